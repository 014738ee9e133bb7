#include "emit/turtle_program.hpp"

#include "emit/turtle_writer.hpp"

namespace axil::emit {

namespace turtle {

Result<std::string> ProgramWriter::cpfg(std::int64_t steps) {
  std::string text = heading("/* ", " */\n", "widths are diameters; SimEco's fruits F are K.");
  for (const auto& [name, value] : environment()) text += "#define " + name + " " + value + "\n";
  text += "Lsystem: 1\n";
  if (isRandom()) text += "seed: 1\n";
  text += "derivation length: " + std::to_string(steps) + "\n";
  if (rules_.filter.mode != simeco::ContextFilter::Mode::None) {
    text += rules_.filter.mode == simeco::ContextFilter::Mode::Ignore ? "ignore: /^F" : "consider:";
    for (const std::string& letter : rules_.filter.letters)
      if (letter.size() == 1) text += " " + letterFor(letter);
    text += "\n";
  }
  if (!rules_.arrays.empty()) text += statements_.cpfgArrays();
  const std::string start = axiom();  // what it draws stands in the block before it
  text += statements_.cpfgBlock("Start", rules_.start, axiomDraws_) + statements_.cpfgBlock("StartEach", rules_.startEach) + statements_.cpfgBlock("EndEach", rules_.endEach) + statements_.cpfgBlock("End", rules_.end);
  text += "Axiom: " + start + "\n";
  for (std::size_t p = 0; p < rules_.productions.size(); ++p) text += cpfgRule(p);
  return finished(text + "endlsystem\n");
}

Result<std::string> ProgramWriter::lpy(std::int64_t steps, std::uint64_t seed) {
  std::string text = heading("# ", "\n", "widths are radii; SimEco's fruits F are K.") +
                     "# Steps shorter than 1e-5 are not drawn by this program; write such a plant in a smaller unit.\n"
                     "# Plants stand along Z here: the plant's axes (x, y, z) are this program's (y, z, x).\n"
                     "from math import *\nfrom random import seed, uniform, gauss\n\ndef sign(x): return (x > 0) - (x < 0)\n";
  if (isRandom()) text += "seed(" + std::to_string(seed) + ")\n";
  for (const auto& [name, value] : environment()) text += name + " = " + value + "\n";
  for (const simeco::ArrayDeclaration& array : rules_.arrays) text += statements_.pythonArray(array);
  for (const std::string& name : statements_.globals()) text += name + " = 0\n";
  text += statements_.pythonBlock("Start", rules_.start) + statements_.pythonBlock("StartEach", rules_.startEach) + statements_.pythonBlock("EndEach", rules_.endEach) + statements_.pythonBlock("End", rules_.end);
  const std::string start = axiom();
  for (const std::string& draw : axiomDraws_) text += "\n" + draw;
  text += "\nAxiom: " + start + "\n\nderivation length: " + std::to_string(steps) + "\nproduction:\n";
  std::string open;
  for (std::size_t p = 0; p < rules_.productions.size(); ++p) text += pythonRule(p, open);
  return finished(text + "\nendlsystem\n");
}

Result<std::string> ProgramWriter::finished(std::string text) {
  std::vector<std::string> troubles = std::move(troubles_);
  troubles.insert(troubles.end(), writer_.troubles().begin(), writer_.troubles().end());
  if (troubles.empty()) return text;
  return fail(Error{ErrorCode::BadInput, "this grammar cannot be said in " + std::string(language_ == TurtleLanguage::Cpfg ? "cpfg's language" : "L-Py") + ": " +
                                             troubles.front() + "; write it as simeco, or the grown plant as mtg",
                    std::move(troubles)});
}

void ProgramWriter::findUnsayable() {
  if (rules_.decomposition || rules_.homomorphism || !rules_.interaction.empty() || !plant_.subRules.empty())
    troubles_.emplace_back("it has decomposition, homomorphism, interaction or sub-L-systems");
  if (rules_.ring) troubles_.emplace_back("its string is a ring");
  const auto look = [&](const std::vector<Attribute>& attributes) {
    for (const Attribute& a : attributes)
      if (a.name.find("Tropism") != std::string::npos || a.name == "LightResponse") troubles_.push_back("its organs bend or compete (" + a.name + ")");
  };
  look(plant_.attributes);
  for (const simeco::OrganBlock& block : plant_.organs) {
    look(block.attributes);
    for (const Stage& stage : block.stages) look(stage.attributes);
  }
  for (const auto& [name, best] : {std::pair{"SoilPH", 7.0}, std::pair{"RainRate", 0.9}, std::pair{"DayLight", 12.0}}) {
    const Attribute* said = attributeIn(plant_.attributes, name);
    if (said == nullptr) said = attributeIn(grammar_.attributes, name);
    if (said != nullptr && writer_.constant(said->value) != best) troubles_.push_back(std::string("its growth answers to ") + name);
  }
}

std::vector<std::pair<std::string, std::string>> ProgramWriter::environment() {
  std::set<std::string> used;
  for (const simeco::Expr& expr : grammar_.expressions)
    if (const auto* name = std::get_if<simeco::Name>(&expr.node)) used.insert(name->name);
  std::vector<std::pair<std::string, std::string>> known;
  for (const std::vector<Attribute>* attributes : {&grammar_.attributes, &plant_.attributes})
    for (const Attribute& a : *attributes)
      if (used.contains(a.name)) known.emplace_back(a.name, writer_.text(a.value));
  return known;
}

bool ProgramWriter::isRandom() const {
  return stochastic_ || std::any_of(grammar_.expressions.begin(), grammar_.expressions.end(), [](const simeco::Expr& expr) {
           const auto* call = std::get_if<simeco::Call>(&expr.node);
           return call != nullptr && (call->function == "random" || call->function == "normal");
         });
}

std::string ProgramWriter::formal(const Module& m, std::vector<std::pair<std::string, std::string>>& demands, int& unnamed) const {
  std::string text = letterFor(m.letter);
  for (std::size_t i = 0; i < m.arguments.size(); ++i) {
    std::string name;
    if (const auto* own = std::get_if<simeco::Name>(&grammar_.at(m.arguments[i]).node)) name = own->name;
    else {
      name = "k" + std::to_string(++unnamed);
      demands.emplace_back(name, turtleNumber(writer_.constant(m.arguments[i]).value_or(0)));
    }
    text += (i == 0 ? "(" : ",") + name;
  }
  return m.arguments.empty() ? text : text + ")";
}

RuleText ProgramWriter::ruleText(const Production& p) {
  RuleText rule;
  int unnamed = 0;
  for (const Module& m : p.predecessor) rule.predecessor.push_back(formal(m, rule.demands, unnamed));
  for (const Module& m : p.left) rule.left.push_back(formal(m, rule.demands, unnamed));
  for (const Module& m : p.right) rule.right.push_back(formal(m, rule.demands, unnamed));
  for (const auto& [name, value] : rule.demands) rule.conditions.push_back(name + " == " + value);
  if (p.condition) rule.conditions.push_back(writer_.text(*p.condition));
  for (const std::string& draw : writer_.takeDraws()) troubles_.push_back("a condition draws by chance (" + draw + ")");
  return rule;
}

std::string ProgramWriter::joined(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : between) + part;
  return all;
}

std::string ProgramWriter::earlierRules(std::size_t p) {
  if (!stochastic_) return {};
  std::string text;
  const Module& own = rules_.productions[p].predecessor.front();
  for (std::size_t e = 0; e < p; ++e) {
    const Production& earlier = rules_.productions[e];
    if (earlier.predecessor.front().letter != own.letter || earlier.predecessor.front().arguments.size() != own.arguments.size()) continue;
    if (disjoint(earlier.predecessor.front(), own) || !earlier.left.empty() || !earlier.right.empty()) continue;
    // Its conditions in this rule's names.
    Meanings meanings;
    std::vector<std::string> parts;
    const std::vector<std::string> here = namesOf(own);
    for (std::size_t i = 0; i < own.arguments.size(); ++i) {
      const ExprId asked = earlier.predecessor.front().arguments[i];
      if (const auto* name = std::get_if<simeco::Name>(&grammar_.at(asked).node)) meanings[name->name] = here[i];
      else if (std::holds_alternative<simeco::Name>(grammar_.at(own.arguments[i]).node)) parts.push_back(here[i] + " == " + turtleNumber(writer_.constant(asked).value_or(0)));
    }
    if (earlier.condition) parts.push_back(writer_.text(*earlier.condition, meanings));
    text += " && !(" + (parts.empty() ? "1" : joined(parts, " && ")) + ")";
  }
  return text;
}

bool ProgramWriter::disjoint(const Module& a, const Module& b) const {
  for (std::size_t i = 0; i < a.arguments.size(); ++i) {
    const auto* x = std::get_if<simeco::Number>(&grammar_.at(a.arguments[i]).node);
    const auto* y = std::get_if<simeco::Number>(&grammar_.at(b.arguments[i]).node);
    if (x != nullptr && y != nullptr && x->value != y->value) return true;
  }
  return false;
}

std::vector<std::string> ProgramWriter::namesOf(const Module& m) const {
  std::vector<std::string> names;
  int unnamed = 0;
  for (const ExprId argument : m.arguments) {
    const auto* name = std::get_if<simeco::Name>(&grammar_.at(argument).node);
    names.push_back(name != nullptr ? name->name : "k" + std::to_string(++unnamed));
  }
  return names;
}

std::string ProgramWriter::cpfgRule(std::size_t number) {
  const Production& p = rules_.productions[number];
  std::string text;
  for (const std::string& line : p.comments.before)
    if (!line.empty()) text += "/* " + turtleComment(line) + " */\n";
  const RuleText rule = ruleText(p);
  const std::string condition = joined(rule.conditions, " && ");
  const std::string others = earlierRules(number);
  for (const simeco::Successor& successor : p.successors) {
    const std::string made = modules(successor.modules);
    const std::vector<std::string> draws = writer_.takeDraws();
    std::string line;
    if (!rule.left.empty()) line += joined(rule.left, "") + " < ";
    line += joined(rule.predecessor, "");
    if (!rule.right.empty()) line += " > " + joined(rule.right, "");
    const bool blocks = !p.before.empty() || !p.after.empty() || !draws.empty();
    const std::string fires = condition.empty() && !others.empty() ? others.substr(4) : condition + others;
    if (blocks || !fires.empty()) line += " : ";
    if (!p.before.empty()) line += "{" + statements_.cpfgStatements(p.before) + "} ";
    if (blocks || !fires.empty()) line += fires.empty() ? "*" : fires;
    if (!p.after.empty() || !draws.empty()) line += " {" + statements_.cpfgStatements(p.after) + statements_.cpfgStatements({}, draws) + "}";
    line += " --> " + (made.empty() ? "*" : made);
    if (successor.weight) line += " : " + writer_.text(*successor.weight);
    text += line + "\n";
  }
  return text;
}

std::string ProgramWriter::pythonRule(std::size_t number, std::string& open) {
  const Production& p = rules_.productions[number];
  const RuleText rule = ruleText(p);
  std::string header;
  if (!rule.left.empty()) header += joined(rule.left, "") + " < ";
  header += joined(rule.predecessor, "");
  if (!rule.right.empty()) header += " > " + joined(rule.right, "");
  std::string text;
  if (header != open) text += "\n" + header + " :\n" + statements_.globalLine("  ");
  open = header;
  for (const std::string& line : p.comments.before)
    if (!line.empty()) text += "  # " + turtleComment(line) + "\n";
  // The statements before the condition run once a module's numbers fit.
  std::string indent = "  ";
  std::vector<std::string> conditions = rule.conditions;
  if (!p.before.empty()) {
    std::vector<std::string> demands;
    for (const auto& [name, value] : rule.demands) demands.push_back(name + " == " + value);
    if (!demands.empty()) text += indent + "if " + joined(demands, " and ") + " :\n", indent += "  ";
    text += statements_.pythonStatements(p.before, indent);
    conditions.erase(conditions.begin(), conditions.begin() + static_cast<std::ptrdiff_t>(demands.size()));
  }
  if (!conditions.empty()) text += indent + "if " + joined(conditions, " and ") + " :\n", indent += "  ";
  text += statements_.pythonStatements(p.after, indent);
  return text + pythonChoice(p, indent);
}

std::string ProgramWriter::pythonChoice(const Production& p, const std::string& indent) {
  if (p.successors.size() == 1) return pythonProduce(p.successors.front(), indent);
  std::string sum;
  std::vector<std::string> weights;
  for (const simeco::Successor& s : p.successors) weights.push_back(s.weight ? writer_.text(*s.weight) : "1");
  std::string text = indent + "share = uniform(0, " + joined(weights, " + ") + ")\n";
  for (std::size_t s = 0; s < p.successors.size(); ++s) {
    sum += (s == 0 ? "" : " + ") + weights[s];
    text += indent + (s == 0 ? "if share < " + sum + " :\n" : s + 1 < p.successors.size() ? "elif share < " + sum + " :\n" : "else :\n");
    text += pythonProduce(p.successors[s], indent + "  ");
  }
  return text;
}

std::string ProgramWriter::pythonProduce(const simeco::Successor& successor, const std::string& indent) {
  const std::string made = modules(successor.modules);
  std::string text;
  for (const std::string& draw : writer_.takeDraws()) text += indent + draw + "\n";
  return text + indent + "produce " + (made.empty() ? "*" : made) + "\n";
}

std::string ProgramWriter::heading(const std::string& open, const std::string& close, const std::string& widths) const {
  std::string text;
  for (const std::string& line : grammar_.comments.before)
    if (!line.empty()) text += open + turtleComment(line) + close;
  text += open + "Angles are degrees, " + widths + close;
  text += open + "What this language does not carry over: continuous growth (organs appear fully grown, step by step), organ models, textures and" + close;
  text += open + "colours, and leaf shapes (a leaf is a diamond of its length and width). A blade that runs exactly along its stem may be rolled otherwise." + close;
  if (isRandom()) text += open + "Draws come from this program's own generator: a seed grows another plant of the same family than in SimEco." + close;
  return text;
}

}  // namespace turtle

Result<std::int64_t> stepsUntilComplete(const simeco::Grammar& grammar) {
  const auto& stated = grammar.plants.front().rules.derivationLength;
  std::int64_t most = 0;
  constexpr std::uint64_t kSeeds = 8;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    simeco::DeriveOptions options;
    options.seed = seed;
    const auto derived = simeco::derive(grammar, options);
    if (!derived) return derived.failure();
    const auto steps = static_cast<std::int64_t>(derived->modulesPerStep.size());
    if (stated || (seed > 1 && steps == most && seed == 2)) return std::max(most, steps);
    most = std::max(most, steps);
  }
  return 2 * most;  // other seeds may grow longer; where nothing changes any more, further steps cost nothing
}

Result<std::string> cpfgProgram(const simeco::Grammar& grammar, std::int64_t steps) { return turtle::ProgramWriter(grammar, TurtleLanguage::Cpfg).cpfg(steps); }
Result<std::string> lpyProgram(const simeco::Grammar& grammar, std::int64_t steps, std::uint64_t seed) { return turtle::ProgramWriter(grammar, TurtleLanguage::LPy).lpy(steps, seed); }

}  // namespace axil::emit
