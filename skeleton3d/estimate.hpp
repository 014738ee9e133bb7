#pragma once
/// \file
/// Cameras nobody calibrated: from the names of the views (front, right, top, back, left say roughly where each camera
/// looked), the clicked origin, a known length, a focal length (given, from EXIF, or a stated default) and the clicks
/// themselves, one bundle adjustment finds every camera's rotation, place and focal length together with the nodes.
///
/// How: views are first taken as seen from far away, which makes scales, offsets and nodes one linear problem; Ceres then
/// minimises the reprojection errors (Cauchy loss, so that a few wrong clicks do not pull) plus priors on how far a camera
/// is turned from its name and on its focal length. The length that fixes the scale comes last. Where several views give
/// the same known length and its ends' rays meet, it is one object in space; else it is taken to lie at the
/// origin's distance and parallel to its picture.
///
/// What the result means: the plant's shape does not depend on the priors where three views have some ten nodes; its
/// upright and its heading are the mean of what the view names say. Views whose camera is known stay as they are.
/// Source: beyond L-Grammar Generator 2005, which assumes exact orthographic views.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

struct EstimateOptions {
  double click_px = 1;                        ///< standard deviation of a click
  Angle tilt = Angle::fromDegrees(5);         ///< how far a handheld camera is turned about each axis from what its name says
  double givenFocalShare = 0.005;             ///< standard deviation of Camera::focal_px, as a share of it
  double exifFocalShare = 0.03;               ///< of an EXIF focal length
  /// Where nothing says the focal length: that of a phone, 26 mm on film, in pixels 0.6 of the photo's diagonal; its inverse
  /// may be anything from 0 (seen from very far) to about three times that.
  double defaultFocalShareOfDiagonal = 0.6;
};

/// How one camera was found.
struct CameraReport {
  std::string view;
  double focal_px = 0;         ///< 0: seen from so far that the camera is orthographic
  Angle turned;                ///< from the nominal direction of its name
  double typical_px = 0;       ///< median distance of its clicks from where their nodes project to
  std::size_t clicks = 0;

  friend bool operator==(const CameraReport&, const CameraReport&) = default;
};

/// A click that may be wrong: without it the node's other clicks agree. Where two clicks could equally be the wrong one both
/// are named; where no single one explains it, all clicks of the node.
struct SuspectClick {
  NodeId node;
  std::string view;
  double off_px = 0;  ///< from where the other clicks put the node (or, all being named, from the best place)

  friend bool operator==(const SuspectClick&, const SuspectClick&) = default;
};

struct EstimatedCameras {
  std::vector<View> views;             ///< in the order they came, no camera unknown
  std::vector<CameraReport> reports;   ///< one for each camera that was unknown, by name
  std::vector<SuspectClick> suspects;  ///< by node and view
};

/// Fails with NoAnswer or BadInput, saying for which view: a name without a nominal direction, unknown photo size, fewer
/// than four nodes shared with other views, no origin in any view, no known length (or one that is not above zero, or
/// clicked in one place), views that do not fit together (exchanged, mirrored, turned by more than 45 degrees). Nodes need not all be good.
[[nodiscard]] Result<EstimatedCameras> estimateCameras(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints,
                                                       std::span<const ClickedNode> nodes, const EstimateOptions& options = {});

/// The nodes without their suspect clicks, the furthest off first, as long as two clicks are left of a node.
[[nodiscard]] std::vector<ClickedNode> withoutSuspects(std::span<const ClickedNode> nodes, std::span<const SuspectClick> suspects);

}  // namespace axil::skeleton3d
