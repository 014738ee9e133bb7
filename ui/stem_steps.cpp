#include "ui/stem_steps.hpp"

#include "document/lookup.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;
using document::StemId;
using document::Step;

const skeleton3d::ClickedStem* stemWith(const Project& project, std::optional<StemId> id) {
  const auto place = id ? document::stemWithId(project, *id) : std::nullopt;
  return place ? &project.stems[*place].stem : nullptr;
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double share = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * along);
}

/// What document would refuse is not offered.
std::optional<Step> ifPossible(const Project& project, Step step) {
  return document::apply(project, step) ? std::optional(std::move(step)) : std::nullopt;
}

}  // namespace

std::optional<Step> splitAt(const Project& project, NodeId node) {
  const auto* stem = stemWith(project, stemOf(project, node));
  if (stem == nullptr || stem->nodes.size() < 3 || stem->nodes.front() == node || stem->nodes.back() == node) return std::nullopt;
  return ifPossible(project, {document::SplitStem{stem->id, node, document::nextStemId(project)}});
}

std::optional<Step> reverseAt(const Project& project, NodeId node) {
  const auto* stem = stemWith(project, stemOf(project, node));
  if (stem == nullptr || stem->nodes.size() < 2) return std::nullopt;
  return ifPossible(project, {document::ReverseStem{stem->id}});
}

std::optional<Step> joinOnto(const Project& project, StemId upper, NodeId node) {
  const auto lower = stemOf(project, node);
  if (!lower || *lower == upper) return std::nullopt;
  return ifPossible(project, {document::JoinStems{*lower, upper}});
}

std::optional<Step> attachTo(const Project& project, StemId stem, NodeId node) { return ifPossible(project, {document::AttachStem{stem, node}}); }

std::optional<PlaceOnStem> placeOnStem(const Project& project, const PhotoClick& click) {
  std::optional<PlaceOnStem> nearest;
  for (const auto& entry : project.stems)
    for (std::size_t i = 1; i < entry.stem.nodes.size(); ++i) {
      const PhotoPoint* a = document::clickOf(project, entry.stem.nodes[i - 1], click.view);
      const PhotoPoint* b = document::clickOf(project, entry.stem.nodes[i], click.view);
      if (a == nullptr || b == nullptr) continue;
      const double distance = distanceToSegment(click.at.px, a->px, b->px);
      if (distance > click.reach_px || (nearest && distance >= nearest->distance_px)) continue;
      nearest = PlaceOnStem{entry.stem.id, entry.stem.nodes[i], distance};
    }
  return nearest;
}

Step insertAt(const Project& project, const PlaceOnStem& place, const PhotoClick& click) {
  const NodeId node = document::nextNodeId(project);
  return {document::AddNode{node, click.view, click.at}, document::InsertNode{place.stem, node, place.before}};
}

}  // namespace axil::ui
