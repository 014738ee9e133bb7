#include "organs/flat_shapes.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace axil::organs {

namespace {

constexpr double negligibleArea = 2e-9;
constexpr double leastQuality = 2e-3;  // a triangle's area over its longest side squared

bool boxesMeet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  return std::max(a.x, b.x) >= std::min(c.x, d.x) && std::max(c.x, d.x) >= std::min(a.x, b.x) && std::max(a.y, b.y) >= std::min(c.y, d.y) &&
         std::max(c.y, d.y) >= std::min(a.y, b.y);
}

bool cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  return boxesMeet(a, b, c, d) && cross2(a, b, c) * cross2(a, b, d) < 0 && cross2(c, d, a) * cross2(c, d, b) < 0;
}

bool holds(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& p) {
  return cross2(a, b, p) >= -1e-14 && cross2(b, c, p) >= -1e-14 && cross2(c, a, p) >= -1e-14;
}

// How far from a sliver the corner's triangle is; below 0 where it is no ear.
double earQuality(std::span<const glm::dvec2> polygon, const std::vector<std::uint32_t>& left, std::size_t i) {
  const std::size_t n = left.size();
  const glm::dvec2 a = polygon[left[(i + n - 1) % n]], b = polygon[left[i]], c = polygon[left[(i + 1) % n]];
  const double area = cross2(a, b, c);
  if (area <= negligibleArea) return -1;
  for (std::size_t k = 0; k < n; ++k) {
    const glm::dvec2& p = polygon[left[k]];
    if (p == a || p == b || p == c) continue;
    if (holds(a, b, c, p)) return -1;
  }
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  const double quality = area / (longest * longest);
  return quality > leastQuality ? quality : -1;
}

}  // namespace

bool isSimpleLine(std::span<const glm::dvec2> line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < line.size(); ++j)
      if (cross(line[i], line[i + 1], line[j], line[j + 1])) return false;
  return true;
}

bool isInside(std::span<const glm::dvec2> polygon, const glm::dvec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const glm::dvec2 &a = polygon[i], &b = polygon[j];
    if ((a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const glm::dvec2> polygon) {
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() > 3) {
    std::size_t best = left.size();
    double bestQuality = 0;
    for (std::size_t i = 0; i < left.size(); ++i)
      if (const double quality = earQuality(polygon, left, i); quality > bestQuality) {
        best = i;
        bestQuality = quality;
      }
    const std::size_t n = left.size();
    if (best == n) {  // only corners on one line are left: the flattest goes
      best = 0;
      for (std::size_t i = 1; i < n; ++i) {
        const auto flatness = [&](std::size_t k) { return std::abs(cross2(polygon[left[(k + n - 1) % n]], polygon[left[k]], polygon[left[(k + 1) % n]])); };
        if (flatness(i) < flatness(best)) best = i;
      }
    } else {
      triangles.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    }
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (left.size() == 3 && cross2(polygon[left[0]], polygon[left[1]], polygon[left[2]]) > negligibleArea) triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace axil::organs
