#pragma once
/// \file
/// Writes a grammar as a program of a turtle language (turtle_program.hpp). Private to this room: turtle_program.cpp has the frames of both languages and their rules, turtle_organs.cpp
/// what successors draw.

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

namespace axil::emit::turtle {

using simeco::Attribute;
using simeco::ExprId;
using simeco::Grammar;
using simeco::Module;
using simeco::OrganKind;
using simeco::Production;
using simeco::Stage;

inline constexpr double kDegrees = 180 / std::numbers::pi;
inline constexpr double kParallel = 1e-9;  // sines of turns below this turn no branch's r-axis

inline std::string command(const std::string& letter, const std::string& argument) { return letter + "(" + argument + ")"; }

/// F is the turtle's own letter, so a fruit gets another.
inline std::string letterFor(const std::string& letter) { return letter == "F" ? "K" : letter; }

inline const Attribute* attributeIn(const std::vector<Attribute>& attributes, std::string_view name) {
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

  Result<std::string> cpfg(std::int64_t steps);

  Result<std::string> lpy(std::int64_t steps, std::uint64_t seed);

 private:
  Result<std::string> finished(std::string text);

  // ---- what cannot be said ----

  void findUnsayable();

  // ---- names of the environment ----

  std::vector<std::pair<std::string, std::string>> environment();
  bool isRandom() const;

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
  Angle sum(const std::vector<ExprId>& parts);
  static std::string degrees(const Angle& angle, double sign);
  /// Positive about the heading, which is `/` in L-Py and the other way round in the classic language.
  [[nodiscard]] double rollSign() const { return language_ == TurtleLanguage::LPy ? 1 : -1; }
  [[nodiscard]] std::string roll(const Angle& angle) const { return angle.constant == 0.0 ? "" : command("/", degrees(angle, rollSign())); }
  static std::string pitch(const Angle& angle) { return angle.constant == 0.0 ? "" : command("^", degrees(angle, 1)); }

  static bool isStraight(const Angle& rotr) { return rotr.constant && std::abs(std::sin(*rotr.constant)) < kParallel; }
  /// A branch's quarter turn, by `rotr`'s sign.
  std::string branchRoll(const Angle& rotr) const;

  std::string turn(Walk& walk, bool toLeaf);

  static std::optional<double> literal(const Grammar& g, const Module& m);
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

  static bool beginsWithTurn(const simeco::Successor& s);
  void indexRules();

  const Body* bodyOf(const Module& m) const;

  /// rate x time of a body, as a number where it is one.
  Angle product(const Body& body, const char* rate, const char* time, double factor, const Meanings& meanings);
  static std::string numberOf(const Angle& value) { return value.constant ? turtleNumber(*value.constant) : value.text; }

  std::string width(const Body& body, const Meanings& meanings);
  /// A blade as a filled diamond: two sides from the base to the widest place, two on to the tip.
  std::string blade(const Body& body, const Meanings& meanings);

  std::string organ(const Module& m, Walk& walk);
  bool hasBodies(const std::string& letter) const;
  /// S(i+1) of a rule that counts far above all stages.
  bool isCounter(const Module& m) const { return std::get_if<simeco::Binary>(&grammar_.at(m.arguments[0]).node) != nullptr; }

  std::string modules(const std::vector<Module>& list);

  /// From the turtle's own start (heading up, r-axis X) to the plant's place and frame.
  std::string axiom();

  // ---- rules ----

  std::string formal(const Module& m, std::vector<std::pair<std::string, std::string>>& demands, int& unnamed) const;
  RuleText ruleText(const Production& p);
  static std::string joined(const std::vector<std::string>& parts, const char* between);

  /// With a seed the classic language draws among all rules that fit, so that rules above must be ruled out by the condition.
  std::string earlierRules(std::size_t p);
  bool disjoint(const Module& a, const Module& b) const;
  std::vector<std::string> namesOf(const Module& m) const;

  std::string cpfgRule(std::size_t number);

  /// Rules of one shape that follow each other share one header: the first branch that fits produces.
  std::string pythonRule(std::size_t number, std::string& open);
  std::string pythonChoice(const Production& p, const std::string& indent);
  std::string pythonProduce(const simeco::Successor& successor, const std::string& indent);

  // ---- heading ----

  std::string heading(const std::string& open, const std::string& close, const std::string& widths) const;

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

}  // namespace axil::emit::turtle
