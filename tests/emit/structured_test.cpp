#include "emit/structured.hpp"

#include "generators.hpp"
#include "quantify/structure.hpp"
#include "support/cases.hpp"

#include <filesystem>
#include <map>
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
  for (const quantify::Measurements& plant : measuredFrom(grammar, 40, 1)) {
    const quantify::PlantStructure structure = quantify::plantStructure(plant);
    EXPECT_EQ(structure.axes.front().segments.size(), 5u);
    EXPECT_EQ(plant.segments.size(), 5u + 4 * 2);
    double height = 0;
    for (const auto id : structure.axes.front().segments) {
      sum += plant.at(id).length;
      ++count;
      height += plant.at(id).length * plant.at(id).direction.unit().y;
    }
    heights.insert(height);
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

// ---- the exact form --------------------------------------------------------------------------------------------------

struct ExactErrors {
  double node = 0;   ///< the farthest that any measured node is from a grown one, or the other way round, of the height
  double bytes = 0;  ///< of the initial grammar's
  std::size_t rules = 0;
};

std::vector<glm::dvec3> measuredNodes(const quantify::Measurements& m) {
  std::vector<glm::dvec3> nodes;
  for (const auto& s : m.segments) nodes.push_back((s.parent ? nodes[static_cast<std::size_t>(s.parent->value)] : m.origin.at) + s.direction.unit() * s.length);
  return nodes;
}

double farthestOf(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
  double worst = 0;
  for (const glm::dvec3& f : from) {
    double nearest = 1e9;
    for (const glm::dvec3& t : to) nearest = std::min(nearest, glm::distance(f, t));
    worst = std::max(worst, nearest);
  }
  return worst;
}

ExactErrors exactErrors(const quantify::Measurements& m, double height, const StructureOptions& options) {
  const simeco::Grammar grammar = valueOf(structuredGrammar(m, {}, options));
  EXPECT_EQ(complaints(grammar), "");
  const std::string text = simeco::print(grammar);
  EXPECT_EQ(simeco::parseSimeco(text).grammar, grammar);
  const simeco::Plant plant = grownUp(grammar);
  std::vector<glm::dvec3> tips;
  std::size_t leaves = 0;
  std::size_t wanted = m.rootLeaves.size();
  for (const auto& s : m.segments) wanted += s.leaves.size();
  for (const simeco::Organ& organ : plant.organs) {
    if (organ.kind == simeco::OrganKind::Stem && plant.styleOf(organ).stage == 1) tips.push_back(organ.tip().at);
    leaves += organ.kind == simeco::OrganKind::Leaf;
  }
  EXPECT_EQ(tips.size(), m.segments.size());
  EXPECT_EQ(leaves, wanted);
  const auto nodes = measuredNodes(m);
  return {std::max(farthestOf(nodes, tips), farthestOf(tips, nodes)) / height, static_cast<double>(text.size()) / static_cast<double>(simeco::print(valueOf(initialGrammar(m))).size()),
          rulesOf(grammar)};
}

TEST(ExactGrammar, RegrowsRandomTreesWithinItsError) {
  const std::uint64_t seed = 62;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = test::randomTree(rng, {.segments = 70, .leaves = i % 2 == 0 ? 60 : 0, .collarBranches = i % 3, .radii = i % 4 < 2});
    const ExactErrors errors = exactErrors(valueOf(quantify::measure(plant)), test::heightOf(plant), {.form = StructuredForm::Exact});
    EXPECT_LT(errors.node, 0.0151);
    EXPECT_LT(errors.bytes, 0.3);
  }
}

TEST(ExactGrammar, ThePublicPlantsTakeLessThanAThirdOfTheText) {
  const auto folders = test::plantCaseFolders();
  if (folders.empty()) GTEST_SKIP() << "no shared plants here";
  for (const auto& folder : folders) {
    SCOPED_TRACE(folder.filename().string());
    const test::PlantCase plant = test::readPlantCase(folder, {.radius = true});
    Skeleton skeleton;
    for (std::size_t n = 0; n < plant.nodes.size(); ++n) skeleton.nodes.push_back({plant.nodes[n].id, plant.truth[n], std::nullopt, {0, 0, 0}, {}});
    std::map<NodeId, StemId> stemOf;
    for (const auto& stem : plant.stems) {
      const auto bearer = stemOf.find(stem.nodes.front());
      skeleton.stems.push_back({stem.id, bearer == stemOf.end() ? std::nullopt : std::optional(bearer->second), stem.nodes});
      for (const NodeId node : stem.nodes) stemOf.emplace(node, stem.id);
    }
    skeleton.root = skeleton.stems.front().nodes.front();
    const auto m = quantify::measure(skeleton);
    if (!m || m->segments.size() < 60) continue;
    const ExactErrors errors = exactErrors(*m, plant.height_m, {.form = StructuredForm::Exact});
    std::cout << folder.filename().string() << ": " << m->segments.size() << " segments, " << errors.rules << " rules, " << 100 * errors.bytes << " % of the bytes, nodes within "
              << 100 * errors.node << " %\n";
    EXPECT_LE(errors.bytes, 0.3);
    EXPECT_LE(errors.node, 0.02);
  }
}

TEST(ExactGrammar, DetailBuysLessErrorForMoreText) {
  Rng rng(63);
  const Skeleton plant = test::randomTree(rng, {.segments = 80});
  const auto m = valueOf(quantify::measure(plant));
  const double height = test::heightOf(plant);
  const ExactErrors coarse = exactErrors(m, height, {.form = StructuredForm::Exact, .maximumError = 0.05, .detail = 0.1});
  const ExactErrors usual = exactErrors(m, height, {.form = StructuredForm::Exact});
  const ExactErrors fine = exactErrors(m, height, {.form = StructuredForm::Exact, .detail = 100});
  EXPECT_LT(coarse.bytes, usual.bytes);
  EXPECT_LT(usual.bytes, fine.bytes);
  EXPECT_GT(usual.node, 3 * fine.node);
  EXPECT_FALSE(structuredGrammar(m, {}, {.form = StructuredForm::Exact, .maximumError = 0}));
  EXPECT_FALSE(structuredGrammar(m, {}, {.form = StructuredForm::Exact, .detail = -1}));
}

TEST(ExactGrammar, GrowsStrangePlants) {
  const std::vector<glm::dvec3> stick{{0, 0, 0}, {0, 0.2, 0}};
  EXPECT_LT(exactErrors(valueOf(quantify::measure(test::chainThrough(stick))), 0.2, {.form = StructuredForm::Exact}).node, 0.0151);
  // Straight on, straight back, and lengths that differ a thousandfold.
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}, {0, 0.4, 0}, {0, 0.401, 0.001}, {0.3, 0.4, 0}};
  Skeleton plant = test::chainThrough(points);
  const std::vector<glm::dvec3> back{{0, 0.2, 0}, {0.1, 0.2, 0}};
  test::addStem(plant, StemId{1}, NodeId{2}, back);
  EXPECT_LT(exactErrors(valueOf(quantify::measure(plant)), 1, {.form = StructuredForm::Exact}).node, 0.0151);
  // One segment an axis, all alike, in millimetres.
  Skeleton star = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 100, 0}});
  for (int i = 0; i < 6; ++i) {
    const std::vector<glm::dvec3> ray{{50 * std::cos(i * 1.0471975512), 130, 50 * std::sin(i * 1.0471975512)}};
    test::addStem(star, StemId{1}, NodeId{2}, ray);
  }
  EXPECT_LT(exactErrors(valueOf(quantify::measure(star)), 130, {.form = StructuredForm::Exact}).node, 0.0151);
}

}  // namespace
}  // namespace axil::emit
