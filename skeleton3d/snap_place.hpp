#pragma once
/// \file
/// Where nodes are whose clicks were snapped. In each view a snapped click is exact across its stem and as loose as any
/// click along it, so every click has its own covariance; the views together fix the stem's centre line far better than
/// where along it the node is. A snap that the other views contradict is taken back to the person's click.
///
/// Widths become radii through the cameras and are combined over the views, each with its own uncertainty.
/// Project's unit; pixels for what is given. Nodes that cannot be placed at all are left out.
/// Source: beyond L-Grammar Generator 2005.

#include "base/result.hpp"
#include "skeleton3d/snap.hpp"

#include <glm/mat3x3.hpp>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

/// View name -> node -> what was read there.
using RidgeReadings = std::map<std::string, std::map<NodeId, RidgeReading>>;

struct SnappedNode {
  NodeId id;
  PlantPoint at;
  glm::dmat3 covariance{0.0};
  std::vector<std::string> snappedIn;   ///< views whose ridge was believed
  std::optional<double> radius = std::nullopt;
  double sigmaRadius = 0;

  friend bool operator==(const SnappedNode&, const SnappedNode&) = default;
};

/// Fails where the cameras or the clicks are wrong, as solveNodes does.
[[nodiscard]] Result<std::vector<SnappedNode>> placeSnapped(std::span<const View> views, std::span<const ClickedNode> nodes, const RidgeReadings& readings,
                                                            double click_px = 3);

/// Photos by the names of their views.
using Photos = std::map<std::string, Photo>;

struct Snapping {
  std::vector<SnappedNode> nodes;
  RidgeReadings readings;
};

/// All of it: ridges read in every photo, nodes placed, each stem's taper found from all its widths, and ridges and places
/// found again with that known, which tells a stem from what overlaps it in a photo. Cameras must be known or estimated.
[[nodiscard]] Result<Snapping> snapNodes(std::span<const View> views, const Photos& photos, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems,
                                         const SnapOptions& options = {});

/// `skeleton` with its nodes where `snapped` says; a radius that was given stays. The reprojection errors are those of the
/// clicks as the person made them.
[[nodiscard]] Skeleton withSnapped(Skeleton skeleton, std::span<const View> views, std::span<const ClickedNode> clicks, std::span<const SnappedNode> snapped);

}  // namespace axil::skeleton3d
