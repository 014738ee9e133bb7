#pragma once
/// \file
/// Private to skeleton3d: lines of places, in a photo, in space or in both at once.

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace axil::skeleton3d::detail {

/// How far `p` is from the straight piece between `a` and `b`.
template <class Vec>
double distanceToPiece(const Vec& p, const Vec& a, const Vec& b) {
  const Vec d = b - a;
  const double square = glm::dot(d, d);
  const double share = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
  return glm::length(a + share * d - p);
}

/// Which of `points` (numbers, rising) to keep so that the line through them is within `tolerance` of all of them; both ends
/// always (Ramer, Douglas and Peucker).
template <class Vec>
std::vector<std::size_t> fewWithin(const std::vector<Vec>& points, double tolerance) {
  if (points.size() < 2) return points.empty() ? std::vector<std::size_t>{} : std::vector<std::size_t>{0};
  std::vector<std::size_t> kept{0}, ahead{points.size() - 1};
  while (!ahead.empty()) {
    const std::size_t a = kept.back(), b = ahead.back();
    double furthest = tolerance;
    std::size_t which = a;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double off = distanceToPiece(points[i], points[a], points[b]); off > furthest) furthest = off, which = i;
    if (which != a) {
      ahead.push_back(which);
    } else {
      kept.push_back(b);
      ahead.pop_back();
    }
  }
  return kept;
}

}  // namespace axil::skeleton3d::detail
