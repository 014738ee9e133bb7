#include "simeco/growth_seasons.hpp"

#include "simeco/growth_moment.hpp"

#include <algorithm>

namespace axil::simeco {

namespace {

/// A plant must stand clear of every obstacle, or there would be no side to keep to.
Result<void> checkStandsClear(const PlantHistory& history, const std::string& name) {
  const glm::dvec3 at = history.position.at;
  const double touching = 1e-9 * (1 + glm::length(at));
  for (const Surroundings& around : history.surroundings)
    if (around.obstacles && (around.obstacles->holds(at) || around.obstacles->nearest(at, at, touching)))
      return fail(ErrorCode::BadInput, "plant \"" + name + "\" stands in an obstacle or touches it; move one of them a little");
  return {};
}

/// One a habit: whether anything ever acts on the heading of its organs.
std::vector<bool> bendsOf(const PlantHistory& history) {
  std::vector<bool> bends;
  for (const Habit& habit : history.habits)
    bends.push_back(std::any_of(history.surroundings.begin(), history.surroundings.end(),
                                [&](const Surroundings& around) { return around.obstacles || around.pullOn(habit) != glm::dvec3{0, 0, 0}; }));
  return bends;
}

/// Puts the plants into their surroundings.
Result<void> surround(GrowthData& data, const Grammar& grammar, std::span<const Scene> scenes) {
  for (std::size_t i = 0; i < data.plants.size(); ++i) {
    PlantHistory& history = data.plants[i];
    auto surroundings = surroundingsOf(grammar, grammar.plants[i], scenes);
    if (!surroundings) return surroundings.failure();
    history.surroundings = *std::move(surroundings);
    if (auto clear = checkStandsClear(history, grammar.plants[i].name); !clear) return clear;
    history.bends = bendsOf(history);
  }
  return {};
}

/// Goes through the steps in order of time: first the host may change the environment, then light falls.
class Seasons {
 public:
  Seasons(GrowthData& data, const Grammar& grammar, const GrowOptions& options, Scenes scenes)
      : data_(data), grammar_(grammar), options_(options), scenes_(std::move(scenes)), now_(options.environment) {}

  Result<void> run() {
    const bool lit = asksForLight(data_);
    if (!lit && !options_.betweenSteps) return {};
    const double upTo = data_.upToTime.value_or(fullSizeTime(data_));
    const auto times = stepTimes(data_, upTo);
    if (!times) return times.failure();
    for (const double time : *times) {
      if (options_.watch.cancelled()) return fail(ErrorCode::Cancelled, "growing was stopped while light was computed");
      options_.watch.report("computing light", upTo > 0 ? time / upTo : 1);
      if (options_.betweenSteps)
        if (auto asked = ask(time); !asked) return asked;
      if (lit) addLightStep(data_, time);
    }
    return {};
  }

 private:
  Result<void> ask(double time) {
    auto answer = options_.betweenSteps(momentOf(data_, time), now_);
    if (!answer) return answer.failure();
    if (*answer == now_) return {};
    now_ = *std::move(answer);
    if (auto added = scenes_.add(time, now_); !added) return added;
    return surround(data_, grammar_, scenes_.all());
  }

  GrowthData& data_;
  const Grammar& grammar_;
  const GrowOptions& options_;
  Scenes scenes_;
  Environment now_;
};

}  // namespace

Result<void> Scenes::add(double from, Environment environment) {
  environment.obstacles.insert(environment.obstacles.end(), own_.begin(), own_.end());
  if (auto checked = checkEnvironment(environment); !checked) return checked;
  if (!scenes_.empty() && scenes_.back().from == from) scenes_.pop_back();
  scenes_.push_back({from, std::move(environment), nullptr});
  Scene& scene = scenes_.back();
  if (!scene.environment.obstacles.empty()) scene.obstacles = std::make_shared<const ObstacleField>(scene.environment.obstacles);
  return {};
}

Result<Scenes> scenesOf(const Grammar& grammar, const GrowOptions& options) {
  if (options.betweenSteps && !options.changes.empty())
    return fail(ErrorCode::BadInput, "growth was given both a list of changes and a host that changes the environment between steps; give one of them");
  if (auto checked = checkChanges(options.changes); !checked) return checked.failure();
  auto own = obstaclesIn(grammar);
  if (!own) return own.failure();
  Scenes scenes(*std::move(own));
  if (auto added = scenes.add(0, options.environment); !added) return added.failure();
  for (const EnvironmentChange& change : options.changes)
    if (auto added = scenes.add(change.time, change.environment); !added) return added.failure();
  return scenes;
}

Result<void> live(GrowthData& data, const Grammar& grammar, const GrowOptions& options, Scenes scenes) {
  if (auto surrounded = surround(data, grammar, scenes.all()); !surrounded) return surrounded;
  return Seasons(data, grammar, options, std::move(scenes)).run();
}

}  // namespace axil::simeco
