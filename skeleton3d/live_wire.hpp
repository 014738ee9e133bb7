#pragma once
/// \file
/// Live-wire: the way along a stem from one place of a photo to another, while the mouse moves.
///
/// Three steps, each a plain value that may be made on any thread and is never changed afterwards:
/// `prepareLiveWire` once a photo (seconds at 12 megapixels, cancellable), `startWire` once a first click (tenths of a second),
/// `wireTo` for every move of the mouse (a few milliseconds). The way is the cheapest one on a cost that is low in the
/// middle of whatever looks like a stem (OpenCV's intelligent scissors), moved to between the stem's two edges, sub-pixel,
/// and resampled to the fewest nodes that stay within a stated distance of it.
///
/// Pixels of the upright photo. Where there is no stem the way is kept but its confidence is near 0.
/// Source: beyond L-Grammar Generator 2005; Mortensen and Barrett's intelligent scissors on a cost for ridges.

#include "base/frames.hpp"
#include "base/progress.hpp"
#include "base/result.hpp"
#include "skeleton3d/photo.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace axil::skeleton3d {

namespace detail {
struct PreparedWire;
struct WireMap;
}  // namespace detail

/// A photo made ready. Copies are cheap and share it.
class LiveWire {
 public:
  explicit LiveWire(std::shared_ptr<const detail::PreparedWire> prepared) : prepared_(std::move(prepared)) {}
  [[nodiscard]] const detail::PreparedWire& prepared() const { return *prepared_; }
  [[nodiscard]] const std::shared_ptr<const detail::PreparedWire>& shared() const { return prepared_; }

 private:
  std::shared_ptr<const detail::PreparedWire> prepared_;
};

/// Every cheapest way from one place of the photo. Copies are cheap and share it.
class WireStart {
 public:
  WireStart(PhotoPoint from, std::shared_ptr<const detail::WireMap> map) : from_(from), map_(std::move(map)) {}
  [[nodiscard]] PhotoPoint from() const { return from_; }
  [[nodiscard]] const detail::WireMap& map() const { return *map_; }

 private:
  PhotoPoint from_;
  std::shared_ptr<const detail::WireMap> map_;
};

/// One node of a way.
struct WireNode {
  PhotoPoint at;            ///< on the stem's centre line
  double width_px = 0;      ///< of the stem there; 0: no stem
  double confidence = 0;    ///< 0 to 1: that there is a stem

  friend bool operator==(const WireNode&, const WireNode&) = default;
};

struct WirePath {
  std::vector<WireNode> nodes;   ///< two at least; the line through them is within the tolerance of `line`
  std::vector<WireNode> line;    ///< the way itself, some pixels apart
  double confidence = 0;         ///< typical one along the way; below 0.3 there is hardly a stem

  friend bool operator==(const WirePath&, const WirePath&) = default;
};

struct WireOptions {
  double tolerance_px = 1.5;   ///< how far the line through the nodes may be from the stem's centre line
  double reach_px = 12;        ///< how far the two ends may be moved onto the stem
};

/// Fails with BadInput for a photo of less than 8 px or without pixels, with Cancelled.
[[nodiscard]] Result<LiveWire> prepareLiveWire(std::shared_ptr<const Photo> photo, const Watch& watch = {});

/// A piece of a stem that has been followed already, from one click to the next.
using TakenSegment = std::pair<PhotoPoint, PhotoPoint>;

/// Along `taken` a way is dearer than along a stem that nobody has followed yet, and cheaper than where there is no stem: a branch beside
/// its parent is not the parent again. Fails with BadInput where `from` is outside the photo.
[[nodiscard]] Result<WireStart> startWire(const LiveWire& wire, PhotoPoint from, std::span<const TakenSegment> taken = {});

/// `to` is moved into the photo if it is outside.
[[nodiscard]] WirePath wireTo(const WireStart& start, PhotoPoint to, const WireOptions& options = {});

/// All at once, for the command line and tests.
[[nodiscard]] Result<WirePath> wireBetween(const LiveWire& wire, PhotoPoint from, PhotoPoint to, const WireOptions& options = {});

}  // namespace axil::skeleton3d
