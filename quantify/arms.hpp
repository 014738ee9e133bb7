#pragma once
/// \file
/// Arms: axes that leave one node together, told apart where they differ, as a straight long and a bent short arm of a fork do.
///
/// The axes of each node are sorted, by how far they lean or by their length over their bearer's, whichever tells them apart better. Arms count as different
/// where the means of neighbours in that order lie more than 2.5 of their deviations apart; sorting alone puts two axes of one kind 1.4 apart.
/// Source: Barthelemy and Caraglio 2007 (sympodial branching; unequal arms).

#include "quantify/phyllotaxis.hpp"
#include "quantify/structure.hpp"

#include <span>
#include <vector>

namespace axil::quantify {

/// One axis that is an arm.
struct ArmMember {
  std::size_t plant = 0;
  SegmentId base;
};

struct Arms {
  int count = 0;                               ///< axes at the node
  std::vector<std::vector<ArmMember>> members; ///< of each arm, the straightest (or longest) first
};

/// What arms may be told apart by. A forecast can only know how an arm will lean.
enum class ArmsBy { Lean, LeanOrLength };

/// Nodes on axes of the orders from `low` to `high` that bear two axes and more, by their number; only those whose arms differ, on four nodes at least.
[[nodiscard]] std::vector<Arms> armsOf(std::span<const MeasuredPlant> plants, int low, int high, ArmsBy by = ArmsBy::LeanOrLength);

}  // namespace axil::quantify
