/// \file
/// Makes a sample: grows a grammar, photographs the plant from front, right and top as a user would, and clicks its nodes.
///
///   axil_photograph GRAMMAR DESCRIPTION OUT_FOLDER
///
/// The clicks are the projected nodes, rounded to a tenth of a pixel; the cameras are perspective and known. A stem organ
/// that carries nothing but one leaf is taken for its stalk.

#include "base/files.hpp"
#include "document/chain.hpp"
#include "render/render.hpp"
#include "simeco/simeco.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdio>
#include <map>

namespace {

using namespace axil;
using document::Project;
using simeco::Organ;
using simeco::OrganId;
using simeco::OrganKind;
using simeco::Plant;
using skeleton3d::NodeId;
using skeleton3d::StemId;

constexpr glm::ivec2 kSize{900, 1200};
constexpr double kFocal_px = 1700;
// A growing point's body is as long as a hair is wide; a person clicks none.
constexpr double kNegligible = 1e-5;

struct LeafOrgan {
  OrganId leaf;
  double petiole = 0;
  StemId stem;
  NodeId node;
};

/// What a person would have clicked, node and stem ids from 1 in the order of their lists.
struct Clicked {
  std::vector<document::ProjectView> views;
  std::vector<document::ProjectNode> nodes;
  std::vector<document::ProjectStem> stems;
  std::vector<document::ProjectLeaves> leaves;
  std::vector<PlantPoint> places;  ///< of the nodes
  std::vector<LeafOrgan> organs;   ///< of the leaves
};

template <class T>
document::SharedList<T> shared(const std::vector<T>& elements) {
  document::SharedList<T> list;
  for (const T& element : elements) list.push_back(element);
  return list;
}

Project projectOf(const Clicked& clicked) {
  Project project;
  project.views = shared(clicked.views);
  project.nodes = shared(clicked.nodes);
  project.stems = shared(clicked.stems);
  project.leaves = shared(clicked.leaves);
  return project;
}

/// Stem organs that carry exactly one leaf and nothing else.
std::vector<bool> stalksOf(const Plant& plant) {
  std::vector<int> children(plant.organs.size(), 0);
  std::vector<int> leaves(plant.organs.size(), 0);
  for (const Organ& organ : plant.organs) {
    if (!organ.parent) continue;
    const auto parent = static_cast<std::size_t>(organ.parent->value);
    ++children[parent];
    if (organ.kind == OrganKind::Leaf) ++leaves[parent];
  }
  std::vector<bool> stalks(plant.organs.size());
  for (std::size_t i = 0; i < stalks.size(); ++i) stalks[i] = plant.organs[i].kind == OrganKind::Stem && children[i] == 1 && leaves[i] == 1;
  return stalks;
}

NodeId addNode(Clicked& clicked, PlantPoint at, double radius) {
  clicked.places.push_back(at);
  const NodeId id(static_cast<std::int32_t>(clicked.places.size()));
  clicked.nodes.push_back({{id, {}, std::round(radius * 1e5) / 1e5}, {}});
  return id;
}

Clicked click(const Plant& plant) {
  Clicked clicked;
  const std::vector<bool> stalks = stalksOf(plant);
  std::vector<NodeId> tipNode(plant.organs.size());
  std::vector<StemId> stemOf(plant.organs.size());
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    const Organ& organ = plant.organs[i];
    const NodeId from = organ.parent ? tipNode[static_cast<std::size_t>(organ.parent->value)] : addNode(clicked, organ.base, organ.radius);
    const StemId parentStem = organ.parent ? stemOf[static_cast<std::size_t>(organ.parent->value)] : StemId();
    tipNode[i] = from;
    stemOf[i] = parentStem;
    if (organ.kind == OrganKind::Leaf)
      clicked.organs.push_back({OrganId(static_cast<std::int32_t>(i)), organ.parent && stalks[static_cast<std::size_t>(organ.parent->value)] ? plant.at(*organ.parent).length : 0,
                                parentStem, from});
    if (organ.kind != OrganKind::Stem || stalks[i] || organ.length < kNegligible) continue;
    if (organ.branch || !parentStem.valid()) {
      stemOf[i] = StemId(static_cast<std::int32_t>(clicked.stems.size()) + 1);
      clicked.stems.push_back({{stemOf[i], {from}}, {}});
    }
    tipNode[i] = addNode(clicked, organ.tip(), organ.radius);
    clicked.stems[static_cast<std::size_t>(stemOf[i].value - 1)].stem.nodes.push_back(tipNode[i]);
  }
  return clicked;
}

double tenth(double px) { return std::round(px * 10) / 10; }

void addView(Clicked& clicked, const std::string& name, const skeleton3d::Camera& camera) {
  document::ProjectView view;
  view.view = {name, camera, kSize};
  view.origin_px = skeleton3d::project(camera, PlantPoint{});
  view.origin_px->px = {tenth(view.origin_px->px.x), tenth(view.origin_px->px.y)};
  clicked.views.push_back(view);
  for (std::size_t i = 0; i < clicked.nodes.size(); ++i) {
    const PhotoPoint p = skeleton3d::project(camera, clicked.places[i]);
    clicked.nodes[i].node.clicks[name] = {{tenth(p.px.x), tenth(p.px.y)}};
  }
}

/// One entry a leaf: first with rough angles, then corrected by how the placed leaf differs from the grown one.
void addLeaves(Clicked& clicked, const Plant& plant, const document::ChainOptions& options) {
  for (const LeafOrgan& organ : clicked.organs) {
    quantify::LeafArrangement a;
    a.stem = organ.stem;
    a.arrangement = "alternate";
    a.at = {organ.node};
    a.angle = 60_deg;
    a.azimuth = a.roll = 0_deg;
    a.length = std::round(plant.at(organ.leaf).length * 1e6) / 1e6;
    a.petiole = std::round(organ.petiole * 1e6) / 1e6;
    a.shape = "ovate";
    clicked.leaves.push_back({a, {}});
  }
  const auto correct = [&](auto&& change) {
    const auto skeleton = document::skeletonOf({projectOf(clicked), {}}, options);
    AXIL_ASSERT(skeleton.has_value(), skeleton.error().message.c_str());
    for (std::size_t i = 0; i < clicked.leaves.size(); ++i)
      change(clicked.leaves[i].arrangement, skeleton->leaves[i], plant.at(clicked.organs[i].leaf));
  };
  const auto rounded = [](Angle angle) { return Angle::fromDegrees(std::round(angle.degrees() * 100) / 100); };
  // The stem's direction at the leaf follows from the placed leaf: it stands 60 degrees from it, on its adaxial side.
  const auto axisOf = [](const skeleton3d::Leaf& leaf, Angle angle) {
    return turned(leaf.direction, PlantDirection::along(glm::cross(leaf.direction.unit(), leaf.normal.unit())), angle);
  };
  correct([&](quantify::LeafArrangement& a, const skeleton3d::Leaf& placed, const Organ& grown) {
    const PlantDirection axis = axisOf(placed, *a.angle);
    a.azimuth = rounded(*a.azimuth + signedAngleAbout(axis, placed.direction, grown.direction));
    a.angle = rounded(angleBetween(axis, grown.direction));
  });
  correct([&](quantify::LeafArrangement& a, const skeleton3d::Leaf& placed, const Organ& grown) {
    a.roll = rounded(*a.roll + signedAngleAbout(placed.direction, placed.normal, grown.adaxial));
  });
}

Result<void> writeJpeg(const std::filesystem::path& path, const render::Image& image) {
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  return writeFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<void> makeSample(const std::filesystem::path& grammarFile, const std::string& description, const std::filesystem::path& folder) {
  const auto grammar = simeco::loadGrammar(grammarFile);
  if (!grammar) return grammar.failure();
  const auto growth = simeco::prepareGrowth(*grammar, {});
  if (!growth) return growth.failure();
  const auto plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  if (!plant) return plant.failure();
  const auto mesh = render::meshOf(*plant, {});
  if (!mesh) return mesh.failure();

  Clicked clicked = click(*plant);
  const render::Bounds bounds = render::boundsOf(*mesh);
  const double distance = 1.9 * std::max({bounds.size().x, bounds.size().y, bounds.size().z});
  for (const char* name : {"front", "right", "top"}) {
    const auto camera = skeleton3d::nominalCamera(name, {.target = {bounds.centre()}, .distance = distance, .focal_px = kFocal_px, .size_px = kSize});
    if (!camera) return camera.failure();
    const auto image = render::drawPlant(*mesh, {.width_px = kSize.x, .height_px = kSize.y, .view = *camera});
    if (!image) return image.failure();
    if (auto written = writeJpeg(folder / (std::string(name) + ".jpg"), *image); !written) return written;
    addView(clicked, name, *camera);
  }
  addLeaves(clicked, *plant, {});
  // The leaves are fitted without looking at the photos; they are named only now.
  for (auto& view : clicked.views) view.photo = view.view.name + ".jpg";
  Project project = projectOf(clicked);
  project.name = folder.filename().string();
  project.description = description;
  return document::saveProject(project, folder / (project.name + ".axil"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: axil_photograph GRAMMAR DESCRIPTION OUT_FOLDER\n", stderr);
    return 2;
  }
  const auto made = makeSample(argv[1], argv[2], argv[3]);
  if (!made) std::fprintf(stderr, "axil_photograph: %s\n", made.error().message.c_str());
  return made ? 0 : 1;
}
