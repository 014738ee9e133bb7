#pragma once
/// \file
/// Directions on a circle: means and spreads of angles around a stem, in radians. A mean of angles is the angle of the mean of their unit
/// vectors; how long that mean is, from 0 to 1, says how concentrated they are. Source: Mardia and Jupp, Directional Statistics (2000).

#include <cstddef>
#include <span>

namespace axil::quantify {

struct CircularMean {
  double mean = 0;           ///< in (-pi, pi]; 0 where nothing was given
  double concentration = 0;  ///< length of the mean vector: 1 all alike, near 0 no direction
  double deviation = 0;      ///< sqrt(-2 ln concentration), at most 10
  double chance = 1;         ///< Rayleigh: how likely evenly spread angles are as concentrated by chance
  std::size_t samples = 0;
};

/// Angles that differ by `period` are the same (pi for axes that have two equal ends).
[[nodiscard]] CircularMean circularMeanOf(std::span<const double> radians, double period = 6.283185307179586476925286766559);

/// `radians` brought into (-period/2, period/2].
[[nodiscard]] double wrappedTo(double radians, double period = 6.283185307179586476925286766559);

}  // namespace axil::quantify
