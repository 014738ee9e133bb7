#include "render/stem_mesh.hpp"
#include "render/tube.hpp"

#include "base/rng.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::render {
namespace {

TubePath pathThrough(const std::vector<glm::dvec3>& nodes, double radius, double tipRadius = -1) {
  TubePath path;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(nodes.size() - 1);
    path.nodes.push_back({.at = nodes[i], .radius = tipRadius < 0 ? radius : radius + (tipRadius - radius) * share, .colour = glm::vec3(0.4f)});
    if (i > 0) path.segments.push_back({.organ = simeco::OrganId(static_cast<std::int32_t>(i) - 1), .material = 0});
  }
  return path;
}

StemMesh tubeOf(const TubePath& path, const TubeDetail& detail = {}) {
  TubeRings rings;
  rings.add(path, detail);
  StemMesh mesh = roomFor(rings.vertexCount(), rings.triangleCount());
  rings.sweepInto(mesh, 0, 0);
  return mesh;
}

/// Every edge is used once in each direction: closed, and oriented alike everywhere.
bool isWatertight(const StemMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end() && back->second == 1;
  });
}

double volumeOf(const StemMesh& mesh) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[mesh.triangles[t]]), b(mesh.positions[mesh.triangles[t + 1]]), c(mesh.positions[mesh.triangles[t + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return volume;
}

double smallestDistance(const std::vector<std::vector<TubeRing>>& runs, const glm::dvec3& point) {
  double least = 1e300;
  for (const auto& run : runs)
    for (const TubeRing& ring : run) least = std::min(least, glm::distance(ring.at, point));
  return least;
}

double distanceToChord(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::distance(p, a + (b - a) * t);
}

std::vector<glm::dvec3> randomChain(Rng& rng, int count) {
  std::vector<glm::dvec3> nodes{{0, 0, 0}};
  glm::dvec3 direction(0, 1, 0);
  for (int i = 0; i < count; ++i) {
    direction = glm::normalize(direction + glm::dvec3{rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8)});
    nodes.push_back(nodes.back() + direction * rng.uniform(0.02, 0.3));
  }
  return nodes;
}

TEST(Tube, AStraightChainGivesAStraightCylinderWithRoundEnds) {
  const double radius = 0.01;
  const StemMesh mesh = tubeOf(pathThrough({{0, 0, 0}, {0, 0.1, 0}, {0, 0.25, 0}, {0, 0.3, 0}}, radius));
  for (const glm::vec3& p : mesh.positions) {
    EXPECT_LE(std::hypot(p.x, p.z), radius + 1e-7);
    if (p.y > 0 && p.y < 0.3f) { EXPECT_NEAR(std::hypot(p.x, p.z), radius, 1e-7); }
  }
  const auto [low, high] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(), [](auto& a, auto& b) { return a.y < b.y; });
  EXPECT_NEAR(low->y, -radius, 1e-7);
  EXPECT_NEAR(high->y, 0.3 + radius, 1e-7);
  EXPECT_TRUE(isWatertight(mesh));
  const double inscribed = std::sin(2 * M_PI / 12) / (2 * M_PI / 12);  // a twelve-sided prism instead of a cylinder
  const double cylinder = M_PI * radius * radius * 0.3 * inscribed, ball = 4.0 / 3 * M_PI * radius * radius * radius;
  EXPECT_NEAR(volumeOf(mesh), cylinder + ball, 0.2 * ball);
}

TEST(Tube, RunsExactlyThroughEveryNode) {
  Rng rng(11);
  for (int trial = 0; trial < 200; ++trial) {
    const auto nodes = randomChain(rng, 8);
    const auto runs = centreLine(pathThrough(nodes, 0.004), {});
    for (const glm::dvec3& node : nodes) EXPECT_LT(smallestDistance(runs, node), 1e-12);
  }
}

TEST(Tube, NeverStraysFurtherFromTheNodesThanAThirdOfASegment) {
  Rng rng(12);
  for (int trial = 0; trial < 200; ++trial) {
    const auto nodes = randomChain(rng, 8);
    for (const auto& run : centreLine(pathThrough(nodes, 0.004), {}))
      for (const TubeRing& ring : run) {
        const auto i = static_cast<std::size_t>(ring.segment);
        EXPECT_LE(distanceToChord(ring.at, nodes[i], nodes[i + 1]), glm::distance(nodes[i], nodes[i + 1]) / 3 + 1e-12);
      }
  }
}

TEST(Tube, TurnsLittleFromRingToRing) {
  const TubeDetail detail{.sides = 12, .turnPerRing = 9_deg, .capRings = 3};
  const auto runs = centreLine(pathThrough({{0, 0, 0}, {0, 0.1, 0}, {0.07, 0.17, 0}, {0.16, 0.2, 0.02}}, 0.005), detail);
  ASSERT_EQ(runs.size(), 1u);
  for (std::size_t i = 1; i < runs[0].size(); ++i)
    EXPECT_LT(angleBetween(PlantDirection::along(runs[0][i - 1].tangent), PlantDirection::along(runs[0][i].tangent)).degrees(), 1.8 * 9);
}

TEST(Tube, IsClosedAndOutwardWhateverTheStemDoes) {
  Rng rng(13);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<glm::dvec3> nodes{{0, 0, 0}};
    for (int i = 0; i < 6; ++i)  // any turn at all, folds included
      nodes.push_back(nodes.back() + PlantDirection::along({rng.normal(), rng.normal(), rng.normal()}).unit() * rng.uniform(0.01, 0.2));
    const StemMesh mesh = tubeOf(pathThrough(nodes, 0.006, 0.001));
    EXPECT_TRUE(isWatertight(mesh));
    EXPECT_GT(volumeOf(mesh), 0);
    for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
    for (const glm::vec3& p : mesh.positions) {
      double nearest = 1e300;
      for (std::size_t i = 1; i < nodes.size(); ++i) nearest = std::min(nearest, distanceToChord(glm::dvec3(p), nodes[i - 1], nodes[i]));
      EXPECT_LT(nearest, 0.2 / 3 + 0.0061);
    }
  }
}

TEST(Tube, AFoldMeetsInABallInsteadOfTearing) {
  const glm::dvec3 fold{0, 0.1, 0};
  const TubePath path = pathThrough({{0, 0, 0}, fold, {0.01, 0.02, 0}}, 0.004);  // turns back by more than 170 degrees
  EXPECT_EQ(centreLine(path, {}).size(), 2u);
  const StemMesh mesh = tubeOf(path);
  float top = 0;
  for (const glm::vec3& p : mesh.positions) top = std::max(top, p.y);
  EXPECT_NEAR(top, 0.1 + 0.004, 1e-4);
  EXPECT_TRUE(isWatertight(mesh));
}

TEST(Tube, NormalsPointAwayFromTheCentreLine) {
  const StemMesh mesh = tubeOf(pathThrough({{0, 0, 0}, {0.02, 0.1, 0}, {0.08, 0.17, 0.03}}, 0.005, 0.003));
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::vec3 a = mesh.positions[mesh.triangles[t]], b = mesh.positions[mesh.triangles[t + 1]], c = mesh.positions[mesh.triangles[t + 2]];
    const glm::vec3 face = glm::cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(glm::dot(face, mesh.normals[mesh.triangles[t + k]]), 0);
  }
}

TEST(Tube, EveryTriangleKnowsItsSegment) {
  const StemMesh mesh = tubeOf(pathThrough({{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0}}, 0.002));
  ASSERT_EQ(mesh.sources.size() * 3, mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.sources.size(); ++t) {
    const float middle = (mesh.positions[mesh.triangles[3 * t]].y + mesh.positions[mesh.triangles[3 * t + 1]].y + mesh.positions[mesh.triangles[3 * t + 2]].y) / 3;
    EXPECT_EQ(mesh.sources[t].organ.value, middle < 0.1f ? 0 : 1);
  }
}

TEST(Tube, ABranchBeginsInsideItsParent) {
  TubePath path = pathThrough({{0, 0, 0}, {0.1, 0, 0}}, 0.006);
  path.collar.parentRadius = 0.004;  // thicker than what it leaves
  const auto runs = centreLine(path, {});
  for (const TubeRing& ring : runs[0])
    if (ring.at.x < 0.0039) { EXPECT_LT(ring.radius, 0.004); }
  EXPECT_NEAR(runs[0].back().radius, 0.006, 1e-12);
  EXPECT_TRUE(isWatertight(tubeOf(path)));
}

}  // namespace
}  // namespace axil::render
