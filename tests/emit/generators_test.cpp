/// Known generators, written as grammars of 1 to 4 rules: grown, measured, and held against what they say.

#include "grown.hpp"
#include "quantify/layers.hpp"
#include "quantify/measure.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace axil::emit {
namespace {

using quantify::LayeredStatistics;
using quantify::Measurements;
using quantify::Quantity;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

constexpr double kDegree = std::numbers::pi / 180;

/// The grown plant's stems as a skeleton; a bracketed organ begins a stem.
Skeleton skeletonOf(const simeco::Plant& plant) {
  Skeleton skeleton;
  skeleton.root = NodeId{0};
  skeleton.nodes.push_back({NodeId{0}, plant.organs.front().base, std::nullopt, {0, 0, 0}, {}});
  std::vector<NodeId> tips(plant.organs.size());
  std::vector<std::size_t> stems(plant.organs.size());
  for (std::size_t o = 0; o < plant.organs.size(); ++o) {
    const simeco::Organ& organ = plant.organs[o];
    if (organ.kind != simeco::OrganKind::Stem) continue;
    const bool starts = !organ.parent || organ.branch;
    const std::size_t below = organ.parent ? static_cast<std::size_t>(organ.parent->value) : 0;
    const NodeId base = organ.parent ? tips[below] : NodeId{0};
    if (starts) {
      const StemId id{static_cast<std::int32_t>(skeleton.stems.size())};
      skeleton.stems.push_back({id, organ.parent ? std::optional(StemId{static_cast<std::int32_t>(stems[below])}) : std::nullopt, {base}});
      stems[o] = skeleton.stems.size() - 1;
    } else {
      stems[o] = stems[below];
    }
    tips[o] = NodeId{static_cast<std::int32_t>(skeleton.nodes.size())};
    skeleton.nodes.push_back({tips[o], organ.tip(), std::nullopt, {0, 0, 0}, {}});
    skeleton.stems[stems[o]].nodes.push_back(tips[o]);
  }
  return skeleton;
}

LayeredStatistics statisticsOf(const std::string& rules, std::int64_t steps, int plants) {
  const std::string text = "EcoSystem 1.1 \"g\" { Plant \"p\" { DeriveTime = 1; Stem { Stage 1(l) { GrowRate = l; } } Grow { " + rules + " } } }";
  const simeco::Parsed parsed = simeco::parseSimeco(text);
  for (const Diagnostic& d : parsed.diagnostics) ADD_FAILURE() << formatDiagnostic(d, text, "generator");
  std::vector<Measurements> measured;
  for (int seed = 1; seed <= plants; ++seed) {
    const auto growth = valueOf(simeco::prepareGrowth(parsed.grammar, {.seed = static_cast<std::uint64_t>(seed), .steps = steps}));
    measured.push_back(valueOf(quantify::measure(skeletonOf(valueOf(simeco::plantAt(growth, simeco::completeTime(growth)))))));
  }
  return valueOf(quantify::layeredStatistics(measured));
}

double insertionOf(const LayeredStatistics& s, int order) { return s.of(Quantity::Insertion).order(order)->estimate.value / kDegree; }

TEST(KnownGenerators, Monopodial) {
  const auto s = statisticsOf("w = A(0, 0, 0.1);"
                              "A(0, i, l) -> 0.6: S(1, l) [rotr(normal(0.87, 0.1))rotu(2.4*i)A(1, 0, l*0.7)] A(0, i+1, l*0.93) | 0.4: S(1, l) A(0, i+1, l*0.93) ;"
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
  EXPECT_EQ(s.branching.back(), quantify::Branching::Sympodial);
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

TEST(KnownGenerators, AHundredPlantsGiveProbabilitiesWithinAHundredth) {
  const auto s = statisticsOf("w = A(0);"
                              "A(0) -> 0.3: S(1, 0.1) [rotr(0.8)rotu(1)A(1)] A(0) | 0.7: S(1, 0.1) A(0) ;"
                              "A(1) -> S(1, 0.05) ;", 300, 100);
  EXPECT_NEAR(s.of(Quantity::Branching).order(0)->estimate.value, 0.3, 0.01);
}

}  // namespace
}  // namespace axil::emit
