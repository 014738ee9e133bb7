#include "render/mesh_files.hpp"

#include "base/text.hpp"
#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/parallel.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace axil::render {
namespace {

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

/// Triangles in the order of the file: by organ, each organ's as they are (which is by material).
std::vector<std::uint32_t> byOrgan(const FlatMesh& flat) {
  std::int32_t last = 0;
  for (const TriangleSource& source : flat.sources) last = std::max(last, source.organ.value);
  std::vector<std::uint32_t> next(static_cast<std::size_t>(last) + 2, 0);
  for (const TriangleSource& source : flat.sources) ++next[static_cast<std::size_t>(source.organ.value) + 1];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  std::vector<std::uint32_t> order(flat.sources.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[next[static_cast<std::size_t>(flat.sources[i].organ.value)]++] = static_cast<std::uint32_t>(i);
  return order;
}

/// Appends `write(i, text)` for every i below `count`, made piece by piece by as many threads as there are.
template <class Write>
void appendAll(std::string& text, std::size_t count, const Write& write) {
  constexpr std::size_t atOnce = 8192, piecesAtOnce = 16;
  std::array<std::string, piecesAtOnce> pieces;
  for (std::size_t first = 0; first < count; first += atOnce * piecesAtOnce) {
    inParallel(piecesAtOnce, [&](std::size_t piece) {
      pieces[piece].clear();
      const std::size_t from = first + piece * atOnce;
      for (std::size_t i = from; i < std::min(from + atOnce, count); ++i) write(i, pieces[piece]);
    });
    for (const std::string& piece : pieces) text += piece;
  }
}

std::string objOf(const PlantMesh& mesh, const FlatMesh& flat, const std::string& mtlName) {
  std::string text;
  text.reserve(flat.positions.size() * 64 + flat.triangles.size() * 7 + 1024);
  text += "# " + (mesh.name.empty() ? std::string("plant") : asWord(mesh.name)) + ", Y up\nmtllib " + mtlName + "\n";
  appendAll(text, flat.positions.size(), [&](std::size_t i, std::string& to) { appendVector(to, "v", flat.positions[i]); });
  appendAll(text, flat.normals.size(), [&](std::size_t i, std::string& to) { appendVector(to, "vn", flat.normals[i]); });
  const std::vector<std::uint32_t> order = byOrgan(flat);
  appendAll(text, order.size(), [&](std::size_t i, std::string& to) {
    const TriangleSource& source = flat.sources[order[i]];
    const TriangleSource before = i == 0 ? TriangleSource{.organ = {}, .material = -1} : flat.sources[order[i - 1]];
    if (source.organ != before.organ) to += "g organ_" + std::to_string(source.organ.value) + "\n";
    if (source.material != before.material) to += "usemtl " + asWord(mesh.materials[static_cast<std::size_t>(source.material)].name) + "\n";
    appendFace(to, flat.triangles.data() + 3 * static_cast<std::size_t>(order[i]));
  });
  return text;
}

}  // namespace

Result<ObjFiles> objAndMtl(const PlantMesh& mesh, const std::string& mtlName) {
  if (mtlName.empty() || mtlName != asWord(mtlName))
    return fail(ErrorCode::BadInput, "an OBJ file cannot name its materials \"" + mtlName + "\"; choose a file name without blanks and #");
  const FlatMesh flat = flattened(mesh);
  return ObjFiles{.obj = objOf(mesh, flat, mtlName), .mtl = mtlOf(mesh, flat)};
}

}  // namespace axil::render
