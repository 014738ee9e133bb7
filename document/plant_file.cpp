#include "document/plant_file.hpp"

#include "base/files.hpp"
#include "document/json_reader.hpp"

#include <nlohmann/json.hpp>

#include <limits>

namespace axil::document {

namespace {

constexpr std::uintmax_t kMostBytes = 100'000'000;
constexpr std::int64_t kMostId = std::numeric_limits<std::int32_t>::max();

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

glm::dvec3 vectorIn(ObjectReader& object, const char* key) {
  const std::vector<double> v = object.numbers(key, 3);
  return {v[0], v[1], v[2]};
}

PlantDirection directionIn(ObjectReader& object, const char* key) {
  const glm::dvec3 v = vectorIn(object, key);
  if (PlantDirection::hasDirection(v)) return PlantDirection::along(v);
  object.fault(key, "is no direction; give three numbers that are not all 0");
  return PlantDirection::up();
}

std::int32_t idIn(ObjectReader& object, const char* key) { return static_cast<std::int32_t>(object.integer(key, 0, kMostId)); }

skeleton3d::Node nodeIn(ObjectReader& object) {
  skeleton3d::Node node;
  node.id = NodeId{idIn(object, "id")};
  node.position.at = vectorIn(object, "position");
  node.radius = object.numberIfAny("radius");
  if (object.has("sigma")) node.sigma = vectorIn(object, "sigma");
  return node;
}

skeleton3d::Stem stemIn(ObjectReader& object) {
  skeleton3d::Stem stem;
  stem.id = StemId{idIn(object, "id")};
  if (const auto parent = object.numberIfAny("parent")) stem.parent = StemId{static_cast<std::int32_t>(*parent)};
  for (const std::int64_t id : object.integers("nodes", 0, kMostId)) stem.nodes.push_back(NodeId{static_cast<std::int32_t>(id)});
  return stem;
}

skeleton3d::Leaf leafIn(ObjectReader& object) {
  skeleton3d::Leaf leaf;
  leaf.stem = StemId{idIn(object, "stem")};
  leaf.position.at = vectorIn(object, "position");
  leaf.direction = directionIn(object, "direction");
  leaf.normal = directionIn(object, "normal");
  if (!areParallel(leaf.direction, leaf.normal)) leaf.normal = perpendicularTo(leaf.direction, leaf.normal);
  leaf.length = object.number("length");
  leaf.width = object.numberIfAny("width").value_or(0);
  leaf.shape = object.textOr("shape", "");
  return leaf;
}

/// A stem without a parent but the first is null in the file; ObjectReader takes null for missing or wrong, so it is left out before.
nlohmann::ordered_json withoutNulls(nlohmann::ordered_json json) {
  if (!json.is_object() || !json.contains("stems") || !json["stems"].is_array()) return json;
  for (auto& stem : json["stems"])
    if (stem.is_object() && stem.contains("parent") && stem["parent"].is_null()) stem.erase("parent");
  return json;
}

}  // namespace

Result<Skeleton> parseSkeleton(std::string_view text) {
  auto parsed = parseJson(text);
  if (!parsed) return parsed.failure();
  const nlohmann::ordered_json json = withoutNulls(std::move(*parsed));
  std::vector<std::string> faults;
  ObjectReader file(json, "", faults);
  static_cast<void>(file.integer("axil_skeleton", 1, 1));
  Skeleton skeleton;
  skeleton.unit = file.textOr("unit", "m");
  skeleton.root = NodeId{idIn(file, "root")};
  for (ObjectReader& node : file.objects("nodes")) skeleton.nodes.push_back(nodeIn(node));
  for (ObjectReader& stem : file.objects("stems")) skeleton.stems.push_back(stemIn(stem));
  if (file.has("leaves"))
    for (ObjectReader& leaf : file.objects("leaves")) skeleton.leaves.push_back(leafIn(leaf));
  if (faults.empty()) return skeleton;
  return fail(Error{ErrorCode::BadInput, "this is no skeleton file; axil skeleton and axil grow -o plant.json write them", std::move(faults)});
}

Result<PlantFile> readPlant(const std::filesystem::path& file, const ChainOptions& options) {
  const auto named = [&](const Error& error) { return fail(Error{error.code, file.string() + ": " + error.message, error.details}); };
  PlantFile plant;
  plant.name = file.stem().string();
  if (file.extension() == ".json") {
    const auto text = readFile(file, kMostBytes);
    if (!text) return text.failure();
    auto skeleton = parseSkeleton(*text);
    if (!skeleton) return named(skeleton.error());
    plant.skeleton = quantify::withoutStalks(std::move(*skeleton));  // a grown plant has them as stems
  } else {
    const auto open = loadProject(file);
    if (!open) return open.failure();
    plant.name = open->project.name;
    auto skeleton = skeletonOf(*open, options);
    if (!skeleton) return named(skeleton.error());
    plant.skeleton = std::move(*skeleton);
  }
  auto measured = measurementsOf(plant.skeleton, options);
  if (!measured) return named(measured.error());
  plant.measurements = std::move(*measured);
  return plant;
}

}  // namespace axil::document
