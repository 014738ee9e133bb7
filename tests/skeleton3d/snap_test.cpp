#include "skeleton3d/snap.hpp"

#include "drawn_stems.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/snap_place.hpp"
#include "skeleton3d/solve.hpp"
#include "support/cases.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

using test::drawnPhoto;
using test::DrawnStem;

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Tried {
  std::vector<double> across, along, width;
  int none = 0;
};

/// Clicks of 3 px scatter beside one straight stem at a random angle.
Tried tried(cv::Scalar background, cv::Scalar stem, double width_px, double noise, std::uint64_t seed) {
  Rng rng(seed);
  Tried result;
  for (int i = 0; i < 40; ++i) {
    const double turn = rng.uniform(0, 3.14159);
    const glm::dvec2 along{std::cos(turn), std::sin(turn)}, across{-along.y, along.x}, middle{60 + rng.uniform(), 60 + rng.uniform()};
    const Photo photo = drawnPhoto({120, 120}, background, {{{middle - 90.0 * along, middle + 90.0 * along}, width_px, stem}}, noise, seed + static_cast<std::uint64_t>(i));
    const glm::dvec2 click = middle + 3.0 * glm::dvec2{rng.normal(), rng.normal()};
    const auto snapped = snapClick(photo, {click});
    if (!snapped) {
      ++result.none;
      continue;
    }
    result.across.push_back(std::abs(glm::dot(snapped->at.px - middle, across)));
    result.along.push_back(std::abs(glm::dot(snapped->at.px - click, along)));
    result.width.push_back(std::abs(snapped->width_px - width_px));
  }
  return result;
}

TEST(Snap, AClickBesideADarkOrALightStemGoesToItsCentreLineWithinASmallPartOfAPixel) {
  const std::uint64_t seed = 11;
  for (const double width : {3.0, 7.0, 16.0})
    for (const bool dark : {true, false}) {
      const Tried t = tried(dark ? cv::Scalar(210, 208, 205) : cv::Scalar(40, 45, 50), dark ? cv::Scalar(60, 110, 40) : cv::Scalar(190, 210, 150), width, 3, seed);
      std::printf("seed %llu: stem %4.1f px %s: across median %.3f, p95 %.3f px; width median %.2f px off; no ridge %d of 40\n", static_cast<unsigned long long>(seed), width,
                  dark ? "dark " : "light", percentile(t.across, 0.5), percentile(t.across, 0.95), percentile(t.width, 0.5), t.none);
      EXPECT_LE(t.none, 2);
      EXPECT_LT(percentile(t.across, 0.5), 0.15);
      EXPECT_LT(percentile(t.across, 0.95), 0.5);
      EXPECT_LT(percentile(t.along, 0.95), 1.0) << "it slid along the stem";
      EXPECT_LT(percentile(t.width, 0.5), 0.5 + (width < 6));
    }
}

TEST(Snap, AClickAtATipDoesNotSlideAlongTheStem) {
  const glm::dvec2 tip{70.3, 40.2}, base{60.1, 118};
  const Photo photo = drawnPhoto({140, 120}, {200, 200, 200}, {{{base, tip}, 5}}, 2, 3);
  const auto snapped = snapClick(photo, {tip + glm::dvec2{2.5, 1}});
  ASSERT_TRUE(snapped);
  const glm::dvec2 along = glm::normalize(tip - base);
  EXPECT_LT(std::abs(glm::dot(snapped->at.px - tip - glm::dvec2{2.5, 1}, along)), 0.7);
  EXPECT_LT(std::abs(glm::dot(snapped->at.px - tip, glm::dvec2{-along.y, along.x})), 0.4);
}

TEST(Snap, APhotoWithoutARidgeThereSaysSo) {
  const Photo uniform = drawnPhoto({120, 120}, {128, 130, 120}, {}, 0, 1), grain = drawnPhoto({120, 120}, {128, 130, 120}, {}, 8, 1);
  const Photo blurred = drawnPhoto({120, 120}, {200, 200, 200}, {{{{60, -20}, {60, 140}}, 6}}, 2, 1, 25);
  EXPECT_FALSE(snapClick(uniform, {{60, 60}}));
  EXPECT_FALSE(snapClick(blurred, {{60, 60}}));
  int found = 0;
  for (int i = 0; i < 25; ++i) found += snapClick(grain, {{30.0 + 2 * i, 40.0 + i}}).has_value();
  EXPECT_LE(found, 1) << "ridges in grain";
  EXPECT_FALSE(snapClick(Photo{}, {{1, 1}}));
}

TEST(Snap, ANodeAtAForkLiesOnItsOwnStemsLine) {
  const DrawnStem trunk{{{100.4, 190}, {100.4, 10}}, 14}, branch{{{100.4, 100}, {170, 60}}, 6};
  const Photo photo = drawnPhoto({200, 200}, {215, 214, 210}, {trunk, branch}, 2, 7);
  std::vector<ClickedNode> nodes;
  for (int i = 0; i < 8; ++i) nodes.push_back({NodeId(i), {{"front", {{100.4 + (i % 3 - 1) * 3, 180.0 - 22.857 * i}}}}, std::nullopt});
  nodes[4].clicks["front"] = {{103, 99}};  // the fork
  nodes.push_back({NodeId(8), {{"front", {{140, 80}}}}, std::nullopt});
  nodes.push_back({NodeId(9), {{"front", {{169, 59}}}}, std::nullopt});
  const std::vector<ClickedStem> stems{{StemId(0), {NodeId(0), NodeId(1), NodeId(2), NodeId(3), NodeId(4), NodeId(5), NodeId(6), NodeId(7)}}, {StemId(1), {NodeId(4), NodeId(8), NodeId(9)}}};
  const auto readings = readRidges(photo, "front", nodes, stems);
  ASSERT_TRUE(readings.contains(NodeId(4)));
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(readings.contains(NodeId(i))) << "node " << i;
    EXPECT_NEAR(readings.at(NodeId(i)).at.px.x, 100.4, 0.4) << "node " << i;
  }
  ASSERT_TRUE(readings.contains(NodeId(8)));
  const glm::dvec2 along = glm::normalize(glm::dvec2{69.6, -40});
  EXPECT_LT(std::abs(glm::dot(readings.at(NodeId(8)).at.px - glm::dvec2{100.4, 100}, glm::dvec2{-along.y, along.x})), 0.3);
}

struct Scores {
  std::vector<double> off, plain, radius;
  std::vector<double> sigmas;  ///< how many standard deviations each coordinate is off
};

/// Distances of the nodes from where the true nodes' stems run, in percent of the height; radii where a stem is 6 px wide.
Scores scoresOf(const char* name, const char* cameras, const char* photos) {
  const auto folder = test::sharedPath("data/plants/cases") / name;
  const test::PlantCase plant = test::readPlantCase(folder, {.cameras = cameras, .noise_px = 3, .seed = 5, .radius = true});
  std::vector<ClickedNode> clicks = plant.nodes;
  for (ClickedNode& node : clicks) node.radius.reset();
  Photos read;
  for (const View& view : plant.views) read[view.name] = *readPhoto(folder / (std::string("bare_") + photos + "_" + view.name + ".jpg"));
  const auto snapped = snapNodes(plant.views, read, clicks, plant.stems);
  const auto plain = solveNodes(plant.views, clicks);
  Scores scores;
  EXPECT_TRUE(snapped && plain);
  if (!snapped || !plain) return scores;
  std::map<NodeId, std::size_t> index;
  for (std::size_t i = 0; i < clicks.size(); ++i) index[clicks[i].id] = i;
  const auto offLine = [&](glm::dvec3 at) {
    double least = 1e9;
    for (const ClickedStem& stem : plant.stems)
      for (std::size_t i = 0; i + 1 < stem.nodes.size(); ++i) {
        const glm::dvec3 a = plant.truth[index[stem.nodes[i]]].at, d = plant.truth[index[stem.nodes[i + 1]]].at - a;
        const double f = glm::dot(d, d) > 0 ? std::clamp(glm::dot(at - a, d) / glm::dot(d, d), 0.0, 1.0) : 0;
        least = std::min(least, glm::length(a + f * d - at));
      }
    return 100 * least / plant.height_m;
  };
  for (const SnappedNode& node : snapped->nodes) {
    scores.off.push_back(offLine(node.at.at));
    for (int k = 0; k < 3; ++k) scores.sigmas.push_back(std::abs(node.at.at[k] - plant.truth[index[node.id]].at[k]) / std::sqrt(node.covariance[k][k]));
    const double truth = *plant.nodes[index[node.id]].radius;
    double widest_px = 0;
    for (const View& view : plant.views) widest_px = std::max(widest_px, 2 * glm::length(project(view.camera, {node.at.at + glm::dvec3{truth, 0, 0}}).px - project(view.camera, node.at).px));
    if (node.radius && widest_px >= 6) scores.radius.push_back(100 * std::abs(*node.radius / truth - 1));
  }
  for (const Node& node : *plain) scores.plain.push_back(offLine(node.position.at));
  std::printf("%s %s, seed 5: off the centre lines median %.4f, p95 %.4f %% of the height (plain %.3f, %.3f); radius median %.1f %% of %zu\n", name, photos, percentile(scores.off, 0.5),
              percentile(scores.off, 0.95), percentile(scores.plain, 0.5), percentile(scores.plain, 0.95), percentile(scores.radius, 0.5), scores.radius.size());
  return scores;
}

TEST(Snap, SnappedClicksPutNodesOnTheTrueCentreLines) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases/p02_quaking_aspen");
  const Scores scores = scoresOf("p02_quaking_aspen", "persp", "persp_plain");
  EXPECT_LE(percentile(scores.off, 0.5), 0.08);
  EXPECT_LE(percentile(scores.off, 0.95), 0.25);
  EXPECT_LE(percentile(scores.radius, 0.5), 10);
}

double shareWithin(const std::vector<double>& sigmas, double most) {
  return static_cast<double>(std::count_if(sigmas.begin(), sigmas.end(), [&](double s) { return s <= most; })) / static_cast<double>(sigmas.size());
}

TEST(Snap, IntervalsOfNodesSnappedToRealRidgesAreTrue) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases/p02_quaking_aspen");
  const Scores scores = scoresOf("p02_quaking_aspen", "persp", "persp_plain");
  std::printf("68 %% intervals hold %.1f %%, 95 %% intervals %.1f %% of %zu coordinates\n", 100 * shareWithin(scores.sigmas, 1), 100 * shareWithin(scores.sigmas, 1.96), scores.sigmas.size());
  EXPECT_NEAR(shareWithin(scores.sigmas, 1), 0.68, 0.05);
  EXPECT_NEAR(shareWithin(scores.sigmas, 1.96), 0.95, 0.05);
}

TEST(Snap, SnappedClicksStayExactBeforeAClutteredBackground) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases/p01_default_simple");
  const Scores scores = scoresOf("p01_default_simple", "handheld", "handheld_clutter");
  EXPECT_LE(percentile(scores.off, 0.5), 0.08);
  EXPECT_LE(percentile(scores.off, 0.95), 0.5);
  EXPECT_LE(percentile(scores.radius, 0.5), 10);
}

}  // namespace
}  // namespace axil::skeleton3d
