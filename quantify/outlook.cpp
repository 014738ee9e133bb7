#include "quantify/outlook.hpp"

#include "quantify/circular.hpp"
#include "quantify/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kNinety = 1.6448536269514722;  // standard deviations that hold 90 % of normal samples
constexpr std::size_t kFew = 5;
constexpr std::size_t kJudges = 3;

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }

double deviationOf(std::span<const double> misses) {
  if (misses.empty()) return 0;
  double sum = 0;
  for (const double m : misses) sum += m * m;
  return std::sqrt(sum / static_cast<double>(misses.size()));
}

/// Student's two-sided 90 % over the normal's: intervals from few samples are wider.
double fewFactor(std::size_t samples) {
  if (samples < 2) return 2;
  const double f = static_cast<double>(samples - 1);
  return 1 + 1.5 / f + 1 / (f * f);
}

/// Logarithms of an axis' lengths.
std::vector<double> logLengths(const Measurements& m, const Axis& axis) {
  std::vector<double> logs;
  for (const SegmentId s : axis.segments) logs.push_back(std::log(m.at(s).length));
  return logs;
}

/// Foretells one rank of an axis from the ranks below it.
double foretold(LengthRule rule, const std::vector<double>& below, const Trend& trend, double logStep, double levelWeight) {
  const double rank = static_cast<double>(below.size());
  if (rule == LengthRule::Last && !below.empty()) return below.back() + logStep;
  double expected = trend.start + logStep * rank;
  if (rule == LengthRule::Axis && !below.empty()) {
    double off = 0;
    for (std::size_t i = 0; i < below.size(); ++i) off += below[i] - trend.start - logStep * static_cast<double>(i);
    // The axis' own level counts by how many segments tell it.
    expected += off / (static_cast<double>(below.size()) + levelWeight);
  }
  return expected;
}

class Maker {
 public:
  Maker(std::span<const MeasuredPlant> plants, LayeredStatistics statistics) : plants_(plants) { out_.statistics = std::move(statistics); }

  Outlook made() {
    for (int order = 0; order < static_cast<int>(out_.statistics.schedule.orders.size()); ++order) addOrder(order);
    addTips();
    addBuds();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const LayeredStatistics& stats() const { return out_.statistics; }

  void addOrder(int order) {
    OrderOutlook o;
    o.order = order;
    o.schedule = stats().schedule.of(order);
    o.delay = stats().patterns[static_cast<std::size_t>(order)].delay;
    if (const auto& p = stats().patterns[static_cast<std::size_t>(order)]; p.habit == BranchingHabit::EveryKth) {
      o.period = p.period;
      o.phase = p.phase;
    }
    setEnd(o);
    setFates(o);
    setLength(o);
    setStart(o);
    o.bend = stats().of(Quantity::Bend).nearest(order);
    o.insertion = stats().of(Quantity::Insertion).nearest(order - 1);
    setRadius(o);
    setAround(o);
    setLeaves(o);
    out_.orders.push_back(std::move(o));
  }

  /// Axes that never go beyond a rank at which nearly all end.
  void setEnd(OrderOutlook& o) {
    const OrderLayer* layer = stats().of(Quantity::Ending).order(o.order);
    if (layer == nullptr) return;
    for (const RankLayer& rank : layer->ranks) {
      if (rank.estimate.samples < 2 || rank.estimate.own < 0.9) continue;
      o.most = rank.rank + 1;
      return;
    }
  }

  void setFates(OrderOutlook& o) {
    std::map<std::pair<bool, int>, double> counts;
    const bool sympodial = std::count(stats().branching.begin(), stats().branching.end(), Branching::Sympodial) * 2 > static_cast<std::ptrdiff_t>(stats().plants);
    for (std::size_t p = 0; p < plants_.size(); ++p) {
      const PlantStructure& structure = *plants_[p].structure;
      for (const SegmentPlace& place : structure.places) {
        if (!sympodial && place.order != o.order) continue;
        if (!place.goesOn && stats().schedule.plants[p].grows[static_cast<std::size_t>(place.axis.value)]) continue;
        if (place.goesOn && place.fromTip <= o.delay) continue;
        if (o.most && place.rank + 1 >= *o.most) continue;
        if (o.period > 1 && place.rank % o.period != o.phase) continue;
        counts[{!place.goesOn, place.branches}] += 1;
      }
    }
    double sum = 0;
    for (const auto& [fate, count] : counts) sum += count;
    if (sum == 0) {
      o.fates = {{true, 0, 1, 0}};
      return;
    }
    for (const auto& [fate, count] : counts) o.fates.push_back({!fate.first, fate.second, count / sum, static_cast<std::size_t>(count)});
  }

  void setLength(OrderOutlook& o) {
    const OrderLayer* layer = stats().of(Quantity::Length).order(o.order);
    const Trend& trend = layer->trend;
    o.segments = layer->estimate.samples;
    o.usualLength = std::exp(trend.start);
    const double ratio = std::log(stats().of(Quantity::LengthRatio).nearest(o.order).value);
    const double axes = std::max(trend.axisDeviation, 1e-9);
    levelWeight_[o.order] = std::min(100.0, trend.residual * trend.residual / (axes * axes));
    const std::array<double, 3> steps{trend.clear() ? trend.slope : 0, trend.clear() ? trend.slope : 0, stats().of(Quantity::LengthRatio).all.samples > 0 ? ratio : 0};
    double least = std::numeric_limits<double>::infinity();
    for (const LengthRule rule : {LengthRule::Trend, LengthRule::Axis, LengthRule::Last}) {
      const double step = steps[static_cast<std::size_t>(rule)];
      std::vector<double> misses;
      for (const MeasuredPlant& plant : plants_)
        for (const Axis& axis : plant.structure->axes) {
          if (axis.order != o.order) continue;
          const std::vector<double> logs = logLengths(*plant.measurements, axis);
          for (std::size_t r = 1; r < logs.size(); ++r)
            misses.push_back(logs[r] - foretold(rule, {logs.begin(), logs.begin() + static_cast<std::ptrdiff_t>(r)}, trend, step, levelWeight_[o.order]));
        }
      const double miss = deviationOf(misses);
      // A later rule must be better by more than rounding.
      if (misses.size() >= kJudges && miss >= 0.98 * least) continue;
      if (misses.size() < kJudges && rule != LengthRule::Last) continue;
      least = miss;
      o.length = {rule, std::exp(step), miss, misses.size()};
    }
  }

  /// First segments: as usual for the order, or in proportion to the bearer.
  void setStart(OrderOutlook& o) {
    std::vector<double> logs;
    std::vector<double> ratios;
    for (const MeasuredPlant& plant : plants_)
      for (const Axis& axis : plant.structure->axes) {
        if (axis.order != o.order) continue;
        logs.push_back(std::log(plant.measurements->at(axis.base()).length));
        if (axis.bearer) ratios.push_back(logs.back() - std::log(plant.measurements->at(*axis.bearer).length));
      }
    const Centre own = centreOf(logs);
    o.usualLength = std::exp(own.value);
    o.startMiss = own.deviation;
    if (ratios.empty()) return;
    const Centre ratio = centreOf(ratios);
    o.bearerRatio = std::exp(ratio.value);
    if (logs.size() != ratios.size() || (ratios.size() > 1 && ratio.deviation >= own.deviation)) return;
    o.followsBearer = true;
    o.startMiss = ratio.deviation;
  }

  void setRadius(OrderOutlook& o) {
    std::vector<double> radii;
    for (const MeasuredPlant& plant : plants_)
      for (const Axis& axis : plant.structure->axes)
        if (const auto& r = plant.measurements->at(axis.tip()).radius; axis.order == o.order && r) radii.push_back(*r);
    if (!radii.empty()) o.radius = medianOf(std::move(radii));
  }

  /// Azimuths of what stands at the first node of axes, against the side where rotu is 0.
  void setAround(OrderOutlook& o) {
    const auto order = static_cast<std::size_t>(o.order);
    const Phyllotaxis& own = stats().leaves[order].samples > 0 ? stats().leaves[order] : stats().branchesAround[order];
    const Phyllotaxis& all = stats().leaves.back().samples > 0 ? stats().leaves.back() : stats().branchesAround.back();
    const Phyllotaxis& fit = own.samples > 0 ? own : all;
    o.divergence = fit.divergence.radians() * (fit.winding == Winding::Right ? -1 : 1);
    o.divergenceDeviation = fit.samples > 0 ? fit.deviation.radians() : 0;
    std::vector<double> firsts;
    std::vector<double> beside;
    for (const MeasuredPlant& plant : plants_)
      for (const Axis& axis : plant.structure->axes) {
        if (axis.order != o.order) continue;
        if (const auto first = nodeAzimuth(plant, axis.base())) firsts.push_back(*first - twistOf(plant, axis.base()));
        for (const SegmentId s : axis.segments) addBeside(plant, s, beside);
      }
    const double period = fit.perNode > 1 ? 2 * std::numbers::pi / fit.perNode : 2 * std::numbers::pi;
    const CircularMean first = circularMeanOf(firsts, period);
    o.firstAzimuth = first.mean;
    o.startsAlike = first.samples >= kJudges && first.concentration > 0.8;
    const CircularMean offset = circularMeanOf(beside);
    if (offset.samples > 0 && offset.concentration > 0.7) o.branchBesideLeaf = offset.mean;
  }

  static double twistOf(const MeasuredPlant& plant, SegmentId id) {
    const double twist = plant.structure->at(id).twist;
    return std::isnan(twist) ? 0 : twist;
  }

  static std::vector<double> branchAzimuths(const MeasuredPlant& plant, SegmentId id) {
    std::vector<double> azimuths;
    for (const SegmentId child : plant.measurements->at(id).children)
      if (plant.structure->at(child).axis != plant.structure->at(id).axis && !std::isnan(plant.structure->at(child).azimuth)) azimuths.push_back(plant.structure->at(child).azimuth);
    return azimuths;
  }
  static std::vector<double> leafAzimuths(const MeasuredPlant& plant, SegmentId id) {
    std::vector<double> azimuths = plant.structure->leafAzimuths[placeOf(id)];
    std::erase_if(azimuths, [](double a) { return std::isnan(a); });
    return azimuths;
  }
  static std::optional<double> starOf(const std::vector<double>& azimuths) {
    if (azimuths.empty()) return std::nullopt;
    return circularMeanOf(azimuths, 2 * std::numbers::pi / static_cast<double>(azimuths.size())).mean;
  }
  /// The azimuth of a node: its leaves', else its branches'.
  static std::optional<double> nodeAzimuth(const MeasuredPlant& plant, SegmentId id) {
    const auto leaves = starOf(leafAzimuths(plant, id));
    return leaves ? leaves : starOf(branchAzimuths(plant, id));
  }
  static void addBeside(const MeasuredPlant& plant, SegmentId id, std::vector<double>& beside) {
    const auto leaves = leafAzimuths(plant, id);
    for (const double branch : branchAzimuths(plant, id)) {
      if (leaves.empty()) continue;
      double nearest = 2 * std::numbers::pi;
      for (const double leaf : leaves)
        if (std::abs(wrappedTo(branch - leaf)) < std::abs(nearest)) nearest = wrappedTo(branch - leaf);
      beside.push_back(nearest);
    }
  }

  void setLeaves(OrderOutlook& o) {
    std::map<int, std::vector<double>> countsByAge;  // leaves of segments of growing axes, by their distance from the tip
    std::map<int, std::vector<double>> sizesByAge;
    std::vector<double> petioles;
    std::map<int, std::size_t> perNode;
    for (std::size_t p = 0; p < plants_.size(); ++p)
      for (std::size_t s = 0; s < plants_[p].measurements->segments.size(); ++s) {
        const SegmentPlace& place = plants_[p].structure->places[s];
        if (place.order != o.order) continue;
        const auto& leaves = plants_[p].measurements->segments[s].leaves;
        if (stats().schedule.plants[p].grows[static_cast<std::size_t>(place.axis.value)]) countsByAge[place.fromTip].push_back(leaves.empty() ? 0 : 1);
        for (const LeafMeasure& leaf : leaves) {
          sizesByAge[place.fromTip].push_back(std::log(leaf.length));
          petioles.push_back(leaf.petiole);
        }
        if (!leaves.empty()) ++perNode[static_cast<int>(leaves.size())];
      }
    if (perNode.empty()) return;
    o.perNode = std::max_element(perNode.begin(), perNode.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
    setLeafTimes(o, countsByAge);
    setLeafSizes(o, sizesByAge);
    o.petiole = medianOf(std::move(petioles));
    const Estimate& angle = stats().of(Quantity::LeafAngle).nearest(o.order);
    o.leafAngle = angle.value;
    o.leafAngleDeviation = angle.deviation;
    o.leafWidth = o.leafLength * widthOverLength(o.order);
  }

  [[nodiscard]] double widthOverLength(int order) const {
    std::vector<double> shares;
    for (const MeasuredPlant& plant : plants_)
      for (std::size_t s = 0; s < plant.measurements->segments.size(); ++s)
        for (const LeafMeasure& leaf : plant.measurements->segments[s].leaves)
          if (plant.structure->places[s].order == order) shares.push_back(leaf.width / leaf.length);
    return shares.empty() ? 0 : medianOf(std::move(shares));
  }

  static double shareIn(const std::map<int, std::vector<double>>& counts, int age) {
    const auto found = counts.find(age);
    if (found == counts.end()) return 0;
    double sum = 0;
    for (const double c : found->second) sum += c;
    return sum / static_cast<double>(found->second.size());
  }

  /// Whether the youngest node has its leaves, and whether old ones have lost theirs.
  static void setLeafTimes(OrderOutlook& o, const std::map<int, std::vector<double>>& counts) {
    double best = 0;
    int oldest = 0;
    for (const auto& [age, values] : counts) {
      if (age <= 3) best = std::max(best, shareIn(counts, age));
      oldest = std::max(oldest, age);
    }
    o.leafShare = best;
    o.leafAtOwnTip = shareIn(counts, 0) >= 0.5 * best;
    if (best <= 0) return;
    // Gone for good: from some age on (nearly) none has leaves, on three nodes and more.
    int last = oldest;
    std::size_t bare = 0;
    while (last >= 0 && shareIn(counts, last) <= 0.1 * best) {
      if (const auto found = counts.find(last); found != counts.end()) bare += found->second.size();
      --last;
    }
    if (bare >= 3 && last >= 0 && last < oldest) o.leafLasts = last + 1;
  }

  static void setLeafSizes(OrderOutlook& o, const std::map<int, std::vector<double>>& sizes) {
    std::vector<double> all;
    for (const auto& [age, logs] : sizes) all.insert(all.end(), logs.begin(), logs.end());
    int oldest = sizes.rbegin()->first;
    // The youngest age from which leaves are within a tenth of all older ones.
    for (int age = 0; age <= oldest; ++age) {
      std::vector<double> here;
      std::vector<double> older;
      for (const auto& [a, logs] : sizes) (a <= age ? here : older).insert((a <= age ? here : older).end(), logs.begin(), logs.end());
      const auto own = sizes.find(age);
      if (own == sizes.end()) continue;
      if (older.empty() || medianOf(own->second) >= medianOf(older) + std::log(0.9)) {
        std::vector<double> grown = own->second;
        grown.insert(grown.end(), older.begin(), older.end());
        const Centre centre = centreOf(grown);
        o.leafLength = std::exp(centre.value);
        o.leafDeviation = centre.deviation;
        o.leafStages = std::max(1, age + (o.leafAtOwnTip ? 1 : 0));
        return;
      }
    }
  }

  // ---- the first plant's own tips ------------------------------------------------------------------------------------

  void addTips() {
    const MeasuredPlant& plant = plants_.front();
    for (std::size_t a = 0; a < plant.structure->axes.size(); ++a) {
      if (!stats().schedule.plants.front().grows[a]) continue;
      const Axis& axis = plant.structure->axes[a];
      const OrderOutlook& o = out_.of(axis.order);
      const int rank = static_cast<int>(axis.segments.size());
      if (o.most && rank >= *o.most) continue;
      out_.tips.push_back(tipOf(plant, AxisId{static_cast<std::int32_t>(a)}, axis, o));
    }
    std::sort(out_.tips.begin(), out_.tips.end(), [](const TipOutlook& x, const TipOutlook& y) { return x.tip < y.tip; });
  }

  TipOutlook tipOf(const MeasuredPlant& plant, AxisId id, const Axis& axis, const OrderOutlook& o) {
    TipOutlook tip;
    tip.axis = id;
    tip.tip = axis.tip();
    tip.order = axis.order;
    tip.nextRank = static_cast<int>(axis.segments.size());
    const OrderLayer* layer = stats().of(Quantity::Length).order(axis.order);
    const std::vector<double> logs = logLengths(*plant.measurements, axis);
    tip.length = std::exp(foretold(o.length.rule, logs, layer->trend, std::log(o.length.step), levelWeight_[o.order]));
    tip.miss = o.length.samples >= 2 ? o.length.miss : std::max(o.length.miss, o.startMiss);
    const double reach = kNinety * tip.miss * fewFactor(o.length.samples);
    tip.low = tip.length * std::exp(-reach);
    tip.high = tip.length * std::exp(reach);
    tip.azimuth = nextAzimuth(plant, axis, o) - twistOf(plant, axis.tip());
    return tip;
  }

  /// Where the organs of the tip's own node stand, or will.
  static double nextAzimuth(const MeasuredPlant& plant, const Axis& axis, const OrderOutlook& o) {
    for (std::size_t back = 0; back < axis.segments.size(); ++back) {
      const SegmentId at = axis.segments[axis.segments.size() - 1 - back];
      if (const auto azimuth = nodeAzimuth(plant, at)) return *azimuth + o.divergence * static_cast<double>(back);
    }
    return o.startsAlike ? o.firstAzimuth + twistOf(plant, axis.tip()) : 0;
  }

  void addBuds() {
    const MeasuredPlant& plant = plants_.front();
    for (std::size_t a = 0; a < plant.structure->axes.size(); ++a) {
      const Axis& axis = plant.structure->axes[a];
      const OrderOutlook& o = out_.of(axis.order);
      double share = 0;
      for (const Fate& fate : o.fates) share += fate.branches > 0 ? fate.share : 0;
      if (o.delay == 0 || share == 0) continue;
      for (const SegmentId s : axis.segments) {
        const SegmentPlace& place = plant.structure->at(s);
        if (!place.goesOn || place.branches > 0 || place.fromTip > o.delay) continue;
        if (o.period > 1 && place.rank % o.period != o.phase) continue;
        const OrderOutlook& next = out_.of(axis.order + 1);
        const double length = next.followsBearer ? next.bearerRatio * plant.measurements->at(s).length : next.usualLength;
        const auto around = nodeAzimuth(plant, s);
        out_.buds.push_back({s, axis.order + 1, o.delay - place.fromTip, share, length, around.value_or(0) + o.branchBesideLeaf - twistOf(plant, s)});
      }
    }
    std::sort(out_.buds.begin(), out_.buds.end(), [](const BudOutlook& x, const BudOutlook& y) { return x.at < y.at; });
  }

  std::span<const MeasuredPlant> plants_;
  Outlook out_;
  std::map<int, double> levelWeight_;
};

}  // namespace

const char* nameOf(LengthRule rule) {
  switch (rule) {
    case LengthRule::Trend: return "the order's trend";
    case LengthRule::Axis: return "the axis' own level on the order's trend";
    case LengthRule::Last: return "the segment below";
  }
  return "";
}

const OrderOutlook& Outlook::of(int order) const { return orders[static_cast<std::size_t>(std::clamp(order, 0, static_cast<int>(orders.size()) - 1))]; }

Result<Outlook> anyOutlookOf(std::span<const Measurements> given) {
  auto statistics = layeredStatistics(given);
  if (!statistics) return statistics.failure();
  std::vector<std::string> known;  // layeredStatistics has warned already
  const auto plants = inOneUnit(given, known);
  if (!plants) return plants.failure();
  std::vector<PlantStructure> structures;
  for (const Measurements& m : *plants) structures.push_back(plantStructure(m));
  std::vector<MeasuredPlant> measured;
  for (std::size_t p = 0; p < plants->size(); ++p) measured.push_back({&(*plants)[p], &structures[p]});
  return Maker(measured, std::move(*statistics)).made();
}

Result<Outlook> outlookOf(std::span<const Measurements> given) {
  const auto branches = [](const Measurements& m) { return std::any_of(m.segments.begin(), m.segments.end(), [](const Segment& s) { return !s.children.empty(); }); };
  const bool empty = given.empty() || std::any_of(given.begin(), given.end(), [](const Measurements& m) { return m.segments.empty(); });
  if (!empty && std::none_of(given.begin(), given.end(), branches))
    return fail(ErrorCode::NoAnswer, "nothing can be predicted: no segment of the plant has a child, so nothing shows how it goes on; measure it with more nodes, or add plants of its kind");
  return anyOutlookOf(given);
}

}  // namespace axil::quantify
