#include "skeleton3d/doubts.hpp"

#include <gtest/gtest.h>

namespace axil::skeleton3d {
namespace {

/// A straight stem with a node at each height, its clicks half a pixel off.
Skeleton stemOf(const std::vector<double>& heights) {
  Skeleton skeleton;
  Stem stem{.id = StemId(1), .parent = {}, .nodes = {}};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const NodeId id(static_cast<std::int32_t>(i) + 1);
    skeleton.nodes.push_back({.id = id, .position = {{0, heights[i], 0}}, .radius = {}, .sigma = {}, .reprojection_px = {{"front", 0.5}, {"right", 0.5}}});
    stem.nodes.push_back(id);
  }
  skeleton.stems.push_back(stem);
  return skeleton;
}

TEST(Doubts, NothingIsDoubtedInAnEvenPlant) { EXPECT_TRUE(doubtsOf(stemOf({0, 1, 2, 3, 4, 5, 6})).empty()); }

TEST(Doubts, AClickFarFromWhereItsNodeProjectsToIsNamed) {
  Skeleton skeleton = stemOf({0, 1, 2, 3, 4, 5, 6});
  skeleton.nodes[3].reprojection_px["right"] = 14;
  const Doubts doubts = doubtsOf(skeleton);
  ASSERT_EQ(doubts.clicks.size(), 1u);
  EXPECT_EQ(doubts.clicks[0], (DoubtfulClick{NodeId(4), "right", 14}));
}

TEST(Doubts, AnUnsteadyHandIsNotDoubtedEverywhere) {
  Skeleton skeleton = stemOf({0, 1, 2, 3, 4, 5, 6});
  for (Node& node : skeleton.nodes) node.reprojection_px = {{"front", 6}, {"right", 7}};
  EXPECT_TRUE(doubtsOf(skeleton).clicks.empty());
}

TEST(Doubts, ALeapAlongAStemIsNamed) {
  const Doubts doubts = doubtsOf(stemOf({0, 1, 2, 3, 4, 12, 13}));
  ASSERT_EQ(doubts.segments.size(), 1u);
  EXPECT_EQ(doubts.segments[0].from, NodeId(5));
  EXPECT_EQ(doubts.segments[0].to, NodeId(6));
  EXPECT_NEAR(doubts.segments[0].times, 8, 1e-12);
  EXPECT_TRUE(doubtsOf(stemOf({0, 1, 9})).segments.empty()) << "two segments say nothing of what is typical";
}

}  // namespace
}  // namespace axil::skeleton3d
