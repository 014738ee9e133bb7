#pragma once
/// \file
/// A PlantMesh as one list of triangles, every copy of a model spelled out: for drawing, and for files without instances.

#include "render/types.hpp"

namespace axil::render {

struct FlatMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;       ///< unit
  std::vector<glm::vec3> colours;       ///< linear
  std::vector<std::int32_t> materials;  ///< one a vertex, index into PlantMesh::materials
  std::vector<std::uint32_t> triangles;
  std::vector<TriangleSource> sources;  ///< one a triangle
};

/// Whether leaves of one model differ a little in colour, as in nature. The difference depends on the organ's id alone.
enum class Tint { None, Natural };

/// The copies of models alone, without stems and faces.
[[nodiscard]] FlatMesh flattenedModels(const PlantMesh& mesh, Tint tint = Tint::None);

[[nodiscard]] FlatMesh flattened(const PlantMesh& mesh, Tint tint = Tint::None);

}  // namespace axil::render
