#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace axil::quantify {

namespace {

constexpr double kClearCurve = 3;        // standard errors that a curve must have
constexpr std::size_t kCurveSamples = 12;

double pairsBelow(double rank) { return rank * (rank - 1) / 2; }

/// Sums of weighted products within axes, of rank (r), pairs below (q) and logarithm (y).
struct Products {
  double rr = 0, rq = 0, qq = 0, ry = 0, qy = 0;
};

}  // namespace

OrderCourse straightCourse(const Trend& trend, std::size_t samples, std::size_t axes) {
  OrderCourse course;
  course.start = trend.start;
  course.step = trend.clear() ? trend.slope : 0;
  course.doubt.first = trend.slopeError * trend.slopeError;
  // Axes of one segment say nothing of levels.
  if (samples > axes) course.weight = std::min(kMostWeight, std::pow(trend.residual / std::max(trend.axisDeviation, 1e-9), 2));
  return course;
}

std::optional<OrderCourse> curvedCourse(std::span<const AxisLengths> axes, LengthsAlong along, double fading) {
  std::size_t samples = 0, freedom = 0;
  for (const AxisLengths& axis : axes) {
    samples += axis.logs.size();
    freedom += axis.logs.size() - 1;
  }
  if (samples < kCurveSamples || freedom < kCurveSamples / 2) return std::nullopt;
  OrderCourse course;
  course.along = along;
  double reach = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 5; ++round) {
    Products sum;
    std::vector<double> offs;
    for (const AxisLengths& axis : axes) {
      const std::vector<double>& logs = axis.logs;
      const double own = course.levelOf(axis, logs.size());
      double w = 0, r = 0, q = 0, y = 0;
      const auto weightOf = [&](std::size_t i) { return axis.faded(i, fading) * std::min(1.0, reach / std::max(1e-12, std::abs(logs[i] - course.at(course.placeOf(axis, i)) - own))); };
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
    double squares = 0, weights = 0;
    std::vector<double> levels;
    for (const AxisLengths& axis : axes) {
      levels.push_back(course.levelOf(axis, axis.logs.size()));
      for (std::size_t i = 0; i < axis.logs.size(); ++i) {
        offs.push_back(std::abs(axis.logs[i] - course.at(course.placeOf(axis, i)) - levels.back()));
        weights += axis.faded(i, fading);
        squares += axis.faded(i, fading) * offs.back() * offs.back();
      }
    }
    const double deviation = std::sqrt(squares / weights * static_cast<double>(samples) / static_cast<double>(freedom));
    reach = std::max(2 * 1.4826 * medianOf(offs), 1e-9);
    const double variance = deviation * deviation;
    course.doubt = {variance * sum.qq / determinant, variance * sum.rr / determinant, -variance * sum.rq / determinant};
    const Centre centre = centreOf(levels);
    course.weight = std::min(kMostWeight, std::pow(deviation / std::max(centre.deviation, 1e-9), 2));
    if (round == 4) course.start = centre.value;
  }
  return std::abs(course.curve) > kClearCurve * std::sqrt(course.doubt.second) ? std::optional(course) : std::nullopt;
}

AxisLengths lengthsOf(const MeasuredPlant& plant, const PlantSchedule& schedule, const Axis& axis) {
  AxisLengths lengths;
  for (const SegmentId s : axis.segments) lengths.logs.push_back(std::log(plant.measurements->at(s).length));
  lengths.begun = schedule.birth[static_cast<std::size_t>(axis.base().value)];
  lengths.rests = std::max(0.0, schedule.now - schedule.birth[static_cast<std::size_t>(axis.tip().value)]);
  return lengths;
}

double AxisLengths::faded(std::size_t rank, double fading) const { return fading == 1 ? 1 : std::pow(fading, rests + static_cast<double>(logs.size() - 1 - rank)); }

double OrderCourse::at(double place) const { return start + (bow ? bow->at(place) : step * place + curve * pairsBelow(place)); }

std::pair<double, double> OrderCourse::slopes(double place) const {
  if (!bow) return {place, pairsBelow(place)};
  constexpr double kPart = 1e-4;
  const double pace = kPart * std::abs(bow->pace);
  const auto difference = [place](const Bow& more, const Bow& less, double apart) { return (more.at(place) - less.at(place)) / apart; };
  Bow quicker = *bow, slower = *bow, later = *bow, earlier = *bow;
  quicker.pace += pace, slower.pace -= pace, later.middle += kPart, earlier.middle -= kPart;
  return {difference(quicker, slower, 2 * pace), difference(later, earlier, 2 * kPart)};
}

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

}  // namespace axil::quantify
