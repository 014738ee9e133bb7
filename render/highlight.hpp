#pragma once
/// \file
/// Some organs of a plant in another colour, for example all that is predicted: the mesh stays as it is, triangle for triangle.

#include "render/types.hpp"

#include <vector>

namespace axil::render {

/// How far to go over to a colour (linear RGB); `share` 0 leaves everything, 1 is all of it.
struct Highlight {
  glm::vec3 colour{0.5f};
  float share = 0.5f;
};

/// `chosen` says for each organ, by its number, whether it is tinted; organs beyond its end are not. Stems run smoothly from one
/// colour to the other where chosen and other organs meet.
[[nodiscard]] PlantMesh highlighted(PlantMesh mesh, const std::vector<bool>& chosen, const Highlight& highlight);

}  // namespace axil::render
