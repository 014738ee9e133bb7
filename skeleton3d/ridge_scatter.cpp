#include "skeleton3d/ridge_scatter.hpp"

#include "skeleton3d/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace axil::skeleton3d::detail {
namespace {

/// Wider or narrower than expected by so much, in one photo. What all share, as a blurred photo widens every stem, moves no middle.
std::map<NodeId, double> oddWidths(const std::map<NodeId, RidgeReading>& readings, const std::map<NodeId, ExpectedRidge>& expected) {
  std::map<NodeId, double> odd;
  std::vector<double> all;
  for (const auto& [id, ridge] : readings)
    if (const auto found = expected.find(id); found != expected.end() && found->second.width_px > 0) all.push_back(odd[id] = ridge.width_px - found->second.width_px);
  if (all.empty()) return odd;
  const double usual = medianOf(std::move(all));
  for (auto& [id, by] : odd) by = std::abs(by - usual);
  return odd;
}

}  // namespace

RidgeReadings withWidthScatter(RidgeReadings readings, const ExpectedRidges& expected) {
  constexpr double kOfMedian = 1.4826;  // a standard deviation, of normal numbers
  for (auto& [view, nodes] : readings) {
    const auto known = expected.find(view);
    if (known == expected.end()) continue;
    const auto odd = oddWidths(nodes, known->second);
    if (odd.empty()) continue;
    std::vector<double> all;
    for (const auto& [id, by] : odd) all.push_back(by);
    const double usual = kOfMedian * medianOf(std::move(all));
    for (auto& [id, ridge] : nodes) {
      const auto own = odd.find(id);
      ridge.sigmaAcross_px = std::max(ridge.sigmaAcross_px, 0.75 * std::max(usual, own == odd.end() ? 0.0 : own->second));
    }
  }
  return readings;
}

}  // namespace axil::skeleton3d::detail
