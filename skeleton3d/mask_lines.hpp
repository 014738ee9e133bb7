#pragma once
/// \file
/// Private to skeleton3d: a mask's middle lines and distances to them.

#include "skeleton3d/draft.hpp"

#include <vector>

namespace axil::skeleton3d::detail {

/// All row by row, as the mask.
struct MaskLines {
  int width = 0, height = 0;
  std::vector<float> toPlant;         ///< px from each pixel to the nearest of the plant; 0 inside
  std::vector<float> inside;          ///< px from each pixel of the plant to the background; 0 outside
  std::vector<float> toLine;          ///< px to the nearest middle line
  std::vector<std::int32_t> nearest;  ///< number of that pixel of a middle line, into `line`
  std::vector<glm::ivec2> line;       ///< the pixels of the middle lines
};

[[nodiscard]] MaskLines linesOf(const Mask& mask);

}  // namespace axil::skeleton3d::detail
