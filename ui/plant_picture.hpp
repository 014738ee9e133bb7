#pragma once
/// \file
/// Pictures of the growing plant for the 3D pane, drawn in the background at the pace the machine can.

#include "render/types.hpp"
#include "simeco/growth.hpp"
#include "skeleton3d/types.hpp"
#include "ui/state.hpp"
#include "ui/worker.hpp"

#include <optional>
#include <string>

namespace axil::ui {

struct PlantQuestion {
  simeco::Growth growth;
  double time = 0;
  skeleton3d::Camera camera;
  glm::ivec2 size_px{0, 0};
  std::optional<double> measuredUntil = {};  ///< what is born later is predicted, and tinted
};

struct PlantPicture {
  render::Image image;
  skeleton3d::Camera camera;
  glm::ivec2 size_px{0, 0};
  double seconds = 0;
  std::optional<Error> trouble;
};

using PlantDrawer = Worker<PlantQuestion, PlantPicture>;
/// To be made on the drawing thread: it owns a drawing context.
[[nodiscard]] PlantDrawer::Work drawingWork();

/// The camera of the 3D pane: `orbit` around a plant that reaches `reach` from `middle`, in a picture of `size_px`.
[[nodiscard]] skeleton3d::Camera orbitCamera(const Orbit& orbit, PlantPoint middle, double reach, glm::ivec2 size_px);
/// The same camera for a picture of another size.
[[nodiscard]] skeleton3d::Camera resized(skeleton3d::Camera camera, double factor);

}  // namespace axil::ui
