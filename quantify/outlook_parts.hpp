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

/// How lengths of one order run along an axis: from the order's start with a step a rank; an axis' own level counts by how many segments tell it, against `weight`.
struct OrderCourse {
  double start = 0;     ///< logarithms
  double step = 0;
  double weight = 100;  ///< of the order, in segments
  double stepError = 0;
  /// The level of an axis with such lengths, at `rank`.
  [[nodiscard]] double levelAt(std::span<const double> logs, double rank) const;
};

/// Sets how new axes of every order begin, and the arms of forks. `courses` by order. For sympodial plants adds the order that comes above.
void setStarts(Outlook& outlook, std::span<const MeasuredPlant> plants, const std::map<int, OrderCourse>& courses);

/// Sets how leaves stand, grow and fall on an order.
void setLeaves(OrderOutlook& order, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics);

}  // namespace axil::quantify
