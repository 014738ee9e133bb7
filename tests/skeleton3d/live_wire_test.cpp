#include "skeleton3d/live_wire.hpp"

#include "drawn_stems.hpp"
#include "skeleton3d/polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

using test::drawnPhoto;
using test::DrawnStem;

double distanceTo(const std::vector<glm::dvec2>& line, glm::dvec2 p) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 d = line[i + 1] - line[i];
    const double f = std::clamp(glm::dot(p - line[i], d) / glm::dot(d, d), 0.0, 1.0);
    least = std::min(least, glm::length(line[i] + f * d - p));
  }
  return least;
}

/// How far the line through the nodes is from the true one at most, ends left out: along the stem they are where they were clicked.
double furthest(const WirePath& path, const std::vector<glm::dvec2>& truth) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < path.nodes.size(); ++i)
    for (int k = 0; k <= 20; ++k) {
      const glm::dvec2 p = path.nodes[i].at.px + k / 20.0 * (path.nodes[i + 1].at.px - path.nodes[i].at.px);
      if (glm::length(p - truth.front()) > 20 && glm::length(p - truth.back()) > 20) most = std::max(most, distanceTo(truth, p));
    }
  return most;
}

/// How many straight pieces the true line needs for the same tolerance.
std::size_t piecesOf(const std::vector<glm::dvec2>& truth, double tolerance_px) { return detail::fewWithin(truth, tolerance_px).size() - 1; }

/// A bent stem: a long wave from the bottom to the top.
std::vector<glm::dvec2> wave(double swing_px) {
  std::vector<glm::dvec2> points;
  for (int k = 0; k <= 60; ++k) points.push_back({300 + swing_px * std::sin(k * 0.08), 560 - 9.0 * k});
  return points;
}

std::shared_ptr<const Photo> shared(Photo photo) { return std::make_shared<const Photo>(std::move(photo)); }

std::shared_ptr<const Photo> bentStem(double width, double noise) { return shared(drawnPhoto({600, 600}, {205, 203, 198}, {{wave(120), width, {70, 120, 50}}}, noise, 5)); }

TEST(LiveWire, ABentStemComesOutWithFewNodesWithinTheToleranceOfItsCentreLine) {
  const std::vector<glm::dvec2> truth = wave(120);
  for (const double width : {3.0, 14.0, 30.0}) {
    const auto wire = prepareLiveWire(bentStem(width, 4));
    ASSERT_TRUE(wire) << wire.error().message;
    const auto start = startWire(*wire, {truth.front() + glm::dvec2{3, -2}});
    ASSERT_TRUE(start) << start.error().message;
    for (const double tolerance : {1.0, 3.0}) {
      const WirePath path = wireTo(*start, {truth.back() + glm::dvec2{-2, 3}}, {.tolerance_px = tolerance});
      std::printf("stem of %4.1f px, tolerance %.0f px: %zu nodes, %.2f px off at most, confidence %.2f\n", width, tolerance, path.nodes.size(), furthest(path, truth), path.confidence);
      EXPECT_LE(furthest(path, truth), tolerance + 0.6);
      EXPECT_LE(path.nodes.size(), piecesOf(truth, tolerance) * 3 / 2 + 2);
      EXPECT_GT(path.confidence, 0.8);
      for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i) EXPECT_NEAR(path.nodes[i].width_px, width, 1 + 0.1 * width);
      EXPECT_LT(glm::length(path.nodes.front().at.px - truth.front()), 5);
      EXPECT_LT(glm::length(path.nodes.back().at.px - truth.back()), 5);
    }
  }
}

TEST(LiveWire, ABranchBesideItsParentIsNotTheParentAgain) {
  // A wide dark parent and a thin branch that leaves it slowly: the parent is the clearer stem for most of the way.
  const std::vector<glm::dvec2> parent{{200, 580}, {200, 20}}, branch{{200, 560}, {222, 470}, {232, 330}, {240, 190}};
  const auto wire = prepareLiveWire(shared(drawnPhoto({400, 600}, {205, 203, 198}, {{parent, 14, {40, 70, 30}}, {branch, 4, {140, 160, 120}}}, 3, 11)));
  ASSERT_TRUE(wire);
  const PhotoPoint from{branch.front()}, tip{branch.back()};
  const std::vector<TakenSegment> taken{{{parent.front()}, {parent.back()}}};
  const auto along = startWire(*wire, from), anew = startWire(*wire, from, taken);
  ASSERT_TRUE(along && anew);
  const auto inMiddle = [&](const WirePath& path) {
    const auto node = std::min_element(path.line.begin(), path.line.end(), [](const WireNode& a, const WireNode& b) { return std::abs(a.at.px.y - 400) < std::abs(b.at.px.y - 400); });
    return distanceTo(branch, node->at.px);
  };
  EXPECT_GT(inMiddle(wireTo(*along, tip)), 10) << "what the clearer stem costs less";
  EXPECT_LT(inMiddle(wireTo(*anew, tip)), 2);
}

TEST(LiveWire, AStraightStemIsTwoNodesWhateverCrossesIt) {
  const std::vector<glm::dvec2> stem{{80, 380}, {310, 30}};
  const DrawnStem other{{{40, 100}, {380, 300}}, 8, {90, 80, 60}};
  const auto wire = prepareLiveWire(shared(drawnPhoto({400, 400}, {200, 200, 196}, {other, {stem, 5, {70, 120, 50}}}, 3, 9)));
  ASSERT_TRUE(wire);
  const auto path = wireBetween(*wire, {stem[0] + glm::dvec2{3, 1}}, {stem[1] + glm::dvec2{-3, 2}});
  ASSERT_TRUE(path);
  EXPECT_LE(path->nodes.size(), 3u);
  EXPECT_LT(furthest(*path, stem), 1.5);
}

TEST(LiveWire, WhereThereIsNoStemTheClicksStayAndItSaysSo) {
  const auto wire = prepareLiveWire(shared(drawnPhoto({300, 300}, {180, 180, 180}, {}, 4, 2)));
  ASSERT_TRUE(wire);
  const auto path = wireBetween(*wire, {{40, 50}}, {{240, 210}});
  ASSERT_TRUE(path);
  EXPECT_LT(path->confidence, 0.3);
  EXPECT_EQ(path->nodes.front().at.px, glm::dvec2(40, 50));
  EXPECT_EQ(path->nodes.back().at.px, glm::dvec2(240, 210));
  for (const WireNode& node : path->line) EXPECT_TRUE(std::isfinite(node.at.px.x + node.at.px.y + node.width_px + node.confidence));
  const auto none = wireBetween(*wire, {{40, 50}}, {{40, 50}});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->nodes.size(), 2u);
}

TEST(LiveWire, BadPhotosAndPlacesAreRefusedAndPreparationCanBeStopped) {
  EXPECT_FALSE(prepareLiveWire(nullptr));
  EXPECT_FALSE(prepareLiveWire(shared(Photo{})));
  EXPECT_FALSE(prepareLiveWire(shared(Photo{4, 4, std::vector<std::uint8_t>(48)})));
  const auto photo = bentStem(6, 0);
  CancelToken token;
  token.cancel();
  const auto stopped = prepareLiveWire(photo, {.cancel = &token});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
  const auto wire = prepareLiveWire(photo);
  ASSERT_TRUE(wire);
  EXPECT_FALSE(startWire(*wire, {{-5, 10}}));
  EXPECT_FALSE(startWire(*wire, {{std::nan(""), 10}}));
  const auto start = startWire(*wire, {wave(120).front()});
  ASSERT_TRUE(start);
  const WirePath outside = wireTo(*start, {{-500, 1e9}});
  for (const WireNode& node : outside.nodes) EXPECT_TRUE(std::isfinite(node.at.px.x) && node.at.px.x >= -20 && node.at.px.y <= 620);
}

}  // namespace
}  // namespace axil::skeleton3d
