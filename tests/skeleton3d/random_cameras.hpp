#pragma once
/// \file
/// Random cameras that look at a plant of about unit size near the origin, and random points of it.

#include "base/rng.hpp"
#include "skeleton3d/camera.hpp"

#include <string>
#include <vector>

namespace axil::test {

inline glm::dvec3 randomVector(Rng& rng, double size) { return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)}; }

inline PlantDirection randomDirection(Rng& rng) {
  for (;;) {
    const glm::dvec3 v = randomVector(rng, 1);
    if (glm::length(v) > 0.1 && glm::length(v) < 1) return PlantDirection::along(v);
  }
}

inline skeleton3d::Camera randomCamera(Rng& rng, skeleton3d::CameraModel model) {
  const PlantDirection forward = randomDirection(rng);
  PlantDirection up = randomDirection(rng);
  while (areParallel(forward, up)) up = randomDirection(rng);
  skeleton3d::Camera camera = skeleton3d::cameraAt(skeleton3d::rotationLookingAlong(forward, up), {.model = model,
                                                                                       .target = {randomVector(rng, 0.1)},
                                                                                       .distance = rng.uniform(3, 6),
                                                                                       .focal_px = rng.uniform(1500, 3000),
                                                                                       .scale_px_per_unit = rng.uniform(300, 900),
                                                                                       .size_px = {2400, 2400}});
  if (model == skeleton3d::CameraModel::Perspective) {
    camera.focal_px->y *= rng.uniform(0.95, 1.05);
    camera.distortion = {rng.uniform(-0.1, 0.2), rng.uniform(-0.05, 0.05), rng.uniform(-0.003, 0.003), rng.uniform(-0.003, 0.003), rng.uniform(-0.02, 0.02)};
  }
  return camera;
}

inline skeleton3d::Camera randomCamera(Rng& rng) {
  return randomCamera(rng, rng.uniform() < 0.5 ? skeleton3d::CameraModel::Perspective : skeleton3d::CameraModel::Orthographic);
}

inline std::vector<skeleton3d::View> randomViews(Rng& rng, int count) {
  std::vector<skeleton3d::View> views;
  for (int i = 0; i < count; ++i) views.push_back({"view" + std::to_string(i), randomCamera(rng), {0, 0}});
  return views;
}

inline skeleton3d::ClickedNode clicked(const std::vector<skeleton3d::View>& views, int id, PlantPoint point) {
  skeleton3d::ClickedNode node{skeleton3d::NodeId(id), {}, std::nullopt};
  for (const auto& view : views) node.clicks[view.name] = skeleton3d::project(view.camera, point);
  return node;
}

}  // namespace axil::test
