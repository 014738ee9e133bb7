#pragma once
/// \file
/// The nouns of the organ room: small meshes of leaves, flowers and fruits. An organ stands in its own frame: it is
/// attached at the origin, grows along +Y, its adaxial (upper) side faces +Z. Lengths are in units of the organ's own
/// length (a leaf's blade runs from y = 0 to y = 1), so one mesh serves all sizes; whoever draws it scales and turns it.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace axil::organs {

/// A triangle mesh with a normal a vertex. Triangles are counter-clockwise seen from outside (for a blade: from its
/// adaxial side). `uv` runs along the blade (v from base 0 to apex 1) and across it (u 0 to 1).
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> triangles;  ///< three indices each

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// A part of an organ that has one colour: blade, petal, centre of a flower.
struct Part {
  std::string name;                      ///< "blade", "petal", "sepal", "centre", "flesh"
  glm::vec3 colour{0.30f, 0.50f, 0.18f};  ///< linear RGB, 0 to 1
  Mesh mesh;
};

/// How finely an organ is drawn. Close for pictures, Far for a plant of ten thousand leaves.
enum class Detail { Close, Medium, Far };

}  // namespace axil::organs
