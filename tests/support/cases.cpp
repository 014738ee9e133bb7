#include "support/cases.hpp"

#include "base/rng.hpp"
#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "support/shared_data.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

namespace axil::test {
namespace {

using nlohmann::json;
using namespace axil::skeleton3d;

json readJson(const std::filesystem::path& path) {
  std::ifstream in(path);
  return json::parse(in);
}

glm::dvec3 vec3(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

Camera cameraFrom(const json& j) {
  Camera camera;
  const json& k = j.at("K");
  camera.centre_px = {k[0][2].get<double>(), k[1][2].get<double>()};
  if (j.at("type") == "perspective") {
    camera.model = CameraModel::Perspective;
    camera.focal_px = glm::dvec2{k[0][0].get<double>(), k[1][1].get<double>()};
  } else {
    camera.model = CameraModel::Orthographic;
    camera.scale_px_per_unit = k[0][0].get<double>();
  }
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) camera.rotation[column][row] = j.at("R")[row][column].get<double>();
  camera.translation = vec3(j.at("t"));
  return camera;
}

struct Spot {
  glm::dvec3 at;
  double radius;
};

struct Chains {
  std::vector<Spot> nodes;
  std::vector<std::vector<std::size_t>> stems;
};

/// The point of a branch at the fractional node number `s`.
Spot spotAt(const json& branch, double s) {
  const json& points = branch.at("points");
  const std::size_t i = std::min(static_cast<std::size_t>(s), points.size() - 2);
  const double f = s - static_cast<double>(i);
  const double r0 = branch.at("radius")[i].get<double>(), r1 = branch.at("radius")[i + 1].get<double>();
  return {vec3(points[i]) * (1 - f) + vec3(points[i + 1]) * f, r0 * (1 - f) + r1 * f};
}

double parentIndexOf(const json& branch) { return roundedTo(branch.at("parent_index").get<double>(), 4); }

/// Node numbers at which each branch is cut: every n-th, its last, and where a branch leaves it.
std::map<int, std::set<double>> cutsOf(const json& branches, int every) {
  std::map<int, std::set<double>> cuts;
  for (const json& b : branches) cuts[b.at("id").get<int>()].insert({0.0, static_cast<double>(b.at("points").size()) - 1});
  for (const json& b : branches) {
    if (const int parent = b.at("parent").get<int>(); cuts.contains(parent)) cuts[parent].insert(parentIndexOf(b));
    for (std::size_t k = 0; k < b.at("points").size(); k += static_cast<std::size_t>(every)) cuts[b.at("id").get<int>()].insert(static_cast<double>(k));
  }
  return cuts;
}

/// The node of `parent` nearest to where the branch leaves it.
std::size_t nodeOnParent(const std::map<std::pair<int, double>, std::size_t>& where, int parent, double index) {
  std::optional<std::pair<double, std::size_t>> nearest;
  for (const auto& [key, node] : where)
    if (key.first == parent && (!nearest || std::abs(key.second - index) < nearest->first)) nearest = {std::abs(key.second - index), node};
  return nearest.value().second;
}

Chains chainsOf(const json& plant, int every) {
  const json& branches = plant.at("branches");
  auto cuts = cutsOf(branches, every);
  Chains chains;
  std::map<std::pair<int, double>, std::size_t> where;
  for (const json& b : branches) {
    std::vector<std::size_t> chain;
    const int id = b.at("id").get<int>();
    for (const double s : cuts[id]) {
      if ((s == 0 && b.at("parent") != -1) || b.at("points").size() < 2) continue;
      where[{id, s}] = chains.nodes.size();
      chain.push_back(chains.nodes.size());
      chains.nodes.push_back(spotAt(b, s));
    }
    chains.stems.push_back(chain);
  }
  for (std::size_t i = 0; i < branches.size(); ++i)
    if (const int parent = branches[i].at("parent").get<int>(); parent != -1)
      chains.stems[i].insert(chains.stems[i].begin(), nodeOnParent(where, parent, parentIndexOf(branches[i])));
  return chains;
}

PhotoPoint rounded(glm::dvec2 px) { return {{roundedTo(px.x, 3), roundedTo(px.y, 3)}}; }

glm::dvec2 noise(Rng& rng, double sigma) { return sigma > 0 ? glm::dvec2{rng.normal(0, sigma), rng.normal(0, sigma)} : glm::dvec2{0, 0}; }

UnknownCameraHints hintsOf(const json& cameras, const Camera& camera, const std::string& kind, double sigma, Rng rng) {
  const auto seen = [&](const glm::dvec3& p) { return rounded(project(camera, {p}).px + noise(rng, sigma)); };
  UnknownCameraHints hints;
  hints.origin_px = seen({0, 0, 0});
  if (kind == "handheld" && cameras.contains("scale_references")) {  // only the cluttered scenes have the rod
    const json& rod = cameras["scale_references"];
    hints.scale = KnownLength{seen(vec3(rod["points"]["rod_bottom"])), seen(vec3(rod["points"]["rod_top"])), rod["rod_length_m"].get<double>()};
  }
  return hints;
}

std::optional<PhotoPoint> clickAt(const Camera& camera, glm::ivec2 size, const glm::dvec3& point, const PlantCaseOptions& options, Rng rng) {
  const glm::dvec2 p = project(camera, {point}).px;
  if (!(p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y)) return std::nullopt;
  glm::dvec2 q = p + noise(rng, options.noise_px);
  if (rng.uniform() < options.wrongShare) {
    const double turn = rng.uniform(0, 2 * std::numbers::pi);
    q += rng.uniform(20, 80) * glm::dvec2{std::cos(turn), std::sin(turn)};
  }
  return rounded({std::clamp(q.x, 0.0, size.x - 1e-3), std::clamp(q.y, 0.0, size.y - 1e-3)});
}

void addView(PlantCase& made, const json& cameras, const std::string& name, const PlantCaseOptions& options) {
  const Camera camera = cameraFrom(cameras.at("cameras").at(options.cameras + "_" + name));
  View view{name, camera, {cameras.at("image_size")[0].get<int>(), cameras.at("image_size")[1].get<int>()}};
  const Rng rng = Rng(options.seed).split(made.views.size() + 1);
  for (std::size_t k = 0; k < made.nodes.size(); ++k)
    if (const auto click = clickAt(camera, view.size_px, made.truth[k].at, options, rng.split(k))) made.nodes[k].clicks[name] = *click;
  if (!options.known) {
    view.camera = {};
    if (camera.focal_px) view.camera.focal_px = glm::dvec2{roundedTo(camera.focal_px->x, 1), roundedTo(camera.focal_px->y, 1)};
    made.hints[name] = hintsOf(cameras, camera, options.cameras, options.noise_px, rng.split(0, 1));
  }
  made.views.push_back(view);
}

}  // namespace

std::vector<std::filesystem::path> plantCaseFolders() {
  std::vector<std::filesystem::path> folders;
  const auto home = sharedPath("data/plants/cases");
  if (!std::filesystem::exists(home)) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(home))
    if (std::filesystem::exists(entry.path() / "plant.json")) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

PlantCase readPlantCase(const std::filesystem::path& folder, const PlantCaseOptions& options) {
  const json plant = readJson(folder / "plant.json");
  const json cameras = readJson(folder / "cameras.json");
  PlantCase made;
  made.name = plant.at("name").get<std::string>();
  made.height_m = plant.at("height_m").get<double>();
  const Chains chains = chainsOf(plant, options.every);
  for (std::size_t k = 0; k < chains.nodes.size(); ++k) {
    made.truth.push_back({chains.nodes[k].at});
    ClickedNode node{NodeId(static_cast<int>(k) + 1), {}, std::nullopt};
    if (options.radius) node.radius = roundedTo(chains.nodes[k].radius, 6);
    made.nodes.push_back(node);
  }
  for (std::size_t k = 0; k < chains.stems.size(); ++k) {
    if (chains.stems[k].size() < 2) continue;
    ClickedStem stem{StemId(static_cast<int>(k) + 1), {}};
    for (const std::size_t n : chains.stems[k]) stem.nodes.push_back(NodeId(static_cast<int>(n) + 1));
    made.stems.push_back(stem);
  }
  for (const std::string name : {"front", "right", "top"}) addView(made, cameras, name, options);
  return made;
}

}  // namespace axil::test
