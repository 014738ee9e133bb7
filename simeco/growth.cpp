#include "simeco/growth.hpp"

#include "base/text.hpp"
#include "simeco/engine.hpp"
#include "simeco/engine_identity.hpp"
#include "simeco/growth_attributes.hpp"
#include "simeco/growth_moment.hpp"
#include "simeco/growth_seasons.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::simeco {

namespace {

// ---- history ---------------------------------------------------------------------------------------------------------

/// A piece of the string with the bodies that stayed behind: a body alone, or a module of the string (and its body, if any).
struct Piece {
  std::int32_t body = -1;
  bool module = false;
};

/// Follows one plant's derivation and writes down when and where its bodies stand.
class Recorder {
 public:
  Recorder(Engine& engine, const StageTable& stages, std::int32_t firstProduction, const Draws& draws)
      : engine_(engine), stages_(stages), firstProduction_(firstProduction), draws_(draws) {
    for (const Symbol& symbol : *engine.program().symbols) roles_.push_back(roleOf(symbol));
  }

  Result<void> axiom() {
    Result<void> done;
    std::size_t module = 0;
    for (const ModuleView view : engine_.string()) {
      if (done = addModule(view, module++, -1); !done) return done;
    }
    place();
    return {};
  }

  /// Takes over one step: copied modules keep their bodies, those of rewritten ones stay behind.
  Result<void> step(const StepTrace& trace) {
    std::vector<Piece> before;
    before.swap(pieces_);
    // `module` counts modules of the old string, `view` walks over the new one.
    std::size_t module = 0, made = 0;
    auto view = engine_.string().begin();
    bool cutting = false;
    for (const Piece& piece : before) {
      if (!piece.module) {
        // A body that stayed behind goes with the modules around it.
        if (cutting) cutOff(piece.body);
        pieces_.push_back(piece);
        continue;
      }
      const std::int32_t rule = trace.rule[module];
      cutting = rule == StepTrace::removed;
      const std::size_t end = trace.begin[module + 1];
      ++module;
      if (rule == StepTrace::copied) {
        pieces_.push_back(piece);
        if (piece.body >= 0) nowModule(piece.body, made);
        ++view;
        ++made;
        continue;
      }
      if (piece.body >= 0) {
        bodies_[static_cast<std::size_t>(piece.body)].rewritten = engine_.stepsDone();
        if (cutting) cutOff(piece.body);
        pieces_.push_back({piece.body, false});
      }
      for (; made < end; ++made, ++view)
        if (auto done = addModule(*view, made, trace.maker[made]); !done) return done;
    }
    place();
    return {};
  }

  /// About what the history takes in memory; counted as it grows, since walking over it would cost as much as a step.
  [[nodiscard]] std::size_t bytes() const {
    constexpr std::size_t kAllocations = 2 * 32;  // what the two lists of a body cost beside their entries
    return bodies_.size() * (sizeof(Body) + kAllocations) + entries_ * sizeof(Placement) + pieces_.size() * sizeof(Piece);
  }

  /// All bodies in the order in which they stand, ids renumbered to it.
  [[nodiscard]] std::vector<Body> takeBodies() {
    std::vector<std::int32_t> rank(bodies_.size(), -1);
    std::vector<Body> ordered;
    for (const Piece& piece : pieces_)
      if (piece.body >= 0) rank[static_cast<std::size_t>(piece.body)] = static_cast<std::int32_t>(ordered.size()), ordered.push_back(std::move(bodies_[static_cast<std::size_t>(piece.body)]));
    for (Body& body : ordered)
      for (Placement& placement : body.placements)
        if (placement.parent >= 0) placement.parent = rank[static_cast<std::size_t>(placement.parent)];
    return ordered;
  }
  [[nodiscard]] std::vector<Habit> takeHabits() { return std::move(habits_); }

 private:
  enum class Role { None, Organ, Rotr, Rotu, Open, Close };
  struct SymbolRole {
    Role role = Role::None;
    OrganKind kind = OrganKind::Stem;
  };
  static SymbolRole roleOf(const Symbol& symbol) {
    if (symbol.letter == "[") return {Role::Open, {}};
    if (symbol.letter == "]") return {Role::Close, {}};
    if (symbol.letter == "rotr" && symbol.parameters == 1) return {Role::Rotr, {}};
    if (symbol.letter == "rotu" && symbol.parameters == 1) return {Role::Rotu, {}};
    const auto kind = organOfLetter(symbol.letter);
    return kind && symbol.parameters >= 1 ? SymbolRole{Role::Organ, *kind} : SymbolRole{};
  }

  [[nodiscard]] const StageRules* stageOf(const ModuleView& view, OrganKind kind) const {
    const double number = view.parameters[0];
    if (number != std::trunc(number) || std::fabs(number) > 1e9) return nullptr;
    const auto found = stages_.find({kind, static_cast<int>(number)});
    return found == stages_.end() ? nullptr : &found->second;
  }

  [[nodiscard]] SymbolRole roleNow(std::size_t module) const { return roles_[engine_.string().codes()[module]]; }

  Result<void> addModule(const ModuleView& view, std::size_t module, std::int32_t rule) {
    pieces_.push_back({-1, true});
    const SymbolRole role = roleNow(module);
    if (role.role != Role::Organ) return {};
    const StageRules* stage = stageOf(view, role.kind);
    if (stage == nullptr) return {};
    auto body = newBody(*stage, role.kind, view, module, rule);
    if (!body) return body.failure();
    pieces_.back().body = static_cast<std::int32_t>(bodies_.size());
    bodies_.push_back(*std::move(body));
    return {};
  }

  Result<Body> newBody(const StageRules& stage, OrganKind kind, const ModuleView& view, std::size_t module, std::int32_t rule) {
    const std::span<const double> further = std::span(view.parameters).subspan(1);
    if (further.size() < stage.parameters)
      return fail(ErrorCode::BadGrammar, std::string(view.letter) + "(" + shortest(view.parameters[0]) + ") has " + std::to_string(further.size()) +
                                             " further arguments, but its Stage names " + std::to_string(stage.parameters));
    const Draws::Place place{static_cast<std::uint64_t>(engine_.stepsDone()), whoIs(engine_.string().identities()[module]), further};
    const auto sizes = draws_.sizesOf(stage, place);
    if (!sizes) return sizes.failure();
    const auto habit = habitOf(stage, place);
    if (!habit) return habit.failure();
    Body body;
    body.kind = kind;
    body.style = stage.style;
    body.habit = *habit;
    body.born = engine_.stepsDone();
    body.production = rule < 0 ? -1 : firstProduction_ + rule;
    body.rate = sizes->rate;
    body.growTime = sizes->growTime;
    body.broadenTime = sizes->broadenTime;
    body.finalRadius = sizes->broadenRate * sizes->broadenTime * modelRadius;
    if (!stage.broadenRate.expression && kind == OrganKind::Stem) body.finalRadius = defaultStemShare * modelRadius;
    body.modules.emplace_back(engine_.stepsDone(), static_cast<std::int64_t>(module));
    return body;
  }

  /// Which habit an organ has: its stage's, or where that draws one, its own.
  Result<std::int32_t> habitOf(const StageRules& stage, Draws::Place place) {
    const bool fixed = stage.hasFixedHabit();
    const auto known = fixed ? fixedHabits_.find(stage.style) : fixedHabits_.end();
    if (known != fixedHabits_.end()) return known->second;
    const auto habit = draws_.habitOf(stage, place);
    if (!habit) return habit.failure();
    const auto id = static_cast<std::int32_t>(habits_.size());
    habits_.push_back(*habit);
    if (fixed) fixedHabits_.emplace(stage.style, id);
    return id;
  }

  void nowModule(std::int32_t body, std::size_t module) {
    auto& modules = bodies_[static_cast<std::size_t>(body)].modules;
    if (modules.back().second == static_cast<std::int64_t>(module)) return;
    modules.emplace_back(engine_.stepsDone(), static_cast<std::int64_t>(module));
    ++entries_;
  }
  void cutOff(std::int32_t body) {
    std::int64_t& gone = bodies_[static_cast<std::size_t>(body)].gone;
    gone = std::min(gone, engine_.stepsDone());
  }

  /// Where the turtle stands while it reads the pieces.
  struct Turtle {
    std::int32_t parent = -1;
    bool branch = false;
    Turn turn;
  };

  /// Reads the pieces from left to right and writes down how each body stands now, where that differs from before.
  void place() {
    Turtle turtle;
    std::vector<Turtle> stack;
    std::size_t module = 0;
    const double* parameter = engine_.string().parameters().data();
    const SymbolCode* codes = engine_.string().codes().data();
    for (const Piece& piece : pieces_) {
      if (piece.body >= 0) placeBody(piece.body, turtle);
      if (!piece.module) continue;
      const SymbolCode code = codes[module++];
      switch (roles_[code].role) {
        case Role::None:
        case Role::Organ: break;
        case Role::Rotr: turtle.turn.rotr += Angle::fromRadians(*parameter); break;
        case Role::Rotu: turtle.turn.rotu += Angle::fromRadians(*parameter); break;
        case Role::Open:
          stack.push_back(turtle);
          turtle.branch = true;
          break;
        case Role::Close:
          if (stack.empty()) break;
          turtle = stack.back();
          stack.pop_back();
          break;
      }
      parameter += engine_.program().parameterCount[code];
    }
  }
  void placeBody(std::int32_t id, Turtle& turtle) {
    Body& body = bodies_[static_cast<std::size_t>(id)];
    if (body.gone != never) return;
    const Placement now{engine_.stepsDone(), turtle.parent, turtle.branch, turtle.turn};
    const auto same = [&](const Placement& p) { return p.parent == now.parent && p.branch == now.branch && p.turn.rotr == now.turn.rotr && p.turn.rotu == now.turn.rotu; };
    if (body.placements.empty() || !same(body.placements.back())) {
      body.placements.push_back(now);
      ++entries_;
    }
    turtle = {id, false, {}};
  }

  Engine& engine_;
  const StageTable& stages_;
  std::int32_t firstProduction_;
  const Draws& draws_;
  std::vector<SymbolRole> roles_;
  std::vector<Piece> pieces_;
  std::vector<Body> bodies_;
  std::size_t entries_ = 0;  ///< of all placements and modules of the bodies
  std::vector<Habit> habits_;
  std::map<std::int32_t, std::int32_t> fixedHabits_;  ///< of the stages whose organs share one, by style
};

// ---- one plant -------------------------------------------------------------------------------------------------------

/// How many steps to derive, or nothing for as many as it takes.
std::optional<std::int64_t> stepsFor(const GrowOptions& options, const Engine& engine, double deriveTime) {
  if (options.steps) return options.steps;
  if (!options.upToTime) return engine.ownLength();
  const double steps = std::floor(*options.upToTime / deriveTime) + 1;  // one more, lest rounding lose the last
  return std::min(static_cast<std::int64_t>(std::fmin(steps, 1e15)), engine.ownLength().value_or(never));
}

/// `rules` are those of the plants before; this plant's are added.
Result<PlantHistory> recordPlant(const Grammar& grammar, std::size_t index, std::vector<RuleInfo>& rules, const GrowOptions& options,
                                 std::vector<OrganStyle>& styles) {
  const PlantGrammar& plant = grammar.plants[index];
  auto history = standingPlace(grammar, plant);
  if (!history) return history;
  const auto stages = readStages(grammar, plant, styles);
  if (!stages) return stages.failure();
  auto program = compile(grammar, index, {options.limits.expressionDepth});
  if (!program) return program.failure();
  const auto firstRule = static_cast<std::int32_t>(rules.size());
  rules.insert(rules.end(), (*program)->rules.begin(), (*program)->rules.end());
  const std::uint64_t seed = Rng(options.seed).split(index).bits();
  auto engine = Engine::create(*std::move(program), {.seed = index == 0 ? options.seed : seed, .limits = options.limits, .watch = options.watch, .identified = true});
  if (!engine) return engine.failure();
  if (auto started = (*engine)->start(); !started) return started.failure();
  const Draws draws(index == 0 ? options.seed : seed, options.limits, options.watch);
  Recorder recorder(**engine, *stages, firstRule, draws);
  if (auto done = recorder.axiom(); !done) return done.failure();
  const auto count = stepsFor(options, **engine, history->deriveTime);
  StepTrace trace;
  while (!history->settled && (!count || (*engine)->stepsDone() < *count)) {
    if ((*engine)->stepsDone() >= (*engine)->stepLimit(count)) return (*engine)->tooManySteps(count);
    const auto outcome = (*engine)->step(&trace);
    if (!outcome) return outcome.failure();
    history->settled = *outcome == Engine::Outcome::Settled;
    if (history->settled) break;
    if (auto done = recorder.step(trace); !done) return done.failure();
    if (recorder.bytes() > options.limits.bytes) return (*engine)->tooManyBytes();
    options.watch.report("growing", count ? static_cast<double>((*engine)->stepsDone()) / static_cast<double>(*count) : 0.5);
  }
  history->steps = (*engine)->stepsDone();
  history->bodies = recorder.takeBodies();
  history->habits = recorder.takeHabits();
  return history;
}

}  // namespace

Result<Growth> prepareGrowth(const Grammar& grammar, const GrowOptions& options) {
  if (grammar.language != Language::SimEco)
    return fail(ErrorCode::BadInput, "only a SimEco grammar grows over time; a classic L-system is drawn by its turtle after a number of steps");
  if (grammar.plants.empty()) return fail(ErrorCode::BadGrammar, "the grammar has no plant, so nothing can grow");
  if (options.upToTime && !(*options.upToTime >= 0)) return fail(ErrorCode::BadInput, "a time to grow up to must be a number of at least 0");
  if (options.steps && *options.steps < 0) return fail(ErrorCode::BadInput, "a plant cannot be derived for " + std::to_string(*options.steps) + " steps");
  auto scenes = scenesOf(grammar, options);
  if (!scenes) return scenes.failure();
  auto data = std::make_shared<GrowthData>();
  std::vector<RuleInfo> rules;
  data->name = grammar.name;
  data->turning = options.turning;
  for (std::size_t i = 0; i < grammar.plants.size(); ++i) {
    auto plant = recordPlant(grammar, i, rules, options, data->styles);
    if (!plant) return plant.failure();
    const bool complete = plant->settled || options.steps;
    if (options.upToTime && !complete) data->upToTime = options.upToTime;
    data->plants.push_back(*std::move(plant));
  }
  data->rules = RuleList(std::move(rules));
  if (auto lived = live(*data, grammar, options, *std::move(scenes)); !lived) return lived.failure();
  return Growth(std::move(data));
}

Result<Plant> plantAt(const Growth& growth, double time) {
  const GrowthData& data = growth.data();
  if (!(time >= 0) || !std::isfinite(time)) return fail(ErrorCode::BadInput, "a plant's time must be a number of at least 0, not " + shortest(time));
  if (data.upToTime && time > *data.upToTime)
    return fail(ErrorCode::BadInput, "growth was prepared up to time " + shortest(*data.upToTime) + "; time " + shortest(time) + " is later");
  return momentOf(data, time);
}

double completeTime(const Growth& growth) { return fullSizeTime(growth.data()); }

}  // namespace axil::simeco
