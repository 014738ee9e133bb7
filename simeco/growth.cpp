#include "simeco/growth.hpp"

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "simeco/engine.hpp"
#include "simeco/engine_machine.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::simeco {

namespace {

/// A size rule of a stage: a number, or an expression that is drawn anew for each organ.
struct SizeRule {
  std::optional<CompiledExpression> expression;
  double otherwise = 0;
};

/// What a stage says about its organs.
struct StageRules {
  std::int32_t style = 0;
  SizeRule growRate, growTime{.expression = {}, .otherwise = 1}, broadenRate;
};

/// How a body stands on another from a step on.
struct Placement {
  std::int64_t fromStep = 0;
  std::int32_t parent = -1;
  bool branch = false;
  Turn turn;
};

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

/// An organ's body through all steps.
struct Body {
  OrganKind kind = OrganKind::Stem;
  std::int32_t style = 0;
  std::int64_t born = 0;                 ///< step
  std::int64_t rewritten = never;        ///< step at which its module went and the body stayed
  std::int64_t gone = never;             ///< step at which it was cut off
  std::int32_t production = -1;
  double growRate = 0, growTime = 1, finalRadius = 0;
  std::vector<Placement> placements;     ///< in step order
  std::vector<std::pair<std::int64_t, std::int64_t>> modules;  ///< which module it is: from step, index in the string
};

/// One plant of the ecosystem: its bodies in the order in which they stand in the string, which no step ever changes.
struct PlantHistory {
  PlantPoint position;
  StemFrame base;
  double deriveTime = 1;
  std::int64_t steps = 0;
  bool settled = false;
  std::vector<Body> bodies;
};

}  // namespace

struct GrowthData {
  std::string name;
  TurningRule turning = TurningRule::Exact;
  std::optional<double> upToTime;
  std::vector<OrganStyle> styles;
  std::vector<PlantHistory> plants;
};

namespace {

// ---- attributes ------------------------------------------------------------------------------------------------------

const Attribute* attributeNamed(const std::vector<Attribute>& attributes, std::string_view name) {
  // The last one counts, as in a list of assignments.
  const auto found = std::find_if(attributes.rbegin(), attributes.rend(), [&](const Attribute& a) { return a.name == name; });
  return found == attributes.rend() ? nullptr : &*found;
}

Failure badAttribute(const std::string& name, const std::string& why) { return fail(ErrorCode::BadGrammar, "the attribute " + name + " " + why); }

Result<double> constantOf(const Grammar& grammar, const Attribute& attribute) {
  const auto compiled = compileExpression(grammar, attribute.value);
  if (!compiled) return badAttribute(attribute.name, "is not a number: " + compiled.error().message);
  if (!compiled->isConstant() || !std::isfinite(compiled->term.value)) return badAttribute(attribute.name, "must be a fixed, finite number");
  return compiled->term.value;
}

/// The number an attribute of the plant says, else the ecosystem's, else nothing.
Result<std::optional<double>> inherited(const Grammar& grammar, const PlantGrammar& plant, std::string_view name) {
  const Attribute* attribute = attributeNamed(plant.attributes, name);
  if (attribute == nullptr) attribute = attributeNamed(grammar.attributes, name);
  if (attribute == nullptr) return std::optional<double>{};
  const auto value = constantOf(grammar, *attribute);
  if (!value) return value.failure();
  return std::optional<double>(*value);
}

/// `vector(x, y, z)`, or `RGBA(r, g, b, a)`: the numbers of a call.
Result<std::vector<double>> numbersOf(const Grammar& grammar, const Attribute& attribute, std::string_view function, std::size_t count) {
  const auto* call = std::get_if<Call>(&grammar.at(attribute.value).node);
  if (call == nullptr || call->function != function || call->arguments.size() != count)
    return badAttribute(attribute.name, "must be " + std::string(function) + " with " + std::to_string(count) + " numbers");
  std::vector<double> numbers;
  for (const ExprId argument : call->arguments) {
    const auto number = constantOf(grammar, {attribute.name, argument, {}, {}});
    if (!number) return number.failure();
    numbers.push_back(*number);
  }
  return numbers;
}

Result<glm::dvec3> vectorAttribute(const Grammar& grammar, const PlantGrammar& plant, std::string_view name, glm::dvec3 otherwise) {
  const Attribute* attribute = attributeNamed(plant.attributes, name);
  if (attribute == nullptr) return otherwise;
  const auto numbers = numbersOf(grammar, *attribute, "vector", 3);
  if (!numbers) return numbers.failure();
  return glm::dvec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::string textAttribute(const Grammar& grammar, const std::vector<Attribute>& attributes, std::string_view name) {
  const Attribute* attribute = attributeNamed(attributes, name);
  if (attribute == nullptr) return {};
  const auto* text = std::get_if<Text>(&grammar.at(attribute->value).node);
  return text == nullptr ? std::string{} : text->text;
}

/// One bell curve of the environment: what the attribute is called, where growth is best, how fast it falls off.
struct ResponseRow {
  const char* attribute;
  const char* width;
  double best;
  double usualWidth;
};
constexpr ResponseRow kResponses[] = {{"SoilPH", "SoilPHWidth", 7, 1.5}, {"RainRate", "RainRateWidth", 0.9, 0.45}, {"DayLight", "DayLightWidth", 12, 6}};

Result<double> environmentResponse(const Grammar& grammar, const PlantGrammar& plant) {
  double response = 1;
  for (const ResponseRow& row : kResponses) {
    const auto value = inherited(grammar, plant, row.attribute);
    if (!value) return value.failure();
    const auto width = inherited(grammar, plant, row.width);
    if (!width) return width.failure();
    if (*width && !(**width > 0)) return badAttribute(row.width, "must be above 0");
    if (!*value) continue;
    const double away = (**value - row.best) / width->value_or(row.usualWidth);
    response *= std::exp(-0.5 * away * away);
  }
  return response;
}

// ---- stages ----------------------------------------------------------------------------------------------------------

/// An attribute of the stage, else of the whole organ block.
const Attribute* stageAttribute(const OrganBlock& block, const Stage& stage, std::string_view name) {
  const Attribute* own = attributeNamed(stage.attributes, name);
  return own != nullptr ? own : attributeNamed(block.attributes, name);
}

std::string stageText(const Grammar& grammar, const OrganBlock& block, const Stage& stage, std::string_view name) {
  const std::string own = textAttribute(grammar, stage.attributes, name);
  return own.empty() ? textAttribute(grammar, block.attributes, name) : own;
}

Result<SizeRule> sizeRule(const Grammar& grammar, const Attribute* attribute, double otherwise) {
  if (attribute == nullptr) return SizeRule{{}, otherwise};
  auto compiled = compileExpression(grammar, attribute->value);
  if (!compiled) return badAttribute(attribute->name, "is not a number: " + compiled.error().message);
  return SizeRule{*std::move(compiled), otherwise};
}

using StageTable = std::map<std::pair<OrganKind, int>, StageRules>;

Result<OrganStyle> styleOf(const Grammar& grammar, const OrganBlock& block, const Stage& stage) {
  OrganStyle style{block.kind, stage.number, stageText(grammar, block, stage, "Model"), stageText(grammar, block, stage, "TextureFront"), {}, 1};
  if (const Attribute* colour = stageAttribute(block, stage, "ColorFront")) {
    const auto numbers = numbersOf(grammar, *colour, "RGBA", 4);
    if (!numbers) return numbers.failure();
    style.colour = glm::dvec4{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  }
  return style;
}

Result<StageTable> readStages(const Grammar& grammar, const PlantGrammar& plant, std::vector<OrganStyle>& styles) {
  StageTable table;
  for (const OrganBlock& block : plant.organs) {
    for (const Stage& stage : block.stages) {
      StageRules rules;
      const struct {
        const char* name;
        SizeRule& rule;
        double otherwise;
      } rows[] = {{"GrowRate", rules.growRate, 0}, {"GrowTime", rules.growTime, 1}, {"BroadenRate", rules.broadenRate, 0}};
      for (const auto& row : rows) {
        auto rule = sizeRule(grammar, stageAttribute(block, stage, row.name), row.otherwise);
        if (!rule) return rule.failure();
        row.rule = *std::move(rule);
      }
      auto style = styleOf(grammar, block, stage);
      if (!style) return style.failure();
      const auto& time = rules.growTime.expression;
      style->growTime = time && time->isConstant() ? time->term.value : rules.growTime.otherwise;
      rules.style = static_cast<std::int32_t>(styles.size());
      styles.push_back(*std::move(style));
      table[{block.kind, stage.number}] = std::move(rules);
    }
  }
  return table;
}

/// The sizes of one new organ; drawn ones depend on (seed, step, module) alone.
class Sizes {
 public:
  Sizes(std::uint64_t seed, const Limits& limits, const Watch& watch) : random_(Rng(seed).split(sizeStream)), limits_(limits), watch_(watch) {}

  Result<double> of(const SizeRule& rule, const char* name, std::uint64_t step, std::uint64_t module, std::uint64_t which) const {
    double value = rule.otherwise;
    if (rule.expression) {
      const auto computed = compute(*rule.expression, random_.split(step, module).split(which));
      if (!computed) return badAttribute(name, "of a stage cannot be computed: " + computed.error().message);
      value = *computed;
    }
    if (!std::isfinite(value) || value < 0) return badAttribute(name, "of a stage must be a finite number of at least 0, not " + shortest(value));
    return value;
  }

 private:
  static constexpr std::uint64_t sizeStream = 101;

  Result<double> compute(const CompiledExpression& expression, const Rng& rng) const {
    if (expression.isConstant()) return expression.term.value;
    const Host noHost;
    const SharedSettings shared{expression.program.get(), &limits_, &watch_, &noHost, std::chrono::steady_clock::time_point::max()};
    Machine machine(shared);
    machine.setRandom(rng);
    const double value = machine.value(expression.term, nullptr);
    if (machine.trouble()) return fail(*machine.trouble());
    return value;
  }

  Rng random_;
  const Limits& limits_;
  const Watch& watch_;
};

// ---- history ---------------------------------------------------------------------------------------------------------

/// A piece of the string with the bodies that stayed behind: a body alone, or a module of the string (and its body, if any).
struct Piece {
  std::int32_t body = -1;
  bool module = false;
};

/// Follows one plant's derivation and writes down when and where its bodies stand.
class Recorder {
 public:
  Recorder(Engine& engine, const StageTable& stages, double response, std::int32_t firstProduction, const Sizes& sizes)
      : engine_(engine), stages_(stages), response_(response), firstProduction_(firstProduction), sizes_(sizes) {
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
        if (auto done = addModule(*view, made, rule); !done) return done;
    }
    place();
    return {};
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
    auto body = newBody(*stage, role.kind, module, rule);
    if (!body) return body.failure();
    pieces_.back().body = static_cast<std::int32_t>(bodies_.size());
    bodies_.push_back(*std::move(body));
    return {};
  }

  Result<Body> newBody(const StageRules& stage, OrganKind kind, std::size_t module, std::int32_t rule) const {
    const auto step = static_cast<std::uint64_t>(engine_.stepsDone());
    const auto rate = sizes_.of(stage.growRate, "GrowRate", step, module, 0);
    if (!rate) return rate.failure();
    const auto time = sizes_.of(stage.growTime, "GrowTime", step, module, 1);
    if (!time) return time.failure();
    const auto broaden = sizes_.of(stage.broadenRate, "BroadenRate", step, module, 2);
    if (!broaden) return broaden.failure();
    Body body;
    body.kind = kind;
    body.style = stage.style;
    body.born = engine_.stepsDone();
    body.production = rule < 0 ? -1 : firstProduction_ + rule;
    body.growRate = *rate * response_;
    body.growTime = *time;
    body.finalRadius = *broaden * *time * modelRadius;
    if (!stage.broadenRate.expression && kind == OrganKind::Stem) body.finalRadius = defaultStemShare * modelRadius;
    body.modules.emplace_back(engine_.stepsDone(), static_cast<std::int64_t>(module));
    return body;
  }

  void nowModule(std::int32_t body, std::size_t module) {
    auto& modules = bodies_[static_cast<std::size_t>(body)].modules;
    if (modules.back().second != static_cast<std::int64_t>(module)) modules.emplace_back(engine_.stepsDone(), static_cast<std::int64_t>(module));
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
    if (body.placements.empty() || !same(body.placements.back())) body.placements.push_back(now);
    turtle = {id, false, {}};
  }

  Engine& engine_;
  const StageTable& stages_;
  double response_;
  std::int32_t firstProduction_;
  const Sizes& sizes_;
  std::vector<SymbolRole> roles_;
  std::vector<Piece> pieces_;
  std::vector<Body> bodies_;
};

// ---- one plant -------------------------------------------------------------------------------------------------------

Result<PlantHistory> standingPlace(const Grammar& grammar, const PlantGrammar& plant) {
  PlantHistory history;
  const auto position = vectorAttribute(grammar, plant, "Position", {0, 0, 0});
  if (!position) return position.failure();
  history.position = {*position};
  const auto direction = vectorAttribute(grammar, plant, "Direction", {0, 1, 0});
  if (!direction) return direction.failure();
  if (!PlantDirection::hasDirection(*direction)) return badAttribute("Direction", "must not be the zero vector");
  history.base = firstFrame(PlantDirection::along(*direction));
  if (const Attribute* attribute = attributeNamed(plant.attributes, "DeriveTime")) {
    const auto time = constantOf(grammar, *attribute);
    if (!time) return time.failure();
    if (!(*time > 0)) return badAttribute("DeriveTime", "must be above 0");
    history.deriveTime = *time;
  }
  return history;
}

/// How many steps to derive, or nothing for as many as it takes.
std::optional<std::int64_t> stepsFor(const GrowOptions& options, const Engine& engine, double deriveTime) {
  if (options.steps) return options.steps;
  if (!options.upToTime) return engine.ownLength();
  const double steps = std::floor(*options.upToTime / deriveTime) + 1;  // one more, lest rounding lose the last
  return std::min(static_cast<std::int64_t>(std::fmin(steps, 1e15)), engine.ownLength().value_or(never));
}

Result<PlantHistory> recordPlant(const Grammar& grammar, std::size_t index, std::int32_t firstProduction, const GrowOptions& options,
                                 std::vector<OrganStyle>& styles) {
  const PlantGrammar& plant = grammar.plants[index];
  auto history = standingPlace(grammar, plant);
  if (!history) return history;
  const auto stages = readStages(grammar, plant, styles);
  if (!stages) return stages.failure();
  const auto response = environmentResponse(grammar, plant);
  if (!response) return response.failure();
  auto program = compile(grammar, index, {options.limits.expressionDepth});
  if (!program) return program.failure();
  const std::uint64_t seed = Rng(options.seed).split(index).bits();
  auto engine = Engine::create(*std::move(program), {.seed = index == 0 ? options.seed : seed, .limits = options.limits, .watch = options.watch});
  if (!engine) return engine.failure();
  if (auto started = (*engine)->start(); !started) return started.failure();
  const Sizes sizes(index == 0 ? options.seed : seed, options.limits, options.watch);
  Recorder recorder(**engine, *stages, *response, firstProduction, sizes);
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
    options.watch.report("growing", count ? static_cast<double>((*engine)->stepsDone()) / static_cast<double>(*count) : 0.5);
  }
  history->steps = (*engine)->stepsDone();
  history->bodies = recorder.takeBodies();
  return history;
}

// ---- one moment ------------------------------------------------------------------------------------------------------

/// The last of a history's entries that holds at `time`.
template <class Entries, class StepOf>
const auto& holding(const Entries& entries, double time, double deriveTime, StepOf stepOf) {
  const auto later = std::partition_point(entries.begin(), entries.end(), [&](const auto& entry) { return static_cast<double>(stepOf(entry)) * deriveTime <= time; });
  return later == entries.begin() ? *later : *std::prev(later);
}

bool happened(std::int64_t step, const PlantHistory& plant, double time) { return step != never && static_cast<double>(step) * plant.deriveTime <= time; }

void addPlant(const GrowthData& data, const PlantHistory& plant, double time, std::vector<Organ>& organs) {
  std::vector<std::int32_t> organOf(plant.bodies.size(), -1);
  std::vector<StemFrame> frames(plant.bodies.size());
  for (std::size_t i = 0; i < plant.bodies.size(); ++i) {
    const Body& body = plant.bodies[i];
    if (!happened(body.born, plant, time) || happened(body.gone, plant, time)) continue;
    const Placement& placement = holding(body.placements, time, plant.deriveTime, [](const Placement& p) { return p.fromStep; });
    const bool rooted = placement.parent < 0;
    const StemFrame& from = rooted ? plant.base : frames[static_cast<std::size_t>(placement.parent)];
    const bool straight = rooted && placement.turn.rotr == Angle{} && placement.turn.rotu == Angle{};
    frames[i] = straight ? from : childFrame(from, placement.turn, placement.branch ? ChildKind::Branch : ChildKind::Main, data.turning);
    Organ organ;
    organ.kind = body.kind;
    organ.style = body.style;
    organ.branch = placement.branch;
    if (!rooted) organ.parent = OrganId(organOf[static_cast<std::size_t>(placement.parent)]);
    organ.base = rooted ? plant.position : organs[static_cast<std::size_t>(organ.parent->value)].tip();
    organ.direction = frames[i].direction;
    organ.rAxis = frames[i].rAxis;
    organ.adaxial = frames[i].adaxial;
    organ.age = time - static_cast<double>(body.born) * plant.deriveTime;
    organ.length = body.growRate * std::min(organ.age, body.growTime);
    organ.radius = body.growTime > 0 ? body.finalRadius * (std::min(organ.age, body.growTime) / body.growTime) : body.finalRadius;
    organ.production = body.production;
    organ.module = happened(body.rewritten, plant, time) ? -1 : holding(body.modules, time, plant.deriveTime, [](const auto& m) { return m.first; }).second;
    organOf[i] = static_cast<std::int32_t>(organs.size());
    organs.push_back(organ);
  }
}

}  // namespace

Result<Growth> prepareGrowth(const Grammar& grammar, const GrowOptions& options) {
  if (grammar.language != Language::SimEco)
    return fail(ErrorCode::BadInput, "only a SimEco grammar grows over time; a classic L-system is drawn by its turtle after a number of steps");
  if (grammar.plants.empty()) return fail(ErrorCode::BadGrammar, "the grammar has no plant, so nothing can grow");
  if (options.upToTime && !(*options.upToTime >= 0)) return fail(ErrorCode::BadInput, "a time to grow up to must be a number of at least 0");
  if (options.steps && *options.steps < 0) return fail(ErrorCode::BadInput, "a plant cannot be derived for " + std::to_string(*options.steps) + " steps");
  auto data = std::make_shared<GrowthData>();
  data->name = grammar.name;
  data->turning = options.turning;
  std::int32_t production = 0;
  for (std::size_t i = 0; i < grammar.plants.size(); ++i) {
    auto plant = recordPlant(grammar, i, production, options, data->styles);
    if (!plant) return plant.failure();
    const bool complete = plant->settled || options.steps;
    if (options.upToTime && !complete) data->upToTime = options.upToTime;
    data->plants.push_back(*std::move(plant));
    production += static_cast<std::int32_t>(grammar.plants[i].rules.productions.size());
  }
  return Growth(std::move(data));
}

Result<Plant> plantAt(const Growth& growth, double time) {
  const GrowthData& data = growth.data();
  if (!(time >= 0) || !std::isfinite(time)) return fail(ErrorCode::BadInput, "a plant's time must be a number of at least 0, not " + shortest(time));
  if (data.upToTime && time > *data.upToTime)
    return fail(ErrorCode::BadInput, "growth was prepared up to time " + shortest(*data.upToTime) + "; time " + shortest(time) + " is later");
  Plant plant{data.name, time, data.styles, {}};
  for (const PlantHistory& history : data.plants) addPlant(data, history, time, plant.organs);
  return plant;
}

double completeTime(const Growth& growth) {
  double complete = 0;
  for (const PlantHistory& plant : growth.data().plants) {
    complete = std::max(complete, static_cast<double>(plant.steps) * plant.deriveTime);
    for (const Body& body : plant.bodies)
      if (body.gone == never) complete = std::max(complete, static_cast<double>(body.born) * plant.deriveTime + body.growTime);
  }
  return complete;
}

}  // namespace axil::simeco
