#pragma once
/// \file
/// Cameras nobody calibrated: from the names of the views (front, right, top, back, left say roughly where each camera
/// looked), the clicked origin, a known length, a focal length (given, from EXIF, or a stated default) and the clicks
/// themselves, one bundle adjustment finds every camera's rotation, place and focal length together with the nodes.
///
/// How: views are first taken as seen from far away, which makes scales, offsets and nodes one linear problem; Ceres then
/// minimises the reprojection errors (Cauchy loss, so that a few wrong clicks do not pull) plus priors on how far a camera
/// is turned from its name and on its lens. The scatter of the clicks is found from what is left; clicks that cannot be
/// part of it are named and left out. The ends of known lengths join the last adjustment as points of their own: where
/// several views give the same length and its ends' rays meet it is one object in space, whichever end was clicked first;
/// else it is taken to lie at the origin's distance and parallel to its picture.
///
/// What the result means: the plant's shape does not depend on the priors where three views have some ten nodes; its
/// upright and its heading are the mean of what the view names say. Views whose camera is known stay as they are.
/// Source: beyond L-Grammar Generator 2005, which assumes exact orthographic views.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "skeleton3d/snap.hpp"
#include "skeleton3d/types.hpp"
#include "skeleton3d/uncertainty.hpp"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

namespace detail {
struct StemEvidence;
}

struct EstimateOptions {
  std::optional<double> click_px = std::nullopt;  ///< standard deviation of a click; none: found from the clicks
  Angle tilt = Angle::fromDegrees(5);         ///< how far a handheld camera is turned about each axis from what its name says
  double givenFocalShare = 0.005;             ///< standard deviation of Camera::focal_px, as a share of it
  double exifFocalShare = 0.03;               ///< of an EXIF focal length
  double unknownBend = 0.02;                  ///< of the radial distortion k1 where the lens was not calibrated
  /// Where nothing says the focal length: that of a phone, 26 mm on film, in pixels 0.6 of the photo's diagonal; its inverse
  /// may be anything from 0 (seen from very far) to about three times that.
  double defaultFocalShareOfDiagonal = 0.6;
  /// Stems, where they are clicked already: of two clicks that could equally be the wrong one of a node, the one that makes
  /// the node leap away from its neighbours. They move no camera and no node.
  std::vector<ClickedStem> stems = {};
  /// Centre lines read beside clicks: each fixes its node across its stem far better than the click does, and so the cameras.
  RidgeReadings centreLines = {};
  /// What the photos say of where stems are (photographed.hpp), to tell wrong clicks from right ones; nothing: they are not at hand.
  std::shared_ptr<const detail::StemEvidence> evidence = nullptr;
};

/// How one camera was found.
struct CameraReport {
  std::string view;
  double focal_px = 0;            ///< 0: seen from so far that the camera is orthographic
  double focalSigma_px = 0;       ///< its standard deviation; as much again is left open by the view being nearly orthographic
  Angle turned;                   ///< from the nominal direction of its name
  std::array<Angle, 3> turnedAbout{};  ///< the same about the picture's axes: nods (x), looks aside (y), rolls (z)
  double typical_px = 0;          ///< median distance of its clicks from where their nodes project to
  double rms_px = 0;              ///< root mean square of the same, suspects left out
  std::size_t clicks = 0;
  std::vector<std::string> weak;  ///< what its clicks leave nearly open, one sentence each

  friend bool operator==(const CameraReport&, const CameraReport&) = default;
};

/// A click that may be wrong: the node's clicks cannot all be meant for one point if clicks scatter as they do elsewhere, and
/// without this one the others agree. Where several could be the wrong one all are named, each with its chance; where no
/// single one explains it, all clicks of the node.
struct SuspectClick {
  NodeId node;
  std::string view;
  double off_px = 0;  ///< from where the other clicks put the node (or, all being named, from the best place)
  double chance = 1;  ///< of being wrong
  /// Where it was rather meant to be, where only one click of its node is right: by that one, the stem's course and the photos.
  std::optional<PhotoPoint> rather = std::nullopt;
  double ratherSigma_px = 0;  ///< standard deviation of `rather`

  friend bool operator==(const SuspectClick&, const SuspectClick&) = default;
};

struct EstimatedCameras {
  std::vector<View> views;             ///< in the order they came, no camera unknown
  std::vector<CameraReport> reports;   ///< one for each camera that was unknown, by name
  std::vector<SuspectClick> suspects;  ///< by node and view
  Uncertainty uncertainty;             ///< of the nodes, in these cameras and without the suspects
  std::vector<std::string> notes;      ///< what a person should look at, one sentence each
};

/// A camera that is not known is estimated from this many nodes at least that are clicked in its view and another.
inline constexpr std::size_t kFewestSharedNodes = 4;

/// Fails with NoAnswer or BadInput, saying for which view: a name without a nominal direction, unknown photo size, fewer
/// than four nodes shared with other views, no origin in any view, no known length (or one that is not above zero, or
/// clicked in one place), views that do not fit together (turned by more than 45 degrees from their names); where they would fit exchanged,
/// mirrored, rotated or taken from another side, the message says so. Nodes need not all be good.
[[nodiscard]] Result<EstimatedCameras> estimateCameras(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints,
                                                       std::span<const ClickedNode> nodes, const EstimateOptions& options = {});

/// The nodes without the suspect clicks that are more likely wrong than not, or, where none is, without the likeliest one. Where only one
/// click of a node is right the others go to where they were rather meant to be, as placed by the program; a node without that has no place.
[[nodiscard]] std::vector<ClickedNode> withoutSuspects(std::span<const ClickedNode> nodes, std::span<const SuspectClick> suspects);

}  // namespace axil::skeleton3d
