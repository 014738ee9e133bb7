#pragma once
/// \file
/// Private to the room: half a blade as rulings, the straight lines from the midrib to the margin along which side veins run.
/// Every ruling stays inside the half and no two cross, so a strip from ruling to ruling triangulates any lobed, cordate or
/// toothed blade without overlaps; the feet climb the midrib (or stay at one point, where the lines fan out).

#include "organs/leaf.hpp"

#include <glm/vec2.hpp>

#include <vector>

namespace axil::organs {

struct Ruling {
  double foot = 0;      ///< height on the midrib, 0 to 1, never below the foot before
  glm::dvec2 margin{};  ///< x >= 0, before the blade is bent sideways
};

/// Width at the share `u` of the way from an end (0) to the widest place (1), as LeafEnd defines it; 0 to 1.
[[nodiscard]] double endWidth(const LeafEnd& end, double u);

/// The right half of `shape`, from base to apex: at most `count` rulings (at least 4), dense where the margin turns.
[[nodiscard]] std::vector<Ruling> rulingsOf(const LeafShape& shape, std::size_t count);
/// The left half, with x >= 0 still; the same places as the right half, narrower when the blade is oblique.
[[nodiscard]] std::vector<Ruling> leftOf(std::vector<Ruling> right, const LeafShape& shape);

}  // namespace axil::organs
