#include "render/axes.hpp"

#include "render/parallel.hpp"
#include "render/types.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::render {
namespace {

using simeco::Organ;
using simeco::OrganId;
using simeco::OrganKind;
using simeco::Plant;

/// Two nodes nearer than this share of the plant's extent are one point.
constexpr double negligibleShare = 1e-7;
/// cos 45 degrees: the sharpest bend at which a bracketed child may go on as its parent's axis.
constexpr double straightEnough = 0.70710678118654752;

bool isTube(const Organ& organ) {
  return organ.kind == OrganKind::Stem || organ.kind == OrganKind::Apex || organ.kind == OrganKind::Root;
}

std::size_t indexOf(OrganId id) { return static_cast<std::size_t>(id.value); }
OrganId idOf(std::size_t index) { return OrganId(static_cast<std::int32_t>(index)); }

/// An organ as seen past the negligible bodies below it.
struct Standing {
  std::optional<OrganId> on;  ///< the organ with a body whose tip it stands on
  bool branch = false;
  bool body = false;          ///< a tube of some length
};

std::vector<Standing> standingsOf(const Plant& plant, double negligible) {
  std::vector<Standing> standings(plant.organs.size());
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    const Organ& organ = plant.organs[i];
    Standing& s = standings[i];
    s.body = isTube(organ) && organ.length > negligible;
    s.branch = organ.branch;
    s.on = organ.parent;
    if (!organ.parent) continue;
    const Standing& below = standings[indexOf(*organ.parent)];
    if (below.body) continue;
    s.on = below.on;
    s.branch = s.branch || below.branch;
  }
  return standings;
}

/// How well `child` goes on from `parent`: above 2 without brackets, else the cosine of the bend; no value: it cannot.
std::optional<double> continuationScore(const Standing& standing, const Organ& parent, const Organ& child,
                                        Continuation continuation, double negligible) {
  if ((parent.kind == OrganKind::Root) != (child.kind == OrganKind::Root)) return std::nullopt;
  if (glm::distance(parent.tip().at, child.base.at) > 100 * negligible) return std::nullopt;
  const double straightness = glm::dot(parent.tipDirection().unit(), child.direction.unit());
  if (!standing.branch) return 4 + straightness;
  if (continuation == Continuation::Brackets || straightness < straightEnough) return std::nullopt;
  return straightness;
}

/// For each organ the one that goes on from its tip as the same axis.
std::vector<std::optional<OrganId>> continuationsOf(const Plant& plant, const std::vector<Standing>& standings, Continuation continuation,
                                                    double negligible) {
  std::vector<std::optional<OrganId>> next(plant.organs.size());
  std::vector<double> best(plant.organs.size(), -2);
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    if (!standings[i].body || !standings[i].on) continue;
    const std::size_t below = indexOf(*standings[i].on);
    const auto score = continuationScore(standings[i], plant.organs[below], plant.organs[i], continuation, negligible);
    if (!score || *score <= best[below]) continue;
    best[below] = *score;
    next[below] = idOf(i);
  }
  return next;
}

std::vector<bool> continuedFlags(const std::vector<std::optional<OrganId>>& next) {
  std::vector<bool> continued(next.size(), false);
  for (const auto& id : next)
    if (id) continued[indexOf(*id)] = true;
  return continued;
}

}  // namespace

double extentOf(const Plant& plant) {
  constexpr std::size_t organsAtOnce = 8192;
  std::vector<Bounds> pieces(piecesFor(plant.organs.size(), organsAtOnce));
  inParallel(pieces.size(), [&](std::size_t piece) {
    Bounds bounds;
    for (std::size_t i = piece * organsAtOnce; i < std::min((piece + 1) * organsAtOnce, plant.organs.size()); ++i) {
      const Organ& organ = plant.organs[i];
      bounds.add(organ.base.at);
      bounds.add(organ.tip().at);
      for (const PlantPoint& point : organ.trail) bounds.add(point.at);
    }
    pieces[piece] = bounds;
  });
  Bounds bounds;
  for (const Bounds& piece : pieces) bounds.add(piece);
  return bounds.empty() ? 0 : glm::length(bounds.size());
}

PlantAxes axesOf(const Plant& plant, Continuation continuation) {
  PlantAxes result;
  result.extent = extentOf(plant);
  result.negligible = result.extent * negligibleShare;
  const std::vector<Standing> standings = standingsOf(plant, result.negligible);
  const auto next = continuationsOf(plant, standings, continuation, result.negligible);
  const std::vector<bool> continued = continuedFlags(next);

  result.siteOfTip.resize(plant.organs.size());
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    const auto standsAt = standings[i].on ? result.siteOfTip[indexOf(*standings[i].on)] : std::nullopt;
    if (!standings[i].body) result.siteOfTip[i] = standsAt;
    if (!standings[i].body || continued[i]) continue;
    const AxisId id(static_cast<std::int32_t>(result.axes.size()));
    Axis axis{.organs = {}, .insertion = standsAt};
    for (std::optional<OrganId> at = idOf(i); at; at = next[indexOf(*at)]) {
      axis.organs.push_back(*at);
      result.siteOfTip[indexOf(*at)] = Site{id, static_cast<std::int32_t>(axis.organs.size())};
    }
    result.axes.push_back(std::move(axis));
  }
  return result;
}

std::vector<PlantPoint> nodesOf(const Plant& plant, const Axis& axis) {
  std::vector<PlantPoint> nodes;
  nodes.reserve(axis.organs.size() + 1);
  nodes.push_back(plant.at(axis.organs.front()).base);
  for (const OrganId id : axis.organs) nodes.push_back(plant.at(id).tip());
  return nodes;
}

}  // namespace axil::render
