#pragma once
/// \file
/// Snapping: a click near a stem goes to the stem's centre line, sub-pixel, and says how sure that is. Only across the stem:
/// where along its stem a click is stays as the person clicked it, so that a click at a fork does not slide away. Only a tip
/// and the collar are also found along their stem, where the photo shows clearly that the stem ends.
///
/// `snapClick` knows one photo and one click. `readRidges` knows all stems clicked in a photo: each stem's clicks are read as
/// one line, the likeliest ridge along it is found by dynamic programming, and the two edges beside each node are fitted, so
/// a node at a fork lies on the line of the stem that it belongs to and not between the stem and its branch.
///
/// Pixels of the upright photo. A place without a ridge (blurred, uniform, cluttered) is no failure: the click is kept.
/// Source: beyond L-Grammar Generator 2005; ridges as in ridge.hpp.

#include "base/angle.hpp"
#include "skeleton3d/ridge.hpp"
#include "skeleton3d/types.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>

namespace axil::skeleton3d {

/// A stem's centre line and its two edges at one place of a photo.
struct RidgeReading {
  PhotoPoint at;
  Angle along;                ///< which way the stem runs, x towards y; 180 degrees are the same
  double sigmaAcross_px = 0;  ///< standard deviation of `at` across the stem; along it, it is the click's
  double width_px = 0;        ///< from edge to edge
  double sigmaWidth_px = 0;
  double confidence = 0;      ///< 0 to 1: how likely this is the stem that was meant
  std::optional<PhotoPoint> tip = std::nullopt;  ///< of a stem's last node, and of the collar, where the photo shows the stem to end
  double sigmaTip_px = 1;     ///< of `tip`, along the stem: a thick end is rounded, and where on it the node is, nobody knows

  friend bool operator==(const RidgeReading&, const RidgeReading&) = default;
};

struct SnapOptions {
  double reach_px = 12;                    ///< how far a click may be moved
  std::optional<double> maxWidth_px = std::nullopt;  ///< of a stem; nothing: a twentieth of the photo's longer side, at least 40
  double click_px = 3;                     ///< usual scatter of a click
  std::optional<Angle> along = std::nullopt;  ///< which way the stem runs, where the caller knows; within 20 degrees
  double leastConfidence = 0.5;
};

/// The widest stem that is looked for.
[[nodiscard]] double widestStem_px(const Photo& photo, const SnapOptions& options);

/// The ridge that `click` means, if there is one.
[[nodiscard]] std::optional<RidgeReading> snapClick(const Photo& photo, PhotoPoint click, const SnapOptions& options = {});

/// What is already known of a node in a photo, from other photos.
struct ExpectedRidge {
  glm::dvec2 at{0, 0};
  double width_px = 0;
};

/// View name -> node -> what was read there.
using RidgeReadings = std::map<std::string, std::map<NodeId, RidgeReading>>;

/// The ridges at all nodes clicked in the view called `view`; nodes without one are left out. Colours of the stems are
/// learned from the clicks themselves where there are enough of them.
[[nodiscard]] std::map<NodeId, RidgeReading> readRidges(const Photo& photo, const std::string& view, std::span<const ClickedNode> nodes,
                                                        std::span<const ClickedStem> stems, const SnapOptions& options = {},
                                                        const std::map<NodeId, ExpectedRidge>& expected = {});

}  // namespace axil::skeleton3d
