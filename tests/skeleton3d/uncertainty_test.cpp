#include "skeleton3d/uncertainty.hpp"

#include "simulated_plants.hpp"
#include "skeleton3d/snap_place.hpp"
#include "skeleton3d/solve.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace axil::skeleton3d {
namespace {

/// How often the truth lies within what 68 % and 95 % of a normal distribution lie within.
struct Coverage {
  double inner = 0, outer = 0, all = 0;

  void add(double error, double sigma) {
    inner += std::abs(error) <= 0.9945 * sigma;
    outer += std::abs(error) <= 1.96 * sigma;
    all += 1;
  }
  void expectTrue(const char* what) const {
    std::printf("%-44s 68 %% intervals hold %.1f %%, 95 %% intervals %.1f %% of %.0f\n", what, 100 * inner / all, 100 * outer / all, all);
    EXPECT_NEAR(inner / all, 0.68, 0.05) << what;
    EXPECT_NEAR(outer / all, 0.95, 0.05) << what;
  }
};

struct Covered {
  Coverage nodes, lengths, angles;

  void expectTrue(const std::string& what) const {
    nodes.expectTrue((what + ", coordinates").c_str());
    lengths.expectTrue((what + ", lengths").c_str());
    angles.expectTrue((what + ", angles").c_str());
  }
};

void addShape(const test::HandheldPlant& plant, const Uncertainty& uncertainty, Covered& covered) {
  const auto at = [&](int i) { return plant.places[static_cast<std::size_t>(i)].at; };
  for (const auto& stem : plant.stems)
    for (std::size_t k = 1; k < stem.size(); ++k) {
      const NodeId a(stem[k - 1]), b(stem[k]);
      if (const auto length = lengthBetween(uncertainty, a, b)) covered.lengths.add(length->value - glm::length(at(stem[k]) - at(stem[k - 1])), length->sigma);
      if (k < 2) continue;
      const NodeId before(stem[k - 2]);
      const glm::dvec3 u = at(stem[k - 1]) - at(stem[k - 2]), v = at(stem[k]) - at(stem[k - 1]);
      const double truth = std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
      const auto angle = angleBetweenSegments(uncertainty, before, a, a, b);
      // Where the angle is of the size of its error it is not normal, as the header says; the test is about the others.
      if (angle && truth > 4 * angle->sigma) covered.angles.add(angle->value - truth, angle->sigma);
    }
}

/// The places as the truth has them, turned about the origin as fits best: the gauge that Uncertainty names.
std::vector<glm::dvec3> turnedToFit(const test::HandheldPlant& plant, const Uncertainty& uncertainty) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto vector = [](const glm::dvec3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (const NodeSpread& node : uncertainty.nodes) sum += vector(node.at.at) * vector(plant.places[static_cast<std::size_t>(node.id.value)].at).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  std::vector<glm::dvec3> places;
  for (const NodeSpread& node : uncertainty.nodes) {
    const Eigen::Vector3d place = turn * vector(plant.places[static_cast<std::size_t>(node.id.value)].at);
    places.push_back({place.x(), place.y(), place.z()});
  }
  return places;
}

void addPlaces(const std::vector<glm::dvec3>& truth, const Uncertainty& uncertainty, Covered& covered) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto sigma = sigmaOf(uncertainty, uncertainty.nodes[i].id);
    ASSERT_TRUE(sigma);
    for (int k = 0; k < 3; ++k) covered.nodes.add(uncertainty.nodes[i].at.at[k] - truth[i][k], (*sigma)[k]);
  }
}

constexpr std::uint64_t kFirstSeed = 1000;

Covered unknownCameras(int plants, const test::HandheldOptions& options) {
  Covered covered;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + static_cast<std::uint64_t>(plants); ++seed) {
    const auto plant = test::handheldPlant(seed, options);
    const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes);
    EXPECT_TRUE(cameras) << "seed " << seed << ": " << cameras.error().message;
    if (!cameras) continue;
    addShape(plant, cameras->uncertainty, covered);
    addPlaces(turnedToFit(plant, cameras->uncertainty), cameras->uncertainty, covered);
  }
  return covered;
}

/// Centre lines as photos would show them beside the clicks: along the stem as it is seen, `sigma_px` off across it.
RidgeReadings linesBeside(const test::HandheldPlant& plant, double sigma_px, Rng& rng) {
  RidgeReadings readings;
  for (const View& view : plant.truth)
    for (const auto& stem : plant.stems)
      for (std::size_t k = 1; k < stem.size(); ++k) {
        const auto& clicks = plant.nodes[static_cast<std::size_t>(stem[k])].clicks;
        const auto click = clicks.find(view.name);
        if (click == clicks.end()) continue;
        const glm::dvec2 here = project(view.camera, plant.places[static_cast<std::size_t>(stem[k])]).px;
        const glm::dvec2 along = glm::normalize(here - project(view.camera, plant.places[static_cast<std::size_t>(stem[k - 1])]).px), across{-along.y, along.x};
        RidgeReading reading;
        reading.along = Angle::fromRadians(std::atan2(along.y, along.x));
        reading.at.px = here + sigma_px * rng.normal() * across + glm::dot(click->second.px - here, along) * along;
        reading.sigmaAcross_px = sigma_px;
        reading.confidence = 0.9;
        readings[view.name][NodeId(stem[k])] = reading;
      }
  return readings;
}

TEST(Uncertainty, CoversTheTruthWhereClicksAreSnapped) {
  std::printf("seeds from %d\n", static_cast<int>(kFirstSeed));
  Covered unknown, known;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 60; ++seed) {
    const auto plant = test::handheldPlant(seed, {.noise_px = 3});
    Rng rng(seed);
    const RidgeReadings lines = linesBeside(plant, 0.3, rng);
    const auto clicked = estimateCameras(plant.views, plant.hints, plant.nodes);
    ASSERT_TRUE(clicked) << "seed " << seed << ": " << clicked.error().message;
    const auto cameras = estimateCameras(plant.views, plant.hints, plant.nodes, {.click_px = clicked->uncertainty.click_px, .centreLines = lines});
    ASSERT_TRUE(cameras) << "seed " << seed << ": " << cameras.error().message;
    addShape(plant, cameras->uncertainty, unknown);
    addPlaces(turnedToFit(plant, cameras->uncertainty), cameras->uncertainty, unknown);
    const auto placed = placeSnapped(plant.truth, plant.nodes, lines, 3);
    ASSERT_TRUE(placed) << placed.error().message;
    for (const SnappedNode& node : *placed)
      for (int k = 0; k < 3; ++k) known.nodes.add(node.at.at[k] - plant.places[static_cast<std::size_t>(node.id.value)].at[k], std::sqrt(node.covariance[k][k]));
  }
  unknown.expectTrue("unknown, snapped");
  known.nodes.expectTrue("known, snapped, coordinates");
}

TEST(Uncertainty, CoversTheTruthWithKnownCameras) {
  std::printf("seeds from %d\n", static_cast<int>(kFirstSeed));
  for (const double noise_px : {0.5, 3.0}) {
    Covered covered;
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 40; ++seed) {
      const auto plant = test::handheldPlant(seed, {.noise_px = noise_px});
      const auto uncertainty = uncertaintyOf(plant.truth, plant.nodes);
      ASSERT_TRUE(uncertainty) << uncertainty.error().message;
      EXPECT_NEAR(uncertainty->click_px, noise_px, 0.3 * noise_px) << "seed " << seed;
      addShape(plant, *uncertainty, covered);
      std::vector<glm::dvec3> truth;
      for (const NodeSpread& node : uncertainty->nodes) truth.push_back(plant.places[static_cast<std::size_t>(node.id.value)].at);
      addPlaces(truth, *uncertainty, covered);
    }
    covered.expectTrue("known, clicks of " + std::to_string(noise_px).substr(0, 3) + " px");
  }
}

TEST(Uncertainty, CoversTheTruthWithUnknownCameras) {
  std::printf("seeds from %d\n", static_cast<int>(kFirstSeed));
  unknownCameras(100, {.noise_px = 0.5}).expectTrue("unknown, focal given, 0.5 px");
  unknownCameras(100, {.noise_px = 3}).expectTrue("unknown, focal given, 3 px");
  unknownCameras(100, {.noise_px = 1, .focalError = 0.02}).expectTrue("unknown, EXIF focal, 1 px");
  unknownCameras(300, {.noise_px = 1, .focalError = 0.02, .nodes = 16}).expectTrue("unknown, EXIF focal, 1 px, 16 nodes");
}

}  // namespace
}  // namespace axil::skeleton3d
