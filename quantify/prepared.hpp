#pragma once
/// \file
/// Plants made ready for what this room computes from many: in one unit, each with its structure. Private to this room.

#include "base/result.hpp"
#include "quantify/layers.hpp"
#include "quantify/outlook.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::quantify {

/// Movable, not copyable: `measured` points into the other two.
struct PreparedPlants {
  PreparedPlants() = default;
  PreparedPlants(PreparedPlants&&) = default;
  PreparedPlants& operator=(PreparedPlants&&) = default;
  PreparedPlants(const PreparedPlants&) = delete;
  PreparedPlants& operator=(const PreparedPlants&) = delete;

  std::vector<Measurements> plants;
  std::vector<PlantStructure> structures;
  std::vector<MeasuredPlant> measured;
  std::vector<std::string> warnings;   ///< of units
};

/// Fails with NoAnswer where there is no plant, or one without a segment, and as inOneUnit does.
[[nodiscard]] Result<PreparedPlants> prepared(std::span<const Measurements> plants);

/// Statistics of plants that are ready.
[[nodiscard]] LayeredStatistics statisticsOf(const PreparedPlants& plants);

/// The outlook of the first, whatever they show; and of each of them, which costs little more.
[[nodiscard]] Outlook outlookOf(const PreparedPlants& plants);
[[nodiscard]] std::vector<Outlook> outlooksOf(const PreparedPlants& plants);

/// Whether most plants are sympodial: their axes are modules of one kind, whatever their order.
[[nodiscard]] bool mostlySympodial(const LayeredStatistics& statistics);

}  // namespace axil::quantify
