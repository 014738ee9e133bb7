#include "quantify/distribution.hpp"

#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace axil::quantify {

Moments momentsOf(const std::vector<double>& values) {
  Moments m;
  if (values.empty()) return m;
  for (const double v : values) m.mean += v;
  m.mean /= static_cast<double>(values.size());
  double sum = 0;
  for (const double v : values) sum += (v - m.mean) * (v - m.mean);
  if (values.size() > 1) m.deviation = std::sqrt(sum / static_cast<double>(values.size() - 1));
  return m;
}

namespace {

constexpr std::size_t kTableSize = 24;
constexpr std::size_t kTested = 8;        // fewer samples contradict nothing
constexpr double kLilliefors = 1.031;     // 1 % bound of sqrt(n) D, of a normal distribution with estimated mean and deviation

/// sqrt(n) times the greatest distance between the samples' distribution and `below`. `sorted` ascending.
double distanceTo(const std::vector<double>& sorted, const std::function<double(double)>& below) {
  const double n = static_cast<double>(sorted.size());
  double worst = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double f = below(sorted[i]);
    worst = std::max({worst, std::abs(static_cast<double>(i + 1) / n - f), std::abs(f - static_cast<double>(i) / n)});
  }
  return worst * std::sqrt(n);
}

std::vector<double> quantiles(const std::vector<double>& sorted) {
  if (sorted.size() <= kTableSize) return sorted;
  std::vector<double> table;
  for (std::size_t i = 0; i < kTableSize; ++i) table.push_back(quantileOf(sorted, (static_cast<double>(i) + 0.5) / kTableSize));
  return table;
}

/// Their number and mean, as if they were all alike. Sorts them.
Distribution constantOf(std::vector<double>& values, const Moments& m) {
  std::sort(values.begin(), values.end());
  Distribution d;
  d.samples = values.size();
  d.centre = m.mean;
  return d;
}

}  // namespace

Distribution distributionOf(std::vector<double> values) {
  const Moments m = momentsOf(values);
  Distribution d = constantOf(values, m);
  if (values.empty()) return d;
  const double size = std::max(std::abs(values.front()), std::abs(values.back()));
  if (m.deviation <= 1e-4 * size || values.size() < 2) return d;
  d.spread = m.deviation;
  const auto normal = [&](double x) { return 0.5 * std::erfc(-(x - m.mean) / (m.deviation * std::numbers::sqrt2)); };
  const bool clear = values.front() < 0 || m.mean > 3.5 * m.deviation;
  // The ends of an even distribution lie a little beyond the samples'.
  const double beyond = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  const double low = values.front() - (values.front() < beyond && values.front() >= 0 ? 0 : beyond);
  const double high = values.back() + beyond;
  const auto even = [&](double x) { return (x - low) / (high - low); };
  const bool few = values.size() < kTested;
  const double fromNormal = few ? 0 : distanceTo(values, normal);
  const double fromEven = few ? kLilliefors : distanceTo(values, even);
  if (clear && fromNormal < kLilliefors && fromNormal <= fromEven) {
    d.form = Distribution::Form::Normal;
    return d;
  }
  if (fromEven < kLilliefors) {
    d.form = Distribution::Form::Even;
    d.centre = (low + high) / 2;
    d.spread = (high - low) / 2;
    return d;
  }
  d.form = Distribution::Form::Table;
  d.values = quantiles(values);
  return d;
}

Distribution countsOf(std::vector<double> values) {
  const Moments m = momentsOf(values);
  Distribution d = constantOf(values, m);
  if (values.empty() || values.front() == values.back()) return d;
  d.spread = m.deviation;
  d.form = Distribution::Form::Table;
  // Quantiles of whole numbers are whole.
  if (values.size() > kTableSize) {
    std::vector<double> table;
    for (std::size_t i = 0; i < kTableSize; ++i) table.push_back(values[(2 * i + 1) * values.size() / (2 * kTableSize)]);
    values = std::move(table);
  }
  d.values = std::move(values);
  return d;
}

}  // namespace axil::quantify
