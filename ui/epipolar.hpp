#pragma once
/// \file
/// The epipolar line: all the places in one photo that a click in another photo may mean. Straight without lens distortion.

#include "skeleton3d/camera.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axil::ui {

/// The line of `at` in the photo of `to`, as points in order along the ray; empty where either camera is unknown. `reach` says how far
/// from `middle`, the middle of the plant, the plant may be (project's unit).
[[nodiscard]] std::vector<PhotoPoint> epipolarLine(const skeleton3d::Camera& from, PhotoPoint at, const skeleton3d::Camera& to, PlantPoint middle,
                                                   double reach);

/// Where that line crosses the straight way from `a` to `b`; nothing where it does not, or runs too nearly along it to say.
[[nodiscard]] std::optional<PhotoPoint> crossing(std::span<const PhotoPoint> line, PhotoPoint a, PhotoPoint b);

}  // namespace axil::ui
