#pragma once
/// \file
/// The parts of an outlook that are worked out apart. Private to this room.

#include "quantify/outlook.hpp"

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace axil::quantify {

/// An axis' lengths from its base, as logarithms.
struct AxisLengths {
  std::vector<double> logs;
  double begun = 0;     ///< stage of the first
  double rests = 0;     ///< stages since the last
  /// What counts by `fading` a stage since it was made.
  [[nodiscard]] double faded(std::size_t rank, double fading) const;
};
[[nodiscard]] AxisLengths lengthsOf(const MeasuredPlant& plant, const PlantSchedule& schedule, const Axis& axis);

/// How lengths of one order run along an axis: from the order's start with a step a rank (or a stage of the plant), which changes by `curve` a rank; an axis' own level
/// counts by how many segments tell it, against `weight`.
struct OrderCourse {
  LengthsAlong along = LengthsAlong::Rank;
  double start = 0;     ///< logarithms
  double step = 0;
  double curve = 0;
  double weight = 100;  ///< of the order, in segments
  double stepError = 0, curveError = 0;
  double bothErrors = 0;  ///< covariance of the two
  /// Where the segment of that rank stands on the course.
  [[nodiscard]] double placeOf(const AxisLengths& axis, std::size_t rank) const { return static_cast<double>(rank) + (along == LengthsAlong::Stage ? axis.begun : 0); }
  [[nodiscard]] double at(double place) const;
  /// By how much the first `count` segments of an axis lie above the course, on average.
  [[nodiscard]] double levelOf(const AxisLengths& axis, std::size_t count) const;
  /// The length at `rank` by those.
  [[nodiscard]] double levelAt(const AxisLengths& axis, std::size_t count, std::size_t rank) const;
};

/// The line along the rank that layers.hpp has, told by so many samples on so many axes.
[[nodiscard]] OrderCourse straightCourse(const Trend& trend, std::size_t samples, std::size_t axes);
/// A step that itself changes evenly from rank to rank: least squares within axes, in which misses beyond 2 deviations count less, and what is below the tip by
/// `fading` a rank. None where it is no more than chance.
[[nodiscard]] std::optional<OrderCourse> curvedCourse(std::span<const AxisLengths> axes, LengthsAlong along, double fading);

/// Foretells the next segment of an axis from its first `below`.
[[nodiscard]] double foretold(LengthRule rule, const AxisLengths& axis, std::size_t below, const OrderCourse& course);
/// Of the logarithm of a next length: its scatter, the doubt about the axis' level, and that about the order's steps on the way there.
[[nodiscard]] double doubtOf(const LengthOutlook& length, std::size_t below, const OrderCourse& course);
/// Sets by which rule an order's lengths are foretold; returns how its lengths run.
[[nodiscard]] OrderCourse setLength(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

/// Sets how new axes of every order begin, and the arms of forks. `courses` by order. For sympodial plants adds the order that comes above.
void setStarts(Outlook& outlook, std::span<const MeasuredPlant> plants, const std::map<int, OrderCourse>& courses);

/// Sets how leaves stand, grow and fall on an order.
void setLeaves(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

}  // namespace axil::quantify
