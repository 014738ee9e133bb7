#pragma once
/// \file
/// ResponseCurve: a curve that answers one number with another, drawn by hand as a few control points: how fast something grows
/// by the day, how long an internode becomes by its place on the stem. Classic texts ask it as `func(number, x)`.
///
/// The points are those of a cubic B-spline that starts in the first and ends in the last (two points: a straight line, three: a
/// parabola), read as the graph of a function: x runs from 0 to 1 and never back. Beside the first and last point the curve stays
/// as high as they are. Source: The Algorithmic Beauty of Plants, section 5.3 (curves as parameters of organs).

#include "base/result.hpp"

#include <glm/vec2.hpp>

#include <string_view>
#include <vector>

namespace axil::simeco {

struct ResponseCurve {
  std::vector<glm::dvec2> points;  ///< two at least, from left to right

  /// How high the curve is at `x`, which is taken to 0 or 1 where it lies outside.
  [[nodiscard]] double at(double x) const;
  friend bool operator==(const ResponseCurve&, const ResponseCurve&) = default;
};

/// A curve through `numbers`, x y x y ... Fails with BadInput where there are no two points, or one lies left of the point before it.
[[nodiscard]] Result<ResponseCurve> responseCurve(const std::vector<double>& numbers);

/// A curve from the text of a function file: numbers, two a line, behind the line `points: n`; other lines `word: value` say how a
/// function editor shows it and are passed over.
[[nodiscard]] Result<ResponseCurve> parseResponseCurve(std::string_view text);

}  // namespace axil::simeco
