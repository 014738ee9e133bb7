#pragma once
/// \file
/// Plants made by hand, for the tests of render: organ after organ, as the interpreter would.

#include "base/turning.hpp"
#include "simeco/plant.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axil::render::test {

/// Adds organs to a plant; each stands on the tip of its parent.
class PlantMaker {
 public:
  PlantMaker();
  /// Index of a style: made once a (kind, model, colour).
  std::int32_t style(simeco::OrganKind kind, const std::string& model = {}, std::optional<glm::dvec4> colour = std::nullopt);
  simeco::OrganId first(glm::dvec3 base, glm::dvec3 direction, double length, double radius, std::int32_t style);
  simeco::OrganId on(simeco::OrganId parent, bool branch, glm::dvec3 direction, double length, double radius, std::int32_t style);
  simeco::Plant plant;
};

/// A straight stem of `segments` equal segments, upwards.
simeco::Plant straightStem(int segments, double length, double radius);
/// A stem whose nodes are the given ones.
simeco::Plant stemThrough(const std::vector<glm::dvec3>& nodes, double radius);
/// A shrub with a curved stem, branches, decussate leaves on petioles, flowers and fruits; about 300 segments at `levels` 3.
simeco::Plant shrub(int levels = 2);

}  // namespace axil::render::test
