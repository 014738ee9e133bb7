#include "ui/elsewhere.hpp"

#include "document/lookup.hpp"
#include "ui/epipolar.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;

/// The clicks in another photo that are nearest along the stem, below a place and above it.
struct Around {
  const PhotoPoint *below = nullptr, *above = nullptr;
};
Around clicksAround(const Project& project, const PlaceOnStem& place, const std::string& view) {
  const auto& nodes = project.stems[*document::stemWithId(project, place.stem)].stem.nodes;
  const auto above = std::find(nodes.begin(), nodes.end(), place.above);
  Around around;
  for (auto node = above; node != nodes.end() && around.above == nullptr; ++node) around.above = document::clickOf(project, *node, view);
  for (auto node = above; node != nodes.begin() && around.below == nullptr;) around.below = document::clickOf(project, *--node, view);
  return around;
}

/// Where a node stands that is neither the first nor the last of its stem.
std::optional<PlaceOnStem> placeWithin(const Project& project, NodeId node) {
  const auto stem = document::stemThrough(project, node);
  if (!stem) return std::nullopt;
  const auto& entry = project.stems[*stem].stem;
  const auto at = std::find(entry.nodes.begin(), entry.nodes.end(), node);
  if (at == entry.nodes.begin() || at == entry.nodes.end() || at + 1 == entry.nodes.end()) return std::nullopt;
  return PlaceOnStem{entry.id, *(at - 1), *(at + 1), 0};
}

}  // namespace

std::optional<PhotoPoint> placeElsewhere(const Project& project, const Placed& placed, const PlaceOnStem& place, const std::string& from, PhotoPoint at,
                                         const std::string& to) {
  if (from == to || placed.view(from) == nullptr || placed.view(to) == nullptr) return std::nullopt;
  const auto [below, above] = clicksAround(project, place, to);
  if (below == nullptr || above == nullptr) return std::nullopt;
  const skeleton3d::Reach scene = placed.scene();
  return crossing(epipolarLine(placed.view(from)->camera, at, placed.view(to)->camera, scene.centre, scene.radius), *below, *above);
}

std::vector<FoundPlace> placesOfWaiting(const Project& project, const Placed& placed) {
  std::vector<FoundPlace> found;
  for (const document::ProjectNode& entry : project.nodes) {
    const skeleton3d::ClickedNode& node = entry.node;
    const auto place = node.clicks.size() == 1 ? placeWithin(project, node.id) : std::nullopt;
    if (!place) continue;
    const auto& [from, at] = *node.clicks.begin();
    for (const document::ProjectView& view : project.views)
      if (const auto there = placeElsewhere(project, placed, *place, from, at, view.view.name)) {
        found.push_back({node.id, view.view.name, *there, placed.within_px(from, view.view.name)});
        break;
      }
  }
  return found;
}

PhotoPoint centred(const skeleton3d::Photo* photo, PhotoPoint at) {
  constexpr double kReach = 0.004;  // of the photo's longer side: a stem bends so far between two clicks; further off stands something else
  if (photo == nullptr) return at;
  const auto ridge = skeleton3d::snapClick(*photo, at, {.reach_px = kReach * std::max(photo->width, photo->height)});
  return ridge ? ridge->at : at;
}

}  // namespace axil::ui
