#pragma once
/// \file
/// From clicks to places: each node is triangulated linearly from the rays of its clicks, then moved to where the sum of
/// squared reprojection errors (px, lens distortion included) is least. With it come the standard deviation of each
/// coordinate, sqrt(diag(click_px^2 (J^T J)^-1)) with J the Jacobian of the pixels, and the reprojection error per view.
///
/// Nodes are solved one by one and their views taken in the order of their names, so neither the order of nodes or views
/// nor the number of threads changes a bit of the answer. Cameras must be known; estimate.hpp makes them so.
/// Source: L-Grammar Generator 2005, section 3.2.2, generalised from two orthographic photos to any number of cameras.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axil::skeleton3d {

struct SolveOptions {
  /// Standard deviation of a click in each direction; Node::sigma is proportional to it.
  double click_px = 1;
  /// A node is refused when after refinement a click lies further than this from the node's projection. Nothing: 2.5 % of
  /// the photo's longer side, or 40 px where its size is unknown. Careful clicks on a calibrated plant stay below 5 px.
  std::optional<double> maxReprojection_px = std::nullopt;
  /// A node is refused when no two of its rays meet at a larger angle: its depth would be a guess.
  Angle minRayAngle = Angle::fromDegrees(1);
};

/// The nodes in the order they came, `radius` as it was given. Fails when a camera or an option is wrong, with the reason;
/// and when nodes cannot be placed: a click in an unknown view or outside the photo, fewer than two clicks, views too
/// similar, rays that do not meet (how far apart), a node behind a camera, an id twice. One trouble is the Error's message;
/// of several the message names the first and the details have a line for each.
[[nodiscard]] Result<std::vector<Node>> solveNodes(std::span<const View> views, std::span<const ClickedNode> nodes, const SolveOptions& options = {});

}  // namespace axil::skeleton3d
