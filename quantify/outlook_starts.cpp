#include "quantify/arms.hpp"
#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"
#include "quantify/prepared.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::quantify {

namespace {

/// How a new axis began, in logarithms: its first length, alone and against its order's course, its bearer's length and level.
struct Start {
  double own = 0;
  double stage = 0;      ///< over its order's course in the stage in which it was made, where lengths follow that
  double bearer = 0;
  double level = 0;
  std::pair<int, std::size_t> arm{0, 0};  ///< number of axes at the node and which it is; (0, 0) where arms are alike
};

struct Fit {
  double centre = 0;
  double miss = 0;
};

using ArmPlaces = std::map<std::pair<std::size_t, SegmentId>, std::pair<int, std::size_t>>;

ArmPlaces placesOf(const std::vector<Arms>& all) {
  ArmPlaces places;
  for (const Arms& arms : all)
    for (std::size_t a = 0; a < arms.members.size(); ++a)
      for (const ArmMember& member : arms.members[a]) places[{member.plant, member.base}] = {arms.count, a};
  return places;
}

/// Of the axes of orders from `low` to `high` that have a bearer.
std::vector<Start> startsOf(std::span<const MeasuredPlant> plants, const Outlook& outlook, const std::map<int, OrderCourse>& courses, const ArmPlaces& arms, int low, int high) {
  const Schedule& schedule = outlook.statistics.schedule;
  std::vector<Start> starts;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const Measurements& m = *plants[p].measurements;
    const PlantStructure& structure = *plants[p].structure;
    for (const Axis& axis : structure.axes) {
      if (axis.order < low || axis.order > high || !axis.bearer) continue;
      const SegmentPlace& place = structure.at(*axis.bearer);
      const double own = std::log(m.at(axis.base()).length);
      const AxisLengths bearer = lengthsOf(plants[p], schedule.plants[p], structure.at(place.axis));
      const double level = courses.at(place.order).levelAt(bearer, bearer.logs.size(), static_cast<std::size_t>(place.rank));
      const LengthOutlook& length = outlook.of(axis.order).length;
      const double byStage = length.along == LengthsAlong::Stage ? length.at(lengthsOf(plants[p], schedule.plants[p], axis).begun) : 0;
      Start start{own, own - byStage, own - std::log(m.at(*axis.bearer).length), own - level, {0, 0}};
      if (const auto arm = arms.find({p, axis.base()}); arm != arms.end()) start.arm = arm->second;
      starts.push_back(start);
    }
  }
  return starts;
}

/// The centre of all, and the deviation around the centre of each arm.
Fit fitOf(const std::vector<Start>& starts, double Start::*by) {
  std::map<std::pair<int, std::size_t>, std::vector<double>> groups;
  std::vector<double> all;
  for (const Start& s : starts) {
    groups[s.arm].push_back(s.*by);
    all.push_back(s.*by);
  }
  Fit fit{centreOf(all).value, 0};
  double squares = 0, freedom = 0;
  for (const auto& [arm, values] : groups) {
    const double n = static_cast<double>(values.size());
    squares += std::pow(centreOf(values).deviation, 2) * std::max(0.0, n - 1);
    freedom += std::max(0.0, n - 1);
  }
  if (freedom > 0) fit.miss = std::sqrt(squares / freedom);
  return fit;
}

/// The simplest rule that no other beats by more than rounding.
void choose(OrderOutlook& o, const std::vector<Start>& starts) {
  o.starts = starts.size();
  if (starts.empty()) return;
  std::vector<Start> alike = starts;  // what is usual for an order does not know arms
  for (Start& s : alike) s.arm = {0, 0};
  const Fit usual = fitOf(alike, &Start::own), stage = fitOf(alike, &Start::stage), bearer = fitOf(starts, &Start::bearer), level = fitOf(starts, &Start::level);
  const bool few = starts.size() < 2;
  o.usualLength = std::exp(usual.centre);
  o.start = StartRule::Usual;
  o.startMiss = usual.miss;
  const auto take = [&o](StartRule rule, const Fit& fit) {
    o.start = rule;
    o.bearerRatio = std::exp(fit.centre);
    o.startMiss = fit.miss;
  };
  if (o.length.along == LengthsAlong::Stage && (few || stage.miss < 0.98 * o.startMiss)) {
    o.start = StartRule::Stage;
    o.usualLength = std::exp(stage.centre);
    o.startMiss = stage.miss;
  }
  if (few || level.miss < 0.98 * o.startMiss) take(StartRule::Level, level);
  if (few || bearer.miss < 0.98 * o.startMiss) take(StartRule::Bearer, bearer);
  if (o.start == StartRule::Usual || o.start == StartRule::Stage) o.bearerRatio = std::exp(level.centre);
}

/// What an axis of `order` bears where arms differ.
void setArms(OrderOutlook& o, std::span<const MeasuredPlant> plants, const std::vector<Arms>& all, const std::vector<Start>& starts, StartRule rule) {
  for (const Arms& arms : all) {
    std::vector<ArmOutlook> outlooks;
    for (std::size_t a = 0; a < arms.members.size(); ++a) {
      std::vector<Sample> leans;
      for (const ArmMember& member : arms.members[a]) leans.push_back({member.plant, 0, 0, plants[member.plant].measurements->at(member.base).rotr.radians()});
      std::vector<double> ratios;
      for (const Start& s : starts)
        if (s.arm == std::pair(arms.count, a)) ratios.push_back(rule == StartRule::Bearer ? s.bearer : s.level);
      outlooks.push_back({estimateOf(leans, SampleKind::Plain), ratios.empty() ? 1 : std::exp(centreOf(ratios).value)});
    }
    o.arms[arms.count] = std::move(outlooks);
  }
}

/// The first axis of a plant, and others that leave its collar.
void setCollar(OrderOutlook& o, std::span<const MeasuredPlant> plants) {
  std::vector<double> logs;
  for (const MeasuredPlant& plant : plants)
    for (const Axis& axis : plant.structure->axes)
      if (axis.order == o.order) logs.push_back(std::log(plant.measurements->at(axis.base()).length));
  const Centre own = centreOf(logs);
  o.usualLength = std::exp(own.value);
  o.startMiss = own.deviation;
  o.starts = logs.size();
}

}  // namespace

void setStarts(Outlook& outlook, std::span<const MeasuredPlant> plants, const std::map<int, OrderCourse>& courses) {
  const int top = static_cast<int>(outlook.orders.size()) - 1;
  const bool together = mostlySympodial(outlook.statistics);
  const std::vector<Arms> every = together ? armsOf(plants, 0, top, ArmsBy::Lean) : std::vector<Arms>{};
  for (int order = 0; order <= top; ++order) {
    OrderOutlook& o = outlook.orders[static_cast<std::size_t>(order)];
    setCollar(o, plants);
    const std::vector<Arms> arms = together ? every : armsOf(plants, order - 1, order - 1, ArmsBy::Lean);
    const std::vector<Start> starts = startsOf(plants, outlook, courses, placesOf(arms), order, order);
    choose(o, starts);
    if (order > 0 && !together) setArms(outlook.orders[static_cast<std::size_t>(order - 1)], plants, arms, starts, o.start);
  }
  if (!together || top < 1) return;
  const std::vector<Start> starts = startsOf(plants, outlook, courses, placesOf(every), 1, top);
  OrderOutlook above = outlook.orders.back();
  above.order = top + 1;
  choose(above, starts);
  // Lengths usual for an order below say nothing here.
  if (above.start == StartRule::Usual || above.start == StartRule::Stage) {
    const Fit level = fitOf(starts, &Start::level);
    above.start = StartRule::Level;
    above.bearerRatio = std::exp(level.centre);
    above.startMiss = level.miss;
  }
  const StartRule rule = above.start;
  outlook.orders.push_back(std::move(above));
  for (OrderOutlook& o : outlook.orders) setArms(o, plants, every, starts, rule);
}

}  // namespace axil::quantify
