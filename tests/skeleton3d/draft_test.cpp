#include "skeleton3d/draft.hpp"

#include "random_tree.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/tree.hpp"
#include "support/cases.hpp"
#include "support/shared_data.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

/// A stem with two branches, drawn as discs along its lines into three masks.
struct Drawn {
  std::vector<View> views;
  std::map<std::string, Mask> masks;
  std::vector<std::vector<glm::dvec3>> lines{{{0, 0, 0}, {0.01, 1, 0}}, {{0.005, 0.5, 0}, {0.3, 0.7, 0.1}}, {{0.007, 0.7, 0}, {-0.2, 0.9, -0.25}}};
};

Drawn drawn() {
  Drawn made;
  for (const char* name : {"front", "right", "top"}) {
    const View view{name, *nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 1200, .size_px = {500, 600}}), {500, 600}};
    Mask mask{500, 600, std::vector<std::uint8_t>(500 * 600, 0)};
    for (const auto& line : made.lines)
      for (int k = 0; k <= 800; ++k) {
        const glm::dvec2 px = project(view.camera, {line[0] + k / 800.0 * (line[1] - line[0])}).px;
        for (int y = static_cast<int>(px.y) - 4; y <= static_cast<int>(px.y) + 4; ++y)
          for (int x = static_cast<int>(px.x) - 4; x <= static_cast<int>(px.x) + 4; ++x)
            if (x >= 0 && y >= 0 && x < 500 && y < 600 && std::hypot(x + 0.5 - px.x, y + 0.5 - px.y) < 3.5) mask.plant[static_cast<std::size_t>(y * 500 + x)] = 1;
      }
    made.views.push_back(view);
    made.masks[name] = std::move(mask);
  }
  return made;
}

TEST(Draft, AStemWithTwoBranchesIsFoundFromThreeMasks) {
  const Drawn plant = drawn();
  const auto stems = draftStems(plant.views, plant.masks);
  ASSERT_TRUE(stems) << stems.error().message;
  ASSERT_EQ(stems->size(), 3u);
  for (const auto& line : plant.lines) {
    double nearest = 1e9;
    for (const DraftStem& stem : *stems) nearest = std::min(nearest, glm::length(stem.points.back().at - line[1]));
    EXPECT_LT(nearest, 0.02) << "no stem ends at a true tip";
  }
  for (const DraftStem& stem : *stems) {
    EXPECT_GT(stem.sureness, 0.5);
    EXPECT_EQ(stem.points.size(), stem.radius.size());
  }
  const DraftClicks clicks = clicksOf(plant.views, *stems, NodeId(1), StemId(1));
  const auto tree = buildSkeleton(plant.views, clicks.nodes, clicks.stems);
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->stems.size(), 3u);
}

TEST(Draft, MasksThatDoNotBelongTogetherAreRefusedWithTheReason) {
  Drawn plant = drawn();
  EXPECT_FALSE(draftStems(plant.views, {{"front", plant.masks["front"]}}));
  Mask empty = plant.masks["front"];
  std::fill(empty.plant.begin(), empty.plant.end(), std::uint8_t{0});
  auto masks = plant.masks;
  masks["right"] = empty;
  EXPECT_FALSE(draftStems(plant.views, masks));
  masks["right"] = Mask{10, 10, std::vector<std::uint8_t>(100, 1)};
  EXPECT_FALSE(draftStems(plant.views, masks));
}

TEST(Draft, MostTipsOfARenderedPlantAreFoundAndFewThatAreNone) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases/p01_default_simple");
  const auto folder = test::sharedPath("data/plants/cases/p01_default_simple");
  const test::PlantCase plant = test::readPlantCase(folder, {.cameras = "persp"});
  std::map<std::string, Mask> masks;
  for (const View& view : plant.views) masks[view.name] = *readMask(folder / ("bare_persp_plain_" + view.name + ".mask.png"));
  const auto stems = draftStems(plant.views, masks);
  ASSERT_TRUE(stems) << stems.error().message;
  std::map<NodeId, glm::dvec3> truth;
  for (std::size_t i = 0; i < plant.nodes.size(); ++i) truth[plant.nodes[i].id] = plant.truth[i].at;
  int found = 0;
  for (const ClickedStem& stem : plant.stems)
    found += std::any_of(stems->begin(), stems->end(), [&](const DraftStem& s) { return glm::length(s.points.back().at - truth[stem.nodes.back()]) < 0.03 * plant.height_m; });
  std::printf("p01_default_simple: %d of %zu true tips, %zu stems drafted\n", found, plant.stems.size(), stems->size());
  EXPECT_GE(found, static_cast<int>(0.7 * static_cast<double>(plant.stems.size())));
  EXPECT_LE(static_cast<double>(stems->size()), static_cast<double>(found) / 0.8);
}

/// The way from the root to each branch's tip, in 50 equal steps.
std::vector<std::vector<glm::dvec3>> waysToTips(const std::vector<test::TreeBranch>& branches) {
  std::vector<std::vector<glm::dvec3>> whole, ways;
  for (const test::TreeBranch& branch : branches) {
    std::vector<glm::dvec3> way;
    if (branch.parent >= 0) {
      const auto& below = whole[static_cast<std::size_t>(branch.parent)];
      std::size_t leaves = 0;
      for (std::size_t i = 0; i < below.size(); ++i)
        if (glm::length(below[i] - branch.points.front()) < glm::length(below[leaves] - branch.points.front())) leaves = i;
      way.assign(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(leaves) + 1);
    }
    for (std::size_t i = 0; i + 1 < branch.points.size(); ++i)
      for (int k = 0; k < 40; ++k) way.push_back(glm::mix(branch.points[i], branch.points[i + 1], k / 40.0));
    way.push_back(branch.points.back());
    whole.push_back(way);
    std::vector<glm::dvec3> even;
    double length = 0, upTo = 0;
    for (std::size_t i = 1; i < way.size(); ++i) length += glm::length(way[i] - way[i - 1]);
    for (std::size_t i = 1; i < way.size(); ++i) {
      upTo += glm::length(way[i] - way[i - 1]);
      while (even.size() < 50 && upTo >= length * static_cast<double>(even.size()) / 50) even.push_back(way[i]);
    }
    ways.push_back(std::move(even));
  }
  return ways;
}

double meanDistance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double sum = 0;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const glm::dvec3& p : *from) {
      double least = 1e9;
      for (const glm::dvec3& q : *to) least = std::min(least, glm::length(p - q));
      sum += 0.5 * least / static_cast<double>(from->size());
    }
  return sum;
}

/// Branches of the truth that are found: way within 2 % of the height on average, tip within 8 % of it or a quarter of the branch.
int matched(const std::vector<test::TreeBranch>& truth, const std::vector<test::TreeBranch>& drafted) {
  const auto want = waysToTips(truth), got = waysToTips(drafted);
  std::vector<bool> taken(got.size(), false);
  int found = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    std::size_t best = got.size();
    double least = 0.02;
    double length = 0;
    for (std::size_t k = 1; k < truth[i].points.size(); ++k) length += glm::length(truth[i].points[k] - truth[i].points[k - 1]);
    for (std::size_t j = 0; j < got.size(); ++j)
      if (!taken[j] && glm::length(want[i].back() - got[j].back()) < std::max(0.08, 0.25 * length))
        if (const double off = meanDistance(want[i], got[j]); off < least) least = off, best = j;
    if (best < got.size()) taken[best] = true, ++found;
  }
  return found;
}

TEST(Draft, MostBranchesOfRandomTreesAreFoundAndFewThatAreNone) {
  struct Case {
    std::uint64_t seed;
    test::RandomTreeOptions options;
  };
  for (const Case& one : {Case{21, {.laterals = 14, .wobble = 0.4}}, Case{22, {.laterals = 10, .sublaterals = 3, .spread = 0.45, .droop = 0.5}}}) {
    const test::RandomTree tree = test::randomTree(one.seed, one.options);
    const auto stems = draftStems(tree.views, tree.masks);
    ASSERT_TRUE(stems) << stems.error().message;
    std::vector<test::TreeBranch> drafted;
    for (const DraftStem& stem : *stems) {
      drafted.push_back({stem.parent ? static_cast<int>(*stem.parent) : -1, {}, stem.radius});
      for (const PlantPoint& p : stem.points) drafted.back().points.push_back(p.at);
    }
    const int found = matched(tree.branches, drafted);
    std::printf("seed %llu: %d of %zu branches found, %zu drafted\n", static_cast<unsigned long long>(one.seed), found, tree.branches.size(), drafted.size());
    EXPECT_GE(found, 0.7 * static_cast<double>(tree.branches.size()));
    EXPECT_GE(found, 0.8 * static_cast<double>(drafted.size()));
  }
}

TEST(Draft, ItCanBeStopped) {
  const Drawn plant = drawn();
  CancelToken token;
  token.cancel();
  const auto stopped = draftStems(plant.views, plant.masks, {.watch = {.cancel = &token}});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

TEST(Draft, MasksOfALeafyPlantTakeFewerCubesNotMoreTime) {
  Drawn plant = drawn();
  for (auto& [name, mask] : plant.masks)
    for (int y = 250; y < 560; ++y)
      for (int x = 160; x < 340; ++x) mask.plant[static_cast<std::size_t>(y * 500 + x)] = 1;
  std::vector<double> shares;
  const auto stems = draftStems(plant.views, plant.masks, {.maxStems = 5, .watch = {.progress = [&](std::string_view, double share) { shares.push_back(share); }}});
  EXPECT_TRUE(stems || stems.error().code == ErrorCode::NoAnswer || stems.error().code == ErrorCode::LimitReached);
  EXPECT_GE(shares.size(), 3u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
}

}  // namespace
}  // namespace axil::skeleton3d
