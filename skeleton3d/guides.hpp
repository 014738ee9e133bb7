#pragma once
/// \file
/// Guides between views: where in another view a point can be that was clicked in this one. The clicked point lies on its
/// ray; the ray as far as the plant reaches, projected into the other view, is a curve (straight without lens distortion),
/// and with the scatter of the clicks and cameras a band about it. Candidates near the band, for example places on the centre lines of stems
/// that imaging found there, are ranked by how well they fit, so that the second click is mostly a confirmation.
///
/// Units: pixels of the two views; depths in the project's unit. Cameras must be known or estimated.
/// Source: beyond L-Grammar Generator 2005; Hartley and Zisserman's epipolar geometry, as curves for any lens.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axil::skeleton3d {

/// One place of a guide: the point of the ray at `depth` from the clicking camera, seen in the other view.
struct GuidePoint {
  PhotoPoint at;
  double depth = 0;
  double sigma_px = 0;  ///< standard deviation across the curve; a band of twice that on both sides holds 95 %

  friend bool operator==(const GuidePoint&, const GuidePoint&) = default;
};

/// Empty where the plant's reach is nowhere visible in the other view. Along increasing depth.
struct Guide {
  std::vector<GuidePoint> curve;

  friend bool operator==(const Guide&, const Guide&) = default;
};

/// The plant's reach: the ray is followed where it is inside this ball.
struct Reach {
  PlantPoint centre;
  double radius = 1;
};

/// The ball about nodes that are already placed, a third larger; for the first click of all a ball about the origin.
[[nodiscard]] Reach reachOf(std::span<const PlantPoint> placed, double otherwise);

/// `click_px`: scatter of a click; `camera_px`: of the other view's cameras, that is how far its nodes typically are off.
/// Fails with BadInput where a camera is unknown or a number is none, with NoAnswer where the ray misses the reach.
[[nodiscard]] Result<Guide> guideBetween(const View& clicked, PhotoPoint click, const View& other, const Reach& reach, double click_px, double camera_px = 0);

/// A place that could be the same point, as imaging finds it; what is not known is left out.
struct GuideCandidate {
  PhotoPoint at;
  std::optional<double> width_px;             ///< of the stem there
  std::optional<Angle> along;                 ///< which way the stem runs, in the picture, x towards y; 180 degrees are the same
  double strength = 1;                        ///< 0 to 1: how sure it is that there is a stem
};

/// What the person's click is known to be: everything is optional.
struct GuideExpectation {
  std::optional<double> width;                ///< the stem's true width, project's unit, from the first view
  std::optional<PlantPoint> before;           ///< the node before it in its stem
  std::optional<double> length;               ///< usual distance to it
  std::optional<PlantDirection> direction;    ///< the stem's direction at `before`
};

struct RankedCandidate {
  std::size_t candidate = 0;  ///< its number in the list given
  double probability = 0;     ///< among all of them, that no candidate is right included
  double off_px = 0;          ///< across the guide
  PlantPoint place;           ///< where the node would be
};

/// The candidates that are within four standard deviations of the guide, likeliest first; the order of equal ones is theirs.
[[nodiscard]] std::vector<RankedCandidate> rankCandidates(const View& clicked, PhotoPoint click, const View& other, const Guide& guide, std::span<const GuideCandidate> candidates,
                                                          const GuideExpectation& expected = {});

}  // namespace axil::skeleton3d
