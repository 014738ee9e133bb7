#include "emit/initial.hpp"

#include "base/turning.hpp"
#include "grown.hpp"
#include "simeco/derive.hpp"

#include <cmath>
#include <numbers>

namespace axil::emit {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

const EmitOptions kExact{.decimals = -1};

Skeleton randomPlant(Rng& rng, int i) {
  return test::randomTree(rng, {.segments = 5 + static_cast<int>(rng.below(30)),
                                .segmentLength = std::pow(10.0, rng.uniform(-2, 0)),
                                .wander = rng.uniform(),
                                .branching = rng.uniform(0, 0.7),
                                .leaves = static_cast<int>(rng.below(8)),
                                .collarBranches = i % 7 == 0 ? 2 : 0,
                                .radii = i % 3 != 0});
}

TEST(InitialGrammar, RegrowsTenThousandRandomTrees) {
  const std::uint64_t seed = 41;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  double worstExact = 0;
  double worstPrinted = 0;
  for (int i = 0; i < 10'000; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = randomPlant(rng, i);
    const GrownErrors exact = roundTrip(plant, kExact);
    ASSERT_LT(exact.direction_deg, 1e-9);
    ASSERT_LT(exact.leafDirection_deg, 1e-9);
    ASSERT_LT(exact.leafNormal_deg, 1e-9);
    ASSERT_EQ(exact.leaves, plant.leaves.size());
    const GrownErrors printed = roundTrip(plant);
    ASSERT_LT(printed.direction_deg, 3e-4);
    ASSERT_LT(printed.leafDirection_deg, 3e-4);
    ASSERT_LT(printed.leafNormal_deg, 3e-4);
    worstExact = std::max(worstExact, exact.direction_deg);
    worstPrinted = std::max(worstPrinted, printed.direction_deg);
  }
  std::cout << "worst direction: " << worstExact << " degrees with all digits, " << worstPrinted << " with six decimals\n";
}

TEST(InitialGrammar, KeepsEveryNodeWithinTwoHundredThousandthsOfTheHeight) {
  const std::uint64_t seed = 42;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = test::randomTree(rng, {.segments = 300, .segmentLength = std::pow(10.0, rng.uniform(-3, 1)), .wander = rng.uniform(0, 0.5),
                                                  .branching = rng.uniform(0, 0.5)});
    worst = std::max(worst, roundTrip(plant).node);
  }
  std::cout << "worst node: " << worst << " of the height\n";
  EXPECT_LT(worst, 2e-5);
}

TEST(InitialGrammar, TextReadsBackAsTheSameGrammarAndPrintsTheSameBytes) {
  const std::uint64_t seed = 43;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const auto m = valueOf(quantify::measure(randomPlant(rng, i)));
    const simeco::Grammar grammar = valueOf(initialGrammar(m, {.decimals = i % 2 == 0 ? 6 : -1}));
    const std::string text = simeco::print(grammar);
    const simeco::Parsed parsed = simeco::parseSimeco(text);
    ASSERT_TRUE(parsed.ok()) << complaints(grammar);
    ASSERT_EQ(parsed.grammar, grammar);
    ASSERT_EQ(simeco::print(parsed.grammar), text);
    ASSERT_EQ(complaints(grammar), "");
  }
}

std::vector<glm::dvec3> helix(int count, double size) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= count; ++i) points.push_back(glm::dvec3{0.1 * std::cos(0.3 * i), 0.001 * i, 0.1 * std::sin(0.3 * i)} * size);
  return points;
}

std::vector<glm::dvec3> zigzag(int count, double size) {
  std::vector<glm::dvec3> points{{0, 0, 0}};
  for (int i = 0; i < count; ++i) points.push_back(points.back() + glm::dvec3{i % 2 == 0 ? 0.0004 : -0.0004, 0.001, 0.0001} * size);
  return points;
}

std::vector<glm::dvec3> straightLine(int count, double size) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= count; ++i) points.push_back(glm::dvec3{0.3, 1, 0.2} * (size * i / count));
  return points;
}

TEST(InitialGrammar, DoesNotDriftAlongAThousandSegments) {
  for (const double size : {20.0, 1.0, 0.05, 0.003}) {
    SCOPED_TRACE(size);
    for (const auto& points : {helix(1000, size), zigzag(1000, size), straightLine(1000, size)}) {
      const GrownErrors errors = roundTrip(test::chainThrough(points));
      EXPECT_LT(errors.node, 2e-5);
      EXPECT_LT(errors.direction_deg, 3e-4);
      EXPECT_LT(roundTrip(test::chainThrough(points), kExact).node, 1e-6);
    }
  }
}

TEST(InitialGrammar, KeepsTheEndOfALongRunnerWhereItIs) {
  // Forty times as long as it is high: a constant error of direction within rounding would carry its end away.
  double worst = 0;
  for (int turn = 0; turn < 40; ++turn) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= 400; ++i) points.push_back(glm::dvec3{0.1 * i, 0.0001 * i, 0.00003 * i});
    points.push_back(points.back() + glm::dvec3{0.3, 1, 0.2});
    const Skeleton runner = test::turnedAboutY(test::chainThrough(points), Angle::fromDegrees(9.1 * turn));
    worst = std::max(worst, roundTrip(runner).node);
  }
  std::cout << "worst node of a runner: " << worst << " of its height\n";
  EXPECT_LT(worst, 5e-6);
}

TEST(InitialGrammar, GrowsStraightAndReversedAndVeryShortSegments) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}, {0, 0.4, 0}, {0, 0.400001, 0.000001}, {0.3, 0.4, 0}};
  Skeleton plant = test::chainThrough(points);
  const std::vector<glm::dvec3> back{{0, 0.2, 0}, {0.1, 0.2, 0}};
  const std::vector<glm::dvec3> on{{0, 0.7, 0}, {0, 0.7, 0.2}};
  test::addStem(plant, StemId{1}, NodeId{2}, back);
  test::addStem(plant, StemId{1}, NodeId{2}, on);
  for (const int decimals : {6, -1}) {
    const GrownErrors errors = roundTrip(plant, {.decimals = decimals});
    EXPECT_LT(errors.direction_deg, decimals < 0 ? 1e-9 : 3e-4);
    EXPECT_LT(errors.node, 2e-5);
  }
}

TEST(InitialGrammar, KeepsTheAzimuthOfAPlantThatIsTurned) {
  Rng rng(44);
  const Skeleton plant = test::turnedAboutY(test::randomTree(rng), 123_deg);
  EXPECT_LT(roundTrip(plant).direction_deg, 3e-4);
}

TEST(InitialGrammar, IsLaidOutLikeTheThesis) {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 0.2, 0}, {0, 0.4, 0}, {0, 0.5, 0.01}};
  Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> side{{0.1, 0.5, 0}};
  test::addStem(plant, StemId{1}, NodeId{3}, side);
  plant.nodes[0].radius = 0.006;
  plant.nodes[1].radius = 0.005;
  const std::string text = simeco::print(valueOf(initialGrammar(valueOf(quantify::measure(plant)), {.name = "twig"})));
  EXPECT_NE(text.find("EcoSystem 1.0 \"twig\" {"), std::string::npos) << text;
  EXPECT_NE(text.find("A(0) -> S(2) ;"), std::string::npos) << text;
  EXPECT_NE(text.find("S(2) -> S(0) A(10) ;"), std::string::npos) << text;
  EXPECT_NE(text.find("A(10) -> rotr(0.000000)rotu(0.000000)S(3) ;"), std::string::npos) << text;
  EXPECT_NE(text.find("S(3) -> S(0) [rotr(0.785398)rotu("), std::string::npos) << text;
  EXPECT_NE(text.find("BroadenRate = 0.500000;"), std::string::npos) << text;
  EXPECT_NE(text.find("GrowRate = 0.200000;"), std::string::npos) << text;
}

TEST(InitialGrammar, GrowsTheMeasuredRadiiAndLeafSizes) {
  Rng rng(45);
  const Skeleton plant = test::randomTree(rng);
  const auto m = valueOf(quantify::measure(plant));
  const simeco::Plant grown = grownUp(valueOf(initialGrammar(m)));
  const auto organs = segmentOrgans(grown, m.segments.size());
  for (std::size_t s = 0; s < m.segments.size(); ++s) EXPECT_NEAR(organs[s]->radius, *m.segments[s].radius, 1e-8);
  for (const simeco::Organ& organ : grown.organs) {
    if (organ.kind != simeco::OrganKind::Leaf) continue;
    EXPECT_EQ(grown.styleOf(organ).model, "ovate.i");
    EXPECT_NEAR(organ.radius, organ.length / 4, 1e-8);
  }
}

TEST(InitialGrammar, MakesUpRadiiThatTaperWhereNoneWereMeasured) {
  Rng rng(46);
  const auto m = valueOf(quantify::measure(test::randomTree(rng, {.radii = false})));
  const std::vector<double> radii = radiiOf(m, 1.0);
  EXPECT_NEAR(radii.front(), 0.012, 1e-12);
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    EXPECT_GT(radii[s], 0.001);
    if (!m.segments[s].parent) continue;
    EXPECT_LE(radii[s], radii[static_cast<std::size_t>(m.segments[s].parent->value)]);
  }
}

TEST(InitialGrammar, TheLiteralRuleWritesTheAnglesAsMeasured) {
  Rng rng(47);
  const auto m = valueOf(quantify::measure(test::randomTree(rng, {.leaves = 0}), {TurningRule::Literal}));
  const simeco::Grammar grammar = valueOf(initialGrammar(m, {.decimals = -1, .turning = TurningRule::Literal}));
  std::vector<double> written;
  for (const simeco::Production& rule : grammar.plants[0].rules.productions)
    for (const simeco::Module& module : rule.successors[0].modules)
      if (module.letter == "rotr") written.push_back(std::get<simeco::Number>(grammar.at(module.arguments[0]).node).value);
  std::vector<double> measured;
  for (std::size_t s = 1; s < m.segments.size(); ++s) measured.push_back(m.segments[s].rotr.radians());
  std::sort(written.begin(), written.end());
  std::sort(measured.begin(), measured.end());
  EXPECT_EQ(written, measured);
}

TEST(InitialGrammar, RefusesOptionsOutOfRangeAndEmptyMeasurements) {
  Rng rng(48);
  const auto m = valueOf(quantify::measure(test::randomTree(rng)));
  EXPECT_FALSE(initialGrammar(m, {.decimals = 13}));
  EXPECT_FALSE(initialGrammar(m, {.decimals = -2}));
  EXPECT_FALSE(initialGrammar(m, {.deriveTime = 0}));
  EXPECT_FALSE(initialGrammar(m, {.name = "a \"quoted\" name"}));
  const auto empty = initialGrammar({}, {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::NoAnswer);
}

}  // namespace
}  // namespace axil::emit
