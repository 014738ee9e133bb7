#include "render/stem_mesh.hpp"

namespace axil::render {

StemMesh roomFor(std::size_t vertices, std::size_t triangles) {
  StemMesh mesh;
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  mesh.colours.resize(vertices);
  mesh.triangles.resize(3 * triangles);
  mesh.sources.resize(triangles);
  return mesh;
}

}  // namespace axil::render
