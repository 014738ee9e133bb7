#pragma once
/// \file
/// Private to skeleton3d: what a prepared photo holds.

#include "skeleton3d/live_wire.hpp"
#include "skeleton3d/stemness.hpp"

namespace axil::skeleton3d::detail {

struct PreparedWire {
  std::shared_ptr<const Photo> photo;
  StemnessMap stems;
};

/// The stem's centre line beside given places, one a place; `widths_px` as far as they are known, else 0.
[[nodiscard]] std::vector<WireNode> refinedAlong(const PreparedWire& wire, const std::vector<glm::dvec2>& places, const std::vector<double>& widths_px);

}  // namespace axil::skeleton3d::detail
