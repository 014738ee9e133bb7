#pragma once
/// \file
/// Ghosts: what the same grammar would grow with other seeds, as thin lines over the plant, so that a prediction is seen with its spread.

#include "simeco/environment.hpp"
#include "ui/following.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace axil::ui {

struct GhostQuestion {
  std::shared_ptr<const GrownGrammar> grammar;
  std::uint64_t seed = 1;    ///< of the plant that is shown; ghosts have those after it
  int ghosts = 0;
  double time = 0;
  simeco::Environment environment = {};
};

/// Stems of one ghost: from, to.
using Ghost = std::vector<std::pair<PlantPoint, PlantPoint>>;

using GhostGrower = Worker<GhostQuestion, std::vector<Ghost>>;
[[nodiscard]] GhostGrower::Work ghostWork();

}  // namespace axil::ui
