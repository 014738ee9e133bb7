#pragma once
/// \file
/// A lens from photos of a chessboard: focal length, middle and distortion of OpenCV's model (k1, k2, p1, p2, k3), for
/// photos that the same camera takes at the same zoom and size. Units: pixels of the upright photo.
///
/// The board's inner corners are found sub-pixel and the lens is fitted to all photos at once; a photo whose corners fit
/// far worse than the others' is left out and named. k3 is fitted only where corners reach far into the photo's corners.
///
/// Fails with BadInput (no photo, a board of fewer than 3 x 3 inner corners, photos of different sizes), NoAnswer (the board
/// found in fewer than three photos, or always held in the same way, so that focal length and distance cannot be told
/// apart) and as photo.hpp says. Messages name the photos.
/// Source: beyond L-Grammar Generator 2005.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

struct CalibrateOptions {
  /// Inner corners across and down; none: the usual boards are tried, largest first.
  std::optional<glm::ivec2> corners = std::nullopt;
};

struct CalibratedPhoto {
  std::string name;
  double rms_px = 0;   ///< of its corners
  std::string fault;   ///< why it was left out; empty: it was used

  friend bool operator==(const CalibratedPhoto&, const CalibratedPhoto&) = default;
};

struct CalibratedLens {
  glm::ivec2 size_px{0, 0};
  glm::ivec2 corners{0, 0};
  glm::dvec2 focal_px{0, 0};
  glm::dvec2 focalSigma_px{0, 0};
  glm::dvec2 centre_px{0, 0};
  glm::dvec2 centreSigma_px{0, 0};
  std::array<double, 5> distortion{0, 0, 0, 0, 0};
  double rms_px = 0;
  std::vector<CalibratedPhoto> photos;

  friend bool operator==(const CalibratedLens&, const CalibratedLens&) = default;
};

[[nodiscard]] Result<CalibratedLens> calibrateLens(std::span<const std::filesystem::path> photos, const CalibrateOptions& options = {},
                                                    const Watch& watch = {});

}  // namespace axil::skeleton3d
