#pragma once
/// \file
/// skeleton.json: a Skeleton as the file of docs/files.md, for other programs and for `axil skeleton` and `axil grow`.

#include "skeleton3d/estimate.hpp"
#include "skeleton3d/types.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::document {

/// Numbers in their shortest exact form. A radius, a width or a shape nobody gave is left out. `suspects` are the clicks that
/// were named as wrong and left out.
[[nodiscard]] std::string skeletonText(const skeleton3d::Skeleton& skeleton, std::span<const skeleton3d::SuspectClick> suspects = {});

/// A sentence for each node that has no place yet: where it is clicked, or that `suspects` left it no click, and what to do.
[[nodiscard]] std::vector<std::string> waitingLines(const skeleton3d::Skeleton& skeleton, std::span<const skeleton3d::SuspectClick> suspects);

}  // namespace axil::document
