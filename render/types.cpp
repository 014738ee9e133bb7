#include "render/types.hpp"

#include <glm/common.hpp>

namespace axil::render {

void Bounds::add(const glm::dvec3& point) {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

void Bounds::add(const Bounds& other) {
  if (other.empty()) return;
  add(other.low);
  add(other.high);
}

simeco::OrganId faceId(const simeco::Plant& plant, std::size_t face) { return simeco::OrganId(static_cast<std::int32_t>(plant.organs.size() + face)); }
simeco::OrganId ballId(const simeco::Plant& plant, std::size_t ball) { return faceId(plant, plant.faces.size() + ball); }
simeco::OrganId discId(const simeco::Plant& plant, std::size_t disc) { return ballId(plant, plant.balls.size() + disc); }

std::size_t PlantMesh::triangleCount() const {
  std::size_t count = (stems.triangles.size() + faces.triangles.size()) / 3;
  for (const OrganModel& model : models)
    for (const ModelPart& part : model.parts) count += part.mesh.triangles.size() / 3 * model.placements.size();
  return count;
}

Bounds boundsOf(const PlantMesh& mesh) {
  Bounds bounds;
  for (const glm::vec3& p : mesh.stems.positions) bounds.add(p);
  for (const glm::vec3& p : mesh.faces.positions) bounds.add(p);
  for (const OrganModel& model : mesh.models)
    for (const ModelPart& part : model.parts)
      for (const Placement& at : model.placements)
        for (const glm::vec3& p : part.mesh.positions) bounds.add(at.position + at.rotation * (at.scale * p));
  return bounds;
}

}  // namespace axil::render
