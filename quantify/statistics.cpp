#include "quantify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double wrapped(double radians) {
  const double w = std::remainder(radians, kTurn);
  return w <= -std::numbers::pi ? w + kTurn : w;
}

/// Collects one number a sample, by what a getter says.
template <class Samples, class Get>
std::vector<double> numbersOf(const Samples& samples, Get get) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const auto* sample : samples) values.push_back(get(*sample));
  return values;
}

ChildSpread childSpread(const std::vector<const Segment*>& samples) {
  return {spreadOf(numbersOf(samples, [](const Segment& s) { return s.rotr.radians(); })),
          circularSpreadOf(numbersOf(samples, [](const Segment& s) { return s.rotu.radians(); })),
          spreadOf(numbersOf(samples, [](const Segment& s) { return s.length; }))};
}

LeafSpread leafSpread(const std::vector<const LeafMeasure*>& samples) {
  return {spreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.rotr.radians(); })),
          circularSpreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.rotu.radians(); })),
          circularSpreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.roll.radians(); })),
          spreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.length; })),
          spreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.width; })),
          spreadOf(numbersOf(samples, [](const LeafMeasure& l) { return l.petiole; }))};
}

RuleTemplate filled(const Measurements& m, RuleTemplate pattern) {
  for (std::size_t c = 0; c < pattern.structure.branches + (pattern.structure.goesOn ? 1 : 0); ++c) {
    std::vector<const Segment*> samples;
    for (const SegmentId id : pattern.members) samples.push_back(&m.at(m.at(id).children[c]));
    pattern.children.push_back(childSpread(samples));
  }
  for (std::size_t l = 0; l < pattern.structure.leaves; ++l) {
    std::vector<const LeafMeasure*> samples;
    for (const SegmentId id : pattern.members) samples.push_back(&m.at(id).leaves[l]);
    pattern.leaves.push_back(leafSpread(samples));
  }
  return pattern;
}

std::vector<double> sharesOf(const std::vector<std::size_t>& counts) {
  std::vector<double> shares;
  for (const std::size_t count : counts) {
    if (shares.size() <= count) shares.resize(count + 1, 0.0);
    shares[count] += 1.0 / static_cast<double>(counts.size());
  }
  return shares;
}

/// What is gathered of one order before it becomes statistics.
struct OrderSamples {
  std::vector<double> lengths, radii, axisLengths, bends, bendsAround, insertions, divergences;
  std::vector<std::size_t> branchCounts, leafCounts;
  std::vector<const LeafMeasure*> leaves;
};

OrderStatistics statisticsOf(int order, const OrderSamples& s) {
  OrderStatistics statistics;
  statistics.order = order;
  statistics.length = spreadOf(s.lengths);
  statistics.radius = spreadOf(s.radii);
  statistics.segmentsPerAxis = spreadOf(s.axisLengths);
  statistics.bend = spreadOf(s.bends);
  statistics.bendAround = circularSpreadOf(s.bendsAround);
  statistics.insertion = spreadOf(s.insertions);
  statistics.divergence = circularSpreadOf(s.divergences);
  statistics.branchShares = sharesOf(s.branchCounts);
  statistics.leafShares = sharesOf(s.leafCounts);
  statistics.leaf = leafSpread(s.leaves);
  return statistics;
}

void gather(const Measurements& m, const Segment& segment, OrderSamples& own) {
  own.lengths.push_back(segment.length);
  if (segment.radius) own.radii.push_back(*segment.radius);
  if (segment.kind == SegmentKind::Main) {
    own.bends.push_back(segment.rotr.radians());
    own.bendsAround.push_back(segment.rotu.radians());
  }
  for (const LeafMeasure& leaf : segment.leaves) own.leaves.push_back(&leaf);
  own.leafCounts.push_back(segment.leaves.size());
  const RuleStructure structure = structureOf(segment);
  if (structure.goesOn) own.branchCounts.push_back(structure.branches);
  for (const SegmentId id : segment.children) {
    if (m.at(id).kind != SegmentKind::Branch) continue;
    own.insertions.push_back(m.at(id).rotr.radians());
    own.divergences.push_back(m.at(id).rotu.radians());
  }
}

/// How many segments stand on the axis that each segment ends; 0 for a segment that its axis goes on from.
std::vector<double> axisLengthsAtTips(const Measurements& m) {
  std::vector<double> sofar(m.segments.size(), 1);
  std::vector<double> atTip(m.segments.size(), 0);
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    const Segment& segment = m.segments[s];
    if (segment.kind == SegmentKind::Main) sofar[s] = sofar[static_cast<std::size_t>(segment.parent->value)] + 1;
    if (segment.children.empty()) atTip[s] = sofar[s];
  }
  return atTip;
}

}  // namespace

Spread spreadOf(std::span<const double> values) {
  Spread spread;
  spread.count = values.size();
  if (values.empty()) return spread;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  spread.low = *low;
  spread.high = *high;
  double sum = 0;
  for (const double v : values) sum += v;
  spread.mean = std::clamp(sum / static_cast<double>(values.size()), spread.low, spread.high);
  double squares = 0;
  for (const double v : values) squares += (v - spread.mean) * (v - spread.mean);
  if (values.size() > 1) spread.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return spread;
}

Spread circularSpreadOf(std::span<const double> radians) {
  if (radians.empty()) return {};
  std::vector<double> sorted;
  for (const double r : radians) sorted.push_back(wrapped(r));
  std::sort(sorted.begin(), sorted.end());
  // The arc begins behind the widest gap.
  std::size_t first = 0;
  double widest = sorted.front() + kTurn - sorted.back();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] <= widest) continue;
    widest = sorted[i] - sorted[i - 1];
    first = i;
  }
  std::vector<double> along;
  for (std::size_t i = 0; i < sorted.size(); ++i) along.push_back(sorted[(first + i) % sorted.size()] + (first + i >= sorted.size() ? kTurn : 0));
  return spreadOf(along);
}

RuleStructure structureOf(const Segment& segment) {
  // A segment with children always has a main one: the nearest to its own direction.
  const bool goesOn = !segment.children.empty();
  return {segment.children.size() - (goesOn ? 1 : 0), goesOn, segment.leaves.size()};
}

std::vector<RuleTemplate> templatesOf(const Measurements& measurements) {
  std::map<RuleStructure, std::size_t> places;
  std::vector<RuleTemplate> templates;
  for (std::size_t s = 0; s < measurements.segments.size(); ++s) {
    const RuleStructure structure = structureOf(measurements.segments[s]);
    if (!structure.goesOn) continue;
    const auto [found, isNew] = places.emplace(structure, templates.size());
    if (isNew) templates.push_back({structure, {}, {}, {}});
    templates[found->second].members.push_back(SegmentId{static_cast<std::int32_t>(s)});
  }
  for (RuleTemplate& pattern : templates) pattern = filled(measurements, std::move(pattern));
  return templates;
}

std::vector<int> ordersOf(const Measurements& measurements) {
  std::vector<int> orders(measurements.segments.size(), 0);
  for (std::size_t s = 1; s < measurements.segments.size(); ++s) {
    const Segment& segment = measurements.segments[s];
    const int parent = segment.parent ? orders[static_cast<std::size_t>(segment.parent->value)] : 0;
    orders[s] = parent + (segment.kind == SegmentKind::Branch ? 1 : 0);
  }
  return orders;
}

std::vector<OrderStatistics> orderStatistics(const Measurements& measurements) {
  const std::vector<int> orders = ordersOf(measurements);
  const std::vector<double> axisLengths = axisLengthsAtTips(measurements);
  std::map<int, OrderSamples> samples;
  for (std::size_t s = 0; s < measurements.segments.size(); ++s) {
    OrderSamples& own = samples[orders[s]];
    gather(measurements, measurements.segments[s], own);
    if (axisLengths[s] > 0) own.axisLengths.push_back(axisLengths[s]);
  }
  std::vector<OrderStatistics> statistics;
  for (const auto& [order, own] : samples) statistics.push_back(statisticsOf(order, own));
  return statistics;
}

}  // namespace axil::quantify
