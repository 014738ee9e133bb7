#include "base/turning.hpp"

#include <numbers>

namespace axil {

namespace {

PlantDirection firstAxisFor(PlantDirection direction) {
  const PlantDirection x = PlantDirection::along({1, 0, 0});
  return perpendicularTo(direction, areParallel(direction, x) ? PlantDirection::along({0, 0, 1}) : x);
}

PlantDirection branchAxis(const StemFrame& parent, PlantDirection child, PlantDirection carried, TurningRule rule) {
  if (rule == TurningRule::Literal) return parent.direction;
  return areParallel(parent.direction, child) ? carried : perpendicularTo(child, parent.direction);
}

}  // namespace

StemFrame firstFrame(PlantDirection direction) {
  const PlantDirection r = firstAxisFor(direction);
  return {direction, r, PlantDirection::along(glm::cross(r.unit(), direction.unit()))};
}

StemFrame childFrame(const StemFrame& parent, Turn turn, ChildKind kind, TurningRule rule) {
  const PlantDirection bent = turned(parent.direction, parent.rAxis, turn.rotr);
  const PlantDirection child = turned(bent, parent.direction, turn.rotu);
  const PlantDirection carried = turned(parent.rAxis, parent.direction, turn.rotu);
  const PlantDirection adaxial =
      areParallel(parent.direction, child) ? turned(parent.adaxial, parent.direction, turn.rotu) : perpendicularTo(child, parent.direction);
  return {child, kind == ChildKind::Main ? carried : branchAxis(parent, child, carried, rule), adaxial};
}

Turn measuredTurn(const StemFrame& parent, PlantDirection child) {
  const Angle rotr = angleBetween(parent.direction, child);
  if (areParallel(parent.direction, child)) return {rotr, Angle{}};
  const PlantDirection start = turned(parent.direction, parent.rAxis, Angle::fromRadians(std::numbers::pi / 2));
  return {rotr, signedAngleAbout(parent.direction, start, child)};
}

}  // namespace axil
