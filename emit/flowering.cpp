#include "emit/flowering.hpp"

#include "base/overloaded.hpp"
#include "emit/text_grammar.hpp"
#include "keywords/keywords.hpp"
#include "keywords/models.hpp"
#include "organs/model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace axil::emit {

namespace {

using keywords::Presets;
using keywords::Traits;
using simeco::ExprId;
using simeco::Grammar;
using simeco::Module;
using simeco::OrganKind;

std::string cm(double metres) { return num(std::round(metres * 1000) / 10) + " cm"; }

std::string words(const Presets& presets, const std::string& preset) {
  const auto found = presets.evidence.find(preset);
  return found == presets.evidence.end() ? "" : " (\"" + found->second + "\")";
}

bool saysPosition(const Traits& traits, std::string_view position) {
  return std::any_of(traits.begin(), traits.end(), [&](const keywords::Trait& t) {
    return t.property == "position" && t.value == position && t.qualifier != "rarely" && t.qualifier != "sometimes";
  });
}

/// A flower's model is one unit long: tube and petal. Where the text says how long the tube and how wide the flower is, both hold.
void setFlowerSize(InflorescencePlan& plan, const keywords::FlowerPreset& flower, double leaf_m) {
  if (flower.diameter_m && flower.tubeLength_m && flower.tubeLength_m->middle() > 0 && organs::flowerModelNamed(plan.flowerModel).shape.tube > 0.2) {
    const double share = flower.tubeLength_m->middle() / (flower.tubeLength_m->middle() + 0.5 * flower.diameter_m->middle());
    plan.flowerModel += ", tube " + std::to_string(static_cast<int>(std::lround(100 * std::clamp(share, 0.2, 0.9))));
  }
  const organs::FlowerShape shape = organs::flowerModelNamed(plan.flowerModel).shape;
  const double petal = 1 - shape.tube;
  const double reach = std::max(0.1, petal * std::sin(std::min(shape.spread_deg, 90.0) * std::numbers::pi / 180) + shape.mouthRadius);
  double length = 0.4 * leaf_m;
  if (flower.diameter_m) length = 0.5 * flower.diameter_m->middle() / reach;
  else if (flower.tubeLength_m && shape.tube > 0.2) length = flower.tubeLength_m->middle() / shape.tube;
  else if (flower.tubeLength_m && flower.tubeLength_m->middle() > 0) length = flower.tubeLength_m->middle();
  else if (flower.petalLength_m) length = flower.petalLength_m->middle() / petal;
  plan.flowerLength = std::clamp(length, 0.0005, 0.5);
  plan.flowerWidth = 2 * reach * plan.flowerLength;
}

/// Fruits follow the flowers where the text names them.
void setFruit(Flowering& flowering, const Traits& traits, const Presets& presets) {
  const keywords::FruitPreset& fruit = presets.fruit;
  FruitPlan& plan = flowering.plan.fruit;
  plan.model = keywords::fruitModelOf(presets);
  if (plan.model.empty()) return;
  const double widthToLength = organs::fruitModelNamed(plan.model).shape.widthToLength;
  const double usual = std::clamp(0.8 * flowering.plan.flowerWidth, 0.003, 0.06);
  const double length = fruit.length_m ? fruit.length_m->middle() : fruit.diameter_m ? fruit.diameter_m->middle() / std::max(widthToLength, 0.05) : usual;
  plan.length = std::clamp(length, 0.0005, 0.8);
  plan.width = plan.length * widthToLength;
  const auto colours = keywords::fruitColours(traits);
  if (!colours.empty()) plan.colour = colours.front();
  flowering.notes.push_back("Fruits " + cm(plan.length) + " long, model \"" + plan.model + "\"" + words(presets, "fruit.type") + ", when the flowers are over.");
}

std::string noteOf(const Flowering& flowering, const Presets& presets) {
  const std::string& type = presets.flower.inflorescence;
  const char* where = !flowering.axillary ? ", terminal." : flowering.terminal ? ", terminal and axillary." : ", axillary.";
  return "Flowers " + cm(flowering.plan.flowerLength) + " long, model \"" + flowering.plan.flowerModel + "\", " +
         (type.empty() ? std::string("alone: the text names no inflorescence") : type + words(presets, "flower.inflorescence")) + where;
}

// ---- into a measured plant's grammar -----------------------------------------------------------------------------------

/// Adds another grammar's expressions to one's arena, and carries over what stands on them.
class Guest {
 public:
  Guest(Grammar& host, const Grammar& guest) : offset_(static_cast<std::int32_t>(host.expressions.size())) {
    for (simeco::Expr expression : guest.expressions) {
      shift(expression.node);
      host.expressions.push_back({std::move(expression.node), {}});
    }
  }

  [[nodiscard]] std::vector<Module> modules(std::vector<Module> all) const {
    for (Module& module : all)
      for (ExprId& argument : module.arguments) argument = moved(argument);
    return all;
  }

  [[nodiscard]] simeco::Production production(simeco::Production rule) const {
    rule.predecessor = modules(std::move(rule.predecessor));
    if (rule.condition) rule.condition = moved(*rule.condition);
    for (simeco::Successor& successor : rule.successors) {
      successor.modules = modules(std::move(successor.modules));
      if (successor.weight) successor.weight = moved(*successor.weight);
    }
    return rule;
  }

  [[nodiscard]] simeco::Stage stage(simeco::Stage stage) const {
    for (simeco::Attribute& attribute : stage.attributes) attribute.value = moved(attribute.value);
    return stage;
  }

 private:
  [[nodiscard]] ExprId moved(ExprId id) const { return ExprId(id.value + offset_); }
  void shiftAll(std::vector<ExprId>& ids) const {
    for (ExprId& id : ids) id = moved(id);
  }
  void shift(simeco::ExprNode& node) const {
    std::visit(overloaded{[](simeco::Number&) {}, [](simeco::Name&) {}, [](simeco::Text&) {},
                          [&](simeco::Unary& u) { u.operand = moved(u.operand); },
                          [&](simeco::Binary& b) {
                            b.left = moved(b.left);
                            b.right = moved(b.right);
                          },
                          [&](simeco::Chain& c) { shiftAll(c.operands); },
                          [&](simeco::Conditional& c) {
                            c.condition = moved(c.condition);
                            c.yes = moved(c.yes);
                            c.no = moved(c.no);
                          },
                          [&](simeco::Call& c) { shiftAll(c.arguments); }, [&](simeco::Element& e) { shiftAll(e.indices); }},
               node);
  }

  std::int32_t offset_;
};

/// Puts inflorescences where a grammar's own axes end and its own leaves stand. Its growing points are the apices whose last parameter counts
/// the segments that are `left`, and whose rules make stems.
class Bearer {
 public:
  Bearer(Grammar grammar, Flowering flowering) : grammar_(std::move(grammar)), flowering_(std::move(flowering)) {}

  Result<Grammar> flowering() {
    std::vector<std::size_t> growing = growingRules();
    if (growing.empty() || grammar_.plants.size() != 1) return std::move(grammar_);
    firstApex_ = nextFree(OrganKind::Apex);
    for (const std::size_t rule : growing) bearIn(plant().rules.productions[rule]);
    if (flowering_.terminal) addLastRules(growing);
    if (const auto added = addInflorescence(); !added) return added.failure();
    grammar_.version = "1.1";
    return std::move(grammar_);
  }

 private:
  simeco::PlantGrammar& plant() { return grammar_.plants.front(); }

  [[nodiscard]] std::optional<int> numberOf(const Module& module) const {
    const auto* number = module.arguments.empty() ? nullptr : std::get_if<simeco::Number>(&grammar_.at(module.arguments.front()).node);
    return number == nullptr ? std::nullopt : std::optional(static_cast<int>(number->value));
  }
  [[nodiscard]] bool countsLeft(const Module& module) const {
    const auto* last = module.arguments.size() < 3 ? nullptr : std::get_if<simeco::Name>(&grammar_.at(module.arguments.back()).node);
    return module.letter == "A" && last != nullptr && last->name == "left";
  }
  static bool has(const std::vector<Module>& modules, const char* letter) {
    return std::any_of(modules.begin(), modules.end(), [&](const Module& m) { return m.letter == letter; });
  }

  [[nodiscard]] std::vector<std::size_t> growingRules() {
    std::vector<std::size_t> rules;
    const auto& productions = plant().rules.productions;
    for (std::size_t i = 0; i < productions.size(); ++i) {
      const bool grows = std::any_of(productions[i].successors.begin(), productions[i].successors.end(), [](const simeco::Successor& s) { return has(s.modules, "S"); });
      if (productions[i].predecessor.size() == 1 && countsLeft(productions[i].predecessor.front()) && grows) rules.push_back(i);
    }
    return rules;
  }

  /// A number above all of that organ's stages and modules.
  [[nodiscard]] int nextFree(OrganKind kind) {
    int most = 0;
    for (const auto& block : plant().organs)
      if (block.kind == kind)
        for (const auto& stage : block.stages) most = std::max(most, stage.number);
    const auto note = [&](const std::vector<Module>& modules) {
      for (const Module& module : modules)
        if (module.letter == simeco::letterOf(kind)) most = std::max(most, numberOf(module).value_or(0));
    };
    note(plant().rules.axiom);
    for (const auto& rule : plant().rules.productions) {
      note(rule.predecessor);
      for (const auto& successor : rule.successors) note(successor.modules);
    }
    return most + 1;
  }

  [[nodiscard]] Module inflorescence() { return {"A", {grammar_.add(simeco::Number{static_cast<double>(firstApex_), -1})}, {}}; }

  void bearIn(simeco::Production& rule) {
    for (simeco::Successor& successor : rule.successors) {
      if (flowering_.axillary) bearInAxils(successor.modules);
      if (flowering_.terminal && !has(successor.modules, "A")) successor.modules.push_back(inflorescence());
    }
  }

  /// Behind a leaf's brackets, or the first leaf's of a node for what stands alone there: what leaves the stem on the leaf's side.
  void bearInAxils(std::vector<Module>& modules) {
    const bool everyAxil = flowering_.plan.type == InflorescenceType::Solitary || flowering_.plan.type == InflorescenceType::Fascicle;
    std::vector<Module> result;
    bool borneAtNode = false;
    for (std::size_t i = 0; i < modules.size(); ++i) {
      const std::size_t end = leafEnd(modules, i);
      if (end == i) {
        borneAtNode = borneAtNode && !(modules[i].letter == "S" || modules[i].letter == "A");
        result.push_back(modules[i]);
        continue;
      }
      result.insert(result.end(), modules.begin() + static_cast<std::ptrdiff_t>(i), modules.begin() + static_cast<std::ptrdiff_t>(end));
      if (everyAxil || !borneAtNode)
        for (Module module : {Module{"[", {}, {}}, Module{"rotr", {grammar_.add(simeco::Number{0.6, -1})}, {}}, modules[i + 2], inflorescence(), Module{"]", {}, {}}}) result.push_back(std::move(module));
      borneAtNode = true;
      i = end - 1;
    }
    modules = std::move(result);
  }

  /// Behind "[rotr(..)rotu(..)S(1)L(2)]" that begins at `i`; `i` where none does.
  [[nodiscard]] static std::size_t leafEnd(const std::vector<Module>& modules, std::size_t i) {
    if (i + 4 >= modules.size() || modules[i].letter != "[" || modules[i + 1].letter != "rotr" || modules[i + 2].letter != "rotu") return i;
    std::size_t at = i + 3;
    while (at < modules.size() && (modules[at].letter == "S" || modules[at].letter == "rotr" || modules[at].letter == "rotu")) ++at;
    const bool leaf = at + 1 < modules.size() && modules[at].letter == "L" && modules[at + 1].letter == "]";
    return leaf ? at + 2 : i;
  }

  /// Apices that have made all their segments, of grammars whose axes do not end of themselves.
  void addLastRules(const std::vector<std::size_t>& growing) {
    std::set<int> done;
    for (const std::size_t i : growing) {
      const simeco::Production rule = plant().rules.productions[i];
      const Module& apex = rule.predecessor.front();
      const auto number = numberOf(apex);
      const auto& grows = rule.successors;
      const bool goesOn = std::any_of(grows.begin(), grows.end(), [&](const simeco::Successor& s) {
        return std::any_of(s.modules.begin(), s.modules.end(), [&](const Module& m) { return m.letter == "A" && numberOf(m) == number; });
      });
      if (!number || !goesOn || endsItself(growing, *number) || !done.insert(*number).second) continue;
      simeco::Production last;
      last.predecessor = {apex};
      last.successors.push_back({{inflorescence()}, std::nullopt});
      if (done.size() == 1) last.comments.before = {"// Axes that have made their segments flower."};
      plant().rules.productions.push_back(std::move(last));
    }
  }

  /// Whether some rule makes a last segment of that axis.
  [[nodiscard]] bool endsItself(const std::vector<std::size_t>& growing, int number) {
    return std::any_of(growing.begin(), growing.end(), [&](std::size_t i) {
      const simeco::Production& rule = plant().rules.productions[i];
      const bool same = numberOf(rule.predecessor.front()) == number;
      return same && std::all_of(rule.successors.begin(), rule.successors.end(), [&](const simeco::Successor& s) {
        return std::none_of(s.modules.begin(), s.modules.end(), [&](const Module& m) { return m.letter == "A" && numberOf(m) == number; });
      });
    });
  }

  Result<void> addInflorescence() {
    flowering_.plan.stepTime = stepTime();
    flowering_.plan.fruit.bloom = inflorescenceText(flowering_.plan, firstApex_, 1).steps + 2;
    const int firstStage = std::max(nextFree(OrganKind::Stem), nextFree(OrganKind::Leaf));
    const auto guest = inflorescenceGrammar(flowering_.plan, firstApex_, firstStage);
    if (!guest) return guest.failure();
    receive(*guest);
    return {};
  }

  void receive(const Grammar& grown) {
    const Guest guest(grammar_, grown);
    const simeco::PlantGrammar& from = grown.plants.front();
    for (const simeco::OrganBlock& block : from.organs)
      for (const simeco::Stage& stage : block.stages) blockOf(block.kind).stages.push_back(guest.stage(stage));
    for (const simeco::Production& rule : from.rules.productions) plant().rules.productions.push_back(guest.production(rule));
    if (from.rules.decomposition) {
      simeco::SubRules within = *from.rules.decomposition;
      for (simeco::Production& rule : within.productions) rule = guest.production(std::move(rule));
      plant().rules.decomposition = std::move(within);
    }
    std::vector<std::string>& heading = grammar_.comments.before;
    for (const std::string& line : flowering_.notes) heading.push_back("// From the description, not measured: " + line);
  }

  simeco::OrganBlock& blockOf(OrganKind kind) {
    for (simeco::OrganBlock& block : plant().organs)
      if (block.kind == kind) return block;
    plant().organs.push_back({kind, {}, {}, {}, {}});
    return plant().organs.back();
  }

  /// The time of one derivation step.
  [[nodiscard]] double stepTime() {
    for (const simeco::Attribute& attribute : plant().attributes)
      if (attribute.name == "DeriveTime")
        if (const auto* number = std::get_if<simeco::Number>(&grammar_.at(attribute.value).node)) return number->value;
    return 1;
  }

  Grammar grammar_;
  Flowering flowering_;
  int firstApex_ = 0;
};

/// From metres to the grammar's unit.
InflorescencePlan inUnits(InflorescencePlan plan, double metresPerUnit) {
  for (double* length : {&plan.length, &plan.flowerLength, &plan.flowerWidth, &plan.fruit.length, &plan.fruit.width}) *length /= metresPerUnit;
  plan.metre = 1 / metresPerUnit;
  return plan;
}

}  // namespace

FloweringScale floweringScaleOf(const quantify::Measurements& measurements, double metresPerUnit) {
  std::vector<double> ends(measurements.segments.size(), 0);
  double top = 0, leaf = 0;
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const quantify::Segment& segment = measurements.segments[i];
    ends[i] = (segment.parent ? ends[static_cast<std::size_t>(segment.parent->value)] : 0) + segment.length;
    top = std::max(top, ends[i]);
    leaves += segment.leaves.size();
    for (const quantify::LeafMeasure& measured : segment.leaves) leaf += measured.length;
  }
  return {(leaves > 0 ? leaf / static_cast<double>(leaves) : 0.08 * top) * metresPerUnit, top * metresPerUnit, metresPerUnit};
}

std::optional<Flowering> floweringOf(const Traits& traits, const Presets& presets, const FloweringScale& scale) {
  const keywords::FlowerPreset& flower = presets.flower;
  const auto colours = keywords::flowerColours(traits);
  const std::string model = keywords::flowerModelOf(traits, presets);
  if (model.empty() && colours.empty() && flower.inflorescence.empty() && !flower.diameter_m) return std::nullopt;
  Flowering flowering;
  InflorescencePlan& plan = flowering.plan;
  plan.flowerModel = model.empty() ? "defaultflower" : model;
  plan.colours = colours;
  plan.type = inflorescenceNamed(flower.inflorescence).value_or(InflorescenceType::Solitary);
  setFlowerSize(plan, flower, scale.leaf_m);
  if (flower.flowersPerInflorescence) plan.flowers = std::clamp(static_cast<int>(std::lround(flower.flowersPerInflorescence->middle())), 1, 120);
  plan.length = flower.inflorescenceLength_m ? std::clamp(flower.inflorescenceLength_m->middle(), 0.0, 0.6 * std::max(scale.height_m, scale.leaf_m * 2)) : 0;
  flowering.axillary = flower.position == "axillary" || saysPosition(traits, "axillary");
  flowering.terminal = flower.position == "terminal" || saysPosition(traits, "terminal") || !flowering.axillary;
  setFruit(flowering, traits, presets);
  flowering.notes.push_back(noteOf(flowering, presets));
  return flowering;
}

Result<Grammar> withFlowers(Grammar grammar, const Traits& traits, const FloweringScale& scale) {
  auto flowering = floweringOf(traits, keywords::presetsOf(traits), scale);
  if (!flowering) return grammar;
  flowering->plan = inUnits(std::move(flowering->plan), scale.metresPerUnit);
  return Bearer(std::move(grammar), *std::move(flowering)).flowering();
}

}  // namespace axil::emit
