#include "quantify/leaves.hpp"

#include "base/text.hpp"
#include "base/turning.hpp"
#include "keywords/keywords.hpp"
#include "quantify/measure.hpp"
#include "quantify/skeleton_index.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace axil::quantify {

namespace {

using keywords::ArrangementPreset;
using skeleton3d::Node;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::Stem;
using skeleton3d::StemId;

constexpr int kMostNodes = 10'000;
constexpr double kSnap = 0.02;          // of the stem's length
constexpr double kDefaultLength = 0.08;  // of the skeleton's extent
const Angle kUpright = 10_deg;           // a stem this near to vertical has no level side

/// An arrangement with nothing left open.
struct LeafPlan {
  StemId stem;
  ArrangementPreset preset;
  int count = 0;                ///< leaf nodes; 0 where `at` lists them
  std::vector<NodeId> at;
  Angle angle = 55_deg;
  Angle roll;
  std::optional<Angle> azimuth;
  double length = 0;
  double width = 0;
  double petiole = 0;
  std::string shape;
};

std::string placeName(const LeafArrangement& wanted) { return "the leaves of stem " + std::to_string(wanted.stem.value); }

Failure wrong(const LeafArrangement& wanted, const std::string& what) { return fail(ErrorCode::BadInput, placeName(wanted) + ": " + what); }

Result<ArrangementPreset> presetFor(const LeafArrangement& wanted, const keywords::Presets& presets) {
  if (wanted.arrangement.empty()) return presets.arrangement ? *presets.arrangement : ArrangementPreset{"spiral", 1, Angle::fromDegrees(137.5), false};
  if (const auto named = keywords::arrangementNamed(wanted.arrangement)) return *named;
  std::string known;
  for (const auto& name : keywords::arrangementNames()) known += (known.empty() ? "" : ", ") + std::string(name);
  return wrong(wanted, "no arrangement is called \"" + wanted.arrangement + "\"; known are " + known);
}

/// How many of `unit` are a metre; none for a unit that says nothing about metres.
std::optional<double> perMetre(const std::string& unit) {
  static const std::map<std::string, double> kUnits{{"m", 1}, {"dm", 10}, {"cm", 100}, {"mm", 1000}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> inUnit(std::optional<double> metres, const std::string& unit) {
  const auto factor = perMetre(unit);
  return metres && factor ? std::optional(*metres * *factor) : std::nullopt;
}

/// The width that belongs to `length`: as wide for its length as the description says, else left to the shape.
double presetWidth(const LeafArrangement& wanted, const keywords::Presets& presets, double length, const std::string& unit) {
  if (!presets.leafWidth_m) return 0;
  if (wanted.length && presets.leafLength_m && *presets.leafLength_m > 0) return length * *presets.leafWidth_m / *presets.leafLength_m;
  return inUnit(presets.leafWidth_m, unit).value_or(0);
}

/// What the description says about the whole leaf holds where the user named no shape, or the very shape that it names.
std::string shapeFor(const LeafArrangement& wanted, const keywords::Presets& presets) {
  if (!wanted.shape.empty() && wanted.shape != presets.leafShape) return wanted.shape;
  return presets.leafModel.empty() ? presets.leafShape : presets.leafModel;
}

Result<void> checkNumbers(const LeafArrangement& wanted) {
  const auto angleOk = [](const std::optional<Angle>& a) { return !a || std::isfinite(a->radians()); };
  const auto sizeOk = [](const std::optional<double>& v) { return !v || (std::isfinite(*v) && *v >= 0); };
  if (!angleOk(wanted.angle) || !angleOk(wanted.roll) || !angleOk(wanted.azimuth)) return wrong(wanted, "an angle is not a number");
  if (wanted.angle && (wanted.angle->radians() < 0 || wanted.angle->radians() > std::numbers::pi))
    return wrong(wanted, "their angle to the stem is " + shortest(wanted.angle->degrees()) + " degrees; it lies between 0 and 180");
  if (!sizeOk(wanted.width) || !sizeOk(wanted.petiole)) return wrong(wanted, "width and stalk length must be numbers from 0");
  if (wanted.length && !(std::isfinite(*wanted.length) && *wanted.length > 0)) return wrong(wanted, "their length is " + shortest(*wanted.length) + "; it must be above 0");
  if (wanted.nodes && (*wanted.nodes < 1 || *wanted.nodes > kMostNodes))
    return wrong(wanted, std::to_string(*wanted.nodes) + " leaf nodes are not possible; give 1 to " + std::to_string(kMostNodes));
  if (!wanted.nodes && wanted.at.empty()) return wrong(wanted, "say how many leaf nodes there are, or which nodes carry leaves");
  return {};
}

Result<void> checkPlaces(const LeafArrangement& wanted, const ArrangementPreset& preset, const SkeletonIndex& index) {
  const Stem* stem = index.stem(wanted.stem);
  if (stem == nullptr) return fail(ErrorCode::BadInput, "leaves are given for stem " + std::to_string(wanted.stem.value) + ", which does not exist");
  for (const NodeId id : wanted.at)
    if (std::find(stem->nodes.begin(), stem->nodes.end(), id) == stem->nodes.end())
      return wrong(wanted, "node " + std::to_string(id.value) + " is not one of the stem's nodes");
  const bool cluster = preset.clustered && wanted.at.size() == 1;
  if (wanted.nodes && !wanted.at.empty() && !cluster && static_cast<std::size_t>(*wanted.nodes) != wanted.at.size())
    return wrong(wanted, std::to_string(*wanted.nodes) + " leaf nodes are wanted but " + std::to_string(wanted.at.size()) + " are listed; give one of the two");
  return {};
}

Result<LeafPlan> planFor(const LeafArrangement& wanted, const keywords::Presets& presets, const SkeletonIndex& index, const std::string& unit) {
  const auto preset = presetFor(wanted, presets);
  if (!preset) return preset.failure();
  if (const auto ok = checkNumbers(wanted); !ok) return ok.failure();
  if (const auto ok = checkPlaces(wanted, *preset, index); !ok) return ok.failure();
  LeafPlan plan;
  plan.stem = wanted.stem;
  plan.preset = *preset;
  plan.count = wanted.nodes.value_or(0);
  plan.at = wanted.at;
  plan.angle = wanted.angle.value_or(plan.angle);
  plan.roll = wanted.roll.value_or(plan.roll);
  plan.azimuth = wanted.azimuth;
  plan.length = wanted.length ? *wanted.length : inUnit(presets.leafLength_m, unit).value_or(kDefaultLength * index.extent());
  plan.width = wanted.width ? *wanted.width : presetWidth(wanted, presets, plan.length, unit);
  plan.petiole = wanted.petiole.value_or(0);
  plan.shape = shapeFor(wanted, presets);
  return plan;
}

/// A skeleton that nodes are inserted into. Positions are looked up by id; ids of new nodes go up from the largest.
class Chains {
 public:
  explicit Chains(Skeleton& skeleton) : skeleton_(skeleton) {
    for (std::size_t n = 0; n < skeleton.nodes.size(); ++n) places_[skeleton.nodes[n].id] = n;
    for (const Node& node : skeleton.nodes) next_ = std::max(next_, node.id.value + 1);
  }

  [[nodiscard]] Stem& stem(StemId id) {
    return *std::find_if(skeleton_.stems.begin(), skeleton_.stems.end(), [id](const Stem& s) { return s.id == id; });
  }
  [[nodiscard]] const Node& node(NodeId id) const { return skeleton_.nodes[places_.at(id)]; }

  /// How far along the stem each of its nodes stands.
  [[nodiscard]] std::vector<double> arcOf(const Stem& stem) const {
    std::vector<double> arc{0};
    for (std::size_t i = 1; i < stem.nodes.size(); ++i)
      arc.push_back(arc.back() + glm::distance(node(stem.nodes[i - 1]).position.at, node(stem.nodes[i]).position.at));
    return arc;
  }

  /// A new node at `share` of the way from the stem's node `before` to the next one.
  NodeId insert(Stem& stem, std::size_t before, double share) {
    const Node& low = node(stem.nodes[before]);
    const Node& high = node(stem.nodes[before + 1]);
    Node between;
    between.id = NodeId{next_++};
    between.position.at = low.position.at * (1 - share) + high.position.at * share;
    between.sigma = low.sigma * (1 - share) + high.sigma * share;
    if (low.radius && high.radius) between.radius = *low.radius * (1 - share) + *high.radius * share;
    else between.radius = high.radius ? high.radius : low.radius;
    places_[between.id] = skeleton_.nodes.size();
    skeleton_.nodes.push_back(between);
    stem.nodes.insert(stem.nodes.begin() + static_cast<std::ptrdiff_t>(before) + 1, between.id);
    return between.id;
  }

 private:
  Skeleton& skeleton_;
  std::map<NodeId, std::size_t> places_;
  std::int32_t next_ = 0;
};

/// The stem's node that stands `along` it: one that is near and not yet taken, else a new one.
NodeId nodeAt(Chains& chains, Stem& stem, double along, double snap, const std::vector<NodeId>& taken) {
  const std::vector<double> arc = chains.arcOf(stem);
  std::optional<std::size_t> near;
  for (std::size_t i = 1; i < arc.size(); ++i) {
    const bool free = std::find(taken.begin(), taken.end(), stem.nodes[i]) == taken.end();
    if (free && std::abs(arc[i] - along) <= snap && (!near || std::abs(arc[i] - along) < std::abs(arc[*near] - along))) near = i;
  }
  if (near) return stem.nodes[*near];
  const auto above = std::upper_bound(arc.begin(), arc.end(), along);
  const auto before = static_cast<std::size_t>(above - arc.begin()) - 1;
  return chains.insert(stem, before, (along - arc[before]) / (arc[before + 1] - arc[before]));
}

std::vector<NodeId> evenNodes(Chains& chains, Stem& stem, int count) {
  const double length = chains.arcOf(stem).back();
  const double snap = std::min(kSnap * length, 0.45 * length / count);
  std::vector<NodeId> nodes;
  // From the tip down: the last one is the tip itself, whatever rounding says.
  nodes.push_back(stem.nodes.back());
  for (int k = count - 1; k >= 1; --k) nodes.push_back(nodeAt(chains, stem, length * k / count, snap, nodes));
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

/// Which node each leaf node stands at, from the base up.
std::vector<NodeId> placesOf(const LeafPlan& plan, Chains& chains) {
  Stem& stem = chains.stem(plan.stem);
  if (plan.preset.clustered && plan.at.size() <= 1) {
    const NodeId place = !plan.at.empty() ? plan.at.front() : plan.preset.name == "rosette" ? stem.nodes.front() : stem.nodes.back();
    return std::vector<NodeId>(static_cast<std::size_t>(std::max(plan.count, 1)), place);
  }
  if (plan.at.empty()) return evenNodes(chains, stem, plan.count);
  std::vector<NodeId> nodes = plan.at;
  const auto rank = [&](NodeId id) { return std::find(stem.nodes.begin(), stem.nodes.end(), id) - stem.nodes.begin(); };
  std::stable_sort(nodes.begin(), nodes.end(), [&](NodeId a, NodeId b) { return rank(a) < rank(b); });
  return nodes;
}

/// The frame a leaf is set against at each node of a stem: the direction in which the stem arrives there (at its first node:
/// in which it leaves), and its r-axis.
struct NodeFrame {
  PlantDirection direction;
  PlantDirection rAxis;
};

std::vector<NodeFrame> framesAlong(const Stem& stem, const Measurements& measured, const std::map<NodeId, std::size_t>& arriving) {
  std::vector<NodeFrame> frames;
  for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
    const Segment& segment = measured.segments[arriving.at(stem.nodes[i])];
    if (i == 1) frames.push_back({segment.direction, segment.rAxis});
    frames.push_back({segment.direction, segment.rAxis});
  }
  return frames;
}

/// `side` carried from one direction of a stem to the next without twist.
PlantDirection carried(PlantDirection side, PlantDirection from, PlantDirection to) {
  const PlantDirection bent = areParallel(from, to) ? side : turned(side, PlantDirection::along(glm::cross(from.unit(), to.unit())), angleBetween(from, to));
  return perpendicularTo(to, bent);
}

PlantDirection firstSide(const LeafPlan& plan, const NodeFrame& frame) {
  const PlantDirection start = PlantDirection::along(glm::cross(frame.rAxis.unit(), frame.direction.unit()));
  const Angle lean = angleBetween(frame.direction, PlantDirection::up());
  const bool upright = std::min(lean.radians(), std::numbers::pi - lean.radians()) < kUpright.radians();
  if (plan.azimuth || upright) return turned(start, frame.direction, plan.azimuth.value_or(Angle{}));
  return PlantDirection::along(glm::cross(PlantDirection::up().unit(), frame.direction.unit()));
}

skeleton3d::Leaf leafAt(const LeafPlan& plan, PlantPoint place, PlantDirection stem, PlantDirection side) {
  skeleton3d::Leaf leaf;
  leaf.stem = plan.stem;
  leaf.direction = turned(stem, PlantDirection::along(glm::cross(stem.unit(), side.unit())), plan.angle);
  const PlantDirection upper =
      areParallel(stem, leaf.direction) ? PlantDirection::along(-side.unit()) : perpendicularTo(leaf.direction, stem);
  leaf.normal = perpendicularTo(leaf.direction, turned(upper, leaf.direction, plan.roll));
  leaf.position.at = place.at + leaf.direction.unit() * plan.petiole;
  leaf.length = plan.length;
  leaf.width = plan.width;
  leaf.shape = plan.shape;
  return leaf;
}

void addLeaves(Skeleton& skeleton, const LeafPlan& plan, const std::vector<NodeId>& places, const Measurements& measured,
               const std::map<NodeId, std::size_t>& arriving) {
  Chains chains(skeleton);
  const Stem& stem = chains.stem(plan.stem);
  const std::vector<NodeFrame> frames = framesAlong(stem, measured, arriving);
  std::size_t at = static_cast<std::size_t>(std::find(stem.nodes.begin(), stem.nodes.end(), places.front()) - stem.nodes.begin());
  PlantDirection side = firstSide(plan, frames[at]);
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (; stem.nodes[at] != places[k]; ++at) side = carried(side, frames[at].direction, frames[at + 1].direction);
    for (int i = 0; i < plan.preset.leavesPerNode; ++i) {
      const Angle around = keywords::turnOfNode(plan.preset, k) + Angle::fromRadians(2 * std::numbers::pi * i / plan.preset.leavesPerNode);
      skeleton.leaves.push_back(leafAt(plan, chains.node(places[k]).position, frames[at].direction, turned(side, frames[at].direction, around)));
    }
  }
}

}  // namespace

Result<Skeleton> withLeaves(const Skeleton& skeleton, std::span<const LeafArrangement> arrangements, const keywords::Presets& presets) {
  const Result<SkeletonIndex> index = SkeletonIndex::of(skeleton);
  if (!index) return index.failure();

  std::vector<LeafPlan> plans;
  for (const LeafArrangement& wanted : arrangements) {
    auto plan = planFor(wanted, presets, *index, skeleton.unit);
    if (!plan) return plan.failure();
    plans.push_back(std::move(*plan));
  }

  Skeleton leafy = skeleton;
  Chains chains(leafy);
  std::vector<std::vector<NodeId>> places;
  for (const LeafPlan& plan : plans) places.push_back(placesOf(plan, chains));

  const Result<Measurements> measured = measure(leafy);
  if (!measured) return measured.failure();
  std::map<NodeId, std::size_t> arriving;
  for (std::size_t s = 0; s < measured->segments.size(); ++s) arriving[measured->segments[s].to] = s;
  for (std::size_t p = 0; p < plans.size(); ++p) addLeaves(leafy, plans[p], places[p], *measured, arriving);
  return leafy;
}

}  // namespace axil::quantify
