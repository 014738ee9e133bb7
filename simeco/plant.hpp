#pragma once
/// \file
/// Plant: a grammar grown to one moment. Organs with frames, sizes and ages, ready to be drawn or measured; plain values
/// that own everything. Frame: the plant's, Y up; lengths in the grammar's unit (metres in what Axil emits).
/// Sources: docs/simeco.md, "Growth"; L-Grammar Generator 2005, sections 3.3.4 and 3.4.

#include "base/frames.hpp"
#include "base/ids.hpp"
#include "base/source.hpp"
#include "simeco/grammar.hpp"
#include "simeco/rule_info.hpp"

#include <glm/vec4.hpp>

#include <optional>
#include <string>
#include <vector>

namespace axil::simeco {

struct OrganTag;
using OrganId = Id<OrganTag>;  ///< index into Plant::organs

/// How a stage looks: one a (organ kind, stage), shared by its organs.
struct OrganStyle {
  OrganKind kind = OrganKind::Stem;
  int stage = 0;
  std::string model;                     ///< "ovate.i"; empty: the kind's default
  std::string texture;
  std::optional<glm::dvec4> colour;      ///< ColorFront, RGBA 0 to 1
  double growTime = 0;                   ///< age at which an organ of this stage is fully grown
  friend bool operator==(const OrganStyle&, const OrganStyle&) = default;
};

/// A body: it runs from `base` along `direction` for `length`, or along its trail where the environment bent it.
struct Organ {
  OrganKind kind = OrganKind::Stem;
  std::int32_t style = 0;                ///< index into Plant::styles
  std::optional<OrganId> parent;         ///< the organ at whose tip it starts; always a smaller id
  bool branch = false;                   ///< stands in brackets: leaves its parent's axis
  PlantPoint base;
  PlantDirection direction = PlantDirection::up();
  PlantDirection rAxis = PlantDirection::along({1, 0, 0});
  PlantDirection adaxial = PlantDirection::along({0, 0, 1});  ///< upper side of a blade, perpendicular to direction
  double length = 0;
  double radius = 0;                     ///< half the width: of a stem's body, else of the organ at its widest (0: by its shape)
  std::optional<double> tipRadius = {};  ///< of a turtle's stem: the radius at its tip; without it a stem is as wide as its neighbours say
  double age = 0;                        ///< in the grammar's time, since birth
  std::int32_t production = -1;          ///< rule that made it, in text order over all plants; -1: the axiom
  std::int64_t module = -1;              ///< which module of the string it is; -1: a body that stayed behind when it was rewritten

  std::vector<PlantPoint> trail = {};    ///< base to tip of a bent body, `length` long along it; empty: straight
  double opening = 1;                    ///< how far a blade, flower or bud has unfolded, 0 to 1
  double withered = 0;                   ///< 0 fresh, 1 withered

  [[nodiscard]] PlantPoint tip() const { return trail.empty() ? PlantPoint{base.at + direction.unit() * length} : trail.back(); }
  /// Where the body points at its tip.
  [[nodiscard]] PlantDirection tipDirection() const {
    return trail.empty() ? direction : PlantDirection::along(trail.back().at - trail[trail.size() - 2].at);
  }
  friend bool operator==(const Organ&, const Organ&) = default;
};

/// A flat face that an L-system's turtle outlined; 3 vertices or more, in order around it.
struct PlantFace {
  std::vector<PlantPoint> vertices = {};
  std::int32_t style = 0;
  std::int32_t production = -1;          ///< as of an Organ
  std::int64_t module = -1;
  friend bool operator==(const PlantFace&, const PlantFace&) = default;
};

/// A sphere that a turtle set.
struct PlantBall {
  PlantPoint centre = {};
  double radius = 0;
  std::int32_t style = 0;
  std::int32_t production = -1;
  std::int64_t module = -1;
  friend bool operator==(const PlantBall&, const PlantBall&) = default;
};

/// A round disc that a turtle set.
struct PlantDisc {
  PlantPoint centre = {};
  PlantDirection normal = PlantDirection::along({0, 0, 1});
  double radius = 0;
  std::int32_t style = 0;
  std::int32_t production = -1;
  std::int64_t module = -1;
  friend bool operator==(const PlantDisc&, const PlantDisc&) = default;
};

/// One plant or several of one ecosystem, at time `time`.
struct Plant {
  std::string name;
  double time = 0;
  std::vector<OrganStyle> styles;
  std::vector<Organ> organs;             ///< parent before child
  std::vector<PlantFace> faces = {};     ///< faces, balls and discs: of L-systems only
  std::vector<PlantBall> balls = {};
  std::vector<PlantDisc> discs = {};
  RuleList rules = {};                   ///< what a `production` number means: the rule's wording and its place in the text

  [[nodiscard]] const Organ& at(OrganId id) const { return organs[static_cast<std::size_t>(id.value)]; }
  [[nodiscard]] const OrganStyle& styleOf(const Organ& organ) const { return styles[static_cast<std::size_t>(organ.style)]; }
  friend bool operator==(const Plant&, const Plant&) = default;
};

}  // namespace axil::simeco
