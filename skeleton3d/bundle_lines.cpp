#include "skeleton3d/bundle.hpp"

#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

BundleLine lineOf(const RidgeReading& ridge) {
  const auto tip = ridge.tip ? std::optional(ridge.tip->px) : std::nullopt;
  return {ridge.at.px, {-std::sin(ridge.along.radians()), std::cos(ridge.along.radians())}, ridge.sigmaAcross_px, tip, ridge.sigmaTip_px};
}

}  // namespace

Bundle withCentreLines(Bundle bundle, const RidgeReadings& readings) {
  for (std::size_t p = 0; p < bundle.nodes; ++p)
    for (BundleClick& click : bundle.points[p].clicks) {
      const auto view = readings.find(bundle.cameras[click.view].view.name);
      if (view == readings.end()) continue;
      if (const auto ridge = view->second.find(bundle.points[p].id); ridge != view->second.end()) click.line = lineOf(ridge->second);
    }
  return bundle;
}

}  // namespace axil::skeleton3d::detail
