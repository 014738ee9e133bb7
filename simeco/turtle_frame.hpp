#pragma once
/// \file
/// Turning the turtle's frame. Internal to the turtle.

#include "base/angle.hpp"
#include "simeco/lsystem_turtle.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace axil::simeco::turtle {

struct SineCosine {
  double sine = 0;
  double cosine = 1;
};
/// Exact at multiples of 90 degrees.
inline SineCosine sineCosine(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarters = turn / 90.0;
  if (quarters == std::floor(quarters)) {
    static constexpr SineCosine kQuarter[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
    return kQuarter[(static_cast<int>(quarters) % 4 + 4) % 4];
  }
  const double radians = Angle::fromDegrees(turn).radians();
  return {std::sin(radians), std::cos(radians)};
}

/// `a` turned towards `b`, and `b` away from `a`.
inline void turn(glm::dvec3& a, glm::dvec3& b, SineCosine angle) {
  const glm::dvec3 old = a;
  a = old * angle.cosine + b * angle.sine;
  b = b * angle.cosine - old * angle.sine;
}

inline bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// `v` turned about the unit vector `axis` (Rodrigues).
inline glm::dvec3 turnedAbout(const glm::dvec3& v, const glm::dvec3& axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

inline void turnFrame(TurtleFrame& frame, const glm::dvec3& axis, double radians) {
  frame.heading = turnedAbout(frame.heading, axis, radians);
  frame.left = turnedAbout(frame.left, axis, radians);
  frame.up = turnedAbout(frame.up, axis, radians);
}

inline glm::dvec3 anyPerpendicular(const glm::dvec3& v) {
  const glm::dvec3 other = std::fabs(v.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
  return glm::normalize(glm::cross(v, other));
}

}  // namespace axil::simeco::turtle
