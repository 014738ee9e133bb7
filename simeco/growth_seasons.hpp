#pragma once
/// \file
/// Plants in their surroundings: the environment through time, and what happens at every step: the host answers, light falls. Internal to growth.

#include "simeco/growth.hpp"
#include "simeco/growth_attributes.hpp"
#include "simeco/growth_data.hpp"

#include <span>
#include <vector>

namespace axil::simeco {

/// Environments in order of time, ready to grow in; the grammar's own obstacles stand in each.
class Scenes {
 public:
  explicit Scenes(std::vector<Obstacle> own) : own_(std::move(own)) {}

  /// Fails with BadInput for an environment that makes no sense.
  [[nodiscard]] Result<void> add(double from, Environment environment);
  [[nodiscard]] std::span<const Scene> all() const { return scenes_; }

 private:
  std::vector<Obstacle> own_;
  std::vector<Scene> scenes_;
};

/// What grammar and host say before anything grows.
[[nodiscard]] Result<Scenes> scenesOf(const Grammar& grammar, const GrowOptions& options);

/// Puts the recorded plants into the scenes and goes through their steps in order of time: first the host may change the environment,
/// then light falls. Fails with BadInput for a plant that stands in an obstacle, and as the host does.
[[nodiscard]] Result<void> live(GrowthData& data, const Grammar& grammar, const GrowOptions& options, Scenes scenes);

}  // namespace axil::simeco
