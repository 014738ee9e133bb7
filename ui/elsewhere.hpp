#pragma once
/// \file
/// The same node in another photo: where a stem is clicked in both, a node clicked on it in one is, in the other, where its epipolar line
/// crosses the stem. Such places are computed for nodes that are put into a stem, and for those that wait for their second click. They are
/// marked as placed: what cameras are estimated from must not itself follow from them.

#include "document/command.hpp"
#include "ui/clicking.hpp"
#include "ui/proposals.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axil::ui {

/// Where a place on a stem, clicked at `at` in `from`, is in `to`; nothing where the stem is not clicked there on both sides of it, or the
/// lines run too nearly along each other to say.
[[nodiscard]] std::optional<PhotoPoint> placeElsewhere(const document::Project& project, const Placed& placed, const PlaceOnStem& place, const std::string& from,
                                                       PhotoPoint at, const std::string& to);

struct FoundPlace {
  document::NodeId node;
  std::string view;
  PhotoPoint at;
  double within_px = 0;
};
/// The places of the nodes that are clicked in one photo alone, each in the first other photo that has one for it.
[[nodiscard]] std::vector<FoundPlace> placesOfWaiting(const document::Project& project, const Placed& placed);

/// A computed place on the centre line of the stem that it is close to; itself where there is none, or the photo is not read (null).
[[nodiscard]] PhotoPoint centred(const skeleton3d::Photo* photo, PhotoPoint at);

}  // namespace axil::ui
