#pragma once
/// \file
/// Private to render: a polygon in space, cut into triangles.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace axil::render {

/// The normal of a polygon that need not be flat, as long as twice its area (Newell's method); counter-clockwise seen from there.
[[nodiscard]] glm::dvec3 areaNormal(std::span<const glm::dvec3> corners);

/// Triangles over the corners, counter-clockwise as they are, by cutting off ears of what is seen along the normal. A polygon of
/// n corners gives n - 2; where it crosses itself what is left over is cut as a fan.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> trianglesOf(std::span<const glm::dvec3> corners);

/// `trianglesOf` for one polygon after the other, in memory that is kept between them.
class PolygonCutter {
 public:
  /// `normal` is the polygon's `areaNormal`. Valid until the next call.
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> cut(std::span<const glm::dvec3> corners, const glm::dvec3& normal);

 private:
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> left_;   ///< corners not yet cut off
  std::vector<glm::dvec2> flat_;
};

}  // namespace axil::render
