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

inline constexpr double kMostWeight = 100;  // segments: of axes that do not differ

/// How lengths of one order run along an axis: from the order's start with a step a rank (or a stage of the plant), which changes by `curve` a rank, or on a bow; an axis' own level
/// counts by how many segments tell it, against `weight`.
struct OrderCourse {
  LengthsAlong along = LengthsAlong::Rank;
  double start = 0;     ///< logarithms
  double step = 0;
  double curve = 0;
  std::optional<Bow> bow;        ///< instead of step and curve
  double weight = kMostWeight;   ///< of the order, in segments
  /// Variances and covariance of the course's two numbers: step and curve, or the bow's pace and middle.
  struct Doubt {
    double first = 0, second = 0, both = 0;
  } doubt;
  /// Where the segment of that rank stands on the course.
  [[nodiscard]] double placeOf(const AxisLengths& axis, std::size_t rank) const { return static_cast<double>(rank) + (along == LengthsAlong::Stage ? axis.begun : 0); }
  [[nodiscard]] double at(double place) const;
  /// How its value there changes with its two numbers.
  [[nodiscard]] std::pair<double, double> slopes(double place) const;
  [[nodiscard]] bool bends() const { return bow || curve != 0; }
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

/// Bows that lengths of all orders together keep to, where there are enough.
struct SharedBows {
  std::optional<Bow> byRank, byStage;
};
[[nodiscard]] SharedBows sharedBows(std::span<const AxisLengths> axes);
/// The bow that an order's axes keep to, of their own or of all; none where even steps, changing evenly, explain them as well. Lengths far off their place and axis count less.
[[nodiscard]] std::optional<OrderCourse> bowedCourse(std::span<const AxisLengths> axes, LengthsAlong along, const SharedBows& shared);

/// Foretells the next segment of an axis from its first `below`.
[[nodiscard]] double foretold(LengthRule rule, const AxisLengths& axis, std::size_t below, const OrderCourse& course);
/// Of the logarithm of a next length: its scatter, the doubt about the axis' level, and that about the order's course on the way there.
[[nodiscard]] double doubtOf(const LengthOutlook& length, const AxisLengths& axis, const OrderCourse& course);

/// Lengths of the axes of every order.
using Axes = std::vector<AxisLengths>;
[[nodiscard]] std::map<int, Axes> axesByOrder(std::span<const MeasuredPlant> plants, const Schedule& schedule);
/// The bows of all axes as they are, and without the youngest one, two... segments of each.
[[nodiscard]] std::vector<SharedBows> sharedBowsBack(const std::map<int, Axes>& axes);
/// Sets by which rule an order's lengths are foretold; returns how its lengths run.
[[nodiscard]] OrderCourse setLength(OrderOutlook& order, const Axes& axes, const std::vector<SharedBows>& shared, const LayeredStatistics& statistics);

/// Sets how new axes of every order begin, and the arms of forks. `courses` by order. For sympodial plants adds the order that comes above.
void setStarts(Outlook& outlook, std::span<const MeasuredPlant> plants, const std::map<int, OrderCourse>& courses);

/// Sets how leaves stand, grow and fall on an order.
void setLeaves(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

}  // namespace axil::quantify
