#include "quantify/outlook.hpp"

#include "quantify/circular.hpp"
#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"
#include "quantify/prepared.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kNinety = 1.6448536269514722;  // standard deviations that hold 90 % of normal samples
constexpr std::size_t kJudges = 3;

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }

/// Student's two-sided 90 % over the normal's: intervals from few samples are wider.
double fewFactor(std::size_t samples) {
  if (samples < 2) return 2;
  const double f = static_cast<double>(samples - 1);
  return 1 + 1.5 / f + 1 / (f * f);
}

class Maker {
 public:
  Maker(std::span<const MeasuredPlant> plants, LayeredStatistics statistics) : plants_(plants) { out_.statistics = std::move(statistics); }

  /// What all plants show; then each plant's own tips, as often as wanted.
  void makeShared() {
    axes_ = axesByOrder(plants_, stats().schedule);
    shared_ = sharedBowsBack(axes_);
    for (int order = 0; order < static_cast<int>(out_.statistics.schedule.orders.size()); ++order) addOrder(order);
    setStarts(out_, plants_, courses_);
  }
  Outlook madeFor(std::size_t plant) {
    out_.plant = plant;
    out_.levels.clear();
    out_.tips.clear();
    out_.buds.clear();
    addLevels();
    addTips();
    addBuds();
    return out_;
  }

 private:
  [[nodiscard]] const LayeredStatistics& stats() const { return out_.statistics; }

  void addOrder(int order) {
    OrderOutlook o;
    o.order = order;
    o.schedule = stats().schedule.of(order);
    o.delay = stats().patterns[static_cast<std::size_t>(order)].delay;
    setEnd(o);
    setFates(o);
    courses_[order] = setLength(o, axes_[order], shared_, stats());
    o.bend = stats().of(Quantity::Bend).nearest(order);
    o.insertion = stats().of(Quantity::Insertion).nearest(order - 1);
    setRadius(o);
    setAround(o);
    setLeaves(o, plants_, stats());
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
    std::vector<NodeFate> nodes;
    const bool together = mostlySympodial(stats());
    for (std::size_t p = 0; p < plants_.size(); ++p) {
      const PlantStructure& structure = *plants_[p].structure;
      for (const SegmentPlace& place : structure.places) {
        if (!together && place.order != o.order) continue;
        if (!place.goesOn && stats().schedule.plants[p].grows[static_cast<std::size_t>(place.axis.value)]) continue;
        if (place.goesOn && place.fromTip <= o.delay) continue;
        if (o.most && place.rank + 1 >= *o.most) continue;
        nodes.push_back({place.rank, place.goesOn, place.branches});
      }
    }
    o.fates = fateTableOf(nodes);
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

  // ---- one plant's own tips ------------------------------------------------------------------------------------

  void addLevels() {
    const MeasuredPlant& plant = plants_[out_.plant];
    out_.levels.resize(plant.measurements->segments.size());
    for (const Axis& axis : plant.structure->axes) {
      const AxisLengths lengths = lengthsOf(plant, stats().schedule.plants[out_.plant], axis);
      const std::size_t count = lengths.logs.size();
      for (std::size_t r = 0; r < count; ++r) out_.levels[placeOf(axis.segments[r])] = std::exp(courses_.at(axis.order).levelAt(lengths, count, r));
    }
  }

  void addTips() {
    const MeasuredPlant& plant = plants_[out_.plant];
    for (std::size_t a = 0; a < plant.structure->axes.size(); ++a) {
      if (!stats().schedule.plants[out_.plant].grows[a]) continue;
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
    const AxisLengths lengths = lengthsOf(plant, stats().schedule.plants[out_.plant], axis);
    const std::size_t below = lengths.logs.size();
    OrderCourse course = courses_.at(axis.order);
    course.step = std::log(o.length.step);
    course.curve = std::log(o.length.curve);
    course.bow = o.length.bow;
    tip.length = std::exp(foretold(o.length.rule, lengths, below, course));
    tip.miss = o.length.samples >= 2 ? doubtOf(o.length, lengths, course) : std::max(o.length.miss, o.startMiss);
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
    const MeasuredPlant& plant = plants_[out_.plant];
    for (std::size_t a = 0; a < plant.structure->axes.size(); ++a) {
      const Axis& axis = plant.structure->axes[a];
      const OrderOutlook& o = out_.of(axis.order);
      if (o.delay == 0) continue;
      for (const SegmentId s : axis.segments) {
        const SegmentPlace& place = plant.structure->at(s);
        if (!place.goesOn || place.branches > 0 || place.fromTip > o.delay) continue;
        const double share = o.fates.branchingAt(place.rank);
        if (share <= 0) continue;
        const OrderOutlook& next = out_.of(axis.order + 1);
        const auto around = nodeAzimuth(plant, s);
        const int waits = o.delay - place.fromTip;
        const double length = next.firstLength(plant.measurements->at(s).length, out_.levels[placeOf(s)], out_.now() + waits + 1);
        out_.buds.push_back({s, axis.order + 1, waits, share, length, around.value_or(0) + o.branchBesideLeaf - twistOf(plant, s)});
      }
    }
    std::sort(out_.buds.begin(), out_.buds.end(), [](const BudOutlook& x, const BudOutlook& y) { return x.at < y.at; });
  }

  std::span<const MeasuredPlant> plants_;
  Outlook out_;
  std::map<int, Axes> axes_;
  std::vector<SharedBows> shared_;
  std::map<int, OrderCourse> courses_;
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

double LengthOutlook::at(double place) const { return bow ? bow->at(place) : std::log(step) * place + std::log(curve) * place * (place - 1) / 2; }

double OrderOutlook::firstLength(double bearer, double level, double stage) const {
  switch (start) {
    case StartRule::Usual: return usualLength;
    case StartRule::Stage: return usualLength * std::exp(length.at(stage));
    case StartRule::Bearer: return bearerRatio * bearer;
    case StartRule::Level: return bearerRatio * level;
  }
  return usualLength;
}

Outlook outlookOf(const PreparedPlants& plants) {
  Maker maker(plants.measured, statisticsOf(plants));
  maker.makeShared();
  return maker.madeFor(0);
}

std::vector<Outlook> outlooksOf(const PreparedPlants& plants) {
  Maker maker(plants.measured, statisticsOf(plants));
  maker.makeShared();
  std::vector<Outlook> all;
  for (std::size_t p = 0; p < plants.plants.size(); ++p) all.push_back(maker.madeFor(p));
  return all;
}

Result<Outlook> anyOutlookOf(std::span<const Measurements> given) {
  const auto ready = prepared(given);
  if (!ready) return ready.failure();
  return outlookOf(*ready);
}

Result<Outlook> outlookOf(std::span<const Measurements> given) {
  const auto branches = [](const Measurements& m) { return std::any_of(m.segments.begin(), m.segments.end(), [](const Segment& s) { return !s.children.empty(); }); };
  const bool empty = given.empty() || std::any_of(given.begin(), given.end(), [](const Measurements& m) { return m.segments.empty(); });
  if (!empty && std::none_of(given.begin(), given.end(), branches))
    return fail(ErrorCode::NoAnswer, "nothing can be predicted: no segment of the plant has a child, so nothing shows how it goes on; measure it with more nodes, or add plants of its kind");
  return anyOutlookOf(given);
}

}  // namespace axil::quantify
