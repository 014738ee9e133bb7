#include "render/plant_skeleton.hpp"

#include "render/known_plants.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <map>

namespace axil::render {
namespace {

using simeco::OrganId;
using simeco::OrganKind;

TEST(PlantSkeleton, HasTheStemsNodesAndLeavesOfAHandMadePlant) {
  test::PlantMaker make;
  const auto stem = make.style(OrganKind::Stem), leaf = make.style(OrganKind::Leaf, "ovate.i");
  const OrganId a = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.01, stem);
  const OrganId point = make.on(a, false, {0, 1, 0}, 1e-9, 0, stem);
  const OrganId b = make.on(point, false, {0, 1, 0}, 0.2, 0.008, stem);
  const OrganId c = make.on(a, true, {1, 0, 0}, 0.1, 0.004, stem);
  make.on(c, false, {1, 0.5, 0}, 0.05, 0.01, leaf);
  static_cast<void>(b);
  const auto skeleton = skeletonOf(make.plant);
  ASSERT_TRUE(skeleton) << skeleton.error().message;
  ASSERT_EQ(skeleton->nodes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(skeleton->nodes[i].id.value, static_cast<int>(i) + 1);
  ASSERT_EQ(skeleton->stems.size(), 2u);
  EXPECT_FALSE(skeleton->stems[0].parent);
  EXPECT_EQ(skeleton->stems[1].parent, skeleton->stems[0].id);
  EXPECT_EQ(skeleton->stems[1].nodes.front(), skeleton->stems[0].nodes[1]);
  EXPECT_NEAR(skeleton->nodes[2].position.at.y, 0.3, 1e-8);
  EXPECT_EQ(skeleton->nodes[1].radius, 0.01);
  ASSERT_EQ(skeleton->leaves.size(), 1u);
  EXPECT_EQ(skeleton->leaves[0].stem, skeleton->stems[1].id);
  EXPECT_EQ(skeleton->leaves[0].shape, "ovate");
  EXPECT_DOUBLE_EQ(skeleton->leaves[0].width, 0.02);
  EXPECT_LT(glm::distance(skeleton->leaves[0].position.at, {0.1, 0.1, 0}), 1e-8);
}

TEST(PlantSkeleton, ABentOrganHasNodesAlongItsTrailAndItsBranchesStartAtItsTip) {
  test::PlantMaker make;
  const auto style = make.style(OrganKind::Stem);
  const OrganId bent = make.first({0, 0, 0}, {0, 1, 0}, 0.3, 0.01, style);
  make.plant.organs[0].trail = {{{0, 0, 0}}, {{0, 0.1, 0}}, {{0.1, 0.1, 0}}, {{0.1, 0.1, 0.1}}};
  make.on(bent, true, {1, 0, 0}, 0.1, 0.004, style);
  make.on(bent, false, {0, 0, 1}, 0.1, 0.01, style);
  const auto skeleton = skeletonOf(make.plant);
  ASSERT_TRUE(skeleton) << skeleton.error().message;
  ASSERT_EQ(skeleton->stems.size(), 2u);
  ASSERT_EQ(skeleton->stems[0].nodes.size(), 5u);
  double length = 0;
  for (std::size_t i = 1; i < 5; ++i) length += glm::distance(skeleton->nodes[i].position.at, skeleton->nodes[i - 1].position.at);
  EXPECT_NEAR(length, 0.4, 1e-12);
  EXPECT_EQ(skeleton->stems[1].nodes.front(), skeleton->stems[0].nodes[3]);
}

TEST(PlantSkeleton, IsOneTreeWhoseParentsComeFirst) {
  const auto skeleton = skeletonOf(test::shrub(2));
  ASSERT_TRUE(skeleton);
  std::map<skeleton3d::NodeId, int> inner;  // how often a node is not the first of a stem: once, the root never
  std::map<skeleton3d::StemId, bool> seen;
  for (const auto& stem : skeleton->stems) {
    ASSERT_GE(stem.nodes.size(), 2u);
    if (stem.parent) { EXPECT_TRUE(seen[*stem.parent]); }
    seen[stem.id] = true;
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) ++inner[stem.nodes[i]];
  }
  EXPECT_EQ(inner.size() + 1, skeleton->nodes.size());
  for (const auto& [node, count] : inner) EXPECT_EQ(count, 1);
}

TEST(PlantSkeleton, APlantThatHasNotGrownGivesNoAnswer) {
  const auto skeleton = skeletonOf(simeco::Plant{});
  ASSERT_FALSE(skeleton);
  EXPECT_EQ(skeleton.error().code, ErrorCode::NoAnswer);
}

TEST(PlantSkeleton, TwoPlantsApartGiveNoAnswer) {
  test::PlantMaker make;
  make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.01, make.style(OrganKind::Stem));
  make.first({1, 0, 0}, {0, 1, 0}, 0.1, 0.01, make.style(OrganKind::Stem));
  EXPECT_FALSE(skeletonOf(make.plant));
}

}  // namespace
}  // namespace axil::render
