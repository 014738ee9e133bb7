#include "skeleton3d/photographed.hpp"

#include "skeleton3d/known_length.hpp"
#include "skeleton3d/tree.hpp"
#include "support/cases.hpp"
#include "support/shared_data.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <cmath>

namespace axil::skeleton3d {
namespace {

struct Photographs {
  test::PlantCase plant;
  Photos photos;
};

/// One rendered plant in cluttered surroundings, with the ends of its rod as the photos show them.
Photographs photographsOf(const std::filesystem::path& folder, const std::string& kind, const test::PlantCaseOptions& options) {
  Photographs made{test::readPlantCase(folder, options), {}};
  for (const View& view : made.plant.views) {
    auto photo = readPhoto(folder / ("bare_" + options.cameras + "_" + kind + "_" + view.name + ".jpg"));
    EXPECT_TRUE(photo) << photo.error().message;
    if (!photo) continue;
    auto& hints = made.plant.hints[view.name];
    if (hints.scale) {
      const SnappedLength snapped = snapKnownLength(*photo, *hints.scale, view.camera.focal_px ? std::optional(view.camera.focal_px->x) : std::nullopt);
      hints.scale = snapped.scale;
      hints.scaleSigma_px = snapped.sigma_px;
    }
    made.photos[view.name] = *std::move(photo);
  }
  return made;
}

double at(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Fit {
  double scale = 1;
  std::vector<double> off;  ///< percent of the height
};

/// After the best similarity.
Fit fitted(const test::PlantCase& plant, const std::vector<SnappedNode>& nodes) {
  Eigen::Matrix3Xd got(3, static_cast<Eigen::Index>(nodes.size())), want = got;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = std::find_if(plant.nodes.begin(), plant.nodes.end(), [&](const ClickedNode& n) { return n.id == nodes[i].id; });
    const glm::dvec3 here = nodes[i].at.at, truth = plant.truth[static_cast<std::size_t>(node - plant.nodes.begin())].at;
    const auto column = static_cast<Eigen::Index>(i);
    got.col(column) << here.x, here.y, here.z;
    want.col(column) << truth.x, truth.y, truth.z;
  }
  const Eigen::Matrix4d to = Eigen::umeyama(got, want, true);
  const Eigen::Matrix3Xd rest = ((to.topLeftCorner<3, 3>() * got).colwise() + to.topRightCorner<3, 1>()) - want;
  Fit fit{to.topLeftCorner<3, 1>().norm(), {}};
  for (Eigen::Index c = 0; c < rest.cols(); ++c) fit.off.push_back(100 * rest.col(c).norm() / plant.height_m);
  return fit;
}

TEST(Photographed, HandheldPhotosOfUnknownCamerasGiveSizeAndPlaces) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  std::printf("seeds 11 and 12\n");
  const auto folders = test::plantCaseFolders();
  for (const std::size_t which : {std::size_t{0}, std::size_t{6}})
    for (const std::uint64_t seed : {11, 12}) {
      const auto made = photographsOf(folders[which], "clutter", {.cameras = "handheld", .noise_px = 3, .seed = seed, .every = 6, .wrongShare = seed == 12 ? 0.05 : 0.0, .known = false});
      const auto found = measurePhotographed(made.plant.views, made.plant.hints, made.photos, made.plant.nodes, {.stems = made.plant.stems});
      ASSERT_TRUE(found) << found.error().message;
      const Fit fit = fitted(made.plant, found->snapping.nodes);
      std::printf("%s: node error %.3f %% (median), %.3f %% (p95), size off by %.2f %%, said +-%.2f %%\n", made.plant.name.c_str(), at(fit.off, 0.5), at(fit.off, 0.95), 100 * (1 / fit.scale - 1),
                  100 * found->cameras.uncertainty.scaleShare);
      EXPECT_LT(at(fit.off, 0.5), 0.4);
      EXPECT_LT(at(fit.off, 0.95), 1.2);
      EXPECT_NEAR(fit.scale, 1, 0.01);
      EXPECT_LT(found->cameras.uncertainty.scaleShare, 0.01);
    }
}

TEST(Photographed, LinesFindCamerasBetterThanClicks) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  const auto made = photographsOf(test::plantCaseFolders()[0], "clutter", {.cameras = "handheld", .noise_px = 3, .seed = 13, .every = 6, .known = false});
  const auto byClicks = estimateCameras(made.plant.views, made.plant.hints, made.plant.nodes);
  const auto byLines = measurePhotographed(made.plant.views, made.plant.hints, made.photos, made.plant.nodes, {.stems = made.plant.stems});
  ASSERT_TRUE(byClicks && byLines);
  const auto clicked = placeSnapped(byClicks->views, made.plant.nodes, byLines->snapping.readings, 3);
  ASSERT_TRUE(clicked);
  EXPECT_LT(at(fitted(made.plant, byLines->snapping.nodes).off, 0.5), at(fitted(made.plant, *clicked).off, 0.5));
}

TEST(Photographed, AWrongClickInKnownCamerasIsNamedAndLeftOut) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  auto made = photographsOf(test::plantCaseFolders()[0], "plain", {.cameras = "persp", .noise_px = 1, .seed = 14, .every = 6});
  ClickedNode& wrong = made.plant.nodes[5];
  const glm::dvec3 truth = made.plant.truth[5].at;
  wrong.clicks.at("right").px += glm::dvec2{60, -35};
  const auto found = measurePhotographed(made.plant.views, {}, made.photos, made.plant.nodes, {.stems = made.plant.stems});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_FALSE(found->cameras.suspects.empty());
  EXPECT_EQ(found->cameras.suspects.front().node, wrong.id);
  EXPECT_EQ(found->cameras.suspects.front().view, "right");
  for (const SnappedNode& node : found->snapping.nodes) {
    if (node.id != wrong.id) continue;
    EXPECT_LT(glm::length(node.at.at - truth), 0.005 * made.plant.height_m);
  }
}

TEST(Photographed, TwoWrongClicksThatAgreeAreToldByTheStemAndThePhotosAndTheNodeKeepsAPlace) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  std::printf("seed 14\n");
  auto made = photographsOf(test::plantCaseFolders()[0], "plain", {.cameras = "persp", .noise_px = 1, .seed = 14, .every = 6});
  ClickedNode& wrong = made.plant.nodes[5];
  wrong.clicks.at("front").px += glm::dvec2{50, -45};
  wrong.clicks.at("right").px += glm::dvec2{-40, -45};
  const auto found = measurePhotographed(made.plant.views, {}, made.photos, made.plant.nodes, {.stems = made.plant.stems});
  ASSERT_TRUE(found) << found.error().message;
  std::set<std::string> named;
  for (const SuspectClick& suspect : found->cameras.suspects)
    if (suspect.node == wrong.id && suspect.chance > 0.5) named.insert(suspect.view);
  EXPECT_EQ(named, (std::set<std::string>{"front", "right"}));
  const auto node = std::find_if(found->snapping.nodes.begin(), found->snapping.nodes.end(), [&](const SnappedNode& n) { return n.id == wrong.id; });
  ASSERT_NE(node, found->snapping.nodes.end());
  EXPECT_LT(glm::length(node->at.at - made.plant.truth[5].at), 0.02 * made.plant.height_m);
}

TEST(Photographed, AStemWhoseEndOnViewShowsNothingKeepsItsWidthAndPlace) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  std::printf("seed 23\n");
  const auto made = photographsOf(test::plantCaseFolders()[5], "plain", {.cameras = "ortho", .noise_px = 3, .seed = 23, .every = 1});  // a young maize, its stem 50 px wide
  const auto snapping = snapNodes(made.plant.views, made.photos, made.plant.nodes, made.plant.stems);
  ASSERT_TRUE(snapping) << snapping.error().message;
  std::size_t measured = 0;
  const std::vector<NodeId>& stem = made.plant.stems.front().nodes;
  for (const SnappedNode& node : snapping->nodes)
    if (std::find(stem.begin(), stem.end(), node.id) != stem.end() && node.radius) {
      EXPECT_NEAR(*node.radius, 0.0046, 0.0009) << node.id.value;
      ++measured;
    }
  EXPECT_GT(measured, stem.size() / 2);
}

TEST(Photographed, PhotosOfOneGreyKeepEveryClickAsItIs) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  auto made = photographsOf(test::plantCaseFolders()[0], "plain", {.cameras = "persp", .noise_px = 1, .seed = 15, .every = 6});
  for (auto& [view, photo] : made.photos) std::fill(photo.rgb.begin(), photo.rgb.end(), std::uint8_t{128});
  const auto found = measurePhotographed(made.plant.views, {}, made.photos, made.plant.nodes, {.stems = made.plant.stems});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FALSE(found->snapping.nodes.empty());
  for (const SnappedNode& node : found->snapping.nodes) EXPECT_TRUE(node.snappedIn.empty()) << node.id.value;
}

TEST(Photographed, ViewsReadTheWrongWayAreNamedInKnownCamerasToo) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  const auto made = test::readPlantCase(test::plantCaseFolders()[0], {.cameras = "persp", .noise_px = 2, .seed = 16, .every = 6});
  auto exchanged = made.nodes, mirrored = made.nodes;
  for (ClickedNode& node : exchanged)
    if (node.clicks.contains("front") && node.clicks.contains("right")) std::swap(node.clicks.at("front"), node.clicks.at("right"));
  for (ClickedNode& node : mirrored)
    if (const auto click = node.clicks.find("right"); click != node.clicks.end()) click->second.px.x = 1200 - click->second.px.x;
  const auto first = estimateCameras(made.views, {}, exchanged), second = estimateCameras(made.views, {}, mirrored);
  ASSERT_FALSE(first);
  EXPECT_NE(first.error().message.find("'front' and 'right' are exchanged"), std::string::npos) << first.error().message;
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("'right' is mirrored"), std::string::npos) << second.error().message;
}

}  // namespace
}  // namespace axil::skeleton3d
