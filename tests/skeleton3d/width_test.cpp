#include "skeleton3d/width.hpp"

#include "base/rng.hpp"
#include "skeleton3d/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axil::skeleton3d {
namespace {

TEST(Width, TheEdgesOfARoundStemGiveItsRadiusThroughBothKindsOfCamera) {
  const double radius = 0.02;
  for (const CameraModel model : {CameraModel::Perspective, CameraModel::Orthographic}) {
    const View view{"front", *nominalCamera("front", {.model = model, .distance = 0.5, .focal_px = 1500, .scale_px_per_unit = 3000}), {1200, 1600}};
    // The tangents from the camera to the upright cylinder about the y axis.
    const double half = model == CameraModel::Perspective ? std::asin(radius / 0.5) : 0;
    const double left_px = model == CameraModel::Perspective ? 1500 * std::tan(half) : 3000 * radius;
    RidgeReading ridge;
    ridge.at = project(view.camera, {{0, 0, 0}});
    ridge.along = Angle::fromDegrees(90);
    ridge.width_px = 2 * left_px;
    ridge.sigmaWidth_px = 0.3;
    const MeasuredRadius measured = radiusFrom(view, ridge, {{0, 0, 0}});
    EXPECT_NEAR(measured.radius, radius, 1e-9);
    EXPECT_GT(measured.sigma, 0);
  }
}

TEST(Width, AViewInWhichSomethingMakesTheStemWiderIsLeftOut) {
  const MeasuredRadius good[] = {{1.0, 0.05}, {1.04, 0.05}, {1.9, 0.05}};
  const auto combined = combinedRadius(good);
  ASSERT_TRUE(combined);
  EXPECT_NEAR(combined->radius, 1.02, 1e-9);
  EXPECT_NEAR(combined->sigma, 0.05 / std::sqrt(2), 1e-9);
  EXPECT_FALSE(combinedRadius({}));
}

TEST(Width, ATaperNeverGrowsAndDoesNotHeedSingleWrongWidths) {
  Rng rng(4);
  std::vector<MeasuredRadius> radii;
  for (int i = 0; i < 60; ++i) radii.push_back({(1 - 0.01 * i) * (1 + 0.03 * rng.normal()) * (i % 7 == 3 ? 2.5 : 1), 0.03});
  const std::vector<double> tapered = taperedRadii(radii);
  ASSERT_EQ(tapered.size(), radii.size());
  for (std::size_t i = 0; i + 1 < tapered.size(); ++i) EXPECT_GE(tapered[i], tapered[i + 1]);
  for (std::size_t i = 0; i < tapered.size(); ++i) EXPECT_NEAR(tapered[i], 1 - 0.01 * static_cast<double>(i), 0.12) << i;
  EXPECT_TRUE(taperedRadii({}).empty());
}

}  // namespace
}  // namespace axil::skeleton3d
