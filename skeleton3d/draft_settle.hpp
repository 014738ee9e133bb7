#pragma once
/// \file
/// Private to skeleton3d: a drafted stem, found as a way through cubes, is moved to where the middle lines of the masks are, in
/// all views at once and to a fraction of a cube. Views that contradict one another (a leaf that swayed between two photos)
/// meet in the middle; a line too far off is another stem's. Project's unit.

#include "skeleton3d/draft_cubes.hpp"

#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

/// The first point stays: it is the parent's.
[[nodiscard]] std::vector<glm::dvec3> settledOnLines(std::span<const SeenMask> masks, std::vector<glm::dvec3> points, double cubeSide);

}  // namespace axil::skeleton3d::detail
