#pragma once
/// \file
/// The layers of the SimEco checks, third: modules, and what the rules of a plant do with each. Internal to `check`.

#include "base/angle.hpp"
#include "simeco/check_attributes.hpp"
#include "simeco/language.hpp"

#include <map>
#include <unordered_map>

namespace axil::simeco::checking {

// More general rules of one letter than these are not compared with every module: the work must stay linear in the text.
inline constexpr std::size_t kMostGeneralRules = 64;

/// What the rules of one plant do with one letter.
struct LetterUse {
  std::unordered_set<double> made;         ///< numbers that an axiom or successor writes
  bool madeByValue = false;                ///< ... and that it computes, so that any may come
  std::unordered_set<double> asked;        ///< numbers that a predecessor or context names
  bool askedInContext = false;             ///< a context takes any number
  std::vector<const Production*> general;  ///< rules whose predecessor takes any number
};

class ModuleCheck : protected AttributeCheck {
 protected:
  explicit ModuleCheck(const Grammar& grammar) : AttributeCheck(grammar) {
    for (const LetterWord& word : letterWords()) letterNames_.push_back(word.letter);
  }

  void gatherStages(const PlantGrammar& p) {
    stages_.clear();
    stageArguments_.clear();
    for (const OrganBlock& o : p.organs)
      for (const Stage& s : o.stages) {
        stages_[letterOf(o.kind)].insert(s.number);
        stageArguments_[{letterOf(o.kind), s.number}] = s.parameters.size();
      }
    uses_.clear();
    gatherUses(p.rules);
    for (const RuleSet& further : p.subRules) gatherUses(further);
  }

  // ---- what the rules do with each letter ----

  void gatherUses(const RuleSet& rules) {
    for (const Module& m : rules.axiom) gatherMade(m);
    gatherUses(rules.productions);
    if (rules.decomposition) gatherUses(rules.decomposition->productions);
    if (rules.homomorphism) gatherUses(rules.homomorphism->productions);
    gatherUses(rules.interaction);
  }
  void gatherUses(const std::vector<Production>& productions) {
    for (const Production& p : productions) {
      for (const Module& m : p.left) gatherContext(m);
      for (const Module& m : p.right) gatherContext(m);
      for (const Module& m : p.predecessor) {
        if (m.arguments.empty()) continue;
        LetterUse& use = uses_[m.letter];
        if (const Number* number = numberIn(grammar_, m.arguments[0]))
          use.asked.insert(number->value);
        else
          use.general.push_back(&p);
      }
      for (const Successor& s : p.successors)
        for (const Module& m : s.modules) gatherMade(m);
    }
  }
  void gatherMade(const Module& m) {
    LetterUse& use = uses_[m.letter];
    const Number* number = m.arguments.empty() ? nullptr : numberIn(grammar_, m.arguments[0]);
    if (number)
      use.made.insert(number->value);
    else
      use.madeByValue = true;
  }
  void gatherContext(const Module& m) {
    if (m.arguments.empty()) return;
    LetterUse& use = uses_[m.letter];
    if (const Number* number = numberIn(grammar_, m.arguments[0]))
      use.asked.insert(number->value);
    else
      use.askedInContext = true;
  }

  /// Whether some rule rewrites, or looks for, `letter(number)`.
  bool isAnswered(const std::string& letter, double number) {
    const LetterUse& use = uses_[letter];
    if (use.askedInContext || use.asked.contains(number) || use.general.size() > kMostGeneralRules) return true;
    const auto [known, isNew] = answered_[letter].try_emplace(number, false);
    if (isNew)
      known->second = std::any_of(use.general.begin(), use.general.end(), [&](const Production* p) { return takes(*p, letter, number); });
    return known->second;
  }
  bool takes(const Production& p, const std::string& letter, double number) const {
    if (!p.condition || !p.before.empty()) return true;
    for (const Module& m : p.predecessor) {
      if (m.letter != letter || m.arguments.empty()) continue;
      const Name* name = nameIn(grammar_, m.arguments[0]);
      const auto holds = name ? foldedWith(grammar_, *p.condition, name->name, number) : std::nullopt;
      if (!holds || *holds != 0) return true;
    }
    return false;
  }

  // ---- modules ----

  void modules(const std::vector<Module>& list, const Scope& names) {
    for (const Module& m : list) {
      letter(m);
      for (const ExprId argument : m.arguments) expression(argument, names);
      stageOf(m);
      turnOf(m);
    }
    brackets(list);
  }
  const LetterWord* known(const std::string& letter, SourceSpan where) {
    for (const LetterWord& word : letterWords())
      if (word.letter == letter) return &word;
    std::string hint;
    if (const auto kind = organOfKeyword(letter)) hint = std::string("in rules ") + keywordOf(*kind) + " is written " + letterOf(*kind);
    if (hint.empty()) hint = didYouMean(letter, letterNames_);
    if (hint.empty()) hint = "modules are A, S, L, R, F, W, rotr, rotu, [ and ]";
    report_.error(where, "unknown module '" + letter + "'", hint);
    return nullptr;
  }
  void letter(const Module& m) {
    const LetterWord* word = known(m.letter, m.where);
    if (!word) return;
    if (word->since11) since11("modules such as " + m.letter, m.where);
    const auto count = static_cast<int>(m.arguments.size());
    if (count >= word->fewest && count <= word->most) {
      if (count > word->fewest && !word->since11) since11("modules with further arguments", m.where);
      return;
    }
    const bool tooFew = count < word->fewest;
    const int bound = tooFew ? word->fewest : word->most;
    const std::string least = word->fewest == word->most ? "" : tooFew ? "at least " : "at most ";
    report_.error(m.where,
                  "'" + m.letter + "' takes " + least + std::to_string(bound) + (bound == 1 ? " argument" : " arguments") + ", not " +
                      std::to_string(count),
                  argumentHint(m.letter));
  }
  static std::string argumentHint(const std::string& letter) {
    if (letter == "rotr" || letter == "rotu") return "an angle in radians, for example " + letter + "(0.5)";
    return organOfLetter(letter) ? "the number of a stage, for example " + letter + "(1)" : std::string{};
  }
  void brackets(const std::vector<Module>& list) {
    std::vector<const Module*> open;
    for (const Module& m : list) {
      if (m.letter == "[") open.push_back(&m);
      if (m.letter != "]") continue;
      if (open.empty())
        report_.error(m.where, "']' closes no branch", "remove it, or write the '[' where the branch starts");
      else
        open.pop_back();
    }
    for (const Module* m : open) report_.error(m->where, "the branch that starts here is never closed", "write ']' where it ends");
  }
  /// An organ must have its stage, be rewritten, or be looked for by a context; else nothing would ever be seen of it.
  void stageOf(const Module& m) {
    const auto kind = organOfLetter(m.letter);
    const Number* number = kind && !m.arguments.empty() ? numberIn(grammar_, m.arguments[0]) : nullptr;
    if (number) furtherArguments(m, number->value);
    if (!number || isAnswered(m.letter, number->value)) return;
    const auto found = stages_.find(m.letter);
    if (found != stages_.end() && found->second.contains(number->value)) return;
    const std::string said = printModule(grammar_, m);
    if (*kind == OrganKind::Apex && found == stages_.end())
      return report_.warning(m.where, "no rule rewrites " + said + ": growth ends here", "add a rule " + said + " -> ... ;");
    report_.error(m.where,
                  "unknown stage: " + std::string(keywordOf(*kind)) + " has no Stage " + textOf(*number) + " and no rule rewrites " + said,
                  found == stages_.end() ? std::string(keywordOf(*kind)) + " has no stages at all" : stageHint(found->second));
  }
  /// What the stage names, the module must give.
  void furtherArguments(const Module& m, double number) {
    const auto named = stageArguments_.find({m.letter, number});
    if (named == stageArguments_.end() || m.arguments.size() > named->second) return;
    report_.error(m.where, "'" + printModule(grammar_, m) + "' has " + std::to_string(m.arguments.size() - 1) + " further arguments, but its Stage names " +
                               std::to_string(named->second),
                  "write them behind the number, as in " + m.letter + "(1, 0.2)");
  }
  /// More than a full turn is mostly an angle in degrees.
  void turnOf(const Module& m) {
    const Number* angle = (m.letter == "rotr" || m.letter == "rotu") && m.arguments.size() == 1 ? numberIn(grammar_, m.arguments[0]) : nullptr;
    constexpr double kFullTurn = 6.2832;
    if (!angle || std::abs(angle->value) <= kFullTurn) return;
    const double radians = Angle::fromDegrees(angle->value).radians();
    report_.warning(m.where, m.letter + " turns by radians, and " + textOf(*angle) + " is more than a full turn", textOf(*angle) + " degrees are " + fixed(radians, 6));
  }
  static std::string stageHint(const std::set<double>& numbers) {
    return "its stages go from " + shortest(*numbers.begin()) + " to " + shortest(*numbers.rbegin());
  }

  std::vector<std::string_view> letterNames_;
  std::map<std::string, std::set<double>> stages_;
  std::map<std::pair<std::string, double>, std::size_t> stageArguments_;  ///< how many further arguments a stage names
  std::map<std::string, LetterUse> uses_;
  std::map<std::string, std::unordered_map<double, bool>> answered_;
};

}  // namespace axil::simeco::checking
