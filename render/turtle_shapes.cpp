#include "render/turtle_shapes.hpp"

#include "render/colour.hpp"
#include "render/parallel.hpp"
#include "render/polygon.hpp"
#include "render/stem_mesh.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace axil::render {
namespace {

using organs::Detail;
using simeco::OrganId;
using simeco::OrganStyle;
using simeco::Plant;

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<void> unplaced(const char* what, std::size_t index) {
  return fail(ErrorCode::BadInput, std::string(what) + " " + std::to_string(index) +
                                       " of the turtle has no finite place and size; look for a division by zero or a runaway length in its rule");
}

glm::vec3 colourOf(const OrganStyle& style) { return style.colour ? paintColour(*style.colour) : defaultColour(style.kind); }

/// The material of each style that something asks for, made when it is first asked for.
class Materials {
 public:
  Materials(PlantMesh& mesh, const Plant& plant, const char* name, Surface surface) : mesh_(mesh), plant_(plant), name_(name), surface_(surface) {}

  [[nodiscard]] std::int32_t of(std::int32_t style) {
    const auto [at, isNew] = known_.try_emplace(style, 0);
    if (isNew) {
      at->second = static_cast<std::int32_t>(mesh_.materials.size());
      const std::string number = known_.size() == 1 ? "" : " " + std::to_string(known_.size());
      mesh_.materials.push_back({.name = name_ + number, .colour = colourOf(plant_.styles[static_cast<std::size_t>(style)]), .roughness = 0.6f, .surface = surface_});
    }
    return at->second;
  }

 private:
  PlantMesh& mesh_;
  const Plant& plant_;
  std::string name_;
  Surface surface_;
  std::map<std::int32_t, std::int32_t> known_;
};

// ---- faces -----------------------------------------------------------------------------------------------------------

/// Writes faces into a mesh that has room for them: a polygon of n corners is n vertices and n - 2 triangles.
class FaceWriter {
 public:
  explicit FaceWriter(StemMesh& mesh) : mesh_(mesh) {}

  void write(const simeco::PlantFace& face, std::size_t firstVertex, std::size_t firstTriangle, const glm::vec3& colour, const TriangleSource& source) {
    corners_.clear();
    for (const PlantPoint& vertex : face.vertices) corners_.push_back(vertex.at);
    const glm::dvec3 area = areaNormal(corners_);
    const glm::vec3 normal = glm::dot(area, area) > 0 ? glm::vec3(glm::normalize(area)) : glm::vec3(0, 1, 0);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      mesh_.positions[firstVertex + k] = glm::vec3(corners_[k]);
      mesh_.normals[firstVertex + k] = normal;
      mesh_.colours[firstVertex + k] = colour;
    }
    for (const auto& triangle : cutter_.cut(corners_, area)) {
      for (std::size_t k = 0; k < 3; ++k) mesh_.triangles[3 * firstTriangle + k] = static_cast<std::uint32_t>(firstVertex) + triangle[k];
      mesh_.sources[firstTriangle++] = source;
    }
  }

 private:
  StemMesh& mesh_;
  std::vector<glm::dvec3> corners_;
  PolygonCutter cutter_;
};

void addFaces(PlantMesh& mesh, const Plant& plant) {
  constexpr std::size_t facesAtOnce = 2048;
  Materials materials(mesh, plant, "face", Surface::Blade);
  std::vector<std::int32_t> materialOf(plant.faces.size());
  // A face of fewer than three corners is none.
  const auto triangles = [](const simeco::PlantFace& face) { return face.vertices.size() < 3 ? std::size_t{0} : face.vertices.size() - 2; };
  std::vector<std::size_t> firstVertex, firstTriangle;   // of each piece
  std::size_t vertexCount = 0, triangleCount = 0;
  for (std::size_t i = 0; i < plant.faces.size(); ++i) {
    if (i % facesAtOnce == 0) {
      firstVertex.push_back(vertexCount);
      firstTriangle.push_back(triangleCount);
    }
    materialOf[i] = materials.of(plant.faces[i].style);
    vertexCount += plant.faces[i].vertices.size();
    triangleCount += triangles(plant.faces[i]);
  }
  mesh.faces = roomFor(vertexCount, triangleCount);
  inParallel(firstVertex.size(), [&](std::size_t piece) {
    FaceWriter writer(mesh.faces);
    std::size_t vertex = firstVertex[piece], triangle = firstTriangle[piece];
    for (std::size_t i = piece * facesAtOnce; i < std::min((piece + 1) * facesAtOnce, plant.faces.size()); ++i) {
      const simeco::PlantFace& face = plant.faces[i];
      writer.write(face, vertex, triangle, mesh.materials[static_cast<std::size_t>(materialOf[i])].colour, {.organ = faceId(plant, i), .material = materialOf[i]});
      vertex += face.vertices.size();
      triangle += triangles(face);
    }
  });
}

// ---- balls and discs -------------------------------------------------------------------------------------------------

/// A sphere of radius 1 around the origin: `bands` from pole to pole.
organs::Mesh ballMesh(int bands) {
  organs::Mesh mesh;
  const int sides = 2 * bands;
  for (int b = 0; b <= bands; ++b) {
    const double latitude = std::numbers::pi * b / bands;
    for (int s = 0; s <= sides; ++s) {
      const double longitude = 2 * std::numbers::pi * s / sides;
      const glm::vec3 at(std::sin(latitude) * std::cos(longitude), std::cos(latitude), -std::sin(latitude) * std::sin(longitude));
      mesh.positions.push_back(at);
      mesh.normals.push_back(at);
      mesh.uvs.emplace_back(static_cast<float>(s) / static_cast<float>(sides), static_cast<float>(b) / static_cast<float>(bands));
    }
  }
  const auto at = [&](int b, int s) { return static_cast<std::uint32_t>(b * (sides + 1) + s); };
  for (int b = 0; b < bands; ++b)
    for (int s = 0; s < sides; ++s) {
      if (b > 0) mesh.triangles.insert(mesh.triangles.end(), {at(b, s), at(b + 1, s), at(b, s + 1)});
      if (b + 1 < bands) mesh.triangles.insert(mesh.triangles.end(), {at(b, s + 1), at(b + 1, s), at(b + 1, s + 1)});
    }
  return mesh;
}

/// A disc of radius 1 around the origin that looks along +Z.
organs::Mesh discMesh(int sides) {
  organs::Mesh mesh;
  mesh.positions.emplace_back(0);
  mesh.uvs.emplace_back(0.5f);
  for (int s = 0; s < sides; ++s) {
    const double angle = 2 * std::numbers::pi * s / sides;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.uvs.emplace_back(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle));
    mesh.triangles.insert(mesh.triangles.end(), {0, static_cast<std::uint32_t>(s + 1), static_cast<std::uint32_t>((s + 1) % sides + 1)});
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  return mesh;
}

/// Copies of one shape, a model for every style.
class Copies {
 public:
  Copies(PlantMesh& mesh, const Plant& plant, const char* name, Surface surface, organs::Mesh shape)
      : mesh_(mesh), name_(name), materials_(mesh, plant, name, surface), shape_(std::move(shape)) {}

  void add(std::int32_t style, const Placement& placement) {
    const auto [at, isNew] = models_.try_emplace(style, mesh_.models.size());
    if (isNew) {
      const std::int32_t material = materials_.of(style);
      mesh_.models.push_back({.name = name_, .parts = {{.material = material, .mesh = shape_}}, .placements = {}});
    }
    mesh_.models[at->second].placements.push_back(placement);
  }

 private:
  PlantMesh& mesh_;
  std::string name_;
  Materials materials_;
  organs::Mesh shape_;
  std::map<std::int32_t, std::size_t> models_;
};

int bandsFor(Detail detail) { return detail == Detail::Close ? 16 : detail == Detail::Medium ? 10 : 5; }

void addBalls(PlantMesh& mesh, const Plant& plant, Detail detail) {
  Copies balls(mesh, plant, "ball", Surface::Solid, ballMesh(bandsFor(detail)));
  for (std::size_t i = 0; i < plant.balls.size(); ++i) {
    const simeco::PlantBall& ball = plant.balls[i];
    if (ball.radius > 0) balls.add(ball.style, {.organ = ballId(plant, i), .position = glm::vec3(ball.centre.at), .rotation = {1, 0, 0, 0}, .scale = glm::vec3(static_cast<float>(ball.radius))});
  }
}

void addDiscs(PlantMesh& mesh, const Plant& plant, Detail detail) {
  Copies discs(mesh, plant, "disc", Surface::Blade, discMesh(2 * bandsFor(detail)));
  for (std::size_t i = 0; i < plant.discs.size(); ++i) {
    const simeco::PlantDisc& disc = plant.discs[i];
    if (disc.radius <= 0) continue;
    const glm::dvec3 z = disc.normal.unit(), helper = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(helper, z));
    discs.add(disc.style, {.organ = discId(plant, i), .position = glm::vec3(disc.centre.at),
                           .rotation = glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)))), .scale = glm::vec3(static_cast<float>(disc.radius))});
  }
}

}  // namespace

Result<void> checkTurtleShapes(const Plant& plant) {
  const auto isPlaced = [](const simeco::PlantFace& face) { return std::all_of(face.vertices.begin(), face.vertices.end(), [](const PlantPoint& p) { return isFinite(p.at); }); };
  const std::size_t unplacedFace = firstOf(plant.faces.size(), [&](std::size_t i) { return !isPlaced(plant.faces[i]); });
  if (unplacedFace < plant.faces.size()) return unplaced("polygon", unplacedFace);
  for (std::size_t i = 0; i < plant.balls.size(); ++i)
    if (!isFinite(plant.balls[i].centre.at) || !std::isfinite(plant.balls[i].radius)) return unplaced("sphere", i);
  for (std::size_t i = 0; i < plant.discs.size(); ++i)
    if (!isFinite(plant.discs[i].centre.at) || !std::isfinite(plant.discs[i].radius)) return unplaced("circle", i);
  return {};
}

void addTurtleShapes(PlantMesh& mesh, const Plant& plant, Detail detail) {
  if (!plant.faces.empty()) addFaces(mesh, plant);
  if (!plant.balls.empty()) addBalls(mesh, plant, detail);
  if (!plant.discs.empty()) addDiscs(mesh, plant, detail);
}

}  // namespace axil::render
