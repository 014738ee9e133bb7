#include "skeleton3d/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

double chiSquaredAt(int freedom, double normalQuantile) {
  const double k = std::max(freedom, 1), spread = 2 / (9 * k);
  const double root = 1 - spread + normalQuantile * std::sqrt(spread);
  return k * root * root * root;
}

}  // namespace

double chiSquaredMedian(int freedom) { return chiSquaredAt(freedom, 0); }
double chiSquaredLimit(int freedom) { return chiSquaredAt(freedom, 3.0902); }

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Scatter scatterFrom(double squares, int freedom) {
  constexpr double kBelief = 2;  // so many numbers say one pixel before any click does
  const double count = std::max(freedom, 0);
  return {std::sqrt(((count > 0 ? squares : 0) + kBelief) / (count + kBelief)), std::max(freedom, 0)};
}

}  // namespace axil::skeleton3d::detail
