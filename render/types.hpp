#pragma once
/// \file
/// The nouns of the drawing room: a plant as triangles, and a picture. Plain values that own everything.
///
/// Frame: the plant's (right-handed, Y up, origin at the collar), lengths in the plant's unit (metres in what Axil emits).
/// Colours are linear RGB, 0 to 1; only an Image and the mesh files hold sRGB. Triangles are counter-clockwise from outside.

#include "base/frames.hpp"
#include "base/large_array.hpp"
#include "organs/types.hpp"
#include "simeco/plant.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace axil::render {

/// The smallest box around some points; empty until the first is added.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] glm::dvec3 centre() const { return (low + high) * 0.5; }
  [[nodiscard]] glm::dvec3 size() const { return high - low; }
  void add(const glm::dvec3& point);
  void add(const Bounds& other);
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// How light meets a material. Solid has an outside only; a Blade is thin: seen from both sides, its underside paler, and
/// light from behind shines through.
enum class Surface { Solid, Blade };

struct Material {
  std::string name;                       ///< "stem", "leaf blade"; unique within a PlantMesh
  glm::vec3 colour{0.5f};
  float roughness = 0.8f;                 ///< as in glTF: 0 a mirror, 1 matt
  Surface surface = Surface::Solid;
  friend bool operator==(const Material&, const Material&) = default;
};

/// Where a triangle comes from: the organ a click on it means, and what it is made of (index into PlantMesh::materials). What
/// an L-system's turtle draws beside organs is numbered on after the last organ: faces, then balls, then discs.
struct TriangleSource {
  simeco::OrganId organ;
  std::int32_t material = 0;
  friend bool operator==(const TriangleSource&, const TriangleSource&) = default;
};

/// All stems of a plant as one closed surface a stem. `colours` is a vertex colour: it runs on smoothly from organ to organ.
struct StemMesh {
  LargeArray<glm::vec3> positions;
  LargeArray<glm::vec3> normals;
  LargeArray<glm::vec3> colours;
  LargeArray<std::uint32_t> triangles;     ///< three indices each
  LargeArray<TriangleSource> sources;      ///< one a triangle
  friend bool operator==(const StemMesh&, const StemMesh&) = default;
};

/// The numbers of what stands behind the organs in `TriangleSource::organ` and `Placement::organ`.
[[nodiscard]] simeco::OrganId faceId(const simeco::Plant& plant, std::size_t face);
[[nodiscard]] simeco::OrganId ballId(const simeco::Plant& plant, std::size_t ball);
[[nodiscard]] simeco::OrganId discId(const simeco::Plant& plant, std::size_t disc);

/// Where one copy of a model stands: p = position + rotation * (scale * p_model).
struct Placement {
  simeco::OrganId organ;
  glm::vec3 position{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
  friend bool operator==(const Placement&, const Placement&) = default;
};

struct ModelPart {
  std::int32_t material = 0;               ///< index into PlantMesh::materials
  organs::Mesh mesh;
  friend bool operator==(const ModelPart&, const ModelPart&) = default;
};

/// A leaf, flower or fruit drawn many times. A model without placements does not occur.
struct OrganModel {
  std::string name;
  std::vector<ModelPart> parts;
  std::vector<Placement> placements;
  friend bool operator==(const OrganModel&, const OrganModel&) = default;
};

/// A plant ready to be drawn or written to a file. An empty one (nothing has grown yet) is a plant too.
struct PlantMesh {
  std::string name;
  std::vector<Material> materials;
  StemMesh stems;
  StemMesh faces;                          ///< polygons of a turtle: thin, seen from both sides; the same arrays as of stems
  std::vector<OrganModel> models;
  PlantPoint collar;                       ///< where the first stem starts: the ground is at its height
  std::vector<std::string> notes;          ///< what was drawn otherwise than asked, a sentence each

  [[nodiscard]] std::size_t triangleCount() const;   ///< with every copy of a model counted
  friend bool operator==(const PlantMesh&, const PlantMesh&) = default;
};

/// The box around every vertex of stems and placed models.
[[nodiscard]] Bounds boundsOf(const PlantMesh& mesh);

/// A picture: sRGB, 8 bits a channel, rows from the top, three bytes a pixel.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace axil::render
