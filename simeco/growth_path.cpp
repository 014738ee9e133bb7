#include "simeco/growth_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::simeco {

namespace {

/// How strongly an obstacle that is touched pushes, as a pull.
constexpr double kPush = 12;
/// Heading straighter at an obstacle than this sine, a tip leans to the side of its r-axis.
constexpr double kHeadOn = 0.05;
/// The sine by which a tip that was turned aside heads away from the obstacle.
constexpr double kAside = 0.1;
/// Of the room that is left, the part a step may use up, so that rounding never closes it.
constexpr double kKeep = 1 - 1e-6;

StemFrame turnedFrame(const StemFrame& frame, PlantDirection axis, Angle angle) {
  return {turned(frame.direction, axis, angle), turned(frame.rAxis, axis, angle), turned(frame.adaxial, axis, angle)};
}

/// The frame carried to another direction the short way.
StemFrame carriedTo(const StemFrame& frame, PlantDirection direction) {
  const glm::dvec3 axis = glm::cross(frame.direction.unit(), direction.unit());
  if (areParallel(frame.direction, direction)) {
    if (glm::dot(frame.direction.unit(), direction.unit()) > 0) return frame;
    return turnedFrame(frame, frame.rAxis, Angle::fromRadians(std::numbers::pi));
  }
  StemFrame carried = turnedFrame(frame, PlantDirection::along(axis), angleBetween(frame.direction, direction));
  carried.direction = direction;
  return carried;
}

/// The frame after `pull` acted for `share` of a growth: tan(angle to it / 2) falls by exp(-|pull| share).
StemFrame pulled(const StemFrame& frame, const glm::dvec3& pull, double share) {
  const double strength = glm::length(pull);
  if (!(strength * share > 0)) return frame;
  const PlantDirection goal = PlantDirection::along(pull);
  if (areParallel(frame.direction, goal)) return frame;
  const double angle = angleBetween(frame.direction, goal).radians();
  const double left = 2 * std::atan(std::tan(angle / 2) * std::exp(-strength * share));
  return turnedFrame(frame, PlantDirection::along(glm::cross(frame.direction.unit(), goal.unit())), Angle::fromRadians(angle - left));
}

/// What an obstacle within sight adds to the pull of a tip with `frame`: a tip that heads for it is turned aside, until it runs along it and
/// a little away from it. So a shoot that meets a wall follows the wall and is not thrown back.
glm::dvec3 pushAt(const glm::dvec3& at, const StemFrame& frame, const PathStep& step, const PathRules& rules) {
  if (step.obstacles == nullptr || !(rules.sight > 0)) return {0, 0, 0};
  const auto nearest = step.obstacles->nearest(at, at, rules.sight);
  if (!nearest || !(nearest->distance > 0)) return {0, 0, 0};
  const glm::dvec3 away = (at - nearest->at) / nearest->distance, heading = frame.direction.unit();
  const double outwards = glm::dot(away, heading);
  if (outwards >= kAside) return {0, 0, 0};
  glm::dvec3 along = heading - away * outwards;
  // Straight on there is no way to turn but that of the r-axis.
  if (glm::length(along) < kHeadOn) along = frame.rAxis.unit() - away * glm::dot(away, frame.rAxis.unit());
  const double closeness = 1 - nearest->distance / rules.sight;
  return glm::normalize(glm::normalize(along) + away * kAside) * (kPush * closeness * closeness);
}

/// Straight ways out of one point.
class Ways {
 public:
  Ways(const ObstacleField* obstacles, const glm::dvec3& from, double reach, double clearance) : obstacles_(obstacles), from_(from), reach_(reach) {
    if (obstacles_ == nullptr) return;
    const auto nearest = obstacles_->nearest(from, from, reach + clearance);
    if (!nearest) {
      obstacles_ = nullptr;  // none can be met
      return;
    }
    out_ = from - nearest->at;
    room_ = std::min(clearance, nearest->distance * kKeep);
  }

  [[nodiscard]] bool isFree(const glm::dvec3& direction) const {
    if (obstacles_ == nullptr) return true;
    return !obstacles_->nearest(from_, from_ + direction * reach_, room_);
  }

  /// The free way that is nearest to `frame`'s in kind: along the obstacle, then more and more away from it, then to the sides.
  [[nodiscard]] std::optional<PlantDirection> around(const StemFrame& frame) const {
    if (!PlantDirection::hasDirection(out_)) return std::nullopt;
    const PlantDirection out = PlantDirection::along(out_);
    const bool headOn = areParallel(frame.direction, out);
    const PlantDirection along = perpendicularTo(out, headOn ? frame.rAxis : frame.direction);
    for (const double side : {0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 135.0, -135.0, 180.0}) {
      const PlantDirection way = turned(along, out, Angle::fromDegrees(side));
      for (const double lift : {0.0, 0.05, 0.2, 0.6, 2.0}) {
        const PlantDirection direction = PlantDirection::along(way.unit() + out.unit() * lift);
        if (isFree(direction.unit())) return direction;
      }
    }
    return std::nullopt;
  }

 private:
  const ObstacleField* obstacles_;
  glm::dvec3 from_;
  double reach_;
  double room_ = 0;
  glm::dvec3 out_{0};
};

/// The trail so far. Pieces along one heading are one.
class Trail {
 public:
  Trail(const PlantPoint& base, const PlantDirection& straight) : points_{base, base}, heading_(straight), corner_(base.at) {}
  void add(const PlantDirection& heading, double length) {
    if (!(length > 0)) return;
    if (heading_ != heading) turn(heading);
    piece_ += length;
    length_ += length;
    points_.back() = {corner_ + heading_.unit() * piece_};
  }
  [[nodiscard]] const glm::dvec3& tip() const { return points_.back().at; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] std::vector<PlantPoint> take(const PlantDirection& straight) {
    if (points_.size() == 2 && heading_ == straight) return {};
    return std::move(points_);
  }

 private:
  void turn(const PlantDirection& heading) {
    if (piece_ > 0) points_.push_back(points_.back());
    corner_ = points_.back().at;
    heading_ = heading;
    piece_ = 0;
  }
  std::vector<PlantPoint> points_;
  PlantDirection heading_;
  glm::dvec3 corner_;
  double piece_ = 0, length_ = 0;
};

}  // namespace

Path followPath(const PlantPoint& base, const StemFrame& frame, std::span<const PathStep> steps, const PathRules& rules) {
  const double stepShare = 1.0 / rules.steps;
  Trail trail(base, frame.direction);
  StemFrame heading = frame;
  bool stopped = false;
  for (const PathStep& step : steps) {
    const glm::dvec3 pull = step.pull + pushAt(trail.tip(), heading, step, rules);
    const StemFrame middle = pulled(heading, pull, stepShare / 2);
    const Ways ways(step.obstacles, trail.tip(), step.reach, rules.clearance);
    if (ways.isFree(middle.direction.unit())) {
      trail.add(middle.direction, step.length);
      heading = pulled(heading, pull, stepShare * step.share);
      continue;
    }
    const auto around = ways.around(heading);
    if (stopped = !around; stopped) break;
    heading = carriedTo(heading, *around);
    trail.add(*around, step.length);
  }
  return {trail.take(frame.direction), heading, trail.length(), stopped};
}

Swing swingBody(const PlantPoint& base, const StemFrame& frame, std::span<const PathStep> steps, const PathRules& rules, double length, double reach) {
  const double stepShare = 1.0 / rules.steps;
  StemFrame heading = frame;
  for (const PathStep& step : steps) heading = pulled(heading, step.pull, stepShare * step.share);
  const ObstacleField* obstacles = steps.empty() ? nullptr : steps.back().obstacles;
  if (obstacles == nullptr || !(reach > 0)) return {heading, length};
  const Ways ways(obstacles, base.at, reach, rules.clearance);
  if (ways.isFree(heading.direction.unit())) return {heading, length};
  if (const auto around = ways.around(heading)) return {carriedTo(heading, *around), length};
  // No room for the whole body any way: as much of it as there is room for.
  const auto nearest = obstacles->nearest(base.at, base.at, reach);
  return {heading, nearest ? std::min(length, std::max(0.0, nearest->distance * 0.5)) : length};
}

}  // namespace axil::simeco
