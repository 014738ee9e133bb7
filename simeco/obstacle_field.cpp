#include "simeco/obstacle_field.hpp"

#include "base/overloaded.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::simeco {

namespace {

using Point = glm::dvec3;

/// Two points that are nearest to each other: of the segment, and of the obstacle.
struct Pair {
  Point mine{0}, its{0};
  [[nodiscard]] double distance() const { return glm::distance(mine, its); }
};

Pair nearer(const Pair& a, const Pair& b) { return b.distance() < a.distance() ? b : a; }

Point nearestOfSegment(const Point& a, const Point& b, const Point& p) {
  const Point ab = b - a;
  const double square = glm::dot(ab, ab);
  return square > 0 ? a + ab * std::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : a;
}

Pair betweenSegments(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a, v = d - c, w = a - c;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  const double determinant = uu * vv - uv * uv;
  Pair best{a, nearestOfSegment(c, d, a)};
  best = nearer(best, {b, nearestOfSegment(c, d, b)});
  best = nearer(best, {nearestOfSegment(a, b, c), c});
  best = nearer(best, {nearestOfSegment(a, b, d), d});
  // The lines' nearest points count where both lie within; for parallel ones an end is as near as anything.
  if (!(determinant > 1e-14 * uu * vv)) return best;
  const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
  return s > 0 && s < 1 && t > 0 && t < 1 ? nearer(best, {a + u * s, c + v * t}) : best;
}

/// The foot of `p` on the triangle's plane, where it lies within the triangle.
std::optional<Point> footWithin(const Point& a, const Point& b, const Point& c, const Point& p) {
  const Point normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  if (!(square > 0)) return std::nullopt;
  const Point foot = p - normal * (glm::dot(p - a, normal) / square);
  const bool within = glm::dot(glm::cross(b - a, foot - a), normal) >= 0 && glm::dot(glm::cross(c - b, foot - b), normal) >= 0 &&
                      glm::dot(glm::cross(a - c, foot - c), normal) >= 0;
  return within ? std::optional<Point>(foot) : std::nullopt;
}

/// Where the segment crosses the triangle.
std::optional<Point> crossing(const Point& a, const Point& b, const Point& c, const Point& from, const Point& to) {
  const Point normal = glm::cross(b - a, c - a);
  const double before = glm::dot(from - a, normal), after = glm::dot(to - a, normal);
  if (before == after || before * after > 0) return std::nullopt;
  return footWithin(a, b, c, from + (to - from) * (before / (before - after)));
}

Pair toTriangle(const Point& a, const Point& b, const Point& c, const Point& from, const Point& to) {
  if (const auto point = crossing(a, b, c, from, to)) return {*point, *point};
  Pair best = nearer(nearer(betweenSegments(from, to, a, b), betweenSegments(from, to, b, c)), betweenSegments(from, to, c, a));
  for (const Point& end : {from, to})
    if (const auto foot = footWithin(a, b, c, end)) best = nearer(best, {end, *foot});
  return best;
}

constexpr std::uint32_t kFewTriangles = 4;

}  // namespace

ObstacleField::ObstacleField(std::span<const Obstacle> obstacles) {
  for (const Obstacle& obstacle : obstacles)
    std::visit(overloaded{[&](const SphereObstacle& sphere) { spheres_.push_back(sphere); }, [&](const BoxObstacle& box) { addBox(box); },
                          [&](const MeshObstacle& mesh) { addMesh(mesh); }},
               obstacle);
  if (triangles_.empty()) return;
  groups_.push_back(groupOf(0, static_cast<std::uint32_t>(triangles_.size())));
  for (std::size_t i = 0; i < groups_.size(); ++i) divide(i);
}

void ObstacleField::addBox(const BoxObstacle& box) {
  boxes_.push_back(box);
  const auto corner = [&](int i) { return Point{i & 1 ? box.high.at.x : box.low.at.x, i & 2 ? box.high.at.y : box.low.at.y, i & 4 ? box.high.at.z : box.low.at.z}; };
  constexpr int sides[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  for (const auto& side : sides) {
    triangles_.push_back({corner(side[0]), corner(side[1]), corner(side[2])});
    triangles_.push_back({corner(side[0]), corner(side[2]), corner(side[3])});
  }
}

void ObstacleField::addMesh(const MeshObstacle& mesh) {
  for (const auto& t : mesh.triangles) triangles_.push_back({mesh.points[t[0]].at, mesh.points[t[1]].at, mesh.points[t[2]].at});
}

ObstacleField::Group ObstacleField::groupOf(std::uint32_t first, std::uint32_t last) const {
  Point low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = first; i < last; ++i)
    for (const Point& p : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) low = glm::min(low, p), high = glm::max(high, p);
  return {(low + high) * 0.5, glm::distance(low, high) * 0.5, first, last, -1};
}

/// Halves a group at the median of its longest side.
void ObstacleField::divide(std::size_t group) {
  const auto [centre, radius, first, last, halves] = groups_[group];
  if (last - first <= kFewTriangles) return;
  Point low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  const auto middleOf = [](const Triangle& t) { return t.a + t.b + t.c; };
  for (std::uint32_t i = first; i < last; ++i) low = glm::min(low, middleOf(triangles_[i])), high = glm::max(high, middleOf(triangles_[i]));
  const Point size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  // A stable order, so that equal middles fall the same way everywhere.
  std::stable_sort(triangles_.begin() + first, triangles_.begin() + last, [&](const Triangle& a, const Triangle& b) { return middleOf(a)[axis] < middleOf(b)[axis]; });
  groups_[group].halves = static_cast<std::int32_t>(groups_.size());
  groups_.push_back(groupOf(first, middle));
  groups_.push_back(groupOf(middle, last));
}

std::optional<ObstacleField::Nearest> ObstacleField::nearest(const glm::dvec3& a, const glm::dvec3& b, double within) const {
  std::optional<Nearest> best;
  const auto offer = [&](double distance, const Point& at) {
    if (distance < within) within = distance, best = Nearest{distance, at};
  };
  for (const SphereObstacle& sphere : spheres_) {
    const Point out = nearestOfSegment(a, b, sphere.centre.at) - sphere.centre.at;
    const double away = glm::length(out);
    offer(away - sphere.radius, sphere.centre.at + (away > 0 ? out / away : Point{0, 1, 0}) * sphere.radius);
  }
  if (groups_.empty()) return best;
  // Halving keeps the depth below 40, so a small stack of open groups is enough.
  std::array<std::int32_t, 128> open{};
  std::size_t count = 1;
  while (count > 0) {
    const Group& group = groups_[static_cast<std::size_t>(open[--count])];
    if (glm::distance(nearestOfSegment(a, b, group.centre), group.centre) - group.radius >= within) continue;
    if (group.halves >= 0) {
      open[count++] = group.halves;
      open[count++] = group.halves + 1;
      continue;
    }
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      const Pair pair = toTriangle(triangles_[i].a, triangles_[i].b, triangles_[i].c, a, b);
      offer(pair.distance(), pair.its);
    }
  }
  return best;
}

bool ObstacleField::holds(const glm::dvec3& p) const {
  const auto inBox = [&](const BoxObstacle& b) { return glm::clamp(p, b.low.at, b.high.at) == p; };
  const auto inSphere = [&](const SphereObstacle& s) { return glm::distance(p, s.centre.at) <= s.radius; };
  return std::any_of(boxes_.begin(), boxes_.end(), inBox) || std::any_of(spheres_.begin(), spheres_.end(), inSphere);
}

}  // namespace axil::simeco
