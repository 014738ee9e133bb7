/// Known generators, written as grammars of 1 to 4 rules: grown, measured, and held against what they say.

#include "generators.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace axil::emit {
namespace {

using quantify::LayeredStatistics;
using quantify::Quantity;

constexpr double kDegree = std::numbers::pi / 180;

double insertionOf(const LayeredStatistics& s, int order) { return s.of(Quantity::Insertion).order(order)->estimate.value / kDegree; }

TEST(KnownGenerators, Monopodial) {
  const auto s = statisticsOf("w = A(0, 0, 0.1);"
                              "A(0, i, l) -> 0.6: S(1, l) [rotr(normal(0.87, 0.06))rotu(2.4*i)A(1, 0, l*0.7)] A(0, i+1, l*0.93) | 0.4: S(1, l) A(0, i+1, l*0.93) ;"
                              "A(1, i, l) -> S(1, l) A(1, i+1, l*0.88) ;", 40, 10);
  EXPECT_NEAR(s.of(Quantity::Branching).order(0)->estimate.value, 0.6, 0.05);
  EXPECT_NEAR(insertionOf(s, 0), 0.87 / kDegree, 1);
  EXPECT_NEAR(s.branchesAround.back().divergence.degrees(), 2.4 / kDegree, 1);
  EXPECT_NEAR(s.of(Quantity::LengthRatio).order(0)->estimate.value / 0.93, 1, 0.02);
  EXPECT_NEAR(s.of(Quantity::LengthRatio).order(1)->estimate.value / 0.88, 1, 0.02);
  EXPECT_NEAR(s.of(Quantity::LateralRatio).order(0)->estimate.value / 0.7, 1, 0.02);
  for (const auto branching : s.branching) EXPECT_EQ(branching, quantify::Branching::Monopodial);
}

TEST(KnownGenerators, ForksLikeLeeuwenbergsModel) {
  const auto s = statisticsOf("w = A(0, 0.1);"
                              "A(0, l) -> 0.9: S(1, l) [rotr(normal(0.6, 0.1))rotu(0)A(0, l*0.85)] [rotr(normal(0.6, 0.1))rotu(3.141593)A(0, l*0.85)] | 0.1: S(1, l) ;", 9, 10);
  EXPECT_NEAR(s.of(Quantity::Forking).all.value, 0.9, 0.05);
  EXPECT_NEAR(s.of(Quantity::Insertion).all.value / kDegree, 0.6 / kDegree, 1);
  EXPECT_NEAR(s.of(Quantity::LateralRatio).all.value / 0.85, 1, 0.02);
  // A plant that ended at its first node forks nowhere.
  EXPECT_GE(std::count(s.branching.begin(), s.branching.end(), quantify::Branching::Sympodial), 8);
  EXPECT_EQ(std::count(s.branching.begin(), s.branching.end(), quantify::Branching::Monopodial), 0);
}

TEST(KnownGenerators, DecussateBranches) {
  const auto s = statisticsOf("w = A(0, 0.1);"
                              "A(0, l) -> S(1, l) [rotr(0.8)rotu(0)A(1, l*0.5)] [rotr(0.8)rotu(3.141593)A(1, l*0.5)] rotr(0)rotu(1.570796)A(0, l*0.96) ;"
                              "A(1, l) -> S(1, l) A(1, l*0.9) ;", 8, 10);
  EXPECT_EQ(s.branchesAround.back().perNode, 2);
  EXPECT_NEAR(s.branchesAround.back().divergence.degrees(), 90, 1);
  EXPECT_EQ(s.branchesAround.back().preset, "decussate");
  EXPECT_NEAR(s.branches.front().shares.back(), 1, 1e-9);
}

TEST(KnownGenerators, BranchesAtTheTopOfEachGrowthUnit) {
  const auto s = statisticsOf("w = A(0, 0);"
                              "A(0, i) : i%4 == 3 -> S(1, 0.1) [rotr(0.8)rotu(2.4*i)A(1, 0)] A(0, i+1) ;"
                              "A(0, i) -> S(1, 0.1) A(0, i+1) ;"
                              "A(1, i) : i < 5 -> S(1, 0.05) A(1, i+1) ;"
                              "A(1, i) : i == 5 -> S(1, 0.05) ;", 17, 10);
  EXPECT_EQ(s.patterns.front().habit, quantify::BranchingHabit::EveryKth);
  EXPECT_EQ(s.patterns.front().period, 4);
  EXPECT_EQ(s.patterns.front().phase, 3);
}

TEST(KnownGenerators, BranchesThatBeginLateAreSeenToBeLate) {
  const auto s = statisticsOf("w = A(0);"
                              "A(0) -> S(1, 0.1) [rotr(0.8)rotu(1)A(2)] A(0) ;"
                              "A(2) -> A(3) ; A(3) -> A(4) ; A(4) -> S(1, 0.05) A(4) ;", 14, 3);
  EXPECT_EQ(s.patterns.front().delay, 2);
  EXPECT_EQ(s.schedule.of(1).delay, 2);
  EXPECT_TRUE(s.schedule.of(1).steady);
}

TEST(KnownGenerators, ShootsThatComeTogetherWithTheirBearersAreNoForksAndNoStageOfTheirOwn) {
  const auto s = statisticsOf("w = A(0.05); A(l) -> 0.6: S(1, l) [rotr(0.8)rotu(random(0, 6.28))S(1, l*0.4)] A(l*0.96) | 0.4: S(1, l) A(l*0.96) ;", 13, 10);
  EXPECT_TRUE(s.schedule.branchesAtOnce);
  for (const auto& plant : s.schedule.plants) {
    EXPECT_EQ(plant.now, 12);
    EXPECT_TRUE(plant.grows.front());
  }
  for (const auto& fate : s.fates.front().fates) EXPECT_TRUE(fate.goesOn);
}

TEST(KnownGenerators, StemsThatBranchBelowOnlyAreNotTakenForLateBranches) {
  const auto s = statisticsOf("w = A(0, 0);"
                              "A(0, i) : i < 7 -> 0.8: S(1, 0.1) [rotr(0.9)rotu(2.4*i)A(1, 0)] A(0, i+1) | 0.2: S(1, 0.1) A(0, i+1) ;"
                              "A(0, i) -> S(1, 0.1) A(0, i+1) ;"
                              "A(1, i) -> S(1, 0.08) A(1, i+1) ;", 12, 10);
  EXPECT_EQ(s.patterns.front().delay, 0);
  EXPECT_EQ(s.patterns.front().habit, quantify::BranchingHabit::Basitonic);
}

TEST(KnownGenerators, AHundredPlantsGiveProbabilitiesWithinAHundredth) {
  const auto s = statisticsOf("w = A(0);"
                              "A(0) -> 0.3: S(1, 0.1) [rotr(0.8)rotu(1)A(1)] A(0) | 0.7: S(1, 0.1) A(0) ;"
                              "A(1) -> S(1, 0.05) ;", 300, 100);
  EXPECT_NEAR(s.of(Quantity::Branching).order(0)->estimate.value, 0.3, 0.01);
}

}  // namespace
}  // namespace axil::emit
