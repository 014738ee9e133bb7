#include "quantify/schedule.hpp"

#include "quantify/ages.hpp"
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

double furthestOf(const std::vector<Case>& cases) {
  double furthest = 0;
  for (const Case& c : cases) furthest = std::max(furthest, c.stages);
  return furthest;
}

/// Whether a branch's first segment comes a stage after its bearer or together with it.
enum class Insertions { AStageLater, AtOnce };

bool isNewborn(const Axis& axis) { return axis.segments.size() == 1 && axis.laterals.empty(); }

/// Whether an axis has ended in a fork. What came together with its last segment is none.
bool forksAt(const PlantStructure& structure, const Axis& axis, Insertions insertions) {
  if (!axis.forks || insertions == Insertions::AStageLater) return axis.forks;
  return std::any_of(axis.laterals.begin(), axis.laterals.end(), [&](AxisId lateral) { return structure.at(lateral).bearer == axis.tip() && !isNewborn(structure.at(lateral)); });
}

/// The stage of a plant's newest segment.
double ageOf(const MeasuredPlant& plant, Insertions insertions) {
  double age = 0;
  for (std::size_t s = 0; s < plant.measurements->segments.size(); ++s)
    age = std::max(age, static_cast<double>(plant.measurements->segments[s].level - (insertions == Insertions::AtOnce ? plant.structure->places[s].order : 0)));
  return age;
}

std::vector<Case> casesOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order, Insertions insertions) {
  std::vector<Case> cases;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const std::vector<double> heights = heightsOf(*plants[p].measurements);
    for (std::size_t a = 0; a < plants[p].structure->axes.size(); ++a) {
      const Axis& axis = plants[p].structure->axes[a];
      if (axis.order != order) continue;
      cases.push_back({p, a, schedule.plants[p].now - bearersBirth(schedule.plants[p], axis), static_cast<double>(axis.segments.size()), heights[placeOf(axis.base())], forksAt(*plants[p].structure, axis, insertions)});
    }
  }
  return cases;
}

/// The log-likelihood of axes that make a segment a stage, `delay` stages late, each node ending its axis with the share that does. What is longer than it can
/// be is a slip.
constexpr double kSlip = 0.02;
double steadyLikelihood(const std::vector<Case>& cases, int delay) {
  double nodes = 0, ended = 0;
  for (const Case& c : cases) {
    const double possible = c.stages - delay;
    if (c.height > possible + 0.5) continue;
    nodes += std::min(c.height, possible - 1);
    ended += c.height < possible - 0.5 ? 1 : 0;
  }
  const double share = nodes > 0 ? std::clamp(ended / nodes, 1e-6, 1 - 1e-6) : 0.5;
  double log = 0;
  for (const Case& c : cases) {
    const double possible = c.stages - delay;
    if (c.height > possible + 0.5) log += std::log(kSlip);
    else if (c.height > possible - 0.5) log += std::max(0.0, possible - 1) * std::log(1 - share);
    else log += (c.height - 1) * std::log(1 - share) + std::log(share);
  }
  return log;
}

/// Of axes that make a segment with chance `rate` in each of their stages. Axes that have made none yet are not seen.
double rateLikelihood(const std::vector<Case>& cases, double rate, double lasting) {
  double log = 0;
  for (const Case& c : cases) {
    const double trials = std::max(1.0, std::round(std::min(c.stages, lasting)));
    const double made = std::min(c.segments, trials);
    if (c.segments > trials) log += std::log(kSlip);
    const double choices = std::lgamma(trials + 1) - std::lgamma(made + 1) - std::lgamma(trials - made + 1);
    log += choices + made * std::log(rate) + (trials - made) * std::log(1 - rate) - std::log(1 - std::pow(1 - rate, trials));
  }
  return log;
}

/// The rate of greatest likelihood, by golden section.
double likeliestRate(const std::vector<Case>& cases, double lasting) {
  constexpr double kGolden = 0.6180339887498949;
  double low = kSlowest, high = 0.999;
  for (int step = 0; step < 40; ++step) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (rateLikelihood(cases, a, lasting) < rateLikelihood(cases, b, lasting)) low = a;
    else high = b;
  }
  return (low + high) / 2;
}

std::vector<Case> unforked(const std::vector<Case>& cases) {
  std::vector<Case> result;
  for (const Case& c : cases)
    if (!c.forks && c.stages > 0) result.push_back(c);
  return result;
}

/// Steady growth with the delay that most axes keep to; none where too few do, or where growth by chance explains them better.
std::optional<int> steadyDelay(const std::vector<Case>& cases, int earliest) {
  double furthest = 0;
  for (const Case& c : cases) furthest = std::max(furthest, c.stages - c.height);
  std::optional<int> best;
  std::size_t most = 0;
  for (int delay = earliest; delay <= static_cast<int>(furthest); ++delay) {
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
  if (!best) return best;
  // Only axes that do not fork can say how fast they grow.
  const std::vector<Case> alone = unforked(cases);
  const bool telling = 2 * alone.size() > cases.size();
  constexpr double kClearly = 4;  // of the log-likelihood: steadiness is what plants without chance show
  if (telling && rateLikelihood(alone, likeliestRate(alone, furthestOf(alone)), furthestOf(alone)) > steadyLikelihood(alone, *best) + kClearly) return std::nullopt;
  return best;
}

/// How fast axes grow, and the stages after which older ones are no longer: the bend of segments = rate * min(stages, lasting), where it fits clearly better than no bend.
void setRate(OrderSchedule& order, const std::vector<Case>& all) {
  const std::vector<Case> cases = unforked(all);
  if (cases.empty()) return;
  order.rate = likeliestRate(cases, furthestOf(cases));
  const auto misfit = [&](double rate, double lasting) {
    double sum = 0;
    for (const Case& c : cases) sum += std::pow(c.segments - rate * std::min(c.stages, lasting), 2);
    return sum;
  };
  constexpr std::size_t kEnough = 8;
  if (cases.size() < kEnough) return;
  const double furthest = furthestOf(cases);
  double least = 0.6 * misfit(order.rate, furthest);
  for (double lasting = 1; lasting < 0.75 * furthest; lasting += 1) {
    double xy = 0, xx = 0;
    for (const Case& c : cases) {
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

/// Where growth is not steady, segments are spread evenly over an axis' stages, each axis a little before or after the others, so that a stage takes as many of them as it made.
void setBirths(PlantSchedule& plant, const Axis& axis, const OrderSchedule& order, const Case& c, bool grows) {
  constexpr double kGolden = 0.6180339887498949;
  const double before = bearersBirth(plant, axis);
  const double phase = std::fmod(0.5 + kGolden * static_cast<double>(c.axis), 1.0);
  for (std::size_t j = 0; j < axis.segments.size(); ++j) {
    const double own = static_cast<double>(j);
    const double after = order.steady ? 1 + order.delay + own : std::ceil((own + phase) / std::max(order.rate, c.segments / std::max(1.0, c.stages)));
    plant.birth[placeOf(axis.segments[j])] = std::min(plant.now, before + std::max(after, own + (order.delay < 0 ? 0 : 1)));
  }
  plant.grows[c.axis] = grows;
}

/// Steady growth that stops: nearly all axes have as many segments as stages since they began, or else one number, beyond which none goes.
struct Stopping {
  int delay = 0;
  double most = 0;
};
std::optional<Stopping> stoppingGrowth(const std::vector<Case>& cases, int earliest) {
  constexpr double kNearlyAll = 0.8;
  constexpr std::size_t kEnough = 8, kStopped = 3;
  std::optional<Stopping> best;
  std::size_t most = 0;
  if (cases.size() < kEnough) return best;
  for (double last = 1; last < furthestOf(cases); last += 1)
    for (int delay = earliest; delay + last < furthestOf(cases); ++delay) {
      std::size_t matching = 0, tooLong = 0, stopped = 0;
      for (const Case& c : cases) {
        const double possible = std::min(c.stages - delay, last);
        tooLong += c.segments > possible + 0.5 ? 1 : 0;
        matching += std::abs(c.segments - possible) < 0.5 ? 1 : 0;
        stopped += c.stages - delay > last + 0.5 ? 1 : 0;
      }
      if (stopped < kStopped || matching <= most) continue;
      if (static_cast<double>(tooLong) > kTooLong * static_cast<double>(cases.size()) || static_cast<double>(matching) < kNearlyAll * static_cast<double>(cases.size())) continue;
      most = matching;
      best = Stopping{delay, last};
    }
  return best;
}

OrderSchedule orderSchedule(int order, const std::vector<Case>& cases, int earliest) {
  OrderSchedule result;
  result.order = order;
  result.axes = cases.size();
  if (order == 0) return result;
  const auto delay = steadyDelay(cases, earliest);
  result.steady = delay.has_value();
  if (delay) {
    result.delay = *delay;
  } else if (const auto stopping = stoppingGrowth(cases, earliest)) {
    result.steady = true;
    result.delay = stopping->delay;
    result.lasting = stopping->most + stopping->delay;
  } else {
    setRate(result, cases);
  }
  return result;
}

bool stillGrows(const OrderSchedule& order, const Case& c) {
  if (c.forks) return false;
  if (order.steady) return c.segments + 0.5 > c.stages - order.delay && (!order.lasting || c.stages < *order.lasting);
  return !order.lasting || c.stages < *order.lasting;
}

/// Whether first axes bear branches of one segment at their very tips, and go on past others: such came with the segments they stand on.
bool branchesComeAtOnce(std::span<const MeasuredPlant> plants) {
  constexpr int kFewest = 3;
  int atTips = 0, passed = 0;
  for (const MeasuredPlant& plant : plants) {
    const PlantStructure& structure = *plant.structure;
    const Axis& first = structure.axes.front();
    bool here = false;
    for (const AxisId lateral : first.laterals) {
      const Axis& branch = structure.at(lateral);
      const bool atTip = branch.bearer == first.tip();
      if (atTip && !isNewborn(branch)) return false;
      here = here || atTip;
      passed += atTip ? 0 : 1;
    }
    atTips += here ? 1 : 0;
  }
  return atTips >= kFewest && passed >= atTips;
}

/// What a plant shows of its age: of sympodial plants all axes are of one kind.
ShownAge shownAgeOf(const MeasuredPlant& plant, double now, Insertions insertions, bool sympodial) {
  ShownAge age;
  age.now = now;
  for (const Axis& axis : plant.structure->axes) {
    ShownAge::Kind& kind = age.kinds[axis.order == 0 || sympodial ? 0 : 1];
    const Segment& tip = plant.measurements->at(axis.tip());
    const double stage = tip.level - (insertions == Insertions::AtOnce ? axis.order : 0);
    const bool forks = forksAt(*plant.structure, axis, insertions);
    const bool newest = !forks && stage + 0.5 > now;
    kind.newest += newest ? 1 : 0;
    kind.ended += !newest && !forks ? 1 : 0;
    kind.nodes += static_cast<double>(axis.segments.size()) - (newest ? 1 : 0);
  }
  return age;
}

/// Where half of the ages and more are one and none is greater, clearly smaller ones are taken to be the same.
std::vector<double> mostlyOneAge(std::vector<double> ages) {
  constexpr std::size_t kFewest = 5;
  if (ages.size() < kFewest) return ages;
  const double oldest = *std::max_element(ages.begin(), ages.end());
  if (2 * static_cast<std::size_t>(std::count(ages.begin(), ages.end(), oldest)) < ages.size()) return ages;
  for (double& age : ages) age = age + 1.5 < oldest ? oldest : age;
  return ages;
}

/// Plants in which everything has ended are older than they show. Sympodial plants of a few modules end often, but have few nodes to tell it by: there most plants' age stands for all.
void setAges(Schedule& schedule, std::span<const MeasuredPlant> plants, Insertions insertions) {
  const auto forking = std::count_if(plants.begin(), plants.end(), [](const MeasuredPlant& p) { return p.structure->branching == Branching::Sympodial; });
  const bool sympodial = 2 * static_cast<std::size_t>(forking) >= plants.size();
  std::vector<ShownAge> shown;
  for (const MeasuredPlant& plant : plants) shown.push_back(shownAgeOf(plant, ageOf(plant, insertions), insertions, sympodial));
  const std::vector<double> ages = sympodial ? mostlyOneAge(agesOf(shown)) : agesOf(shown);
  for (std::size_t p = 0; p < plants.size(); ++p) schedule.plants[p].now = ages[p];
}

}  // namespace

const OrderSchedule& Schedule::of(int order) const {
  return orders[static_cast<std::size_t>(std::clamp(order, 0, static_cast<int>(orders.size()) - 1))];
}

Schedule scheduleOf(std::span<const MeasuredPlant> plants) {
  Schedule schedule;
  schedule.branchesAtOnce = branchesComeAtOnce(plants);
  const Insertions insertions = schedule.branchesAtOnce ? Insertions::AtOnce : Insertions::AStageLater;
  int orders = 0;
  for (const MeasuredPlant& plant : plants) {
    PlantSchedule own;
    own.birth.assign(plant.measurements->segments.size(), 0);
    own.grows.assign(plant.structure->axes.size(), false);
    schedule.plants.push_back(std::move(own));
    orders = std::max(orders, plant.structure->orders);
  }
  setAges(schedule, plants, insertions);
  for (int order = 0; order < orders; ++order) {
    const std::vector<Case> cases = casesOf(plants, schedule, order, insertions);
    schedule.orders.push_back(orderSchedule(order, cases, insertions == Insertions::AtOnce ? -1 : 0));
    for (const Case& c : cases)
      setBirths(schedule.plants[c.plant], plants[c.plant].structure->axes[c.axis], schedule.orders.back(), c, stillGrows(schedule.orders.back(), c));
  }
  return schedule;
}

}  // namespace axil::quantify
