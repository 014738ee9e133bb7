#include "base/overloaded.hpp"
#include "simeco/check_fold.hpp"
#include "simeco/check_reach.hpp"
#include "simeco/check_runaway.hpp"
#include "simeco/derive.hpp"
#include "simeco/fold.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_reader.hpp"
#include "simeco/report.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace axil::simeco {

namespace {

using Names = std::set<std::string, std::less<>>;

/// How a string of modules leaves brackets: ]]][[ is what remains when pairs are taken away.
struct Balance {
  std::size_t closes = 0;
  std::size_t opens = 0;
  friend bool operator==(const Balance&, const Balance&) = default;
};

Balance balanceOf(const std::vector<Module>& modules) {
  Balance result;
  for (const Module& m : modules) {
    if (m.letter == "[") ++result.opens;
    if (m.letter != "]") continue;
    if (result.opens > 0) --result.opens;
    else ++result.closes;
  }
  return result;
}

/// Names that an expression of calls gives a value to: fscanf's.
void scanned(const Grammar& grammar, ExprId id, Names& names) {
  const auto* call = std::get_if<Call>(&grammar.at(id).node);
  if (call == nullptr || call->function != "fscanf") return;
  for (const ExprId argument : call->arguments)
    if (const Name* name = nameIn(grammar, argument)) names.insert(name->name);
}

/// Names that statements give a value to.
void assigned(const Grammar& grammar, const Block& block, Names& names) {
  for (const Statement& s : block)
    std::visit(overloaded{[&](const Assign& a) { names.insert(a.name), scanned(grammar, a.value, names); }, [](const AssignElement&) {},
                          [&](const Evaluate& e) { scanned(grammar, e.value, names); },
                          [&](const If& i) { assigned(grammar, i.yes, names), assigned(grammar, i.no, names); },
                          [&](const While& w) { assigned(grammar, w.body, names); }},
               s.node);
}

class Checker {
 public:
  explicit Checker(const Grammar& grammar) : grammar_(grammar) {}

  std::vector<Diagnostic> run() {
    for (const PlantGrammar& plant : grammar_.plants) {
      for (const RuleSet& rules : plant.subRules) labels_.insert(rules.label);
      labels_.insert(plant.rules.label);
      gatherMade(plant);
      lsystem(plant.rules);
      warnAboutRunaway(grammar_, plant.rules, report_);
      for (const RuleSet& rules : plant.subRules) lsystem(rules);
    }
    return report_.take();
  }

 private:
  // ---- one L-system

  void lsystem(const RuleSet& rules) {
    readGlobals(rules);
    rewritesDetaching_ = std::any_of(rules.productions.begin(), rules.productions.end(), [](const Production& rule) {
      return rule.predecessor.size() == 1 && rule.predecessor.front().letter == "%" && rule.predecessor.front().arguments.size() == 1;
    });
    for (const ArrayDeclaration& array : rules.arrays)
      for (const ExprId id : array.initial) expression(id);
    if (rules.derivationLength) derivationLength(*rules.derivationLength);
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) statements(*block);
    string(rules.axiom);
    const Balance axiom = balanceOf(rules.axiom);
    if (axiom.closes + axiom.opens > 0) report_.warning(rules.axiom.front().where, "the brackets of the axiom do not pair", "count the [ and ]");
    filter(rules);
    productions(rules.productions, rules, rules.seed.has_value());
    if (rules.decomposition) productions(rules.decomposition->productions, rules, false);
    if (rules.homomorphism) productions(rules.homomorphism->productions, rules, false);
    productions(rules.interaction, rules, rules.seed.has_value());
  }

  void derivationLength(ExprId id) {
    expression(id);
    const auto steps = foldedAlone(grammar_, id);
    if (steps && *steps < 0) report_.error(grammar_.at(id).where, "the derivation length must not be negative", "0 gives the axiom");
    else if (steps && *steps > static_cast<double>(Limits{}.steps)) report_.warning(grammar_.at(id).where, "the derivation is limited to " + std::to_string(Limits{}.steps) + " steps", "write fewer, or raise the limit with --max-steps");
  }

  void readGlobals(const RuleSet& rules) {
    globals_.clear();
    arrays_.clear();
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) assigned(grammar_, *block, globals_);
    globals_.insert(rules.externals.begin(), rules.externals.end());
    for (const ArrayDeclaration& array : rules.arrays) arrays_[array.name] = &array;
  }

  void filter(const RuleSet& rules) {
    const bool considers = rules.filter.mode == ContextFilter::Mode::Consider;
    const auto lists = [&](const char* letter) { return std::find(rules.filter.letters.begin(), rules.filter.letters.end(), letter) != rules.filter.letters.end(); };
    ignored_.clear();
    if (rules.filter.mode == ContextFilter::Mode::Ignore) ignored_.insert(rules.filter.letters.begin(), rules.filter.letters.end());
    considered_.clear();
    if (considers) considered_.insert(rules.filter.letters.begin(), rules.filter.letters.end());
    considers_ = considers;
    const bool loses = considers ? !lists("[") || !lists("]") : lists("[") || lists("]");
    const bool rightContext = std::any_of(rules.productions.begin(), rules.productions.end(), [](const Production& p) { return !p.right.empty(); });
    if (loses && rightContext && !rules.axiom.empty())
      report_.warning(rules.axiom.front().where, "brackets keep their meaning in contexts, whatever ignore: and consider: list",
                      considers ? "list [ and ] in consider:" : "take [ and ] out of ignore:");
  }

  // ---- what the rules make

  void gatherMade(const PlantGrammar& plant) {
    made_.clear();
    gatherMade(plant.rules);
    for (const RuleSet& rules : plant.subRules) gatherMade(rules);
  }
  void gatherMade(const RuleSet& rules) {
    gatherMade(rules.axiom);
    gatherMade(rules.productions);
    if (rules.decomposition) gatherMade(rules.decomposition->productions);
    if (rules.homomorphism) gatherMade(rules.homomorphism->productions);
    gatherMade(rules.interaction);
  }
  void gatherMade(const std::vector<Production>& rules) {
    for (const Production& rule : rules)
      for (const Successor& successor : rule.successors) gatherMade(successor.modules);
  }
  void gatherMade(const std::vector<Module>& modules) {
    for (const Module& m : modules) made_[m.letter].insert(m.arguments.size());
  }
  /// A rule for a letter that nothing makes, or not with so many parameters.
  void neverMade(const Production& rule) {
    for (const Module& m : rule.predecessor) {
      const auto counts = made_.find(m.letter);
      if (counts != made_.end() && counts->second.contains(m.arguments.size())) continue;
      const std::string said = m.letter + (m.arguments.empty() ? "" : " with " + std::to_string(m.arguments.size()) + (m.arguments.size() == 1 ? " parameter" : " parameters"));
      const bool others = counts != made_.end() && !counts->second.empty();
      const std::size_t count = others ? *counts->second.begin() : 0;
      report_.warning(rule.where, "this rule never fires: nothing makes " + said + (others && m.arguments.empty() ? " without parameters" : ""),
                      others ? "there is " + m.letter + " with " + std::to_string(count) + (count == 1 ? " parameter" : " parameters") + "; letter and number of parameters must agree" : "");
      return;
    }
  }

  // ---- rules

  void productions(const std::vector<Production>& all, const RuleSet& rules, bool stochastic) {
    for (const Production& rule : all) production(rule, rules, stochastic);
    unreached(all, stochastic ? Order::ByChance : Order::FirstThatFits);
  }

  void production(const Production& rule, const RuleSet& rules, bool stochastic) {
    formals_.clear();
    for (const auto* side : {&rule.left, &rule.predecessor, &rule.right}) bind(*side);
    locals_.clear();
    assigned(grammar_, rule.before, locals_);
    assigned(grammar_, rule.after, locals_);
    set_.clear();
    neverMade(rule);
    context(rule.left, true);
    context(rule.right, false);
    statements(rule.before);
    if (rule.condition) expression(*rule.condition);
    statements(rule.after);
    for (const Successor& successor : rule.successors) {
      string(successor.modules);
      if (successor.weight) expression(*successor.weight);
      if (successor.weight && !stochastic)
        report_.warning(grammar_.at(*successor.weight).where, "this weight is not used: the first rule that fits is taken",
                        rules.seed ? "weights count in productions only" : "write seed: 1 before Axiom: for rules by chance");
      if (balanceOf(successor.modules) != balanceOf(rule.predecessor))
        report_.warning(rule.where, "this rule changes how brackets pair", "give every [ of the successor its ]");
    }
    formals_.clear();
    locals_.clear();
    set_.clear();
  }

  void bind(const std::vector<Module>& side) {
    for (const Module& m : side)
      for (const ExprId id : m.arguments) {
        const Name* formal = nameIn(grammar_, id);
        if (formal == nullptr) continue;
        if (!formals_.insert(formal->name).second)
          report_.error(grammar_.at(id).where, "parameter " + formal->name + " stands twice in this rule", "give each its own name and compare them in a condition");
        if (arrays_.contains(formal->name)) report_.warning(grammar_.at(id).where, "parameter " + formal->name + " has the name of an array");
      }
  }

  void context(const std::vector<Module>& side, bool left) {
    for (const Module& m : side) {
      const bool bracket = m.letter == "[" || m.letter == "]";
      if (left && bracket) report_.warning(m.where, "a bracket in a left context never matches", "leave it out: branches are skipped and left by themselves");
      if (!bracket && m.letter != "=" && (ignored_.contains(m.letter) || (considers_ && !considered_.contains(m.letter))))
        report_.warning(m.where, m.letter + " is passed over in contexts, so this context never matches", "see ignore: and consider:");
    }
  }

  /// Rules that rules above them or their own condition keep from firing.
  void unreached(const std::vector<Production>& all, Order order) {
    const auto unreached = unreachedRules(grammar_, all, order);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (unreached[i] == Unreached::ByItsCondition) report_.warning(all[i].where, "this rule never fires: its condition never holds", "compare again, or leave the rule out");
      if (unreached[i] == Unreached::ByRulesAbove)
        report_.warning(all[i].where, all[i].condition ? "this rule never fires: rules above it take every module for which its condition holds" : "this rule never fires: one above it takes every such module",
                        "move it up, or give the other a condition");
    }
  }

  // ---- strings, statements, expressions

  void string(const std::vector<Module>& modules) {
    for (std::size_t i = 0; i < modules.size(); ++i) {
      for (const ExprId id : modules[i].arguments) expression(id);
      if (modules[i].letter == "?" && modules[i].arguments.size() == 2) entered(modules[i]);
      if (modules[i].letter == "%" && modules[i].arguments.size() == 1 && !rewritesDetaching_)
        report_.error(modules[i].where, "%(p), which would detach a branch and let it go on by itself, is not built", "write % to cut the branch off, or give % with a parameter a rule");
    }
  }

  void entered(const Module& module) {
    const auto* number = std::get_if<Number>(&grammar_.at(module.arguments[0]).node);
    if (number == nullptr || labels_.contains(textOf(*number))) return;
    report_.warning(module.where, "there is no L-system with the label " + textOf(*number), "a sub-L-system is written below, Lsystem: " + textOf(*number));
  }

  void statements(const Block& block) {
    for (const Statement& s : block)
      std::visit(overloaded{[&](const Assign& a) { assignment(a, s.where); }, [&](const AssignElement& a) { element(a.array, a.indices, s.where), expression(a.value); },
                            [&](const Evaluate& e) { expression(e.value); },
                            [&](const If& i) {
                              expression(i.condition);
                              statements(i.yes);
                              statements(i.no);
                            },
                            [&](const While& w) {
                              if (w.testFirst) expression(w.condition);
                              statements(w.body);
                              if (!w.testFirst) expression(w.condition);
                            }},
                 s.node);
  }

  void assignment(const Assign& a, SourceSpan where) {
    expression(a.value);
    if (arrays_.contains(a.name)) report_.error(where, a.name + " is an array and needs an index here", "write " + a.name + "[0]");
    set_.insert(a.name);
  }

  void expression(ExprId id) {
    const Expr& e = grammar_.at(id);
    std::visit(overloaded{[](const Number&) {}, [&](const Name& n) { variable(n.name, e.where); },
                          [&](const Text&) { report_.error(e.where, "a quoted text has no value", "texts stand in printf only"); },
                          [&](const Unary& u) { expression(u.operand); },
                          [&](const Binary& b) {
                            expression(b.left);
                            expression(b.right);
                            const auto* divisor = std::get_if<Number>(&grammar_.at(b.right).node);
                            if (divisor != nullptr && divisor->value == 0 && (b.op == BinaryOp::Divide || b.op == BinaryOp::Remainder))
                              report_.warning(grammar_.at(b.right).where, "this divides by zero, which ends a derivation", "the reference program would divide by 1");
                          },
                          [&](const Chain& c) {
                            for (const ExprId operand : c.operands) expression(operand);
                          },
                          [&](const Conditional& c) {
                            expression(c.condition);
                            expression(c.yes);
                            expression(c.no);
                          },
                          [&](const Call& c) { call(c, e.where); }, [&](const Element& a) { element(a.array, a.indices, e.where); }},
               e.node);
  }

  void variable(const std::string& name, SourceSpan where) {
    if (arrays_.contains(name)) return report_.error(where, name + " is an array and needs an index here", "write " + name + "[0]");
    if (formals_.contains(name) || globals_.contains(name)) return;
    if (locals_.contains(name)) {
      if (!set_.contains(name)) report_.warning(where, name + " is read before it is set; it starts at 0 for every module", "to count, set it in Start: first");
      return;
    }
    report_.warning(where, "nothing sets " + name + "; it is 0", "set it in Start:, or #define it");
  }

  void element(const std::string& array, const std::vector<ExprId>& indices, SourceSpan where) {
    for (const ExprId id : indices) expression(id);
    const auto found = arrays_.find(array);
    if (found == arrays_.end()) return report_.error(where, array + " is not declared as an array", "write define: { array " + array + "[3]; } before Axiom:");
    const std::vector<int>& sizes = found->second->sizes;
    if (sizes.size() != indices.size())
      return report_.error(where, "array " + array + " has " + std::to_string(sizes.size()) + " dimensions, not " + std::to_string(indices.size()));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const auto* number = std::get_if<Number>(&grammar_.at(indices[i]).node);
      if (number != nullptr && number->value >= sizes[i])
        report_.warning(grammar_.at(indices[i]).where, "index " + textOf(*number) + " is behind the end of array " + array + "; its last element is meant", "the first index is 0");
    }
  }

  void call(const Call& c, SourceSpan where) {
    const LSystemFunction* known = lsystemFunction(c.function);
    const bool takesText = known != nullptr && known->takesText;
    for (const ExprId id : c.arguments)
      if (!takesText || !std::holds_alternative<Text>(grammar_.at(id).node)) expression(id);
    if (c.function == "com")
      for (const ExprId id : c.arguments)
        if (nameIn(grammar_, id) == nullptr) report_.error(grammar_.at(id).where, "com hands over variables, not values", "put the value into a variable first");
    if (c.function == "trunc") report_.warning(where, "trunc rounds here: trunc(1.6) is 2", "write floor(x) to cut off the decimals of a positive x");
    files(c, where);
    static const Names kContours{"curveX", "curveY", "curveZ", "curveGAL", "inblob"};
    if (kContours.contains(c.function)) report_.error(where, c.function + " needs the curves of a modelling session, which are not read here", "compute the value, or use func(id, x)");
  }

  /// A grammar reads files beside it and writes none.
  void files(const Call& c, SourceSpan where) {
    const auto textOf = [&](std::size_t i) { return i < c.arguments.size() ? std::get_if<Text>(&grammar_.at(c.arguments[i]).node) : nullptr; };
    if (c.function == "fprintf") report_.warning(where, "fprintf writes nothing: a grammar may not write files", "use printf, which writes to standard error");
    if (c.function == "fopen" && (textOf(0) == nullptr || textOf(1) == nullptr)) report_.error(where, "fopen takes two quoted texts", "write fopen(\"file\",\"r\")");
    else if (c.function == "fopen" && !textOf(1)->text.starts_with('r')) report_.warning(where, "the file \"" + textOf(0)->text + "\" is not written: a grammar may only read files beside it", "what is printed into it is dropped");
    if (c.function != "fscanf") return;
    if (textOf(1) == nullptr) report_.error(where, "fscanf needs a quoted format behind the file", "write fscanf(f,\"%f\",&x)");
    for (std::size_t i = 2; i < c.arguments.size(); ++i)
      if (nameIn(grammar_, c.arguments[i]) == nullptr) report_.error(grammar_.at(c.arguments[i]).where, "fscanf reads into variables", "write &x");
  }

  const Grammar& grammar_;
  Report report_;
  Names labels_;
  std::map<std::string, std::set<std::size_t>, std::less<>> made_;  ///< letters with their numbers of parameters
  Names globals_;
  Names formals_;
  Names locals_;
  Names set_;      ///< locals set so far, in text order
  Names ignored_;
  Names considered_;
  bool considers_ = false;
  bool rewritesDetaching_ = false;  ///< %(p) is an ordinary letter
  std::map<std::string, const ArrayDeclaration*, std::less<>> arrays_;
};

}  // namespace

std::vector<Diagnostic> checkLSystem(const Grammar& grammar) { return Checker(grammar).run(); }

}  // namespace axil::simeco
