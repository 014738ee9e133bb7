#pragma once
/// \file
/// Private to skeleton3d: a rod painted in bands of equal length, as ranging rods are. Every edge between two bands says where
/// the ends are, so they are known even where something hides them or is of their colour.
///
/// How: along lines beside one another between the clicked ends, the colour is followed on the axis on which it changes most;
/// where it crosses the middle between its two levels is a band's edge. Edges that are equally far apart, alternate and are as
/// many as bands fit between the clicked ends make a rod. (Perspective moves both ends alike, so the length stays.)
/// Pixels are the upright photo's. Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/photo.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace axil::skeleton3d::detail {

struct BandedEnds {
  glm::dvec2 from{0, 0};  ///< on the rod's front, in the middle of its width
  glm::dvec2 to{0, 0};
  double half_px = 0;     ///< half the rod's width
  double sigma_px = 0;    ///< standard deviation of each end along the rod
  int bands = 0;
};

/// `reach_px`: how far the ends may be from where they were clicked.
[[nodiscard]] std::optional<BandedEnds> bandedEnds(const Photo& photo, glm::dvec2 from, glm::dvec2 to, double reach_px);

/// The photo's colour at a place, bilinear; beyond the photo its border goes on.
[[nodiscard]] glm::dvec3 colourAt(const Photo& photo, glm::dvec2 px);

}  // namespace axil::skeleton3d::detail
