#pragma once
/// \file
/// Private to skeleton3d: what colours the stems of a photo have, learned from the stems that were found in it.

#include "skeleton3d/stem_path.hpp"

#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

/// For every pixel how much likelier its colour is inside the stems than beside them and elsewhere in the photo.
/// Empty where too little was found to say, or where the colours do not tell stems from the rest.
[[nodiscard]] StemLikelihood likelihoodOf(const Photo& photo, std::span<const std::vector<EdgePair>> stems);

}  // namespace axil::skeleton3d::detail
