#include "emit/predictive.hpp"

#include "grown.hpp"
#include "quantify/leaves.hpp"
#include "simeco/derive.hpp"

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
  both.predictive = valueOf(predictiveGrammar(both.measured));
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

TEST(PredictiveGrammar, IsTheInitialPlantUntilTheCountersHaveRunOut) {
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

TEST(PredictiveGrammar, EveryTipGoesOnInTheSameStepAndThenItEnds) {
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

TEST(PredictiveGrammar, DrawsWithinTheMeasuredRanges) {
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

TEST(PredictiveGrammar, IsWrittenAsTheThesisWritesIt) {
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

TEST(PredictiveGrammar, ParsesAndChecksWithoutAComplaint) {
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

TEST(PredictiveGrammar, KeepsItsNumbersApartFromThoseOfALongStem) {
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
  const auto result = predictiveGrammar(m);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::NoAnswer);
}

}  // namespace
}  // namespace axil::emit
