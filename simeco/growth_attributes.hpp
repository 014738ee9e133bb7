#pragma once
/// \file
/// What a grammar's attributes say to growth, as numbers. Each function fails with BadGrammar and the attribute's name. Internal to growth.

#include "simeco/engine_machine.hpp"
#include "simeco/growth_data.hpp"

#include <map>
#include <span>

namespace axil::simeco {

/// A number of a stage, or an expression that is drawn anew for each organ.
struct SizeRule {
  std::optional<CompiledExpression> expression;
  double otherwise = 0;
};

/// What a stage says about its organs.
struct StageRules {
  std::int32_t style = 0;
  std::size_t parameters = 0;           ///< further arguments of its modules that its rules may use
  SizeRule growRate, growTime, broadenRate, broadenTime;
  Habit habit;                          ///< what is fixed of it
  std::vector<SizeRule> habitRules;     ///< a rule a number of the habit, in the order of the table; for whatever is not said: its default

  /// Whether all organs of the stage share one habit.
  [[nodiscard]] bool hasFixedHabit() const;
};

using StageTable = std::map<std::pair<OrganKind, int>, StageRules>;

/// The stages of a plant; their looks are added to `styles`.
[[nodiscard]] Result<StageTable> readStages(const Grammar& grammar, const PlantGrammar& plant, std::vector<OrganStyle>& styles);

/// Position, Direction, DeriveTime.
[[nodiscard]] Result<PlantHistory> standingPlace(const Grammar& grammar, const PlantGrammar& plant);

/// The host's environment from a time on, with its obstacles made ready.
struct Scene {
  double from = 0;
  Environment environment;
  std::shared_ptr<const ObstacleField> obstacles;  ///< null: none
};

/// What the ecosystem's own `Obstacle = sphere(...)` and `Obstacle = box(...)` say, for all its plants.
[[nodiscard]] Result<std::vector<Obstacle>> obstaclesIn(const Grammar& grammar);

/// The plant's surroundings through time: what the host says, else the plant, else the ecosystem.
[[nodiscard]] Result<std::vector<Surroundings>> surroundingsOf(const Grammar& grammar, const PlantGrammar& plant, std::span<const Scene> scenes);

/// The sizes and habits of new organs; drawn ones depend on (seed, step, who the module is) alone.
class Draws {
 public:
  Draws(std::uint64_t seed, const Limits& limits, const Watch& watch) : random_(Rng(seed).split(sizeStream)), limits_(limits), watch_(watch) {}

  /// Which organ it is, and its further arguments.
  struct Place {
    std::uint64_t step = 0, module = 0;
    std::span<const double> arguments = {};
  };
  struct Sizes {
    double rate = 0, growTime = 0, broadenRate = 0, broadenTime = 0;
  };
  [[nodiscard]] Result<Sizes> sizesOf(const StageRules& stage, Place place) const;
  [[nodiscard]] Result<Habit> habitOf(const StageRules& stage, Place place) const;

 private:
  static constexpr std::uint64_t sizeStream = 101;
  [[nodiscard]] Result<double> draw(const SizeRule& rule, const char* name, double least, Place place, std::uint64_t which) const;
  [[nodiscard]] Result<double> compute(const CompiledExpression& expression, const Rng& rng, std::span<const double> arguments) const;

  Rng random_;
  const Limits& limits_;
  const Watch& watch_;
};

}  // namespace axil::simeco
