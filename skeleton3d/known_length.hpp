#pragma once
/// \file
/// The ends of a known length, exactly: a click of three pixels at each end of a rod that spans 160 leaves its length open by
/// 2.6 %, and with it the size of the plant; the photo says where the rod ends to a fraction of a pixel.
///
/// How, for each end: the rod's two edges just inside the end give its middle line; along that the place where the colour
/// changes across the rod but not beside it (a joint of bricks behind a rod goes on at both sides, the end of the rod does not)
/// is the end. It is taken only where it stands out clearly among all places near the click; else the click stays.
/// A rod painted in four or more bands of equal length is measured by all edges between its bands instead, which need no end
/// that stands out and a few of which may be hidden.
/// Pixels are the upright photo's. Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/photo.hpp"
#include "skeleton3d/types.hpp"

#include <array>
#include <optional>

namespace axil::skeleton3d {

struct SnappedLength {
  KnownLength scale;
  bool fromMoved = false;  ///< the photo says where this end is; else it is where it was clicked
  bool toMoved = false;
  std::array<std::optional<double>, 2> sigma_px = {};  ///< standard deviations of `from` and `to` where the photo says it

  friend bool operator==(const SnappedLength&, const SnappedLength&) = default;
};

/// Ends nearer than 40 px to one another (a rod seen from its tip) are left as they are. `focal_px`, where it is known: the
/// front of a round banded rod is nearer to the camera than its axis, so it looks longer by its radius over its distance.
[[nodiscard]] SnappedLength snapKnownLength(const Photo& photo, const KnownLength& clicked, std::optional<double> focal_px = std::nullopt);

}  // namespace axil::skeleton3d
