#include "render/mesh_files.hpp"

#include "base/file_writer.hpp"
#include "base/files.hpp"
#include "base/text.hpp"
#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/number_text.hpp"
#include "render/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <span>
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

/// A triangle; its corners' positions and normals have the same numbers, counted from `first`.
void appendFace(std::string& text, const std::uint32_t* corners, std::uint32_t first) {
  std::array<char, 4 + 6 * (longestNumber + 2)> line;
  char* at = line.data();
  *at++ = 'f';
  for (int k = 0; k < 3; ++k) {
    *at++ = ' ';
    const char* const number = at;
    at = writeWhole(at, corners[k] + first);
    const char* const end = at;
    *at++ = '/';
    *at++ = '/';
    at = std::copy(number, end, at);
  }
  *at++ = '\n';
  text.append(line.data(), at);
}

/// A stretch of the file's vertices and triangles, seen where it is.
struct Stretch {
  std::span<const glm::vec3> positions;
  std::span<const glm::vec3> normals;
  std::span<const glm::vec3> colours;
  std::span<const std::uint32_t> triangles;  ///< corners counted from the stretch's first vertex
  std::span<const TriangleSource> sources;
  std::size_t firstVertex = 0;
  std::size_t firstTriangle = 0;
};

/// The plant as the file has it: stems, faces, then every copy of a model spelled out. No copy of the first two is made.
class Stretches {
 public:
  explicit Stretches(const PlantMesh& mesh) : models_(flattenedModels(mesh)) {
    add(mesh.stems);
    add(mesh.faces);
    add(models_);
  }
  Stretches(const Stretches&) = delete;

  [[nodiscard]] const std::array<Stretch, 3>& all() const { return all_; }
  [[nodiscard]] std::size_t vertexCount() const { return vertices_; }
  [[nodiscard]] std::size_t triangleCount() const { return triangles_; }
  [[nodiscard]] const Stretch& ofTriangle(std::size_t t) const { return t < all_[1].firstTriangle ? all_[0] : t < all_[2].firstTriangle ? all_[1] : all_[2]; }
  [[nodiscard]] const TriangleSource& source(std::size_t t) const {
    const Stretch& stretch = ofTriangle(t);
    return stretch.sources[t - stretch.firstTriangle];
  }

 private:
  template <class Mesh>
  void add(const Mesh& mesh) {
    all_[count_++] = {mesh.positions, mesh.normals, mesh.colours, mesh.triangles, mesh.sources, vertices_, triangles_};
    vertices_ += mesh.positions.size();
    triangles_ += mesh.sources.size();
  }

  FlatMesh models_;
  std::array<Stretch, 3> all_;
  std::size_t count_ = 0, vertices_ = 0, triangles_ = 0;
};

/// The mean colour of what each material covers: stems are coloured by vertex, which OBJ cannot say.
std::vector<glm::vec3> meanColours(const PlantMesh& mesh, const Stretches& stretches) {
  std::vector<glm::dvec3> sums(mesh.materials.size(), glm::dvec3(0));
  std::vector<double> counts(mesh.materials.size(), 0);
  for (const Stretch& stretch : stretches.all())
    for (std::size_t i = 0; i < stretch.triangles.size(); ++i) {
      const auto m = static_cast<std::size_t>(stretch.sources[i / 3].material);
      sums[m] += glm::dvec3(stretch.colours[stretch.triangles[i]]);
      counts[m] += 1;
    }
  std::vector<glm::vec3> means;
  for (std::size_t m = 0; m < sums.size(); ++m) means.push_back(counts[m] > 0 ? glm::vec3(sums[m] / counts[m]) : mesh.materials[m].colour);
  return means;
}

std::string mtlOf(const PlantMesh& mesh, const Stretches& stretches) {
  std::string text = "# Colours are sRGB.\n";
  const std::vector<glm::vec3> colours = meanColours(mesh, stretches);
  for (std::size_t m = 0; m < colours.size(); ++m) {
    const glm::dvec3 srgb = srgbFromLinear(colours[m]);
    text += "newmtl " + asWord(mesh.materials[m].name) + "\n";
    text += "Kd " + fixed(srgb.r, 4) + " " + fixed(srgb.g, 4) + " " + fixed(srgb.b, 4) + "\nKs 0.02 0.02 0.02\nNs 20\nd 1\nillum 2\n";
  }
  return text;
}

/// Triangles in the order of the file: by organ, each organ's as they are (which is by material).
std::vector<std::uint32_t> byOrgan(const Stretches& stretches) {
  std::vector<std::uint32_t> next(2, 0);
  for (const Stretch& stretch : stretches.all())
    for (const TriangleSource& source : stretch.sources) {
      const std::size_t place = static_cast<std::size_t>(source.organ.value) + 1;
      if (place >= next.size()) next.resize(std::max(place + 1, 2 * next.size()), 0);
      ++next[place];
    }
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  std::vector<std::uint32_t> order(stretches.triangleCount());
  for (std::size_t i = 0; i < order.size(); ++i) order[next[static_cast<std::size_t>(stretches.source(i).organ.value)]++] = static_cast<std::uint32_t>(i);
  return order;
}

/// Pieces of text that threads make in any order, put in theirs. A thread that is early leaves its piece here and goes on.
template <class Put>
class InOrder {
 public:
  explicit InOrder(const Put& put) : put_(put) {}

  void add(std::size_t number, std::string piece) {
    std::unique_lock lock(mutex_);
    // Not too far ahead of one that is slow, or all of the text would wait here.
    roomy_.wait(lock, [&] { return number < turn_ + kMostAhead; });
    early_.emplace(number, std::move(piece));
    for (; !early_.empty() && early_.begin()->first == turn_; ++turn_) {
      put_(early_.begin()->second);
      early_.erase(early_.begin());
    }
    roomy_.notify_all();
  }

 private:
  static constexpr std::size_t kMostAhead = 64;
  const Put& put_;
  std::mutex mutex_;
  std::condition_variable roomy_;
  std::map<std::size_t, std::string> early_;
  std::size_t turn_ = 0;
};

/// Puts `write(i, text)` for every i below `count`, in order; threads write pieces.
template <class Put, class Write>
void putEach(const Put& put, std::size_t count, const Write& write) {
  constexpr std::size_t atOnce = 8192;
  const std::size_t pieces = piecesFor(count, atOnce);
  std::atomic<std::size_t> next = 0;
  InOrder inOrder(put);
  inParallel(threadsFor(pieces), [&](std::size_t) {
    std::size_t longest = 0;
    for (std::size_t k = next++; k < pieces; k = next++) {
      std::string piece;
      piece.reserve(longest);
      for (std::size_t i = k * atOnce; i < std::min((k + 1) * atOnce, count); ++i) write(i, piece);
      longest = std::max(longest, piece.size());
      inOrder.add(k, std::move(piece));
    }
  });
}

double largestCoordinate(const Stretches& stretches) {
  float largest = 0;
  for (const Stretch& stretch : stretches.all())
    for (const glm::vec3& p : stretch.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

template <class Put>
void putObj(const Put& put, const PlantMesh& mesh, const Stretches& stretches, const std::string& mtlName) {
  const FixedText lengths = FixedText::forNumbersUpTo(largestCoordinate(stretches)), directions(normalDecimals);
  put("# " + (mesh.name.empty() ? std::string("plant") : asWord(mesh.name)) + ", Y up\nmtllib " + mtlName + "\n");
  for (const Stretch& stretch : stretches.all())
    putEach(put, stretch.positions.size(), [&](std::size_t i, std::string& to) { appendVector(to, "v", stretch.positions[i], lengths); });
  for (const Stretch& stretch : stretches.all())
    putEach(put, stretch.normals.size(), [&](std::size_t i, std::string& to) { appendVector(to, "vn", stretch.normals[i], directions); });
  const std::vector<std::uint32_t> order = byOrgan(stretches);
  putEach(put, order.size(), [&](std::size_t i, std::string& to) {
    const TriangleSource& source = stretches.source(order[i]);
    const TriangleSource before = i == 0 ? TriangleSource{.organ = {}, .material = -1} : stretches.source(order[i - 1]);
    if (source.organ != before.organ) to += "g organ_" + std::to_string(source.organ.value) + "\n";
    if (source.material != before.material) to += "usemtl " + asWord(mesh.materials[static_cast<std::size_t>(source.material)].name) + "\n";
    const Stretch& stretch = stretches.ofTriangle(order[i]);
    appendFace(to, stretch.triangles.data() + 3 * (order[i] - stretch.firstTriangle), static_cast<std::uint32_t>(stretch.firstVertex) + 1);
  });
}

Result<void> checkMtlName(const std::string& name) {
  if (!name.empty() && name == asWord(name)) return {};
  return fail(ErrorCode::BadInput, "an OBJ file cannot name its materials \"" + name + "\"; choose a file name without blanks and #");
}

}  // namespace

Result<ObjFiles> objAndMtl(const PlantMesh& mesh, const std::string& mtlName) {
  if (const auto checked = checkMtlName(mtlName); !checked) return checked.failure();
  const Stretches stretches(mesh);
  ObjFiles files{.obj = {}, .mtl = mtlOf(mesh, stretches)};
  files.obj.reserve(stretches.vertexCount() * 64 + stretches.triangleCount() * 54 + 1024);  // pages that stay empty cost nothing
  putObj([&](std::string_view piece) { files.obj += piece; }, mesh, stretches, mtlName);
  return files;
}

Result<void> writeObj(const PlantMesh& mesh, const std::filesystem::path& file) {
  const std::filesystem::path library = file.parent_path() / (asWord(file.stem().string()) + ".mtl");
  const Stretches stretches(mesh);
  if (auto written = writeFile(library, mtlOf(mesh, stretches)); !written) return written;
  FileWriter writer(file);
  putObj([&](std::string_view piece) { writer.write(piece); }, mesh, stretches, library.filename().string());
  return writer.finish();
}

}  // namespace axil::render
