#pragma once
/// \file
/// Outlines as polygons: their area, and whether their edges cross.

#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

namespace axil::organs::test {

inline double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Above zero when the corners go round against the clock.
inline double areaOf(const std::vector<glm::vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

inline bool segmentsCross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
  const auto side = [](glm::dvec2 p, glm::dvec2 q, glm::dvec2 r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

inline int crossingsOf(const std::vector<glm::vec2>& polygon) {
  int crossings = 0;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && segmentsCross(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n])) ++crossings;
  return crossings;
}

}  // namespace axil::organs::test
