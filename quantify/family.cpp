#include "quantify/family_maker.hpp"

#include "quantify/arms.hpp"
#include "quantify/circular.hpp"
#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr std::size_t kEnoughAxes = 12;   // for an order to have rules of its own
constexpr std::size_t kTested = 8;        // fewer samples contradict nothing

}  // namespace

Family FamilyMaker::made() {
  family_.plants = plants_.size();
  setAges();
  setGroups();
  setArmPlaces();
  for (std::size_t g = 0; g < family_.orders.size(); ++g) setExtent(g);
  for (std::size_t g = 0; g < family_.orders.size(); ++g) {
    FamilyOrder& o = family_.orders[g];
    o.outlook = outlook_.of(o.order);
    setFates(g);
    setLengths(g);
    setAngles(g);
    setRadius(g);
    setLeaves(g);
  }
  // After the levels of all orders are known: a branch starts from its bearer's.
  for (std::size_t g = 0; g < family_.orders.size(); ++g) setStart(g);
  std::vector<double> stages;
  double collar = 0;
  for (std::size_t p = 0; p < plants_.size(); ++p) {
    stages.push_back(cases_[p].front().potential);
    for (const Axis& axis : plants_[p].structure->axes) collar += !axis.bearer && axis.order > 0 ? 1 : 0;
  }
  family_.stages = countsOf(stages);
  family_.collarAxes = static_cast<int>(std::lround(collar / static_cast<double>(plants_.size())));
  family_.statistics = std::move(outlook_.statistics);
  return std::move(family_);
}

std::size_t FamilyMaker::groupOf(int order) const {
  std::size_t g = 0;
  while (g + 1 < family_.orders.size() && family_.orders[g + 1].order <= order) ++g;
  return g;
}

void FamilyMaker::setAges() {
  double most = 0, oldest = 0;
  for (const PlantSchedule& plant : schedule().plants) most = std::max(most, plant.now + 1);
  for (const PlantSchedule& plant : schedule().plants) oldest += plant.now + 1.5 > most ? 1 : 0;
  for (const PlantSchedule& plant : schedule().plants) ages_.push_back(2 * oldest >= static_cast<double>(plants_.size()) ? most : plant.now + 1);
}

void FamilyMaker::setGroups() {
  std::map<int, std::size_t> axes;
  std::ptrdiff_t sympodial = 0;
  for (const MeasuredPlant& plant : plants_) {
    for (const Axis& axis : plant.structure->axes) ++axes[axis.order];
    sympodial += plant.structure->branching == Branching::Sympodial ? 1 : plant.structure->branching == Branching::Monopodial ? -1 : 0;
  }
  family_.deepest = static_cast<int>(axes.size());
  for (const auto& [order, count] : axes) {
    // Axes that fork are modules of one kind, whatever their order.
    const bool alike = sympodial > 0 && order > (modulesAlike() ? 0 : 1);
    if (alike || (order > 1 && (count < kEnoughAxes || axes[order - 1] < kEnoughAxes))) {
      family_.orders.back().lastOrder = order;
      continue;
    }
    FamilyOrder o;
    o.order = o.lastOrder = order;
    family_.orders.push_back(std::move(o));
  }
  cases_.resize(plants_.size());
  for (std::size_t p = 0; p < plants_.size(); ++p) {
    for (const Axis& axis : plants_[p].structure->axes) cases_[p].push_back({p, &axis, 0, 0, -1});
  }
}

bool FamilyMaker::modulesAlike() const {
  std::vector<double> first, others;
  for (const MeasuredPlant& plant : plants_)
    for (const Axis& axis : plant.structure->axes) (axis.order == 0 ? first : others).push_back(static_cast<double>(axis.segments.size()));
  const Moments a = momentsOf(first), b = momentsOf(others);
  return std::abs(a.mean - b.mean) <= 0.05 + 2 * std::max(a.deviation, b.deviation) / std::sqrt(static_cast<double>(first.size()));
}

void FamilyMaker::setExtent(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  // What comes together with its bearer stands on an axis' last segment too, as what an axis ends in.
  bool steady = !schedule().branchesAtOnce && (g == 0 || family_.orders[g - 1].extent == Extent::Stages);
  for (int order = o.order; order <= o.lastOrder; ++order) steady = steady && schedule().of(order).steady;
  std::size_t full = 0, all = 0;
  if (g == 0) {
    eachCase(g, [&](AxisCase& c) {
      if (c.axis->order > 0) return;
      ++all;
      full += c.count() + 0.5 > ages_[c.plant] ? 1 : 0;
    });
    // A first axis that ends in a fork has not ended by chance.
    steady = steady && (2 * full >= all || family_.orders.size() == 1 || forksOften());
  }
  o.extent = steady ? Extent::Stages : Extent::Own;
  o.delay = steady ? schedule().of(o.order).delay : 0;
  eachCase(g, [&](AxisCase& c) { setPotential(o, c); });
  if (steady) setMost(g);
  else setOwn(g);
}

bool FamilyMaker::forksOften() const {
  std::size_t forks = 0;
  for (const MeasuredPlant& plant : plants_) forks += plant.structure->axes.front().forks ? 1 : 0;
  return 2 * forks >= plants_.size();
}

void FamilyMaker::setPotential(const FamilyOrder& o, AxisCase& c) {
  c.bearerLeft = ages_[c.plant];
  if (c.axis->bearer) {
    const AxisCase& bearer = cases_[c.plant][static_cast<std::size_t>(c.axis->parent->value)];
    const SegmentPlace& place = plants_[c.plant].structure->at(*c.axis->bearer);
    c.bearerRank = place.rank;
    c.bearerLeft = bearer.potential - place.rank - 1;
  }
  c.potential = o.extent == Extent::Stages ? std::max(c.count(), c.bearerLeft - (c.axis->bearer ? o.delay : 0)) : c.count();
}

void FamilyMaker::setMost(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  double longest = 0, nodes = 0, ended = 0;
  eachCase(g, [&](const AxisCase& c) { longest = std::max(longest, c.count()); });
  double atLongest = 0, further = 0;
  eachCase(g, [&](const AxisCase& c) {
    further += c.count() >= longest && c.potential > longest ? 1 : 0;
    if (c.axis->forks) return;
    atLongest += c.count() >= longest && c.potential > longest ? 1 : 0;
    nodes += std::min(c.count(), longest - 1);
    ended += c.count() < longest && c.potential > c.count() ? 1 : 0;
  });
  if (further < 2 || atLongest < further || longest < 2) return;
  const double chance = nodes > 0 ? std::max(ended, 0.5) / nodes : 0.5;
  if (std::pow(chance, atLongest) > 0.01) return;
  o.most = static_cast<int>(longest);
  eachCase(g, [&](AxisCase& c) { c.potential = std::min(c.potential, longest); });
}

void FamilyMaker::setOwn(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<double> y, left, rank;
  eachCase(g, [&](const AxisCase& c) {
    y.push_back(c.count());
    left.push_back(c.bearerLeft);
    rank.push_back(c.bearerRank);
  });
  const double n = static_cast<double>(y.size());
  const auto criterion = [&](const std::vector<double>& misses, double numbers) {
    double sum = 0;
    for (const double m : misses) sum += m * m;
    return n * std::log(sum / n + 0.02) + numbers * std::log(n);
  };
  const double mean = momentsOf(y).mean;
  std::vector<double> best;
  for (const double v : y) best.push_back(v - mean);
  double least = criterion(best, 1);
  for (const Along along : {Along::Left, Along::Rank}) {
    if (g == 0 || y.size() < kTested) break;
    const std::vector<double>& x = along == Along::Left ? left : rank;
    const double middle = momentsOf(x).mean;
    double xy = 0, xx = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xy += (x[i] - middle) * (y[i] - mean);
      xx += (x[i] - middle) * (x[i] - middle);
    }
    if (xx == 0) continue;
    std::vector<double> misses;
    for (std::size_t i = 0; i < x.size(); ++i) misses.push_back(y[i] - mean - xy / xx * (x[i] - middle));
    if (criterion(misses, 2) + 6 >= least) continue;
    least = criterion(misses, 2);
    o.along = along;
    o.slope = xy / xx;
    for (double& m : misses) m += mean - o.slope * middle;
    best = std::move(misses);
  }
  o.own = o.along == Along::Nothing ? countsOf(y) : distributionOf(best);
}

void FamilyMaker::setFates(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  const int delay = g + 1 < family_.orders.size() ? family_.orders[g + 1].delay : o.delay;
  std::map<int, double> ends;
  std::vector<NodeFate> nodes;
  eachCase(g, [&](const AxisCase& c) {
    ++o.axes;
    o.segments += c.axis->segments.size();
    const PlantStructure& structure = *plants_[c.plant].structure;
    for (const SegmentId s : c.axis->segments) {
      const SegmentPlace& place = structure.at(s);
      const double left = c.potential - place.rank - 1;
      o.insertions += static_cast<std::size_t>(place.branches);
      if (o.extent == Extent::Own && !place.goesOn) {
        // Where the measured plants stop at their highest order, axes have not ended for good.
        if (c.axis->order + 1 < structure.orders || o.lastOrder == o.order) ends[place.branches] += 1;
        continue;
      }
      // Too young to branch, or to have ended beyond doubt.
      if (o.extent == Extent::Stages && left - delay < 1) continue;
      nodes.push_back({place.rank, place.goesOn, place.branches});
    }
  });
  o.nodes = nodes.size();
  o.fates = fateTableOf(nodes);
  double sum = 0;
  for (const auto& [arms, count] : ends) sum += count;
  for (const auto& [arms, count] : ends) o.ends.push_back({arms, count / sum});
  if (o.ends.empty()) o.ends = {{0, 1}};
}

void FamilyMaker::setAngles(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<double> bends, sides, insertions;
  eachCase(g, [&](const AxisCase& c) {
    const Measurements& m = *plants_[c.plant].measurements;
    const PlantStructure& structure = *plants_[c.plant].structure;
    for (std::size_t i = 0; i < c.axis->segments.size(); ++i) {
      const SegmentId s = c.axis->segments[i];
      if (i > 0) {
        bends.push_back(m.at(s).rotr.radians());
        if (bends.back() > 0.2 * std::numbers::pi / 180) sides.push_back(m.at(s).rotu.radians());
      }
      for (const SegmentId child : m.at(s).children)
        if (structure.at(child).axis != structure.at(s).axis) insertions.push_back(m.at(child).rotr.radians());
    }
  });
  o.bend = distributionOf(bends);
  const CircularMean side = circularMeanOf(sides);
  o.bendsToOneSide = side.samples >= kTested && side.concentration > 0.6;
  o.side = side.mean;
  o.sideDeviation = side.deviation;
  o.insertion = distributionOf(insertions);
  for (const Arms& arms : armsOf(plants_, o.order, o.lastOrder))
    for (const auto& members : arms.members) {
      std::vector<double> leans;
      for (const ArmMember& member : members) leans.push_back(plants_[member.plant].measurements->at(member.base).rotr.radians());
      o.arms[arms.count].push_back({distributionOf(std::move(leans)), {}});
    }
}

void FamilyMaker::setRadius(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<Sample> samples;
  std::vector<std::size_t> axisOf;
  std::size_t axes = 0;
  eachCase(g, [&](const AxisCase& c) {
    for (std::size_t i = 0; i < c.axis->segments.size(); ++i)
      if (const auto r = plants_[c.plant].measurements->at(c.axis->segments[i]).radius; r && *r > 0) {
        samples.push_back({c.plant, o.order, static_cast<int>(i), *r});
        axisOf.push_back(axes);
      }
    ++axes;
  });
  if (samples.empty()) return;
  const Trend trend = trendOf(samples, axisOf, true);
  o.radiusStep = trend.clear() ? std::min(1.0, std::exp(trend.slope)) : 1;
  std::vector<double> starts;
  for (const Sample& s : samples) starts.push_back(std::log(s.value) - std::log(o.radiusStep) * s.rank);
  o.radius = std::exp(medianOf(starts));
}

void FamilyMaker::setLeaves(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<double> lengths;
  double with = 0;
  eachCase(g, [&](const AxisCase& c) {
    for (const SegmentId s : c.axis->segments) {
      const auto& leaves = plants_[c.plant].measurements->at(s).leaves;
      with += leaves.empty() ? 0 : 1;
      for (const LeafMeasure& leaf : leaves) lengths.push_back(leaf.length);
    }
  });
  if (lengths.empty()) return;
  // Grown plants are of the measured ones' ages: whether old nodes lost their leaves or low ones never had any, they are bare alike.
  o.outlook.leafLasts = o.extent == Extent::Stages ? o.outlook.leafSpan : std::nullopt;
  o.leafShare = o.outlook.leafLasts ? o.outlook.leafShare : with / static_cast<double>(o.segments);
  o.leafLength = distributionOf(lengths);
}

Result<Family> familyOf(std::span<const Measurements> given) {
  const auto ready = prepared(given);
  if (!ready) return ready.failure();
  return FamilyMaker(ready->measured, outlookOf(*ready)).made();
}

}  // namespace axil::quantify
