#include "emit/predictive.hpp"

#include "grown.hpp"
#include "quantify/leaves.hpp"
#include "simeco/derive.hpp"

#include <cmath>
#include <numbers>
#include <set>

namespace axil::emit {
namespace {

using quantify::Measurements;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

struct Both {
  Measurements measured;
  simeco::Grammar initial;
  simeco::Grammar predictive;
};

Both bothOf(const Skeleton& plant) {
  Both both;
  both.measured = valueOf(quantify::measure(plant));
  both.initial = valueOf(initialGrammar(both.measured));
  both.predictive = valueOf(predictiveGrammar(both.measured, {}, {.style = PredictiveStyle::Thesis}));
  return both;
}

double settledTime(const simeco::Grammar& grammar) { return simeco::completeTime(valueOf(simeco::prepareGrowth(grammar))); }

/// Organs as (kind, stage, base, direction, length): what can be seen of a plant.
void expectSamePlant(const simeco::Plant& a, const simeco::Plant& b) {
  ASSERT_EQ(a.organs.size(), b.organs.size());
  for (std::size_t i = 0; i < a.organs.size(); ++i) {
    ASSERT_EQ(a.organs[i].kind, b.organs[i].kind);
    ASSERT_EQ(a.styleOf(a.organs[i]).stage, b.styleOf(b.organs[i]).stage);
    ASSERT_EQ(a.organs[i].base, b.organs[i].base);
    ASSERT_EQ(a.organs[i].direction, b.organs[i].direction);
    ASSERT_EQ(a.organs[i].length, b.organs[i].length);
    ASSERT_EQ(a.organs[i].radius, b.organs[i].radius);
  }
}

/// Steps of the predictive derivation in which an apex of the prediction stands in the string.
std::set<std::int64_t> wakingSteps(const simeco::Grammar& grammar) {
  std::set<std::int64_t> steps;
  const auto whole = valueOf(simeco::derive(grammar));
  for (std::int64_t step = 1; step <= static_cast<std::int64_t>(whole.modulesPerStep.size()); ++step) {
    const auto derived = valueOf(simeco::derive(grammar, {.steps = step}));
    for (const simeco::ModuleView module : derived.string)
      if (module.letter == "A" && module.parameters[0] >= 1000) steps.insert(step);
  }
  return steps;
}

TEST(ThesisPrediction, IsTheInitialPlantUntilTheCountersHaveRunOut) {
  const std::uint64_t seed = 51;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Both both = bothOf(test::randomTree(rng, {.segments = 25, .collarBranches = i % 3}));
    const auto initial = valueOf(simeco::prepareGrowth(both.initial));
    const auto predictive = valueOf(simeco::prepareGrowth(both.predictive));
    const double complete = simeco::completeTime(initial);
    for (int k = 0; k <= 20; ++k) expectSamePlant(valueOf(simeco::plantAt(initial, complete * k / 20)), valueOf(simeco::plantAt(predictive, complete * k / 20)));
  }
}

TEST(ThesisPrediction, EveryTipGoesOnInTheSameStepAndThenItEnds) {
  const std::uint64_t seed = 52;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Both both = bothOf(test::randomTree(rng, {.segments = 20}));
    EXPECT_EQ(wakingSteps(both.predictive).size(), 1u);
    const auto derived = valueOf(simeco::derive(both.predictive));
    EXPECT_TRUE(derived.settled);
    EXPECT_GT(settledTime(both.predictive), settledTime(both.initial));

    std::size_t tips = 0;
    for (const auto& s : both.measured.segments) tips += s.children.empty();
    const auto stems = [](const simeco::Plant& plant) {
      return static_cast<std::size_t>(std::count_if(plant.organs.begin(), plant.organs.end(), [](const simeco::Organ& o) { return o.kind == simeco::OrganKind::Stem && o.length > 1e-6; }));
    };
    EXPECT_GE(stems(grownUp(both.predictive)), stems(grownUp(both.initial)) + tips);
  }
}

TEST(ThesisPrediction, DrawsWithinTheMeasuredRanges) {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 0.2, 0}, {0.02, 0.4, 0}, {0.02, 0.6, 0.03}};
  Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> low{{0.1, 0.3, 0}, {0.2, 0.4, 0.02}};
  const std::vector<glm::dvec3> high{{-0.12, 0.5, 0}};
  test::addStem(plant, StemId{1}, NodeId{2}, low);
  test::addStem(plant, StemId{1}, NodeId{3}, high);
  const Both both = bothOf(plant);
  const auto segments = both.measured.segments.size();
  double least = std::numbers::pi;
  double most = 0;
  for (const auto& s : both.measured.segments) {
    if (s.kind != quantify::SegmentKind::Branch) continue;
    least = std::min(least, s.rotr.radians());
    most = std::max(most, s.rotr.radians());
  }
  std::set<double> seen;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const simeco::Plant grown = grownUp(both.predictive, {.seed = seed});
    for (const simeco::Organ& organ : grown.organs) {
      const bool predicted = organ.kind == simeco::OrganKind::Stem && grown.styleOf(organ).stage >= kFirstSegmentStage + static_cast<int>(segments);
      if (!predicted || !organ.branch) continue;
      const double rotr = angleBetween(grown.at(*organ.parent).direction, organ.direction).radians();
      EXPECT_GE(rotr, least - 1e-6);
      EXPECT_LE(rotr, most + 1e-6);
      seen.insert(rotr);
    }
  }
  EXPECT_GT(seen.size(), 50u);
}

TEST(ThesisPrediction, IsWrittenAsTheThesisWritesIt) {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 0.2, 0}, {0, 0.4, 0.01}};
  Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> side{{0.1, 0.3, 0}};
  test::addStem(plant, StemId{1}, NodeId{2}, side);
  const std::string text = simeco::print(bothOf(plant).predictive);
  EXPECT_NE(text.find("EcoSystem 1.1"), std::string::npos);
  EXPECT_NE(text.find("S(3) -> S(1002) S(5003) ;"), std::string::npos) << text;
  EXPECT_NE(text.find("S(i) -> S(i+1, 1001 < i < 1003) ;"), std::string::npos) << text;
  EXPECT_NE(text.find("S(1003) > S(5003) -> A(1003) ;"), std::string::npos) << text;
}

TEST(ThesisPrediction, ParsesAndChecksWithoutAComplaint) {
  const std::uint64_t seed = 53;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 50; ++i) {
    const Both both = bothOf(test::randomTree(rng));
    EXPECT_EQ(complaints(both.predictive), "");
    const simeco::Parsed parsed = simeco::parseSimeco(simeco::print(both.predictive));
    EXPECT_EQ(parsed.grammar, both.predictive);
  }
}

TEST(ThesisPrediction, KeepsItsNumbersApartFromThoseOfALongStem) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= 1500; ++i) points.push_back({0.001 * (i % 2), 0.001 * i, 0});
  const Both both = bothOf(test::chainThrough(points));
  const simeco::Plant initial = grownUp(both.initial);
  const simeco::Plant predicted = grownUp(both.predictive);
  EXPECT_EQ(predicted.organs.size(), initial.organs.size() + 1);
}

TEST(PredictiveGrammar, RefusesAPlantThatShowsNothing) {
  const std::vector<glm::dvec3> stick{{0, 0, 0}, {0, 0.2, 0}};
  const auto m = valueOf(quantify::measure(test::chainThrough(stick)));
  for (const PredictiveStyle style : {PredictiveStyle::Layered, PredictiveStyle::Thesis}) {
    const auto result = predictiveGrammar(m, {}, {.style = style});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::NoAnswer);
  }
}

TEST(PredictiveGrammar, RefusesStagesOutOfRangeAndWhatTheThesisDoesNotHave) {
  const std::vector<glm::dvec3> stem{{0, 0, 0}, {0, 0.2, 0}, {0, 0.4, 0}};
  const auto m = valueOf(quantify::measure(test::chainThrough(stem)));
  EXPECT_FALSE(predictiveGrammar(m, {}, {.stages = 0}));
  EXPECT_FALSE(predictiveGrammar(m, {}, {.stages = kMostStages + 1}));
  EXPECT_FALSE(predictiveGrammar(m, {}, {.style = PredictiveStyle::Thesis, .stages = 2}));
  EXPECT_FALSE(predictiveGrammar(m, {}, {.style = PredictiveStyle::Thesis, .also = {m}}));
}

/// The organs that have a length, without those of growing points: (kind, base, direction, length).
void expectSameShape(const simeco::Plant& a, const simeco::Plant& b) {
  const auto seen = [](const simeco::Plant& plant) {
    std::vector<const simeco::Organ*> organs;
    for (const simeco::Organ& o : plant.organs)
      if (o.length > 1e-6) organs.push_back(&o);
    return organs;
  };
  const auto x = seen(a);
  const auto y = seen(b);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(x[i]->kind, y[i]->kind);
    ASSERT_EQ(x[i]->base, y[i]->base);
    ASSERT_EQ(x[i]->direction, y[i]->direction);
    ASSERT_NEAR(x[i]->length, y[i]->length, 1e-9 * x[i]->length);
    ASSERT_NEAR(x[i]->radius, y[i]->radius, 1e-9 * x[i]->radius);
  }
}

TEST(PredictiveGrammar, AtTheMeasuredTimeIsTheMeasuredPlant) {
  const std::uint64_t seed = 54;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Measurements m = valueOf(quantify::measure(test::randomTree(rng, {.segments = 25, .collarBranches = i % 3})));
    const simeco::Grammar initial = valueOf(initialGrammar(m));
    const simeco::Grammar predictive = valueOf(predictiveGrammar(m, {}, {.stages = 3}));
    EXPECT_EQ(complaints(predictive), "");
    EXPECT_EQ(simeco::parseSimeco(simeco::print(predictive)).grammar, predictive);
    const double measured = settledTime(initial);
    expectSameShape(valueOf(simeco::plantAt(valueOf(simeco::prepareGrowth(initial)), measured)), valueOf(simeco::plantAt(valueOf(simeco::prepareGrowth(predictive)), measured)));
  }
}

/// A trunk of `nodes` nodes with a straight branch at each, as long as the trunk above it.
Skeleton cone(int nodes) {
  std::vector<glm::dvec3> trunk;
  for (int i = 0; i <= nodes; ++i) trunk.push_back({0, 0.1 * i, 0});
  Skeleton plant = test::chainThrough(trunk);
  for (int i = 1; i < nodes; ++i) {
    std::vector<glm::dvec3> side;
    const double a = 2.4 * i;
    for (int k = 1; k <= nodes - i; ++k) side.push_back({0.08 * k * std::cos(a), 0.1 * i + 0.05 * k, 0.08 * k * std::sin(a)});
    test::addStem(plant, StemId{1}, NodeId{i + 1}, side);
  }
  return plant;
}

std::size_t stemsOf(const simeco::Plant& plant) {
  return static_cast<std::size_t>(std::count_if(plant.organs.begin(), plant.organs.end(), [](const simeco::Organ& o) { return o.kind == simeco::OrganKind::Stem && o.length > 1e-6; }));
}

TEST(PredictiveGrammar, EveryStageAddsWhatTheRuleOfThePlantAdds) {
  const Measurements m = valueOf(quantify::measure(cone(6)));
  for (const int stages : {1, 2, 5}) {
    // The same rule grown on: a trunk of more nodes.
    const std::size_t expected = valueOf(quantify::measure(cone(6 + stages))).segments.size();
    EXPECT_EQ(stemsOf(grownUp(valueOf(predictiveGrammar(m, {}, {.stages = stages})))), expected) << stages;
  }
}

/// A trunk of `nodes` nodes with a straight branch at every third, whose segments are as long as the law says for the stage in which they were made; branches a half of it.
Skeleton byAge(int nodes, double (*law)(int)) {
  std::vector<glm::dvec3> trunk{{0, 0, 0}};
  for (int i = 0; i < nodes; ++i) trunk.push_back(trunk.back() + glm::dvec3{0, law(i), 0});
  Skeleton plant = test::chainThrough(trunk);
  for (int i = 1; i < nodes; i += 3) {
    const double a = 2.4 * i;
    std::vector<glm::dvec3> side;
    glm::dvec3 at = trunk[static_cast<std::size_t>(i)];
    for (int stage = i; stage < nodes; ++stage) side.push_back(at += 0.5 * law(stage) * glm::dvec3{0.6 * std::cos(a), 0.8, 0.6 * std::sin(a)});
    test::addStem(plant, StemId{1}, NodeId{i + 1}, side);
  }
  return plant;
}

TEST(PredictiveGrammar, LengthsGoOnByTheLawOfThePlantsAge) {
  struct Law {
    const char* name;
    double (*at)(int stage);
  };
  const Law laws[] = {{"rise to a level", [](int i) { return 0.1 * (1 - 0.9 * std::exp(-i / 3.0)); }},
                      {"rise by the logistic law", [](int i) { return 0.1 / (1 + std::exp(5.0 - i)); }},
                      {"fall by the logistic law", [](int i) { return 0.1 / (1 + std::exp((i - 9.0) / 1.5)); }},
                      {"rise by Gompertz' law", [](int i) { return 0.1 * std::exp(-3 * std::exp(-i / 3.0)); }},
                      {"fall to a level", [](int i) { return 0.03 + 0.1 * std::exp(-i / 3.0); }},
                      {"swell and dwindle", [](int i) { return 0.1 * std::exp(-(i - 6) * (i - 6) / 30.0); }}};
  constexpr int kMeasured = 12, kAhead = 4;
  for (const Law& law : laws) {
    SCOPED_TRACE(law.name);
    const Measurements m = valueOf(quantify::measure(byAge(kMeasured, law.at)));
    const simeco::Plant plant = grownUp(valueOf(predictiveGrammar(m, {}, {.stages = kAhead})));
    // What the trunk and its branches add in each stage, in one heap: every new length is that of one of the stages, of a trunk or of a branch.
    const auto measured = segmentOrgans(plant, m.segments.size());
    std::vector<double> fresh;
    for (const simeco::Organ& o : plant.organs)
      if (o.kind == simeco::OrganKind::Stem && o.length > 1e-6 && std::find(measured.begin(), measured.end(), &o) == measured.end()) fresh.push_back(o.length);
    const auto perStage = fresh.size() / kAhead;
    EXPECT_GE(perStage, 5u);
    std::vector<double> expected;
    for (int stage = kMeasured; stage < kMeasured + kAhead; ++stage) expected.insert(expected.end(), {law.at(stage), 0.5 * law.at(stage)});
    for (const double length : fresh) {
      double nearest = 1;
      for (const double e : expected) nearest = std::min(nearest, std::abs(length / e - 1));
      EXPECT_LT(nearest, 0.01) << length;
    }
    for (const double e : expected) EXPECT_TRUE(std::any_of(fresh.begin(), fresh.end(), [e](double length) { return std::abs(length / e - 1) < 0.01; })) << "none of " << e;
  }
}

TEST(PredictiveGrammar, NoPathGetsLongerThanSaid) {
  const std::uint64_t seed = 55;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 20; ++i) {
    const Measurements m = valueOf(quantify::measure(test::randomTree(rng, {.segments = 20, .leaves = 0})));
    int depth = 0;
    for (const auto& s : m.segments) depth = std::max(depth, s.level + 1);
    const simeco::Plant plant = grownUp(valueOf(predictiveGrammar(m, {}, {.stages = 4})), {.seed = static_cast<std::uint64_t>(i)});
    std::vector<int> levels(plant.organs.size(), 0);
    for (std::size_t o = 0; o < plant.organs.size(); ++o) {
      const auto& organ = plant.organs[o];
      const int below = organ.parent ? levels[static_cast<std::size_t>(organ.parent->value)] : 0;
      levels[o] = below + (organ.length > 1e-6 ? 1 : 0);
      EXPECT_LE(levels[o], depth + 4);
    }
  }
}

TEST(PredictiveGrammar, WhatOtherPlantsShowCounts) {
  const std::vector<glm::dvec3> stem{{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0}, {0, 0.3, 0}};
  const Measurements bare = valueOf(quantify::measure(test::chainThrough(stem)));
  const Measurements branched = valueOf(quantify::measure(cone(6)));
  EXPECT_EQ(stemsOf(grownUp(valueOf(predictiveGrammar(bare)))), 4u);
  EXPECT_GT(stemsOf(grownUp(valueOf(predictiveGrammar(bare, {}, {.stages = 3, .also = {branched, branched}})), {.seed = 3})), 6u);
}

TEST(PredictiveGrammar, YoungLeavesGoOnGrowingToTheUsualSize) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= 8; ++i) points.push_back({0, 0.1 * i, 0});
  Skeleton plant = test::chainThrough(points);
  for (int i = 1; i <= 8; ++i) {
    const double length = std::min(0.1, 0.025 * (9 - i));  // the last four are still growing
    const double a = 2.4 * i;
    const PlantDirection out = PlantDirection::along({std::cos(a), 0.5, std::sin(a)});
    plant.leaves.push_back({StemId{1}, {{0, 0.1 * i, 0}}, out, perpendicularTo(out, PlantDirection::up()), length, length / 2, "ovate"});
  }
  const Measurements m = valueOf(quantify::measure(plant));
  const simeco::Plant grown = grownUp(valueOf(predictiveGrammar(m, {}, {.stages = 5})));
  std::size_t full = 0;
  std::size_t leaves = 0;
  for (const simeco::Organ& o : grown.organs) {
    if (o.kind != simeco::OrganKind::Leaf) continue;
    ++leaves;
    full += std::abs(o.length - 0.1) < 1e-3;
  }
  EXPECT_EQ(leaves, 13u);
  EXPECT_EQ(full, 13u);
}

enum class Branches { None, OfTwoLengths };
/// A stem of ten segments, with branches of seven and five if wanted; only the youngest four nodes of each bear a leaf.
Skeleton withYoungLeavesOnly(Branches branches) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= 10; ++i) points.push_back({0, 0.1 * i, 0});
  Skeleton plant = test::chainThrough(points);
  const auto leaf = [&plant](int stem, glm::dvec3 at, int i) {
    const PlantDirection out = PlantDirection::along({std::cos(2.4 * i), 0.5, std::sin(2.4 * i)});
    plant.leaves.push_back({StemId{stem}, {at}, out, perpendicularTo(out, PlantDirection::up()), 0.1, 0.05, "ovate"});
  };
  for (int i = 7; i <= 10; ++i) leaf(1, {0, 0.1 * i, 0}, i);
  if (branches == Branches::None) return plant;
  for (const int length : {7, 5}) {
    const double base = 0.1 * (10 - length), out = length == 7 ? 0.06 : -0.06;
    std::vector<glm::dvec3> side;
    for (int k = 1; k <= length; ++k) side.push_back({out * k, base + 0.06 * k, 0});
    test::addStem(plant, StemId{1}, NodeId{10 - length + 1}, side);
    for (int k = length - 3; k <= length; ++k) leaf(plant.stems.back().id.value, side[static_cast<std::size_t>(k - 1)], k);
  }
  return plant;
}
std::ptrdiff_t leavesAfter(int stages, const Skeleton& plant) {
  const Measurements m = valueOf(quantify::measure(plant));
  const simeco::Growth growth = valueOf(simeco::prepareGrowth(valueOf(predictiveGrammar(m, {}, {.stages = stages}))));
  const simeco::Plant grown = valueOf(simeco::plantAt(growth, simeco::completeTime(growth)));
  return std::count_if(grown.organs.begin(), grown.organs.end(), [](const simeco::Organ& o) { return o.kind == simeco::OrganKind::Leaf; });
}

TEST(PredictiveGrammar, OldLeavesFall) {
  // Branches of two lengths tell that old nodes are bare, not low ones: of the twelve measured leaves and what six stages add no axis keeps more than five.
  const Measurements m = valueOf(quantify::measure(withYoungLeavesOnly(Branches::OfTwoLengths)));
  const simeco::Grammar grammar = valueOf(predictiveGrammar(m, {}, {.stages = 6}));
  const simeco::Growth growth = valueOf(simeco::prepareGrowth(grammar));
  const simeco::Plant grown = valueOf(simeco::plantAt(growth, simeco::completeTime(growth)));
  std::map<std::int32_t, int> leaves;  // by the stem organ that bears them
  for (const simeco::Organ& o : grown.organs)
    if (o.kind == simeco::OrganKind::Leaf && o.parent) ++leaves[o.parent->value];
  const auto stems = std::count_if(grown.organs.begin(), grown.organs.end(), [](const simeco::Organ& o) { return o.kind == simeco::OrganKind::Stem; });
  EXPECT_GE(stems, 22 + 18);
  EXPECT_LE(leaves.size(), static_cast<std::size_t>(stems) - 22);  // the measured segments are bare by then
  EXPECT_GE(leaves.size(), 9u);
}

TEST(PredictiveGrammar, LeavesStayWhereNothingTellsThatTheyFall) {
  // On one stem the bare nodes may be those that never had a leaf: four stay, six come.
  EXPECT_EQ(leavesAfter(6, withYoungLeavesOnly(Branches::None)), 10);
}

TEST(PredictiveGrammar, AxesThatEndAtTheSameRankEndThereAgain) {
  std::vector<glm::dvec3> trunk;
  for (int i = 0; i <= 10; ++i) trunk.push_back({0, 0.1 * i, 0});
  Skeleton plant = test::chainThrough(trunk);
  for (int i = 1; i <= 9; ++i) {
    std::vector<glm::dvec3> side;
    for (int k = 1; k <= std::min(2, 10 - i); ++k) side.push_back({0.05 * k, 0.1 * i + 0.03 * k, 0.01 * i});
    test::addStem(plant, StemId{1}, NodeId{i + 1}, side);
  }
  const Measurements m = valueOf(quantify::measure(plant));
  const std::size_t before = m.segments.size();
  // A stage adds one to the trunk, one to the youngest branch, and one new branch.
  EXPECT_EQ(stemsOf(grownUp(valueOf(predictiveGrammar(m)))), before + 3);
  EXPECT_EQ(stemsOf(grownUp(valueOf(predictiveGrammar(m, {}, {.stages = 4})))), before + 12);
}

}  // namespace
}  // namespace axil::emit
