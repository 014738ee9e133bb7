#include "simeco/growth_moment.hpp"

#include "simeco/growth_path.hpp"
#include "simeco/light_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::simeco {

namespace {

// ---- time ------------------------------------------------------------------------------------------------------------

/// The last of a history's entries that holds at `time`.
template <class Entries, class TimeOf>
std::size_t holding(const Entries& entries, double time, TimeOf timeOf) {
  const auto later = std::partition_point(entries.begin(), entries.end(), [&](const auto& entry) { return timeOf(entry) <= time; });
  return later == entries.begin() ? 0 : static_cast<std::size_t>(later - entries.begin()) - 1;
}

bool happened(std::int64_t step, const PlantHistory& plant, double time) { return step != never && static_cast<double>(step) * plant.deriveTime <= time; }

std::size_t surroundingsAt(const PlantHistory& plant, double time) {
  return plant.surroundings.size() == 1 ? 0 : holding(plant.surroundings, time, [](const Surroundings& s) { return s.from; });
}

// ---- size ------------------------------------------------------------------------------------------------------------

/// How long a body becomes between two ages, where its surroundings or its light change on the way.
class Lengthening {
 public:
  Lengthening(const GrowthData& data, const PlantHistory& plant, const Body& body)
      : plant_(plant), body_(body), lightSteps_(data.lightSteps), born_(plant.bornAt(body)) {
    if (!body.lit.empty()) firstLight_ = holding(lightSteps_, born_, [](double t) { return t; });
  }

  [[nodiscard]] double between(double from, double to) const {
    const double end = born_ + to;
    double time = born_ + from, vigour = 0;
    // Computed like this whatever comes later, so that a later change touches no bit of what came before it.
    const std::size_t first = surroundingsAt(plant_, time);
    const bool steady = body_.lit.empty() && (first + 1 == plant_.surroundings.size() || plant_.surroundings[first + 1].from >= end);
    if (steady) return body_.rate * plant_.surroundings[first].response * (to - from);
    while (time < end) {
      const std::size_t now = surroundingsAt(plant_, time);
      double until = now + 1 < plant_.surroundings.size() ? std::min(end, plant_.surroundings[now + 1].from) : end;
      vigour += plant_.surroundings[now].response * lightFrom(time, until) * (until - time);
      time = until;
    }
    return body_.rate * vigour;
  }

 private:
  /// How much the light lets it grow from `time` on; `until` moves to where that ends.
  double lightFrom(double time, double& until) const {
    if (body_.lit.empty()) return 1;
    const std::size_t step = holding(lightSteps_, time, [](double t) { return t; });
    if (step + 1 < lightSteps_.size()) until = std::min(until, lightSteps_[step + 1]);
    return body_.lit[std::min(step - firstLight_, body_.lit.size() - 1)];
  }

  const PlantHistory& plant_;
  const Body& body_;
  const std::vector<double>& lightSteps_;
  double born_;
  std::size_t firstLight_ = 0;
};

double lengthAt(const GrowthData& data, const PlantHistory& plant, const Body& body, double age) {
  return Lengthening(data, plant, body).between(0, std::min(age, body.growTime));
}

double shareOf(double age, double time) { return time > 0 ? std::clamp(age / time, 0.0, 1.0) : 1; }

double smooth(double share) { return share * share * (3 - 2 * share); }

double witheredAt(const Habit& habit, double age) { return age > habit.witherAge ? shareOf(age - habit.witherAge, habit.witherTime) : 0; }

// ---- shape -----------------------------------------------------------------------------------------------------------

constexpr int kFewestSteps = 8, kMostSteps = 32;
constexpr double kStepsAPull = 8;
/// A withered blade hangs: as if this much more gravity had pulled at it.
constexpr double kDroop = 1.5;
/// Of an organ's full length: how far it sees an obstacle, and the room it leaves before an obstacle where it is thinner than that.
constexpr double kSight = 0.5, kLeastClearance = 1e-3;

bool bendsAlong(OrganKind kind) { return kind == OrganKind::Stem || kind == OrganKind::Apex || kind == OrganKind::Root; }

/// In how many steps an organ of this habit grows: from its own numbers alone, so that no weather changes what came before it.
int stepsOf(const Habit& habit) {
  const double strength = habit.elasticity * (glm::length(habit.tropism) + std::fabs(habit.gravity) + std::fabs(habit.light) + std::fabs(habit.wind));
  return static_cast<int>(std::clamp(std::ceil(kStepsAPull * strength), double{kFewestSteps}, double{kMostSteps}));
}

/// The steps of a body's growth up to `age`.
std::vector<PathStep> stepsUpTo(const GrowthData& data, const PlantHistory& plant, const Body& body, const Habit& habit, double age, int count) {
  const Lengthening lengthening(data, plant, body);
  const auto ageAt = [&](int step) { return body.growTime * step / count; };
  std::vector<PathStep> steps;
  for (int i = 0; i < count && ageAt(i) < age; ++i) {
    const double from = ageAt(i), to = ageAt(i + 1), end = std::min(to, age);
    const Surroundings& around = plant.surroundings[surroundingsAt(plant, plant.bornAt(body) + from)];
    PathStep step;
    step.length = lengthening.between(from, end);
    step.reach = body.rate * (to - from);  // no response and no light lets it grow more
    step.share = end < to ? (end - from) / (to - from) : 1;
    step.pull = around.pullOn(habit);
    step.obstacles = around.obstacles.get();
    steps.push_back(step);
  }
  return steps;
}

/// Takes away obstacles that are out of the organ's reach and sight: then no step need ask for them.
void forgetFarObstacles(std::vector<PathStep>& steps, const glm::dvec3& base, double farthest) {
  const ObstacleField* asked = nullptr;
  bool near = false;
  for (PathStep& step : steps) {
    if (step.obstacles == nullptr) continue;
    if (step.obstacles != asked) near = step.obstacles->nearest(base, base, farthest).has_value();
    asked = step.obstacles;
    if (!near) step.obstacles = nullptr;
  }
}

/// Bends `organ`, which stands in its place as if nothing acted on it, and says with what frame it ends.
StemFrame bend(Organ& organ, const StemFrame& frame, const GrowthData& data, const PlantHistory& plant, const Body& body) {
  const Habit& habit = plant.habits[static_cast<std::size_t>(body.habit)];
  const double reach = body.rate * body.growTime;
  if (!(reach > 0) || (!plant.bends[static_cast<std::size_t>(body.habit)] && organ.withered == 0)) return frame;
  const PathRules rules{stepsOf(habit), std::max(body.finalRadius, reach * kLeastClearance), reach * kSight + body.finalRadius};
  std::vector<PathStep> steps = stepsUpTo(data, plant, body, habit, organ.age, rules.steps);
  forgetFarObstacles(steps, organ.base.at, reach + rules.sight + rules.clearance);
  if (bendsAlong(body.kind)) {
    Path path = followPath(organ.base, frame, steps, rules);
    if (path.stopped) organ.length = path.length;
    organ.trail = std::move(path.trail);
    return path.tip;
  }
  if (organ.withered > 0) {
    PathStep droop = steps.back();
    droop.pull = plant.surroundings[surroundingsAt(plant, plant.bornAt(body) + organ.age)].gravity * (kDroop * rules.steps);
    droop.share = organ.withered;
    steps.push_back(droop);
  }
  const Swing swing = swingBody(organ.base, frame, steps, rules, organ.length, reach);
  organ.length = swing.length;
  organ.direction = swing.frame.direction;
  organ.rAxis = swing.frame.rAxis;
  organ.adaxial = swing.frame.adaxial;
  return swing.frame;
}

// ---- one organ -------------------------------------------------------------------------------------------------------

void setAge(Organ& organ, const Body& body, const Habit& habit, double age) {
  organ.age = age;
  organ.radius = body.broadenTime > 0 ? body.finalRadius * (std::min(age, body.broadenTime) / body.broadenTime) : body.finalRadius;
  organ.withered = witheredAt(habit, age);
  organ.opening = habit.unfoldTime > 0 ? smooth(shareOf(age, habit.unfoldTime)) : 1;
  organ.style = body.style;
  if (organ.withered > 0 && habit.witherStyles > 0)
    organ.style = habit.witherStyle + std::min(habit.witherStyles - 1, static_cast<std::int32_t>(organ.withered * habit.witherStyles));
}

/// The frame of a body at its base. What unfolds starts along its parent and turns away from it.
StemFrame standingFrame(const StemFrame& from, const Placement& placement, double opening, TurningRule rule) {
  const bool straight = placement.parent < 0 && placement.turn.rotr == Angle{} && placement.turn.rotu == Angle{};
  if (straight) return from;
  const Turn turn{opening < 1 ? placement.turn.rotr * opening : placement.turn.rotr, placement.turn.rotu};
  return childFrame(from, turn, placement.branch ? ChildKind::Branch : ChildKind::Main, rule);
}

}  // namespace

std::vector<std::int32_t> addOrgans(const GrowthData& data, const PlantHistory& plant, double time, std::vector<Organ>& organs) {
  std::vector<std::int32_t> organOf(plant.bodies.size(), -1);
  std::vector<StemFrame> tips(plant.bodies.size());
  for (std::size_t i = 0; i < plant.bodies.size(); ++i) {
    const Body& body = plant.bodies[i];
    if (!happened(body.born, plant, time) || happened(body.gone, plant, time)) continue;
    const Habit& habit = plant.habits[static_cast<std::size_t>(body.habit)];
    const double age = time - plant.bornAt(body);
    const auto stepTime = [&](std::int64_t step) { return static_cast<double>(step) * plant.deriveTime; };
    const Placement& placement = body.placements[holding(body.placements, time, [&](const Placement& p) { return stepTime(p.fromStep); })];
    const bool rooted = placement.parent < 0;
    const auto parent = static_cast<std::size_t>(rooted ? 0 : placement.parent);
    if (age >= habit.fallAge || (!rooted && organOf[parent] < 0)) continue;  // fallen, or what it stood on has
    Organ organ;
    organ.kind = body.kind;
    setAge(organ, body, habit, age);
    organ.branch = placement.branch;
    if (!rooted) organ.parent = OrganId(organOf[parent]);
    organ.base = rooted ? plant.position : organs[static_cast<std::size_t>(organ.parent->value)].tip();
    const StemFrame frame = standingFrame(rooted ? plant.base : tips[parent], placement, organ.opening, data.turning);
    organ.direction = frame.direction;
    organ.rAxis = frame.rAxis;
    organ.adaxial = frame.adaxial;
    organ.length = lengthAt(data, plant, body, age);
    organ.production = body.production;
    organ.module = happened(body.rewritten, plant, time) ? -1 : body.modules[holding(body.modules, time, [&](const auto& m) { return stepTime(m.first); })].second;
    tips[i] = bend(organ, frame, data, plant, body);
    organOf[i] = static_cast<std::int32_t>(organs.size());
    organs.push_back(std::move(organ));
  }
  return organOf;
}

Plant momentOf(const GrowthData& data, double time) {
  Plant plant{data.name, time, data.styles, {}};
  plant.rules = data.rules;
  for (const PlantHistory& history : data.plants) addOrgans(data, history, time, plant.organs);
  return plant;
}

double fullSizeTime(const GrowthData& data) {
  double complete = 0;
  for (const PlantHistory& plant : data.plants) {
    complete = std::max(complete, static_cast<double>(plant.steps) * plant.deriveTime);
    for (const Body& body : plant.bodies) {
      if (body.gone != never) continue;
      const Habit& habit = plant.habits[static_cast<std::size_t>(body.habit)];
      complete = std::max(complete, plant.bornAt(body) + std::max({body.growTime, body.broadenTime, habit.unfoldTime}));
    }
  }
  return complete;
}

Result<std::vector<double>> stepTimes(const GrowthData& data, double upTo) {
  constexpr std::size_t most = 100'000;
  std::vector<double> times;
  for (const PlantHistory& plant : data.plants) {
    if (upTo / plant.deriveTime > static_cast<double>(most))
      return fail(ErrorCode::LimitReached, "light or the environment would have to be computed more than " + std::to_string(most) +
                                               " times; grow the plants for a shorter time, or raise DeriveTime");
    for (std::int64_t step = 0; static_cast<double>(step) * plant.deriveTime <= upTo; ++step) times.push_back(static_cast<double>(step) * plant.deriveTime);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

// ---- light -----------------------------------------------------------------------------------------------------------

namespace {

/// A blade without a radius is about this share of its length wide; of the rectangle around it a blade covers two thirds.
constexpr double kBladeWidth = 0.5, kBladeCover = 2.0 / 3;
constexpr int kPatchesAnOrgan = 3;

bool asksForLight(const PlantHistory& plant, const Body& body) { return plant.habits[static_cast<std::size_t>(body.habit)].lightResponse > 0; }

double shadeOf(const Organ& organ) {
  if (organ.kind == OrganKind::Root) return 0;
  if (bendsAlong(organ.kind)) return organ.length * 2 * organ.radius;
  const double width = organ.radius > 0 ? 2 * organ.radius : organ.length * kBladeWidth;
  return kBladeCover * organ.length * width * organ.opening;
}

std::vector<ShadePatch> patchesOf(const std::vector<Organ>& organs) {
  std::vector<ShadePatch> patches;
  for (const Organ& organ : organs) {
    const double area = shadeOf(organ) / kPatchesAnOrgan;
    if (!(area > 0)) continue;
    const glm::dvec3 along = organ.tip().at - organ.base.at;
    for (int i = 0; i < kPatchesAnOrgan; ++i) patches.push_back({{organ.base.at + along * ((i + 0.5) / kPatchesAnOrgan)}, area});
  }
  return patches;
}

}  // namespace

bool asksForLight(const GrowthData& data) {
  return std::any_of(data.plants.begin(), data.plants.end(), [](const PlantHistory& plant) {
    return std::any_of(plant.bodies.begin(), plant.bodies.end(), [&](const Body& body) { return asksForLight(plant, body); });
  });
}

void addLightStep(GrowthData& data, double time) {
  std::vector<Organ> organs;
  std::vector<std::vector<std::int32_t>> organOf;
  for (const PlantHistory& plant : data.plants) organOf.push_back(addOrgans(data, plant, time, organs));
  const std::vector<ShadePatch> patches = patchesOf(organs);
  for (std::size_t p = 0; p < data.plants.size(); ++p) {
    PlantHistory& plant = data.plants[p];
    const LightGrid grid(patches, PlantDirection::along(plant.surroundings[surroundingsAt(plant, time)].light));
    for (std::size_t i = 0; i < plant.bodies.size(); ++i) {
      Body& body = plant.bodies[i];
      const double age = time - plant.bornAt(body);
      if (!asksForLight(plant, body) || age < 0 || age >= body.growTime) continue;
      const std::int32_t organ = organOf[p][i];
      const double light = organ < 0 ? 1 : grid.lightAt(organs[static_cast<std::size_t>(organ)].tip());
      body.lit.push_back(1 - plant.habits[static_cast<std::size_t>(body.habit)].lightResponse * (1 - light));
    }
  }
  data.lightSteps.push_back(time);
}

}  // namespace axil::simeco
