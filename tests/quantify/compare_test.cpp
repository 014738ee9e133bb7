#include "quantify/compare.hpp"

#include "quantify/measure.hpp"
#include "quantify/tree_edit.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

namespace axil::quantify {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

Measurements measured(const Skeleton& skeleton) {
  auto m = measure(skeleton);
  if (!m) throw std::runtime_error(m.error().message);
  return *std::move(m);
}

/// A trunk of `segments` with a branch of two segments at each of `at` (trunk nodes, 1 above the root).
Skeleton trunkWith(int segments, std::initializer_list<int> at, double side = 0.1) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= segments; ++i) points.push_back({0, 0.1 * i, 0});
  Skeleton plant = test::chainThrough(points);
  for (const int node : at) {
    const std::vector<glm::dvec3> branch{{side, 0.1 * node + 0.05, 0}, {2 * side, 0.1 * node + 0.1, 0.02}};
    test::addStem(plant, StemId{1}, NodeId{node + 1}, branch);
  }
  return plant;
}

TEST(ComparePlants, APlantIsItself) {
  Rng rng(81);
  const Measurements m = measured(test::randomTree(rng, {.segments = 60}));
  const auto same = comparePlants(m, m);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->precision, 1);
  EXPECT_EQ(same->recall, 1);
  EXPECT_EQ(same->place.worst, 0);
  EXPECT_EQ(same->length.samples, m.segments.size());
  EXPECT_EQ(same->treeEdit, std::size_t{0});
  for (const double iou : same->silhouettes) EXPECT_EQ(iou, 1);
}

TEST(ComparePlants, WhatIsMissingLowersRecallAndWhatIsTooMuchPrecision) {
  const Measurements full = measured(trunkWith(6, {1, 3, 5}));
  const Measurements less = measured(trunkWith(6, {1, 5}));
  const auto missing = comparePlants(full, less);
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->matched, 11u);
  EXPECT_NEAR(missing->recall, 11.0 / 13, 1e-12);
  EXPECT_EQ(missing->precision, 1);
  EXPECT_EQ(missing->treeEdit, std::size_t{2});
  EXPECT_LT(missing->silhouettes[0], 0.95);
  const auto tooMuch = comparePlants(less, full);
  ASSERT_TRUE(tooMuch);
  EXPECT_EQ(tooMuch->recall, 1);
  EXPECT_NEAR(tooMuch->precision, 11.0 / 13, 1e-12);
}

TEST(ComparePlants, ErrorsAreThoseOfMatchedSegments) {
  const Measurements a = measured(trunkWith(6, {3}));
  Skeleton moved = trunkWith(6, {3});
  moved.nodes.back().position.at += glm::dvec3{0.01, 0, 0};
  const auto c = comparePlants(a, measured(moved));
  ASSERT_TRUE(c);
  EXPECT_EQ(c->recall, 1);
  EXPECT_NEAR(c->place.worst, 0.01, 1e-9);
  const glm::dvec3 before{0.1, 0.05, 0.02};
  const glm::dvec3 after{0.11, 0.05, 0.02};
  EXPECT_NEAR(c->length.worst, glm::length(after) - glm::length(before), 1e-9);
  EXPECT_NEAR(c->angle.worst, std::acos(glm::dot(glm::normalize(before), glm::normalize(after))), 1e-6);
}

TEST(ComparePlants, TheTreeEditDistanceCountsSegments) {
  const auto edit = [](const Skeleton& a, const Skeleton& b) { return treeEditDistance(measured(a), measured(b)); };
  EXPECT_EQ(edit(trunkWith(6, {}), trunkWith(4, {})), 2u);
  EXPECT_EQ(edit(trunkWith(6, {1}), trunkWith(6, {})), 2u);
  EXPECT_EQ(edit(trunkWith(6, {2}), trunkWith(6, {3})), 2u);  // a segment taken out below the branch and put in above it
  EXPECT_EQ(edit(trunkWith(6, {2, 2}), trunkWith(6, {2})), 2u);
  Rng rng(82);
  for (int i = 0; i < 10; ++i) {
    const Skeleton a = test::randomTree(rng, {.segments = 20});
    const Skeleton b = test::randomTree(rng, {.segments = 25});
    const Skeleton c = test::randomTree(rng, {.segments = 15});
    EXPECT_EQ(edit(a, test::shuffled(a, rng)), 0u);
    EXPECT_EQ(edit(a, b), edit(b, a));
    EXPECT_LE(edit(a, c), edit(a, b) + edit(b, c));
    EXPECT_GE(edit(a, b), 5u);
  }
}

TEST(ComparePlants, ASilhouetteKnowsTheView) {
  // Moved along the line of sight of the front view only.
  const Skeleton a = trunkWith(6, {3});
  Skeleton b = a;
  for (auto& node : b.nodes) node.position.at.z += 0.2;
  const auto c = comparePlants(measured(a), measured(b));
  ASSERT_TRUE(c);
  EXPECT_EQ(c->silhouettes[0], 1);
  EXPECT_LT(c->silhouettes[1], 0.1);
  EXPECT_LT(c->silhouettes[2], 0.1);
}

TEST(ComparePlants, RefusesOtherUnitsAndOptionsOutOfRange) {
  const Measurements a = measured(trunkWith(3, {1}));
  Measurements b = a;
  b.unit = "cm";
  EXPECT_FALSE(comparePlants(a, b));
  EXPECT_FALSE(comparePlants(a, a, {.tolerance = 0}));
  EXPECT_FALSE(comparePlants(a, a, {.silhouette_cells = 3}));
  EXPECT_FALSE(compareSets({}, std::span(&a, 1)));
  const auto bounded = comparePlants(a, a, {.mostPairs = 3});
  ASSERT_TRUE(bounded);
  EXPECT_FALSE(bounded->treeEdit);
}

TEST(CompareSets, DistancesAreThoseOfTheDistributions) {
  const auto shifted = distanceOf("x", {1, 2, 3, 4}, {3, 4, 5, 6});
  EXPECT_NEAR(shifted.wasserstein, 2, 1e-12);
  EXPECT_NEAR(shifted.ks, 0.5, 1e-12);
  const std::uint64_t seed = 83;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  int rejected = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<double> a, b;
    for (int k = 0; k < 60; ++k) a.push_back(rng.uniform()), b.push_back(rng.uniform());
    rejected += distanceOf("x", a, b).p < 0.05;
    for (double& x : b) x += 0.4;
    EXPECT_LT(distanceOf("x", a, b).p, 0.01);
  }
  EXPECT_GT(rejected, 1);
  EXPECT_LT(rejected, 22);
}

}  // namespace
}  // namespace axil::quantify
