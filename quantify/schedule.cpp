#include "quantify/schedule.hpp"

#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>

namespace axil::quantify {

namespace {

constexpr double kMatching = 0.2;    // of an order's axes that must have exactly their stages
constexpr double kTooLong = 0.05;    // of them that may have more
constexpr double kSlowest = 0.05;

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }

/// One axis of an order, and how many stages its bearer is old.
struct Case {
  std::size_t plant = 0;
  std::size_t axis = 0;
  double stages = 0;
  double segments = 0;
  double height = 0;   ///< segments of the longest path from its base, its laterals' included
  bool forks = false;
};

double bearersBirth(const PlantSchedule& plant, const Axis& axis) { return axis.bearer ? plant.birth[placeOf(*axis.bearer)] : -1; }

/// Segments on the longest path from each segment to a tip, itself included.
std::vector<double> heightsOf(const Measurements& m) {
  std::vector<double> heights(m.segments.size(), 1);
  for (std::size_t s = m.segments.size(); s-- > 0;)
    if (const auto parent = m.segments[s].parent) heights[placeOf(*parent)] = std::max(heights[placeOf(*parent)], heights[s] + 1);
  return heights;
}

std::vector<Case> casesOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order) {
  std::vector<Case> cases;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const std::vector<double> heights = heightsOf(*plants[p].measurements);
    for (std::size_t a = 0; a < plants[p].structure->axes.size(); ++a) {
      const Axis& axis = plants[p].structure->axes[a];
      if (axis.order != order) continue;
      cases.push_back({p, a, schedule.plants[p].now - bearersBirth(schedule.plants[p], axis), static_cast<double>(axis.segments.size()), heights[placeOf(axis.base())], axis.forks});
    }
  }
  return cases;
}

/// Steady growth with the delay that most axes keep to; none where too few do.
std::optional<int> steadyDelay(const std::vector<Case>& cases) {
  double furthest = 0;
  for (const Case& c : cases) furthest = std::max(furthest, c.stages - c.height);
  std::optional<int> best;
  std::size_t most = 0;
  for (int delay = 0; delay <= static_cast<int>(furthest); ++delay) {
    std::size_t matching = 0;
    std::size_t tooLong = 0;
    for (const Case& c : cases) {
      const double possible = c.stages - delay;
      tooLong += c.height > possible + 0.5 ? 1 : 0;
      matching += std::abs(c.height - possible) < 0.5 ? 1 : 0;
    }
    if (static_cast<double>(tooLong) > kTooLong * static_cast<double>(cases.size())) continue;
    if (static_cast<double>(matching) < kMatching * static_cast<double>(cases.size()) || matching <= most) continue;
    most = matching;
    best = delay;
  }
  return best;
}

/// Stages after which older axes are no longer: the bend of segments = rate * min(stages, lasting), where it fits clearly better than no bend.
void setRate(OrderSchedule& order, const std::vector<Case>& cases) {
  std::vector<double> rates;
  for (const Case& c : cases)
    if (!c.forks && c.stages > 0) rates.push_back(c.segments / c.stages);
  order.rate = rates.empty() ? 1 : std::clamp(medianOf(rates), kSlowest, 1.0);
  const auto misfit = [&](double rate, double lasting) {
    double sum = 0;
    for (const Case& c : cases) sum += c.forks ? 0 : std::pow(c.segments - rate * std::min(c.stages, lasting), 2);
    return sum;
  };
  constexpr std::size_t kEnough = 8;
  if (rates.size() < kEnough) return;
  double furthest = 0;
  for (const Case& c : cases) furthest = std::max(furthest, c.stages);
  double least = 0.6 * misfit(order.rate, furthest);
  for (double lasting = 1; lasting < 0.75 * furthest; lasting += 1) {
    double xy = 0, xx = 0;
    for (const Case& c : cases) {
      if (c.forks) continue;
      xy += c.segments * std::min(c.stages, lasting);
      xx += std::min(c.stages, lasting) * std::min(c.stages, lasting);
    }
    const double rate = std::min(1.0, xy / xx);
    if (misfit(rate, lasting) >= least) continue;
    least = misfit(rate, lasting);
    order.lasting = lasting;
    order.rate = std::max(kSlowest, rate);
  }
}

void setBirths(PlantSchedule& plant, const Axis& axis, const OrderSchedule& order, const Case& c, bool grows) {
  const double start = bearersBirth(plant, axis) + 1;
  for (std::size_t j = 0; j < axis.segments.size(); ++j) {
    const double after = order.steady ? order.delay + static_cast<double>(j) : static_cast<double>(j) / std::max(order.rate, c.segments / std::max(1.0, c.stages));
    plant.birth[placeOf(axis.segments[j])] = std::min(plant.now, start + after);
  }
  plant.grows[c.axis] = grows;
}

OrderSchedule orderSchedule(int order, const std::vector<Case>& cases) {
  OrderSchedule result;
  result.order = order;
  result.axes = cases.size();
  if (order == 0) return result;
  const auto delay = steadyDelay(cases);
  result.steady = delay.has_value();
  if (delay) result.delay = *delay;
  else setRate(result, cases);
  return result;
}

bool stillGrows(const OrderSchedule& order, const Case& c) {
  if (c.forks) return false;
  if (order.steady) return c.segments + 0.5 > c.stages - order.delay;
  return !order.lasting || c.stages < *order.lasting;
}

}  // namespace

const OrderSchedule& Schedule::of(int order) const {
  return orders[static_cast<std::size_t>(std::clamp(order, 0, static_cast<int>(orders.size()) - 1))];
}

Schedule scheduleOf(std::span<const MeasuredPlant> plants) {
  Schedule schedule;
  int orders = 0;
  for (const MeasuredPlant& plant : plants) {
    PlantSchedule own;
    for (const Segment& s : plant.measurements->segments) own.now = std::max(own.now, static_cast<double>(s.level));
    own.birth.assign(plant.measurements->segments.size(), 0);
    own.grows.assign(plant.structure->axes.size(), false);
    schedule.plants.push_back(std::move(own));
    orders = std::max(orders, plant.structure->orders);
  }
  for (int order = 0; order < orders; ++order) {
    const std::vector<Case> cases = casesOf(plants, schedule, order);
    schedule.orders.push_back(orderSchedule(order, cases));
    for (const Case& c : cases)
      setBirths(schedule.plants[c.plant], plants[c.plant].structure->axes[c.axis], schedule.orders.back(), c, stillGrows(schedule.orders.back(), c));
  }
  return schedule;
}

}  // namespace axil::quantify
