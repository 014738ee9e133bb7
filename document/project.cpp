#include "document/project.hpp"

#include "base/files.hpp"
#include "base/text.hpp"
#include "document/degrees.hpp"
#include "document/json_lines.hpp"
#include "document/json_reader.hpp"

#include <nlohmann/json.hpp>

#include <limits>

namespace axil::document {

using Json = nlohmann::ordered_json;
using skeleton3d::Camera;
using skeleton3d::CameraModel;
using skeleton3d::KnownLength;
using skeleton3d::NodeId;
using skeleton3d::StemId;

namespace {

constexpr std::uintmax_t kMaximumProjectBytes = std::uintmax_t{256} << 20;
constexpr std::int64_t kMaximumId = std::numeric_limits<std::int32_t>::max();
constexpr int kVersion = 1;

// ---- reading ---------------------------------------------------------------------------------------------------------

CameraModel modelOf(ObjectReader& reader) {
  const std::string model = reader.text("model");
  if (model == "orthographic") return CameraModel::Orthographic;
  if (model == "perspective") return CameraModel::Perspective;
  if (model != "unknown" && !model.empty()) reader.fault("model", "is '" + model + "'; it must be orthographic, perspective or unknown");
  return CameraModel::Unknown;
}

// JSON holds the rotation by rows; GLM by columns.
void readPose(ObjectReader& reader, Camera& camera) {
  const std::vector<double> t = reader.numbers("translation", 3);
  camera.translation = {t[0], t[1], t[2]};
  const auto rows = reader.rows("rotation");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) camera.rotation[column][row] = rows[static_cast<std::size_t>(row * 3 + column)];
}

Camera readCamera(ObjectReader reader, Extras& extras) {
  Camera camera;
  camera.model = modelOf(reader);
  if (reader.has("focal_px")) {
    const std::vector<double> f = reader.numbers("focal_px", 2);
    camera.focal_px = glm::dvec2{f[0], f[1]};
  }
  if (camera.model != CameraModel::Unknown || reader.has("centre_px")) camera.centre_px = reader.point("centre_px").px;
  if (camera.model == CameraModel::Perspective && !camera.focal_px) reader.fault("focal_px", "is missing");
  if (reader.has("distortion")) {
    const std::vector<double> k = reader.numbers("distortion", 5);
    std::copy(k.begin(), k.end(), camera.distortion.begin());
  }
  if (camera.model == CameraModel::Orthographic) camera.scale_px_per_unit = reader.number("scale_px_per_unit");
  if (camera.model != CameraModel::Unknown) readPose(reader, camera);
  extras = reader.extras();
  return camera;
}

KnownLength readScale(ObjectReader reader) {
  const KnownLength scale{reader.point("from_px"), reader.point("to_px"), reader.number("length")};
  if (scale.length <= 0) reader.fault("length", "must be above zero");
  if (scale.from == scale.to) reader.fault("to_px", "is the same point as from_px; click the two ends of the known length");
  return scale;
}

ProjectView readView(ObjectReader reader) {
  ProjectView view;
  view.view.name = reader.text("name");
  view.photo = reader.textOr("photo", "");
  view.view.camera = readCamera(reader.object("camera"), view.cameraExtras);
  if (reader.has("size_px")) {
    const std::vector<std::int64_t> size = reader.integers("size_px", 1, 1'000'000);
    if (size.size() == 2) view.view.size_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
    else reader.fault("size_px", "must be [width, height]");
  }
  if (reader.has("origin_px")) view.origin_px = reader.point("origin_px");
  if (reader.has("scale")) view.scale = readScale(reader.object("scale"));
  view.extras = reader.extras();
  return view;
}

void readPlaced(ObjectReader placed, skeleton3d::ClickedNode& node) {
  for (const std::string& view : placed.allKeys()) {
    const double within_px = placed.number(view.c_str());
    if (!node.clicks.contains(view)) placed.fault(view, "names a view that the node has no click in");
    else if (within_px < 0) placed.fault(view, "must not be negative");
    else node.placed[view] = within_px;
  }
}

ProjectNode readNode(ObjectReader reader) {
  ProjectNode node;
  node.node.id = NodeId(static_cast<std::int32_t>(reader.integer("id", 0, kMaximumId)));
  ObjectReader clicks = reader.object("clicks");
  for (const std::string& view : clicks.allKeys()) node.node.clicks[view] = clicks.point(view.c_str());
  if (reader.has("placed")) readPlaced(reader.object("placed"), node.node);
  node.node.radius = reader.numberIfAny("radius");
  if (node.node.radius && *node.node.radius < 0) reader.fault("radius", "must not be negative");
  node.extras = reader.extras();
  return node;
}

std::vector<NodeId> readNodeIds(ObjectReader& reader, const char* key) {
  std::vector<NodeId> ids;
  for (const std::int64_t id : reader.integers(key, 0, kMaximumId)) ids.emplace_back(static_cast<std::int32_t>(id));
  return ids;
}

ProjectStem readStem(ObjectReader reader) {
  ProjectStem stem;
  stem.stem.id = StemId(static_cast<std::int32_t>(reader.integer("id", 0, kMaximumId)));
  stem.stem.nodes = readNodeIds(reader, "nodes");
  stem.extras = reader.extras();
  return stem;
}

std::optional<Angle> degreesIfAny(ObjectReader& reader, const char* key) {
  const auto degrees = reader.numberIfAny(key);
  return degrees ? std::optional(Angle::fromDegrees(*degrees)) : std::nullopt;
}

std::optional<double> lengthIfAny(ObjectReader& reader, const char* key) {
  const auto length = reader.numberIfAny(key);
  if (length && *length < 0) reader.fault(key, "must not be negative");
  return length;
}

ProjectLeaves readLeaves(ObjectReader reader) {
  ProjectLeaves leaves;
  quantify::LeafArrangement& a = leaves.arrangement;
  a.stem = StemId(static_cast<std::int32_t>(reader.integer("stem", 0, kMaximumId)));
  a.arrangement = reader.textOr("arrangement", "");
  if (reader.has("nodes")) a.nodes = static_cast<int>(reader.integer("nodes", 1, 100'000));
  if (reader.has("at")) a.at = readNodeIds(reader, "at");
  a.angle = degreesIfAny(reader, "angle_deg");
  a.roll = degreesIfAny(reader, "roll_deg");
  a.azimuth = degreesIfAny(reader, "azimuth_deg");
  a.length = lengthIfAny(reader, "length");
  a.width = lengthIfAny(reader, "width");
  a.petiole = lengthIfAny(reader, "petiole");
  a.shape = reader.textOr("shape", "");
  leaves.extras = reader.extras();
  return leaves;
}

Verdict verdictOf(ObjectReader& reader) {
  const std::string verdict = reader.text("verdict");
  if (verdict == "rejected") return Verdict::Rejected;
  if (verdict == "changed") return Verdict::Changed;
  if (verdict != "accepted" && !verdict.empty()) reader.fault("verdict", "is '" + verdict + "'; it must be accepted, changed or rejected");
  return Verdict::Accepted;
}

ProjectTrait readTrait(ObjectReader reader) {
  ProjectTrait trait;
  trait.organ = reader.text("organ");
  trait.property = reader.text("property");
  trait.words = reader.textOr("words", "");
  trait.verdict = verdictOf(reader);
  trait.value = reader.textOr("value", "");
  trait.low = reader.numberIfAny("low");
  trait.high = reader.numberIfAny("high");
  trait.unit = reader.textOr("unit", "");
  trait.extras = reader.extras();
  return trait;
}

void checkVersion(ObjectReader& reader) {
  const std::int64_t version = reader.integer("axil", 1, 1'000'000);
  if (version > kVersion)
    reader.fault("axil", "is " + std::to_string(version) + ": the project was made by a newer version of Axil than this one, which reads version " +
                             std::to_string(kVersion));
}

Project readProject(ObjectReader reader) {
  Project project;
  checkVersion(reader);
  project.name = reader.textOr("name", "plant");
  project.unit = reader.textOr("unit", "m");
  if (reader.has("seed")) project.seed = static_cast<std::uint64_t>(reader.integer("seed", 0, std::int64_t{1} << 53));
  project.description = reader.textOr("description", "");
  if (reader.has("traits"))
    for (ObjectReader& trait : reader.objects("traits")) project.traits.push_back(readTrait(std::move(trait)));
  for (ObjectReader& view : reader.objects("views")) project.views.push_back(readView(std::move(view)));
  for (ObjectReader& node : reader.objects("nodes")) project.nodes.push_back(readNode(std::move(node)));
  for (ObjectReader& stem : reader.objects("stems")) project.stems.push_back(readStem(std::move(stem)));
  for (ObjectReader& leaves : reader.objects("leaves")) project.leaves.push_back(readLeaves(std::move(leaves)));
  project.extras = reader.extras();
  return project;
}

// ---- writing ---------------------------------------------------------------------------------------------------------

Json pointJson(PhotoPoint p) { return Json::array({p.px.x, p.px.y}); }

void addExtras(Json& object, const Extras& extras) {
  for (const auto& [key, text] : extras) object[key] = Json::parse(text);
}

const char* modelName(CameraModel model) {
  switch (model) {
    case CameraModel::Orthographic: return "orthographic";
    case CameraModel::Perspective: return "perspective";
    case CameraModel::Unknown: return "unknown";
  }
  return "unknown";
}

Json rotationJson(const glm::dmat3& r) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) rows.push_back({r[0][row] + 0.0, r[1][row] + 0.0, r[2][row] + 0.0});  // + 0.0: no -0
  return rows;
}

Json cameraJson(const Camera& camera, const Extras& extras) {
  Json json = {{"model", modelName(camera.model)}};
  if (camera.focal_px) json["focal_px"] = {camera.focal_px->x, camera.focal_px->y};
  if (camera.model != CameraModel::Unknown || camera.centre_px != glm::dvec2{0, 0}) json["centre_px"] = {camera.centre_px.x, camera.centre_px.y};
  if (camera.model == CameraModel::Perspective || camera.distortion != Camera{}.distortion) json["distortion"] = camera.distortion;
  if (camera.model == CameraModel::Orthographic) json["scale_px_per_unit"] = camera.scale_px_per_unit;
  if (camera.model != CameraModel::Unknown) {
    json["rotation"] = rotationJson(camera.rotation);
    json["translation"] = {camera.translation.x, camera.translation.y, camera.translation.z};
  }
  addExtras(json, extras);
  return json;
}

Json viewJson(const ProjectView& view) {
  Json json = {{"name", view.view.name}};
  if (!view.photo.empty()) json["photo"] = view.photo;
  if (view.view.size_px != glm::ivec2{0, 0}) json["size_px"] = {view.view.size_px.x, view.view.size_px.y};
  json["camera"] = cameraJson(view.view.camera, view.cameraExtras);
  if (view.origin_px) json["origin_px"] = pointJson(*view.origin_px);
  if (view.scale) json["scale"] = {{"from_px", pointJson(view.scale->from)}, {"to_px", pointJson(view.scale->to)}, {"length", view.scale->length}};
  addExtras(json, view.extras);
  return json;
}

Json nodeJson(const ProjectNode& node) {
  Json clicks = Json::object();
  for (const auto& [view, click] : node.node.clicks) clicks[view] = pointJson(click);
  Json json = {{"id", node.node.id.value}, {"clicks", clicks}};
  if (!node.node.placed.empty()) json["placed"] = node.node.placed;
  if (node.node.radius) json["radius"] = *node.node.radius;
  addExtras(json, node.extras);
  return json;
}

Json idsJson(const std::vector<NodeId>& ids) {
  Json list = Json::array();
  for (const NodeId id : ids) list.push_back(id.value);
  return list;
}

Json stemJson(const ProjectStem& stem) {
  Json json = {{"id", stem.stem.id.value}, {"nodes", idsJson(stem.stem.nodes)}};
  addExtras(json, stem.extras);
  return json;
}

Json leavesJson(const ProjectLeaves& leaves) {
  const quantify::LeafArrangement& a = leaves.arrangement;
  Json json = {{"stem", a.stem.value}};
  if (!a.arrangement.empty()) json["arrangement"] = a.arrangement;
  if (a.nodes) json["nodes"] = *a.nodes;
  if (!a.at.empty()) json["at"] = idsJson(a.at);
  if (a.angle) json["angle_deg"] = degreesOf(*a.angle);
  if (a.roll) json["roll_deg"] = degreesOf(*a.roll);
  if (a.azimuth) json["azimuth_deg"] = degreesOf(*a.azimuth);
  if (a.length) json["length"] = *a.length;
  if (a.width) json["width"] = *a.width;
  if (a.petiole) json["petiole"] = *a.petiole;
  if (!a.shape.empty()) json["shape"] = a.shape;
  addExtras(json, leaves.extras);
  return json;
}

const char* verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::Accepted: return "accepted";
    case Verdict::Changed: return "changed";
    case Verdict::Rejected: return "rejected";
  }
  return "accepted";
}

Json traitJson(const ProjectTrait& trait) {
  Json json = {{"organ", trait.organ}, {"property", trait.property}};
  if (!trait.words.empty()) json["words"] = trait.words;
  json["verdict"] = verdictName(trait.verdict);
  if (!trait.value.empty()) json["value"] = trait.value;
  if (trait.low) json["low"] = *trait.low;
  if (trait.high) json["high"] = *trait.high;
  if (!trait.unit.empty()) json["unit"] = trait.unit;
  addExtras(json, trait.extras);
  return json;
}

template <class Items, class ToJson>
Json listJson(const Items& items, ToJson toJson) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(toJson(item));
  return list;
}

Json projectJson(const Project& project) {
  Json json = {{"axil", kVersion}, {"name", project.name}, {"unit", project.unit}, {"seed", project.seed}, {"description", project.description.text()}};
  if (!project.traits.empty()) json["traits"] = listJson(project.traits, traitJson);
  json["views"] = listJson(project.views, viewJson);
  json["nodes"] = listJson(project.nodes, nodeJson);
  json["stems"] = listJson(project.stems, stemJson);
  json["leaves"] = listJson(project.leaves, leavesJson);
  addExtras(json, project.extras);
  return json;
}

Failure withFileName(const Error& error, const std::filesystem::path& path) {
  Error named = error;
  named.message = path.string() + ": " + error.message;
  return fail(std::move(named));
}

}  // namespace

Result<Project> parseProject(std::string_view text) {
  const auto decoded = decodeText(text);
  if (!decoded) return fail(ErrorCode::Unreadable, "this is not text; a project is a UTF-8 JSON file");
  if (decoded->encoding != "UTF-8")
    return fail(ErrorCode::Unreadable, "the text is " + decoded->encoding + "; a project must be UTF-8, so save it as UTF-8 and try again");
  const auto json = parseJson(decoded->utf8);
  if (!json) return json.failure();
  if (!json->is_object() || !json->contains("axil"))
    return fail(ErrorCode::BadInput, "this is not an Axil project: it has no \"axil\" key with the version");
  std::vector<std::string> faults;
  Project project = readProject(ObjectReader(*json, "", faults));
  if (faults.empty()) return project;
  const std::string count = faults.size() == 1 ? "one value is wrong" : std::to_string(faults.size()) + " values are wrong";
  return fail(Error{ErrorCode::BadInput, count, std::move(faults)});
}

std::string projectText(const Project& project) { return jsonLines(projectJson(project)); }

Result<OpenProject> loadProject(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaximumProjectBytes);
  if (!text) return text.failure();
  auto project = parseProject(*text);
  if (!project) return withFileName(project.error(), path);
  return OpenProject{std::move(*project), path.parent_path()};
}

Result<void> saveProject(const Project& project, const std::filesystem::path& path) { return writeFile(path, projectText(project)); }

}  // namespace axil::document
