#pragma once
/// \file
/// LightGrid: how much light reaches a place among plants, coarsely. Everything that shades is put into columns along the light, each
/// a square cell wide; a place gets exp(-0.5 x area above it in its column / area of the cell) of the full light (Beer and
/// Lambert's law for leaves that point anywhere). Between the columns' middles light is interpolated.
///
/// The cell is a sixteenth of the shading plants' extent across the light, so the grid follows from what stands there now and from nothing
/// else. The same patches in the same order give the same light, to the last bit. Internal to growth.
/// Sources: Mech and Prusinkiewicz 1996 (open L-systems: plants that compete for light); Monsi and Saeki 1953 (extinction in leaves).

#include "base/frames.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace axil::simeco {

/// A piece of a plant that shades.
struct ShadePatch {
  PlantPoint at;
  double area = 0;
};

class LightGrid {
 public:
  /// `toLight` points to where the light comes from. A cell is at least `leastCell` wide: patches that are larger than a sixteenth of all
  /// would leave gaps between them.
  LightGrid(std::span<const ShadePatch> patches, PlantDirection toLight, double leastCell = 0);

  /// The share of the full light that reaches `point`, above 0 and at most 1. What is nearer than half a cell along the light is
  /// the place's own surroundings and does not shade it.
  [[nodiscard]] double lightAt(const PlantPoint& point) const;

 private:
  /// One column: patches from the top down, with the area of all down to each.
  struct Layer {
    double height = 0;
    double areaAbove = 0;
  };
  using Column = std::pair<std::int64_t, std::int64_t>;
  /// Across the light, in cells.
  [[nodiscard]] glm::dvec2 cellsAt(const PlantPoint& point) const;
  [[nodiscard]] double areaAbove(Column column, double height) const;

  glm::dvec3 light_, across_, along_;
  glm::dvec2 corner_{0};
  double cell_ = 0;
  std::map<Column, std::vector<Layer>> columns_;
};

}  // namespace axil::simeco
