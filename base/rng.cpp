#include "base/rng.hpp"

#include "base/result.hpp"

#include <cmath>
#include <numbers>

namespace axil {

std::uint64_t Rng::below(std::uint64_t count) {
  AXIL_ASSERT(count > 0, "a choice among nothing");
  // Draws in the short last block are thrown away, so that every outcome is equally likely.
  const std::uint64_t limit = count * ((~std::uint64_t{0}) / count);
  std::uint64_t draw = bits();
  while (draw >= limit) draw = bits();
  return draw % count;
}

double Rng::normal(double mean, double standardDeviation) {
  const double u = 1.0 - uniform();  // (0, 1], so the logarithm is finite
  const double v = uniform();
  return mean + standardDeviation * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

}  // namespace axil
