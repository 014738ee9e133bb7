#pragma once
/// \file
/// Ridges: the profile of a photo across a stem and how well two edges in it bound a stem. A stem is a band that is lighter,
/// darker or of another colour than what is to both sides of it; its centre line is midway between its two edges, whatever
/// the shading between them.
///
/// Units: pixels of the photo; edge strengths in grey levels (0 to 255 a channel) of the step that they stand for.
/// Pure arithmetic on pixels; nothing fails: outside the photo its border goes on.
/// Source: beyond L-Grammar Generator 2005.

#include "base/frames.hpp"
#include "skeleton3d/photo.hpp"

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace axil::skeleton3d {

/// How likely each pixel is the plant's, 0 to 255, row by row; empty: unknown.
using StemLikelihood = std::vector<std::uint8_t>;

/// The photo along a line across a stem: samples `kRidgeStep_px` apart, the middle one at the line's centre; each is averaged
/// over a few pixels along the stem. Red, green, blue, and the likelihood (0 where it is unknown).
struct RidgeProfile {
  std::vector<glm::vec4> colour;
  std::vector<glm::vec4> slope;   ///< derivative, smoothed, times the smoothing's width: the height of a step, in grey levels
  double reach_px = 0;            ///< the samples go from -reach to +reach
  bool hasLikelihood = false;
};

inline constexpr double kRidgeStep_px = 0.5;

/// The nearest pixel is good enough to find a band, four times as fast as to measure it.
enum class Sampling { BetweenPixels, NearestPixel };

struct ProfileOptions {
  double reach_px = 30;
  double blur_px = 1;   ///< standard deviation of the smoothing of `slope`
  int along_px = 1;     ///< averaged over this far to both sides along the stem
  Sampling sampling = Sampling::BetweenPixels;
};

/// `across` is a unit vector.
[[nodiscard]] RidgeProfile profileAcross(const Photo& photo, const StemLikelihood& likelihood, glm::dvec2 centre, glm::dvec2 across, const ProfileOptions& options = {});

/// How well edges at `left` and `right` (px from the centre, left < right) bound a stem: about the height in grey levels of the
/// weaker of both edges, less where they are of different colours; 0 where the likelihood says that the stem is outside.
[[nodiscard]] double ridgeStrength(const RidgeProfile& profile, double left, double right);

/// The same where the width is known from elsewhere: one edge that is seen is worth half of two, since of stems that overlap
/// in the photo only the outer edges show.
[[nodiscard]] double ridgeStrengthOfKnownWidth(const RidgeProfile& profile, double left, double right);

/// How strongly the left or right edge of a stem is seen at `at`: the rise towards the stem in grey levels, of the likelihood where it is known.
enum class StemSide { Left, Right };
[[nodiscard]] double edgeStrength(const RidgeProfile& profile, double at, StemSide side);

/// An edge near `at`, moved to where it is steepest within `reach_px`, sub-pixel.
[[nodiscard]] double sharpened(const RidgeProfile& profile, double at, double reach_px);

}  // namespace axil::skeleton3d
