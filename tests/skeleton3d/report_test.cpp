#include "skeleton3d/report.hpp"

#include "simulated_plants.hpp"
#include "skeleton3d/tree.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <chrono>
#include <cstdlib>
#include <fstream>

namespace axil::skeleton3d {
namespace {

std::vector<ClickedStem> stemsOf(const test::HandheldPlant& plant) {
  std::vector<ClickedStem> stems;
  for (const auto& chain : plant.stems) {
    stems.push_back({StemId(static_cast<int>(stems.size())), {}});
    for (const int node : chain) stems.back().nodes.emplace_back(node);
  }
  return stems;
}

/// Set AXIL_REPORT_PICTURE to a file name to look at the picture.
TEST(ResidualPlot, DrawsEveryClickAndMarksTheSuspects) {
  auto plant = test::handheldPlant(12, {.noise_px = 1, .wrongShare = 0.04});
  plant.nodes.back().clicks.erase("right");
  plant.nodes.back().clicks.erase("top");
  const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes);
  ASSERT_TRUE(cameras) << cameras.error().message;
  const auto kept = withoutSuspects(plant.nodes, cameras->suspects);
  const auto tree = buildSkeleton(cameras->views, kept, stemsOf(plant), {.maxReprojection_px = 1000});
  ASSERT_TRUE(tree) << tree.error().message;
  const auto png = residualPlot(std::nullopt, cameras->views[0], plant.nodes, *tree, cameras->suspects, cameras->uncertainty.click_px);
  ASSERT_TRUE(png) << png.error().message;
  if (const char* file = std::getenv("AXIL_REPORT_PICTURE")) std::ofstream(file, std::ios::binary) << *png;
  const std::vector<std::uint8_t> bytes(png->begin(), png->end());
  const cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR);
  EXPECT_EQ(picture.cols, 1500);
  EXPECT_EQ(picture.rows, 2000);
  const auto colourAt = [&](const SuspectClick& suspect, double away) {
    const glm::dvec2 px = plant.nodes[static_cast<std::size_t>(suspect.node.value)].clicks.at(suspect.view).px;
    return picture.at<cv::Vec3b>(static_cast<int>(px.y), std::min(static_cast<int>(px.x + away), 1499));
  };
  int rings = 0;
  for (const SuspectClick& suspect : cameras->suspects) {
    if (suspect.view != "front") continue;
    ++rings;
    EXPECT_GT(colourAt(suspect, 12)[2], 150) << "a red ring about node " << suspect.node.value;
  }
  EXPECT_GT(rings, 0);
  const std::string text = reportText(cameras->views, cameras->reports, cameras->suspects, cameras->uncertainty, cameras->notes, *tree);
  for (const char* part : {"view front: ", "view right: ", "view top: ", "rms", "turned by", "focal length", "clicks scatter by", "size known to +-", "suspect: node ", "waits: node "})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(ResidualPlot, RefusesWhatItCannotDrawOn) {
  const auto plant = test::handheldPlant(12, {});
  EXPECT_FALSE(residualPlot("no/such/photo.jpg", plant.truth[0], plant.nodes, {}, {}, 1));
  View view = plant.truth[0];
  view.size_px = {0, 0};
  view.camera.centre_px = {0, 0};
  EXPECT_FALSE(residualPlot(std::nullopt, view, plant.nodes, {}, {}, 1));
}

TEST(EstimateCameras, FiveHundredNodesAreQuick) {
  const auto plant = test::handheldPlant(4, {.noise_px = 1, .nodes = 500});
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(estimateCameras(plant.views, plant.hints, plant.nodes));
  std::printf("500 nodes, 3 views: %.1f ms\n", std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace
}  // namespace axil::skeleton3d
