#include "emit/turtle_program.hpp"

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "base/turning.hpp"
#include "emit/turtle_statements.hpp"
#include "emit/turtle_syntax.hpp"
#include "simeco/derive.hpp"
#include "simeco/growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using simeco::Attribute;
using simeco::ExprId;
using simeco::Grammar;
using simeco::Module;
using simeco::OrganKind;
using simeco::Production;
using simeco::Stage;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kParallel = 1e-9;  // sines of turns below this turn no branch's r-axis

std::string command(const std::string& letter, const std::string& argument) { return letter + "(" + argument + ")"; }

/// F is the turtle's own letter, so a fruit gets another.
std::string letterFor(const std::string& letter) { return letter == "F" ? "K" : letter; }

const Attribute* attributeIn(const std::vector<Attribute>& attributes, std::string_view name) {
  const auto found = std::find_if(attributes.rbegin(), attributes.rend(), [&](const Attribute& a) { return a.name == name; });
  return found == attributes.rend() ? nullptr : &*found;
}

/// A stage with the block that it stands in.
struct Body {
  OrganKind kind{};
  const Stage* stage = nullptr;
  const simeco::OrganBlock* block = nullptr;

  [[nodiscard]] const Attribute* attribute(std::string_view name) const {
    const Attribute* own = attributeIn(stage->attributes, name);
    return own != nullptr ? own : attributeIn(block->attributes, name);
  }
};

/// One rule's pieces, ready to be laid out by either language.
struct RuleText {
  std::vector<std::string> left, predecessor, right;   ///< modules with their formal names
  std::vector<std::string> conditions;
  std::vector<std::pair<std::string, std::string>> demands;  ///< name, value
};

class ProgramWriter {
 public:
  ProgramWriter(const Grammar& grammar, TurtleLanguage language)
      : grammar_(grammar), plant_(grammar.plants.front()), rules_(plant_.rules), language_(language), writer_(grammar, language), statements_(rules_, writer_) {
    for (const simeco::OrganBlock& block : plant_.organs)
      for (const Stage& stage : block.stages) bodies_[{simeco::letterOf(block.kind), stage.number}] = {block.kind, &stage, &block};
    stochastic_ = std::any_of(rules_.productions.begin(), rules_.productions.end(), [](const Production& p) { return p.successors.size() > 1; });
    findUnsayable();
    indexRules();
  }

  Result<std::string> cpfg(std::int64_t steps) {
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

  Result<std::string> lpy(std::int64_t steps, std::uint64_t seed) {
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

 private:
  Result<std::string> finished(std::string text) {
    std::vector<std::string> troubles = std::move(troubles_);
    troubles.insert(troubles.end(), writer_.troubles().begin(), writer_.troubles().end());
    if (troubles.empty()) return text;
    return fail(Error{ErrorCode::BadInput, "this grammar cannot be said in " + std::string(language_ == TurtleLanguage::Cpfg ? "cpfg's language" : "L-Py") + ": " +
                                               troubles.front() + "; write it as simeco, or the grown plant as mtg",
                      std::move(troubles)});
  }

  // ---- what cannot be said ----

  void findUnsayable() {
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

  // ---- names of the environment ----

  std::vector<std::pair<std::string, std::string>> environment() {
    std::set<std::string> used;
    for (const simeco::Expr& expr : grammar_.expressions)
      if (const auto* name = std::get_if<simeco::Name>(&expr.node)) used.insert(name->name);
    std::vector<std::pair<std::string, std::string>> known;
    for (const std::vector<Attribute>* attributes : {&grammar_.attributes, &plant_.attributes})
      for (const Attribute& a : *attributes)
        if (used.contains(a.name)) known.emplace_back(a.name, writer_.text(a.value));
    return known;
  }
  bool isRandom() const {
    return stochastic_ || std::any_of(grammar_.expressions.begin(), grammar_.expressions.end(), [](const simeco::Expr& expr) {
             const auto* call = std::get_if<simeco::Call>(&expr.node);
             return call != nullptr && (call->function == "random" || call->function == "normal");
           });
  }

  // ---- successors ----

  /// What is known of the turtle while a successor is read.
  struct Walk {
    bool branchAhead = false;     ///< behind a bracket, before the first organ
    bool adaxialIsAxis = false;   ///< the organ it stands on shows its upper side along its r-axis: a branch that was turned
    std::vector<ExprId> rotr, rotu;
  };

  struct Angle {
    std::string text;                ///< radians
    std::optional<double> constant;
  };
  Angle sum(const std::vector<ExprId>& parts) {
    Angle all{"", 0.0};
    for (const ExprId part : parts) {
      const auto value = writer_.constant(part);
      all.constant = all.constant && value ? std::optional(*all.constant + *value) : std::nullopt;
      const std::string own = writer_.text(part);
      all.text = all.text.empty() ? own : "(" + all.text + " + " + own + ")";
    }
    return all;
  }
  static std::string degrees(const Angle& angle, double sign) {
    return angle.constant ? turtleNumber(*angle.constant * kDegrees * sign) : angle.text + "*" + turtleNumber(kDegrees * sign);
  }
  /// Positive about the heading, which is `/` in L-Py and the other way round in the classic language.
  [[nodiscard]] double rollSign() const { return language_ == TurtleLanguage::LPy ? 1 : -1; }
  [[nodiscard]] std::string roll(const Angle& angle) const { return angle.constant == 0.0 ? "" : command("/", degrees(angle, rollSign())); }
  static std::string pitch(const Angle& angle) { return angle.constant == 0.0 ? "" : command("^", degrees(angle, 1)); }

  static bool isStraight(const Angle& rotr) { return rotr.constant && std::abs(std::sin(*rotr.constant)) < kParallel; }
  /// A branch's quarter turn, by `rotr`'s sign.
  std::string branchRoll(const Angle& rotr) const {
    if (rotr.constant) return isStraight(rotr) ? "" : command("/", turtleNumber(std::copysign(90, rollSign() * std::sin(*rotr.constant))));
    const std::string sine = language_ == TurtleLanguage::Cpfg ? "sin(" + rotr.text + "*" + turtleNumber(kDegrees) + ")" : "sin(" + rotr.text + ")";
    const std::string straight = (language_ == TurtleLanguage::Cpfg ? "fabs(" : "abs(") + sine + ") < " + turtleNumber(kParallel);
    return command("/", language_ == TurtleLanguage::Cpfg ? "(" + straight + " ? 0 : -90*sign(" + sine + "))" : "(0 if " + straight + " else 90*sign(" + sine + "))");
  }

  std::string turn(Walk& walk, bool toLeaf) {
    Angle rotr = sum(walk.rotr);
    const Angle rotu = sum(walk.rotu);
    walk.rotr.clear();
    walk.rotu.clear();
    const bool isName = rotr.text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    if (!rotr.constant && walk.branchAhead && !toLeaf && !isName) rotr.text = writer_.named(rotr.text);
    std::string text = roll(rotu) + pitch(rotr);
    if (toLeaf) {
      // The blade lies across its upper side: in the turtle's plane of turning once the leaf has bent away; else as its bearer's upper side.
      if (isStraight(rotr) && walk.adaxialIsAxis) text += command("/", turtleNumber(-90 * rollSign()));
      return text;
    }
    if (walk.branchAhead) text += branchRoll(rotr);
    walk.adaxialIsAxis = walk.branchAhead ? !isStraight(rotr) : walk.adaxialIsAxis && isStraight(rotr);
    return text;
  }

  static std::optional<double> literal(const Grammar& g, const Module& m) {
    if (m.arguments.empty()) return {};
    const auto* number = std::get_if<simeco::Number>(&g.at(m.arguments[0]).node);
    return number == nullptr ? std::nullopt : std::optional(number->value);
  }
  /// Modules that rules ask for, by letter, number of arguments and first number; so that thousands of rules are looked through once.
  struct Patterns {
    std::map<std::pair<std::string, std::size_t>, std::set<double>> numbers;
    std::set<std::pair<std::string, std::size_t>> anyNumber;

    void add(const Module& m, const ProgramWriter& writer) {
      const std::pair key{m.letter, m.arguments.size()};
      const auto number = literal(writer.grammar_, m);
      if (number) numbers[key].insert(*number);
      else anyNumber.insert(key);
    }
    bool mayHold(const Module& made, const ProgramWriter& writer) const {
      const std::pair key{made.letter, made.arguments.size()};
      if (anyNumber.contains(key)) return true;
      const auto found = numbers.find(key);
      if (found == numbers.end()) return false;
      const auto number = made.arguments.empty() ? std::nullopt : writer.writer_.constant(made.arguments[0]);
      return !number || found->second.contains(*number);
    }
  };
  bool isUsed(const Module& made) const { return asked_.mayHold(made, *this); }
  /// Whether some rule turns `made` into something that begins with a turn.
  bool beginsTurning(const Module& made) const { return turning_.mayHold(made, *this); }

  static bool beginsWithTurn(const simeco::Successor& s) {
    int depth = 0;
    for (const Module& m : s.modules) {
      if (m.letter == "[") ++depth;
      else if (m.letter == "]") --depth;
      else if (depth == 0) return m.letter == "rotr" || m.letter == "rotu";
    }
    return false;
  }
  void indexRules() {
    for (std::size_t i = 0; i < rules_.productions.size(); ++i) {
      const Production& p = rules_.productions[i];
      for (const std::vector<Module>* side : {&p.left, &p.predecessor, &p.right})
        for (const Module& m : *side) asked_.add(m, *this);
      if (!p.predecessor.empty() && std::any_of(p.successors.begin(), p.successors.end(), beginsWithTurn)) turning_.add(p.predecessor.front(), *this);
    }
  }

  const Body* bodyOf(const Module& m) const {
    const auto number = m.arguments.empty() ? std::nullopt : writer_.constant(m.arguments[0]);
    if (!number) return nullptr;
    const auto found = bodies_.find({m.letter, static_cast<int>(*number)});
    return found == bodies_.end() ? nullptr : &found->second;
  }

  /// rate x time of a body, as a number where it is one.
  Angle product(const Body& body, const char* rate, const char* time, double factor, const Meanings& meanings) {
    const Attribute* r = body.attribute(rate);
    if (r == nullptr) return {"0", 0.0};
    const Attribute* t = body.attribute(time);
    if (t == nullptr) t = body.attribute("GrowTime");
    const auto rateValue = writer_.constant(r->value);
    const auto timeValue = t == nullptr ? std::optional(1.0) : writer_.constant(t->value);
    if (rateValue && timeValue) return {"", *rateValue * *timeValue * factor};
    std::string text = writer_.text(r->value, meanings);
    if (!timeValue) text += "*" + writer_.text(t->value, meanings);
    const double rest = factor * timeValue.value_or(1);
    if (rest != 1) text += "*" + turtleNumber(rest);
    return {text, std::nullopt};
  }
  static std::string numberOf(const Angle& value) { return value.constant ? turtleNumber(*value.constant) : value.text; }

  std::string width(const Body& body, const Meanings& meanings) {
    if (body.attribute("BroadenRate") == nullptr) return {};
    const double factor = simeco::modelRadius * (language_ == TurtleLanguage::Cpfg ? 2 : 1);
    return command(language_ == TurtleLanguage::Cpfg ? "!" : "_", numberOf(product(body, "BroadenRate", "BroadenTime", factor, meanings)));
  }
  /// A blade as a filled diamond: two sides from the base to the widest place, two on to the tip.
  std::string blade(const Body& body, const Meanings& meanings) {
    const Angle length = product(body, "GrowRate", "GrowTime", 1, meanings);
    Angle half = product(body, "BroadenRate", "BroadenTime", simeco::modelRadius, meanings);
    if (half.constant == 0.0) half = length.constant ? Angle{"", *length.constant / 4} : Angle{length.text + "/4", std::nullopt};
    // A turtle notes the corner where it starts only when it is told to.
    const std::string start = language_ == TurtleLanguage::Cpfg ? ";(2){." : ",(2){.";
    if (length.constant && half.constant) {
      const double side = std::hypot(*length.constant / 2, *half.constant);
      const double angle = std::atan2(*half.constant, *length.constant / 2) * kDegrees;
      const std::string edge = command("f", turtleNumber(side));
      return start + command("+", turtleNumber(angle)) + edge + command("-", turtleNumber(2 * angle)) + edge + command("-", turtleNumber(180 - 2 * angle)) + edge + "}";
    }
    const std::string l = writer_.named(numberOf(length));
    const std::string h = writer_.named(numberOf(half));
    const std::string side = writer_.named("sqrt(" + l + "*" + l + "/4 + " + h + "*" + h + ")");
    // acos of a ratio of lengths, since one of the languages has no atan2 that can be called.
    const std::string angle = writer_.named(language_ == TurtleLanguage::Cpfg ? "acos(" + l + "/(2*" + side + "))"
                                                                             : "acos(" + l + "/(2*" + side + "))*" + turtleNumber(kDegrees));
    const std::string edge = command("f", side);
    return start + command("+", angle) + edge + command("-", "2*" + angle) + edge + command("-", "180 - 2*" + angle) + edge + "}";
  }

  std::string organ(const Module& m, Walk& walk) {
    const bool leaf = m.letter == "L";
    const Body* body = bodyOf(m);
    const bool turned = !walk.rotr.empty() || !walk.rotu.empty();
    if (body == nullptr && (turned || walk.branchAhead) && beginsTurning(m)) troubles_.push_back("a turn before " + m.letter + " goes on in the rule of that module");
    if (body == nullptr && !m.arguments.empty() && !writer_.constant(m.arguments[0]) && hasBodies(m.letter) && !isCounter(m))
      troubles_.push_back("the stage of a module " + m.letter + " is computed");
    std::string text = turned || (leaf && body != nullptr) ? turn(walk, leaf && body != nullptr) : "";
    std::vector<std::string> arguments;
    for (const ExprId argument : m.arguments) arguments.push_back(writer_.text(argument));
    if (body != nullptr) {
      Meanings meanings;
      for (std::size_t i = 0; i < body->stage->parameters.size() && i + 1 < arguments.size(); ++i) meanings[body->stage->parameters[i]] = arguments[i + 1];
      text += leaf ? blade(*body, meanings) : width(*body, meanings) + command("F", numberOf(product(*body, "GrowRate", "GrowTime", 1, meanings)));
      walk.branchAhead = false;
    }
    if (body != nullptr && !isUsed(m)) return text;
    text += letterFor(m.letter);
    for (std::size_t i = 0; i < arguments.size(); ++i) text += (i == 0 ? "(" : ",") + arguments[i];
    return arguments.empty() ? text : text + ")";
  }
  bool hasBodies(const std::string& letter) const {
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& entry) { return entry.first.first == letter; });
  }
  /// S(i+1) of a rule that counts far above all stages.
  bool isCounter(const Module& m) const { return std::get_if<simeco::Binary>(&grammar_.at(m.arguments[0]).node) != nullptr; }

  std::string modules(const std::vector<Module>& list) {
    std::string text;
    std::vector<Walk> outer;
    Walk walk;
    for (const Module& m : list) {
      if (m.letter == "[") {
        if (!walk.rotr.empty() || !walk.rotu.empty()) troubles_.emplace_back("a turn stands before a bracket");
        outer.push_back(walk);
        walk.branchAhead = true;
        text += "[";
      } else if (m.letter == "]") {
        if (!outer.empty()) walk = std::move(outer.back()), outer.pop_back();
        text += "]";
      } else if (m.letter == "rotr") {
        walk.rotr.push_back(m.arguments.at(0));
      } else if (m.letter == "rotu") {
        walk.rotu.push_back(m.arguments.at(0));
      } else if (simeco::organOfLetter(m.letter)) {
        text += organ(m, walk);
      } else {
        if (m.letter != "%") troubles_.push_back("it has the module " + m.letter);
        text += m.letter;
      }
    }
    return text;
  }

  /// From the turtle's own start (heading up, r-axis X) to the plant's place and frame.
  std::string axiom() {
    std::string text;
    const auto vector = [&](const char* name, glm::dvec3 otherwise) {
      const Attribute* attribute = attributeIn(plant_.attributes, name);
      const auto* call = attribute == nullptr ? nullptr : std::get_if<simeco::Call>(&grammar_.at(attribute->value).node);
      if (call == nullptr || call->arguments.size() != 3) return otherwise;
      for (int k = 0; k < 3; ++k) otherwise[k] = writer_.constant(call->arguments[static_cast<std::size_t>(k)]).value_or(0);
      return otherwise;
    };
    const glm::dvec3 at = vector("Position", {0, 0, 0});
    const bool python = language_ == TurtleLanguage::LPy;
    if (at != glm::dvec3{0, 0, 0}) {
      const std::array<double, 3> place = python ? std::array{at.z, at.x, at.y} : std::array{at.x, at.y, at.z};
      text += "@M(" + turtleNumber(place[0]) + "," + turtleNumber(place[1]) + "," + turtleNumber(place[2]) + ")";
    }
    const StemFrame upright = firstFrame(PlantDirection::up());
    const StemFrame frame = firstFrame(PlantDirection::along(vector("Direction", {0, 1, 0})));
    const Turn turn = measuredTurn(upright, frame.direction);
    const double rest = signedAngleAbout(frame.direction, turned(upright.rAxis, upright.direction, turn.rotu), frame.rAxis).radians();
    text += roll({"", turn.rotu.radians()}) + pitch({"", turn.rotr.radians()});
    if (std::abs(rest) > kParallel) text += roll({"", rest});
    text += modules(rules_.axiom);
    axiomDraws_ = writer_.takeDraws();
    return text;
  }

  // ---- rules ----

  std::string formal(const Module& m, std::vector<std::pair<std::string, std::string>>& demands, int& unnamed) const {
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
  RuleText ruleText(const Production& p) {
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
  static std::string joined(const std::vector<std::string>& parts, const char* between) {
    std::string all;
    for (const std::string& part : parts) all += (all.empty() ? "" : between) + part;
    return all;
  }

  /// With a seed the classic language draws among all rules that fit, so that rules above must be ruled out by the condition.
  std::string earlierRules(std::size_t p) {
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
  bool disjoint(const Module& a, const Module& b) const {
    for (std::size_t i = 0; i < a.arguments.size(); ++i) {
      const auto* x = std::get_if<simeco::Number>(&grammar_.at(a.arguments[i]).node);
      const auto* y = std::get_if<simeco::Number>(&grammar_.at(b.arguments[i]).node);
      if (x != nullptr && y != nullptr && x->value != y->value) return true;
    }
    return false;
  }
  std::vector<std::string> namesOf(const Module& m) const {
    std::vector<std::string> names;
    int unnamed = 0;
    for (const ExprId argument : m.arguments) {
      const auto* name = std::get_if<simeco::Name>(&grammar_.at(argument).node);
      names.push_back(name != nullptr ? name->name : "k" + std::to_string(++unnamed));
    }
    return names;
  }

  std::string cpfgRule(std::size_t number) {
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

  /// Rules of one shape that follow each other share one header: the first branch that fits produces.
  std::string pythonRule(std::size_t number, std::string& open) {
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
  std::string pythonChoice(const Production& p, const std::string& indent) {
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
  std::string pythonProduce(const simeco::Successor& successor, const std::string& indent) {
    const std::string made = modules(successor.modules);
    std::string text;
    for (const std::string& draw : writer_.takeDraws()) text += indent + draw + "\n";
    return text + indent + "produce " + (made.empty() ? "*" : made) + "\n";
  }

  // ---- heading ----

  std::string heading(const std::string& open, const std::string& close, const std::string& widths) const {
    std::string text;
    for (const std::string& line : grammar_.comments.before)
      if (!line.empty()) text += open + turtleComment(line) + close;
    text += open + "Angles are degrees, " + widths + close;
    text += open + "What this language does not carry over: continuous growth (organs appear fully grown, step by step), organ models, textures and" + close;
    text += open + "colours, and leaf shapes (a leaf is a diamond of its length and width). A blade that runs exactly along its stem may be rolled otherwise." + close;
    if (isRandom()) text += open + "Draws come from this program's own generator: a seed grows another plant of the same family than in SimEco." + close;
    return text;
  }

  const Grammar& grammar_;
  const simeco::PlantGrammar& plant_;
  const simeco::RuleSet& rules_;
  TurtleLanguage language_;
  ExpressionWriter writer_;
  StatementWriter statements_;
  std::map<std::pair<std::string, int>, Body> bodies_;
  bool stochastic_ = false;
  std::vector<std::string> axiomDraws_;
  std::vector<std::string> troubles_;
  Patterns asked_;    ///< by any rule, as predecessor or context
  Patterns turning_;  ///< rewritten into something that begins with a turn
};

}  // namespace

Result<std::int64_t> stepsUntilComplete(const Grammar& grammar) {
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

Result<std::string> cpfgProgram(const Grammar& grammar, std::int64_t steps) { return ProgramWriter(grammar, TurtleLanguage::Cpfg).cpfg(steps); }
Result<std::string> lpyProgram(const Grammar& grammar, std::int64_t steps, std::uint64_t seed) { return ProgramWriter(grammar, TurtleLanguage::LPy).lpy(steps, seed); }

}  // namespace axil::emit
