#pragma once
/// \file
/// Leaves on stems: a botanical arrangement, a count and a few numbers become blades with places and sides in the plant's
/// frame. Lengths in the skeleton's unit.
///
/// Leaf nodes stand evenly along the stem's arc, at k/n of its length for k = 1 to n, the last at the tip; clustered
/// arrangements stand at one place (a rosette at the stem's base, others at its tip). A place within 2 % of the stem's length of a
/// skeleton node is that node; elsewhere a node is inserted into the chain, with an id above all others, radius and
/// uncertainty interpolated. Around the stem each leaf node is turned by the arrangement's divergence against the one below,
/// counted from a reference that follows the stem's bends without twisting.
///
/// What an arrangement leaves out comes from the description's presets, else: spiral by 137.5 degrees, 55 degrees from the
/// stem, not rolled, no stalk, a blade of 8 % of the skeleton's largest extent, a width of 0 (its shape decides), and the first leaf
/// at the side of a leaning stem (level with the ground) or at rotu 0 of an upright one.
/// Source: L-Grammar Generator 2005, section 3.2.3.

#include "base/result.hpp"
#include "keywords/types.hpp"
#include "quantify/types.hpp"
#include "skeleton3d/types.hpp"

#include <span>

namespace axil::quantify {

/// `skeleton` with the leaves of `arrangements` after those it has. Fails with BadInput for a stem, node or arrangement that
/// does not exist, for neither or both of a count and a list of nodes that disagree, for a count outside 1 to 10,000, and
/// for numbers that are not finite or out of range; else as quantify::measure does.
[[nodiscard]] Result<skeleton3d::Skeleton> withLeaves(const skeleton3d::Skeleton& skeleton, std::span<const LeafArrangement> arrangements,
                                                      const keywords::Presets& presets = {});

}  // namespace axil::quantify
