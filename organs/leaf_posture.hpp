#pragma once
/// \file
/// Private to the room: the posture of a blade, a height over its plane, so that what does not overlap when flat does not overlap
/// in space. x is the distance from the midrib (0 and above), `side` 1 for the right half and -1 for the left one.

#include "organs/leaf.hpp"
#include "organs/leaf_rulings.hpp"

#include <glm/vec3.hpp>

#include <vector>

namespace axil::organs {

[[nodiscard]] double bowedX(const LeafShape& shape, double x, double y);
[[nodiscard]] glm::dvec3 pointAt(const LeafShape& shape, double side, double x, double y);
[[nodiscard]] glm::dvec3 normalAt(const LeafShape& shape, double side, double x, double y);

/// One half between its rulings as a sheet with `columns` strips from the midrib to the margin.
[[nodiscard]] Mesh halfBlade(const LeafShape& shape, const std::vector<Ruling>& rulings, int columns, double side);

}  // namespace axil::organs
