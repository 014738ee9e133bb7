#pragma once
/// \file
/// One moment of a growth: a plant's bodies as organs at a time, and the light that they leave each other. Internal to growth.

#include "base/progress.hpp"
#include "simeco/growth_data.hpp"

namespace axil::simeco {

/// Adds the organs that `plant` has at `time`; says for each body which organ it became, -1 where there is none.
std::vector<std::int32_t> addOrgans(const GrowthData& data, const PlantHistory& plant, double time, std::vector<Organ>& organs);

/// All plants at `time`.
[[nodiscard]] Plant momentOf(const GrowthData& data, double time);

/// The time from which on all sizes stay as they are.
[[nodiscard]] double fullSizeTime(const GrowthData& data);

/// All times up to `upTo` at which a plant of the ecosystem takes a step, or would if it still took any. Fails with LimitReached
/// where there are too many.
[[nodiscard]] Result<std::vector<double>> stepTimes(const GrowthData& data, double upTo);

/// Whether any organ grows as its light lets it.
[[nodiscard]] bool asksForLight(const GrowthData& data);

/// Gives the bodies that grow at `time` the light that they have from then on to the next light step. Times must come in order.
void addLightStep(GrowthData& data, double time);

}  // namespace axil::simeco
