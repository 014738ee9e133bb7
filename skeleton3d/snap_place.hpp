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

struct SnappedNode {
  NodeId id;
  PlantPoint at;
  glm::dmat3 covariance{0.0};
  std::vector<std::string> snappedIn;   ///< views whose ridge was believed
  std::optional<double> radius = std::nullopt;
  double sigmaRadius = 0;
  bool tipSeen = false;                 ///< the ends of its stem that photos show were believed

  friend bool operator==(const SnappedNode&, const SnappedNode&) = default;
};

/// Fails where the cameras or the clicks are wrong, as solveNodes does.
/// `cameras_px`: how far the cameras themselves may be off, where they were estimated.
[[nodiscard]] Result<std::vector<SnappedNode>> placeSnapped(std::span<const View> views, std::span<const ClickedNode> nodes, const RidgeReadings& readings,
                                                            double click_px = 3, double cameras_px = 0);

/// The readings that were believed where nodes were placed.
[[nodiscard]] RidgeReadings believedReadings(const RidgeReadings& readings, std::span<const SnappedNode> placed);
/// The readings with standard deviations as large as the believed ones scatter about their nodes; never smaller than read.
[[nodiscard]] RidgeReadings withTrueScatter(RidgeReadings readings, std::span<const View> views, std::span<const SnappedNode> placed);

/// Photos by the names of their views.
using Photos = std::map<std::string, Photo>;

struct Snapping {
  std::vector<SnappedNode> nodes;
  RidgeReadings readings;
};

/// The ridges at all nodes in all photos; `expected`, where something is known of the nodes already.
using ExpectedRidges = std::map<std::string, std::map<NodeId, ExpectedRidge>>;
[[nodiscard]] RidgeReadings readAllRidges(const Photos& photos, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems, const SnapOptions& options,
                                          const ExpectedRidges& expected = {});
/// Where each node and how wide its stem is to be seen, from where nodes were placed and the tapers of their stems.
[[nodiscard]] ExpectedRidges expectedRidges(std::span<const View> views, std::span<const SnappedNode> placed, std::span<const ClickedStem> stems, const RidgeReadings& readings);

/// All of it: ridges read in every photo, nodes placed, each stem's taper found from all its widths, and ridges and places
/// found again with that known, which tells a stem from what overlaps it in a photo. Cameras must be known; see photographed.hpp.
[[nodiscard]] Result<Snapping> snapNodes(std::span<const View> views, const Photos& photos, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems,
                                         const SnapOptions& options = {});

/// `skeleton` with its nodes where `snapped` says; a radius that was given stays. The reprojection errors are those of the
/// clicks as the person made them.
[[nodiscard]] Skeleton withSnapped(Skeleton skeleton, std::span<const View> views, std::span<const ClickedNode> clicks, std::span<const SnappedNode> snapped);

}  // namespace axil::skeleton3d
