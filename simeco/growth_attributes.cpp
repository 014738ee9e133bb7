#include "simeco/growth_attributes.hpp"

#include "base/text.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace axil::simeco {

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

/// An attribute of the plant, else of the ecosystem.
const Attribute* inheritedAttribute(const Grammar& grammar, const PlantGrammar& plant, std::string_view name) {
  const Attribute* attribute = attributeNamed(plant.attributes, name);
  return attribute != nullptr ? attribute : attributeNamed(grammar.attributes, name);
}

Result<std::optional<double>> inherited(const Grammar& grammar, const PlantGrammar& plant, std::string_view name) {
  const Attribute* attribute = inheritedAttribute(grammar, plant, name);
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

Result<glm::dvec3> vectorOf(const Grammar& grammar, const Attribute* attribute, glm::dvec3 otherwise) {
  if (attribute == nullptr) return otherwise;
  const auto numbers = numbersOf(grammar, *attribute, "vector", 3);
  if (!numbers) return numbers.failure();
  return glm::dvec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

Result<std::optional<glm::dvec4>> colourOf(const Grammar& grammar, const Attribute* attribute) {
  if (attribute == nullptr) return std::optional<glm::dvec4>{};
  const auto numbers = numbersOf(grammar, *attribute, "RGBA", 4);
  if (!numbers) return numbers.failure();
  return std::optional(glm::dvec4{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]});
}

std::string textAttribute(const Grammar& grammar, const std::vector<Attribute>& attributes, std::string_view name) {
  const Attribute* attribute = attributeNamed(attributes, name);
  if (attribute == nullptr) return {};
  const auto* text = std::get_if<Text>(&grammar.at(attribute->value).node);
  return text == nullptr ? std::string{} : text->text;
}

// ---- the environment -------------------------------------------------------------------------------------------------

/// One bell curve of the environment: what the attribute is called, where growth is best, how fast it falls off.
struct ResponseRow {
  const char* attribute;
  std::optional<double> Environment::*said;
  const char* width;
  double usualWidth;
  const char* best;
  double usualBest;
};
constexpr ResponseRow kResponses[] = {{"SoilPH", &Environment::soilPH, "SoilPHWidth", 1.5, "SoilPHBest", 7},
                                      {"RainRate", &Environment::rainRate, "RainRateWidth", 0.45, "RainRateBest", 0.9},
                                      {"DayLight", &Environment::dayLight, "DayLightWidth", 6, "DayLightBest", 12},
                                      {"Temperature", &Environment::temperature, "TemperatureWidth", 8, "TemperatureBest", 22}};

Result<double> responseTo(const Environment& environment, const Grammar& grammar, const PlantGrammar& plant) {
  double response = 1;
  for (const ResponseRow& row : kResponses) {
    const auto value = inherited(grammar, plant, row.attribute);
    if (!value) return value.failure();
    const auto width = inherited(grammar, plant, row.width);
    if (!width) return width.failure();
    if (*width && !(**width > 0)) return badAttribute(row.width, "must be above 0");
    const auto best = inherited(grammar, plant, row.best);
    if (!best) return best.failure();
    const std::optional<double> now = environment.*row.said ? environment.*row.said : *value;
    if (!now) continue;
    const double away = (*now - best->value_or(row.usualBest)) / width->value_or(row.usualWidth);
    response *= std::exp(-0.5 * away * away);
  }
  return response;
}

Result<Surroundings> surroundingsIn(const Environment& environment, const Grammar& grammar, const PlantGrammar& plant) {
  Surroundings result;
  const auto response = responseTo(environment, grammar, plant);
  if (!response) return response.failure();
  result.response = *response;
  const struct {
    const char* name;
    const std::optional<glm::dvec3>& said;
    glm::dvec3& vector;
  } rows[] = {{"Light", environment.light, result.light}, {"Gravity", environment.gravity, result.gravity}, {"Wind", environment.wind, result.wind}};
  for (const auto& row : rows) {
    const auto vector = vectorOf(grammar, inheritedAttribute(grammar, plant, row.name), row.vector);
    if (!vector) return vector.failure();
    row.vector = row.said.value_or(*vector);
  }
  if (!PlantDirection::hasDirection(result.light)) return badAttribute("Light", "must not be the zero vector");
  result.light = glm::normalize(result.light);
  return result;
}

// ---- stages ----------------------------------------------------------------------------------------------------------

/// Where a stage's attributes are looked for: the stage, its organ block, and for some the plant.
struct StageView {
  const Grammar& grammar;
  const PlantGrammar& plant;
  const OrganBlock& block;
  const Stage& stage;

  [[nodiscard]] const Attribute* own(std::string_view name) const {
    const Attribute* attribute = attributeNamed(stage.attributes, name);
    return attribute != nullptr ? attribute : attributeNamed(block.attributes, name);
  }
  [[nodiscard]] const Attribute* ownOrPlants(std::string_view name) const {
    const Attribute* attribute = own(name);
    return attribute != nullptr ? attribute : attributeNamed(plant.attributes, name);
  }
  [[nodiscard]] std::string text(std::string_view name) const {
    const std::string of = textAttribute(grammar, stage.attributes, name);
    return of.empty() ? textAttribute(grammar, block.attributes, name) : of;
  }
};

Result<SizeRule> sizeRule(const StageView& view, const Attribute* attribute, double otherwise) {
  if (attribute == nullptr) return SizeRule{{}, otherwise};
  auto compiled = compileExpression(view.grammar, attribute->value, view.stage.parameters);
  if (!compiled) return badAttribute(attribute->name, "is not a number: " + compiled.error().message);
  return SizeRule{*std::move(compiled), otherwise};
}

constexpr double kAny = -std::numeric_limits<double>::infinity();

/// The numbers of a habit. Those of the plant may stand in the Plant too.
struct HabitRow {
  const char* attribute;
  double Habit::*number;
  double least;
  bool ofPlant;
};
constexpr HabitRow kHabits[] = {{"Elasticity", &Habit::elasticity, 0, true},     {"GravityTropism", &Habit::gravity, kAny, true},
                                {"LightTropism", &Habit::light, kAny, true},     {"WindTropism", &Habit::wind, kAny, true},
                                {"LightResponse", &Habit::lightResponse, 0, true}, {"UnfoldTime", &Habit::unfoldTime, 0, false},
                                {"WitherAge", &Habit::witherAge, 0, false},      {"WitherTime", &Habit::witherTime, 0, false},
                                {"FallAge", &Habit::fallAge, 0, false}};

Result<void> readHabit(const StageView& view, StageRules& rules) {
  if (view.block.kind == OrganKind::Root) rules.habit.wind = 0;  // no wind blows in the ground
  const auto tropism = vectorOf(view.grammar, view.ownOrPlants("Tropism"), {0, 0, 0});
  if (!tropism) return tropism.failure();
  rules.habit.tropism = *tropism;
  for (const HabitRow& row : kHabits) {
    auto rule = sizeRule(view, row.ofPlant ? view.ownOrPlants(row.attribute) : view.own(row.attribute), rules.habit.*row.number);
    if (!rule) return rule.failure();
    rules.habitRules.push_back(*std::move(rule));
  }
  return {};
}

Result<OrganStyle> styleOf(const StageView& view) {
  OrganStyle style{view.block.kind, view.stage.number, view.text("Model"), view.text("TextureFront"), {}, 1};
  const auto colour = colourOf(view.grammar, view.own("ColorFront"));
  if (!colour) return colour.failure();
  style.colour = *colour;
  return style;
}

constexpr int kWitherGrades = 4;
constexpr glm::dvec4 kWithered{0.42, 0.31, 0.16, 1};

/// The looks of an organ that withers, step by step from its own colour to the withered one.
Result<void> addWitherStyles(const StageView& view, StageRules& rules, std::vector<OrganStyle>& styles) {
  if (view.own("WitherAge") == nullptr) return {};
  const auto colour = colourOf(view.grammar, view.own("WitherColor"));
  if (!colour) return colour.failure();
  const OrganStyle fresh = styles[static_cast<std::size_t>(rules.style)];
  const glm::dvec4 goal = colour->value_or(kWithered);
  rules.habit.witherStyle = static_cast<std::int32_t>(styles.size());
  rules.habit.witherStyles = fresh.colour ? kWitherGrades : 1;  // a colour that nobody named cannot be mixed
  for (int i = 1; i <= rules.habit.witherStyles; ++i) {
    OrganStyle style = fresh;
    style.colour = glm::mix(fresh.colour.value_or(goal), goal, static_cast<double>(i) / rules.habit.witherStyles);
    styles.push_back(std::move(style));
  }
  return {};
}

Result<StageRules> readStage(const StageView& view, std::vector<OrganStyle>& styles) {
  StageRules rules;
  rules.parameters = view.stage.parameters.size();
  const struct {
    const char* name;
    SizeRule& rule;
    double otherwise;
  } rows[] = {{"GrowRate", rules.growRate, 0}, {"GrowTime", rules.growTime, 1}, {"BroadenRate", rules.broadenRate, 0}, {"BroadenTime", rules.broadenTime, 0}};
  for (const auto& row : rows) {
    auto rule = sizeRule(view, view.own(row.name), row.otherwise);
    if (!rule) return rule.failure();
    row.rule = *std::move(rule);
  }
  auto style = styleOf(view);
  if (!style) return style.failure();
  const auto& time = rules.growTime.expression;
  style->growTime = time && time->isConstant() ? time->term.value : rules.growTime.otherwise;
  rules.style = static_cast<std::int32_t>(styles.size());
  styles.push_back(*std::move(style));
  if (auto habit = readHabit(view, rules); !habit) return habit.failure();
  if (auto withering = addWitherStyles(view, rules, styles); !withering) return withering.failure();
  return rules;
}

Result<Obstacle> obstacleOf(const Grammar& grammar, const Attribute& attribute) {
  const auto* call = std::get_if<Call>(&grammar.at(attribute.value).node);
  const bool box = call != nullptr && call->function == "box";
  const auto numbers = numbersOf(grammar, attribute, box ? "box" : "sphere", box ? 6 : 4);
  if (!numbers) return numbers.failure();
  const std::vector<double>& n = *numbers;
  if (box) return Obstacle{BoxObstacle{{{n[0], n[1], n[2]}}, {{n[3], n[4], n[5]}}}};
  return Obstacle{SphereObstacle{{{n[0], n[1], n[2]}}, n[3]}};
}

}  // namespace

Result<std::vector<Obstacle>> obstaclesIn(const Grammar& grammar) {
  std::vector<Obstacle> obstacles;
  for (const Attribute& attribute : grammar.attributes) {
    if (attribute.name != "Obstacle") continue;
    auto obstacle = obstacleOf(grammar, attribute);
    if (!obstacle) return obstacle.failure();
    obstacles.push_back(*std::move(obstacle));
  }
  return obstacles;
}

Result<StageTable> readStages(const Grammar& grammar, const PlantGrammar& plant, std::vector<OrganStyle>& styles) {
  StageTable table;
  for (const OrganBlock& block : plant.organs)
    for (const Stage& stage : block.stages) {
      auto rules = readStage({grammar, plant, block, stage}, styles);
      if (!rules) return rules.failure();
      table[{block.kind, stage.number}] = *std::move(rules);
    }
  return table;
}

Result<PlantHistory> standingPlace(const Grammar& grammar, const PlantGrammar& plant) {
  PlantHistory history;
  const auto position = vectorOf(grammar, attributeNamed(plant.attributes, "Position"), {0, 0, 0});
  if (!position) return position.failure();
  history.position = {*position};
  const auto direction = vectorOf(grammar, attributeNamed(plant.attributes, "Direction"), {0, 1, 0});
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

Result<std::vector<Surroundings>> surroundingsOf(const Grammar& grammar, const PlantGrammar& plant, std::span<const Scene> scenes) {
  std::vector<Surroundings> all;
  for (const Scene& scene : scenes) {
    auto surroundings = surroundingsIn(scene.environment, grammar, plant);
    if (!surroundings) return surroundings.failure();
    surroundings->from = scene.from;
    surroundings->obstacles = scene.obstacles;
    all.push_back(*std::move(surroundings));
  }
  return all;
}

bool StageRules::hasFixedHabit() const {
  return std::all_of(habitRules.begin(), habitRules.end(), [](const SizeRule& rule) { return !rule.expression || rule.expression->isConstant(); });
}

Result<Draws::Sizes> Draws::sizesOf(const StageRules& stage, Place place) const {
  Sizes sizes;
  const struct {
    const SizeRule& rule;
    const char* name;
    double& size;
  } rows[] = {{stage.growRate, "GrowRate", sizes.rate}, {stage.growTime, "GrowTime", sizes.growTime}, {stage.broadenRate, "BroadenRate", sizes.broadenRate},
              {stage.broadenTime, "BroadenTime", sizes.broadenTime}};
  std::uint64_t which = 0;
  for (const auto& row : rows) {
    const auto size = draw(row.rule, row.name, 0, place, which++);
    if (!size) return size.failure();
    row.size = *size;
  }
  if (!stage.broadenTime.expression) sizes.broadenTime = sizes.growTime;
  return sizes;
}

Result<Habit> Draws::habitOf(const StageRules& stage, Place place) const {
  constexpr std::uint64_t kFirstDraw = 16;  // after the sizes
  Habit habit = stage.habit;
  for (std::size_t i = 0; i < stage.habitRules.size(); ++i) {
    const auto number = draw(stage.habitRules[i], kHabits[i].attribute, kHabits[i].least, place, kFirstDraw + i);
    if (!number) return number.failure();
    habit.*kHabits[i].number = *number;
  }
  if (habit.lightResponse > 1) return badAttribute("LightResponse", "must be from 0 to 1, not " + shortest(habit.lightResponse));
  return habit;
}

Result<double> Draws::draw(const SizeRule& rule, const char* name, double least, Place place, std::uint64_t which) const {
  if (!rule.expression) return rule.otherwise;
  const auto value = compute(*rule.expression, random_.split(place.step, place.module).split(which), place.arguments);
  if (!value) return badAttribute(name, "of a stage cannot be computed: " + value.error().message);
  if (std::isfinite(*value) && *value >= least) return *value;
  return badAttribute(name, "of a stage must be a finite number" + std::string(least == 0 ? " of at least 0" : "") + ", not " + shortest(*value));
}

Result<double> Draws::compute(const CompiledExpression& expression, const Rng& rng, std::span<const double> arguments) const {
  if (expression.isConstant()) return expression.term.value;
  const Host noHost;
  const SharedSettings shared{expression.program.get(), &limits_, &watch_, &noHost, std::chrono::steady_clock::time_point::max()};
  Machine machine(shared);
  machine.setRandom(rng);
  std::vector<double> locals(arguments.begin(), arguments.end());  // an expression assigns none of them
  const double value = machine.value(expression.term, locals.data());
  if (machine.trouble()) return fail(*machine.trouble());
  return value;
}

}  // namespace axil::simeco
