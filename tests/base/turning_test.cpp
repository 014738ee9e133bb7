#include "base/turning.hpp"

#include "base/rng.hpp"

#include <gtest/gtest.h>

namespace axil {
namespace {

PlantDirection randomDirection(Rng& rng) { return PlantDirection::along({rng.normal(), rng.normal(), rng.normal()}); }

TEST(Turning, MeasuringIsTheInverseOfGrowingForMainsAndBranches) {
  const std::uint64_t seed = 7;
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int plant = 0; plant < 200; ++plant) {
    StemFrame frame = firstFrame(randomDirection(rng));
    for (int level = 0; level < 20; ++level) {
      const PlantDirection wanted = randomDirection(rng);
      const ChildKind kind = rng.uniform() < 0.5 ? ChildKind::Main : ChildKind::Branch;
      frame = childFrame(frame, measuredTurn(frame, wanted), kind);
      ASSERT_LT(angleBetween(frame.direction, wanted).degrees(), 1e-9);
      ASSERT_NEAR(glm::dot(frame.direction.unit(), frame.rAxis.unit()), 0, 1e-12);
      ASSERT_NEAR(glm::dot(frame.direction.unit(), frame.adaxial.unit()), 0, 1e-12);
    }
  }
}

TEST(Turning, TheLiteralRuleRegrowsBranchesWrongly) {
  Rng rng(8);
  StemFrame frame = firstFrame(PlantDirection::up());
  double worst = 0;
  for (int level = 0; level < 5; ++level) {
    const PlantDirection wanted = randomDirection(rng);
    frame = childFrame(frame, measuredTurn(frame, wanted), ChildKind::Branch, TurningRule::Literal);
    worst = std::max(worst, angleBetween(frame.direction, wanted).degrees());
  }
  EXPECT_GT(worst, 1.0);
}

TEST(Turning, FirstAxisIsXUnlessTheStemRunsAlongX) {
  EXPECT_NEAR(firstFrame(PlantDirection::up()).rAxis.unit().x, 1, 1e-15);
  EXPECT_NEAR(firstFrame(PlantDirection::along({-1, 0, 0})).rAxis.unit().z, 1, 1e-15);
}

TEST(Turning, AStraightChildKeepsItsFrameAndRollsItsBladeByRotu) {
  const StemFrame parent = firstFrame(PlantDirection::up());
  const StemFrame child = childFrame(parent, {Angle{}, 90_deg}, ChildKind::Main);
  EXPECT_LT(angleBetween(child.direction, parent.direction).degrees(), 1e-12);
  EXPECT_NEAR(angleBetween(child.adaxial, parent.adaxial).degrees(), 90, 1e-9);
  EXPECT_NEAR(angleBetween(child.rAxis, parent.rAxis).degrees(), 90, 1e-9);
}

TEST(Turning, ALeafShowsItsUpperSideToTheTipOfItsStem) {
  const StemFrame leaf = childFrame(firstFrame(PlantDirection::up()), {60_deg, 200_deg}, ChildKind::Branch);
  EXPECT_GT(leaf.adaxial.unit().y, 0);
}

}  // namespace
}  // namespace axil
