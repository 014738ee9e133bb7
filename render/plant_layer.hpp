#pragma once
/// \file
/// Private to render: the plant alone, as one camera sees it, on nothing. The rest of a picture is laid under it.

#include "base/result.hpp"
#include "render/daylight.hpp"
#include "render/flat_mesh.hpp"
#include "render/headless_window.hpp"
#include "skeleton3d/types.hpp"

#include <optional>

namespace axil::render {

/// sRGB with premultiplied coverage, 8 bits a channel, rows from the top, four bytes a pixel.
struct Layer {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;
};

/// What is to be seen, and from where. `floor` hides what is lower, as the ground does.
struct LayerScene {
  const PlantMesh& plant;
  const FlatMesh& mesh;
  const std::vector<PointLight>& light;
  const skeleton3d::Camera& camera;
  std::optional<double> floor;
};

struct LayerSize {
  int width_px = 0;
  int height_px = 0;
  int edgeSamples = 0;  ///< beside the four samples that every pixel is the mean of
};

[[nodiscard]] Result<Layer> drawLayer(HeadlessWindow& window, const LayerScene& scene, const LayerSize& size);

}  // namespace axil::render
