#include "quantify/layers.hpp"

#include "known_growth.hpp"
#include "quantify/backtest.hpp"
#include "quantify/estimate.hpp"
#include "quantify/outlook.hpp"

#include <algorithm>
#include <cstdio>

namespace axil::quantify {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

LayeredStatistics statisticsOf(const std::vector<Measurements>& plants) {
  auto s = layeredStatistics(plants);
  EXPECT_TRUE(s) << (s ? "" : s.error().message);
  return s ? *s : LayeredStatistics{};
}

TEST(Layers, TenPlantsGiveTheirRulesBack) {
  const KnownRules rules{.stages = 14, .insertion_deg = 47, .divergence_deg = 137.5, .orders = 2};
  const LayeredStatistics s = statisticsOf(manyGrownBy(rules, 61, 10));
  EXPECT_NEAR(s.of(Quantity::Branching).order(0)->estimate.value, rules.branching, 0.1);  // 130 nodes: two and a half standard errors
  EXPECT_NEAR(s.of(Quantity::Insertion).order(0)->estimate.value / kDegree, rules.insertion_deg, 1.5);
  EXPECT_NEAR(s.branchesAround.back().divergence.degrees(), rules.divergence_deg, 1);
  EXPECT_NEAR(s.of(Quantity::Length).order(0)->trend.step() / rules.alongRatio, 1, 0.02);
  EXPECT_NEAR(s.of(Quantity::Length).order(1)->trend.step() / rules.alongRatio, 1, 0.02);
  EXPECT_NEAR(s.of(Quantity::LateralRatio).order(0)->estimate.value / rules.lateralRatio, 1, 0.02);
  EXPECT_NEAR(s.of(Quantity::Ending).order(1)->estimate.value, rules.ending, 0.03);
}

TEST(Layers, AHundredPlantsGiveProbabilitiesWithinAHundredth) {
  // 17,000 nodes: a hundredth is two and a half standard errors.
  const KnownRules rules{.stages = 12, .branching = 0.6, .ending = 0, .insertion_deg = 40, .orders = 3, .leaves = 0};
  const LayeredStatistics s = statisticsOf(manyGrownBy(rules, 62, 100));
  const auto& orders = s.of(Quantity::Branching);
  const double n0 = static_cast<double>(orders.order(0)->estimate.samples);
  const double n1 = static_cast<double>(orders.order(1)->estimate.samples);
  const double share = (orders.order(0)->estimate.own * n0 + orders.order(1)->estimate.own * n1) / (n0 + n1);
  EXPECT_NEAR(share, rules.branching, 0.0125);
}

TEST(Layers, EachPlantCountsOnceWherePlantsDiffer) {
  std::vector<Measurements> plants{grownBy({.stages = 16, .insertion_deg = 30, .insertionNoise_deg = 2, .orders = 2}, Rng(1)),
                                   grownBy({.stages = 10, .insertion_deg = 60, .insertionNoise_deg = 2, .orders = 2}, Rng(2))};
  const LayeredStatistics s = statisticsOf(plants);
  EXPECT_NEAR(s.of(Quantity::Insertion).order(0)->estimate.own / kDegree, 45, 2);
  EXPECT_FALSE(s.warnings.empty());
}

TEST(Layers, SharesAreTrueWhereAnEndLeavesAPlantWithFewNodes) {
  // Each plant makes nodes until one ends it, or a dozen: those that ended soon have few. True share: one in ten.
  const std::uint64_t seed = 65;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  std::vector<Sample> samples;
  for (std::size_t plant = 0; plant < 1000; ++plant)
    for (int node = 0; node < 12; ++node) {
      samples.push_back({plant, 0, node, rng.uniform() < 0.1 ? 1.0 : 0.0});
      if (samples.back().value > 0) break;
    }
  const Estimate share = estimateOf(samples, SampleKind::Share);
  EXPECT_NEAR(share.own, 0.1, 0.01);  // three standard errors
  EXPECT_EQ(share.between, 0);
}

TEST(Layers, SharesOfPlantsThatDifferCountEachPlantAlike) {
  std::vector<Sample> samples;
  for (int i = 0; i < 1000; ++i) samples.push_back({0, 0, i, i % 10 == 0 ? 1.0 : 0.0});
  for (int i = 0; i < 100; ++i) samples.push_back({1, 0, i, i % 10 < 8 ? 1.0 : 0.0});
  EXPECT_NEAR(estimateOf(samples, SampleKind::Share).own, 0.45, 0.03);  // of all nodes together it is 0.16
}

TEST(Layers, OneSpeciesIsNotCalledTwo) {
  for (std::uint64_t seed = 70; seed < 80; ++seed) {
    const LayeredStatistics s = statisticsOf(manyGrownBy({.stages = 8 + static_cast<int>(seed % 5)}, seed, 6));
    EXPECT_TRUE(s.warnings.empty()) << s.warnings.front();
  }
}

TEST(Layers, AStrangerAmongManyIsNamed) {
  std::vector<Measurements> plants = manyGrownBy({.stages = 12}, 63, 6);
  plants.push_back(grownBy({.stages = 12, .insertion_deg = 80}, Rng(9)));
  const LayeredStatistics s = statisticsOf(plants);
  ASSERT_FALSE(s.warnings.empty());
  EXPECT_NE(s.warnings.front().find("plant 7"), std::string::npos) << s.warnings.front();
}

TEST(Layers, UnitsAreConvertedOrRefused) {
  const Measurements metres = grownBy({}, Rng(3));
  Measurements centimetres = metres;
  centimetres.unit = "cm";
  for (Segment& segment : centimetres.segments) segment.length *= 100;
  const LayeredStatistics both = statisticsOf({metres, centimetres});
  EXPECT_NEAR(both.of(Quantity::Length).all.own, statisticsOf({metres}).of(Quantity::Length).all.own, 1e-9);
  EXPECT_EQ(both.warnings.size(), 1u);
  centimetres.unit = "furlong";
  const auto refused = layeredStatistics(std::vector<Measurements>{metres, centimetres});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::BadInput);
}

TEST(Layers, FewSamplesArePulledTowardsTheParentLayerAndManyAreNot) {
  const LayeredStatistics s = statisticsOf(manyGrownBy({.stages = 12, .insertionNoise_deg = 10}, 64, 3));
  const OrderLayer& layer = *s.of(Quantity::Insertion).order(0);
  for (const RankLayer& rank : layer.ranks) {
    const double own = std::abs(rank.estimate.own - layer.estimate.value);
    EXPECT_LE(std::abs(rank.estimate.value - layer.estimate.value), own + 1e-12);
    EXPECT_GE(rank.estimate.pooled, 0);
    EXPECT_LE(rank.estimate.pooled, 1);
  }
  EXPECT_GT(layer.ranks.front().estimate.pooled, 0.3);
}

TEST(Layers, ASlippedClickMovesAnEstimateLittle) {
  Measurements m = grownBy({.stages = 14, .insertionNoise_deg = 3}, Rng(4));
  const double before = statisticsOf({m}).of(Quantity::Length).order(0)->trend.step();
  m.segments[6].length *= 20;
  EXPECT_NEAR(statisticsOf({m}).of(Quantity::Length).order(0)->trend.step(), before, 0.05);
}

TEST(Layers, PoorPlantsGiveWhatTheyHave) {
  const auto stick = measure(test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}}));
  const LayeredStatistics one = statisticsOf({*stick});
  EXPECT_EQ(one.of(Quantity::Length).all.samples, 1u);
  EXPECT_EQ(one.of(Quantity::Insertion).all.samples, 0u);
  EXPECT_EQ(one.leaves.back().perNode, 0);
  // Zero variance, angles of 0 and 180 degrees.
  auto back = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}});
  test::addStem(back, skeleton3d::StemId{1}, skeleton3d::NodeId{2}, std::vector<glm::dvec3>{{0, 0.5, 0}});
  const LayeredStatistics s = statisticsOf({*measure(back)});
  EXPECT_NEAR(s.of(Quantity::Insertion).all.value / kDegree, 180, 1e-6);
  EXPECT_NEAR(s.of(Quantity::Bend).all.value, 0, 1e-9);
  EXPECT_EQ(s.of(Quantity::Length).all.deviation, s.of(Quantity::Length).all.deviation);
  EXPECT_FALSE(layeredStatistics({}));
}

TEST(Schedule, SteadyAxesAreToldFromEndedOnes) {
  const Measurements m = grownBy({.stages = 14, .ending = 0.15, .orders = 2}, Rng(6));
  const PlantStructure s = plantStructure(m);
  const Schedule schedule = scheduleOf(std::vector<MeasuredPlant>{{&m, &s}});
  ASSERT_TRUE(schedule.of(1).steady);
  EXPECT_EQ(schedule.of(1).delay, 0);
  for (std::size_t a = 1; a < s.axes.size(); ++a) {
    const double stages = schedule.plants[0].now - m.at(*s.axes[a].bearer).level;
    EXPECT_EQ(schedule.plants[0].grows[a], static_cast<double>(s.axes[a].segments.size()) == stages);
  }
}

/// The figures of docs/prediction.md.
void printSkill(const char* what, const BacktestSkill& s) {
  std::printf("%s: length %.1f %% (last again %.1f, thesis %.1f), all organs %.1f %% (%.1f, %.1f), new organs %.1f %% (%.1f, %.1f), intervals hold %.1f %% of %zu lengths, %.0f %% of counts\n", what,
              100 * s.lengthError, 100 * s.lengthErrorRepeated, 100 * s.lengthErrorThesis, 100 * s.countError, 100 * s.countErrorRepeated, 100 * s.countErrorThesis, 100 * s.newError,
              100 * s.newErrorRepeated, 100 * s.newErrorThesis, 100 * s.lengthCoverage, s.lengths, 100 * s.countCoverage);
}

TEST(Backtest, KnownRulesOfManyKindsAreForetold) {
  const std::pair<const char*, KnownRules> kinds[] = {
      {"spiral, single branches", {.stages = 11, .lengthNoise = 0.1}},
      {"decussate pairs", {.stages = 9, .lateralRatio = 0.5, .lengthNoise = 0.08, .branching = 0.6, .branchesAtNode = 2, .divergence_deg = 90, .leaves = 2}},
      {"few branches, many ends", {.stages = 14, .alongRatio = 0.9, .lengthNoise = 0.12, .branching = 0.4, .ending = 0.15, .leaves = 0}}};
  for (const auto& [name, rules] : kinds) {
    const auto test = backtest(manyGrownBy(rules, 66, 8));
    ASSERT_TRUE(test) << test.error().message;
    printSkill(name, test->skill);
    EXPECT_LT(test->skill.lengthError, 0.15);
    EXPECT_LT(test->skill.countError, 0.1);
    EXPECT_GT(test->skill.lengthCoverage, 0.85);
    EXPECT_LT(test->skill.lengthCoverage, 0.96);
    EXPECT_LT(test->skill.lengthError, test->skill.lengthErrorRepeated);
  }
}

TEST(Backtest, AKnownRuleIsForetoldWithinItsNoise) {
  const auto test = backtest(manyGrownBy({.stages = 11, .lengthNoise = 0.1}, 65, 8));
  ASSERT_TRUE(test) << test.error().message;
  const BacktestSkill& skill = test->skill;
  EXPECT_GT(skill.lengths, 100u);
  EXPECT_LT(skill.lengthError, 0.15);
  EXPECT_LT(skill.lengthError, skill.lengthErrorRepeated);
  EXPECT_LT(skill.lengthError, skill.lengthErrorThesis);
  EXPECT_GT(skill.lengthCoverage, 0.85);
  EXPECT_LT(skill.lengthCoverage, 0.95);
  EXPECT_LT(skill.countError, 0.1);
  EXPECT_LT(skill.newError, skill.newErrorThesis);
}

TEST(Backtest, ALaterMeasurementIsForetoldFromAnEarlierOne) {
  std::vector<Measurements> early;
  std::vector<Measurements> late;
  for (std::uint64_t p = 0; p < 5; ++p) {
    // The same draws in the same order: what is older is the same in both only while nothing is drawn from other axes, so noise is off.
    early.push_back(grownBy({.stages = 9, .lengthNoise = 0, .branching = 1, .ending = 0, .insertionNoise_deg = 0}, Rng(p)));
    late.push_back(grownBy({.stages = 10, .lengthNoise = 0, .branching = 1, .ending = 0, .insertionNoise_deg = 0}, Rng(p)));
  }
  const auto test = backtest(early, late, 1);
  ASSERT_TRUE(test) << test.error().message;
  EXPECT_LT(test->skill.lengthError, 1e-6);
  EXPECT_EQ(test->skill.countError, 0);
}

TEST(Backtest, WhatCannotBeTestedIsSaid) {
  const auto stick = measure(test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(backtest(std::vector<Measurements>{*stick}));
  EXPECT_FALSE(backtest(std::vector<Measurements>{grownBy({}, Rng(1))}, 0));
  EXPECT_FALSE(backtest(std::vector<Measurements>{*stick}, std::vector<Measurements>{}, 1));
  const auto mixed = backtest(std::vector<Measurements>{*stick, grownBy({}, Rng(1))});
  ASSERT_TRUE(mixed);
  EXPECT_EQ(mixed->notes.size(), 1u);
}

}  // namespace
}  // namespace axil::quantify
