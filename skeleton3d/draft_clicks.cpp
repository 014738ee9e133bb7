#include "skeleton3d/camera.hpp"
#include "skeleton3d/draft.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

struct Spot {
  PlantPoint at;
  double radius = 0;
};

struct Chains {
  std::vector<Spot> spots;
  std::vector<std::vector<std::size_t>> stems;
};

/// The parent's spot at `at`: one of its own where that is within `near`, else a new one between two of them.
std::size_t spotOn(Chains& chains, std::vector<std::size_t>& parent, PlantPoint at, double near) {
  std::size_t best = 0;
  double least = 1e300, share = 0;
  for (std::size_t i = 0; i + 1 < parent.size(); ++i) {
    const glm::dvec3 a = chains.spots[parent[i]].at.at, d = chains.spots[parent[i + 1]].at.at - a;
    const double f = glm::dot(d, d) > 0 ? std::clamp(glm::dot(at.at - a, d) / glm::dot(d, d), 0.0, 1.0) : 0;
    if (const double off = glm::length(a + f * d - at.at); off < least) least = off, best = i, share = f;
  }
  const Spot a = chains.spots[parent[best]], b = chains.spots[parent[best + 1]];
  const double length = glm::length(b.at.at - a.at.at);
  if (share * length < near) return parent[best];
  if ((1 - share) * length < near) return parent[best + 1];
  chains.spots.push_back({{a.at.at * (1 - share) + b.at.at * share}, a.radius * (1 - share) + b.radius * share});
  parent.insert(parent.begin() + static_cast<std::ptrdiff_t>(best) + 1, chains.spots.size() - 1);
  return chains.spots.size() - 1;
}

Chains chainsOf(std::span<const DraftStem> stems) {
  Chains chains;
  for (const DraftStem& stem : stems) {
    const double length = glm::length(stem.points.back().at - stem.points.front().at);
    std::vector<std::size_t> chain;
    if (stem.parent) chain.push_back(spotOn(chains, chains.stems[*stem.parent], stem.points.front(), 0.05 * length));
    for (std::size_t i = stem.parent ? 1 : 0; i < stem.points.size(); ++i) {
      chains.spots.push_back({stem.points[i], stem.radius[i]});
      chain.push_back(chains.spots.size() - 1);
    }
    chains.stems.push_back(std::move(chain));
  }
  return chains;
}

double rounded(double px) { return std::round(px * 1000) / 1000; }

ClickedNode clickedAt(std::span<const View> views, NodeId id, const Spot& spot) {
  ClickedNode node{id, {}, std::isfinite(spot.radius) && spot.radius > 0 ? std::optional(spot.radius) : std::nullopt};
  for (const View& view : views) {
    if (!isInFront(view.camera, spot.at)) continue;
    const glm::dvec2 px = project(view.camera, spot.at).px;
    const bool known = view.size_px.x > 0;
    if (known && (px.x < 0 || px.y < 0 || px.x >= view.size_px.x - 0.001 || px.y >= view.size_px.y - 0.001)) continue;
    node.clicks[view.name] = {{rounded(px.x), rounded(px.y)}};
  }
  return node;
}

}  // namespace

DraftClicks clicksOf(std::span<const View> views, std::span<const DraftStem> stems, NodeId firstNode, StemId firstStem) {
  const Chains chains = chainsOf(stems);
  DraftClicks clicks;
  for (std::size_t i = 0; i < chains.spots.size(); ++i) clicks.nodes.push_back(clickedAt(views, NodeId(firstNode.value + static_cast<decltype(firstNode.value)>(i)), chains.spots[i]));
  for (std::size_t s = 0; s < chains.stems.size(); ++s) {
    ClickedStem stem{StemId(firstStem.value + static_cast<decltype(firstStem.value)>(s)), {}};
    for (const std::size_t spot : chains.stems[s]) stem.nodes.push_back(clicks.nodes[spot].id);
    clicks.stems.push_back(std::move(stem));
  }
  return clicks;
}

}  // namespace axil::skeleton3d
