#include "skeleton3d/camera.hpp"

#include "random_cameras.hpp"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace axil::skeleton3d {
namespace {

double distanceTo(const Ray& ray, PlantPoint p) { return glm::length(glm::cross(p.at - ray.origin.at, ray.direction.unit())); }

TEST(Camera, TheRayThroughAProjectedPointPassesThroughThePoint) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng rng(seed);
    const Camera camera = test::randomCamera(rng);
    const PlantPoint point{test::randomVector(rng, 0.5)};
    ASSERT_LT(distanceTo(rayThrough(camera, project(camera, point)), point), 1e-11) << "seed " << seed;
  }
}

TEST(Camera, EveryPointOfARayProjectsToItsPixel) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng rng(seed);
    const Camera camera = test::randomCamera(rng);
    const PhotoPoint pixel{{rng.uniform(200, 2200), rng.uniform(200, 2200)}};
    const Ray ray = rayThrough(camera, pixel);
    const PlantPoint far{ray.origin.at + rng.uniform(1, 9) * ray.direction.unit()};
    ASSERT_TRUE(isInFront(camera, far));
    ASSERT_LT(glm::length(project(camera, far).px - pixel.px), 1e-8) << "seed " << seed;
  }
}

TEST(Camera, DistortsAsTheLensModelOfOpenCvSays) {
  Camera camera = cameraAt(glm::dmat3(1.0), {.distance = 0, .focal_px = 1, .size_px = {0, 0}});
  camera.distortion = {0.1, 0.01, 0.002, 0.003, 0.0005};
  // x = 0.5, y = 0.25: r2 = 0.3125, radial = 1 + 0.1 r2 + 0.01 r2^2 + 0.0005 r2^3 = 1.032241821...
  const double radial = 1 + 0.1 * 0.3125 + 0.01 * 0.09765625 + 0.0005 * 0.030517578125;
  const glm::dvec2 px = project(camera, {{1.0, 0.5, 2.0}}).px;
  EXPECT_NEAR(px.x, 0.5 * radial + 2 * 0.002 * 0.125 + 0.003 * (0.3125 + 0.5), 1e-15);
  EXPECT_NEAR(px.y, 0.25 * radial + 0.002 * (0.3125 + 0.125) + 2 * 0.003 * 0.125, 1e-15);
}

TEST(Camera, NominalViewsLookAlongTheAxesOfTheFormat) {
  const Framing framing{.model = CameraModel::Orthographic, .scale_px_per_unit = 100, .size_px = {200, 200}};
  struct Expected {
    const char* view;
    glm::dvec2 x, y, z;  // where the unit points of the axes are seen, from the picture's middle
  };
  for (const Expected& e : {Expected{"front", {100, 0}, {0, -100}, {0, 0}}, Expected{"right", {0, 0}, {0, -100}, {-100, 0}}, Expected{"top", {100, 0}, {0, 0}, {0, 100}},
                            Expected{"back", {-100, 0}, {0, -100}, {0, 0}}, Expected{"left", {0, 0}, {0, -100}, {100, 0}}}) {
    const auto camera = nominalCamera(e.view, framing);
    ASSERT_TRUE(camera) << e.view;
    EXPECT_TRUE(checkCamera(*camera, e.view)) << e.view;
    const auto seen = [&](glm::dvec3 p) { return project(*camera, {p}).px - glm::dvec2{100, 100}; };
    EXPECT_LT(glm::length(seen({1, 0, 0}) - e.x), 1e-12) << e.view;
    EXPECT_LT(glm::length(seen({0, 1, 0}) - e.y), 1e-12) << e.view;
    EXPECT_LT(glm::length(seen({0, 0, 1}) - e.z), 1e-12) << e.view;
  }
  EXPECT_EQ(nominalCamera("from below", framing).error().code, ErrorCode::NotFound);
}

TEST(Camera, FramingPutsTheTargetInTheMiddleAtItsDistance) {
  const auto camera = nominalCamera("right", {.target = {{0.1, 0.4, -0.2}}, .distance = 2, .focal_px = 1000});
  ASSERT_TRUE(camera);
  EXPECT_EQ(project(*camera, {{0.1, 0.4, -0.2}}).px, glm::dvec2(600, 800));
  EXPECT_NEAR(toPlant(*camera, {{0, 0, 0}}).at.x, 2.1, 1e-12);
  EXPECT_FALSE(isInFront(*camera, {{2.2, 0.4, -0.2}}));
}

TEST(CheckCamera, AcceptsRandomGoodCameras) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const auto checked = checkCamera(test::randomCamera(rng), "front", {1200, 1200});
    EXPECT_TRUE(checked) << seed << ": " << checked.error().message;
  }
}

void expectRefused(const Camera& camera, const std::string& what) {
  const auto checked = checkCamera(camera, "side", {1000, 1000});
  ASSERT_FALSE(checked) << what;
  EXPECT_EQ(checked.error().code, ErrorCode::BadInput);
  EXPECT_NE(checked.error().message.find("'side'"), std::string::npos);
  EXPECT_NE(checked.error().message.find(what), std::string::npos) << checked.error().message;
}

TEST(CheckCamera, SaysWhatIsWrong) {
  const Camera good = cameraAt(*nominalRotation("front"), {.focal_px = 1000, .size_px = {1000, 1000}});
  ASSERT_TRUE(checkCamera(good, "side", {1000, 1000}));
  Camera c = good;
  c.rotation[0] = -c.rotation[0];
  expectRefused(c, "mirrors");
  c = good;
  c.rotation *= 1.01;
  expectRefused(c, "unit and perpendicular");
  c = good;
  c.rotation[1][1] = std::nan("");
  expectRefused(c, "finite");
  c = good;
  c.focal_px = glm::dvec2{1000, 0};
  expectRefused(c, "focal");
  c.focal_px.reset();
  expectRefused(c, "focal");
  c = good;
  c.distortion[0] = -2;  // folds at r = 0.41, inside the photo's corner at 0.71
  expectRefused(c, "folds");
  c = good;
  c.model = CameraModel::Orthographic;
  c.scale_px_per_unit = -3;
  expectRefused(c, "scale");
}

}  // namespace
}  // namespace axil::skeleton3d
