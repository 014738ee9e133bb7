// A real maize plant: silhouettes from two sides and from above, calibrated cameras, no truth but the silhouettes themselves.

#include "skeleton3d/draft.hpp"
#include "skeleton3d/mask_lines.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve.hpp"
#include "skeleton3d/tree.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace axil::skeleton3d {
namespace {

View viewFrom(const nlohmann::json& camera, const char* name) {
  View view{name, {}, {camera.at("image_size")[0], camera.at("image_size")[1]}};
  view.camera.model = CameraModel::Perspective;
  view.camera.focal_px = glm::dvec2{camera.at("K")[0][0], camera.at("K")[1][1]};
  view.camera.centre_px = {camera.at("K")[0][2], camera.at("K")[1][2]};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) view.camera.rotation[column][row] = camera.at("R")[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  view.camera.translation = {camera.at("t")[0], camera.at("t")[1], camera.at("t")[2]};
  return view;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Distances of a stem's picture from the silhouette's medial lines, a pixel apart.
std::vector<double> offLines(const View& view, const detail::MaskLines& lines, const std::vector<PlantPoint>& points) {
  std::vector<double> off;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 a = project(view.camera, points[i]).px, b = project(view.camera, points[i + 1]).px;
    for (double at = 0; at < glm::length(b - a); at += 1) {
      const glm::dvec2 px = glm::clamp(glm::mix(a, b, at / glm::length(b - a)), glm::dvec2(0.0), glm::dvec2(lines.width - 1, lines.height - 1));
      off.push_back(lines.toLine[static_cast<std::size_t>(px.y) * static_cast<std::size_t>(lines.width) + static_cast<std::size_t>(px.x)]);
    }
  }
  return off;
}

TEST(Maize, StemAndLeavesTracedFromThreeSilhouettesLieOnTheirMedialLines) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/real/maize_plant_1");
  const auto folder = test::sharedPath("data/plants/real/maize_plant_1");
  const auto cameras = nlohmann::json::parse(std::ifstream(folder / "cameras.json")).at("cameras");
  std::vector<View> views;
  std::map<std::string, Mask> masks;
  for (const auto& [file, name] : {std::pair{"side_0", "front"}, std::pair{"side_90", "right"}, std::pair{"top_0", "top"}}) {
    views.push_back(viewFrom(cameras.at(file), name));
    masks[name] = *readMask(folder / (std::string(file) + ".png"));
  }
  const auto stems = draftStems(views, masks);
  ASSERT_TRUE(stems) << stems.error().message;
  const DraftClicks clicks = clicksOf(views, *stems, NodeId(1), StemId(1));
  const auto tree = buildSkeleton(views, clicks.nodes, clicks.stems);
  ASSERT_TRUE(tree) << tree.error().message;
  std::map<NodeId, PlantPoint> places;
  for (const Node& node : tree->nodes) places[node.id] = node.position;
  std::vector<double> all;
  for (const View& view : views) {
    const detail::MaskLines lines = detail::linesOf(masks.at(view.name));
    std::vector<double> here;
    for (const Stem& stem : tree->stems) {
      std::vector<PlantPoint> points;
      for (const NodeId id : stem.nodes) points.push_back(places.at(id));
      const std::vector<double> off = offLines(view, lines, points);
      here.insert(here.end(), off.begin(), off.end());
    }
    std::printf("%s: %.2f px from the medial lines (median)\n", view.name.c_str(), median(here));
    EXPECT_LE(median(here), 3);
    all.insert(all.end(), here.begin(), here.end());
  }
  std::printf("%zu stems and leaves, %.2f px (median over the views)\n", tree->stems.size(), median(all));
  EXPECT_LE(median(all), 3);
  EXPECT_GE(tree->stems.size(), 8u) << "the plant has a stem and more than ten leaves";
}

}  // namespace
}  // namespace axil::skeleton3d
