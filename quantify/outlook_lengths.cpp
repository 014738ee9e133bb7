#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace axil::quantify {

namespace {

constexpr std::size_t kJudges = 3;
constexpr double kSlightlyBetter = 0.98;
constexpr double kClearlyBetter = 0.95;
constexpr double kFading = 0.6;          // of what the young tell, by stage
constexpr std::size_t kHindsight = 2;    // youngest segments of each axis that are foretold again from what is below them
constexpr std::size_t kFewHindsights = 8;
constexpr double kExact = 1e-6;          // misses of rounding alone

double deviationOf(std::span<const double> misses) {
  if (misses.empty()) return 0;
  double sum = 0;
  for (const double m : misses) sum += m * m;
  return std::sqrt(sum / static_cast<double>(misses.size()));
}

/// By how much an axis' own level, told by so many segments, adds to a miss.
double levelDoubt(LengthRule rule, std::size_t below, const OrderCourse& course) {
  return rule == LengthRule::Axis ? std::sqrt(1 + 1 / (static_cast<double>(below) + course.weight)) : 1;
}

/// How well a rule foretells the measured lengths: the deviation of its misses as they are, and as they would be for an axis whose level is known.
struct Judgement {
  double miss = 0;
  double alike = 0;
  std::size_t samples = 0;
};
Judgement judged(LengthRule rule, const OrderCourse& course, const Axes& axes) {
  std::vector<double> misses, alike;
  for (const AxisLengths& axis : axes)
    for (std::size_t r = 1; r < axis.logs.size(); ++r) {
      misses.push_back(axis.logs[r] - foretold(rule, axis, r, course));
      alike.push_back(misses.back() / levelDoubt(rule, r, course));
    }
  return {deviationOf(misses), deviationOf(alike), misses.size()};
}

/// A way to foretell lengths, and what it made of the axes.
struct Candidate {
  LengthRule rule = LengthRule::Trend;
  OrderCourse course;
  double better = 1;      ///< what share of the misses of those before it it may have at most
};

OrderCourse stepped(OrderCourse course, double step) {
  course.step = step;
  course.doubt = {};
  return course;
}

/// What is usual from segment to segment among the youngest.
double recentStep(const Axes& axes) {
  double sum = 0, weights = 0;
  for (const AxisLengths& axis : axes)
    for (std::size_t r = 1; r < axis.logs.size(); ++r) {
      const double w = axis.faded(r, kFading);
      sum += w * (axis.logs[r] - axis.logs[r - 1]);
      weights += w;
    }
  return weights > 0 ? sum / weights : 0;
}

/// Courses along which all of the axes run. An order that stops after its stages loses count of them.
std::vector<Candidate> lastingCandidates(const Axes& axes, const SharedBows& shared, const OrderCourse& straight, double usualStep, bool countsStages) {
  std::vector<Candidate> all{{LengthRule::Trend, straight, kSlightlyBetter}, {LengthRule::Axis, straight, kSlightlyBetter}, {LengthRule::Last, stepped(straight, usualStep), kSlightlyBetter}};
  for (const LengthsAlong along : {LengthsAlong::Rank, LengthsAlong::Stage}) {
    if (along == LengthsAlong::Stage && !countsStages) continue;
    const auto bowed = bowedCourse(axes, along, shared);
    const auto bent = bowed ? bowed : curvedCourse(axes, along, 1);
    if (!bent) continue;
    all.push_back({LengthRule::Trend, *bent, kClearlyBetter});
    all.push_back({LengthRule::Axis, *bent, kSlightlyBetter});
    all.push_back({LengthRule::Last, *bent, kSlightlyBetter});
  }
  return all;
}

/// What the youngest do among themselves, whatever was below.
std::vector<Candidate> recentCandidates(const Axes& axes, const OrderCourse& straight, bool countsStages) {
  std::vector<Candidate> all{{LengthRule::Last, stepped(straight, 0)}, {LengthRule::Last, stepped(straight, recentStep(axes))}};
  for (const LengthsAlong along : {LengthsAlong::Rank, LengthsAlong::Stage}) {
    if (along == LengthsAlong::Stage && !countsStages) continue;
    if (const auto curved = curvedCourse(axes, along, kFading)) all.push_back({LengthRule::Last, *curved});
  }
  return all;
}

/// Made in one way of different axes.
bool alike(const Candidate& a, const Candidate& b) { return a.rule == b.rule && a.course.along == b.course.along && a.course.bends() == b.course.bends(); }

/// The line along the rank of those axes alone, and the step from each segment to the next.
std::pair<OrderCourse, double> straightOf(const Axes& axes) {
  std::vector<Sample> samples;
  std::vector<std::size_t> axisOf;
  std::vector<double> steps;
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t r = 0; r < axes[a].logs.size(); ++r) {
      samples.push_back({0, 0, static_cast<int>(r), axes[a].logs[r]});
      axisOf.push_back(a);
      if (r > 0) steps.push_back(axes[a].logs[r] - axes[a].logs[r - 1]);
    }
  return {straightCourse(trendOf(samples, axisOf, false), samples.size(), axes.size()), centreOf(steps).value};
}

/// Axes without their last `count` segments; those of no more are gone.
Axes withoutLast(const Axes& axes, std::size_t count) {
  Axes cut;
  for (const AxisLengths& axis : axes) {
    if (axis.logs.size() <= count) continue;
    cut.push_back(axis);
    cut.back().logs.resize(axis.logs.size() - count);
  }
  return cut;
}

/// Misses of the youngest segments of axes that grow, each foretold from courses fitted to what is below it: of what `chosen` would have been, and of each recent candidate.
struct Hindsight {
  std::size_t samples = 0;
  double chosen = 0;
  std::vector<double> recent;   ///< infinite where it would not have been there
};
Hindsight hindsightOf(const Axes& axes, const std::vector<SharedBows>& shared, const Candidate& chosen, const std::vector<Candidate>& recent, bool countsStages) {
  std::vector<double> own;
  std::vector<std::vector<double>> others(recent.size());
  for (std::size_t back = 1; back <= kHindsight; ++back) {
    const Axes below = withoutLast(axes, back);
    if (below.empty()) break;
    const auto [straight, step] = straightOf(below);
    const std::vector<Candidate> lasting = lastingCandidates(below, shared[back], straight, step, countsStages), young = recentCandidates(below, straight, countsStages);
    const auto missesOf = [&](const std::vector<Candidate>& all, std::vector<Candidate>::const_iterator found) {
      std::vector<double> misses;
      if (found == all.end()) return misses;
      for (const AxisLengths& axis : axes)
        if (const std::size_t known = axis.logs.size() - std::min(back, axis.logs.size()); known > 0 && axis.rests < 1)
          misses.push_back((axis.logs[known] - foretold(found->rule, axis, known, found->course)) / levelDoubt(found->rule, known, found->course));
      return misses;
    };
    const auto append = [](std::vector<double>& to, const std::vector<double>& more) { to.insert(to.end(), more.begin(), more.end()); };
    append(own, missesOf(lasting, std::find_if(lasting.begin(), lasting.end(), [&](const Candidate& c) { return alike(c, chosen); })));
    // The first two, of no step and of a recent one, are always there.
    for (std::size_t i = 0; i < recent.size(); ++i)
      append(others[i], missesOf(young, i < 2 ? young.begin() + static_cast<std::ptrdiff_t>(i) : std::find_if(young.begin() + 2, young.end(), [&](const Candidate& c) { return alike(c, recent[i]); })));
  }
  Hindsight result{own.size(), deviationOf(own), {}};
  for (const auto& misses : others) result.recent.push_back(misses.size() == own.size() ? deviationOf(misses) : std::numeric_limits<double>::infinity());
  return result;
}

}  // namespace

double doubtOf(const LengthOutlook& length, const AxisLengths& axis, const OrderCourse& course) {
  const std::size_t below = axis.logs.size();
  const double scatter = length.miss * levelDoubt(length.rule, below, course);
  // What comes next lies further on than what it is told by: the middle of what is known, or the last of it.
  auto [first, second] = course.slopes(course.placeOf(axis, below));
  const std::size_t from = length.rule == LengthRule::Last ? below - 1 : 0;
  for (std::size_t i = from; i < below; ++i) {
    const auto [a, b] = course.slopes(course.placeOf(axis, i));
    first -= a / static_cast<double>(below - from);
    second -= b / static_cast<double>(below - from);
  }
  const double variance = first * first * course.doubt.first + second * second * course.doubt.second + 2 * first * second * course.doubt.both;
  return std::sqrt(scatter * scatter + std::max(0.0, variance));
}

std::map<int, Axes> axesByOrder(std::span<const MeasuredPlant> plants, const Schedule& schedule) {
  std::map<int, Axes> axes;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (const Axis& axis : plants[p].structure->axes) axes[axis.order].push_back(lengthsOf(plants[p], schedule.plants[p], axis));
  return axes;
}

std::vector<SharedBows> sharedBowsBack(const std::map<int, Axes>& axes) {
  Axes all;
  for (const auto& [order, own] : axes) all.insert(all.end(), own.begin(), own.end());
  std::vector<SharedBows> shared;
  for (std::size_t back = 0; back <= kHindsight; ++back) shared.push_back(sharedBows(withoutLast(all, back)));
  return shared;
}

OrderCourse setLength(OrderOutlook& o, const Axes& axes, const std::vector<SharedBows>& shared, const LayeredStatistics& statistics) {
  const OrderLayer& layer = *statistics.of(Quantity::Length).order(o.order);
  const QuantityLayers& ratios = statistics.of(Quantity::LengthRatio);
  const bool countsStages = !o.schedule.lasting;
  o.segments = layer.estimate.samples;
  const OrderCourse straight = straightCourse(layer.trend, layer.estimate.samples, o.schedule.axes);
  const double usualStep = ratios.all.samples > 0 ? std::log(ratios.nearest(o.order).value) : 0;

  Candidate best{LengthRule::Trend, straight};
  Judgement least{.miss = std::numeric_limits<double>::infinity()};
  for (const Candidate& candidate : lastingCandidates(axes, shared.front(), straight, usualStep, countsStages)) {
    const Judgement judgement = judged(candidate.rule, candidate.course, axes);
    // A later rule must be better by more than rounding; where too few misses judge, the segment below it is.
    if (judgement.samples >= kJudges && judgement.miss >= candidate.better * least.miss) continue;
    if (judgement.samples < kJudges && candidate.rule != LengthRule::Last) continue;
    least = judgement;
    best = candidate;
  }
  // Where that would have foretold the youngest clearly worse than they do each other, they go on among themselves.
  const std::vector<Candidate> recent = recentCandidates(axes, straight, countsStages);
  const Hindsight hindsight = hindsightOf(axes, shared, best, recent, countsStages);
  if (hindsight.samples >= kFewHindsights && hindsight.chosen > kExact) {
    const double byChance = 2 * std::sqrt(2 / static_cast<double>(hindsight.samples));
    const auto leastRecent = std::min_element(hindsight.recent.begin(), hindsight.recent.end());
    if (std::pow(*leastRecent / hindsight.chosen, 2) < 1 - byChance) {
      best = recent[static_cast<std::size_t>(leastRecent - hindsight.recent.begin())];
      least.alike = *leastRecent;
    } else if (std::pow(hindsight.chosen / least.alike, 2) > 1 + byChance) {
      least.alike = hindsight.chosen;
    }
  }
  o.length = {best.rule, best.course.along, std::exp(best.course.step), std::exp(best.course.curve), best.course.bow, least.alike, least.samples};
  // Levels are told by the order's course; only what goes on from the segment below has a step of its own.
  const OrderCourse course = best.rule == LengthRule::Last && !best.course.bends() ? straight : best.course;
  o.usualLength = std::exp(course.start);
  return course;
}

}  // namespace axil::quantify
