#include "render/turtle_shapes.hpp"

#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/known_plants.hpp"
#include "render/mesh_files.hpp"
#include "render/obstacles.hpp"
#include "render/picture.hpp"
#include "render/plant_mesh.hpp"
#include "render/polygon.hpp"

#include "base/rng.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace axil::render {
namespace {

using simeco::OrganKind;
using simeco::Plant;

double areaOf(std::span<const glm::dvec3> corners) {
  double area = 0;
  for (const auto& t : trianglesOf(corners)) area += 0.5 * glm::length(glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]));
  return area;
}

Plant plantWith(OrganKind kind, std::optional<glm::dvec4> colour = std::nullopt) {
  test::PlantMaker make;
  make.style(kind, {}, colour);
  return make.plant;
}

TEST(Polygon, AConcaveOneIsCutIntoTrianglesThatCoverItOnce) {
  const std::vector<glm::dvec3> arrow{{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {2, 1, 1}, {0, 4, 1}};
  EXPECT_EQ(trianglesOf(arrow).size(), 3u);
  EXPECT_NEAR(areaOf(arrow), 0.5 * glm::length(areaNormal(arrow)), 1e-12);  // no triangle lies outside or twice
}

TEST(Polygon, AnyStarKeepsItsAreaHoweverItIsTurned) {
  const std::uint64_t seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Rng rng(seed);
  for (int round = 0; round < 50; ++round) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.1, 1)));
    const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3(0.3, 1, 0.2)));
    std::vector<glm::dvec3> star;
    const int n = 3 + static_cast<int>(rng.uniform(0, 20));
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, out = rng.uniform(0.2, 2);
      star.push_back(x * (out * std::cos(angle)) + y * (out * std::sin(angle)) + glm::dvec3(5, -3, 2));
    }
    EXPECT_EQ(trianglesOf(star).size(), static_cast<std::size_t>(n - 2));
    EXPECT_NEAR(areaOf(star), 0.5 * glm::length(areaNormal(star)), 1e-9) << "round " << round;
  }
}

TEST(Polygon, OneWithoutAreaGivesNothingThatBreaks) {
  const std::vector<glm::dvec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(trianglesOf(line).size(), 2u);
  EXPECT_TRUE(trianglesOf(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(TurtleShapes, AreDrawnWhereTheyAreAndNumberedAfterTheOrgans) {
  Plant plant = test::straightStem(2, 1, 0.05);
  plant.styles.push_back({.kind = OrganKind::Leaf, .stage = 1, .model = {}, .texture = {}, .colour = glm::dvec4(1, 0, 0, 1), .growTime = 0});
  plant.faces.push_back({.vertices = {{{0, 2, 0}}, {{1, 2, 0}}, {{1, 3, 0}}, {{0, 3, 0}}}, .style = 1});
  plant.balls.push_back({.centre = {{5, 0, 0}}, .radius = 0.5, .style = 1});
  plant.discs.push_back({.centre = {{-5, 0, 0}}, .normal = PlantDirection::along({1, 1, 0}), .radius = 0.25, .style = 1});
  const auto mesh = meshOf(plant);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->faces.sources.size(), 2u);
  const Bounds bounds = boundsOf(*mesh);
  EXPECT_NEAR(bounds.high.x, 5.5, 1e-6);
  EXPECT_NEAR(bounds.low.x, -5 - 0.25 / std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(bounds.high.y, 3, 1e-6);
  std::set<std::int32_t> drawn;
  const FlatMesh flat = flattened(*mesh);
  for (const TriangleSource& source : flat.sources) drawn.insert(source.organ.value);
  EXPECT_EQ(drawn, (std::set<std::int32_t>{0, 1, faceId(plant, 0).value, ballId(plant, 0).value, discId(plant, 0).value}));
  for (std::size_t i = 0; i < flat.triangles.size(); ++i) ASSERT_LT(flat.triangles[i], flat.positions.size());
}

TEST(TurtleShapes, StandInEveryMeshFile) {
  Plant plant = plantWith(OrganKind::Leaf);
  plant.faces.push_back({.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}, .style = 0});
  plant.balls.push_back({.centre = {{0, 2, 0}}, .radius = 0.5, .style = 0});
  const auto mesh = meshOf(plant);
  ASSERT_TRUE(mesh);
  const auto glb = glbBytes(*mesh);
  ASSERT_TRUE(glb);
  EXPECT_NE(glb->find("\"faces\""), std::string::npos);
  EXPECT_NE(glb->find("ball 1"), std::string::npos);
  const auto obj = objAndMtl(*mesh, "plant.mtl");
  ASSERT_TRUE(obj);
  EXPECT_NE(obj->obj.find("g organ_0\nusemtl face\nf 1//1 2//2 3//3\n"), std::string::npos) << obj->obj.substr(0, 300);
  EXPECT_NE(obj->obj.find("g organ_1\nusemtl ball\n"), std::string::npos);
  EXPECT_GT(plyBytes(*mesh).size(), 1000u);
}

TEST(TurtleShapes, AFaceKeepsTheColourThatItsIndexSays) {
  const glm::vec3 red = paintColour({0.9, 0.1, 0.1, 1});
  EXPECT_GT(red.r, 4 * red.g);
  const glm::vec3 white = paintColour({1, 1, 1, 1});
  EXPECT_GT(std::min({white.r, white.g, white.b}), 0.8f);
  const glm::vec3 green = paintColour({0, 1, 0, 1});
  EXPECT_GT(green.g, green.r);
  EXPECT_LT(green.g, 0.4f);  // a leaf's, not a lamp's
}

TEST(TurtleShapes, OneThatIsNowhereIsRefusedByItsNumber) {
  Plant plant = plantWith(OrganKind::Leaf);
  plant.faces.push_back({.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, std::numeric_limits<double>::quiet_NaN(), 0}}}, .style = 0});
  const auto mesh = meshOf(plant);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("polygon 0"), std::string::npos) << mesh.error().message;
}

/// A bent line of two pieces as a turtle draws it, and as a grammar of organs grows it.
Plant bentLine(std::optional<double> tipRadius) {
  Plant plant = test::stemThrough({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 0.05);
  for (simeco::Organ& organ : plant.organs) organ.tipRadius = tipRadius;
  return plant;
}

TEST(TurtleStems, KeepTheirCornersAndEndAsWideAsTheTurtleSays) {
  const auto turtle = meshOf(bentLine(0.05)), grown = meshOf(bentLine(std::nullopt));
  ASSERT_TRUE(turtle && grown);
  const auto farthest = [](const PlantMesh& mesh) {  // from the two straight lines
    double most = 0;
    for (const glm::vec3& p : mesh.stems.positions) {
      const glm::dvec3 at(p);
      const double toFirst = glm::distance(at, glm::dvec3(0, std::clamp(at.y, 0.0, 1.0), 0)), toSecond = glm::distance(at, glm::dvec3(std::clamp(at.x, 0.0, 1.0), 1, 0));
      most = std::max(most, std::min(toFirst, toSecond));
    }
    return most;
  };
  EXPECT_NEAR(farthest(*turtle), 0.05, 1e-6);
  EXPECT_GT(farthest(*grown), 0.055);
  const auto widthAtTip = [](const PlantMesh& mesh) {
    double most = 0;
    for (const glm::vec3& p : mesh.stems.positions)
      if (p.x > 0.999) most = std::max(most, std::abs(static_cast<double>(p.z)));
    return most;
  };
  EXPECT_NEAR(widthAtTip(*turtle), 0.05, 1e-3);
  EXPECT_LT(widthAtTip(*grown), 0.04);
}

TEST(Obstacles, AreDrawnBesideThePlantAndBelongToNoOrgan) {
  const PlantMesh plant = meshOf(test::straightStem(3, 0.3, 0.01)).value();
  const PlantMesh all = withObstacles(plant, {simeco::SphereObstacle{{{0.5, 0.2, 0}}, 0.1}, simeco::BoxObstacle{{{-1, 0, -1}}, {{-0.5, 1, 1}}}});
  EXPECT_EQ(all.stems, plant.stems);
  for (const TriangleSource& source : all.faces.sources) EXPECT_FALSE(source.organ.valid());
  // Every triangle looks outwards: the sum of the signed volumes is that of both bodies.
  double volume = 0;
  for (std::size_t t = 0; t < all.faces.triangles.size(); t += 3) {
    const glm::dvec3 a(all.faces.positions[all.faces.triangles[t]]), b(all.faces.positions[all.faces.triangles[t + 1]]), c(all.faces.positions[all.faces.triangles[t + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  EXPECT_NEAR(volume, 1.0 + 4.0 / 3 * std::numbers::pi * 0.001, 1e-3);
}

TEST(Obstacles, ThePictureMakesRoomForANearOneAndNotForAWall) {
  const PlantMesh plant = meshOf(test::straightStem(3, 0.3, 0.01)).value();
  const auto framed = obstaclesToFrame(plant, {simeco::SphereObstacle{{{0.2, 0.2, 0}}, 0.05}, simeco::BoxObstacle{{{-50, 0, -1}}, {{50, 1, -0.5}}}});
  EXPECT_EQ(framed.size(), 1u);
}

TEST(Obstacles, ChangeThePicture) {
  const PlantMesh plant = meshOf(test::straightStem(3, 0.3, 0.01)).value();
  PictureOptions options{.width_px = 60, .height_px = 80};
  const auto without = drawPlant(plant, options);
  options.obstacles = {simeco::SphereObstacle{{{0.1, 0.2, 0}}, 0.08}};
  const auto with = drawPlant(plant, options);
  ASSERT_TRUE(without && with);
  EXPECT_NE(without->rgb, with->rgb);
}

}  // namespace
}  // namespace axil::render
