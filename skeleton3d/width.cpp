#include "skeleton3d/width.hpp"

#include "skeleton3d/camera.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

/// Radii that are pooled to one value because they would grow otherwise.
struct Pool {
  std::vector<MeasuredRadius> members;
  double value = 0;
};

double weightOf(const MeasuredRadius& r) { return 1 / std::max(r.sigma, 1e-9); }

double weightedMedian(std::vector<MeasuredRadius> members) {
  std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.radius < b.radius; });
  double all = 0, below = 0;
  for (const auto& m : members) all += weightOf(m);
  for (std::size_t i = 0; i + 1 < members.size(); ++i) {
    below += weightOf(members[i]);
    if (std::abs(below - 0.5 * all) < 1e-9 * all) return 0.5 * (members[i].radius + members[i + 1].radius);
    if (below > 0.5 * all) return members[i].radius;
  }
  return members.back().radius;
}

}  // namespace

MeasuredRadius radiusFrom(const View& view, const RidgeReading& ridge, PlantPoint at) {
  const glm::dvec2 across{-std::sin(ridge.along.radians()), std::cos(ridge.along.radians())}, half = 0.5 * ridge.width_px * across;
  const Ray left = rayThrough(view.camera, {ridge.at.px - half}), right = rayThrough(view.camera, {ridge.at.px + half});
  const double radius = view.camera.model == CameraModel::Orthographic
                            ? 0.5 * glm::length(right.origin.at - left.origin.at)
                            : glm::length(at.at - left.origin.at) * std::sin(0.5 * angleBetween(left.direction, right.direction).radians());
  // A few percent for what is not round.
  return {radius, radius * std::hypot(ridge.sigmaWidth_px / ridge.width_px, 0.03)};
}

std::optional<MeasuredRadius> combinedRadius(std::span<const MeasuredRadius> readings) {
  if (readings.empty()) return std::nullopt;
  const auto surest = [](const MeasuredRadius& a, const MeasuredRadius& b) { return a.radius + 2 * a.sigma < b.radius + 2 * b.sigma; };
  const MeasuredRadius least = *std::min_element(readings.begin(), readings.end(), surest);
  double weights = 0, sum = 0;
  for (const MeasuredRadius& r : readings) {
    if (r.radius - 2.5 * std::hypot(r.sigma, least.sigma) > least.radius) continue;
    const double weight = 1 / std::max(r.sigma * r.sigma, 1e-18);
    weights += weight;
    sum += weight * r.radius;
  }
  return MeasuredRadius{sum / weights, 1 / std::sqrt(weights)};
}

std::vector<double> taperedRadii(std::span<const MeasuredRadius> radii) {
  std::vector<Pool> pools;
  for (const MeasuredRadius& r : radii) {
    pools.push_back({{r}, r.radius});
    while (pools.size() > 1 && pools.back().value > pools[pools.size() - 2].value) {
      Pool last = std::move(pools.back());
      pools.pop_back();
      Pool& into = pools.back();
      into.members.insert(into.members.end(), last.members.begin(), last.members.end());
      into.value = weightedMedian(into.members);
    }
  }
  std::vector<double> tapered;
  for (const Pool& pool : pools) tapered.insert(tapered.end(), pool.members.size(), pool.value);
  return tapered;
}

}  // namespace axil::skeleton3d
