#include "skeleton3d/estimate.hpp"

#include "random_cameras.hpp"
#include "skeleton3d/tree.hpp"
#include "support/cases.hpp"
#include "support/shared_data.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace axil::skeleton3d {
namespace {

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Alignment {
  double scale = 1;               ///< true size over measured size
  std::vector<double> distances;  ///< after the best similarity
};

Alignment aligned(const std::vector<PlantPoint>& got, const std::vector<PlantPoint>& truth) {
  const auto matrixOf = [](const std::vector<PlantPoint>& points) {
    Eigen::Matrix3Xd m(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) m.col(static_cast<Eigen::Index>(i)) << points[i].at.x, points[i].at.y, points[i].at.z;
    return m;
  };
  const Eigen::Matrix3Xd a = matrixOf(got), b = matrixOf(truth);
  const Eigen::Matrix4d t = Eigen::umeyama(a, b);
  const Eigen::Matrix3Xd left = (t.topLeftCorner<3, 3>() * a).colwise() + t.topRightCorner<3, 1>() - b;
  Alignment alignment{std::cbrt(t.topLeftCorner<3, 3>().determinant()), {}};
  for (Eigen::Index i = 0; i < left.cols(); ++i) alignment.distances.push_back(left.col(i).norm());
  return alignment;
}

std::vector<PlantPoint> places(const std::vector<Node>& nodes) {
  std::vector<PlantPoint> points;
  for (const Node& node : nodes) points.push_back(node.position);
  return points;
}

double difference(const std::vector<Node>& a, const std::vector<PlantPoint>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, glm::length(a[i].position.at - b[i].at));
  return worst;
}

TEST(EstimateCameras, HandheldPhotosGiveTheShapeOfEveryPlant) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  for (const auto& folder : test::plantCaseFolders())
    for (const double noise_px : {0.0, 3.0}) {
      const auto plant = test::readPlantCase(folder, {.cameras = "handheld", .noise_px = noise_px, .every = 4, .known = false});
      const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes);
      ASSERT_TRUE(cameras) << plant.name << ": " << cameras.error().message;
      const auto nodes = solveNodes(cameras->views, plant.nodes);
      ASSERT_TRUE(nodes) << plant.name << ": " << nodes.error().message;
      const Alignment alignment = aligned(places(*nodes), plant.truth);
      const double half = percentile(alignment.distances, 0.5) / plant.height_m, most = percentile(alignment.distances, 0.95) / plant.height_m;
      std::printf("%-20s noise %.0f px: median %.3f %%, p95 %.3f %%, scale %.3f %% off, %zu suspects\n", folder.filename().c_str(), noise_px, 100 * half, 100 * most,
                  100 * (alignment.scale - 1), cameras->suspects.size());
      EXPECT_LE(half, noise_px > 0 ? 0.006 : 0.0005) << plant.name;
      EXPECT_LE(most, noise_px > 0 ? 0.012 : 0.002) << plant.name;
      EXPECT_NEAR(alignment.scale, 1, noise_px > 0 ? 0.05 : 0.003) << plant.name;
    }
}

TEST(EstimateCameras, OrthographicPhotosAreRecognisedWithoutAnyFocalLength) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  for (const auto& folder : test::plantCaseFolders()) {
    auto plant = test::readPlantCase(folder, {.cameras = "ortho", .noise_px = 1, .every = 4, .known = false});
    plant.hints["front"].scale = KnownLength{{{0, 100}}, {{0, 200}}, 0.1};
    const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes);
    ASSERT_TRUE(cameras) << plant.name << ": " << cameras.error().message;
    const auto nodes = solveNodes(cameras->views, plant.nodes);
    ASSERT_TRUE(nodes) << plant.name << ": " << nodes.error().message;
    const Alignment alignment = aligned(places(*nodes), plant.truth);
    std::printf("%-20s ortho: median %.3f %%, p95 %.3f %%, focal %.0f %.0f %.0f\n", folder.filename().c_str(), 100 * percentile(alignment.distances, 0.5) / plant.height_m,
                100 * percentile(alignment.distances, 0.95) / plant.height_m, cameras->reports[0].focal_px, cameras->reports[1].focal_px, cameras->reports[2].focal_px);
    EXPECT_LE(percentile(alignment.distances, 0.5) / plant.height_m, 0.01) << plant.name;
  }
}

TEST(EstimateCameras, AFewWrongClicksAreNamedAndDoNoHarm) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  double named = 0, wrong = 0, falselyNamed = 0, clicks = 0;
  for (const auto& folder : test::plantCaseFolders()) {
    const test::PlantCaseOptions options{.cameras = "handheld", .noise_px = 1, .every = 4, .wrongShare = 0.05, .known = false};
    const auto plant = test::readPlantCase(folder, options);
    auto right = options;
    right.wrongShare = 0;
    const auto clean = test::readPlantCase(folder, right);
    const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes);
    ASSERT_TRUE(cameras) << plant.name << ": " << cameras.error().message;
    for (std::size_t i = 0; i < plant.nodes.size(); ++i)
      for (const auto& [view, click] : plant.nodes[i].clicks) {
        const bool isWrong = glm::length(click.px - clean.nodes[i].clicks.at(view).px) > 15;
        const bool isNamed = std::any_of(cameras->suspects.begin(), cameras->suspects.end(), [&, name = view](const SuspectClick& s) { return s.node == plant.nodes[i].id && s.view == name; });
        clicks += 1;
        wrong += isWrong;
        named += isWrong && isNamed;
        falselyNamed += !isWrong && isNamed;
      }
    const auto nodes = solveNodes(cameras->views, clean.nodes);
    ASSERT_TRUE(nodes) << nodes.error().message;
    EXPECT_LE(percentile(aligned(places(*nodes), clean.truth).distances, 0.5) / plant.height_m, 0.004) << plant.name;
  }
  std::printf("wrong clicks: %.0f of %.0f named; %.0f of %.0f right ones named\n", named, wrong, falselyNamed, clicks - wrong);
  EXPECT_GE(named, 0.9 * wrong);
  EXPECT_LE(falselyNamed, 0.02 * (clicks - wrong));
}

// ---- a plant made here --------------------------------------------------------------------------------------------------

struct Studio {
  std::vector<View> views;  ///< true cameras
  std::vector<View> asked;  ///< unknown ones
  std::map<std::string, UnknownCameraHints> hints;
  std::vector<ClickedNode> nodes;
  std::vector<PlantPoint> truth;
};

/// Thirty nodes in a box of half a metre, seen by three nearly nominal cameras with focal length 2000 px.
Studio studio(std::uint64_t seed, double tilt_deg = 2) {
  Rng rng(seed);
  Studio made;
  for (const char* name : {"front", "right", "top"}) {
    View view{name, *nominalCamera(name, {.target = {{0, 0.25, 0}}, .distance = rng.uniform(1.2, 1.8), .focal_px = 2000}), {1200, 1600}};
    const glm::dmat3 nominal = view.camera.rotation;
    const PlantDirection axis = test::randomDirection(rng);
    for (int c = 0; c < 3; ++c) view.camera.rotation[c] = turned(PlantDirection::along(nominal[c]), axis, Angle::fromDegrees(tilt_deg)).unit();
    made.views.push_back(view);
    View asked = view;
    asked.camera = {};
    asked.camera.focal_px = glm::dvec2{2000, 2000};
    made.asked.push_back(asked);
    UnknownCameraHints hint;
    hint.origin_px = project(view.camera, {{0, 0, 0}});
    hint.scale = KnownLength{project(view.camera, {{-0.1, 0.0, 0.1}}), project(view.camera, {{-0.1, 0.2, 0.12}}), std::hypot(0.2, 0.02)};
    made.hints[name] = hint;
  }
  for (int i = 0; i < 30; ++i) {
    made.truth.push_back({glm::dvec3{0, 0.25, 0} + test::randomVector(rng, 0.25)});
    made.nodes.push_back(test::clicked(made.views, i, made.truth.back()));
  }
  return made;
}

TEST(EstimateCameras, ExactClicksGiveTheTrueShapeAndSize) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Studio s = studio(seed);
    const auto cameras = estimateCameras(s.asked, s.hints, s.nodes);
    ASSERT_TRUE(cameras) << "seed " << seed << ": " << cameras.error().message;
    const auto nodes = solveNodes(cameras->views, s.nodes);
    ASSERT_TRUE(nodes);
    const Alignment alignment = aligned(places(*nodes), s.truth);
    EXPECT_LT(percentile(alignment.distances, 1), 1e-4) << "seed " << seed;
    EXPECT_NEAR(alignment.scale, 1, 1e-3) << "seed " << seed;
    EXPECT_TRUE(cameras->suspects.empty());
    EXPECT_EQ(cameras->views[1].name, "right");
    for (const CameraReport& report : cameras->reports) EXPECT_LT(report.turned.degrees(), 4.5) << report.view;
  }
}

TEST(EstimateCameras, AKnownViewStaysAndHoldsTheFrameForTheOthers) {
  Studio s = studio(3);
  s.asked[0] = s.views[0];
  s.hints.erase("front");
  for (auto& [name, hint] : s.hints) hint.scale.reset();
  const auto cameras = estimateCameras(s.asked, s.hints, s.nodes);
  ASSERT_TRUE(cameras) << cameras.error().message;
  EXPECT_EQ(cameras->views[0], s.views[0]);
  EXPECT_EQ(cameras->reports.size(), 2u);
  const auto nodes = solveNodes(cameras->views, s.nodes);
  ASSERT_TRUE(nodes);
  EXPECT_LT(percentile(aligned(places(*nodes), s.truth).distances, 1), 1e-3);
  EXPECT_LT(difference(*nodes, s.truth), 0.02);
}

TEST(EstimateCameras, ALengthKnownInOneViewIsTakenAtTheOriginsDistance) {
  Studio s = studio(5, 0);
  for (auto& [name, hint] : s.hints) hint.scale.reset();
  s.hints["front"].scale = KnownLength{project(s.views[0].camera, {{0, 0, 0}}), project(s.views[0].camera, {{0.3, 0, 0}}), 0.3};
  const auto cameras = estimateCameras(s.asked, s.hints, s.nodes);
  ASSERT_TRUE(cameras) << cameras.error().message;
  const auto nodes = solveNodes(cameras->views, s.nodes);
  ASSERT_TRUE(nodes);
  EXPECT_NEAR(aligned(places(*nodes), s.truth).scale, 1, 2e-3);
}

TEST(EstimateCameras, OrderOfViewsAndNodesChangesNoBit) {
  Studio s = studio(11);
  const auto first = estimateCameras(s.asked, s.hints, s.nodes);
  std::reverse(s.asked.begin(), s.asked.end());
  std::reverse(s.nodes.begin(), s.nodes.end());
  auto second = estimateCameras(s.asked, s.hints, s.nodes);
  ASSERT_TRUE(first && second);
  std::reverse(second->views.begin(), second->views.end());
  EXPECT_EQ(first->views, second->views);
  EXPECT_EQ(first->reports, second->reports);
}

void expectRefused(const Studio& s, const std::string& part) {
  const auto cameras = estimateCameras(s.asked, s.hints, s.nodes);
  ASSERT_FALSE(cameras) << part;
  EXPECT_NE(cameras.error().message.find(part), std::string::npos) << cameras.error().message;
}

TEST(EstimateCameras, RefusesWhatDeterminesNothing) {
  Studio s = studio(1);
  for (auto& [name, hint] : s.hints) hint.scale.reset();
  expectRefused(s, "no length is known");
  s = studio(1);
  for (auto& [name, hint] : s.hints) hint.origin_px.reset();
  expectRefused(s, "origin is clicked in no view");
  s = studio(1);
  s.hints["front"].scale->length = 0;
  expectRefused(s, "not above zero");
  s = studio(1);
  for (auto& [name, hint] : s.hints) hint.scale->to = hint.scale->from;
  expectRefused(s, "in one place");
  s = studio(1);
  s.asked[0].name = "side";
  expectRefused(s, "node 0 has a click in view 'front', which does not exist");
  for (auto& node : s.nodes) {
    node.clicks["side"] = node.clicks["front"];
    node.clicks.erase("front");
  }
  expectRefused(s, "does not say where it looks");
  s = studio(1);
  s.asked[1].size_px = {0, 0};
  expectRefused(s, "size of its photo is unknown");
  s = studio(1);
  for (std::size_t i = 3; i < s.nodes.size(); ++i) s.nodes[i].clicks.erase("top");
  expectRefused(s, "shares 3 clicked nodes");
}

/// `made` with two views' photos exchanged, clicks and hints included.
Studio exchanged(Studio made, const std::string& a, const std::string& b) {
  for (auto& node : made.nodes) std::swap(node.clicks[a], node.clicks[b]);
  std::swap(made.hints[a], made.hints[b]);
  return made;
}

Studio mirrored(Studio made, const std::string& view) {
  const auto mirror = [](PhotoPoint& p) { p.px.x = 1200 - p.px.x; };
  for (auto& node : made.nodes) mirror(node.clicks[view]);
  mirror(*made.hints[view].origin_px);
  mirror(made.hints[view].scale->from);
  mirror(made.hints[view].scale->to);
  return made;
}

TEST(EstimateCameras, RefusesExchangedOrMirroredViews) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Studio s = studio(seed);
    expectRefused(exchanged(s, "front", "top"), "do not fit together");
    expectRefused(exchanged(s, "right", "top"), "do not fit together");
    expectRefused(exchanged(s, "front", "right"), "do not fit together");
    for (const char* view : {"front", "right", "top"}) expectRefused(mirrored(s, view), "do not fit together");
  }
}

TEST(EstimateCameras, KnownCamerasComeBackAsTheyAre) {
  const Studio s = studio(4);
  const auto cameras = estimateCameras(s.views, {}, s.nodes);
  ASSERT_TRUE(cameras);
  EXPECT_EQ(cameras->views, s.views);
  EXPECT_TRUE(cameras->reports.empty());
}

TEST(WithoutSuspects, DropsWhatIsLikelyWrongAndMovesItWhereTheNodeIsRatherMeant) {
  const Studio s = studio(4);
  const PhotoPoint rather{{10, 20}};
  const std::vector<SuspectClick> suspects{{NodeId(5), "front", 40, 0.3},          {NodeId(5), "right", 50, 0.4}, {NodeId(7), "front", 40, 0.9, rather},
                                           {NodeId(7), "right", 50, 0.95, rather}, {NodeId(6), "front", 40, 0.9}, {NodeId(6), "right", 50, 0.9}};
  const auto kept = withoutSuspects(s.nodes, suspects);
  EXPECT_EQ(kept[5].clicks.size(), 2u) << "none is likely wrong, but one of them is";
  EXPECT_FALSE(kept[5].clicks.contains("right"));
  EXPECT_EQ(kept[6].clicks.size(), 1u) << "two are likely wrong, and nothing says where they were meant";
  ASSERT_EQ(kept[7].clicks.size(), 3u);
  EXPECT_EQ(kept[7].clicks.at("front"), rather);
  EXPECT_EQ(kept[7].clicks.at("top"), s.nodes[7].clicks.at("top"));
  EXPECT_EQ(kept[8].clicks, s.nodes[8].clicks);
}

}  // namespace
}  // namespace axil::skeleton3d
