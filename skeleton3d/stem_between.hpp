#pragma once
/// \file
/// A stem that was traced in one view, proposed in another: matched as a whole curve, so that a bent stem costs two clicks in
/// the first view and at most one, to say where it ends, in the other.
///
/// Every place of the traced way can be anywhere along its ray; the way through all these rays is wanted that runs along
/// something that looks like a stem in the other photo, is as wide as it should be there, has its direction and does not leap
/// in depth. Dynamic programming finds it (places in order, depths as states). Then it is moved onto the centre line seen
/// in the other photo.
///
/// Cameras must be known or estimated. Pixels of both views, places in the project's unit.
/// Source: beyond L-Grammar Generator 2005; stereo by scan lines, along curves instead of rows.

#include "skeleton3d/guides.hpp"
#include "skeleton3d/live_wire.hpp"

#include <optional>
#include <vector>

namespace axil::skeleton3d {

/// One place of a stem, seen in both views.
struct StemPlace {
  PhotoPoint inFirst, inOther;
  PlantPoint at;
  double width_px = 0;     ///< in the first view; 0: unknown
  double confidence = 0;   ///< 0 to 1: that the other view shows a stem there

  friend bool operator==(const StemPlace&, const StemPlace&) = default;
};

struct StemBetween {
  std::vector<StemPlace> nodes;   ///< few: the lines through them are within the tolerance of `line` in both views
  std::vector<StemPlace> line;
  double confidence = 0;          ///< 0 to 1; small where nothing like a stem was found or where another course fits as well

  friend bool operator==(const StemBetween&, const StemBetween&) = default;
};

struct BetweenOptions {
  double click_px = 1.5;                        ///< scatter of the traced way and of the cameras together, px
  double tolerance_px = 1.5;                    ///< as WireOptions::tolerance_px
  std::optional<PlantPoint> base = std::nullopt;      ///< where the stem begins, if that node has its place already
  std::optional<PhotoPoint> startInOther = std::nullopt;  ///< a click in the other view where the way begins
  std::optional<PhotoPoint> endInOther = std::nullopt;    ///< ... or ends: the third click
};

/// `reach`: see reachOf. Fails with BadInput where a camera is unknown or the way has no length, with NoAnswer where no place of the
/// way can be seen in the other view.
[[nodiscard]] Result<StemBetween> tracedInOtherView(const View& first, const WirePath& path, const View& other, const LiveWire& otherPhoto, const Reach& reach,
                                                    const BetweenOptions& options = {});

}  // namespace axil::skeleton3d
