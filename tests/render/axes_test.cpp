#include "render/axes.hpp"

#include "render/known_plants.hpp"

#include <gtest/gtest.h>

namespace axil::render {
namespace {

using simeco::OrganId;
using simeco::OrganKind;

TEST(Axes, AChainIsOneAxis) {
  const auto axes = axesOf(test::straightStem(5, 1, 0.01), Continuation::Brackets);
  ASSERT_EQ(axes.axes.size(), 1u);
  EXPECT_EQ(axes.axes[0].organs.size(), 5u);
  EXPECT_FALSE(axes.axes[0].insertion);
}

TEST(Axes, AGrowingPointIsPassedOverAndWhatStandsOnItStandsBelow) {
  test::PlantMaker make;
  const auto stem = make.style(OrganKind::Stem);
  const OrganId a = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.01, stem);
  const OrganId point = make.on(a, false, {0, 1, 0}, 1e-9, 0.01, stem);
  const OrganId b = make.on(point, false, {0.1, 1, 0}, 0.1, 0.01, stem);
  const OrganId c = make.on(point, true, {1, 1, 0}, 0.1, 0.005, stem);
  const auto axes = axesOf(make.plant, Continuation::Brackets);
  ASSERT_EQ(axes.axes.size(), 2u);
  EXPECT_EQ(axes.axes[0].organs, (std::vector{a, b}));
  EXPECT_EQ(axes.axes[1].organs, std::vector{c});
  EXPECT_EQ(axes.axes[1].insertion, (Site{AxisId(0), 1}));
  EXPECT_EQ(axes.siteOfTip[static_cast<std::size_t>(point.value)], (Site{AxisId(0), 1}));
}

TEST(Axes, WhereAllChildrenStandInBracketsTheStraightestGoesOnOnlyInAPicture) {
  test::PlantMaker make;
  const auto stem = make.style(OrganKind::Stem);
  const OrganId a = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.01, stem);
  make.on(a, true, {0.9, 1, 0}, 0.1, 0.01, stem);
  const OrganId straight = make.on(a, true, {-0.2, 1, 0}, 0.1, 0.01, stem);
  EXPECT_EQ(axesOf(make.plant, Continuation::Brackets).axes.size(), 3u);
  const auto drawn = axesOf(make.plant, Continuation::Straightest);
  ASSERT_EQ(drawn.axes.size(), 2u);
  EXPECT_EQ(drawn.axes[0].organs, (std::vector{a, straight}));
}

TEST(Axes, ARootDoesNotContinueAStem) {
  test::PlantMaker make;
  const OrganId a = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.01, make.style(OrganKind::Stem));
  make.on(a, false, {0, 1, 0.1}, 0.1, 0.01, make.style(OrganKind::Root));
  EXPECT_EQ(axesOf(make.plant, Continuation::Straightest).axes.size(), 2u);
}

}  // namespace
}  // namespace axil::render
