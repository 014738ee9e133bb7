#include "skeleton3d/bundle.hpp"
#include "skeleton3d/solve_all.hpp"

#include <cmath>
#include <set>

namespace axil::skeleton3d::detail {
namespace {

/// Without its tip: a rounded end is seen a little further out in every photo, which would pull at the cameras.
BundleLine lineOf(const RidgeReading& ridge) {
  return {ridge.at.px, {-std::sin(ridge.along.radians()), std::cos(ridge.along.radians())}, ridge.sigmaAcross_px};
}

/// A place on a stem that nobody clicked: on its centre line in every photo, and anywhere along it.
BundlePoint freeAlong(NodeId id, const std::map<std::size_t, const RidgeReading*>& lines) {
  constexpr double kLoose_px = 60;  // only so that it has a place at all
  BundlePoint point{id, {}, {}, false};
  for (const auto& [view, ridge] : lines) point.clicks.push_back({view, ridge->at.px, kLoose_px, lineOf(*ridge)});
  return point;
}

/// Those seen in three photos or more; two only say where such a place is, not whether the cameras fit.
std::vector<BundlePoint> placesBetween(const Bundle& bundle, const RidgeReadings& readings) {
  std::set<NodeId> clicked;
  for (std::size_t p = 0; p < bundle.nodes; ++p) clicked.insert(bundle.points[p].id);
  std::map<NodeId, std::map<std::size_t, const RidgeReading*>> lines;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v)
    if (const auto view = readings.find(bundle.cameras[v].view.name); view != readings.end())
      for (const auto& [id, ridge] : view->second)
        if (!clicked.contains(id)) lines[id].emplace(v, &ridge);
  std::vector<BundlePoint> places;
  for (const auto& [id, own] : lines)
    if (own.size() > 2) places.push_back(freeAlong(id, own));
  return places;
}

/// Where their rays meet best; what has no such place is left out.
void addPlaced(std::vector<BundlePoint> places, Bundle& bundle) {
  const std::vector<View> views = viewsOf(bundle);
  std::vector<ClickedNode> nodes;
  for (const BundlePoint& place : places) {
    nodes.push_back({place.id, {}, std::nullopt});
    for (const BundleClick& click : place.clicks) nodes.back().clicks[views[click.view].name] = {click.px};
  }
  const auto solved = solveAll(views, nodes, {}, "plant units");
  if (!solved) return;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!solved->nodes[i]) continue;
    const glm::dvec3 at = solved->nodes[i]->position.at;
    places[i].id = NodeId(-1 - static_cast<int>(bundle.points.size()));
    places[i].at = {at.x, at.y, at.z};
    bundle.points.push_back(std::move(places[i]));
  }
}

}  // namespace

Bundle withCentreLines(Bundle bundle, const RidgeReadings& readings) {
  for (std::size_t p = 0; p < bundle.nodes; ++p)
    for (BundleClick& click : bundle.points[p].clicks) {
      const auto view = readings.find(bundle.cameras[click.view].view.name);
      if (view == readings.end()) continue;
      if (const auto ridge = view->second.find(bundle.points[p].id); ridge != view->second.end()) click.line = lineOf(ridge->second);
    }
  addPlaced(placesBetween(bundle, readings), bundle);
  return bundle;
}

}  // namespace axil::skeleton3d::detail
