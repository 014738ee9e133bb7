#pragma once
/// \file
/// Axes: the organs of a plant chained into stems. An organ of an L-system is one straight segment; a stem is the chain of
/// segments that follow each other tip to base. Leaves, flowers and fruits are not chained, they sit on a node.
///
/// A growing point has a body of next to no length (1e-8); bodies shorter than `negligible` are passed over, and what
/// stands on them stands on what they stand on.
/// Source: L-Grammar Generator 2005, section 3.3 (stems, main stems and branches).

#include "simeco/plant.hpp"

#include <optional>
#include <vector>

namespace axil::render {

struct AxisTag;
using AxisId = Id<AxisTag>;  ///< index into PlantAxes::axes

/// A point of an axis: node 0 is its base, node k the tip of its k-th organ.
struct Site {
  AxisId axis;
  std::int32_t node = 0;
  friend bool operator==(const Site&, const Site&) = default;
};

struct Axis {
  std::vector<simeco::OrganId> organs;   ///< base to tip, at least one, none negligible
  std::optional<Site> insertion;         ///< the node of its parent that it starts at; none: it stands alone
};

struct PlantAxes {
  std::vector<Axis> axes;                         ///< parent before child
  std::vector<std::optional<Site>> siteOfTip;     ///< one an organ: where things on its tip sit (for a leaf: where it is attached)
  double extent = 0;                              ///< `extentOf` the plant
  double negligible = 0;                          ///< length below which a body was passed over
};

/// What goes on as the same axis. Brackets: the child without brackets, as the grammar says. Straightest: where all
/// children stand in brackets, the one that bends least, up to 45 degrees; that is how a picture looks unjointed.
enum class Continuation { Brackets, Straightest };

/// The diameter of the box around all organs: what "small" is measured against.
[[nodiscard]] double extentOf(const simeco::Plant& plant);

/// Stems, apices with a body and roots are chained; a root never continues a stem.
[[nodiscard]] PlantAxes axesOf(const simeco::Plant& plant, Continuation continuation);

/// The nodes of an axis, one more than its organs.
[[nodiscard]] std::vector<PlantPoint> nodesOf(const simeco::Plant& plant, const Axis& axis);

}  // namespace axil::render
