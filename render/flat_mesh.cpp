#include "render/flat_mesh.hpp"

#include "base/rng.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace axil::render {
namespace {

/// How strongly the leaves of one plant differ: brightness, and from yellowish to bluish.
constexpr double brightnessSpread = 0.12, hueSpread = 0.07;

glm::vec3 tintOf(simeco::OrganId organ, Tint tint) {
  if (tint == Tint::None) return glm::vec3(1);
  Rng rng = Rng(0x1eaf).split(static_cast<std::uint64_t>(organ.value));
  const double brightness = 1 + rng.uniform(-brightnessSpread, brightnessSpread);
  const double yellow = rng.uniform(-hueSpread, hueSpread);
  return glm::vec3(brightness * (1 + yellow), brightness, brightness * (1 - yellow));
}

struct Counts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

Counts countsOfModels(const PlantMesh& mesh) {
  Counts counts;
  for (const OrganModel& model : mesh.models)
    for (const ModelPart& part : model.parts) {
      counts.vertices += part.mesh.positions.size() * model.placements.size();
      counts.triangles += part.mesh.triangles.size() / 3 * model.placements.size();
    }
  return counts;
}

FlatMesh withRoomFor(std::size_t vertices, std::size_t triangles) {
  FlatMesh flat;
  flat.positions.reserve(vertices);
  flat.normals.reserve(vertices);
  flat.colours.reserve(vertices);
  flat.materials.reserve(vertices);
  flat.triangles.reserve(triangles * 3);
  flat.sources.reserve(triangles);
  return flat;
}

void append(FlatMesh& flat, const ModelPart& part, const Placement& at, const glm::vec3& colour) {
  const auto first = static_cast<std::uint32_t>(flat.positions.size());
  const glm::mat3 turn = glm::mat3_cast(at.rotation);
  const glm::mat3 place(turn[0] * at.scale.x, turn[1] * at.scale.y, turn[2] * at.scale.z);
  const glm::mat3 normal(turn[0] / at.scale.x, turn[1] / at.scale.y, turn[2] / at.scale.z);
  for (const glm::vec3& p : part.mesh.positions) flat.positions.push_back(at.position + place * p);
  for (const glm::vec3& n : part.mesh.normals) flat.normals.push_back(glm::normalize(normal * n));
  flat.colours.insert(flat.colours.end(), part.mesh.positions.size(), colour);
  flat.materials.insert(flat.materials.end(), part.mesh.positions.size(), part.material);
  for (const std::uint32_t index : part.mesh.triangles) flat.triangles.push_back(first + index);
  flat.sources.insert(flat.sources.end(), part.mesh.triangles.size() / 3, {at.organ, part.material});
}

/// `tint` makes faces differ a little, as it does leaves; stems are drawn as they are.
void append(FlatMesh& flat, const StemMesh& part, Tint tint) {
  const auto first = static_cast<std::uint32_t>(flat.positions.size());
  flat.positions.insert(flat.positions.end(), part.positions.begin(), part.positions.end());
  flat.normals.insert(flat.normals.end(), part.normals.begin(), part.normals.end());
  flat.colours.insert(flat.colours.end(), part.colours.begin(), part.colours.end());
  flat.sources.insert(flat.sources.end(), part.sources.begin(), part.sources.end());
  flat.materials.resize(flat.positions.size());
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    const std::uint32_t vertex = part.triangles[i];
    flat.triangles.push_back(first + vertex);
    flat.materials[first + vertex] = part.sources[i / 3].material;
    if (tint == Tint::Natural) flat.colours[first + vertex] = part.colours[vertex] * tintOf(part.sources[i / 3].organ, tint);
  }
}

void appendModels(FlatMesh& flat, const PlantMesh& mesh, Tint tint) {
  for (const OrganModel& model : mesh.models)
    for (const Placement& at : model.placements)
      for (const ModelPart& part : model.parts)
        append(flat, part, at, mesh.materials[static_cast<std::size_t>(part.material)].colour * tintOf(at.organ, tint));
}

}  // namespace

FlatMesh flattenedModels(const PlantMesh& mesh, Tint tint) {
  const Counts counts = countsOfModels(mesh);
  FlatMesh flat = withRoomFor(counts.vertices, counts.triangles);
  appendModels(flat, mesh, tint);
  return flat;
}

FlatMesh flattened(const PlantMesh& mesh, Tint tint) {
  const std::size_t vertices = countsOfModels(mesh).vertices + mesh.stems.positions.size() + mesh.faces.positions.size();
  FlatMesh flat = withRoomFor(vertices, mesh.triangleCount());
  append(flat, mesh.stems, Tint::None);
  append(flat, mesh.faces, tint);
  appendModels(flat, mesh, tint);
  return flat;
}

}  // namespace axil::render
