#include "render/mesh_files.hpp"

#include "base/file_writer.hpp"
#include "render/flat_mesh.hpp"
#include "render/parallel.hpp"

#include <glm/common.hpp>

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace axil::render {
namespace {

/// A file holds its length in 32 bits; some room is left for the text.
constexpr std::size_t largestBuffer = 3'900'000'000;
constexpr std::size_t coloursAtOnce = 1 << 16;

/// One array of the file: seen where it is, or kept here because the file has it otherwise.
struct Piece {
  std::string_view seen;
  std::vector<char> kept;
  [[nodiscard]] std::string_view bytes() const { return kept.empty() ? seen : std::string_view(kept.data(), kept.size()); }
};

template <class T>
std::string_view bytesOf(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

template <class T>
std::vector<char> copyOf(std::span<const T> values) {
  const std::string_view bytes = bytesOf(values);
  return {bytes.begin(), bytes.end()};
}

/// Where an array lives: in the plant's mesh, as long as that, or in a value that is made for the file.
enum class Lives { WithThePlant, Here };

/// The file: what stands before its arrays, and the arrays.
struct Glb {
  std::string head;
  std::vector<Piece> pieces;
};

std::size_t roundedUp(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

void appendWord(std::string& text, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(value >> shift & 0xff);
}

/// Collects meshes and nodes; a material that several parts share is written once.
class GlbWriter {
 public:
  explicit GlbWriter(const PlantMesh& mesh) : mesh_(mesh) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Axil";
  }

  int addStems() { return addColoured("stems", mesh_.stems, Surface::Solid); }
  int addFaces() { return addColoured("faces", mesh_.faces, Surface::Blade); }

  /// One mesh that all copies of a model share.
  int addModel(const OrganModel& model) {
    std::vector<tinygltf::Primitive> primitives;
    for (const ModelPart& part : model.parts) {
      if (part.mesh.triangles.empty()) continue;
      primitives.push_back(primitiveOf(part.mesh.positions, part.mesh.normals, part.mesh.triangles, Lives::WithThePlant));
      primitives.back().material = materialOf(part.material);
    }
    return addMesh(model.name, std::move(primitives));
  }

  /// All copies of a model, spelled out.
  int addMerged(const OrganModel& model) {
    std::vector<tinygltf::Primitive> primitives;
    for (const ModelPart& part : model.parts) {
      if (part.mesh.triangles.empty()) continue;
      PlantMesh one;
      one.materials = mesh_.materials;
      one.models.push_back({.name = model.name, .parts = {part}, .placements = model.placements});
      const FlatMesh flat = flattened(one);
      primitives.push_back(primitiveOf(flat.positions, flat.normals, flat.triangles, Lives::Here));
      primitives.back().material = materialOf(part.material);
    }
    return addMesh(model.name, std::move(primitives));
  }

  int addNode(const std::string& name, int mesh) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size() - 1);
  }

  int addNode(const std::string& name, int mesh, const Placement& at) {
    const int index = addNode(name, mesh);
    tinygltf::Node& node = model_.nodes.back();
    const glm::dquat q = glm::normalize(glm::dquat(at.rotation));
    node.translation = {at.position.x, at.position.y, at.position.z};
    node.rotation = {q.x, q.y, q.z, q.w};
    node.scale = {at.scale.x, at.scale.y, at.scale.z};
    return index;
  }

  /// The file's one scene: a root that holds everything and turns the plant's unit into metres.
  void addRoot(std::vector<int> children, double metresPerUnit) {
    const int root = addNode(mesh_.name.empty() ? "plant" : mesh_.name, -1);
    model_.nodes.back().children = std::move(children);
    if (metresPerUnit != 1) model_.nodes.back().scale = {metresPerUnit, metresPerUnit, metresPerUnit};
    tinygltf::Scene scene;
    scene.nodes = {root};
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
  }

  [[nodiscard]] std::size_t byteCount() const { return byteCount_; }

  /// The library writes the description; the arrays follow as they are, so that no copy of them is made.
  [[nodiscard]] std::optional<Glb> written() && {
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, false) || !stream) return std::nullopt;
    std::string json = std::move(stream).str();
    while (!json.empty() && json.back() == '\n') json.pop_back();
    if (byteCount_ > 0) json.insert(1, "\"buffers\":[{\"byteLength\":" + std::to_string(byteCount_) + "}],");
    json.resize(roundedUp(json.size()), ' ');
    const std::size_t arrays = byteCount_ > 0 ? 8 + byteCount_ : 0;
    Glb glb{.head = "glTF", .pieces = std::move(pieces_)};
    appendWord(glb.head, 2);
    appendWord(glb.head, 20 + json.size() + arrays);
    appendWord(glb.head, json.size());
    glb.head += "JSON" + json;
    if (arrays == 0) return glb;
    appendWord(glb.head, byteCount_);
    glb.head += std::string("BIN\0", 4);
    return glb;
  }

 private:
  int addView(Piece piece, int target) {
    const std::size_t length = piece.bytes().size();
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = byteCount_;
    view.byteLength = length;
    view.target = target;
    model_.bufferViews.push_back(std::move(view));
    byteCount_ = roundedUp(byteCount_ + length);
    pieces_.push_back(std::move(piece));
    return static_cast<int>(model_.bufferViews.size() - 1);
  }
  /// `seen` stays where it is until the file is written; what is only made for the file is kept.
  template <class T>
  [[nodiscard]] Piece pieceOf(std::span<const T> seen, Lives lives) const {
    return lives == Lives::WithThePlant ? Piece{.seen = bytesOf(seen), .kept = {}} : Piece{.seen = {}, .kept = copyOf(seen)};
  }

  /// A mesh whose colours are in its vertices.
  int addColoured(const char* name, const StemMesh& part, Surface surface) {
    tinygltf::Primitive primitive = primitiveOf(part.positions, part.normals, part.triangles, Lives::WithThePlant);
    primitive.attributes["COLOR_0"] = addColours(part.colours);
    primitive.material = addMaterial({.name = name, .colour = glm::vec3(1), .roughness = 0.85f, .surface = surface});
    return addMesh(name, {std::move(primitive)});
  }

  tinygltf::Accessor& addAccessor(int view, int componentType, int type, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.componentType = componentType;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(std::move(accessor));
    return model_.accessors.back();
  }
  [[nodiscard]] int lastAccessor() const { return static_cast<int>(model_.accessors.size() - 1); }

  int addVectors(std::span<const glm::vec3> values, Lives lives) {
    addAccessor(addView(pieceOf(values, lives), TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size());
    return lastAccessor();
  }

  int addPositions(std::span<const glm::vec3> values, Lives lives) {
    const int index = addVectors(values, lives);
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : values) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    model_.accessors.back().minValues = {low.x, low.y, low.z};
    model_.accessors.back().maxValues = {high.x, high.y, high.z};
    return index;
  }

  /// A vertex colour is linear in glTF, as it is here; 16 bits keep dark ones apart.
  int addColours(std::span<const glm::vec3> colours) {
    std::vector<char> values(colours.size() * sizeof(glm::u16vec4));
    inParallel(piecesFor(colours.size(), coloursAtOnce), [&](std::size_t piece) {
      for (std::size_t i = piece * coloursAtOnce; i < std::min((piece + 1) * coloursAtOnce, colours.size()); ++i) {
        const glm::u16vec4 colour(glm::vec4(glm::clamp(colours[i], 0.0f, 1.0f), 1.0f) * 65535.0f + 0.5f);
        std::memcpy(values.data() + i * sizeof colour, &colour, sizeof colour);
      }
    });
    addAccessor(addView({.seen = {}, .kept = std::move(values)}, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, colours.size()).normalized = true;
    return lastAccessor();
  }

  int addIndices(std::span<const std::uint32_t> indices, std::size_t vertexCount, Lives lives) {
    if (vertexCount < 65535) {
      const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
      addAccessor(addView(pieceOf(std::span(narrow), Lives::Here), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, narrow.size());
    } else {
      addAccessor(addView(pieceOf(indices, lives), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size());
    }
    return lastAccessor();
  }

  tinygltf::Primitive primitiveOf(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals, std::span<const std::uint32_t> triangles, Lives lives) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addPositions(positions, lives);
    primitive.attributes["NORMAL"] = addVectors(normals, lives);
    primitive.indices = addIndices(triangles, positions.size(), lives);
    return primitive;
  }

  int addMesh(const std::string& name, std::vector<tinygltf::Primitive> primitives) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives = std::move(primitives);
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size() - 1);
  }

  int addMaterial(const Material& material) {
    tinygltf::Material written;
    written.name = material.name;
    written.pbrMetallicRoughness.baseColorFactor = {material.colour.r, material.colour.g, material.colour.b, 1};
    written.pbrMetallicRoughness.metallicFactor = 0;
    written.pbrMetallicRoughness.roughnessFactor = std::round(static_cast<double>(material.roughness) * 1000) / 1000;
    written.doubleSided = material.surface == Surface::Blade;
    model_.materials.push_back(std::move(written));
    return static_cast<int>(model_.materials.size() - 1);
  }

  int materialOf(std::int32_t index) {
    const auto [at, isNew] = materials_.try_emplace(index, 0);
    if (isNew) at->second = addMaterial(mesh_.materials[static_cast<std::size_t>(index)]);
    return at->second;
  }

  const PlantMesh& mesh_;
  tinygltf::Model model_;
  std::vector<Piece> pieces_;
  std::size_t byteCount_ = 0;
  std::map<std::int32_t, int> materials_;
};

ModelStorage storageFor(const PlantMesh& mesh, ModelStorage asked) {
  if (asked != ModelStorage::Auto) return asked;
  std::size_t count = 0;
  for (const OrganModel& model : mesh.models) count += model.placements.size();
  return count <= sharedUpTo ? ModelStorage::Shared : ModelStorage::Merged;
}

std::optional<Glb> glbOf(const PlantMesh& mesh, const GlbOptions& options) {
  GlbWriter writer(mesh);
  std::vector<int> children;
  if (!mesh.stems.triangles.empty()) children.push_back(writer.addNode("stems", writer.addStems()));
  if (!mesh.faces.triangles.empty()) children.push_back(writer.addNode("faces", writer.addFaces()));
  const ModelStorage storage = storageFor(mesh, options.storage);
  for (const OrganModel& model : mesh.models) {
    if (storage == ModelStorage::Merged) {
      children.push_back(writer.addNode(model.name, writer.addMerged(model)));
      continue;
    }
    const int shared = writer.addModel(model);
    for (const Placement& at : model.placements) children.push_back(writer.addNode(model.name + " " + std::to_string(at.organ.value), shared, at));
  }
  writer.addRoot(std::move(children), options.metresPerUnit);
  if (writer.byteCount() > largestBuffer) return std::nullopt;
  return std::move(writer).written();
}

Result<Glb> glb(const PlantMesh& mesh, const GlbOptions& options) {
  if (!std::isfinite(options.metresPerUnit) || options.metresPerUnit <= 0)
    return fail(ErrorCode::BadInput, "a glTF file needs the plant's unit in metres as a number above 0");
  try {
    if (auto made = glbOf(mesh, options)) return *std::move(made);
  } catch (const std::exception&) {
    // The library throws where its text or memory runs out; the message below says what to do in either case.
  }
  return fail(ErrorCode::LimitReached, "the plant with its " + std::to_string(mesh.triangleCount()) +
                                           " triangles does not fit into a .glb file; ask for a lower level of detail or for shared leaves");
}

/// Hands out the file's bytes in order; every array starts at a multiple of four.
template <class Put>
void putAll(const Glb& glb, const Put& put) {
  put(glb.head);
  for (const Piece& piece : glb.pieces) {
    put(piece.bytes());
    put(std::string_view("\0\0\0", roundedUp(piece.bytes().size()) - piece.bytes().size()));
  }
}

}  // namespace

Result<std::string> glbBytes(const PlantMesh& mesh, const GlbOptions& options) {
  const auto made = glb(mesh, options);
  if (!made) return made.failure();
  std::string bytes;
  std::size_t size = made->head.size();
  for (const Piece& piece : made->pieces) size += roundedUp(piece.bytes().size());
  bytes.reserve(size);
  putAll(*made, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

Result<void> writeGlb(const PlantMesh& mesh, const std::filesystem::path& file, const GlbOptions& options) {
  const auto made = glb(mesh, options);
  if (!made) return made.failure();
  FileWriter writer(file);
  putAll(*made, [&](std::string_view piece) { writer.write(piece); });
  return writer.finish();
}

}  // namespace axil::render
