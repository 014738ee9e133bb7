#include "render/plant_mesh.hpp"

#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/highlight.hpp"
#include "render/known_plants.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <set>

namespace axil::render {
namespace {

using simeco::OrganId;
using simeco::OrganKind;

TEST(PlantMesh, EveryOrganWithABodyIsDrawnUnderItsOwnId) {
  const simeco::Plant plant = test::shrub(2);
  const auto mesh = meshOf(plant);
  ASSERT_TRUE(mesh) << mesh.error().message;
  std::set<std::int32_t> drawn;
  for (const TriangleSource& source : flattened(*mesh).sources) drawn.insert(source.organ.value);
  EXPECT_EQ(drawn.size(), plant.organs.size());
}

TEST(PlantMesh, ALeafStandsAtItsBaseAndReachesItsTip) {
  test::PlantMaker make;
  const OrganId stem = make.first({0.1, 0.2, 0.3}, {0, 1, 0}, 0.1, 0.004, make.style(OrganKind::Stem));
  make.on(stem, true, {1, 0.2, 0.3}, 0.05, 0.012, make.style(OrganKind::Leaf, "ovate.i"));
  const auto& leaf = make.plant.organs.back();
  const auto mesh = meshOf(make.plant);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->models.size(), 1u);
  const Placement& at = mesh->models[0].placements.at(0);
  EXPECT_LT(glm::distance(glm::dvec3(at.position), leaf.base.at), 1e-7);
  EXPECT_LT(glm::distance(glm::dvec3(at.position + at.rotation * (at.scale * glm::vec3(0, 1, 0))), leaf.tip().at), 1e-6);
  EXPECT_LT(glm::distance(glm::dvec3(at.rotation * glm::vec3(0, 0, 1)), leaf.adaxial.unit()), 1e-6);
  float low = 0, high = 0;
  for (const glm::vec3& p : mesh->models[0].parts[0].mesh.positions) {
    low = std::min(low, p.x * at.scale.x);
    high = std::max(high, p.x * at.scale.x);
  }
  EXPECT_NEAR(high - low, 0.024, 1e-6);  // twice the organ's radius
}

TEST(PlantMesh, HighlightedOrgansKeepTheirTrianglesAndChangeTheirColour) {
  const simeco::Plant plant = test::shrub(2);
  const PlantMesh plain = meshOf(plant).value();
  std::vector<bool> chosen(plant.organs.size(), false);
  for (std::size_t i = chosen.size() / 2; i < chosen.size(); ++i) chosen[i] = true;
  const PlantMesh changed = highlighted(plain, chosen, {.colour = {0, 0, 1}, .share = 1});
  EXPECT_EQ(changed.triangleCount(), plain.triangleCount());
  EXPECT_EQ(changed.stems.triangles, plain.stems.triangles);
  std::size_t blue = 0, placed = 0;
  for (const OrganModel& model : changed.models)
    for (const Placement& placement : model.placements) {
      ++placed;
      const bool isBlue = changed.materials[static_cast<std::size_t>(model.parts[0].material)].colour == glm::vec3(0, 0, 1);
      EXPECT_EQ(isBlue, chosen[static_cast<std::size_t>(placement.organ.value)]);
      blue += isBlue ? 1 : 0;
    }
  EXPECT_GT(blue, 0u);
  EXPECT_LT(blue, placed);
  EXPECT_EQ(highlighted(plain, {}, {.colour = {0, 0, 1}, .share = 1}), plain);
}

TEST(PlantMesh, LeavesThatLookTheSameShareAModel) {
  test::PlantMaker make;
  const OrganId stem = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.004, make.style(OrganKind::Stem));
  for (int i = 0; i < 5; ++i) {
    make.plant.styles.push_back({.kind = OrganKind::Leaf, .stage = 100 + i, .model = "Ovate.i", .texture = {}, .colour = std::nullopt, .growTime = 0});
    make.on(stem, true, {1, 0.1 * i, 0}, 0.05, 0, static_cast<std::int32_t>(make.plant.styles.size()) - 1);
  }
  const auto mesh = meshOf(make.plant);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->models.size(), 1u);
  EXPECT_EQ(mesh->models[0].placements.size(), 5u);
}

TEST(PlantMesh, AnUnknownModelIsSaidOnce) {
  test::PlantMaker make;
  const OrganId stem = make.first({0, 0, 0}, {0, 1, 0}, 0.1, 0.004, make.style(OrganKind::Stem));
  for (int i = 0; i < 3; ++i) make.on(stem, true, {1, 0.1 * i, 0}, 0.05, 0, make.style(OrganKind::Leaf, "banana split.i"));
  const auto mesh = meshOf(make.plant);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->notes.size(), 1u);
  EXPECT_NE(mesh->notes[0].find("banana split"), std::string::npos);
}

TEST(PlantMesh, AStemWithoutARadiusIsStillSeen) {
  const auto mesh = meshOf(test::straightStem(3, 1, 0));
  ASSERT_TRUE(mesh);
  const Bounds bounds = boundsOf(*mesh);
  EXPECT_GT(bounds.size().x, 1e-3);
  EXPECT_LT(bounds.size().x, 0.1);
}

TEST(PlantMesh, AnEmptyPlantIsAnEmptyMesh) {
  const auto mesh = meshOf(simeco::Plant{});
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangleCount(), 0u);
  EXPECT_TRUE(boundsOf(*mesh).empty());
}

TEST(PlantMesh, AnOrganWithoutAFinitePlaceIsRefusedByName) {
  simeco::Plant plant = test::straightStem(3, 1, 0.01);
  plant.organs[1].length = std::numeric_limits<double>::quiet_NaN();
  const auto mesh = meshOf(plant);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::BadInput);
  EXPECT_NE(mesh.error().message.find("organ 1 (Stem"), std::string::npos) << mesh.error().message;
}

TEST(PlantMesh, TooManyTrianglesAreRefused) {
  const auto mesh = meshOf(test::shrub(2), {.detail = std::nullopt, .maximumTriangles = 1000});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::LimitReached);
}

TEST(PlantMesh, FarIsMuchLighterThanClose) {
  const simeco::Plant plant = test::shrub(1);
  const auto close = meshOf(plant, {.detail = organs::Detail::Close}), far = meshOf(plant, {.detail = organs::Detail::Far});
  EXPECT_GT(close->triangleCount(), 5 * far->triangleCount());
}

TEST(Colour, PureGreenBecomesALeafsGreen) {
  const glm::dvec3 srgb = srgbFromLinear(naturalColour({0, 1, 0, 1}, OrganKind::Leaf));
  EXPECT_GT(srgb.g, srgb.r);
  EXPECT_GT(srgb.r, srgb.b);
  EXPECT_LT(srgb.g, 0.55);
  EXPECT_GT(srgb.b, 0.1);
}

TEST(Colour, AMutedColourStaysAsItIs) {
  const glm::dvec4 bark{0.35, 0.30, 0.28, 1};
  const glm::dvec3 srgb = srgbFromLinear(naturalColour(bark, OrganKind::Stem));
  EXPECT_LT(glm::distance(srgb, glm::dvec3(bark)), 1e-3);
}

TEST(Colour, SrgbAndBackIsTheSame) {
  for (int i = 0; i < 256; ++i) EXPECT_EQ(rgb8FromLinear(linearFromSrgb(glm::dvec3(i / 255.0))).g, i);
}

}  // namespace
}  // namespace axil::render
