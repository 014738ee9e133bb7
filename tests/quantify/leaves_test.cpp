#include "quantify/leaves.hpp"

#include "base/turning.hpp"
#include "quantify/measure.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::quantify {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

Skeleton post() {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.4, 0}, {0, 1, 0}};
  return test::chainThrough(points);
}

LeafArrangement onStem(const char* arrangement, int nodes) {
  LeafArrangement wanted;
  wanted.stem = StemId{1};
  wanted.arrangement = arrangement;
  wanted.nodes = nodes;
  return wanted;
}

Skeleton leafy(const Skeleton& skeleton, const LeafArrangement& wanted, const keywords::Presets& presets = {}) {
  auto result = withLeaves(skeleton, std::span(&wanted, 1), presets);
  EXPECT_TRUE(result) << result.error().message;
  return result ? std::move(*result) : Skeleton{};
}

std::string refusal(const LeafArrangement& wanted) {
  const auto result = withLeaves(post(), std::span(&wanted, 1));
  return result ? "" : result.error().message;
}

TEST(Leaves, StandEvenlyAlongTheStemOnOldAndNewNodes) {
  const Skeleton plant = leafy(post(), onStem("alternate", 5));
  ASSERT_EQ(plant.leaves.size(), 5u);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(plant.leaves[static_cast<std::size_t>(k)].position.at.y, 0.2 * (k + 1), 1e-12);
  // The node at 0.4 is used, three are new, and the chain stays in order.
  EXPECT_EQ(plant.nodes.size(), 6u);
  EXPECT_TRUE(measure(plant));
  EXPECT_EQ(plant.stems[0].nodes, (std::vector<NodeId>{NodeId{1}, NodeId{6}, NodeId{2}, NodeId{5}, NodeId{4}, NodeId{3}}));
}

TEST(Leaves, OfACycleTurnByItsTurnsOneAfterAnother) {
  const Skeleton plant = leafy(post(), onStem("orixate", 6));
  const std::vector<double> turns{180, 90, 180, 270, 180};
  ASSERT_EQ(plant.leaves.size(), 6u);
  const auto azimuth = [&](std::size_t k) { return std::atan2(plant.leaves[k].direction.unit().z, plant.leaves[k].direction.unit().x) * 180 / std::numbers::pi; };
  // Turning about +Y runs from +Z to +X, against atan2(z, x).
  for (std::size_t k = 0; k < turns.size(); ++k) EXPECT_NEAR(std::remainder(azimuth(k) - azimuth(k + 1) - turns[k], 360), 0, 1e-6) << k;
}

TEST(Leaves, SnapToANodeWithinTwoPercentAndInterpolateElsewhere) {
  Skeleton stem = post();
  stem.nodes[1].position.at.y = 0.515;
  stem.nodes[0].radius = 0.02;
  stem.nodes[1].radius = 0.01;
  EXPECT_EQ(leafy(stem, onStem("alternate", 2)).nodes.size(), 3u);
  stem.nodes[1].position.at.y = 0.525;
  const Skeleton apart = leafy(stem, onStem("alternate", 2));
  ASSERT_EQ(apart.nodes.size(), 4u);
  EXPECT_NEAR(apart.nodes[3].position.at.y, 0.5, 1e-12);
  EXPECT_NEAR(*apart.nodes[3].radius, 0.02 - 0.01 * 0.5 / 0.525, 1e-12);
}

TEST(Leaves, DecussatePairsCrossAtEveryNode) {
  const Skeleton plant = leafy(post(), onStem("decussate", 3));
  ASSERT_EQ(plant.leaves.size(), 6u);
  const auto side = [&](std::size_t l) { return perpendicularTo(PlantDirection::up(), plant.leaves[l].direction); };
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(angleBetween(side(2 * k), side(2 * k + 1)).degrees(), 180, 1e-9);
  EXPECT_NEAR(angleBetween(side(0), side(2)).degrees(), 90, 1e-9);
  EXPECT_NEAR(angleBetween(side(2), side(4)).degrees(), 90, 1e-9);
}

TEST(Leaves, LeaveTheStemAtTheirAngleAndShowTheirUpperSideToItsTip) {
  LeafArrangement wanted = onStem("spiral", 4);
  wanted.angle = 70_deg;
  wanted.petiole = 0.02;
  wanted.azimuth = 30_deg;
  const Skeleton plant = leafy(post(), wanted);
  const auto m = measure(plant);
  ASSERT_TRUE(m);
  for (const Segment& s : m->segments)
    for (const LeafMeasure& leaf : s.leaves) {
      EXPECT_NEAR(leaf.rotr.degrees(), 70, 1e-9);
      EXPECT_NEAR(leaf.roll.radians(), 0, 1e-9);
      EXPECT_NEAR(leaf.petiole, 0.02, 1e-12);
    }
  EXPECT_NEAR(m->segments[0].leaves.at(0).rotu.degrees(), 30, 1e-9);
}

TEST(Leaves, RollTurnsTheBladeAboutItself) {
  LeafArrangement wanted = onStem("alternate", 2);
  wanted.roll = 25_deg;
  const auto m = measure(leafy(post(), wanted));
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->segments.back().leaves.at(0).roll.degrees(), 25, 1e-9);
}

TEST(Leaves, ARosetteStandsAtTheCollar) {
  const Skeleton plant = leafy(post(), onStem("rosette", 6));
  ASSERT_GE(plant.leaves.size(), 6u);
  for (const auto& leaf : plant.leaves) EXPECT_EQ(leaf.position.at, (glm::dvec3{0, 0, 0}));
  const auto m = measure(plant);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->rootLeaves.size(), plant.leaves.size());
}

TEST(Leaves, FillInWhatTheDescriptionSays) {
  keywords::Presets presets;
  presets.arrangement = keywords::ArrangementPreset{"opposite", 2, 90_deg, false};
  presets.leafShape = "ovate";
  presets.leafLength_m = 0.05;
  presets.leafWidth_m = 0.03;
  Skeleton stem = post();
  stem.unit = "cm";
  const Skeleton plant = leafy(stem, onStem("", 1), presets);
  ASSERT_EQ(plant.leaves.size(), 2u);
  EXPECT_NEAR(plant.leaves[0].length, 5, 1e-12);
  EXPECT_NEAR(plant.leaves[0].width, 3, 1e-12);
  EXPECT_EQ(plant.leaves[0].shape, "ovate");
}

TEST(Leaves, StandOnTheNodesThatAreListed) {
  LeafArrangement wanted = onStem("alternate", 1);
  wanted.nodes.reset();
  wanted.at = {NodeId{3}, NodeId{2}};
  const Skeleton plant = leafy(post(), wanted);
  ASSERT_EQ(plant.leaves.size(), 2u);
  EXPECT_NEAR(plant.leaves[0].position.at.y, 0.4, 1e-15);
  EXPECT_NEAR(plant.leaves[1].position.at.y, 1.0, 1e-15);
  EXPECT_EQ(plant.nodes.size(), 3u);
}

TEST(Leaves, RegrowOnBentStemsOfRandomTrees) {
  const std::uint64_t seed = 31;
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 200; ++i) {
    const Skeleton tree = test::randomTree(rng, {.leaves = 0});
    LeafArrangement wanted = onStem("spiral", 1 + static_cast<int>(rng.below(60)));
    wanted.petiole = rng.uniform() < 0.5 ? 0.0 : 0.01;
    const Skeleton plant = leafy(tree, wanted);
    const auto m = measure(plant);
    ASSERT_TRUE(m) << m.error().message;
    for (const Segment& s : m->segments)
      for (const LeafMeasure& leaf : s.leaves) ASSERT_NEAR(leaf.rotr.degrees(), 55, 1e-6);
  }
}

TEST(Leaves, RefuseWhatCannotBe) {
  LeafArrangement wanted = onStem("alternate", 3);
  wanted.stem = StemId{7};
  EXPECT_NE(refusal(wanted).find("stem 7, which does not exist"), std::string::npos);
  EXPECT_NE(refusal(onStem("zigzag", 3)).find("decussate"), std::string::npos) << refusal(onStem("zigzag", 3));
  EXPECT_NE(refusal(onStem("alternate", 0)).find("0 leaf nodes"), std::string::npos);
  wanted = onStem("alternate", 3);
  wanted.nodes.reset();
  EXPECT_NE(refusal(wanted).find("how many"), std::string::npos);
  wanted.at = {NodeId{9}};
  EXPECT_NE(refusal(wanted).find("node 9"), std::string::npos);
  wanted.at = {NodeId{2}};
  wanted.nodes = 2;
  EXPECT_NE(refusal(wanted).find("give one of the two"), std::string::npos);
  wanted = onStem("alternate", 3);
  wanted.angle = Angle::fromRadians(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(refusal(wanted).find("angle"), std::string::npos);
  wanted.angle = 200_deg;
  EXPECT_NE(refusal(wanted).find("between 0 and 180"), std::string::npos);
  wanted = onStem("alternate", 3);
  wanted.length = 0;
  EXPECT_NE(refusal(wanted).find("above 0"), std::string::npos);
}

}  // namespace
}  // namespace axil::quantify
