#pragma once
/// \file
/// A draft by itself: from masks of the plant in two or more photos with known cameras to a tree of stems, without a click.
/// A person corrects it afterwards.
///
/// Space about the plant is carved by the masks into small cubes; ways from the collar through the cubes are cheap where
/// they run along the middle lines (medial axes) of the masks in all views. Of all ways those are kept, one after the other, that explain
/// most of the middle lines that nothing explains yet: stems that only seem to be there, where others cross in the
/// photos, explain nothing new. Each stem carries how sure it is.
///
/// Plant frame, project's unit. Fails with BadInput where cameras are unknown or masks do not fit their views, with NoAnswer
/// where the masks have no common space or nothing of it is near the origin.
/// Source: beyond L-Grammar Generator 2005; visual hulls and medial axes.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "skeleton3d/photo.hpp"
#include "skeleton3d/types.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

/// Which pixels are the plant's: 0 is background, anything else plant. Row by row from the top.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> plant;
};

/// A mask file: pixels of 128 and more are the plant's. Fails as readPhoto does.
[[nodiscard]] Result<Mask> readMask(const std::filesystem::path& path);

/// A box of pixels that holds the whole plant.
struct PlantBox {
  glm::dvec2 from{0, 0};
  glm::dvec2 to{0, 0};
};

/// The plant in `photo` by the colours inside and outside `box` (OpenCV's grabCut on a hundred thousand pixels at most, begun with what looks
/// unlike all that is usual outside the box; its border then by each pixel's own colour). Before a wall of many colours it finds what is
/// strangest there, which may be no plant. Fails with BadInput for a box or photo of next to no size, with NoAnswer where nothing is left, with Cancelled.
[[nodiscard]] Result<Mask> maskByColour(const Photo& photo, const PlantBox& box, const Watch& watch = {});

struct DraftOptions {
  int cubesAcross = 350;        ///< cubes along the plant's reach; fewer where a leafy mask would leave more than half a million
  double leastLength = 0.010;    ///< of a stem, as a share of the plant's size
  int maxStems = 400;
  Watch watch = {};
};

struct DraftStem {
  std::optional<std::size_t> parent;   ///< number of an earlier stem; none: begins at the collar
  std::vector<PlantPoint> points;      ///< the first lies on the parent
  std::vector<double> radius;
  double sureness = 0;                 ///< 0 to 1: how much of it no other stem explains, in how many views
};

/// Stems, a parent before its children.
[[nodiscard]] Result<std::vector<DraftStem>> draftStems(std::span<const View> views, const std::map<std::string, Mask>& masks, const DraftOptions& options = {});

/// A draft as if a person had clicked it, to be corrected as any clicks are: each node clicked in every view that shows its place.
struct DraftClicks {
  std::vector<ClickedNode> nodes;     ///< with radii
  std::vector<ClickedStem> stems;     ///< as many as drafted, in their order
};

/// Node and stem ids count up from the ones given.
[[nodiscard]] DraftClicks clicksOf(std::span<const View> views, std::span<const DraftStem> stems, NodeId firstNode, StemId firstStem);

}  // namespace axil::skeleton3d
