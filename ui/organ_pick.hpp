#pragma once
/// \file
/// Choosing an organ of the grown plant with the mouse: which one is under it, which rule made it, and which measured segment it belongs to.

#include "base/source.hpp"
#include "simeco/plant.hpp"
#include "skeleton3d/camera.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axil::ui {

/// The organ whose body is nearest to `at` in the picture of `camera`, within `reach_px` of its width; of several there the one in front.
[[nodiscard]] std::optional<simeco::OrganId> organUnder(const simeco::Plant& plant, const skeleton3d::Camera& camera, PhotoPoint at, double reach_px);

/// The measured segment that an organ is, or stands on; -1: of none. As Axil's own initial and predictive grammars number them.
[[nodiscard]] int segmentOfOrgan(const simeco::Plant& plant, simeco::OrganId organ);

/// What is told of an organ that was chosen. It stays as it is when the plant changes.
struct ChosenOrgan {
  simeco::OrganKind kind = simeco::OrganKind::Stem;
  std::vector<PlantPoint> middle;      ///< from its base to its tip
  double length = 0;
  double age = 0;
  double time = 0;                     ///< at which the plant was shown
  std::string rule;                    ///< which one made it, as the derivation names it; empty: the axiom
  std::optional<SourceSpan> where;     ///< of that rule in the grammar's text
};
[[nodiscard]] ChosenOrgan describedOrgan(const simeco::Plant& plant, simeco::OrganId organ);

}  // namespace axil::ui
