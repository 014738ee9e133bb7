#include "skeleton3d/solve.hpp"

#include "random_cameras.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d {
namespace {

std::vector<View> threeViews(glm::ivec2 size = {1200, 1600}) {
  std::vector<View> views;
  for (const char* name : {"front", "right", "top"}) views.push_back({name, *nominalCamera(name, {.target = {{0, 0.4, 0}}, .distance = 2, .focal_px = 2000, .size_px = size}), size});
  return views;
}

TEST(SolveNodes, FindsAPointFromExactClicksOfAnyCameras) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Rng rng(seed);
    const auto views = test::randomViews(rng, 2 + static_cast<int>(rng.below(4)));
    const PlantPoint point{test::randomVector(rng, 0.4)};
    const auto solved = solveNodes(views, std::vector{test::clicked(views, 1, point)});
    if (!solved && solved.error().message.find("too similar") != std::string::npos) continue;
    ASSERT_TRUE(solved) << "seed " << seed << ": " << solved.error().message;
    EXPECT_LT(glm::length(solved->front().position.at - point.at), 1e-8) << "seed " << seed;
    for (const auto& [view, px] : solved->front().reprojection_px) EXPECT_LT(px, 1e-6) << view;
  }
}

TEST(SolveNodes, NoNearbyPointHasASmallerReprojectionError) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const auto views = test::randomViews(rng, 3);
    auto node = test::clicked(views, 1, {test::randomVector(rng, 0.4)});
    for (auto& [name, click] : node.clicks) click.px += glm::dvec2{rng.normal(0, 3), rng.normal(0, 3)};
    const auto solved = solveNodes(views, std::vector{node});
    ASSERT_TRUE(solved) << "seed " << seed << ": " << solved.error().message;
    const auto cost = [&](const glm::dvec3& at) {
      double sum = 0;
      for (const View& view : views) sum += std::pow(glm::length(project(view.camera, {at}).px - node.clicks.at(view.name).px), 2);
      return sum;
    };
    const glm::dvec3 best = solved->front().position.at;
    for (int i = 0; i < 20; ++i) EXPECT_LE(cost(best), cost(best + test::randomVector(rng, 1e-4)) + 1e-9) << "seed " << seed;
    double reported = 0;
    for (const auto& [view, px] : solved->front().reprojection_px) reported += px * px;
    EXPECT_NEAR(reported, cost(best), 1e-9);
  }
}

TEST(SolveNodes, OrderOfViewsAndNodesChangesNoBit) {
  Rng rng(7);
  auto views = test::randomViews(rng, 4);
  std::vector<ClickedNode> nodes;
  for (int i = 0; i < 50; ++i) {
    nodes.push_back(test::clicked(views, i, {test::randomVector(rng, 0.4)}));
    for (auto& [name, click] : nodes.back().clicks) click.px += glm::dvec2{rng.normal(0, 2), rng.normal(0, 2)};
  }
  const auto first = solveNodes(views, nodes);
  std::reverse(views.begin(), views.end());
  std::rotate(nodes.begin(), nodes.begin() + 17, nodes.end());
  auto second = solveNodes(views, nodes);
  ASSERT_TRUE(first && second);
  std::sort(second->begin(), second->end(), [](const Node& a, const Node& b) { return a.id < b.id; });
  EXPECT_EQ(*first, *second);
}

TEST(SolveNodes, SigmaIsTheSpreadThatNoisyClicksGive) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Rng rng(seed);
    const auto views = test::randomViews(rng, 3);
    const PlantPoint point{test::randomVector(rng, 0.3)};
    const double noise_px = 1.5;
    std::vector<ClickedNode> trials;
    for (int i = 0; i < 3000; ++i) {
      trials.push_back(test::clicked(views, i, point));
      for (auto& [name, click] : trials.back().clicks) click.px += glm::dvec2{rng.normal(0, noise_px), rng.normal(0, noise_px)};
    }
    const auto solved = solveNodes(views, trials, {.click_px = noise_px});
    ASSERT_TRUE(solved) << solved.error().message;
    glm::dvec3 squares{0, 0, 0}, sigma{0, 0, 0};
    for (const Node& node : *solved) {
      squares += (node.position.at - point.at) * (node.position.at - point.at) / 3000.0;
      sigma += node.sigma / 3000.0;
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sigma[k] / std::sqrt(squares[k]), 1.0, 0.06) << "seed " << seed << " axis " << k;
  }
}

TEST(SolveNodes, ANodeHiddenInOneViewIsSolvedFromTheOthers) {
  const auto views = threeViews();
  auto node = test::clicked(views, 1, {{0.1, 0.5, -0.05}});
  node.clicks.erase("top");
  const auto solved = solveNodes(views, std::vector{node});
  ASSERT_TRUE(solved);
  EXPECT_LT(glm::length(solved->front().position.at - glm::dvec3(0.1, 0.5, -0.05)), 1e-10);
  EXPECT_EQ(solved->front().reprojection_px.size(), 2u);
}

/// The message of the only trouble when `node` is solved.
std::string refusalOf(const std::vector<View>& views, const ClickedNode& node, const SolveOptions& options = {}) {
  const auto solved = solveNodes(views, std::vector{node}, options);
  if (solved) return "solved";
  EXPECT_TRUE(solved.error().details.empty());
  return solved.error().message;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SolveNodes, RefusesRaysThatDoNotMeetAndSaysHowFar) {
  const auto views = threeViews();
  auto node = test::clicked(views, 12, {{0.1, 0.5, -0.05}});
  node.clicks["front"].px.y += 200;
  const std::string message = refusalOf(views, node);
  EXPECT_TRUE(says(message, "node 12")) << message;
  EXPECT_TRUE(says(message, "do not meet")) << message;
  EXPECT_TRUE(says(message, "front 107.8 px, right 99.5 px")) << message;  // half of the 200 px each
  EXPECT_TRUE(says(message, "plant units")) << message;
  EXPECT_EQ(refusalOf(views, node, {.maxReprojection_px = 150}), "solved");
}

TEST(SolveNodes, TheLimitGrowsWithThePhoto) {
  const auto small = threeViews({1200, 1600}), large = threeViews({4800, 6400});
  for (const auto* views : {&small, &large}) {
    auto node = test::clicked(*views, 1, {{0.02, 0.41, -0.02}});
    node.clicks["front"].px.y += 200;
    EXPECT_EQ(refusalOf(*views, node) == "solved", views == &large);
  }
}

TEST(SolveNodes, RefusesClicksThatFixNoPlace) {
  const auto views = threeViews();
  const PlantPoint point{{0.1, 0.5, -0.05}};
  auto node = test::clicked(views, 3, point);
  node.clicks.erase("top");
  node.clicks.erase("right");
  EXPECT_TRUE(says(refusalOf(views, node), "node 3 is clicked in one view only (front)"));
  node.clicks.clear();
  EXPECT_TRUE(says(refusalOf(views, node), "in no view"));
  node = test::clicked(views, 3, point);
  node.clicks["front"].px.x = 1200.5;
  EXPECT_TRUE(says(refusalOf(views, node), "outside the photo of view front: (1200.5"));
  node.clicks["front"].px.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(refusalOf(views, node), "not a number"));
  node = test::clicked(views, 3, point);
  node.clicks["left"] = node.clicks["front"];
  EXPECT_TRUE(says(refusalOf(views, node), "view 'left', which does not exist"));
}

TEST(SolveNodes, RefusesViewsFromTheSameOrTheOppositeSide) {
  for (const char* other : {"front", "back"}) {
    auto views = threeViews();
    views.resize(1);
    views.push_back({"again", *nominalCamera(other, {.model = CameraModel::Orthographic, .scale_px_per_unit = 500}), {1200, 1600}});
    views[0].camera = *nominalCamera("front", {.model = CameraModel::Orthographic, .scale_px_per_unit = 500});
    const std::string message = refusalOf(views, test::clicked(views, 4, {{0.1, 0.5, 0}}));
    EXPECT_TRUE(says(message, "too similar")) << message;
    EXPECT_TRUE(says(message, "again and front")) << message;
  }
}

TEST(SolveNodes, RefusesAPointBehindACamera) {
  auto views = threeViews();
  views.pop_back();
  const PlantPoint behind{{0, 0.4, 2.5}};  // the front camera is at z = 2
  const std::string message = refusalOf({{"front", views[0].camera, {}}, {"right", views[1].camera, {}}}, test::clicked(views, 5, behind));
  EXPECT_TRUE(says(message, "behind the camera of view front")) << message;
}

TEST(SolveNodes, ListsEveryNodeThatHasNoPlace) {
  const auto views = threeViews();
  std::vector<ClickedNode> nodes;
  for (int i = 0; i < 6; ++i) nodes.push_back(test::clicked(views, i, {{0.1, 0.1 * i, -0.05}}));
  nodes[1].clicks = {{"top", nodes[1].clicks["top"]}};
  nodes[4].clicks["right"].px.y += 300;
  nodes[5].id = NodeId(0);
  const auto solved = solveNodes(views, nodes);
  ASSERT_FALSE(solved);
  ASSERT_EQ(solved.error().details.size(), 3u);
  EXPECT_TRUE(says(solved.error().details[0], "node 1"));
  EXPECT_TRUE(says(solved.error().details[1], "node 4"));
  EXPECT_TRUE(says(solved.error().details[2], "node 0 is listed twice"));
  EXPECT_TRUE(says(solved.error().message, "node 1") && says(solved.error().message, "2 more"));
}

TEST(SolveNodes, RefusesViewsThatCannotBeUsed) {
  auto views = threeViews();
  const std::vector nodes{test::clicked(views, 1, {{0, 0.4, 0}})};
  views[1].camera.model = CameraModel::Unknown;
  EXPECT_TRUE(says(solveNodes(views, nodes).error().message, "'right' is unknown"));
  views[1] = views[0];
  EXPECT_TRUE(says(solveNodes(views, nodes).error().message, "two views are called 'front'"));
  EXPECT_FALSE(solveNodes(threeViews(), nodes, {.click_px = 0}));
}

}  // namespace
}  // namespace axil::skeleton3d
