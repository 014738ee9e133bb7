#pragma once
/// \file
/// Private to skeleton3d: solving that collects every trouble instead of stopping, so that a tree's troubles can join them.

#include "skeleton3d/solve.hpp"

#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

/// One thing that is wrong with the input, as a line for a person.
struct Trouble {
  ErrorCode code = ErrorCode::BadInput;
  std::string text;
};

struct Solved {
  std::vector<std::optional<Node>> nodes;  ///< as many as there were clicked nodes; none where one has no place
  std::vector<Trouble> troubles;
};

/// Fails only where the views or options themselves are wrong. `unit` is the word for lengths in messages.
[[nodiscard]] Result<Solved> solveAll(std::span<const View> views, std::span<const ClickedNode> nodes, const SolveOptions& options, const std::string& unit);

/// Covariance of a node's place for clicks that scatter by `click_px`, from its clicks in known cameras.
[[nodiscard]] glm::dmat3 covarianceOfPlace(std::span<const View> views, const ClickedNode& node, PlantPoint point, double click_px);

/// One Error of at least one trouble: `what` names the whole ("the clicks do not make a skeleton") and the first trouble
/// stands behind it; where there are several, `details` has a line for each, the first included.
[[nodiscard]] Failure failWith(const std::vector<Trouble>& troubles, const std::string& what);

/// Every view has a good camera of its own name; `Unknown` is refused unless `allowUnknown`.
enum class UnknownCameras { Refused, Allowed };
[[nodiscard]] Result<void> checkViews(std::span<const View> views, UnknownCameras unknown);

/// What is wrong with the clicks of one node before any geometry: unknown views, numbers, places outside the photo.
[[nodiscard]] std::vector<Trouble> clickTroubles(std::span<const View> views, const ClickedNode& node);

/// `name` -> its view, or null.
[[nodiscard]] const View* findView(std::span<const View> views, const std::string& name);

}  // namespace axil::skeleton3d::detail
