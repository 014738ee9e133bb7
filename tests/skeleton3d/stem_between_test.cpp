#include "skeleton3d/stem_between.hpp"

#include "drawn_stems.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/guide_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

using test::drawnPhoto;
using test::DrawnStem;

/// A stem bent to two sides of space, and others beside it that the epipolar lines of its places cross as well.
std::vector<std::vector<glm::dvec3>> stems() {
  std::vector<std::vector<glm::dvec3>> made(4);
  for (int k = 0; k <= 40; ++k) {
    const double t = k / 40.0;
    made[0].push_back({0.25 * std::sin(2.5 * t), t, 0.2 * std::cos(3 * t) - 0.2});
  }
  made[1] = {{0, 0.05, 0.3}, {-0.1, 0.95, 0.38}};
  made[2] = {{-0.3, 0.1, -0.25}, {-0.35, 0.9, -0.4}};
  made[3] = {{0.05, 0.5, -0.1}, {0.35, 0.6, 0.3}};
  return made;
}

View viewOf(const char* name) {
  return {name, *nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 1300, .size_px = {520, 640}}), {520, 640}};
}

Photo photoOf(const View& view, const std::vector<std::vector<glm::dvec3>>& plant, double widestOf) {
  std::vector<DrawnStem> drawn;
  for (std::size_t s = 0; s < plant.size(); ++s) {
    DrawnStem stem{{}, s == 0 ? widestOf : 1.7 * widestOf, {60, 110, 40}};
    for (const glm::dvec3& p : plant[s]) stem.points.push_back(project(view.camera, {p}).px);
    drawn.push_back(std::move(stem));
  }
  return drawnPhoto({520, 640}, {206, 204, 200}, drawn, 3, 4);
}

double furthest(const StemBetween& stem, const std::vector<glm::dvec3>& truth) {
  double most = 0;
  for (const StemPlace& place : stem.line) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
      const glm::dvec3 d = truth[i + 1] - truth[i];
      const double f = std::clamp(glm::dot(place.at.at - truth[i], d) / glm::dot(d, d), 0.0, 1.0);
      least = std::min(least, glm::length(truth[i] + f * d - place.at.at));
    }
    most = std::max(most, least);
  }
  return most;
}

struct Scene {
  View front = viewOf("front"), right = viewOf("right");
  std::vector<std::vector<glm::dvec3>> plant = stems();
  LiveWire frontWire = *prepareLiveWire(std::make_shared<const Photo>(photoOf(front, plant, 5)));
  LiveWire rightWire = *prepareLiveWire(std::make_shared<const Photo>(photoOf(right, plant, 5)));
  WirePath path = *wireBetween(frontWire, project(front.camera, {plant[0].front()}), project(front.camera, {plant[0].back()}));
  Reach reach{{{0, 0.5, 0}}, 0.8};
};

/// Made once: drawing and preparing photos takes the time of these tests.
const Scene& bentScene() {
  static const Scene scene;
  return scene;
}

TEST(StemBetween, ABentStemTracedInOneViewIsFoundInAnotherWithItsDepths) {
  const Scene& scene = bentScene();
  const auto two = tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, scene.reach, {.base = PlantPoint{scene.plant[0].front()}});
  ASSERT_TRUE(two) << two.error().message;
  const auto three = tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, scene.reach, {.endInOther = project(scene.right.camera, {scene.plant[0].back()})});
  ASSERT_TRUE(three) << three.error().message;
  std::printf("two clicks and a placed base: %zu nodes, %.4f off at most, confidence %.2f; three: %zu nodes, %.4f, %.2f\n", two->nodes.size(), furthest(*two, scene.plant[0]), two->confidence,
              three->nodes.size(), furthest(*three, scene.plant[0]), three->confidence);
  EXPECT_LT(furthest(*two, scene.plant[0]), 0.01);
  EXPECT_LT(furthest(*three, scene.plant[0]), 0.01);
  EXPECT_GT(three->confidence, 0.3);
  EXPECT_LT(three->nodes.size(), 25u);
  for (const StemPlace& node : three->nodes) {
    EXPECT_LT(glm::length(project(scene.front.camera, node.at).px - node.inFirst.px), 2);
    EXPECT_LT(glm::length(project(scene.right.camera, node.at).px - node.inOther.px), 2);
  }
}

TEST(StemBetween, AThirdClickDecidesWhichOfTwoStemsIsMeant) {
  // Both are straight and alike in the front view's rows; only the click in the other view tells them apart.
  Scene scene = bentScene();
  scene.plant = {{{0, 0.1, 0.2}, {0.05, 0.9, 0.2}}, {{-0.2, 0.1, -0.2}, {-0.2, 0.9, -0.25}}};
  scene.frontWire = *prepareLiveWire(std::make_shared<const Photo>(photoOf(scene.front, scene.plant, 4)));
  scene.rightWire = *prepareLiveWire(std::make_shared<const Photo>(photoOf(scene.right, {scene.plant[1], scene.plant[0]}, 4)));
  scene.path = *wireBetween(scene.frontWire, project(scene.front.camera, {scene.plant[0][0]}), project(scene.front.camera, {scene.plant[0][1]}));
  const auto meant = tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, scene.reach, {.endInOther = project(scene.right.camera, {scene.plant[0][1]})});
  const auto other = tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, scene.reach, {.endInOther = project(scene.right.camera, {scene.plant[1][1]})});
  ASSERT_TRUE(meant && other);
  EXPECT_LT(furthest(*meant, scene.plant[0]), 0.01);
  EXPECT_GT(furthest(*other, scene.plant[0]), 0.2);
}

TEST(GuideCandidates, AClickInOnePhotoGivesTheSamePointInTheOtherAmongTheFirst) {
  const Scene& scene = bentScene();
  int first = 0, among = 0, asked = 0;
  for (std::size_t k = 4; k <= 36; k += 4, ++asked) {
    const glm::dvec3 truth = scene.plant[0][k], before = scene.plant[0][k - 4];
    const auto places = proposedPlaces(scene.front, project(scene.front.camera, {truth}), scene.right, scene.rightWire, scene.reach,
                                       {.width = 5.0 * 3 / 1300, .before = PlantPoint{before}, .length = glm::length(truth - before), .direction = PlantDirection::along(truth - before)});
    ASSERT_TRUE(places) << places.error().message;
    const glm::dvec2 there = project(scene.right.camera, {truth}).px;
    const auto near = [&](const ProposedPlace& p) { return glm::length(p.candidate.at.px - there) < 2; };
    first += !places->empty() && near(places->front());
    among += std::any_of(places->begin(), places->end(), near);
  }
  std::printf("of %d places %d are among the candidates, %d the likeliest one\n", asked, among, first);
  EXPECT_GE(among, asked - 1);
  EXPECT_GE(first, asked - 2);
}

TEST(StemBetween, WhereTheOtherPhotoShowsNoStemItIsNotSure) {
  Scene scene = bentScene();
  scene.rightWire = *prepareLiveWire(std::make_shared<const Photo>(photoOf(scene.right, {}, 5)));
  const auto stem = tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, scene.reach);
  ASSERT_TRUE(stem);
  EXPECT_LT(stem->confidence, 0.1);
  for (const StemPlace& place : stem->line) EXPECT_TRUE(std::isfinite(place.at.at.x + place.at.at.y + place.at.at.z + place.inOther.px.x));
}

TEST(StemBetween, UnknownCamerasAndWaysOfNoLengthAreRefused) {
  const Scene& scene = bentScene();
  View unknown = scene.right;
  unknown.camera.model = CameraModel::Unknown;
  EXPECT_FALSE(tracedInOtherView(scene.front, scene.path, unknown, scene.rightWire, scene.reach));
  EXPECT_FALSE(tracedInOtherView(scene.front, WirePath{}, scene.right, scene.rightWire, scene.reach));
  EXPECT_FALSE(tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, {{}, 0}));
  EXPECT_FALSE(tracedInOtherView(scene.front, scene.path, scene.right, scene.rightWire, {{{50, 50, 50}}, 0.5})) << "the reach is nowhere in the picture";
}

}  // namespace
}  // namespace axil::skeleton3d
