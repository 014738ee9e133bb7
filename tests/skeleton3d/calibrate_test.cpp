#include "skeleton3d/calibrate.hpp"

#include "base/rng.hpp"
#include "skeleton3d/camera.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>

namespace axil::skeleton3d {
namespace {

namespace fs = std::filesystem;

constexpr int kWide = 640, kHigh = 480;

/// A photo of a 9 x 6 board by `camera`, every pixel from four samples traced back through the lens.
cv::Mat boardSeenBy(const Camera& camera) {
  cv::Mat picture(kHigh, kWide, CV_8UC3);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      int sum = 0;
      for (const glm::dvec2 part : {glm::dvec2{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
        const Ray ray = rayThrough(camera, {glm::dvec2{x, y} + part});
        const double t = -ray.origin.at.z / ray.direction.unit().z;  // the board lies in z = 0
        const glm::dvec3 at = ray.origin.at + t * ray.direction.unit();
        const bool rim = at.x < -1.7 || at.y < -1.7 || at.x > 9.7 || at.y > 6.7;
        const bool board = at.x >= -1 && at.y >= -1 && at.x < 9 && at.y < 6;
        const bool black = board && (static_cast<int>(std::floor(at.x) + std::floor(at.y) + 4) % 2 == 0);
        sum += t <= 0 || rim ? 120 : black ? 25 : 235;
      }
      const auto grey = static_cast<std::uint8_t>(sum / 4);
      picture.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  return picture;
}

Camera boardCamera(Rng& rng, double tilt_deg) {
  Camera camera;
  camera.model = CameraModel::Perspective;
  camera.focal_px = glm::dvec2{600, 604};
  camera.centre_px = {326, 235};
  camera.distortion = {-0.12, 0.05, 0.001, -0.0008, 0};
  const double turn = rng.uniform(0, 6.28), tilt = Angle::fromDegrees(tilt_deg).radians();
  const glm::dvec3 forward{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
  camera.rotation = rotationLookingAlong(PlantDirection::along(forward), PlantDirection::along({0.1 * rng.normal(), -1, 0}));
  const glm::dvec3 target{4 + rng.uniform(-1, 1), 2.5 + rng.uniform(-0.7, 0.7), 0};
  camera.translation = glm::dvec3{0, 0, rng.uniform(13, 15)} - camera.rotation * target;
  return camera;
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("axil_calibrate_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

TEST(CalibrateLens, FindsTheLensThatTookRenderedBoards) {
  const Folder folder;
  Rng rng(7);
  std::printf("seed 7\n");
  std::vector<fs::path> photos;
  for (int i = 0; i < 7; ++i) {
    photos.push_back(folder.path / ("board" + std::to_string(i) + ".png"));
    cv::imwrite(photos.back().string(), boardSeenBy(boardCamera(rng, 28)));
  }
  const fs::path empty = folder.path / "empty.png";
  cv::imwrite(empty.string(), cv::Mat(kHigh, kWide, CV_8UC3, cv::Scalar(90, 90, 90)));
  photos.push_back(empty);
  const auto lens = calibrateLens(photos);
  ASSERT_TRUE(lens) << lens.error().message;
  std::printf("focal %.1f %.1f (truth 600 604), centre %.1f %.1f (326 235), k1 %.4f (-0.12), rms %.3f px\n", lens->focal_px.x, lens->focal_px.y, lens->centre_px.x, lens->centre_px.y,
              lens->distortion[0], lens->rms_px);
  EXPECT_EQ(lens->corners, glm::ivec2(9, 6));
  EXPECT_NEAR(lens->focal_px.x, 600, 3);
  EXPECT_NEAR(lens->focal_px.y, 604, 3);
  EXPECT_NEAR(lens->centre_px.x, 326, 3);
  EXPECT_NEAR(lens->centre_px.y, 235, 3);
  EXPECT_NEAR(lens->distortion[0], -0.12, 0.01);
  EXPECT_LT(lens->rms_px, 0.2);
  EXPECT_EQ(lens->photos.back().fault, "the board was not found");
}

TEST(CalibrateLens, SaysWhatIsWrong) {
  const Folder folder;
  EXPECT_FALSE(calibrateLens({}));
  const std::vector<fs::path> missing{folder.path / "none.png"};
  EXPECT_FALSE(calibrateLens(missing));
  std::vector<fs::path> photos;
  Rng rng(8);
  for (int i = 0; i < 3; ++i) {
    photos.push_back(folder.path / ("flat" + std::to_string(i) + ".png"));
    cv::imwrite(photos.back().string(), boardSeenBy(boardCamera(rng, 0)));
  }
  const auto flat = calibrateLens(photos);
  ASSERT_FALSE(flat);
  EXPECT_NE(flat.error().message.find("faces the same way"), std::string::npos) << flat.error().message;
  EXPECT_FALSE(calibrateLens(photos, {.corners = glm::ivec2{2, 2}}));
  cv::imwrite(photos[1].string(), cv::Mat(100, 80, CV_8UC3, cv::Scalar(9, 9, 9)));
  const auto sizes = calibrateLens(photos);
  ASSERT_FALSE(sizes);
  EXPECT_NE(sizes.error().message.find("photos of one size"), std::string::npos);
}

}  // namespace
}  // namespace axil::skeleton3d
