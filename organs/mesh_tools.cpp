#include "organs/mesh_tools.hpp"

#include "base/result.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::organs {

namespace {

constexpr double pi = std::numbers::pi;

// Direction of the profile at point i, between its neighbours; it always has one, since no two points coincide.
glm::dvec2 tangentAt(std::span<const glm::dvec2> profile, std::size_t i) {
  const glm::dvec2 before = profile[i == 0 ? 0 : i - 1];
  const glm::dvec2 after = profile[std::min(i + 1, profile.size() - 1)];
  return glm::normalize(after - before);
}

void addVertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv) {
  mesh.positions.emplace_back(position);
  mesh.normals.emplace_back(glm::normalize(normal));
  mesh.uvs.emplace_back(uv);
}

// Quads between rings of `sides` + 1 vertices; a ring that is one point gives triangles.
void addRings(Mesh& mesh, std::size_t rings, int sides, const std::vector<bool>& isPoint) {
  const auto at = [&](std::size_t ring, int side) { return static_cast<std::uint32_t>(ring * (sides + 1) + side); };
  for (std::size_t r = 0; r + 1 < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const std::uint32_t a = at(r, s), b = at(r, s + 1), c = at(r + 1, s + 1), d = at(r + 1, s);
      if (!isPoint[r]) mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
      if (!isPoint[r + 1]) mesh.triangles.insert(mesh.triangles.end(), {a, c, d});
    }
}

glm::dvec3 anyAcross(const glm::dvec3& v) {
  const glm::dvec3 axis = std::abs(v.z) < 0.9 ? glm::dvec3{0, 0, 1} : glm::dvec3{1, 0, 0};
  return glm::normalize(axis - v * glm::dot(axis, v));
}

}  // namespace

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  mesh.uvs.insert(mesh.uvs.end(), more.uvs.begin(), more.uvs.end());
  for (const std::uint32_t i : more.triangles) mesh.triangles.push_back(first + i);
}

Mesh transformed(const Mesh& mesh, const glm::dmat4& matrix) {
  AXIL_ASSERT(glm::determinant(glm::dmat3(matrix)) > 0, "a mesh is mirrored, which would turn its triangles inside out");
  const glm::dmat3 forNormals = glm::transpose(glm::inverse(glm::dmat3(matrix)));
  Mesh result = mesh;
  for (glm::vec3& p : result.positions) p = glm::vec3(glm::dvec3(matrix * glm::dvec4(glm::dvec3(p), 1)));
  for (glm::vec3& n : result.normals) n = glm::vec3(glm::normalize(forNormals * glm::dvec3(n)));
  return result;
}

Mesh revolved(std::span<const glm::dvec2> profile, int sides) {
  Mesh mesh;
  std::vector<bool> isPoint;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const glm::dvec2 tangent = tangentAt(profile, i);
    isPoint.push_back(profile[i].x < 1e-9);
    for (int s = 0; s <= sides; ++s) {
      const double turn = 2 * pi * (s % sides) / sides;  // the seam's two ends are the same point to the last bit
      const glm::dvec3 out{std::sin(turn), 0, std::cos(turn)};
      glm::dvec3 normal = out * tangent.y - glm::dvec3{0, tangent.x, 0};
      if (isPoint.back()) normal = {0, i == 0 ? -1 : 1, 0};
      addVertex(mesh, out * profile[i].x + glm::dvec3{0, profile[i].y, 0}, normal,
                {static_cast<double>(s) / sides, static_cast<double>(i) / static_cast<double>(profile.size() - 1)});
    }
  }
  addRings(mesh, profile.size(), sides, isPoint);
  return mesh;
}

Mesh tube(std::span<const glm::dvec3> path, std::span<const double> radii, int sides) {
  Mesh mesh;
  glm::dvec3 across{0, 0, 0};
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::dvec3 along = glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]);
    across = i == 0 ? anyAcross(along) : glm::normalize(across - along * glm::dot(across, along));
    const glm::dvec3 side = glm::cross(along, across);
    for (int s = 0; s <= sides; ++s) {
      const double turn = 2 * pi * (s % sides) / sides;
      const glm::dvec3 out = across * std::cos(turn) + side * std::sin(turn);
      addVertex(mesh, path[i] + out * radii[i], out,
                {static_cast<double>(s) / sides, static_cast<double>(i) / static_cast<double>(path.size() - 1)});
    }
  }
  addRings(mesh, path.size(), sides, std::vector<bool>(path.size(), false));
  return mesh;
}

}  // namespace axil::organs
