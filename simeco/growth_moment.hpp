#pragma once
/// \file
/// One moment of a growth: a plant's bodies as organs at a time, and the light that they leave each other. Internal to growth.

#include "base/progress.hpp"
#include "simeco/growth_data.hpp"

namespace axil::simeco {

/// Adds the organs that `plant` has at `time`; says for each body which organ it became, -1 where there is none.
std::vector<std::int32_t> addOrgans(const GrowthData& data, const PlantHistory& plant, double time, std::vector<Organ>& organs);

/// The time from which on all sizes stay as they are.
[[nodiscard]] double fullSizeTime(const GrowthData& data);

/// Works out how much light each organ that asks for it has, step of time after step of time up to `upTo`. Fails with LimitReached
/// where there are too many steps, with Cancelled.
[[nodiscard]] Result<void> addLight(GrowthData& data, double upTo, const Watch& watch);

}  // namespace axil::simeco
