#pragma once
/// \file
/// An L-system as a Plant: derived, drawn by the turtle, and what is drawn turned into organs. Segments are stems (radius = half
/// the width), `~s` are leaves of model "s", polygons are faces, spheres balls, circles discs. Every one knows the module it
/// comes from, and its rule: `plantOfLSystem` traces the derivation; of a string derived elsewhere only when that was traced.
///
/// With the line style `pixel` (the default) a width is so many pixels of a picture `pixelsAcross` wide; with `polygon` and
/// `cylinder` it is a length of the plant.
/// Fails as `deriveLSystem` and `interpret` do.

#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_turtle.hpp"
#include "simeco/plant.hpp"

namespace axil::simeco {

struct LSystemPlantOptions {
  DeriveLSystemOptions derive = {};
  double pixelsAcross = 600;
  std::size_t modulesPerThread = 16384;  ///< fewer are not worth another thread; the plant does not depend on it
};

[[nodiscard]] Result<Plant> plantOfLSystem(const Grammar& grammar, const LSystemPlantOptions& options = {});

/// The same of a string that is derived already. `time` of the plant is the number of steps.
[[nodiscard]] Result<Plant> plantOfDerivation(const Grammar& grammar, const Derivation& derivation, const LSystemPlantOptions& options = {});

/// The colour of an index of the reference program's colour table as we paint it: a turn around the colour circle, dark to light.
[[nodiscard]] glm::dvec4 colourOfIndex(int index);

}  // namespace axil::simeco
