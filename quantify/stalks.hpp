#pragma once
/// \file
/// Leaf stalks that a grammar wrote as stems. A grown plant's stalk is a stem like any other; to count it as a branch would be wrong.

#include "skeleton3d/types.hpp"

namespace axil::quantify {

/// `skeleton` with every stem that is nothing but the stalk of one leaf given to that leaf: a stem of one segment that bears no stem, and whose only leaf goes
/// straight on from its tip; or the last segment of a stem, where it is like the stalks beside it. Such a leaf stands off a node of the stem that bore the stalk, as `measure` wants it.
[[nodiscard]] skeleton3d::Skeleton withoutStalks(skeleton3d::Skeleton skeleton);

}  // namespace axil::quantify
