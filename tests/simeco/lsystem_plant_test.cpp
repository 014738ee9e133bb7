#include "simeco/lsystem_plant.hpp"

#include "simeco/lsystem_language.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace axil::simeco {
namespace {

Result<Plant> plantOf(const std::string& rest, const std::string& view = "line style: cylinder\n", DeriveOptions derive = {}) {
  const Parsed parsed = parseLSystem("Lsystem: tree\n" + rest + "endlsystem\n");
  EXPECT_TRUE(parsed.ok()) << parsed.diagnostics.front().message;
  return plantOfLSystem(parsed.grammar, {.derive = {.derive = std::move(derive), .view = parseLSystemView(view).view}});
}

TEST(LSystemPlant, SegmentsAreStemsThatKnowTheirParents) {
  const auto plant = plantOf("derivation length: 1\nAxiom: !(2)A\nA --> F(3)[+(90)!(1)F]F\n");
  ASSERT_TRUE(plant) << plant.error().message;
  ASSERT_EQ(plant->organs.size(), 3u);
  const Organ& trunk = plant->organs[0];
  EXPECT_EQ(trunk.kind, OrganKind::Stem);
  EXPECT_DOUBLE_EQ(trunk.length, 3);
  EXPECT_DOUBLE_EQ(trunk.radius, 1);
  EXPECT_EQ(trunk.tipRadius, trunk.radius);
  EXPECT_EQ(plant->organs[1].parent, OrganId(0));
  EXPECT_TRUE(plant->organs[1].branch);
  EXPECT_EQ(plant->organs[1].direction, PlantDirection::along({-1, 0, 0}));
  EXPECT_EQ(plant->organs[2].parent, OrganId(0));
  EXPECT_FALSE(plant->organs[2].branch);
  EXPECT_EQ(plant->name, "tree");
  EXPECT_EQ(plant->time, 1);
  for (const Organ& organ : plant->organs) {
    EXPECT_NEAR(glm::dot(organ.direction.unit(), organ.rAxis.unit()), 0, 1e-12);
    EXPECT_NEAR(glm::dot(organ.direction.unit(), organ.adaxial.unit()), 0, 1e-12);
  }
}

TEST(LSystemPlant, TaperedSegmentsKnowBothRadii) {
  const auto plant = plantOf("Axiom: !(4)F!(2)F\n");
  ASSERT_TRUE(plant);
  EXPECT_DOUBLE_EQ(plant->organs[0].radius, 2);
  EXPECT_EQ(plant->organs[0].tipRadius, 1.0);
}

TEST(LSystemPlant, PixelWidthsFollowTheSizeOfThePlant) {
  const auto plant = plantOf("Axiom: !(3)F(1200)\n", "");
  ASSERT_TRUE(plant);
  EXPECT_DOUBLE_EQ(plant->organs[0].radius, 3);
}

TEST(LSystemPlant, EverythingDrawnKnowsItsModuleAndItsRule) {
  DeriveOptions traced;
  traced.traced = true;
  const auto plant = plantOf("derivation length: 2\nAxiom: FX\nX --> [Y]F\nF --> F\nhomomorphism\nmaximum depth: 2\nY --> {.f.+f.}@O(2)@c(2)~l(3)\nX --> F\n", "", traced);
  ASSERT_TRUE(plant) << plant.error().message;
  ASSERT_EQ(plant->faces.size(), 1u);
  EXPECT_EQ(plant->faces[0].vertices.size(), 3u) << "a point that is recorded twice is one vertex";
  ASSERT_EQ(plant->balls.size(), 1u);
  EXPECT_DOUBLE_EQ(plant->balls[0].radius, 1);
  ASSERT_EQ(plant->discs.size(), 1u);
  ASSERT_EQ(plant->organs.size(), 3u);
  EXPECT_EQ(plant->organs[0].module, 0);
  EXPECT_EQ(plant->organs[0].production, 1);
  const Organ& leaf = plant->organs[1];
  EXPECT_EQ(leaf.kind, OrganKind::Leaf);
  EXPECT_EQ(plant->styleOf(leaf).model, "l");
  EXPECT_DOUBLE_EQ(leaf.length, 3);
  EXPECT_EQ(leaf.module, 2);
  EXPECT_EQ(leaf.production, 0);
  EXPECT_EQ(plant->faces[0].module, 2);
  EXPECT_EQ(plant->faces[0].production, 0);
}

TEST(LSystemPlant, ColoursMakeStyles) {
  const auto plant = plantOf("Axiom: F;(7)FF;(128)F\n");
  ASSERT_TRUE(plant);
  ASSERT_EQ(plant->styles.size(), 2u);
  EXPECT_FALSE(plant->styles[0].colour);
  EXPECT_EQ(plant->styles[1].colour, colourOfIndex(7));
  EXPECT_EQ(plant->organs[3].style, 0);
}

TEST(LSystemPlant, ABackwardStepIsAStemTheOtherWayRound) {
  const auto plant = plantOf("Axiom: F(-2)F(0)\n");
  ASSERT_TRUE(plant);
  EXPECT_DOUBLE_EQ(plant->organs[0].length, 2);
  EXPECT_EQ(plant->organs[0].direction, PlantDirection::along({0, -1, 0}));
  EXPECT_DOUBLE_EQ(plant->organs[1].length, 0);
}

}  // namespace
}  // namespace axil::simeco
