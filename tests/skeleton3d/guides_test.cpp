#include "skeleton3d/guides.hpp"

#include "random_cameras.hpp"
#include "simulated_plants.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace axil::skeleton3d {
namespace {

double offFrom(const Guide& guide, PhotoPoint at, double* sigma) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < guide.curve.size(); ++i) {
    const glm::dvec2 a = guide.curve[i].at.px, along = guide.curve[i + 1].at.px - a;
    const double t = std::clamp(glm::dot(at.px - a, along) / glm::dot(along, along), 0.0, 1.0), off = glm::length(at.px - a - t * along);
    if (off < least) *sigma = guide.curve[i].sigma_px;
    least = std::min(least, off);
  }
  return least;
}

TEST(GuideBetween, HoldsTheSamePointWhateverTheLens) {
  std::printf("seeds 1 to 60\n");
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const auto views = test::randomViews(rng, 2);
    const PlantPoint point{test::randomVector(rng, 0.5)};
    const auto guide = guideBetween(views[0], project(views[0].camera, point), views[1], {{}, 1.2}, 1);
    ASSERT_TRUE(guide) << guide.error().message;
    double sigma = 0;
    EXPECT_LT(offFrom(*guide, project(views[1].camera, point), &sigma), 0.2) << "seed " << seed;
  }
}

TEST(GuideBetween, ItsBandIsAsWideAsTheClicksScatter) {
  double inner = 0, outer = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Rng rng(seed);
    const auto plant = test::handheldPlant(1 + seed % 10, {});
    const PlantPoint point = plant.places[seed % plant.places.size()];
    PhotoPoint click = project(plant.truth[0].camera, point), there = project(plant.truth[1].camera, point);
    click.px += 2.0 * glm::dvec2{rng.normal(), rng.normal()};
    there.px += 1.0 * glm::dvec2{rng.normal(), rng.normal()};
    const auto guide = guideBetween(plant.truth[0], click, plant.truth[1], reachOf(plant.places, 1), 2, 1);
    ASSERT_TRUE(guide) << guide.error().message;
    double sigma = 0;
    const double off = offFrom(*guide, there, &sigma);
    inner += off <= sigma;
    outer += off <= 1.96 * sigma;
    all += 1;
  }
  std::printf("guides: 68 %% band holds %.1f %%, 95 %% band %.1f %% of %.0f\n", 100 * inner / all, 100 * outer / all, all);
  EXPECT_NEAR(inner / all, 0.68, 0.06);
  EXPECT_NEAR(outer / all, 0.95, 0.03);
}

TEST(RankCandidates, PrefersWhatLiesOnTheGuideHasTheWidthAndGoesOnStraight) {
  const auto plant = test::handheldPlant(3, {});
  const View &front = plant.truth[0], &right = plant.truth[1];
  const PlantPoint before = plant.places[3], point = plant.places[4];
  const PhotoPoint click = project(front.camera, point);
  const auto guide = guideBetween(front, click, right, reachOf(plant.places, 1), 1, 0.5);
  ASSERT_TRUE(guide);
  const double width = 0.004, px = width * right.camera.focal_px->x / toView(right.camera, point).at.z;
  const PhotoPoint at = project(right.camera, point);
  const auto& far = guide->curve.front();
  const std::vector<GuideCandidate> candidates{
      {far.at, px, std::nullopt, 1},                         // on the guide, but far from its neighbour
      {at, px, std::nullopt, 1},                             // the right one
      {at, 3 * px, std::nullopt, 1},                         // three times as thick
      {{at.px + glm::dvec2{0, 300}}, px, std::nullopt, 1},   // far from the guide
      {{{std::nan(""), 0}}, px, std::nullopt, 1},
  };
  const GuideExpectation expected{.width = width, .before = before, .length = glm::length(point.at - before.at), .direction = PlantDirection::along(point.at - before.at)};
  const auto ranked = rankCandidates(front, click, right, *guide, candidates, expected);
  ASSERT_EQ(ranked.size(), 3u);
  EXPECT_EQ(ranked[0].candidate, 1u);
  EXPECT_GT(ranked[0].probability, 0.8);
  EXPECT_LT(glm::length(ranked[0].place.at - point.at), 1e-6);
}

TEST(GuideBetween, SaysWhyThereIsNone) {
  const auto plant = test::handheldPlant(3, {});
  const auto past = guideBetween(plant.truth[0], {{1, 1}}, plant.truth[1], {{}, 1e-3}, 1);
  ASSERT_FALSE(past);
  EXPECT_NE(past.error().message.find("points past the plant"), std::string::npos);
  const auto unknown = guideBetween(plant.views[0], {{1, 1}}, plant.truth[1], {{}, 1}, 1);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("'front' is unknown"), std::string::npos) << unknown.error().message;
  EXPECT_FALSE(guideBetween(plant.truth[0], {{std::nan(""), 1}}, plant.truth[1], {{}, 1}, 1));
}

}  // namespace
}  // namespace axil::skeleton3d
