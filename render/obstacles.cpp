#include "render/obstacles.hpp"

#include "base/overloaded.hpp"
#include "render/polygon.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

namespace axil::render {
namespace {

constexpr int bands = 32;  // of a sphere, pole to pole
const glm::vec3 stone(0.36f, 0.35f, 0.33f);

/// Adds one obstacle after the other to the faces of a mesh.
class Builder {
 public:
  Builder(StemMesh& mesh, std::int32_t material) : mesh_(mesh), source_{.organ = {}, .material = material} {}

  void add(const simeco::SphereObstacle& sphere) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    constexpr int sides = 2 * bands;
    for (int b = 0; b <= bands; ++b)
      for (int s = 0; s <= sides; ++s) {
        const double latitude = std::numbers::pi * b / bands, longitude = 2 * std::numbers::pi * s / sides;
        const glm::dvec3 normal(std::sin(latitude) * std::cos(longitude), std::cos(latitude), -std::sin(latitude) * std::sin(longitude));
        addVertex(sphere.centre.at + normal * sphere.radius, normal);
      }
    const auto at = [&](int b, int s) { return first + static_cast<std::uint32_t>(b * (sides + 1) + s); };
    for (int b = 0; b < bands; ++b)
      for (int s = 0; s < sides; ++s) {
        if (b > 0) addTriangle(at(b, s), at(b + 1, s), at(b, s + 1));
        if (b + 1 < bands) addTriangle(at(b, s + 1), at(b + 1, s), at(b + 1, s + 1));
      }
  }

  void add(const simeco::BoxObstacle& box) {
    const glm::dvec3 low = glm::min(box.low.at, box.high.at), high = glm::max(box.low.at, box.high.at);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<glm::dvec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
          corners[k][axis] = upper ? high[axis] : low[axis];
          corners[k][u] = (k == 1 || k == 2) == upper ? high[u] : low[u];
          corners[k][v] = k >= 2 ? high[v] : low[v];
        }
        addPolygon(corners);
      }
  }

  void add(const simeco::MeshObstacle& obstacle) {
    for (const auto& triangle : obstacle.triangles)
      addPolygon(std::array<glm::dvec3, 3>{obstacle.points[triangle[0]].at, obstacle.points[triangle[1]].at, obstacle.points[triangle[2]].at});
  }

 private:
  void addVertex(const glm::dvec3& at, const glm::dvec3& normal) {
    mesh_.positions.emplace_back(at);
    mesh_.normals.emplace_back(normal);
    mesh_.colours.push_back(stone);
  }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
    mesh_.sources.push_back(source_);
  }
  void addPolygon(std::span<const glm::dvec3> corners) {
    const glm::dvec3 area = areaNormal(corners);
    if (!(glm::dot(area, area) > 0)) return;
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const glm::dvec3& corner : corners) addVertex(corner, glm::normalize(area));
    for (std::uint32_t k = 2; k < corners.size(); ++k) addTriangle(first, first + k - 1, first + k);
  }

  StemMesh& mesh_;
  TriangleSource source_;
};

Bounds boundsOfObstacle(const simeco::Obstacle& obstacle) {
  Bounds bounds;
  std::visit(overloaded{[&](const simeco::SphereObstacle& sphere) {
                          bounds.add(sphere.centre.at - sphere.radius);
                          bounds.add(sphere.centre.at + sphere.radius);
                        },
                        [&](const simeco::BoxObstacle& box) {
                          bounds.add(box.low.at);
                          bounds.add(box.high.at);
                        },
                        [&](const simeco::MeshObstacle& mesh) {
                          for (const PlantPoint& point : mesh.points) bounds.add(point.at);
                        }},
             obstacle);
  return bounds;
}

}  // namespace

PlantMesh withObstacles(PlantMesh mesh, const std::vector<simeco::Obstacle>& obstacles) {
  if (obstacles.empty()) return mesh;
  const auto material = static_cast<std::int32_t>(mesh.materials.size());
  mesh.materials.push_back({.name = "obstacle", .colour = stone, .roughness = 0.9f, .surface = Surface::Solid});
  Builder builder(mesh.faces, material);
  for (const simeco::Obstacle& obstacle : obstacles) std::visit([&](const auto& shape) { builder.add(shape); }, obstacle);
  return mesh;
}

std::vector<simeco::Obstacle> obstaclesToFrame(const PlantMesh& mesh, const std::vector<simeco::Obstacle>& obstacles) {
  const Bounds plant = boundsOf(mesh);
  std::vector<simeco::Obstacle> framed;
  if (plant.empty()) return framed;
  const double reach = glm::length(plant.size());
  std::copy_if(obstacles.begin(), obstacles.end(), std::back_inserter(framed), [&](const simeco::Obstacle& obstacle) {
    const Bounds bounds = boundsOfObstacle(obstacle);
    return !bounds.empty() && glm::length(bounds.size()) <= reach && glm::distance(bounds.centre(), plant.centre()) <= reach;
  });
  return framed;
}

}  // namespace axil::render
