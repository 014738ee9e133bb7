#include "render/mesh_files.hpp"

#include "base/text.hpp"
#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/number_text.hpp"
#include "render/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string_view>

namespace axil::render {
namespace {

constexpr int normalDecimals = 4;  // 0.006 degrees

void appendVector(std::string& text, std::string_view keyword, const glm::vec3& v, const FixedText& numbers) {
  std::array<char, 4 + 3 * (longestNumber + 1)> line;
  char* at = std::copy(keyword.begin(), keyword.end(), line.data());
  for (const float x : {v.x, v.y, v.z}) {
    *at++ = ' ';
    at = numbers.write(at, x);
  }
  *at++ = '\n';
  text.append(line.data(), at);
}

/// A name as OBJ has it: one word.
std::string asWord(std::string name) {
  std::replace_if(name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '#'; }, '_');
  return name.empty() ? "unnamed" : name;
}

/// A triangle; its corners' positions and normals have the same numbers.
void appendFace(std::string& text, const std::uint32_t* corners) {
  std::array<char, 4 + 6 * (longestNumber + 2)> line;
  char* at = line.data();
  *at++ = 'f';
  for (int k = 0; k < 3; ++k) {
    *at++ = ' ';
    const char* const number = at;
    at = writeWhole(at, corners[k] + 1);
    const char* const end = at;
    *at++ = '/';
    *at++ = '/';
    at = std::copy(number, end, at);
  }
  *at++ = '\n';
  text.append(line.data(), at);
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

/// Appends `write(i, text)` for every i below `count`: threads write pieces, and each is appended when its turn has come.
template <class Write>
void appendAll(std::string& text, std::size_t count, const Write& write) {
  constexpr std::size_t atOnce = 8192;
  const std::size_t pieces = piecesFor(count, atOnce);
  std::atomic<std::size_t> next = 0, turn = 0;
  inParallel(threadsFor(pieces), [&](std::size_t) {
    std::string piece;
    for (std::size_t k = next++; k < pieces; k = next++) {
      piece.clear();
      for (std::size_t i = k * atOnce; i < std::min((k + 1) * atOnce, count); ++i) write(i, piece);
      for (std::size_t now = turn; now != k; now = turn) turn.wait(now);
      text += piece;
      turn = k + 1;
      turn.notify_all();
    }
  });
}

double largestCoordinate(const FlatMesh& flat) {
  float largest = 0;
  for (const glm::vec3& p : flat.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

std::string objOf(const PlantMesh& mesh, const FlatMesh& flat, const std::string& mtlName) {
  const FixedText lengths = FixedText::forNumbersUpTo(largestCoordinate(flat)), directions(normalDecimals);
  std::string text;
  text.reserve(flat.positions.size() * 64 + flat.triangles.size() * 18 + 1024);  // pages that stay empty cost nothing
  text += "# " + (mesh.name.empty() ? std::string("plant") : asWord(mesh.name)) + ", Y up\nmtllib " + mtlName + "\n";
  appendAll(text, flat.positions.size(), [&](std::size_t i, std::string& to) { appendVector(to, "v", flat.positions[i], lengths); });
  appendAll(text, flat.normals.size(), [&](std::size_t i, std::string& to) { appendVector(to, "vn", flat.normals[i], directions); });
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
