#include "skeleton3d/draft.hpp"

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

}  // namespace
}  // namespace axil::skeleton3d
