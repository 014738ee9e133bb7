#include "organs/leaf.hpp"

#include "mesh_checks.hpp"
#include "polygon_checks.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace axil::organs {
namespace {

using test::areaOf;
using test::cross;
using test::crossingsOf;
using test::expectSound;
using test::trianglesOf;

constexpr std::array allDetails{Detail::Close, Detail::Medium, Detail::Far};

const Mesh& bladeOf(const std::vector<Part>& parts) {
  return std::find_if(parts.begin(), parts.end(), [](const Part& p) { return p.name == "blade"; })->mesh;
}

// Signed areas of the blade's triangles seen from above (+Z).
std::vector<double> flatAreasOf(const Mesh& blade) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < blade.triangles.size(); t += 3) {
    const glm::dvec2 a = glm::vec2(blade.positions[blade.triangles[t]]);
    const glm::dvec2 b = glm::vec2(blade.positions[blade.triangles[t + 1]]);
    const glm::dvec2 c = glm::vec2(blade.positions[blade.triangles[t + 2]]);
    areas.push_back(0.5 * cross(b - a, c - a));
  }
  return areas;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

TEST(LeafShapes, AreManyAndEachIsFoundByItsOwnName) {
  EXPECT_GE(leafShapes().size(), 24u);
  std::set<std::string> names;
  for (const LeafShape& shape : leafShapes()) {
    EXPECT_TRUE(names.insert(shape.name).second) << shape.name;
    ASSERT_TRUE(leafShapeNamed(shape.name));
    EXPECT_EQ(*leafShapeNamed(shape.name), shape);
  }
  EXPECT_FALSE(leafShapeNamed("no such shape"));
}

TEST(LeafOutline, IsASimpleCounterClockwisePolygonFromBaseToApex) {
  for (const LeafShape& shape : leafShapes()) {
    SCOPED_TRACE(shape.name);
    const std::vector<glm::vec2> outline = leafOutline(shape);
    ASSERT_GT(outline.size(), 20u);
    EXPECT_GT(areaOf(outline), 0);
    EXPECT_EQ(crossingsOf(outline), 0);
    EXPECT_EQ(outline.front().x, 0);
    EXPECT_EQ(outline.front() == glm::vec2(0, 0), shape.shield == 0);
    EXPECT_NE(std::find(outline.begin(), outline.end(), glm::vec2(0, 1)), outline.end());
  }
}

TEST(LeafOutline, IsAsWideAsTheShapeSays) {
  for (const LeafShape& shape : leafShapes()) {
    if (shape.bend != 0 || shape.teeth != 0) continue;
    const std::vector<glm::vec2> outline = leafOutline(shape);
    const auto [low, high] = std::minmax_element(outline.begin(), outline.end(), [](auto a, auto b) { return a.x < b.x; });
    EXPECT_NEAR(high->x - low->x, shape.widthToLength, 0.01 * shape.widthToLength) << shape.name;
  }
}

TEST(LeafOutline, MirrorsItselfUnlessTheBladeIsBentOrOblique) {
  for (const LeafShape& shape : leafShapes()) {
    if (shape.bend != 0 || shape.oblique != 0) continue;
    const std::vector<glm::vec2> outline = leafOutline(shape);
    for (const glm::vec2& p : outline)
      EXPECT_TRUE(std::any_of(outline.begin(), outline.end(), [&](glm::vec2 q) { return glm::distance(q, {-p.x, p.y}) < 1e-6; })) << shape.name;
  }
}

TEST(LeafOutline, HasTheProportionsThatTheWordsMean) {
  const auto widestAt = [](const char* name) {
    const std::vector<glm::vec2> outline = leafOutline(*leafShapeNamed(name));
    return std::max_element(outline.begin(), outline.end(), [](auto a, auto b) { return a.x < b.x; })->y;
  };
  const auto lowest = [](const char* name) {
    const std::vector<glm::vec2> outline = leafOutline(*leafShapeNamed(name));
    return std::min_element(outline.begin(), outline.end(), [](auto a, auto b) { return a.y < b.y; })->y;
  };
  EXPECT_LT(widestAt("ovate"), 0.45);
  EXPECT_GT(widestAt("obovate"), 0.55);
  EXPECT_NEAR(widestAt("elliptic"), 0.5, 0.02);
  EXPECT_LT(lowest("cordate"), -0.05);
  EXPECT_LT(lowest("sagittate"), -0.15);
  EXPECT_GT(lowest("ovate"), -0.001);
}

// With every triangle facing up and a margin that does not cross itself, triangles whose areas add up to the outline's
// cannot overlap.
TEST(LeafParts, BladesAreTriangulatedWithoutOverlapsFacingUp) {
  for (const LeafShape& shape : leafShapes())
    for (const Detail detail : allDetails) {
      SCOPED_TRACE(shape.name + " " + std::to_string(static_cast<int>(detail)));
      const std::vector<double> areas = flatAreasOf(bladeOf(leafParts(shape, std::nullopt, detail)));
      EXPECT_GT(*std::min_element(areas.begin(), areas.end()), 0);
      EXPECT_NEAR(sumOf(areas) / areaOf(leafOutline(shape)), 1, detail == Detail::Close ? 0.03 : 0.35);
    }
}

TEST(LeafParts, StayCleanWhenTheWidthIsChanged) {
  for (const LeafShape& shape : leafShapes())
    for (const double factor : {0.4, 0.7, 1.5}) {
      SCOPED_TRACE(shape.name + " x " + std::to_string(factor));
      const std::vector<double> areas = flatAreasOf(bladeOf(leafParts(shape, factor * shape.widthToLength, Detail::Close)));
      EXPECT_GT(*std::min_element(areas.begin(), areas.end()), 0);
    }
}

TEST(LeafParts, AreSoundMeshes) {
  for (const LeafShape& shape : leafShapes())
    for (const Detail detail : allDetails)
      for (const Part& part : leafParts(shape, std::nullopt, detail)) expectSound(part, shape.name);
}

TEST(LeafParts, KeepToTheTriangleCountsOfTheirDetail) {
  for (const LeafShape& shape : leafShapes()) {
    SCOPED_TRACE(shape.name);
    const std::size_t close = trianglesOf(leafParts(shape, std::nullopt, Detail::Close));
    const std::size_t medium = trianglesOf(leafParts(shape, std::nullopt, Detail::Medium));
    const std::size_t far = trianglesOf(leafParts(shape, std::nullopt, Detail::Far));
    EXPECT_TRUE(close >= 100 && close <= 600) << close;
    EXPECT_TRUE(medium >= 25 && medium <= 64) << medium;
    EXPECT_TRUE(far >= 4 && far <= 10) << far;
  }
}

TEST(LeafParts, BeginAtTheOriginAndEndAtTheTip) {
  for (const LeafShape& shape : leafShapes())
    for (const Detail detail : allDetails) {
      const std::vector<Part> parts = leafParts(shape, std::nullopt, detail);
      const Mesh& blade = bladeOf(parts);
      const auto has = [&](glm::vec3 place) {
        return std::any_of(blade.positions.begin(), blade.positions.end(), [&](glm::vec3 p) { return glm::distance(p, place) < 1e-6f; });
      };
      EXPECT_TRUE(has({0, 0, 0})) << shape.name;
      EXPECT_TRUE(has({0, 1, 0})) << shape.name;
    }
}

TEST(LeafParts, FoldUpFromTheMidrib) {
  const std::vector<Part> parts = leafParts(*leafShapeNamed("ovate"), std::nullopt, Detail::Close);
  bool left = false;
  bool right = false;
  const Mesh& blade = bladeOf(parts);
  for (std::size_t i = 0; i < blade.positions.size(); ++i)
    if (blade.positions[i].x == 0) {
      left = left || blade.normals[i].x > 0.1f;
      right = right || blade.normals[i].x < -0.1f;
    }
  EXPECT_TRUE(left && right) << "the crease needs the normals of both halves";
}

// Two compilers must number vertices alike, or their mesh files differ: from the midrib out, from the base up.
TEST(LeafParts, VerticesAreNumberedFromTheBaseOutwards) {
  const std::vector<Part> parts = leafParts(*leafShapeNamed("deltoid"), std::nullopt, Detail::Close);
  const Mesh& blade = bladeOf(parts);
  EXPECT_EQ(blade.positions[0], glm::vec3(0, 0, 0));
  EXPECT_LT(blade.positions[0].x, blade.positions[1].x);
  EXPECT_LT(blade.positions[1].y, blade.positions[2].y);
}

TEST(LeafParts, TheSameArgumentsGiveTheSameMesh) {
  const LeafShape shape = *leafShapeNamed("palmately lobed");
  const auto once = leafParts(shape, 0.8, Detail::Close);
  const auto twice = leafParts(shape, 0.8, Detail::Close);
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].mesh, twice[i].mesh);
}

TEST(LeafParts, TeethAndObliquenessAndUndulationKeepTheBladeClean) {
  LeafShape shape = *leafShapeNamed("ovate");
  shape.teeth = 9;
  shape.toothDepth = 0.03;
  shape.oblique = 0.25;
  for (const LeafMargin margin : {LeafMargin::Serrate, LeafMargin::Dentate, LeafMargin::Crenate, LeafMargin::Undulate}) {
    SCOPED_TRACE(static_cast<int>(margin));
    shape.margin = margin;
    EXPECT_EQ(crossingsOf(leafOutline(shape)), 0);
    const std::vector<double> areas = flatAreasOf(bladeOf(leafParts(shape, std::nullopt, Detail::Close)));
    EXPECT_GT(*std::min_element(areas.begin(), areas.end()), 0);
  }
}

}  // namespace
}  // namespace axil::organs
