#include "quantify/structure.hpp"

#include "known_growth.hpp"
#include "quantify/branching.hpp"
#include "quantify/circular.hpp"
#include "quantify/phyllotaxis.hpp"
#include "quantify/subtrees.hpp"

#include <cmath>

namespace axil::quantify {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

Measurements measuredOf(const Skeleton& plant) {
  const auto m = measure(plant);
  EXPECT_TRUE(m) << (m ? "" : m.error().message);
  return m ? *m : Measurements{};
}

Skeleton trunkWithBranches() {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}};
  Skeleton plant = test::chainThrough(trunk);
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{1, 2, 0}, {2, 3, 0}});
  test::addStem(plant, StemId{1}, NodeId{4}, std::vector<glm::dvec3>{{-1, 4, 0}});
  return plant;
}

BranchingPattern patternOf(const Measurements& m, const PlantStructure& s) {
  const std::vector<MeasuredPlant> plants{{&m, &s}};
  return branchingPatternOf(plants, scheduleOf(plants), 0);
}

TEST(Structure, OrdersRanksAndNodes) {
  const Measurements m = measuredOf(trunkWithBranches());
  const PlantStructure s = plantStructure(m);
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_EQ(s.orders, 2);
  EXPECT_EQ(s.axes[0].segments.size(), 4u);
  EXPECT_EQ(s.at(s.axes[0].segments[2]).rank, 2);
  EXPECT_EQ(s.at(s.axes[0].segments[2]).fromTip, 1);
  EXPECT_TRUE(s.at(s.axes[0].segments[0]).isNode);
  EXPECT_FALSE(s.at(s.axes[0].segments[1]).isNode);
  EXPECT_EQ(s.axes[1].order, 1);
  EXPECT_EQ(s.branching, Branching::Monopodial);
  EXPECT_EQ(internodesOf(m, s, s.axes[0]), (std::vector<double>{1, 2, 1}));
}

TEST(Structure, AnAxisFollowsItsStemEvenWhereABranchGoesOnStraighter) {
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0.8, 1.8, 0}});
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{-0.1, 2, 0}});
  const PlantStructure s = plantStructure(measuredOf(plant));
  EXPECT_EQ(s.axes[0].segments.size(), 2u);
  EXPECT_EQ(s.branching, Branching::Sympodial);
}

TEST(Structure, StemsThatEndInLikeChildrenFork) {
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}});
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{0.5, 2, 0}});
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{-0.52, 2, 0}});
  const PlantStructure s = plantStructure(measuredOf(plant));
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_TRUE(s.axes[0].forks);
  EXPECT_EQ(s.axes[2].order, 1);
}

/// A straight stem that ends in two arms, so far from straight on.
Measurements forkOf(double one_deg, double other_deg) {
  const auto arm = [](double degrees) { return std::vector<glm::dvec3>{{std::sin(degrees * std::numbers::pi / 180), 6 + std::cos(degrees * std::numbers::pi / 180), 0}}; };
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}, {0, 5, 0}, {0, 6, 0}});
  test::addStem(plant, StemId{1}, NodeId{7}, arm(one_deg));
  test::addStem(plant, StemId{1}, NodeId{7}, arm(-other_deg));
  return measuredOf(plant);
}

TEST(Structure, ForksOfAKindAreJudgedTogether) {
  // Alone the second one's least angle is below a half of the other; among its like it forks as they do.
  const std::vector<Measurements> plants{forkOf(5, 9), forkOf(5, 11), forkOf(5, 8), forkOf(6, 9)};
  EXPECT_EQ(plantStructure(plants[1]).branching, Branching::Monopodial);
  for (const PlantStructure& s : plantStructures(plants)) {
    EXPECT_EQ(s.branching, Branching::Sympodial);
    EXPECT_EQ(s.axes.size(), 3u);
  }
}

TEST(Structure, ArmsThatBothLeanUnlikeAStraightStemAreAFork) {
  EXPECT_EQ(plantStructure(forkOf(30, 70)).axes.size(), 3u);
  EXPECT_EQ(plantStructure(forkOf(8, 70)).axes.size(), 2u);
}

TEST(Structure, AStemClickedInTwoPiecesIsOneAxis) {
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}});
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{0, 2, 0.1}, {0, 3, 0.1}});
  EXPECT_EQ(plantStructure(measuredOf(plant)).axes.size(), 1u);
}

TEST(Circular, MeansAreOfDirectionsNotOfNumbers) {
  const CircularMean m = circularMeanOf(std::vector<double>{3.1, -3.1});
  EXPECT_NEAR(std::abs(m.mean), std::numbers::pi, 1e-12);
  EXPECT_GT(m.concentration, 0.99);
  const CircularMean two = circularMeanOf(std::vector<double>{0.1, 0.1 + std::numbers::pi}, std::numbers::pi);
  EXPECT_NEAR(two.mean, 0.1, 1e-12);
  std::vector<double> even;
  for (int i = 0; i < 60; ++i) even.push_back(2 * std::numbers::pi * i / 60);
  EXPECT_GT(circularMeanOf(even).chance, 0.9);
  EXPECT_LT(circularMeanOf(std::vector<double>(20, 1.0)).chance, 1e-6);
}

Phyllotaxis fitOf(const KnownRules& rules, OrgansAround organs) {
  const Measurements m = grownBy(rules, Rng(5));
  const PlantStructure s = plantStructure(m);
  return phyllotaxisOf(std::vector<MeasuredPlant>{{&m, &s}}, organs);
}

TEST(Phyllotaxis, FindsTheDivergenceWhateverTheAxisDoes) {
  for (const double divergence : {137.5, 99.5, 120.0, 144.0, 180.0, 77.0}) {
    SCOPED_TRACE(divergence);
    const Phyllotaxis fit = fitOf({.divergence_deg = divergence, .bend_deg = 4}, OrgansAround::Branches);
    EXPECT_NEAR(fit.divergence.degrees(), divergence, 1e-6);
    EXPECT_EQ(fit.perNode, 1);
  }
  EXPECT_EQ(fitOf({.divergence_deg = 180}, OrgansAround::Leaves).preset, "distichous");
  EXPECT_EQ(fitOf({.divergence_deg = 137.5}, OrgansAround::Leaves).preset, "spiral");
}

TEST(Phyllotaxis, PairsAndWhorlsTurnWithinTheirOwnPeriod) {
  const Phyllotaxis pairs = fitOf({.divergence_deg = 90, .leaves = 2}, OrgansAround::Leaves);
  EXPECT_EQ(pairs.perNode, 2);
  EXPECT_NEAR(pairs.divergence.degrees(), 90, 1e-6);
  EXPECT_EQ(pairs.preset, "decussate");
  const Phyllotaxis whorls = fitOf({.divergence_deg = 60, .leaves = 3}, OrgansAround::Leaves);
  EXPECT_EQ(whorls.perNode, 3);
  EXPECT_NEAR(whorls.divergence.degrees(), 60, 1e-6);
}

TEST(Phyllotaxis, LeavesAlongTheirStemHaveNoSide) {
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  const PlantDirection up = PlantDirection::up();
  plant.leaves.push_back({StemId{1}, {{0, 1, 0}}, up, PlantDirection::along({0, 0, 1}), 0.1, 0, ""});
  plant.leaves.push_back({StemId{1}, {{0, 2, 0}}, PlantDirection::along({0, -1, 0}), PlantDirection::along({0, 0, 1}), 0.1, 0, ""});
  const Measurements m = measuredOf(plant);
  const PlantStructure s = plantStructure(m);
  EXPECT_TRUE(std::isnan(s.leafAzimuths[0][0]));
  EXPECT_TRUE(std::isnan(s.leafAzimuths[1][0]));
  EXPECT_EQ(phyllotaxisOf(std::vector<MeasuredPlant>{{&m, &s}}, OrgansAround::Leaves).perNode, 0);
}

TEST(BranchingPattern, EveryThirdNode) {
  std::vector<glm::dvec3> trunk;
  for (int i = 0; i <= 18; ++i) trunk.push_back({0, i, 0});
  Skeleton plant = test::chainThrough(trunk);
  for (int node = 3; node <= 15; node += 3) test::addStem(plant, StemId{1}, NodeId{node}, std::vector<glm::dvec3>{{1, node, 0}});
  const Measurements m = measuredOf(plant);
  const PlantStructure s = plantStructure(m);
  const BranchingPattern p = patternOf(m, s);
  EXPECT_EQ(p.habit, BranchingHabit::EveryKth);
  EXPECT_EQ(p.period, 3);
  EXPECT_EQ(p.growthUnit, 3);
}

TEST(BranchingPattern, BranchesAtTheTopAreAcrotonicAndAtTheBaseBasitonic) {
  for (const bool top : {true, false}) {
    std::vector<glm::dvec3> trunk;
    for (int i = 0; i <= 20; ++i) trunk.push_back({0, i, 0});
    Skeleton plant = test::chainThrough(trunk);
    for (int k = 0; k < 6; ++k) {
      const int node = top ? 20 - k : 2 + k;
      test::addStem(plant, StemId{1}, NodeId{node}, std::vector<glm::dvec3>{{1, node, 0}});
    }
    const Measurements m = measuredOf(plant);
    const PlantStructure s = plantStructure(m);
    EXPECT_EQ(patternOf(m, s).habit, top ? BranchingHabit::Acrotonic : BranchingHabit::Basitonic);
  }
}

TEST(Subtrees, TheSameBranchAtAnotherPlaceAndSizeIsFound) {
  Skeleton plant = test::chainThrough(std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}});
  test::addStem(plant, StemId{1}, NodeId{2}, std::vector<glm::dvec3>{{0.5, 1.5, 0}, {1, 2.2, 0}});
  test::addStem(plant, StemId{1}, NodeId{3}, std::vector<glm::dvec3>{{0, 2.25, 0.25}, {0, 2.6, 0.5}});
  const Measurements m = measuredOf(plant);
  const PlantStructure s = plantStructure(m);
  const Repetition r = repetitionsOf(m, s);
  ASSERT_FALSE(r.exact.empty());
  EXPECT_EQ(r.exact.front().segments, 2u);
  EXPECT_EQ(r.exact.front().members.size(), 2u);
  EXPECT_TRUE(r.exact.front().scaled);
  EXPECT_NEAR(likeness(m, s, s.axes[1].base(), s.axes[2].base()), 1, 1e-12);
  EXPECT_LT(likeness(m, s, s.axes[0].base(), s.axes[2].base()), 0.7);
}

TEST(Subtrees, AlikeAxesAreGroupedWhereNumbersVary) {
  const Measurements m = grownBy({.stages = 10, .ending = 0}, Rng(8));
  const PlantStructure s = plantStructure(m);
  const auto groups = similarAxes(m, s, 0.6);
  ASSERT_FALSE(groups.empty());
  for (const auto& group : groups)
    for (const AxisId axis : group) EXPECT_EQ(s.at(axis).order, s.at(group.front()).order);
}

}  // namespace
}  // namespace axil::quantify
