#pragma once
/// \file
/// The parts of an outlook that are worked out apart. Private to this room.

#include "quantify/outlook.hpp"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace axil::quantify {

/// Logarithms of an axis' lengths.
[[nodiscard]] std::vector<double> logLengths(const Measurements& m, const Axis& axis);

/// How lengths of one order run along an axis: from the order's start with a step a rank, which changes by `curve` a rank; an axis' own level counts by how many segments tell it,
/// against `weight`.
struct OrderCourse {
  double start = 0;     ///< logarithms
  double step = 0;
  double curve = 0;
  double weight = 100;  ///< of the order, in segments
  double stepError = 0, curveError = 0;
  double bothErrors = 0;  ///< covariance of the two
  [[nodiscard]] double at(double rank) const;
  /// By how much an axis lies above the course, on average.
  [[nodiscard]] double levelOf(std::span<const double> logs) const;
  /// The length at `rank` of an axis with such lengths.
  [[nodiscard]] double levelAt(std::span<const double> logs, double rank) const;
};

/// Foretells one rank of an axis from the ranks below it.
[[nodiscard]] double foretold(LengthRule rule, std::span<const double> below, const OrderCourse& course);
/// Of the logarithm of a next length: its scatter, the doubt about the axis' level, and that about the order's steps on the way there.
[[nodiscard]] double doubtOf(const LengthOutlook& length, std::size_t below, const OrderCourse& course);
/// Sets by which rule an order's lengths are foretold; returns how its lengths run.
[[nodiscard]] OrderCourse setLength(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

/// Sets how new axes of every order begin, and the arms of forks. `courses` by order. For sympodial plants adds the order that comes above.
void setStarts(Outlook& outlook, std::span<const MeasuredPlant> plants, const std::map<int, OrderCourse>& courses);

/// Sets how leaves stand, grow and fall on an order.
void setLeaves(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

}  // namespace axil::quantify
