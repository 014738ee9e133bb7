#include "render/mesh_files.hpp"

#include "base/text.hpp"
#include "render/colour.hpp"
#include "render/flat_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace axil::render {
namespace {

// ---- text ------------------------------------------------------------------------------------------------------------

template <class Number>
void appendNumber(std::string& text, Number value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end.ptr);
}

void appendVector(std::string& text, const char* keyword, const glm::vec3& v) {
  text += keyword;
  for (const float x : {v.x, v.y, v.z}) {
    text += ' ';
    appendNumber(text, x + 0.0f);  // no -0
  }
  text += '\n';
}

/// A name as OBJ has it: one word.
std::string asWord(std::string name) {
  std::replace_if(name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '#'; }, '_');
  return name.empty() ? "unnamed" : name;
}

void appendFace(std::string& text, const std::uint32_t* corners) {
  text += 'f';
  for (int k = 0; k < 3; ++k) {
    text += ' ';
    appendNumber(text, corners[k] + 1);
    text += "//";
    appendNumber(text, corners[k] + 1);
  }
  text += '\n';
}

/// The mean colour of what each material covers: stems are coloured by vertex, which OBJ cannot say.
std::vector<glm::vec3> meanColours(const PlantMesh& mesh, const FlatMesh& flat) {
  std::vector<glm::dvec3> sums(mesh.materials.size(), glm::dvec3(0));
  std::vector<double> counts(mesh.materials.size(), 0);
  for (std::size_t i = 0; i < flat.colours.size(); ++i) {
    const auto m = static_cast<std::size_t>(flat.materials[i]);
    sums[m] += glm::dvec3(flat.colours[i]);
    counts[m] += 1;
  }
  std::vector<glm::vec3> means;
  for (std::size_t m = 0; m < sums.size(); ++m) means.push_back(counts[m] > 0 ? glm::vec3(sums[m] / counts[m]) : mesh.materials[m].colour);
  return means;
}

std::string mtlOf(const PlantMesh& mesh, const FlatMesh& flat) {
  std::string text = "# Colours are sRGB.\n";
  const std::vector<glm::vec3> colours = meanColours(mesh, flat);
  for (std::size_t m = 0; m < colours.size(); ++m) {
    const glm::dvec3 srgb = srgbFromLinear(colours[m]);
    text += "newmtl " + asWord(mesh.materials[m].name) + "\n";
    text += "Kd " + fixed(srgb.r, 4) + " " + fixed(srgb.g, 4) + " " + fixed(srgb.b, 4) + "\nKs 0.02 0.02 0.02\nNs 20\nd 1\nillum 2\n";
  }
  return text;
}

/// Triangles in the order of the file: by organ, and within it by material.
std::vector<std::uint32_t> byOrgan(const FlatMesh& flat) {
  std::vector<std::uint32_t> order(flat.sources.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(flat.sources[a].organ, flat.sources[a].material) < std::pair(flat.sources[b].organ, flat.sources[b].material);
  });
  return order;
}

std::string objOf(const PlantMesh& mesh, const FlatMesh& flat, const std::string& mtlName) {
  std::string text;
  text.reserve(flat.positions.size() * 64 + flat.triangles.size() * 16 + 1024);
  text += "# " + (mesh.name.empty() ? std::string("plant") : asWord(mesh.name)) + ", Y up\nmtllib " + mtlName + "\n";
  for (const glm::vec3& p : flat.positions) appendVector(text, "v", p);
  for (const glm::vec3& n : flat.normals) appendVector(text, "vn", n);
  TriangleSource current{.organ = {}, .material = -1};
  for (const std::uint32_t triangle : byOrgan(flat)) {
    const TriangleSource& source = flat.sources[triangle];
    if (source.organ != current.organ) text += "g organ_" + std::to_string(source.organ.value) + "\n";
    if (source.material != current.material) text += "usemtl " + asWord(mesh.materials[static_cast<std::size_t>(source.material)].name) + "\n";
    current = source;
    appendFace(text, flat.triangles.data() + 3 * static_cast<std::size_t>(triangle));
  }
  return text;
}

// ---- binary ----------------------------------------------------------------------------------------------------------

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

Result<ObjFiles> objAndMtl(const PlantMesh& mesh, const std::string& mtlName) {
  if (mtlName.empty() || mtlName != asWord(mtlName))
    return fail(ErrorCode::BadInput, "an OBJ file cannot name its materials \"" + mtlName + "\"; choose a file name without blanks and #");
  const FlatMesh flat = flattened(mesh);
  return ObjFiles{.obj = objOf(mesh, flat, mtlName), .mtl = mtlOf(mesh, flat)};
}

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
