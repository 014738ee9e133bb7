#pragma once
/// \file
/// What growth remembers of a derivation: bodies, when they were born, how they stand, how they age. Internal to growth.

#include "simeco/environment.hpp"
#include "simeco/growth.hpp"
#include "simeco/obstacle_field.hpp"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace axil::simeco {

inline constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

/// How an organ bends and ages. Most stages have one habit for all their organs.
struct Habit {
  glm::dvec3 tropism{0};
  double elasticity = 1;
  double gravity = 0, light = 0, wind = 1;  ///< tropisms: how much each pulls
  double lightResponse = 0;                 ///< the share of growth that needs light
  double unfoldTime = 0;
  double witherAge = std::numeric_limits<double>::infinity(), witherTime = 1;
  double fallAge = std::numeric_limits<double>::infinity();
  std::int32_t witherStyle = -1;            ///< the first of the styles of a withering organ
  std::int32_t witherStyles = 0;
};

/// The environment of one plant from a time on.
struct Surroundings {
  double from = 0;
  double response = 1;
  glm::dvec3 gravity{0, -1, 0}, light{0, 1, 0}, wind{0};
  std::shared_ptr<const ObstacleField> obstacles;  ///< null: none

  [[nodiscard]] glm::dvec3 pullOn(const Habit& habit) const {
    return (habit.tropism + gravity * habit.gravity + light * habit.light + wind * habit.wind) * habit.elasticity;
  }
};

/// How a body stands on another from a step on.
struct Placement {
  std::int64_t fromStep = 0;
  std::int32_t parent = -1;
  bool branch = false;
  Turn turn;
};

/// An organ's body through all steps.
struct Body {
  OrganKind kind = OrganKind::Stem;
  std::int32_t style = 0;
  std::int32_t habit = 0;
  std::int32_t production = -1;
  std::int64_t born = 0;                 ///< step
  std::int64_t rewritten = never;        ///< step at which its module went and the body stayed
  std::int64_t gone = never;             ///< step at which it was cut off
  double rate = 0, growTime = 1, broadenTime = 1, finalRadius = 0;
  std::vector<Placement> placements;     ///< in step order
  std::vector<std::pair<std::int64_t, std::int64_t>> modules;  ///< which module it is: from step, index in the string
  std::vector<double> lit = {};          ///< how much its light lets it grow, for each light step from its birth on; empty: fully
};

/// One plant of the ecosystem: its bodies in the order in which they stand in the string, which no step ever changes.
struct PlantHistory {
  PlantPoint position;
  StemFrame base;
  double deriveTime = 1;
  std::int64_t steps = 0;
  bool settled = false;
  std::vector<Surroundings> surroundings;  ///< in time order, the first from 0 on
  std::vector<Habit> habits;
  std::vector<bool> bends;                 ///< one a habit: whether anything ever acts on its heading
  std::vector<Body> bodies;

  [[nodiscard]] double bornAt(const Body& body) const { return static_cast<double>(body.born) * deriveTime; }
};

struct GrowthData {
  std::string name;
  TurningRule turning = TurningRule::Exact;
  std::optional<double> upToTime;
  std::vector<OrganStyle> styles;
  std::vector<PlantHistory> plants;
  RuleList rules;                          ///< of all plants, by an organ's production
  std::vector<double> lightSteps;          ///< times at which light was computed; empty where no organ asks for it
};

}  // namespace axil::simeco
