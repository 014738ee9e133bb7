#include "render/picture.hpp"

#include "base/files.hpp"
#include "render/colour.hpp"
#include "render/known_plants.hpp"
#include "skeleton3d/camera.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace axil::render {
namespace {

using skeleton3d::Camera;
using skeleton3d::CameraModel;

/// Pictures worth a look are kept where AXIL_PICTURES says.
void keep(const std::string& name, const Image& image) {
  const char* folder = std::getenv("AXIL_PICTURES");
  if (folder == nullptr) return;
  ASSERT_TRUE(writePng(std::filesystem::path(folder) / name, image));
}

/// Small balls of one colour, each at its place.
PlantMesh balls(const std::vector<glm::dvec3>& places, float radius) {
  organs::Mesh ball;
  constexpr int rings = 24, sides = 48;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const double latitude = M_PI * r / rings, longitude = 2 * M_PI * s / sides;
      ball.normals.emplace_back(std::sin(latitude) * std::sin(longitude), std::cos(latitude), std::sin(latitude) * std::cos(longitude));
      ball.positions.push_back(ball.normals.back());
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sides; ++s) {
      const std::uint32_t a = r * sides + s, b = r * sides + (s + 1) % sides;
      for (const std::uint32_t v : {a, a + sides, b + sides, a, b + sides, b}) ball.triangles.push_back(v);
    }
  PlantMesh mesh;
  mesh.materials.push_back({.name = "ball", .colour = {0, 0, 0}, .roughness = 1, .surface = Surface::Solid});
  OrganModel model{.name = "ball", .parts = {{.material = 0, .mesh = ball}}, .placements = {}};
  for (std::size_t i = 0; i < places.size(); ++i)
    model.placements.push_back({.organ = simeco::OrganId(static_cast<int>(i)), .position = glm::vec3(places[i]), .rotation = {1, 0, 0, 0}, .scale = glm::vec3(radius)});
  mesh.models.push_back(model);
  return mesh;
}

/// The centre of what differs from the white background within `reach` pixels of `near`.
glm::dvec2 centreOfBlob(const Image& image, glm::dvec2 near, double reach) {
  glm::dvec2 sum(0);
  double weight = 0;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      if (glm::distance(pixel, near) > reach) continue;
      const double w = 255 - image.rgb[3 * static_cast<std::size_t>(y * image.width_px + x) + 1];
      sum += pixel * w;
      weight += w;
    }
  return weight > 0 ? sum / weight : glm::dvec2(-1);
}

const std::vector<glm::dvec3> knownPoints{{0, 0, 0}, {0.12, 0.3, -0.05}, {-0.2, 0.55, 0.1}, {0.05, 0.7, 0.2}, {-0.08, 0.2, -0.25}};

void expectEveryPointWhereItProjects(const Camera& camera, int width, int height, const std::string& name) {
  const PictureOptions options{.width_px = width, .height_px = height, .view = camera, .background = glm::vec3(1), .ground = Ground::None};
  const auto image = drawPlant(balls(knownPoints, 0.006f), options);
  ASSERT_TRUE(image) << image.error().message;
  keep(name, *image);
  for (const glm::dvec3& point : knownPoints) {
    const glm::dvec2 expected = skeleton3d::project(camera, {point}).px;
    const glm::dvec2 found = centreOfBlob(*image, expected, 14);
    EXPECT_LT(glm::distance(found, expected), 0.3) << name << ": expected " << expected.x << ", " << expected.y << ", found " << found.x << ", " << found.y;
  }
}

Camera perspectiveCamera(const char* view) {
  Camera camera = skeleton3d::nominalCamera(view, {.model = CameraModel::Perspective, .target = {{0, 0.4, 0}}, .distance = 2.2, .focal_px = 1500, .size_px = {700, 900}}).value();
  return camera;
}

TEST(ExactCamera, EveryPointIsWhereAPerspectivePhotoHasIt) {
  for (const char* view : {"front", "right", "top"}) {
    Camera camera = perspectiveCamera(view);
    camera.centre_px = {340, 455};  // a principal point off the middle
    camera.focal_px = glm::dvec2(1300, 1310);
    expectEveryPointWhereItProjects(camera, 700, 900, std::string("exact_") + view + ".png");
  }
}

TEST(ExactCamera, EveryPointIsWhereAnOrthographicPhotoHasIt) {
  const Camera camera = skeleton3d::nominalCamera("right", {.model = CameraModel::Orthographic, .target = {{0.01, 0.38, 0.02}}, .distance = 2, .scale_px_per_unit = 900, .size_px = {701, 903}}).value();
  expectEveryPointWhereItProjects(camera, 701, 903, "exact_orthographic.png");
}

TEST(ExactCamera, EveryPointIsWhereABentLensHasIt) {
  Camera camera = perspectiveCamera("front");
  camera.distortion = {-0.6, 0.5, 0.004, -0.003, 0.1};
  expectEveryPointWhereItProjects(camera, 700, 900, "exact_lens.png");
}

TEST(ExactCamera, AnUnknownCameraIsRefused) {
  const auto image = drawPlant(test::straightStem(2, 1, 0.01), {.view = Camera{}});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::BadInput);
}

TEST(Picture, IsTheSameBytesTwiceAndWithAPainterThatHasDrawnOthers) {
  const auto mesh = meshOf(test::shrub(1));
  const PictureOptions options{.width_px = 300, .height_px = 400};
  const auto once = drawPlant(*mesh, options);
  ASSERT_TRUE(once) << once.error().message;
  auto painter = Painter::open();
  ASSERT_TRUE(painter);
  ASSERT_TRUE(painter->draw(*mesh, {.width_px = 123, .height_px = 77, .view = ViewPreset::Top, .smoothing = Smoothing::Fine}));
  const auto again = painter->draw(*mesh, options);
  ASSERT_TRUE(again);
  EXPECT_EQ(*once, *again);
  EXPECT_EQ(*pngBytes(*once), *pngBytes(*again));
}

TEST(Picture, APresetFitsThePlantWithAMargin) {
  const auto mesh = meshOf(test::shrub(1));
  for (const ViewPreset preset : {ViewPreset::Front, ViewPreset::Right, ViewPreset::Top, ViewPreset::ThreeQuarter}) {
    const Camera camera = cameraFitting(*mesh, preset, 600, 800);
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::vec3& p : mesh->stems.positions) {
      const glm::dvec2 px = skeleton3d::project(camera, {glm::dvec3(p)}).px;
      low = glm::min(low, px);
      high = glm::max(high, px);
    }
    EXPECT_GT(low.x, 20);
    EXPECT_GT(low.y, 20);
    EXPECT_LT(high.x, 580);
    EXPECT_LT(high.y, 780);
    EXPECT_GT(std::max((high.x - low.x) / 600, (high.y - low.y) / 800), 0.5);
  }
}

TEST(Picture, FrontRightAndTopLookAsThePhotosDo) {
  const auto mesh = meshOf(test::straightStem(2, 1, 0.01));
  const auto at = [&](ViewPreset preset, glm::dvec3 p) { return skeleton3d::project(cameraFitting(*mesh, preset, 600, 800), {p}).px; };
  EXPECT_GT(at(ViewPreset::Front, {0.1, 0.5, 0}).x, at(ViewPreset::Front, {0, 0.5, 0}).x);
  EXPECT_GT(at(ViewPreset::Right, {0, 0.5, -0.1}).x, at(ViewPreset::Right, {0, 0.5, 0}).x);
  EXPECT_LT(at(ViewPreset::Top, {0, 0.5, -0.1}).y, at(ViewPreset::Top, {0, 0.5, 0}).y);
  EXPECT_LT(at(ViewPreset::Front, {0, 1, 0}).y, at(ViewPreset::Front, {0, 0, 0}).y);
}

TEST(Picture, ThePlantDarkensTheGroundAndTheGroundHidesWhatIsBelow) {
  const auto lit = drawPlant(PlantMesh{}, {.width_px = 300, .height_px = 400});
  ASSERT_TRUE(lit) << lit.error().message;
  simeco::Plant plant = test::shrub(1);
  const PlantMesh mesh = *meshOf(plant);
  const PictureOptions fixed{.width_px = 300, .height_px = 400, .view = cameraFitting(mesh, ViewPreset::ThreeQuarter, 300, 400)};
  const auto shaded = drawPlant(mesh, fixed);
  ASSERT_TRUE(shaded);
  keep("shaded.png", *shaded);
  std::size_t darker = 0;
  for (std::size_t y = 330; y < 390; ++y)
    for (std::size_t x = 0; x < 300; ++x)
      if (shaded->rgb[3 * (y * 300 + x)] + 12 < lit->rgb[3 * (y * 300 + x)]) ++darker;
  EXPECT_GT(darker, 200u);

  test::PlantMaker make;
  const auto root = make.style(simeco::OrganKind::Root);
  make.first({0, 0, 0}, {0.2, -1, 0.2}, 0.3, 0.02, root);
  const PlantMesh roots = *meshOf(make.plant);
  Camera above = cameraFitting(*meshOf(test::straightStem(1, 0.3, 0.02)), ViewPreset::ThreeQuarter, 300, 400);
  const auto hidden = drawPlant(roots, {.width_px = 300, .height_px = 400, .view = above, .background = glm::vec3(1), .ground = Ground::Shadow, .floorHeight = 0.0});
  const auto shown = drawPlant(roots, {.width_px = 300, .height_px = 400, .view = above, .background = glm::vec3(1), .ground = Ground::None});
  const auto ink = [](const Image& image) { return std::count_if(image.rgb.begin(), image.rgb.end(), [](std::uint8_t v) { return v < 120; }); };
  EXPECT_GT(ink(*shown), 4 * ink(*hidden));
}

TEST(Picture, TheFloorIsUnderWhatHangsAndAtTheCollarOfWhatStands) {
  const PlantMesh standing = *meshOf(test::straightStem(1, 0.3, 0.02));
  EXPECT_EQ(floorUnder(standing), standing.collar.at.y);
  test::PlantMaker make;
  make.first({0, 0, 0}, {0.2, -1, 0.2}, 0.3, 0.02, make.style(simeco::OrganKind::Root));
  const PlantMesh roots = *meshOf(make.plant);
  EXPECT_NEAR(floorUnder(roots), boundsOf(roots).low.y, 1e-9);
  EXPECT_LT(floorUnder(roots), -0.2);
  EXPECT_EQ(floorUnder(PlantMesh{}), 0);
}

TEST(Picture, APlantOfNothingShowsTheRoom) {
  const auto image = drawPlant(simeco::Plant{}, {.width_px = 60, .height_px = 80});
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_GT(*std::min_element(image->rgb.begin(), image->rgb.end()), 150);
}

TEST(Picture, SizesThatAreNoneOrTooLargeAreRefused) {
  EXPECT_EQ(drawPlant(simeco::Plant{}, {.width_px = 0, .height_px = 80}).error().code, ErrorCode::BadInput);
  EXPECT_EQ(drawPlant(simeco::Plant{}, {.width_px = 60'000, .height_px = 60'000}).error().code, ErrorCode::LimitReached);
}

TEST(Picture, ALargeOneIsDrawnInTilesWithoutSeams) {
  const PlantMesh mesh = *meshOf(test::straightStem(3, 1, 0.04));
  const auto large = drawPlant(mesh, {.width_px = 2500, .height_px = 300, .view = ViewPreset::Front, .background = glm::vec3(1), .ground = Ground::None});
  ASSERT_TRUE(large) << large.error().message;
  EXPECT_EQ(large->rgb.size(), 2500u * 300 * 3);
  Camera shifted = cameraFitting(mesh, ViewPreset::Front, 2500, 300);
  shifted.centre_px.x = 2048;  // the stem stands on the seam
  const auto onSeam = drawPlant(mesh, {.width_px = 2500, .height_px = 300, .view = shifted, .background = glm::vec3(1), .ground = Ground::None});
  ASSERT_TRUE(onSeam);
  // Both tiles agree: the row through the stem is one dark run.
  int changes = 0;
  for (std::size_t x = 1; x < 2500; ++x) {
    const auto dark = [&](std::size_t at) { return onSeam->rgb[3 * (150 * 2500 + at)] < 200; };
    changes += dark(x) != dark(x - 1) ? 1 : 0;
  }
  EXPECT_EQ(changes, 2);
}

TEST(Picture, AShrubLooksLikeOne) {
  for (const auto& [preset, name] : {std::pair{ViewPreset::ThreeQuarter, "shrub.png"}, {ViewPreset::Front, "shrub_front.png"}, {ViewPreset::Top, "shrub_top.png"}}) {
    const auto image = drawPlant(test::shrub(2), {.view = preset});
    ASSERT_TRUE(image) << image.error().message;
    keep(name, *image);
    std::size_t green = 0;
    for (std::size_t i = 0; i < image->rgb.size(); i += 3) green += image->rgb[i + 1] > image->rgb[i] + 20 && image->rgb[i + 1] > image->rgb[i + 2] + 20 ? 1 : 0;
    EXPECT_GT(green, image->rgb.size() / 3 / 25);
  }
}

}  // namespace
}  // namespace axil::render
