#pragma once
/// \file
/// Private to skeleton3d: what an adjustment says of itself in words: whether views fit, whether they would fit better if
/// they were named, turned or mirrored otherwise, what is weakly determined.

#include "skeleton3d/bundle.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

/// Fails where the clicks of a view are typically far off or a camera is far from what its name says.
[[nodiscard]] Result<void> checkFit(const Bundle& bundle);

/// How the views of a gathered bundle would fit: exchanged, mirrored, rotated, or taken from another side, as a sentence
/// for a person, simplest first. Empty where nothing does, or not clearly better than `typical_px`.
[[nodiscard]] std::string betterReading(const Bundle& gathered, const EstimateOptions& options, std::optional<double> typical_px);

/// The same for a bundle that fits, where that alone does not settle it: two directions only, clicks far off, cameras far turned.
[[nodiscard]] std::string doubtOn(const Bundle& fitted, const EstimateOptions& options);

/// The same where all cameras are known and clicks are far off: exchanged between two views, mirrored or upside down in one.
[[nodiscard]] std::string betterReading(std::span<const View> views, std::span<const ClickedNode> nodes);

[[nodiscard]] std::vector<std::string> weaknessesOf(const BundleCamera& camera, const CameraReport& report);

/// Views that cut the plant off, of all points that were clicked: those at a border are often among the suspects.
[[nodiscard]] std::vector<std::string> borderNotes(const Bundle& all);

/// Origins and known lengths that contradict one another, a size or nodes known poorly.
[[nodiscard]] std::vector<std::string> notesOn(const Bundle& bundle, const std::vector<Miss>& misses, const EstimatedCameras& estimated);

}  // namespace axil::skeleton3d::detail
