#pragma once
/// \file
/// Whether plants that were put together are of one kind. Private to this room; layeredStatistics warns with it.

#include "quantify/layers.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::quantify {

/// A sentence for each quantity in which plants disagree by more than their samples explain and by more than plants of one kind do: angles, ratios
/// and shares, never sizes (one species has small and large plants).
[[nodiscard]] std::vector<std::string> disagreements(const LayeredStatistics& statistics, std::span<const MeasuredPlant> plants);

}  // namespace axil::quantify
