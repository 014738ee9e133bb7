#pragma once
/// \file
/// Private to skeleton3d: how far off centre lines are, as the widths tell. A background in patches, a shadow or a neighbour moves one
/// edge of a stem and not the other: then the line midway is off by half of what the width is. Along a stem widths are known far
/// better than one place shows them, so each reading's own width says how much its edges are to be trusted.
/// Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/snap_place.hpp"

namespace axil::skeleton3d::detail {

/// The readings with standard deviations across their stems no smaller than their widths' scatter about the expected ones allows.
[[nodiscard]] RidgeReadings withWidthScatter(RidgeReadings readings, const ExpectedRidges& expected);

}  // namespace axil::skeleton3d::detail
