#include "simeco/growth.hpp"

#include "base/files.hpp"
#include "base/text.hpp"
#include "simeco/language.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::simeco {
namespace {

Grammar grammarOf(const std::string& text) {
  const Parsed parsed = parseSimeco(text);
  EXPECT_TRUE(parsed.ok()) << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}

/// One plant with the given plant attributes, stages of stems and leaves, and rules.
std::string plantText(const std::string& attributes, const std::string& stems, const std::string& leaves, const std::string& rules) {
  return "EcoSystem 1.1 \"e\" { Plant \"p\" { " + attributes + " Apex {} Stem { " + stems + " } Leaf { " + leaves +
         " } Root {} Fruit {} Flower {} Grow { " + rules + " } } }";
}

const char* const kStems =
    "Stage 1 { GrowRate = 2.0; GrowTime = 3.0; BroadenRate = 0.5; } Stage 2 { GrowRate = 1.0; GrowTime = 1.0; }";
const char* const kLeaves = "Stage 1 { GrowRate = 0.25; GrowTime = 2.0; }";

Growth grown(const Grammar& grammar, const GrowOptions& options = {}) {
  auto growth = prepareGrowth(grammar, options);
  if (!growth) throw std::runtime_error(growth.error().message);
  return *growth;
}
Plant at(const Growth& growth, double time) {
  auto plant = plantAt(growth, time);
  if (!plant) throw std::runtime_error(plant.error().message);
  return *plant;
}
std::string refusal(const std::string& text, const GrowOptions& options = {}) {
  const auto growth = prepareGrowth(grammarOf(text), options);
  return growth ? std::string("it grew") : growth.error().message;
}

std::size_t countOf(const Plant& plant, OrganKind kind) {
  return static_cast<std::size_t>(std::count_if(plant.organs.begin(), plant.organs.end(), [&](const Organ& o) { return o.kind == kind; }));
}

void expectAt(const PlantPoint& point, double x, double y, double z) {
  EXPECT_NEAR(point.at.x, x, 1e-12);
  EXPECT_NEAR(point.at.y, y, 1e-12);
  EXPECT_NEAR(point.at.z, z, 1e-12);
}

TEST(Growth, AnOrganLengthensByItsRateUntilItsGrowTime) {
  const Growth growth = grown(grammarOf(plantText("", kStems, kLeaves, "w = S(1);")));
  EXPECT_DOUBLE_EQ(at(growth, 0).organs[0].length, 0);
  EXPECT_DOUBLE_EQ(at(growth, 1.5).organs[0].length, 3);
  EXPECT_DOUBLE_EQ(at(growth, 3).organs[0].length, 6);
  EXPECT_DOUBLE_EQ(at(growth, 30).organs[0].length, 6);
  EXPECT_DOUBLE_EQ(at(growth, 30).organs[0].age, 30);
  EXPECT_DOUBLE_EQ(at(growth, 30).organs[0].radius, 0.5 * 3 * modelRadius);
  EXPECT_DOUBLE_EQ(at(growth, 1.5).organs[0].radius, 0.5 * 1.5 * modelRadius);
  EXPECT_DOUBLE_EQ(completeTime(growth), 3);
}

TEST(Growth, AStemWithoutBroadenRateGetsTheDefaultRadiusAndALeafNone) {
  const Plant plant = at(grown(grammarOf(plantText("", kStems, kLeaves, "w = S(2) L(1);"))), 10);
  ASSERT_EQ(plant.organs.size(), 2u);
  EXPECT_DOUBLE_EQ(plant.organs[0].radius, defaultStemShare * modelRadius);
  EXPECT_DOUBLE_EQ(plant.organs[1].radius, 0);
}

TEST(Growth, ARewrittenOrganStaysAndItsSuccessorStartsAtItsTip) {
  const Growth growth = grown(grammarOf(plantText("", kStems, kLeaves, "w = S(1); S(1) -> S(2) L(1) ;")));
  const Plant before = at(growth, 0.5);
  ASSERT_EQ(before.organs.size(), 1u);
  EXPECT_EQ(before.organs[0].module, 0);
  const Plant plant = at(growth, 1.5);
  ASSERT_EQ(plant.organs.size(), 3u);
  EXPECT_EQ(plant.organs[0].module, -1);
  EXPECT_DOUBLE_EQ(plant.organs[0].age, 1.5);
  EXPECT_DOUBLE_EQ(plant.organs[1].age, 0.5);
  EXPECT_EQ(plant.organs[1].production, 0);
  EXPECT_EQ(plant.organs[0].production, -1);
  expectAt(plant.organs[0].tip(), 0, 3, 0);
  expectAt(plant.organs[1].base, 0, 3, 0);
  expectAt(plant.organs[2].base, 0, 3.5, 0);
  EXPECT_EQ(plant.organs[2].parent, OrganId(1));
}

TEST(Growth, AModuleWithoutAStageHasNoBody) {
  const Plant plant = at(grown(grammarOf(plantText("", kStems, kLeaves, "w = S(1) S(1002) A(3) S(2);"))), 5);
  ASSERT_EQ(plant.organs.size(), 2u);
  EXPECT_EQ(plant.organs[1].parent, OrganId(0));
}

TEST(Growth, TurnsAddUpUntilTheNextOrganAndBracketsMakeBranches) {
  const Plant plant = at(grown(grammarOf(plantText("", kStems, kLeaves, "w = S(2) [rotr(0.2)rotr(0.3)rotu(0.4) S(2) L(1)] rotr(0.1) S(2);"))), 5);
  ASSERT_EQ(plant.organs.size(), 4u);
  EXPECT_FALSE(plant.organs[0].branch);
  EXPECT_TRUE(plant.organs[1].branch);
  EXPECT_FALSE(plant.organs[2].branch);
  EXPECT_FALSE(plant.organs[3].branch);
  EXPECT_EQ(plant.organs[1].parent, OrganId(0));
  EXPECT_EQ(plant.organs[2].parent, OrganId(1));
  EXPECT_EQ(plant.organs[3].parent, OrganId(0));
  const StemFrame base = firstFrame(PlantDirection::up());
  const StemFrame branch = childFrame(base, {0.5_rad, 0.4_rad}, ChildKind::Branch);
  EXPECT_EQ(plant.organs[1].direction, branch.direction);
  EXPECT_EQ(plant.organs[1].rAxis, branch.rAxis);
  EXPECT_NEAR(angleBetween(plant.organs[0].direction, plant.organs[3].direction).radians(), 0.1, 1e-12);
}

TEST(Growth, StartsAtThePlantsPositionAlongItsDirection) {
  const Plant plant = at(grown(grammarOf(plantText("Position = vector(1, 2, 3); Direction = vector(2, 0, 0);", kStems, kLeaves, "w = S(2);"))), 5);
  expectAt(plant.organs[0].base, 1, 2, 3);
  expectAt(plant.organs[0].tip(), 2, 2, 3);
}

TEST(Growth, StepsHappenAtMultiplesOfDeriveTime) {
  const Growth growth = grown(grammarOf(plantText("DeriveTime = 2.5;", kStems, kLeaves, "w = A(0); A(0) -> A(1) ; A(1) -> S(2) ;")));
  EXPECT_EQ(at(growth, 4.99).organs.size(), 0u);
  EXPECT_EQ(at(growth, 5).organs.size(), 1u);
  EXPECT_DOUBLE_EQ(at(growth, 5.5).organs[0].length, 0.5);
  EXPECT_DOUBLE_EQ(completeTime(growth), 6);
}

TEST(Growth, AnInsertedInternodeLiftsWhatStandsOnIt) {
  // The apex between stem and leaf becomes an internode at step 1, so the leaf changes its parent but not its age.
  const Growth growth = grown(grammarOf(plantText("", kStems, kLeaves, "w = S(2) A(0) L(1); A(0) -> S(2) ;")));
  EXPECT_EQ(at(growth, 0.9).organs.size(), 2u);
  const Plant plant = at(growth, 2);
  ASSERT_EQ(plant.organs.size(), 3u);
  EXPECT_EQ(plant.organs[2].kind, OrganKind::Leaf);
  EXPECT_EQ(plant.organs[2].parent, OrganId(1));
  EXPECT_DOUBLE_EQ(plant.organs[2].age, 2);
  expectAt(plant.organs[2].base, 0, 2, 0);
}

TEST(Growth, TheEnvironmentActsThroughBellCurvesThatAreOneAtTheAppendixValues) {
  const auto lengthWith = [](const std::string& attributes) { return at(grown(grammarOf(plantText(attributes, kStems, kLeaves, "w = S(2);"))), 5).organs[0].length; };
  EXPECT_DOUBLE_EQ(lengthWith("SoilPH = 7.0; RainRate = 0.9; DayLight = 12.0;"), 1);
  EXPECT_DOUBLE_EQ(lengthWith("SoilPH = 8.5;"), std::exp(-0.5));
  EXPECT_DOUBLE_EQ(lengthWith("DayLight = 6.0; RainRate = 0.45;"), std::exp(-0.5) * std::exp(-0.5));
  EXPECT_DOUBLE_EQ(lengthWith("SoilPH = 5.0; SoilPHWidth = 2.0;"), std::exp(-0.5));
}

TEST(Growth, ACutTakesTheRestOfItsBranchAndTheBodiesThatStayedBehindThere) {
  // Step 1 makes the cut and rewrites S(1), whose body stays; step 2 cuts both off, the stem below and the other branch stay.
  const Growth growth = grown(grammarOf(plantText("", kStems, kLeaves, "w = S(2) [rotr(0.5) S(2) A(0) S(1) L(1)] S(2); A(0) -> % ; S(1) -> S(2) ;")));
  EXPECT_EQ(at(growth, 0.5).organs.size(), 5u);
  EXPECT_EQ(at(growth, 1.5).organs.size(), 6u);
  const Plant plant = at(growth, 2);
  ASSERT_EQ(plant.organs.size(), 3u);
  EXPECT_EQ(countOf(plant, OrganKind::Leaf), 0u);
  EXPECT_TRUE(plant.organs[1].branch);
  EXPECT_EQ(plant.organs[2].parent, OrganId(0));
  EXPECT_EQ(at(growth, 1.5).organs.size(), 6u);
}

TEST(Growth, SeveralPlantsShareOneEcosystem) {
  const std::string stems = "Stem { Stage 1 { GrowRate = 1.0; GrowTime = 1.0; } }";
  const Grammar grammar = grammarOf("EcoSystem 1.1 \"e\" { Plant \"a\" { " + stems + " Grow { w = S(1); S(1) -> S(1001) ; } } Plant \"b\" { Position = vector(5, 0, 0); " +
                                    stems + " Grow { w = A(1); A(1) -> S(1) ; } } }");
  const Plant plant = at(grown(grammar), 3);
  ASSERT_EQ(plant.organs.size(), 2u);
  EXPECT_FALSE(plant.organs[1].parent.has_value());
  expectAt(plant.organs[1].base, 5, 0, 0);
  EXPECT_EQ(plant.organs[1].production, 1);
  EXPECT_EQ(plant.organs[1].style, 1);
}

TEST(Growth, LantanaIsAPlantWithTwentyFourLeaves) {
  const auto text = readFile(std::string(AXIL_TEST_DIR) + "/data/lantana.simeco");
  ASSERT_TRUE(text) << text.error().message;
  const Grammar grammar = grammarOf(*text);
  const Growth growth = grown(grammar);
  const Plant plant = at(growth, completeTime(growth));
  EXPECT_EQ(countOf(plant, OrganKind::Leaf), 24u);
  double sum = 0;
  for (const Organ& organ : plant.organs)
    if (organ.kind == OrganKind::Stem && plant.styleOf(organ).stage >= 2) sum += organ.length;
  EXPECT_NEAR(sum, 1.655, 5e-4);
  for (std::size_t i = 0; i < plant.organs.size(); ++i) EXPECT_LT(plant.organs[i].parent.value_or(OrganId(-1)).value, static_cast<std::int32_t>(i));
}

TEST(Growth, AskingInAnyOrderGivesTheSamePlant) {
  const auto text = readFile(std::string(AXIL_TEST_DIR) + "/data/lantana.simeco");
  ASSERT_TRUE(text);
  const Growth growth = grown(grammarOf(*text));
  std::vector<Plant> inOrder;
  for (int i = 0; i <= 64; ++i) inOrder.push_back(at(growth, 0.5 * i));
  for (int i = 0; i <= 64; ++i) {
    const int shuffled = (i * 37) % 65;
    EXPECT_EQ(at(growth, 0.5 * shuffled), inOrder[static_cast<std::size_t>(shuffled)]);
  }
}

TEST(Growth, StepsAddedLaterChangeNothingEarlier) {
  const Grammar grammar = grammarOf(plantText("", kStems, kLeaves,
                                              "w = A(0); A(i) -> S(2) [rotr(random(0.1, 0.9)) rotu(random(-3, 3)) L(1)] rotr(normal(0, 0.1)) A(i+1) ;"));
  const Growth few = grown(grammar, {.seed = 7, .steps = 9});
  const Growth many = grown(grammar, {.seed = 7, .steps = 40});
  for (double time = 0; time < 9.99; time += 0.37) EXPECT_EQ(at(few, time), at(many, time)) << time;
  EXPECT_NE(at(few, 12), at(many, 12));
  EXPECT_NE(at(grown(grammar, {.seed = 8, .steps = 9}), 5), at(few, 5));
  const Growth limited = grown(grammar, {.seed = 7, .upToTime = 6.5});
  EXPECT_EQ(at(limited, 6.5), at(many, 6.5));
  EXPECT_FALSE(plantAt(limited, 7));
}

TEST(Growth, StageSizesMayBeDrawnForEachOrgan) {
  const Grammar grammar = grammarOf(plantText("", "Stage 1 { GrowRate = random(1.0, 2.0); GrowTime = 1.0; }", kLeaves, "w = S(1) S(1);"));
  const Plant plant = at(grown(grammar), 2);
  EXPECT_NE(plant.organs[0].length, plant.organs[1].length);
  for (const Organ& organ : plant.organs) EXPECT_TRUE(organ.length >= 1 && organ.length < 2);
  EXPECT_EQ(at(grown(grammar), 2), plant);
}

TEST(Growth, BadInputEndsInOneClearSentence) {
  const Growth growth = grown(grammarOf(plantText("", kStems, kLeaves, "w = S(1);")));
  EXPECT_EQ(plantAt(growth, -1).error().code, ErrorCode::BadInput);
  EXPECT_EQ(plantAt(growth, std::nan("")).error().code, ErrorCode::BadInput);
  EXPECT_NE(refusal(plantText("Direction = vector(0, 0, 0);", kStems, kLeaves, "w = S(1);")).find("Direction"), std::string::npos);
  EXPECT_NE(refusal(plantText("DeriveTime = 0.0;", kStems, kLeaves, "w = S(1);")).find("DeriveTime"), std::string::npos);
  EXPECT_NE(refusal(plantText("", "Stage 1 { GrowRate = -1.0; }", kLeaves, "w = S(1);")).find("GrowRate"), std::string::npos);
  GrowOptions few;
  few.limits.steps = 50;
  const std::string endless = refusal(plantText("", kStems, kLeaves, "w = S(1000); S(i) -> S(i+1) ;"), few);
  EXPECT_NE(endless.find("50 steps"), std::string::npos) << endless;
  EXPECT_NE(endless.find("S(i)"), std::string::npos) << endless;
}

}  // namespace
}  // namespace axil::simeco
