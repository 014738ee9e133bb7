#pragma once
/// \file
/// What a person wants to see of a measurement: per view the clicks and where their nodes project to, drawn over the photo;
/// and how every camera was found, as text. Pixels are the upright photo's.
///
/// Fails with Unreadable or NotFound where a photo cannot be read (see photo.hpp).

#include "base/result.hpp"
#include "skeleton3d/estimate.hpp"
#include "skeleton3d/types.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace axil::skeleton3d {

struct ResidualPlotOptions {
  double magnified = 10;    ///< the arrows, against the photo's pixels
  int longestSide_px = 2000;
};

/// One view as PNG bytes: the photo, dimmed (grey without `photo`); at every placed node a dot where it projects to and an
/// arrow towards its click, magnified, green, yellow or red as it is below two, four or more standard deviations of a
/// click; rings around clicks that are suspect; crosses at clicks that no other view completes.
[[nodiscard]] Result<std::string> residualPlot(const std::optional<std::filesystem::path>& photo, const View& view, std::span<const ClickedNode> clicks, const Skeleton& skeleton,
                                               std::span<const SuspectClick> suspects, double click_px, const ResidualPlotOptions& options = {});

/// Cameras, residuals, suspects and notes in plain words, one line each.
[[nodiscard]] std::string reportText(std::span<const View> views, std::span<const CameraReport> cameras, std::span<const SuspectClick> suspects, const Uncertainty& uncertainty,
                                     std::span<const std::string> notes, const Skeleton& skeleton);

}  // namespace axil::skeleton3d
