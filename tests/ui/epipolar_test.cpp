#include "ui/epipolar.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::ui {
namespace {

skeleton3d::Camera camera(const char* view) {
  return *skeleton3d::nominalCamera(view, {.model = skeleton3d::CameraModel::Perspective, .target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 1500, .size_px = {1000, 1200}});
}

double distanceTo(const std::vector<PhotoPoint>& line, PhotoPoint p) {
  double best = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::dvec2 along = line[i].px - line[i - 1].px;
    const double share = std::clamp(glm::dot(p.px - line[i - 1].px, along) / glm::dot(along, along), 0.0, 1.0);
    best = std::min(best, glm::distance(p.px, line[i - 1].px + share * along));
  }
  return best;
}

TEST(EpipolarLine, PassesThroughWhereThePointIsSeen) {
  const PlantPoint point{{0.1, 0.7, -0.15}};
  const auto line = epipolarLine(camera("front"), skeleton3d::project(camera("front"), point), camera("right"), {{0, 0.5, 0}}, 1);
  ASSERT_GT(line.size(), 10u);
  EXPECT_LT(distanceTo(line, skeleton3d::project(camera("right"), point)), 0.01);
  EXPECT_GT(distanceTo(line, skeleton3d::project(camera("right"), {{0.1, 0.75, -0.15}})), 5);
}

TEST(EpipolarLine, IsEmptyWhereACameraIsUnknown) {
  EXPECT_TRUE(epipolarLine({}, {{1, 2}}, camera("right"), {}, 1).empty());
  EXPECT_TRUE(epipolarLine(camera("right"), {{1, 2}}, {}, {}, 1).empty());
}

TEST(EpipolarLine, CrossesAStemWhereItsPointIsSeen) {
  const PlantPoint below{{0.1, 0.6, -0.15}}, above{{0.14, 0.8, -0.1}}, between{(below.at + above.at) / 2.0};
  const auto seen = [](PlantPoint p) { return skeleton3d::project(camera("right"), p); };
  const auto line = epipolarLine(camera("front"), skeleton3d::project(camera("front"), between), camera("right"), {{0, 0.5, 0}}, 1);
  const auto crossed = crossing(line, seen(below), seen(above));
  ASSERT_TRUE(crossed);
  EXPECT_LT(glm::distance(crossed->px, seen(between).px), 0.5);
  EXPECT_FALSE(crossing(line, seen(above), seen({{0.18, 1.0, -0.05}}))) << "another part of the stem";
  EXPECT_FALSE(crossing(line, line.front(), line.back())) << "along the line every place would do";
}

}  // namespace
}  // namespace axil::ui
