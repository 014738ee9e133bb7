#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace axil::quantify {

namespace {

constexpr std::size_t kJudges = 3;
constexpr double kMostWeight = 100;      // segments: axes that do not differ
constexpr double kClearCurve = 3;        // standard errors that a curve must have
constexpr std::size_t kCurveSamples = 20;
constexpr double kSlightlyBetter = 0.98;
constexpr double kClearlyBetter = 0.95;
constexpr double kFading = 0.5;          // of a miss' weight, by rank from the tip

using Axes = std::vector<AxisLengths>;

Axes axesOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order) {
  Axes axes;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (const Axis& axis : plants[p].structure->axes)
      if (axis.order == order) axes.push_back(lengthsOf(plants[p], schedule.plants[p], axis));
  return axes;
}

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

double pairsBelow(double rank) { return rank * (rank - 1) / 2; }

/// The line along the rank that layers.hpp has.
OrderCourse straightCourse(const OrderLayer& layer, std::size_t axes) {
  const Trend& trend = layer.trend;
  OrderCourse course;
  course.start = trend.start;
  course.step = trend.clear() ? trend.slope : 0;
  course.stepError = trend.slopeError;
  // Axes of one segment say nothing of levels.
  if (layer.estimate.samples > axes) course.weight = std::min(kMostWeight, std::pow(trend.residual / std::max(trend.axisDeviation, 1e-9), 2));
  return course;
}

/// Sums of weighted products within axes, of rank (r), pairs below (q) and logarithm (y).
struct Products {
  double rr = 0, rq = 0, qq = 0, ry = 0, qy = 0;
};

/// A step that itself changes evenly from rank to rank: least squares within axes, in which misses beyond 2 deviations count less. None where it is no more than chance.
std::optional<OrderCourse> curvedCourse(const Axes& axes, LengthsAlong along) {
  std::size_t samples = 0, freedom = 0;
  for (const AxisLengths& axis : axes) {
    samples += axis.logs.size();
    freedom += axis.logs.size() - 1;
  }
  if (samples < kCurveSamples || freedom < kCurveSamples / 2) return std::nullopt;
  OrderCourse course;
  course.along = along;
  double reach = std::numeric_limits<double>::infinity(), curveError = 0;
  for (int round = 0; round < 5; ++round) {
    Products sum;
    std::vector<double> offs;
    for (const AxisLengths& axis : axes) {
      const std::vector<double>& logs = axis.logs;
      const double own = course.levelOf(axis, logs.size());
      double w = 0, r = 0, q = 0, y = 0;
      const auto weightOf = [&](std::size_t i) { return std::min(1.0, reach / std::max(1e-12, std::abs(logs[i] - course.at(course.placeOf(axis, i)) - own))); };
      const auto each = [&](const std::function<void(double, double, double, double)>& visit) {
        for (std::size_t i = 0; i < logs.size(); ++i) visit(weightOf(i), course.placeOf(axis, i), pairsBelow(course.placeOf(axis, i)), logs[i]);
      };
      each([&](double weight, double ri, double qi, double yi) { w += weight, r += weight * ri, q += weight * qi, y += weight * yi; });
      r /= w, q /= w, y /= w;
      each([&](double weight, double ri, double qi, double yi) {
        sum.rr += weight * (ri - r) * (ri - r), sum.rq += weight * (ri - r) * (qi - q), sum.qq += weight * (qi - q) * (qi - q);
        sum.ry += weight * (ri - r) * (yi - y), sum.qy += weight * (qi - q) * (yi - y);
      });
    }
    const double determinant = sum.rr * sum.qq - sum.rq * sum.rq;
    if (determinant <= 1e-9 * sum.rr * sum.qq) return std::nullopt;
    course.start = 0;
    course.step = (sum.ry * sum.qq - sum.qy * sum.rq) / determinant;
    course.curve = (sum.qy * sum.rr - sum.ry * sum.rq) / determinant;
    double squares = 0;
    std::vector<double> levels;
    for (const AxisLengths& axis : axes) {
      levels.push_back(course.levelOf(axis, axis.logs.size()));
      for (std::size_t i = 0; i < axis.logs.size(); ++i) {
        offs.push_back(std::abs(axis.logs[i] - course.at(course.placeOf(axis, i)) - levels.back()));
        squares += offs.back() * offs.back();
      }
    }
    const double deviation = std::sqrt(squares / static_cast<double>(freedom));
    reach = std::max(2 * 1.4826 * medianOf(offs), 1e-9);
    course.stepError = deviation * std::sqrt(sum.qq / determinant);
    course.curveError = curveError = deviation * std::sqrt(sum.rr / determinant);
    course.bothErrors = -deviation * deviation * sum.rq / determinant;
    const Centre centre = centreOf(levels);
    course.weight = std::min(kMostWeight, std::pow(deviation / std::max(centre.deviation, 1e-9), 2));
    if (round == 4) course.start = centre.value;
  }
  return std::abs(course.curve) > kClearCurve * curveError ? std::optional(course) : std::nullopt;
}

/// What counts less the further below its axis' tip it is.
double recency(const AxisLengths& axis, std::size_t rank) { return std::pow(kFading, static_cast<double>(axis.logs.size() - 1 - rank)); }

/// How well a rule foretells the measured lengths: the deviation of its misses as they are, and as they would be for an axis whose level is known; and
/// that of the youngest.
struct Judgement {
  double miss = 0;
  double alike = 0;
  std::size_t samples = 0;
  double recent = 0;
  double recentSamples = 0;
};
Judgement judged(LengthRule rule, const OrderCourse& course, const Axes& axes) {
  std::vector<double> misses, alike;
  double weights = 0, squares = 0;
  for (const AxisLengths& axis : axes)
    for (std::size_t r = 1; r < axis.logs.size(); ++r) {
      misses.push_back(axis.logs[r] - foretold(rule, axis, r, course));
      alike.push_back(misses.back() / levelDoubt(rule, r, course));
      weights += recency(axis, r);
      squares += recency(axis, r) * alike.back() * alike.back();
    }
  return {deviationOf(misses), deviationOf(alike), misses.size(), weights > 0 ? std::sqrt(squares / weights) : 0, weights};
}

/// By how much a variance told by so many samples is off by chance, twice over.
double byChance(double samples) { return 2 * std::sqrt(2 / samples); }

/// What is usual from segment to segment among the youngest.
double recentStep(const Axes& axes) {
  double sum = 0, weights = 0;
  for (const AxisLengths& axis : axes)
    for (std::size_t r = 1; r < axis.logs.size(); ++r) {
      sum += recency(axis, r) * (axis.logs[r] - axis.logs[r - 1]);
      weights += recency(axis, r);
    }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

AxisLengths lengthsOf(const MeasuredPlant& plant, const PlantSchedule& schedule, const Axis& axis) {
  AxisLengths lengths;
  for (const SegmentId s : axis.segments) lengths.logs.push_back(std::log(plant.measurements->at(s).length));
  lengths.begun = schedule.birth[static_cast<std::size_t>(axis.base().value)];
  return lengths;
}

double OrderCourse::at(double place) const { return start + step * place + curve * pairsBelow(place); }

double OrderCourse::levelOf(const AxisLengths& axis, std::size_t count) const {
  double off = 0;
  for (std::size_t i = 0; i < count; ++i) off += axis.logs[i] - at(placeOf(axis, i));
  return count == 0 ? 0 : off / static_cast<double>(count);
}

double OrderCourse::levelAt(const AxisLengths& axis, std::size_t count, std::size_t rank) const {
  const double known = static_cast<double>(count);
  return at(placeOf(axis, rank)) + levelOf(axis, count) * known / (known + weight);
}

double foretold(LengthRule rule, const AxisLengths& axis, std::size_t below, const OrderCourse& course) {
  const double place = course.placeOf(axis, below);
  if (rule == LengthRule::Last && below > 0) return axis.logs[below - 1] + course.at(place) - course.at(place - 1);
  if (rule == LengthRule::Axis && below > 0) return course.levelAt(axis, below, below);
  return course.at(place);
}

double doubtOf(const LengthOutlook& length, std::size_t below, const OrderCourse& course) {
  const double scatter = length.miss * levelDoubt(length.rule, below, course);
  if (length.rule == LengthRule::Last) return scatter;
  // What comes next lies further on than the middle of what is known.
  const double count = static_cast<double>(below);
  const double r = (count + 1) / 2;
  double q = pairsBelow(count);
  for (std::size_t i = 0; i < below; ++i) q -= pairsBelow(static_cast<double>(i)) / count;
  const double variance = r * r * course.stepError * course.stepError + q * q * course.curveError * course.curveError + 2 * r * q * course.bothErrors;
  return std::sqrt(scatter * scatter + std::max(0.0, variance));
}

OrderCourse setLength(OrderOutlook& o, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics) {
  const OrderLayer& layer = *statistics.of(Quantity::Length).order(o.order);
  const QuantityLayers& ratios = statistics.of(Quantity::LengthRatio);
  const Axes axes = axesOf(plants, statistics.schedule, o.order);
  o.segments = layer.estimate.samples;
  OrderCourse best = straightCourse(layer, o.schedule.axes);
  Judgement least{.miss = std::numeric_limits<double>::infinity()};
  const auto take = [&](LengthRule rule, const OrderCourse& course, const Judgement& judgement) {
    least = judgement;
    best = course;
    o.length = {rule, course.along, std::exp(course.step), std::exp(course.curve), judgement.alike, judgement.samples};
  };
  const auto consider = [&](LengthRule rule, const OrderCourse& course, double better) {
    const Judgement judgement = judged(rule, course, axes);
    // A later rule must be better by more than rounding; where too few misses judge, the segment below it is.
    if (judgement.samples >= kJudges && judgement.miss >= better * least.miss) return;
    if (judgement.samples < kJudges && rule != LengthRule::Last) return;
    take(rule, course, judgement);
  };
  const OrderCourse straight = best;
  consider(LengthRule::Trend, straight, kSlightlyBetter);
  consider(LengthRule::Axis, straight, kSlightlyBetter);
  OrderCourse last = straight;
  last.step = ratios.all.samples > 0 ? std::log(ratios.nearest(o.order).value) : 0;
  consider(LengthRule::Last, last, kSlightlyBetter);
  // An order that stops after its stages loses count of them.
  for (const LengthsAlong along : {LengthsAlong::Rank, LengthsAlong::Stage}) {
    const auto curved = along == LengthsAlong::Stage && o.schedule.lasting ? std::nullopt : curvedCourse(axes, along);
    if (!curved) continue;
    consider(LengthRule::Trend, *curved, kClearlyBetter);
    consider(LengthRule::Axis, *curved, kSlightlyBetter);
    consider(LengthRule::Last, *curved, kSlightlyBetter);
  }
  // Where the youngest have left what all follow, they go on as they do among themselves, or stay as they are.
  for (const double step : {recentStep(axes), 0.0}) {
    OrderCourse recent = straight;
    recent.step = step;
    const Judgement judgement = judged(LengthRule::Last, recent, axes);
    if (std::pow(judgement.recent / least.recent, 2) < 1 - byChance(judgement.recentSamples)) take(LengthRule::Last, recent, judgement), o.length.miss = judgement.recent;
  }
  if (std::pow(least.recent / o.length.miss, 2) > 1 + byChance(least.recentSamples)) o.length.miss = least.recent;
  // Levels are told by the order's course; only what goes on from the segment below has a step of its own.
  OrderCourse course = o.length.rule == LengthRule::Last ? straight : best;
  if (o.length.rule == LengthRule::Last && best.curve != 0) course = best;
  o.usualLength = std::exp(course.start);
  return course;
}

}  // namespace axil::quantify
