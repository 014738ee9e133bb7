#pragma once
/// \file
/// Widths: from a stem's two edges in a photo, through the camera, to its radius; and radii along a stem as a taper.
///
/// A stem is taken as round: its radius is that of the cylinder whose sides are seen at the two edges. Project's unit.
/// Source: beyond L-Grammar Generator 2005, whose widths are typed by hand.

#include "skeleton3d/snap.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axil::skeleton3d {

struct MeasuredRadius {
  double radius = 0;
  double sigma = 0;

  friend bool operator==(const MeasuredRadius&, const MeasuredRadius&) = default;
};

/// What one reading of the stem at `at` says of its radius.
[[nodiscard]] MeasuredRadius radiusFrom(const View& view, const RidgeReading& ridge, PlantPoint at);

/// Several views' radii of one place as one. What lies behind or before a stem makes it look wider, seldom narrower: readings
/// well above the least are left out. Nothing for no reading.
[[nodiscard]] std::optional<MeasuredRadius> combinedRadius(std::span<const MeasuredRadius> readings);

/// The radii of a stem from its base to its tip that never grow and are nearest to those given, weighted by 1/sigma
/// (least sum of absolute differences, so that single wrong readings do not count). A sigma of 0 counts as exact.
[[nodiscard]] std::vector<double> taperedRadii(std::span<const MeasuredRadius> radii);

}  // namespace axil::skeleton3d
