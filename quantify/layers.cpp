#include "quantify/layers.hpp"

#include "base/text.hpp"
#include "quantify/arms.hpp"
#include "quantify/estimate.hpp"
#include "quantify/mixed.hpp"
#include "quantify/prepared.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

namespace axil::quantify {

namespace {

using Kind = QuantityName::Kind;

constexpr QuantityName kNames[kQuantities] = {
    {Quantity::Length, "length", "length of a segment", Kind::Size},
    {Quantity::Internode, "internode", "length from node to node", Kind::Size},
    {Quantity::Radius, "radius", "radius of a segment", Kind::Size},
    {Quantity::Bend, "bend", "rotr from a segment to what goes on", Kind::Angle},
    {Quantity::Insertion, "insertion", "rotr of what branches off", Kind::Angle},
    {Quantity::LengthRatio, "length_ratio", "a segment's length over the one below", Kind::Ratio},
    {Quantity::LateralRatio, "lateral_ratio", "a branch's first segment over its bearer", Kind::Ratio},
    {Quantity::RadiusRatio, "radius_ratio", "a segment's radius over the one below", Kind::Ratio},
    {Quantity::Branching, "branching", "share of nodes that branch", Kind::Share},
    {Quantity::Forking, "forking", "share of ended axes that fork", Kind::Share},
    {Quantity::Ending, "ending", "share of segments at which an axis ends", Kind::Share},
    {Quantity::AxisSegments, "axis_segments", "segments of an axis", Kind::Count},
    {Quantity::LeafLength, "leaf_length", "length of a leaf", Kind::Size},
    {Quantity::LeafWidth, "leaf_width", "width of a leaf", Kind::Size},
    {Quantity::LeafAngle, "leaf_angle", "rotr of a leaf", Kind::Angle},
    {Quantity::Petiole, "petiole", "length of a leaf's stalk", Kind::Size},
    {Quantity::LeavesPerNode, "leaves_per_node", "leaves of a segment that has any", Kind::Count},
};

constexpr std::size_t indexOf(Quantity q) { return static_cast<std::size_t>(q); }

/// All samples of all quantities, each with the axis it stands on.
class Gatherer {
 public:
  Gatherer(std::span<const MeasuredPlant> plants, LayeredStatistics& out) : plants_(plants), out_(out) {
    for (int order = 0; order < static_cast<int>(out.schedule.orders.size()); ++order) delays_.push_back(branchingDelayOf(plants, out.schedule, order));
  }

  void gather() {
    for (plant_ = 0; plant_ < plants_.size(); ++plant_) {
      const PlantStructure& structure = *plants_[plant_].structure;
      for (std::size_t a = 0; a < structure.axes.size(); ++a) axis(structure.axes[a], out_.schedule.plants[plant_].grows[a]);
      firstAxis_ += structure.axes.size();
    }
    for (auto& [order, counts] : fates_) {
      Fates fates;
      fates.order = order;
      for (const auto& [fate, count] : counts) fates.segments += count;
      for (const auto& [fate, count] : counts) fates.fates.push_back({fate.goesOn, fate.branches, static_cast<double>(count) / static_cast<double>(fates.segments), count});
      out_.fates.push_back(std::move(fates));
    }
  }

  std::vector<std::size_t> axes[kQuantities];
  std::map<int, std::vector<std::pair<std::size_t, int>>> branchCounts;  ///< order -> (plant, branches) of each node

 private:
  void add(Quantity q, const SegmentPlace& place, double value) {
    out_.samples[indexOf(q)].push_back({plant_, place.order, place.rank, value});
    axes[indexOf(q)].push_back(firstAxis_ + static_cast<std::size_t>(place.axis.value));
  }

  void axis(const Axis& own, bool grows) {
    const Measurements& m = *plants_[plant_].measurements;
    const PlantStructure& structure = *plants_[plant_].structure;
    const SegmentPlace& base = structure.at(own.base());
    add(Quantity::AxisSegments, base, static_cast<double>(own.segments.size()));
    if (!grows) add(Quantity::Forking, structure.at(own.tip()), own.forks ? 1 : 0);
    if (own.bearer) add(Quantity::LateralRatio, structure.at(*own.bearer), std::log(m.at(own.base()).length / m.at(*own.bearer).length));
    if (own.bearer) add(Quantity::Insertion, structure.at(*own.bearer), m.at(own.base()).rotr.radians());
    const std::vector<double> internodes = internodesOf(m, structure, own);
    for (std::size_t i = 0; i < internodes.size(); ++i) {
      SegmentPlace at = base;
      at.rank = static_cast<int>(i);
      add(Quantity::Internode, at, internodes[i]);
    }
    for (std::size_t i = 0; i < own.segments.size(); ++i) {
      segment(m, structure, own.segments[i], grows);
      if (i > 0) pair(m, structure, own.segments[i - 1], own.segments[i]);
    }
  }

  void pair(const Measurements& m, const PlantStructure& structure, SegmentId low, SegmentId high) {
    const SegmentPlace& place = structure.at(low);
    add(Quantity::LengthRatio, place, std::log(m.at(high).length / m.at(low).length));
    add(Quantity::Bend, place, m.at(high).rotr.radians());
    if (m.at(high).radius && m.at(low).radius) add(Quantity::RadiusRatio, place, std::log(*m.at(high).radius / *m.at(low).radius));
  }

  void segment(const Measurements& m, const PlantStructure& structure, SegmentId id, bool grows) {
    const SegmentPlace& place = structure.at(id);
    const Segment& s = m.at(id);
    add(Quantity::Length, place, s.length);
    if (s.radius) add(Quantity::Radius, place, *s.radius);
    if (!s.leaves.empty()) add(Quantity::LeavesPerNode, place, static_cast<double>(s.leaves.size()));
    for (const LeafMeasure& leaf : s.leaves) {
      add(Quantity::LeafLength, place, leaf.length);
      if (leaf.width > 0) add(Quantity::LeafWidth, place, leaf.width);
      if (leaf.petiole > 0) add(Quantity::Petiole, place, leaf.petiole);
      add(Quantity::LeafAngle, place, leaf.rotr.radians());
    }
    if (place.goesOn && place.fromTip > delays_[static_cast<std::size_t>(place.order)]) {
      add(Quantity::Branching, place, place.branches > 0 ? 1 : 0);
      branchCounts[place.order].emplace_back(plant_, place.branches);
    }
    if (!place.goesOn && grows) return;
    add(Quantity::Ending, place, !place.goesOn && place.branches == 0 ? 1 : 0);
    if (place.goesOn && place.fromTip <= delays_[static_cast<std::size_t>(place.order)]) return;
    ++fates_[place.order][{place.goesOn, place.branches, 0, 0}];
  }

  std::span<const MeasuredPlant> plants_;
  LayeredStatistics& out_;
  std::vector<int> delays_;
  std::size_t plant_ = 0;
  std::size_t firstAxis_ = 0;
  std::map<int, std::map<Fate, std::size_t>> fates_;
};

/// Sizes and ratios have a logarithm, shares are binomial.
SampleKind sampleKindOf(Kind kind) { return kind == Kind::Share ? SampleKind::Share : SampleKind::Plain; }

/// Logarithms back to ratios.
void exponentiate(Estimate& e) {
  e.between *= std::exp(e.own);
  e.deviation *= std::exp(e.own);
  e.error *= std::exp(e.own);
  for (double* v : {&e.value, &e.own, &e.low, &e.high}) *v = std::exp(*v);
}

void poolRanks(OrderLayer& layer, Kind kind) {
  std::vector<Estimate*> sisters;
  std::vector<double> expected;
  const bool follows = layer.trend.clear() && kind != Kind::Share;
  for (RankLayer& rank : layer.ranks) {
    sisters.push_back(&rank.estimate);
    expected.push_back(follows ? layer.trend.at(rank.rank) : layer.estimate.value);
  }
  pool(sisters, expected, sampleKindOf(kind));
}

QuantityLayers layersOf(const std::vector<Sample>& samples, const std::vector<std::size_t>& axes, Kind kind) {
  QuantityLayers layers;
  layers.all = estimateOf(samples, sampleKindOf(kind));
  std::map<int, std::vector<std::size_t>> orders;
  for (std::size_t i = 0; i < samples.size(); ++i) orders[samples[i].order].push_back(i);
  for (const auto& [order, places] : orders) {
    std::vector<Sample> own;
    std::vector<std::size_t> ownAxes;
    std::map<int, std::vector<Sample>> ranks;
    for (const std::size_t i : places) {
      own.push_back(samples[i]);
      ownAxes.push_back(axes[i]);
      ranks[samples[i].rank].push_back(samples[i]);
    }
    OrderLayer layer;
    layer.order = order;
    layer.estimate = estimateOf(own, sampleKindOf(kind));
    layer.trend = trendOf(own, ownAxes, kind == Kind::Size);
    for (const auto& [rank, there] : ranks) layer.ranks.push_back({rank, estimateOf(there, sampleKindOf(kind))});
    layers.orders.push_back(std::move(layer));
  }
  std::vector<Estimate*> sisters;
  for (OrderLayer& layer : layers.orders) sisters.push_back(&layer.estimate);
  pool(sisters, std::vector<double>(sisters.size(), layers.all.value), sampleKindOf(kind));
  for (OrderLayer& layer : layers.orders) poolRanks(layer, kind);
  if (kind == Kind::Ratio) {
    exponentiate(layers.all);
    for (OrderLayer& layer : layers.orders) {
      exponentiate(layer.estimate);
      for (RankLayer& rank : layer.ranks) exponentiate(rank.estimate);
    }
  }
  return layers;
}

std::vector<BranchShares> branchSharesOf(const std::map<int, std::vector<std::pair<std::size_t, int>>>& counts) {
  std::vector<BranchShares> all;
  for (const auto& [order, nodes] : counts) {
    BranchShares shares;
    shares.order = order;
    shares.nodes = nodes.size();
    int most = 0;
    for (const auto& [plant, branches] : nodes) most = std::max(most, branches);
    double sum = 0;
    for (int k = 0; k <= most; ++k) {
      std::vector<Sample> samples;
      for (const auto& [plant, branches] : nodes) samples.push_back({plant, order, 0, branches == k ? 1.0 : 0.0});
      shares.shares.push_back(std::clamp(estimateOf(samples, SampleKind::Share).value, 0.0, 1.0));
      sum += shares.shares.back();
    }
    if (sum > 0)
      for (double& s : shares.shares) s /= sum;
    all.push_back(std::move(shares));
  }
  return all;
}

std::optional<double> perMetre(const std::string& unit) {
  static const std::map<std::string, double> kUnits{{"m", 1}, {"dm", 10}, {"cm", 100}, {"mm", 1000}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

Measurements scaled(Measurements m, double factor, const std::string& unit) {
  m.unit = unit;
  m.origin.at *= factor;
  const auto scaleLeaf = [factor](LeafMeasure& leaf) {
    leaf.length *= factor;
    leaf.width *= factor;
    leaf.petiole *= factor;
  };
  for (Segment& s : m.segments) {
    s.length *= factor;
    if (s.radius) *s.radius *= factor;
    for (LeafMeasure& leaf : s.leaves) scaleLeaf(leaf);
  }
  for (LeafMeasure& leaf : m.rootLeaves) scaleLeaf(leaf);
  return m;
}

void addAngles(LayeredStatistics& out, std::span<const MeasuredPlant> plants) {
  for (int order = 0; order < static_cast<int>(out.schedule.orders.size()); ++order) {
    out.patterns.push_back(branchingPatternOf(plants, out.schedule, order));
    out.leaves.push_back(phyllotaxisOf(plants, OrgansAround::Leaves, order));
    out.branchesAround.push_back(phyllotaxisOf(plants, OrgansAround::Branches, order));
  }
  out.leaves.push_back(phyllotaxisOf(plants, OrgansAround::Leaves));
  out.branchesAround.push_back(phyllotaxisOf(plants, OrgansAround::Branches));
}

ArmLayer armLayer(std::span<const MeasuredPlant> plants, const std::vector<ArmMember>& members) {
  std::vector<Sample> leans, ratios;
  for (const ArmMember& member : members) {
    const Measurements& m = *plants[member.plant].measurements;
    const Segment& base = m.at(member.base);
    leans.push_back({member.plant, 0, 0, base.rotr.radians()});
    ratios.push_back({member.plant, 0, 0, std::log(base.length / m.at(*base.parent).length)});
  }
  ArmLayer layer{estimateOf(leans, SampleKind::Plain), estimateOf(ratios, SampleKind::Plain)};
  exponentiate(layer.lateralRatio);
  return layer;
}

void addArms(LayeredStatistics& out, std::span<const MeasuredPlant> plants) {
  const int top = static_cast<int>(out.schedule.orders.size()) - 1;
  const bool together = mostlySympodial(out);
  for (int order = 0; order <= (together ? 0 : top); ++order)
    for (const Arms& arms : armsOf(plants, order, together ? top : order)) {
      ArmLayers layers;
      if (!together) layers.order = order;
      for (const auto& members : arms.members) layers.arms.push_back(armLayer(plants, members));
      out.arms.push_back(std::move(layers));
    }
}

}  // namespace

bool mostlySympodial(const LayeredStatistics& s) {
  return std::count(s.branching.begin(), s.branching.end(), Branching::Sympodial) * 2 > static_cast<std::ptrdiff_t>(s.plants);
}

std::span<const QuantityName> quantityNames() { return kNames; }

const OrderLayer* QuantityLayers::order(int number) const {
  for (const OrderLayer& layer : orders)
    if (layer.order == number) return &layer;
  return nullptr;
}

const Estimate& QuantityLayers::nearest(int number) const {
  const Estimate* best = nullptr;
  for (const OrderLayer& layer : orders)
    if (layer.order <= number) best = &layer.estimate;
  return best != nullptr ? *best : all;
}

Result<std::vector<Measurements>> inOneUnit(std::span<const Measurements> plants, std::vector<std::string>& warnings) {
  std::vector<Measurements> same;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const std::string& unit = plants.front().unit;
    if (plants[p].unit == unit) {
      same.push_back(plants[p]);
      continue;
    }
    const auto to = perMetre(unit);
    const auto from = perMetre(plants[p].unit);
    if (!to || !from)
      return fail(ErrorCode::BadInput, "plant " + std::to_string(p + 1) + " is measured in '" + plants[p].unit + "' and plant 1 in '" + unit +
                                           "', which cannot be converted; give all plants in one unit, or in m, dm, cm or mm");
    warnings.push_back("plant " + std::to_string(p + 1) + " is measured in " + plants[p].unit + "; its lengths were converted to " + unit);
    same.push_back(scaled(plants[p], *to / *from, unit));
  }
  return same;
}

Result<PreparedPlants> prepared(std::span<const Measurements> given) {
  if (given.empty() || std::any_of(given.begin(), given.end(), [](const Measurements& m) { return m.segments.empty(); }))
    return fail(ErrorCode::NoAnswer, "there is no plant with a segment to take statistics of");
  PreparedPlants result;
  auto plants = inOneUnit(given, result.warnings);
  if (!plants) return plants.failure();
  result.plants = std::move(*plants);
  result.structures = plantStructures(result.plants);
  for (std::size_t p = 0; p < result.plants.size(); ++p) result.measured.push_back({&result.plants[p], &result.structures[p]});
  return result;
}

LayeredStatistics statisticsOf(const PreparedPlants& ready) {
  const std::span<const MeasuredPlant> measured = ready.measured;
  LayeredStatistics out;
  out.warnings = ready.warnings;
  out.unit = ready.plants.front().unit;
  out.plants = ready.plants.size();
  out.stemEnds = stemEndsOf(ready.plants);
  std::vector<double> straightness;
  for (const PlantStructure& structure : ready.structures) {
    out.branching.push_back(structure.branching);
    if (structure.branching != Branching::None) straightness.push_back(structure.straightness);
  }
  if (!straightness.empty()) out.straightness = medianOf(straightness);
  out.schedule = scheduleOf(measured);
  Gatherer gatherer(measured, out);
  gatherer.gather();
  for (const QuantityName& name : kNames) out.layers.push_back(layersOf(out.samples[indexOf(name.quantity)], gatherer.axes[indexOf(name.quantity)], name.kind));
  out.branches = branchSharesOf(gatherer.branchCounts);
  addAngles(out, measured);
  addArms(out, measured);
  for (std::string& warning : disagreements(out, measured)) out.warnings.push_back(std::move(warning));
  return out;
}

Result<LayeredStatistics> layeredStatistics(std::span<const Measurements> given) {
  const auto ready = prepared(given);
  if (!ready) return ready.failure();
  return statisticsOf(*ready);
}

}  // namespace axil::quantify
