#pragma once
/// \file
/// Private to skeleton3d: the space that masks leave of a plant, as small cubes joined to their neighbours.

#include "skeleton3d/mask_lines.hpp"

#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

struct SeenMask {
  const View* view = nullptr;
  MaskLines lines;
};

struct CubeInView {
  std::int32_t pixel = -1;  ///< number of the middle line's nearest pixel
  float off_px = 0;         ///< how far that is
  float cube_px = 1;        ///< a cube's side there
};

struct Cubes {
  double side = 0;
  std::vector<glm::ivec3> at;                   ///< grid places, sorted
  glm::dvec3 origin{0, 0, 0};
  std::vector<std::vector<CubeInView>> seen;    ///< of each cube, by view

  [[nodiscard]] PlantPoint centre(std::size_t i) const { return {origin + side * (glm::dvec3(at[i]) + 0.5)}; }
};

/// `cubesAcross` cubes along the plant's reach, or fewer where that would be more than `kMostCubes` in all: masks of a leafy plant leave
/// much space. Fails with NoAnswer where nothing is common to all masks, with Cancelled.
inline constexpr std::size_t kMostCubes = 500'000;
[[nodiscard]] Result<Cubes> carvedCubes(std::span<const SeenMask> masks, int cubesAcross, const Watch& watch);

}  // namespace axil::skeleton3d::detail
