#include "quantify/measure.hpp"

#include "base/turning.hpp"
#include "quantify/csv.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

namespace axil::quantify {
namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::StemId;

/// A trunk of two segments; at its middle node one child goes on almost straight and two branch off.
Skeleton forkedPlant() {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 0.2, 0}, {0.02, 0.4, 0}};
  Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> right{{0.1, 0.3, 0}};
  const std::vector<glm::dvec3> back{{0, 0.25, -0.2}, {0, 0.3, -0.4}};
  test::addStem(plant, StemId{1}, NodeId{2}, right);
  test::addStem(plant, StemId{1}, NodeId{2}, back);
  return plant;
}

Measurements measured(const Skeleton& skeleton, TurningRule rule = TurningRule::Exact) {
  auto result = measure(skeleton, {rule});
  EXPECT_TRUE(result) << result.error().message;
  return std::move(*result);
}

std::string refusal(const Skeleton& skeleton) {
  const auto result = measure(skeleton);
  if (result) return "";
  std::string all = result.error().message;
  for (const std::string& line : result.error().details) all += "\n" + line;
  return all;
}

TEST(Measure, FollowsTheFourStepsOnAForkedPlant) {
  const Measurements m = measured(forkedPlant());
  ASSERT_EQ(m.segments.size(), 5u);
  const Segment& root = m.segments[0];
  EXPECT_EQ(root.kind, SegmentKind::Root);
  EXPECT_DOUBLE_EQ(root.length, 0.2);
  EXPECT_EQ(root.level, 0);
  ASSERT_EQ(root.children.size(), 3u);

  const Segment& main = m.at(root.children.back());
  EXPECT_EQ(main.kind, SegmentKind::Main);
  EXPECT_EQ(main.stem, StemId{1});
  EXPECT_EQ(main.level, 1);
  EXPECT_NEAR(main.rotr.radians(), std::atan2(0.02, 0.2), 1e-12);

  const Segment& steep = m.at(root.children[0]);
  const Segment& flat = m.at(root.children[1]);
  EXPECT_EQ(steep.stem, StemId{2});
  EXPECT_EQ(flat.stem, StemId{3});
  EXPECT_NEAR(steep.rotr.degrees(), 45, 1e-9);
  EXPECT_NEAR(flat.rotr.radians(), std::atan2(0.2, 0.05), 1e-12);
  EXPECT_EQ(m.segments[4].level, 2);
  EXPECT_EQ(m.segments[4].kind, SegmentKind::Main);
}

TEST(Measure, BranchAxesArePerpendicularToTheirSegments) {
  const Measurements m = measured(forkedPlant());
  for (const Segment& s : m.segments) EXPECT_NEAR(glm::dot(s.rAxis.unit(), s.direction.unit()), 0, 1e-12);
}

TEST(Measure, EquallyNearChildrenMakeTheSmallerIdTheMainOne) {
  // A leaning trunk, so that the two equal angles are not equal in every bit.
  const glm::dvec3 along{0.05, 0.2, 0.03};
  const glm::dvec3 aside = glm::cross(along, glm::dvec3{0.2, 0.1, 0.7});
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, along, along * 1.5 + aside};
  Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> twin{along * 1.5 - aside};
  test::addStem(plant, StemId{1}, NodeId{2}, twin);
  for (int turn = 0; turn < 36; ++turn) {
    const Measurements m = measured(test::turnedAboutY(plant, Angle::fromDegrees(10 * turn)));
    EXPECT_EQ(m.segments[1].stem, StemId{1});
    EXPECT_EQ(m.segments[1].kind, SegmentKind::Main);
    EXPECT_EQ(m.segments[2].kind, SegmentKind::Branch);
  }
}

TEST(Measure, TurningThePlantAboutYChangesNoLengthAndNoRotr) {
  const std::uint64_t seed = 21;
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 300; ++i) {
    const Skeleton plant = test::randomTree(rng);
    const Measurements before = measured(plant);
    const Measurements after = measured(test::turnedAboutY(plant, Angle::fromRadians(rng.uniform(-3, 3))));
    ASSERT_EQ(before.segments.size(), after.segments.size());
    for (std::size_t s = 0; s < before.segments.size(); ++s) {
      ASSERT_NEAR(before.segments[s].length, after.segments[s].length, 1e-14);
      ASSERT_NEAR(before.segments[s].rotr.radians(), after.segments[s].rotr.radians(), 1e-12);
      ASSERT_EQ(before.segments[s].kind, after.segments[s].kind);
    }
  }
}

TEST(Measure, TheOrderOfNodesAndStemsChangesNothing) {
  const std::uint64_t seed = 22;
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 300; ++i) {
    const Skeleton plant = test::randomTree(rng);
    EXPECT_EQ(segmentsCsv(measured(plant)), segmentsCsv(measured(test::shuffled(plant, rng))));
  }
}

TEST(Measure, TheMeasuredTurnsRegrowEveryDirection) {
  const std::uint64_t seed = 23;
  SCOPED_TRACE(seed);
  Rng rng(seed);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const Measurements m = measured(test::randomTree(rng, {.segments = 60, .collarBranches = i % 3}));
    std::vector<StemFrame> frames{firstFrame(m.segments[0].direction)};
    for (std::size_t s = 1; s < m.segments.size(); ++s) {
      const Segment& segment = m.segments[s];
      const StemFrame& parent = frames[segment.parent ? static_cast<std::size_t>(segment.parent->value) : 0];
      frames.push_back(childFrame(parent, {segment.rotr, segment.rotu}, segment.kind == SegmentKind::Main ? ChildKind::Main : ChildKind::Branch));
      worst = std::max(worst, angleBetween(frames.back().direction, segment.direction).degrees());
      for (const LeafMeasure& leaf : segment.leaves) {
        const StemFrame blade = childFrame(frames.back(), {leaf.rotr, leaf.rotu}, ChildKind::Branch);
        worst = std::max(worst, angleBetween(blade.direction, leaf.direction).degrees());
        worst = std::max(worst, angleBetween(turned(blade.adaxial, blade.direction, leaf.roll), leaf.normal).degrees());
      }
    }
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(Measure, TheLiteralRuleOfTheThesisDoesNotRegrowBranches) {
  const std::uint64_t seed = 24;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  double sum = 0;
  std::size_t count = 0;
  for (int i = 0; i < 200; ++i) {
    const Measurements m = measured(test::randomTree(rng), TurningRule::Literal);
    std::vector<StemFrame> frames{{m.segments[0].direction, m.segments[0].rAxis, m.segments[0].rAxis}};
    for (std::size_t s = 1; s < m.segments.size(); ++s) {
      const Segment& segment = m.segments[s];
      frames.push_back(childFrame(frames[static_cast<std::size_t>(segment.parent->value)], {segment.rotr, segment.rotu},
                                  segment.kind == SegmentKind::Main ? ChildKind::Main : ChildKind::Branch, TurningRule::Literal));
      sum += angleBetween(frames.back().direction, segment.direction).degrees();
      ++count;
    }
  }
  const double mean = sum / static_cast<double>(count);
  std::cout << "the literal rule errs by " << mean << " degrees on average\n";
  EXPECT_GT(mean, 10);
}

TEST(Measure, TheLiteralRuleMakesTheFirstRotuZero) {
  const Measurements m = measured(test::turnedAboutY(forkedPlant(), 77_deg), TurningRule::Literal);
  EXPECT_NEAR(m.segments[1].rotu.radians(), 0, 1e-9);
}

TEST(Measure, StraightChildrenHaveRotrZeroAndReversedOnesHalfATurn) {
  const std::vector<glm::dvec3> straight{{0, 0, 0}, {0, 0.1, 0}, {0, 0.3, 0}};
  EXPECT_EQ(measured(test::chainThrough(straight)).segments[1].rotr, Angle{});
  const std::vector<glm::dvec3> back{{0, 0, 0}, {0, 0.3, 0}, {0, 0.1, 0}};
  EXPECT_NEAR(measured(test::chainThrough(back)).segments[1].rotr.radians(), std::numbers::pi, 1e-15);
}

TEST(Measure, ALeafAtTheCollarAndABranchAtTheCollarAreMeasuredAgainstTheFirstSegment) {
  Skeleton plant = forkedPlant();
  const std::vector<glm::dvec3> tiller{{0.1, 0.1, 0}};
  test::addStem(plant, StemId{1}, NodeId{1}, tiller);
  skeleton3d::Leaf leaf;
  leaf.stem = StemId{1};
  leaf.direction = PlantDirection::along({0, 1, 1});
  leaf.normal = PlantDirection::along({0, 1, -1});
  leaf.length = 0.05;
  plant.leaves.push_back(leaf);
  const Measurements m = measured(plant);
  EXPECT_EQ(m.segments[0].kind, SegmentKind::Root);
  EXPECT_EQ(m.segments[0].stem, StemId{1});
  EXPECT_EQ(m.segments[1].stem, StemId{4});
  EXPECT_EQ(m.segments[1].kind, SegmentKind::Branch);
  EXPECT_FALSE(m.segments[1].parent);
  EXPECT_NEAR(m.segments[1].rotr.degrees(), 45, 1e-9);
  ASSERT_EQ(m.rootLeaves.size(), 1u);
  EXPECT_NEAR(m.rootLeaves[0].rotr.degrees(), 45, 1e-9);
}

TEST(Measure, AStalkIsTheGapBetweenNodeAndBlade) {
  Skeleton plant = forkedPlant();
  skeleton3d::Leaf leaf;
  leaf.stem = StemId{1};
  leaf.direction = PlantDirection::along({1, 0, 0});
  leaf.normal = PlantDirection::up();
  leaf.position.at = glm::dvec3{0.02, 0.4, 0} + leaf.direction.unit() * 0.03;
  leaf.length = 0.05;
  plant.leaves.push_back(leaf);
  const Measurements m = measured(plant);
  const auto tip = std::find_if(m.segments.begin(), m.segments.end(), [](const Segment& s) { return !s.leaves.empty(); });
  ASSERT_NE(tip, m.segments.end());
  EXPECT_EQ(tip->to, NodeId{3});
  EXPECT_NEAR(tip->leaves[0].petiole, 0.03, 1e-15);
}

TEST(Measure, RadiusIsTheUpperNodesElseTheLowerOnes) {
  Skeleton plant = forkedPlant();
  plant.nodes[1].radius = 0.01;
  const Measurements m = measured(plant);
  EXPECT_EQ(m.segments[0].radius, 0.01);
  EXPECT_EQ(m.segments[1].radius, 0.01);
  EXPECT_FALSE(m.segments[4].radius);
}

TEST(Measure, RefusesWhatIsNoTree) {
  Skeleton cycle = forkedPlant();
  cycle.stems[2].nodes.push_back(NodeId{3});
  EXPECT_NE(refusal(cycle).find("reached by stem 1 and by stem 3"), std::string::npos) << refusal(cycle);

  Skeleton home = forkedPlant();
  home.stems[2].nodes.push_back(NodeId{1});
  EXPECT_NE(refusal(home).find("comes back to the root"), std::string::npos);

  Skeleton apart = forkedPlant();
  apart.stems[2].nodes.erase(apart.stems[2].nodes.begin());
  EXPECT_NE(refusal(apart).find("stem 3"), std::string::npos) << refusal(apart);

  Skeleton twoRoots = forkedPlant();
  twoRoots.stems[2].parent.reset();
  EXPECT_NE(refusal(twoRoots).find("2 stems without a parent"), std::string::npos);

  Skeleton oneNode = forkedPlant();
  oneNode.stems[1].nodes.resize(1);
  EXPECT_NE(refusal(oneNode).find("at least two"), std::string::npos);

  Skeleton stranger = forkedPlant();
  stranger.stems[1].nodes.back() = NodeId{99};
  EXPECT_NE(refusal(stranger).find("node 99, which does not exist"), std::string::npos);

  Skeleton twins = forkedPlant();
  twins.nodes[2].id = NodeId{2};
  EXPECT_NE(refusal(twins).find("node 2 is there twice"), std::string::npos);
  EXPECT_NE(refusal(Skeleton{}), "");
}

TEST(Measure, RefusesSegmentsWithoutLengthAndNumbersThatAreNone) {
  Skeleton same = forkedPlant();
  same.nodes[2].position = same.nodes[1].position;
  const auto result = measure(same);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::NoAnswer);
  EXPECT_NE(result.error().message.find("nodes 2 and 3"), std::string::npos);

  Skeleton nan = forkedPlant();
  nan.nodes[2].position.at.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(nan).find("node 3"), std::string::npos);

  Skeleton thin = forkedPlant();
  thin.nodes[2].radius = 0;
  EXPECT_NE(refusal(thin).find("radius is 0"), std::string::npos);

  Skeleton floating = forkedPlant();
  skeleton3d::Leaf leaf;
  leaf.stem = StemId{1};
  leaf.position.at = {0.5, 0.5, 0.5};
  leaf.normal = PlantDirection::along({1, 0, 0});
  leaf.length = 0.05;
  floating.leaves.push_back(leaf);
  EXPECT_NE(refusal(floating).find("leaf 1 of stem 1"), std::string::npos);
}

TEST(SegmentsCsv, HasTheColumnsOfTheFileFormat) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.5, 0}, {0, 0.75, 0}};
  EXPECT_EQ(segmentsCsv(measured(test::chainThrough(points))),
            "segment,stem,parent,level,kind,length,radius,rotr,rotu,rx,ry,rz,dx,dy,dz,leaves\n"
            "0,1,,0,root,0.5,,0,0,1,0,0,0,1,0,0\n"
            "1,1,0,1,main,0.25,,0,0,1,0,0,0,1,0,0\n");
}

}  // namespace
}  // namespace axil::quantify
