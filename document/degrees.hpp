#pragma once
/// \file
/// Private to document: angles as degrees for people, such that what is written reads back as the same angle.

#include "base/angle.hpp"
#include "base/text.hpp"

#include <cmath>
#include <limits>

namespace axil::document {

/// The roundest number of degrees that is exactly `angle`; where no number is, which is so for a few angles in a hundred, the nearest.
[[nodiscard]] inline double degreesOf(Angle angle) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double degrees = angle.degrees();
  for (const double candidate : {roundedTo(degrees, 9), degrees, std::nextafter(degrees, infinity), std::nextafter(degrees, -infinity)})
    if (Angle::fromDegrees(candidate) == angle) return candidate;
  return degrees;
}

}  // namespace axil::document
