#include "ui/organ_pick.hpp"

#include "ui/clicking.hpp"
#include "ui/grammar_links.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using simeco::Organ;
using simeco::OrganId;
using simeco::Plant;

std::vector<PlantPoint> middleOf(const Organ& organ) { return organ.trail.empty() ? std::vector<PlantPoint>{organ.base, organ.tip()} : organ.trail; }

/// How a body lies to a place of the picture.
struct Hit {
  double beside_px = 0;  ///< from its edge; 0: on it
  double depth = 0;
};

std::optional<Hit> hitOf(const Organ& organ, const skeleton3d::Camera& camera, PhotoPoint at) {
  const std::vector<PlantPoint> middle = middleOf(organ);
  if (organ.length <= 0 || !std::all_of(middle.begin(), middle.end(), [&](PlantPoint p) { return skeleton3d::isInFront(camera, p); })) return std::nullopt;
  double nearest = 1e9;
  for (std::size_t i = 1; i < middle.size(); ++i)
    nearest = std::min(nearest, distanceToSegment(at.px, skeleton3d::project(camera, middle[i - 1]).px, skeleton3d::project(camera, middle[i]).px));
  const PlantPoint heart{(middle.front().at + middle.back().at) / 2.0};
  const glm::dvec3 away = heart.at - skeleton3d::rayThrough(camera, at).origin.at;
  const double scale = glm::distance(skeleton3d::project(camera, heart).px, skeleton3d::project(camera, {heart.at + organ.adaxial.unit() * organ.length * 1e-3}).px) / (organ.length * 1e-3);
  const double across = glm::distance(skeleton3d::project(camera, heart).px, skeleton3d::project(camera, {heart.at + organ.rAxis.unit() * organ.length * 1e-3}).px) / (organ.length * 1e-3);
  return Hit{std::max(0.0, nearest - organ.radius * std::max(scale, across)), glm::length(away)};
}

}  // namespace

std::optional<OrganId> organUnder(const Plant& plant, const skeleton3d::Camera& camera, PhotoPoint at, double reach_px) {
  std::optional<OrganId> found;
  Hit best{reach_px, 1e300};
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    const auto hit = hitOf(plant.organs[i], camera, at);
    if (!hit || hit->beside_px > best.beside_px || (hit->beside_px == best.beside_px && hit->depth >= best.depth)) continue;
    best = *hit;
    found = OrganId(static_cast<int>(i));
  }
  return found;
}

int segmentOfOrgan(const Plant& plant, OrganId organ) {
  for (std::optional<OrganId> at = organ; at; at = plant.at(*at).parent) {
    const int stage = plant.styleOf(plant.at(*at)).stage;  // of stalks and what joins: below the first segment's
    if (plant.at(*at).kind == simeco::OrganKind::Stem && stage >= stageOfSegment(0)) return stage - stageOfSegment(0);
  }
  return -1;
}

ChosenOrgan describedOrgan(const Plant& plant, OrganId id) {
  const Organ& organ = plant.at(id);
  ChosenOrgan chosen{organ.kind, middleOf(organ), organ.length, organ.age, plant.time, {}, {}};
  if (const simeco::RuleInfo* rule = plant.rules.find(organ.production)) {
    chosen.rule = rule->name;
    chosen.where = rule->where;
  }
  return chosen;
}

}  // namespace axil::ui
