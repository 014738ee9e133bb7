#pragma once
/// \file
/// Private to skeleton3d: the clicks of one stem in one photo as a line that imaging can walk along.

#include "base/frames.hpp"

#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

/// Places a small step apart along a stem, with the number of each click's nearest place.
struct StemLine {
  std::vector<glm::dvec2> at;
  std::vector<glm::dvec2> along;    ///< unit
  std::vector<double> length_px;    ///< from the first place
  std::vector<std::size_t> placeOf; ///< of each click
};

/// A smooth line past the clicks, whose scatter is `click_px`; clicks closer than that say little alone and are averaged.
/// Empty where the stem is seen so short that it has no direction.
[[nodiscard]] StemLine stemLine(std::span<const glm::dvec2> clicks, double click_px, double step_px);

/// A line through given places, for example along a curve of the plant; `clicks` are places of it.
[[nodiscard]] StemLine lineThroughPlaces(std::vector<glm::dvec2> places, std::vector<std::size_t> clicks);

}  // namespace axil::skeleton3d::detail
