#include "render/mesh_files.hpp"

#include "render/flat_mesh.hpp"

#include <glm/common.hpp>

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>

namespace axil::render {
namespace {

/// A file holds its length in 32 bits; some room is left for the text.
constexpr std::size_t largestBuffer = 3'900'000'000;

/// A stream into a string that has its room from the start: a large file would be copied several times else.
class StringSink : public std::streambuf {
 public:
  explicit StringSink(std::size_t expectedBytes) { text_.reserve(expectedBytes); }
  [[nodiscard]] std::string take() && { return std::move(text_); }

 protected:
  std::streamsize xsputn(const char* from, std::streamsize count) override {
    text_.append(from, static_cast<std::size_t>(count));
    return count;
  }
  int_type overflow(int_type c) override {
    if (!traits_type::eq_int_type(c, traits_type::eof())) text_.push_back(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

 private:
  std::string text_;
};

/// Collects meshes and nodes; a material that several parts share is written once.
class GlbWriter {
 public:
  explicit GlbWriter(const PlantMesh& mesh) : mesh_(mesh) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Axil";
    model_.buffers.resize(1);
    model_.buffers[0].data.reserve((mesh.stems.positions.size() + mesh.faces.positions.size()) * 32 + (mesh.stems.triangles.size() + mesh.faces.triangles.size()) * 4 + 64);
  }

  int addStems() { return addColoured("stems", mesh_.stems, Surface::Solid); }
  int addFaces() { return addColoured("faces", mesh_.faces, Surface::Blade); }

  /// One mesh that all copies of a model share.
  int addModel(const OrganModel& model) {
    std::vector<tinygltf::Primitive> primitives;
    for (const ModelPart& part : model.parts) {
      if (part.mesh.triangles.empty()) continue;
      primitives.push_back(primitiveOf(part.mesh.positions, part.mesh.normals, part.mesh.triangles));
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
      primitives.push_back(primitiveOf(flat.positions, flat.normals, flat.triangles));
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

  [[nodiscard]] std::size_t byteCount() const { return model_.buffers[0].data.size(); }

  [[nodiscard]] std::optional<std::string> written() {
    if (byteCount() == 0) model_.buffers.clear();
    StringSink sink(byteCount() + 1024 + 320 * model_.nodes.size());
    std::ostream stream(&sink);
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true) || !stream) return std::nullopt;
    return std::move(sink).take();
  }

 private:
  template <class T>
  int addView(const std::vector<T>& values, int target) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size() - 1);
  }

  /// A mesh whose colours are in its vertices.
  int addColoured(const char* name, const StemMesh& part, Surface surface) {
    tinygltf::Primitive primitive = primitiveOf(part.positions, part.normals, part.triangles);
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

  int addVectors(const std::vector<glm::vec3>& values) {
    addAccessor(addView(values, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size());
    return lastAccessor();
  }

  int addPositions(const std::vector<glm::vec3>& values) {
    const int index = addVectors(values);
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
  int addColours(const std::vector<glm::vec3>& colours) {
    std::vector<glm::u16vec4> values;
    values.reserve(colours.size());
    for (const glm::vec3& c : colours) values.emplace_back(glm::u16vec4(glm::vec4(glm::clamp(c, 0.0f, 1.0f), 1.0f) * 65535.0f + 0.5f));
    addAccessor(addView(values, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, values.size()).normalized = true;
    return lastAccessor();
  }

  int addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertexCount) {
    if (vertexCount < 65535) {
      const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
      addAccessor(addView(narrow, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, narrow.size());
    } else {
      addAccessor(addView(indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size());
    }
    return lastAccessor();
  }

  tinygltf::Primitive primitiveOf(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals, const std::vector<std::uint32_t>& triangles) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addPositions(positions);
    primitive.attributes["NORMAL"] = addVectors(normals);
    primitive.indices = addIndices(triangles, positions.size());
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
  std::map<std::int32_t, int> materials_;
};

ModelStorage storageFor(const PlantMesh& mesh, ModelStorage asked) {
  if (asked != ModelStorage::Auto) return asked;
  std::size_t count = 0;
  for (const OrganModel& model : mesh.models) count += model.placements.size();
  return count <= sharedUpTo ? ModelStorage::Shared : ModelStorage::Merged;
}

std::optional<std::string> glbOf(const PlantMesh& mesh, const GlbOptions& options) {
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
  return writer.written();
}

}  // namespace

Result<std::string> glbBytes(const PlantMesh& mesh, const GlbOptions& options) {
  if (!std::isfinite(options.metresPerUnit) || options.metresPerUnit <= 0)
    return fail(ErrorCode::BadInput, "a glTF file needs the plant's unit in metres as a number above 0");
  try {
    if (auto bytes = glbOf(mesh, options)) return *std::move(bytes);
  } catch (const std::exception&) {
    // The library throws where its text or memory runs out; the message below says what to do in either case.
  }
  return fail(ErrorCode::LimitReached, "the plant with its " + std::to_string(mesh.triangleCount()) +
                                           " triangles does not fit into a .glb file; ask for a lower level of detail or for shared leaves");
}

}  // namespace axil::render
