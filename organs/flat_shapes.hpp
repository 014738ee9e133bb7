#pragma once
/// \file
/// Private to the room: lines and polygons in a blade's plane.

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace axil::organs {

/// Twice the signed area of a triangle: above 0 when counter-clockwise.
[[nodiscard]] inline double cross2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
/// Whether no two pieces of an open line cross.
[[nodiscard]] bool isSimpleLine(std::span<const glm::dvec2> line);
/// Whether the point lies inside the closed polygon.
[[nodiscard]] bool isInside(std::span<const glm::dvec2> polygon, const glm::dvec2& point);
/// A simple counter-clockwise polygon as triangles (indices into it), none without area; ears are cut fattest first.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const glm::dvec2> polygon);

}  // namespace axil::organs
