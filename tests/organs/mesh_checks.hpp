#pragma once
/// \file
/// What every mesh of the room must be.

#include "organs/types.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace axil::organs::test {

inline std::size_t trianglesOf(const std::vector<Part>& parts) {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.mesh.triangles.size() / 3;
  return count;
}

/// Indices in range, one normal of unit length and one uv in [0, 1] a vertex, no triangle without area, and normals on the
/// side that the triangle's winding says.
inline void expectSound(const Part& part, const std::string& of) {
  SCOPED_TRACE(of + " " + part.name);
  const Mesh& mesh = part.mesh;
  ASSERT_FALSE(mesh.triangles.empty());
  ASSERT_EQ(mesh.triangles.size() % 3, 0u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
  for (const glm::vec2& uv : mesh.uvs) ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv.x << " " << uv.y;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) ASSERT_LT(mesh.triangles[t + k], mesh.positions.size());
    const glm::dvec3 a = mesh.positions[mesh.triangles[t]];
    const glm::dvec3 b = mesh.positions[mesh.triangles[t + 1]];
    const glm::dvec3 c = mesh.positions[mesh.triangles[t + 2]];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    ASSERT_GT(glm::length(normal), 1e-9) << "triangle " << t / 3;
    const glm::dvec3 shaded = glm::dvec3(mesh.normals[mesh.triangles[t]]) + glm::dvec3(mesh.normals[mesh.triangles[t + 1]]) +
                              glm::dvec3(mesh.normals[mesh.triangles[t + 2]]);
    ASSERT_GT(glm::dot(normal, shaded), 0) << "triangle " << t / 3 << " faces away from its normals";
  }
}

}  // namespace axil::organs::test
