#include "simeco/light_grid.hpp"

#include "base/turning.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::simeco {

namespace {
constexpr double kCellsAcross = 16;
constexpr double kExtinction = 0.5;
}  // namespace

LightGrid::LightGrid(std::span<const ShadePatch> patches, PlantDirection toLight, double leastCell) {
  const StemFrame frame = firstFrame(toLight);
  light_ = frame.direction.unit();
  across_ = frame.rAxis.unit();
  along_ = frame.adaxial.unit();
  double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-low[0], -low[1]};
  for (const ShadePatch& patch : patches)
    for (int i = 0; i < 2; ++i) {
      const double at = glm::dot(i == 0 ? across_ : along_, patch.at.at);
      low[i] = std::min(low[i], at), high[i] = std::max(high[i], at);
    }
  corner_ = {low[0], low[1]};
  if (patches.empty()) return;
  cell_ = std::max(std::max(high[0] - low[0], high[1] - low[1]) / kCellsAcross, leastCell);
  if (!(cell_ > 0)) return;  // nothing, or all in one line along the light: a line casts no shade
  for (const ShadePatch& patch : patches) {
    const glm::dvec2 at = cellsAt(patch.at);
    columns_[Column{std::llround(at.x), std::llround(at.y)}].push_back({glm::dot(light_, patch.at.at), patch.area});
  }
  for (auto& [column, layers] : columns_) {
    std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) { return a.height > b.height; });
    double sum = 0;
    for (Layer& layer : layers) layer.areaAbove = sum += layer.areaAbove;
  }
}

glm::dvec2 LightGrid::cellsAt(const PlantPoint& point) const {
  const glm::dvec2 at = (glm::dvec2{glm::dot(across_, point.at), glm::dot(along_, point.at)} - corner_) / cell_;
  return glm::clamp(at, -2.0, kCellsAcross + 2);  // farther out there is nothing
}

double LightGrid::areaAbove(Column column, double height) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) return 0;
  const auto& layers = found->second;
  const auto below = std::partition_point(layers.begin(), layers.end(), [&](const Layer& layer) { return layer.height > height; });
  return below == layers.begin() ? 0 : std::prev(below)->areaAbove;
}

double LightGrid::lightAt(const PlantPoint& point) const {
  if (!(cell_ > 0)) return 1;
  const glm::dvec2 at = cellsAt(point), corner = glm::floor(at), within = at - corner;
  const double height = glm::dot(light_, point.at) + cell_ / 2;
  double area = 0;
  for (const int right : {0, 1})
    for (const int back : {0, 1}) {
      const double weight = (right == 1 ? within.x : 1 - within.x) * (back == 1 ? within.y : 1 - within.y);
      if (weight > 0) area += weight * areaAbove({static_cast<std::int64_t>(corner.x) + right, static_cast<std::int64_t>(corner.y) + back}, height);
    }
  return std::exp(-kExtinction * area / (cell_ * cell_));
}

}  // namespace axil::simeco
