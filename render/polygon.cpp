#include "render/polygon.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace axil::render {
namespace {

double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The polygon as seen along its normal, so that it runs counter-clockwise.
void flatten(std::vector<glm::dvec2>& flat, std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 helper = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(helper, normal)), up = glm::cross(normal, right);
  flat.clear();
  for (const glm::dvec3& p : corners) flat.emplace_back(glm::dot(p - corners.front(), right), glm::dot(p - corners.front(), up));
}

bool isInside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return cross2(b - a, p - a) >= 0 && cross2(c - b, p - b) >= 0 && cross2(a - c, p - c) >= 0;
}

/// Whether the corner at place `k` of `left` can be cut off: it turns left, and no other corner lies in its triangle.
bool isEar(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& left, std::size_t k) {
  const std::size_t n = left.size();
  const std::uint32_t before = left[(k + n - 1) % n], here = left[k], after = left[(k + 1) % n];
  const glm::dvec2 &a = flat[before], &b = flat[here], &c = flat[after];
  if (cross2(b - a, c - b) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t other) {
    const glm::dvec2& p = flat[other];
    return p != a && p != b && p != c && isInside(p, a, b, c);
  });
}

}  // namespace

glm::dvec3 areaNormal(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < corners.size(); ++i) sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

std::span<const std::array<std::uint32_t, 3>> PolygonCutter::cut(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  triangles_.clear();
  if (corners.size() < 3) return triangles_;
  left_.resize(corners.size());
  std::iota(left_.begin(), left_.end(), 0u);
  if (corners.size() > 3 && glm::dot(normal, normal) > 0) {
    flatten(flat_, corners, glm::normalize(normal));
    // Each round starts where the last ear was, so that a long strip is cut along it and not as a fan of slivers.
    for (std::size_t k = 0, tried = 0; left_.size() > 3 && tried < left_.size();) {
      k %= left_.size();
      if (!isEar(flat_, left_, k)) {
        ++k, ++tried;
        continue;
      }
      const std::size_t n = left_.size();
      triangles_.push_back({left_[(k + n - 1) % n], left_[k], left_[(k + 1) % n]});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
      ++k, tried = 0;
    }
  }
  for (std::size_t i = 2; i < left_.size(); ++i) triangles_.push_back({left_[0], left_[i - 1], left_[i]});
  return triangles_;
}

std::vector<std::array<std::uint32_t, 3>> trianglesOf(std::span<const glm::dvec3> corners) {
  PolygonCutter cutter;
  const auto triangles = cutter.cut(corners, areaNormal(corners));
  return {triangles.begin(), triangles.end()};
}

}  // namespace axil::render
