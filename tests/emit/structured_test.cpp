#include "emit/structured.hpp"

#include "grown.hpp"

#include <set>

namespace axil::emit {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

/// A trunk with a branch of two segments at each of its four nodes.
Skeleton fishbone() {
  std::vector<glm::dvec3> trunk;
  for (int i = 0; i <= 5; ++i) trunk.push_back({0.004 * (i % 2), 0.1 * i, 0});
  Skeleton plant = test::chainThrough(trunk);
  for (int i = 1; i <= 4; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const std::vector<glm::dvec3> branch{{side * (0.05 + 0.002 * i), 0.1 * i + 0.05, 0.01}, {side * 0.1, 0.1 * i + 0.11, 0.02}};
    test::addStem(plant, StemId{1}, NodeId{i + 1}, branch);
  }
  return plant;
}

std::size_t rulesOf(const simeco::Grammar& grammar) { return grammar.plants[0].rules.productions.size(); }

TEST(StructuredGrammar, HasAtMostTwoRulesAnOrderAndIsShorterThanTheInitialOne) {
  const auto m = valueOf(quantify::measure(fishbone()));
  const simeco::Grammar grammar = valueOf(structuredGrammar(m));
  EXPECT_EQ(rulesOf(grammar), 4u);
  EXPECT_LT(simeco::print(grammar).size(), simeco::print(valueOf(initialGrammar(m))).size() / 2);
}

TEST(StructuredGrammar, GrowsPlantsLikeTheMeasuredOne) {
  const auto m = valueOf(quantify::measure(fishbone()));
  const simeco::Grammar grammar = valueOf(structuredGrammar(m));
  std::set<double> heights;
  double sum = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const simeco::Plant plant = grownUp(grammar, {.seed = seed});
    std::size_t onTrunk = 0;
    for (const simeco::Organ& organ : plant.organs) {
      const bool trunk = plant.styleOf(organ).stage == 10;
      onTrunk += trunk;
      if (trunk) sum += organ.length, ++count;
    }
    EXPECT_EQ(onTrunk, 5u);
    EXPECT_EQ(plant.organs.size(), 5u + 4 * 2);
    heights.insert(plant.organs.back().tip().at.y);
  }
  EXPECT_NEAR(sum / static_cast<double>(count), 0.1, 0.001);
  EXPECT_GT(heights.size(), 35u);
}

TEST(StructuredGrammar, ParsesChecksAndEndsForRandomTrees) {
  const std::uint64_t seed = 61;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const auto m = valueOf(quantify::measure(test::randomTree(rng, {.segments = 40, .leaves = i % 2 == 0 ? 60 : 0, .collarBranches = i % 3})));
    const simeco::Grammar grammar = valueOf(structuredGrammar(m));
    ASSERT_EQ(complaints(grammar), "") << simeco::print(grammar);
    const simeco::Parsed parsed = simeco::parseSimeco(simeco::print(grammar));
    ASSERT_EQ(parsed.grammar, grammar);
    ASSERT_FALSE(grownUp(grammar).organs.empty());
  }
}

TEST(StructuredGrammar, KeepsAsManyOrdersAsAsked) {
  const auto m = valueOf(quantify::measure(fishbone()));
  EXPECT_EQ(rulesOf(valueOf(structuredGrammar(m, {}, {.orders = 1}))), 2u);
  EXPECT_EQ(complaints(valueOf(structuredGrammar(m, {}, {.orders = 1}))), "");
  EXPECT_FALSE(structuredGrammar(m, {}, {.orders = 0}));
}

}  // namespace
}  // namespace axil::emit
