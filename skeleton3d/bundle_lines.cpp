#include "skeleton3d/bundle.hpp"

#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

/// Without its tip: a rounded end is seen a little further out in every photo, which would pull at the cameras.
BundleLine lineOf(const RidgeReading& ridge) {
  return {ridge.at.px, {-std::sin(ridge.along.radians()), std::cos(ridge.along.radians())}, ridge.sigmaAcross_px};
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
