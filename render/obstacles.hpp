#pragma once
/// \file
/// Private to render: what stands around a plant, drawn in pictures as smooth grey stone. Never part of a mesh file.

#include "render/types.hpp"
#include "simeco/environment.hpp"

#include <vector>

namespace axil::render {

/// The plant with the obstacles beside it. Their triangles belong to no organ.
[[nodiscard]] PlantMesh withObstacles(PlantMesh mesh, const std::vector<simeco::Obstacle>& obstacles);

/// Those of `obstacles` that a picture of the plant makes room for: no larger than it, and near it. A wall or the ground is
/// shown as far as the picture reaches.
[[nodiscard]] std::vector<simeco::Obstacle> obstaclesToFrame(const PlantMesh& mesh, const std::vector<simeco::Obstacle>& obstacles);

}  // namespace axil::render
