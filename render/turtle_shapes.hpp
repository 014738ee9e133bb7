#pragma once
/// \file
/// Private to render: what an L-system's turtle draws beside stems and leaves. Filled polygons become faces, spheres balls,
/// circles discs. Each is numbered after the organs, as TriangleSource::organ says (types.hpp).

#include "base/result.hpp"
#include "render/types.hpp"

namespace axil::render {

/// Adds the plant's faces, balls and discs to `mesh`. Polygons need be neither flat nor convex; one that crosses itself is
/// filled as far as it can be.
void addTurtleShapes(PlantMesh& mesh, const simeco::Plant& plant, organs::Detail detail);

/// Fails with BadInput where a face, ball or disc has no finite place and size.
[[nodiscard]] Result<void> checkTurtleShapes(const simeco::Plant& plant);

}  // namespace axil::render
