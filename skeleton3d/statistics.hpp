#pragma once
/// \file
/// Private to skeleton3d: the few numbers of statistics that judging clicks needs.

#include "skeleton3d/bundle.hpp"

#include <vector>

namespace axil::skeleton3d::detail {

/// The median of a sum of `freedom` squared standard normal numbers, and the value it exceeds once in a thousand times.
/// Source: Wilson and Hilferty's cube-root approximation, good to some percent from one degree of freedom.
[[nodiscard]] double chiSquaredMedian(int freedom);
[[nodiscard]] double chiSquaredLimit(int freedom);

/// From the sum of squared misses in pixels. With few numbers it is drawn towards one pixel, as if two more had said that.
[[nodiscard]] Scatter scatterFrom(double squares, int freedom);

}  // namespace axil::skeleton3d::detail
