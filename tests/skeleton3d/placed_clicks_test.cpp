#include "random_cameras.hpp"
#include "simulated_plants.hpp"
#include "skeleton3d/photographed.hpp"
#include "skeleton3d/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axil::skeleton3d {
namespace {

std::vector<View> threeViews() {
  std::vector<View> views;
  for (const char* name : {"front", "right", "top"})
    views.push_back({name, *nominalCamera(name, {.target = {{0, 0.4, 0}}, .distance = 2, .focal_px = 2000, .size_px = {1200, 1600}}), {1200, 1600}});
  return views;
}

/// The place of one node and how sure it is.
Node placeOf(const ClickedNode& node) {
  const auto solved = solveNodes(threeViews(), std::vector{node}, {.click_px = 2});
  EXPECT_TRUE(solved) << solved.error().message;
  return solved ? solved->front() : Node{};
}

TEST(PlacedClicks, DoNotMoveANodeThatAPersonClickedTwice) {
  ClickedNode node = test::clicked(threeViews(), 1, {{0.05, 0.4, -0.03}});
  node.clicks.at("top").px += glm::dvec2{9, -4};
  ClickedNode two = node;
  two.clicks.erase("top");
  node.placed["top"] = 2;
  EXPECT_EQ(placeOf(node), placeOf(two));
}

TEST(PlacedClicks, PlaceANodeThatAPersonClickedOnce) {
  const PlantPoint at{{0.05, 0.4, -0.03}};
  ClickedNode node = test::clicked(threeViews(), 1, at);
  node.clicks.erase("top");
  const double byHand = glm::length(placeOf(node).sigma);
  node.placed["right"] = 20;
  const Node placed = placeOf(node);
  EXPECT_LT(glm::length(placed.position.at - at.at), 1e-9);
  EXPECT_GT(glm::length(placed.sigma), 5 * byHand) << "20 px are ten times a person's 2";
  node.clicks.at("right").px.y += 30;  // against the ray of the other click, which a person made
  EXPECT_LT(placeOf(node).reprojection_px.at("front"), 1);
}

/// Every third node: its click in the top view is the program's, from a guess of the cameras that was 20 px off.
std::vector<ClickedNode> withGuesses(std::vector<ClickedNode> nodes, bool remembered) {
  for (std::size_t i = 0; i < nodes.size(); i += 3) {
    if (!nodes[i].clicks.contains("top")) continue;
    nodes[i].clicks.at("top").px += glm::dvec2{16, -12};
    if (remembered) nodes[i].placed["top"] = 3;
  }
  return nodes;
}

TEST(PlacedClicks, HaveNoPartInEstimatingCameras) {
  for (const std::uint64_t seed : {1, 2}) {
    const auto plant = test::handheldPlant(seed);
    auto without = plant.nodes;
    for (std::size_t i = 0; i < without.size(); i += 3) without[i].clicks.erase("top");
    const EstimateOptions options{.stems = plant.clickedStems()};
    const auto expected = estimateCameras(plant.views, plant.hints, without, options);
    const auto remembered = estimateCameras(plant.views, plant.hints, withGuesses(plant.nodes, true), options);
    const auto trusted = estimateCameras(plant.views, plant.hints, withGuesses(plant.nodes, false), options);
    ASSERT_TRUE(expected && remembered && trusted) << "seed " << seed;
    EXPECT_EQ(remembered->views, expected->views) << "seed " << seed;
    EXPECT_EQ(remembered->suspects, expected->suspects) << "seed " << seed;
    EXPECT_EQ(remembered->uncertainty, expected->uncertainty) << "seed " << seed;
    EXPECT_NE(trusted->views, expected->views) << "seed " << seed;
  }
}

TEST(PlacedClicks, GiveANodeOfOneOtherClickAPlaceAndASpreadOfItsOwn) {
  const auto plant = test::handheldPlant(3);
  auto nodes = plant.nodes;
  nodes[20].clicks.erase("top");
  nodes[20].placed["right"] = 30;
  const auto found = estimateCameras(plant.views, plant.hints, nodes, {.stems = plant.clickedStems()});
  ASSERT_TRUE(found) << found.error().message;
  const auto sigma = sigmaOf(found->uncertainty, NodeId(20)), usual = sigmaOf(found->uncertainty, NodeId(21));
  ASSERT_TRUE(sigma && usual);
  EXPECT_GT(glm::length(*sigma), 3 * glm::length(*usual));
  EXPECT_TRUE(lengthBetween(found->uncertainty, NodeId(20), NodeId(21)));
  for (const SuspectClick& suspect : found->suspects) EXPECT_NE(suspect.node, NodeId(20));
}

TEST(PlacedClicks, WhereAWrongClickWasRatherMeantIsOne) {
  const auto views = threeViews();
  const std::vector nodes{test::clicked(views, 1, {{0.05, 0.4, -0.03}})};
  const std::vector<SuspectClick> suspects{{NodeId(1), "top", 40, 0.9, PhotoPoint{{600, 800}}, 12}};
  const auto kept = withoutSuspects(nodes, suspects);
  EXPECT_EQ(kept.front().placed, (std::map<std::string, double>{{"top", 12}}));
}

}  // namespace
}  // namespace axil::skeleton3d
