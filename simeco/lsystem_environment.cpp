#include "simeco/lsystem_environment.hpp"

#include "simeco/light_grid.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::simeco {

EnvironmentProgram lightProgram(const glm::dvec3& toLight) {
  return [toLight](const Communication& communication) -> Result<void> {
    if (!PlantDirection::hasDirection(toLight)) return fail(ErrorCode::BadInput, "light must come from somewhere: the direction to it is 0 or not a number");
    std::vector<ShadePatch> patches;
    for (const DrawnPatch& patch : communication.patches)
      if (patch.area > 0 && std::isfinite(patch.area)) patches.push_back({{patch.at}, patch.area});
    double largest = 0;
    for (const ShadePatch& patch : patches) largest = std::max(largest, patch.area);
    const LightGrid grid(patches, PlantDirection::along(toLight), std::sqrt(largest));
    for (Message& message : communication.messages)
      if (!message.parameters.empty()) message.parameters[0] = grid.lightAt({message.frame.position});
    return {};
  };
}

}  // namespace axil::simeco
