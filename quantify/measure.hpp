#pragma once
/// \file
/// Measuring: a Skeleton as numbers. The four steps of the thesis, on segments: length; level; parent and children; main or
/// branch with r-axis, rotr and rotu. Lengths keep the skeleton's unit. Nothing here changes a skeleton.
///
/// The result regrows the skeleton: childFrame (base/turning.hpp) with the measured turns gives every direction back to
/// 1e-9 degrees, however deep the tree. Which child is main does not depend on the order of nodes or on the plant's azimuth.
/// Source: L-Grammar Generator 2005, section 3.3.

#include "base/result.hpp"
#include "base/turning.hpp"
#include "quantify/types.hpp"

namespace axil::quantify {

struct MeasureOptions {
  /// Literal measures as the thesis words it: a branch's r-axis is its parent's direction, the first r-axis is the first
  /// segment's direction x its nearest child. Such angles do not regrow the plant; docs/decisions/turning.md shows it.
  TurningRule turning = TurningRule::Exact;
};

/// Measures every segment and leaf of `skeleton`.
/// Fails with BadInput when the skeleton is no tree (unknown or doubled ids, a node reached twice, parts that the root does
/// not reach, two first stems) or holds values that are not numbers, and with NoAnswer for a segment without length or a
/// leaf that is not attached to a node of its stem. The details list every such place.
[[nodiscard]] Result<Measurements> measure(const skeleton3d::Skeleton& skeleton, const MeasureOptions& options = {});

}  // namespace axil::quantify
