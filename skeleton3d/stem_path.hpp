#pragma once
/// \file
/// Private to skeleton3d: the likeliest pair of edges along a stem's line, by dynamic programming, and the edges' fit at a place.

#include "skeleton3d/snap.hpp"
#include "skeleton3d/stem_line.hpp"

#include <optional>
#include <vector>

namespace axil::skeleton3d::detail {

/// The two edges beside one place of the line.
struct EdgePair {
  glm::dvec2 left{0, 0}, right{0, 0};  ///< where they are in the photo
  double strength = 0;                 ///< grey levels, see ridgeStrength
  double leftStrength = 0, rightStrength = 0;
  double expectedWidth_px = 0;         ///< 0: unknown
};

struct PathOptions {
  double reach_px = 12;
  double maxWidth_px = 60;
  double click_px = 3;
  double blur_px = 1;
};

/// What is known of a stem before it is looked at, a value each place; empty: nothing.
struct Expected {
  std::vector<double> width_px;
};

/// One pair of edges a place. `clicks[i]` is the raw click at `line.placeOf[i]`: it pulls the path with its scatter.
[[nodiscard]] std::vector<EdgePair> likeliestEdges(const Photo& photo, const StemLikelihood& likelihood, const StemLine& line, std::span<const glm::dvec2> clicks,
                                                   const PathOptions& options, const Expected& expected = {});

/// Places of a line, both included.
struct PlaceRange {
  std::size_t first = 0, last = 0;
};

/// Centre line and edges beside `click`, from the edges along some of the line near place `place`, but none outside `within`:
/// beyond a stem's end there are none.
[[nodiscard]] std::optional<RidgeReading> readingAt(const StemLine& line, const std::vector<EdgePair>& edges, std::size_t place, glm::dvec2 click, const PathOptions& options,
                                                    PlaceRange within);

}  // namespace axil::skeleton3d::detail
