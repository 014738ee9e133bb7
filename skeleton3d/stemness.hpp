#pragma once
/// \file
/// Private to skeleton3d: how much each place of a photo looks like the middle of a stem. At every scale a ridge (or valley) of
/// any colour channel counts as much as the weaker of the two edges beside it, so the flank of something wide is no stem.
/// The photo is kept as cells of some pixels, each with its best place; a photo of any size has about half a million.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "skeleton3d/photo.hpp"

#include <glm/vec2.hpp>

#include <vector>

namespace axil::skeleton3d::detail {

struct StemCell {
  glm::vec2 at{0, 0};     ///< px, the place on the ridge
  glm::vec2 along{1, 0};  ///< unit, which way the ridge runs; its opposite is the same
  float strength = 0;     ///< grey levels of the weaker edge; 0: no ridge
  float width_px = 0;     ///< within a factor of 1.5
};

struct StemnessMap {
  int cell_px = 1;
  int columns = 0, rows = 0;
  std::vector<StemCell> cells;  ///< row by row
  float usual = 6;              ///< strength that texture and noise have everywhere; grey levels

  [[nodiscard]] glm::ivec2 cellOf(glm::dvec2 px) const;
  [[nodiscard]] const StemCell& at(int column, int row) const { return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)]; }
  /// 0 to 1: half where the strength is the usual one.
  [[nodiscard]] float likeness(const StemCell& cell) const { return cell.strength * cell.strength / (cell.strength * cell.strength + usual * usual); }
};

/// Fails with BadInput for a photo of less than 8 px, with Cancelled.
[[nodiscard]] Result<StemnessMap> stemnessOf(const Photo& photo, const Watch& watch);

}  // namespace axil::skeleton3d::detail
