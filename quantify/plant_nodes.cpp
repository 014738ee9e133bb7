#include "quantify/plant_nodes.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace axil::quantify {

std::vector<glm::dvec3> nodesOf(const Measurements& m) {
  std::vector<glm::dvec3> nodes{m.origin.at};
  for (const Segment& s : m.segments) nodes.push_back((s.parent ? nodes[static_cast<std::size_t>(s.parent->value) + 1] : m.origin.at) + s.direction.unit() * s.length);
  return nodes;
}

Box boxOf(const std::vector<glm::dvec3>& nodes) {
  Box box{nodes.front(), nodes.front()};
  for (const glm::dvec3& n : nodes) box = {glm::min(box.low, n), glm::max(box.high, n)};
  return box;
}
double heightOf(const std::vector<glm::dvec3>& nodes) {
  const Box box = boxOf(nodes);
  const glm::dvec3 size = box.high - box.low;
  return std::max(size.y, 0.1 * std::max({size.x, size.y, size.z}));
}

}  // namespace axil::quantify
