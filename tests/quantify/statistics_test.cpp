#include "quantify/statistics.hpp"

#include "quantify/measure.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace axil::quantify {
namespace {

using skeleton3d::NodeId;
using skeleton3d::StemId;

TEST(Statistics, SpreadOfPlainNumbers) {
  const Spread s = spreadOf(std::vector<double>{1, 2, 3, 6});
  EXPECT_EQ(s.low, 1);
  EXPECT_EQ(s.high, 6);
  EXPECT_EQ(s.mean, 3);
  EXPECT_NEAR(s.deviation, std::sqrt(14.0 / 3), 1e-15);
  EXPECT_EQ(spreadOf(std::vector<double>{0.1}).deviation, 0);
  EXPECT_EQ(spreadOf({}).count, 0u);
}

TEST(Statistics, AnglesAcrossHalfATurnHaveAShortArc) {
  const Spread s = circularSpreadOf(std::vector<double>{3.1, -3.1, 3.0});
  EXPECT_NEAR(s.low, 3.0, 1e-12);
  EXPECT_NEAR(s.high, 2 * std::numbers::pi - 3.1, 1e-12);
  EXPECT_NEAR(s.mean, (3.0 + 3.1 + 2 * std::numbers::pi - 3.1) / 3, 1e-12);
}

TEST(Statistics, TemplatesHoldSegmentsOfOneStructureAndTheirRanges) {
  const std::vector<glm::dvec3> trunk{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}};
  skeleton3d::Skeleton plant = test::chainThrough(trunk);
  const std::vector<glm::dvec3> low{{1, 2, 0}};
  const std::vector<glm::dvec3> high{{2, 2, 0}};
  test::addStem(plant, StemId{1}, NodeId{2}, low);
  test::addStem(plant, StemId{1}, NodeId{3}, high);
  const auto m = measure(plant);
  ASSERT_TRUE(m);
  const auto templates = templatesOf(*m);
  ASSERT_EQ(templates.size(), 1u);
  EXPECT_EQ(templates[0].structure, (RuleStructure{1, true, 0}));
  ASSERT_EQ(templates[0].members.size(), 2u);
  EXPECT_NEAR(templates[0].children[0].rotr.low, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(templates[0].children[0].rotr.high, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(templates[0].children[1].length.mean, 1, 1e-12);

  const auto orders = orderStatistics(*m);
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_EQ(orders[0].segmentsPerAxis.mean, 3);
  EXPECT_EQ(orders[1].segmentsPerAxis.count, 2u);
  EXPECT_EQ(orders[0].branchShares, (std::vector<double>{0, 1}));
}

}  // namespace
}  // namespace axil::quantify
