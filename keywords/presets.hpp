#pragma once
/// \file
/// What traits mean for geometry: the arrangement's numbers, the leaf's outline and size. Every preset names the words that
/// set it; what the text does not say stays empty.

#include "keywords/types.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::keywords {

/// The defaults that `traits` set. Statements marked "rarely" or "sometimes" set none. Of two arrangements one of which makes
/// the other precise (opposite, decussate) the precise one counts; otherwise the first. Sizes are the middle of their range.
[[nodiscard]] Presets presetsOf(const Traits& traits);

/// The arrangement of that name, in any of the vocabulary's words and scripts, lower or upper case: "decussate", "Opposite",
/// 輪生. "whorled 4" carries four leaves at each node.
[[nodiscard]] std::optional<ArrangementPreset> arrangementNamed(std::string_view name);
/// The English names, in the table's order.
[[nodiscard]] std::vector<std::string> arrangementNames();
/// How far the k-th node (from 0) is turned against the first: k times the divergence, or the turns of the cycle one after another.
[[nodiscard]] Angle turnOfNode(const ArrangementPreset& preset, std::size_t k);
/// `preset` with another number of leaves at each node; whorls stand above the gaps of the whorl below.
[[nodiscard]] ArrangementPreset withLeavesPerNode(ArrangementPreset preset, int leavesPerNode);

/// The row of organs/data/leaf_shapes.tsv that draws a shape's value; of a compound ("ovate-lanceolate") the last half that
/// has one. Empty when none has.
[[nodiscard]] std::string drawnShapeOf(std::string_view value);

}  // namespace axil::keywords
