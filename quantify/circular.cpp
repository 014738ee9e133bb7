#include "quantify/circular.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kMostDeviation = 10;

/// The Rayleigh test's probability, by the series of Mardia and Jupp (6.3.2) that is good from a few samples on.
double rayleigh(double concentration, std::size_t samples) {
  const double n = static_cast<double>(samples);
  const double z = n * concentration * concentration;
  const double series = 1 + (2 * z - z * z) / (4 * n) - (24 * z - 132 * z * z + 76 * z * z * z - 9 * z * z * z * z) / (288 * n * n);
  return std::clamp(std::exp(-z) * series, 0.0, 1.0);
}

}  // namespace

double wrappedTo(double radians, double period) {
  const double w = std::remainder(radians, period);
  return w <= -period / 2 ? w + period : w;
}

CircularMean circularMeanOf(std::span<const double> radians, double period) {
  CircularMean result;
  result.samples = radians.size();
  if (radians.empty()) return result;
  const double factor = 2 * std::numbers::pi / period;
  double x = 0;
  double y = 0;
  for (const double r : radians) {
    x += std::cos(r * factor);
    y += std::sin(r * factor);
  }
  const double n = static_cast<double>(radians.size());
  result.concentration = std::min(1.0, std::hypot(x, y) / n);
  result.mean = wrappedTo(std::atan2(y, x) / factor, period);
  result.deviation = result.concentration > 0 ? std::min(kMostDeviation, std::sqrt(std::max(0.0, -2 * std::log(result.concentration)))) / factor : kMostDeviation;
  result.chance = rayleigh(result.concentration, result.samples);
  return result;
}

}  // namespace axil::quantify
