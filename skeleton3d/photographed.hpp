#pragma once
/// \file
/// Clicks and photos together. Clicks alone find the cameras to within a pixel or so; in those the photos tell which centre
/// line each click means, and lines known to a fraction of a pixel find the cameras again, far better, and the nodes in them.
/// Twice, since a stem's taper and its place in the other photos tell it from what overlaps it.
///
/// Cameras that are known stay as they are; then only nodes are placed. Either way clicks that contradict the others are named
/// and left out, and the uncertainty is that of what was done: loose along a stem, exact across it, with the cameras' own errors.
/// Project's unit; pixels for what is given. Fails as estimateCameras does.
/// Source: beyond L-Grammar Generator 2005.

#include "base/result.hpp"
#include "skeleton3d/estimate.hpp"
#include "skeleton3d/snap_place.hpp"

#include <map>
#include <span>
#include <string>

namespace axil::skeleton3d {

struct Photographed {
  EstimatedCameras cameras;  ///< as estimateCameras says; its uncertainty is that of the snapped nodes
  Snapping snapping;
};

/// `options.stems` are the stems; `options.centreLines` is not read.
[[nodiscard]] Result<Photographed> measurePhotographed(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, const Photos& photos,
                                                       std::span<const ClickedNode> nodes, const EstimateOptions& options);

}  // namespace axil::skeleton3d
