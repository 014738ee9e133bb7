#include "render/mesh_files.hpp"

#include "render/colour.hpp"
#include "render/flat_mesh.hpp"

#include <bit>
#include <cstring>

namespace axil::render {
namespace {

/// Puts values one after the other into bytes that are already there.
class ByteWriter {
 public:
  explicit ByteWriter(char* to) : to_(to) {}
  template <class T>
  void put(const T& value) {
    static_assert(std::endian::native == std::endian::little, "PLY and glTF are written little endian");
    std::memcpy(to_, &value, sizeof(T));
    to_ += sizeof(T);
  }

 private:
  char* to_;
};

}  // namespace

std::string plyBytes(const PlantMesh& mesh) {
  const FlatMesh flat = flattened(mesh);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment Y up; organ is the number of the plant's organ\nelement vertex " +
                      std::to_string(flat.positions.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " +
                      std::to_string(flat.sources.size()) + "\nproperty list uchar uint vertex_indices\nproperty int organ\nend_header\n";
  constexpr std::size_t vertexBytes = 27, faceBytes = 17;
  const std::size_t header = bytes.size();
  bytes.resize(header + flat.positions.size() * vertexBytes + flat.sources.size() * faceBytes);
  ByteWriter write(bytes.data() + header);
  for (std::size_t i = 0; i < flat.positions.size(); ++i) {
    write.put(flat.positions[i]);
    write.put(flat.normals[i]);
    write.put(rgb8FromLinear(flat.colours[i]));
  }
  for (std::size_t t = 0; t < flat.sources.size(); ++t) {
    write.put(std::uint8_t{3});
    for (std::size_t k = 0; k < 3; ++k) write.put(flat.triangles[3 * t + k]);
    write.put(flat.sources[t].organ.value);
  }
  return bytes;
}

}  // namespace axil::render
