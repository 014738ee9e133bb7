#pragma once
/// \file
/// Where a measured plant's nodes stand. Private to this room.

#include "quantify/types.hpp"

#include <glm/vec3.hpp>

#include <vector>

namespace axil::quantify {

/// Node 0 is the root, node s + 1 the tip of segment s.
[[nodiscard]] std::vector<glm::dvec3> nodesOf(const Measurements& m);

struct Box {
  glm::dvec3 low, high;
};
[[nodiscard]] Box boxOf(const std::vector<glm::dvec3>& nodes);

/// Of a plant that lies down, a tenth of its extent.
[[nodiscard]] double heightOf(const std::vector<glm::dvec3>& nodes);

}  // namespace axil::quantify
