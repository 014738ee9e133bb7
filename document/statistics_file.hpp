#pragma once
/// \file
/// What `axil fit-statistics` prints: layered statistics as a table for people or as JSON for programs. Angles in degrees.

#include "quantify/layers.hpp"

#include <string>

namespace axil::document {

[[nodiscard]] std::string statisticsText(const quantify::LayeredStatistics& statistics);

/// docs/prediction.md has the keys.
[[nodiscard]] std::string statisticsJson(const quantify::LayeredStatistics& statistics);

}  // namespace axil::document
