#include "base/frames.hpp"

#include "base/result.hpp"

#include <cmath>

namespace axil {

namespace {
// Below this sine two directions count as parallel: 6e-10 degrees, far above the rounding of a double (1e-14 degrees)
// and below anything a grammar or a measurement is asked to keep (1e-9 degrees).
constexpr double kParallelSine = 1e-11;
}  // namespace

bool PlantDirection::hasDirection(const glm::dvec3& v) {
  const double length = glm::length(v);
  return std::isfinite(length) && length > 0;
}

PlantDirection PlantDirection::along(const glm::dvec3& v) {
  AXIL_ASSERT(hasDirection(v), "a zero vector has no direction");
  return PlantDirection(v / glm::length(v));
}

Angle angleBetween(PlantDirection a, PlantDirection b) {
  return Angle::fromRadians(std::atan2(glm::length(glm::cross(a.unit(), b.unit())), glm::dot(a.unit(), b.unit())));
}

Angle signedAngleAbout(PlantDirection axis, PlantDirection from, PlantDirection to) {
  const glm::dvec3 d = axis.unit();
  const glm::dvec3 f = from.unit() - d * glm::dot(from.unit(), d);
  const glm::dvec3 t = to.unit() - d * glm::dot(to.unit(), d);
  return Angle::fromRadians(std::atan2(glm::dot(glm::cross(f, t), d), glm::dot(f, t)));
}

PlantDirection turned(PlantDirection v, PlantDirection axis, Angle angle) {
  const double c = std::cos(angle.radians());
  const double s = std::sin(angle.radians());
  const glm::dvec3 k = axis.unit();
  return PlantDirection::along(v.unit() * c + glm::cross(k, v.unit()) * s + k * (glm::dot(k, v.unit()) * (1 - c)));
}

PlantDirection perpendicularTo(PlantDirection normal, PlantDirection v) {
  return PlantDirection::along(v.unit() - normal.unit() * glm::dot(v.unit(), normal.unit()));
}

bool areParallel(PlantDirection a, PlantDirection b) { return glm::length(glm::cross(a.unit(), b.unit())) < kParallelSine; }

}  // namespace axil
