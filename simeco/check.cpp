// What is wrong with a SimEco grammar that parsed. Every finding stands at the place that the author has to change.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "base/angle.hpp"
#include "base/text.hpp"
#include "base/overloaded.hpp"
#include "simeco/check_fold.hpp"
#include "simeco/check_reach.hpp"
#include "simeco/check_runaway.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

namespace axil::simeco {

namespace {

// More general rules of one letter than these are not compared with every module: the work must stay linear in the text.
constexpr std::size_t kMostGeneralRules = 64;

/// What the rules of one plant do with one letter.
struct LetterUse {
  std::unordered_set<double> made;         ///< numbers that an axiom or successor writes
  bool madeByValue = false;                ///< ... and that it computes, so that any may come
  std::unordered_set<double> asked;        ///< numbers that a predecessor or context names
  bool askedInContext = false;             ///< a context takes any number
  std::vector<const Production*> general;  ///< rules whose predecessor takes any number
};

class Checker {
 public:
  explicit Checker(const Grammar& grammar) : grammar_(grammar), is10_(grammar.version == "1.0") {
    for (const AttributeWord& word : attributeWords()) attributeNames_.push_back(word.name);
    for (const FunctionWord& word : functionWords()) functionNames_.push_back(word.name);
    for (const LetterWord& word : letterWords()) letterNames_.push_back(word.letter);
    for (const Expr& expr : grammar.expressions)
      if (const auto* name = std::get_if<Name>(&expr.node)) usedNames_.insert(name->name);
  }

  std::vector<Diagnostic> run() {
    if (std::find(std::begin(kVersions), std::end(kVersions), grammar_.version) == std::end(kVersions))
      report_.error({}, "version " + grammar_.version + " is not known", "this program reads 1.0 and 1.1");
    oneLine(grammar_.name, {}, "the ecosystem's name");
    enterPlant(nullptr);
    attributes(grammar_.attributes, InEcosystem);
    std::set<std::string_view> names;
    for (const PlantGrammar& p : grammar_.plants) {
      if (!names.insert(p.name).second) report_.error(p.where, "there is a second plant \"" + p.name + "\"", "give it another name");
      plant(p);
    }
    if (grammar_.plants.empty()) report_.warning({}, "the ecosystem has no plant", "add Plant \"name\" { ... }");
    return report_.take();
  }

 private:
  // ---- what version 1.0 does not have ----

  /// Told once a feature: the fix is the same everywhere.
  void since11(const std::string& feature, SourceSpan where) {
    if (is10_ && toldFeatures_.insert(feature).second)
      report_.error(where, feature + " need SimEco 1.1", "begin the file with: EcoSystem 1.1");
  }
  void oneLine(std::string_view words, SourceSpan where, const char* what) {
    if (words.find_first_of("\n\r") != std::string_view::npos)
      report_.error(where, std::string(what) + " has a line break", "write it on one line");
  }

  // ---- attributes ----

  void attributes(const std::vector<Attribute>& list, Place place) {
    std::unordered_set<std::string_view> names;
    for (const Attribute& a : list) {
      if (!names.insert(a.name).second && a.name != "Obstacle") report_.error(a.where, "'" + a.name + "' is given a second time in this block", "keep one of them");
      attribute(a, place);
    }
  }
  void attribute(const Attribute& a, Place place) {
    expression(a.value, {});
    const auto words = attributeWords();
    const auto word = std::find_if(words.begin(), words.end(), [&](const AttributeWord& w) { return w.name == a.name; });
    if (word == words.end()) return unknownAttribute(a, place);
    if (word->since11) since11("attributes such as '" + a.name + "'", a.where);
    if (!word->warning.empty()) report_.warning(a.where, "'" + a.name + "' is read, but " + std::string(word->warning));
    if ((word->places & place) == 0)
      report_.warning(a.where, "'" + a.name + "' has no effect here", "it belongs into " + placesOf(word->places));
    value(a, word->kind);
  }
  void unknownAttribute(const Attribute& a, Place place) {
    if (usedNames_.contains(a.name)) return;  // the author's own name for a number
    const std::string hint = didYouMean(a.name, attributeNames_);
    if (!hint.empty()) return report_.error(a.where, "unknown attribute '" + a.name + "'", hint);
    if (place == InOrgan) report_.warning(a.where, "unknown attribute '" + a.name + "': it is kept and has no effect");
  }
  static std::string placesOf(std::uint8_t places) {
    std::string text;
    const auto add = [&](Place place, const char* words) {
      if ((places & place) == 0) return;
      text += (text.empty() ? "" : " or ") + std::string(words);
    };
    add(InEcosystem, "the EcoSystem");
    add(InPlant, "a Plant");
    add(InOrgan, "an organ or its Stage");
    return text;
  }
  void value(const Attribute& a, ValueKind kind) {
    const Expr& expr = grammar_.at(a.value);
    const auto* call = std::get_if<Call>(&expr.node);
    const auto wants = [&](const std::string& what) { report_.error(expr.where, "'" + a.name + "' is " + what); };
    const auto wantsCall = [&](std::string_view function, const std::string& what) {
      if (!call || call->function != function) wants(what);
    };
    switch (kind) {
      case ValueKind::Words:
        if (!std::holds_alternative<Text>(expr.node)) wants("a text in quotes, for example \"leaf.i\"");
        return;
      case ValueKind::Vector:
        return wantsCall("vector", "a vector(x, y, z)");
      case ValueKind::Colour:
        wantsCall("RGBA", "a colour RGBA(red, green, blue, alpha)");
        return shares(a, call);
      case ValueKind::Body:
        if (!call || (call->function != "sphere" && call->function != "box")) wants("a sphere(x, y, z, radius) or a box(x, y, z, x, y, z)");
        return;
      case ValueKind::Material:
        return wantsCall("MTRL", "a material MTRL(...) of six numbers");
      case ValueKind::Number:
      case ValueKind::NotNegative:
      case ValueKind::Positive:
        return number(a, kind);
    }
  }
  /// The parts of a colour go from 0 to 1.
  void shares(const Attribute& a, const Call* call) {
    if (call == nullptr || call->function != "RGBA") return;
    for (const ExprId id : call->arguments)
      if (const Number* part = numberIn(grammar_, id); part != nullptr && part->value > 1)
        return report_.warning(grammar_.at(id).where, "the parts of '" + a.name + "' go from 0 to 1", part->value <= 255 ? "divide by 255" : "");
  }
  void number(const Attribute& a, ValueKind kind) {
    const Expr& expr = grammar_.at(a.value);
    const auto* call = std::get_if<Call>(&expr.node);
    const bool isThing = call && (call->function == "vector" || call->function == "RGBA" || call->function == "MTRL" || call->function == "sphere" || call->function == "box");
    if (isThing || std::holds_alternative<Text>(expr.node)) return report_.error(expr.where, "'" + a.name + "' is a number");
    const auto known = foldedWith(grammar_, a.value, {}, 0);
    if (!known) return;
    if (kind == ValueKind::Positive && !(*known > 0)) report_.error(expr.where, "'" + a.name + "' must be above 0");
    if (kind == ValueKind::NotNegative && !(*known >= 0)) report_.error(expr.where, "'" + a.name + "' must not be negative");
  }

  // ---- plants ----

  void plant(const PlantGrammar& p) {
    oneLine(p.name, p.where, "the plant's name");
    enterPlant(&p);
    attributes(p.attributes, InPlant);
    std::set<OrganKind> kinds;
    for (const OrganBlock& o : p.organs) {
      if (!kinds.insert(o.kind).second) report_.error(o.where, std::string("there is a second block ") + keywordOf(o.kind), "join the two");
      organ(o);
    }
    gatherStages(p);
    rules(p.rules);
    for (const RuleSet& further : p.subRules) {
      const SourceSpan where = further.axiom.empty() ? p.where : further.axiom.front().where;
      report_.error(where, "a plant has one Grow block", "join the two; sub-L-systems can be written in an L-system file (.l)");
      rules(further);
    }
    unusedStages(p);
  }
  void organ(const OrganBlock& o) {
    attributes(o.attributes, InOrgan);
    std::unordered_set<int> numbers;
    for (const Stage& s : o.stages) {
      if (!numbers.insert(s.number).second)
        report_.error(s.where, std::string(keywordOf(o.kind)) + " has a second Stage " + std::to_string(s.number),
                      "give it another number");
      if (s.number < 0) report_.error(s.where, "a stage's number must not be negative");
      stageAttributes(s);
    }
  }
  /// Beside the environment they may use the stage's own arguments.
  void stageAttributes(const Stage& s) {
    if (!s.parameters.empty()) since11("stages with arguments", s.where);
    const auto outside = environment_;
    std::set<std::string_view> own;
    for (const std::string& name : s.parameters) {
      if (!own.insert(name).second) report_.error(s.where, "'" + name + "' names two arguments of the stage", "rename one");
      environment_.insert(name);
    }
    attributes(s.attributes, InOrgan);
    environment_ = outside;
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

  // ---- rules ----

  /// A rule's own names. Those of the block and of the environment are members: they are looked up behind them.
  using Scope = std::vector<std::string_view>;

  void enterPlant(const PlantGrammar* plant) {
    globals_.clear();
    arrays_.clear();
    environment_.clear();
    for (const Attribute& a : grammar_.attributes) environment_.insert(a.name);
    if (plant)
      for (const Attribute& a : plant->attributes) environment_.insert(a.name);
  }
  void rules(const RuleSet& rules) {
    answered_.clear();
    Scope assigned(rules.externals.begin(), rules.externals.end());
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) assignedNames(*block, assigned);
    globals_ = {assigned.begin(), assigned.end()};
    settings(rules);
    if (rules.axiom.empty() && !rules.productions.empty()) {
      const SourceSpan where = rules.productions.front().where;
      report_.error({where.begin, where.begin}, "the rules have no axiom to begin with", "write one above them, for example: w = A(0);");
    }
    modules(rules.axiom, {});
    productions(rules.productions);
    if (rules.decomposition) productions(rules.decomposition->productions);
    if (rules.homomorphism) productions(rules.homomorphism->productions);
    productions(rules.interaction);
    neverFired(rules.productions);
    warnAboutRunaway(grammar_, rules, report_);
  }
  void settings(const RuleSet& rules) {
    const SourceSpan where = rules.axiom.empty() ? SourceSpan{} : rules.axiom.front().where;
    if (rules.seed || rules.derivationLength || rules.ring) since11("seed, steps and ring", where);
    if (rules.filter.mode != ContextFilter::Mode::None) since11("ignore and consider", where);
    if (rules.decomposition || rules.homomorphism || !rules.interaction.empty())
      since11("decomposition, homomorphism and interaction", where);
    if (!rules.arrays.empty() || !rules.externals.empty()) since11("arrays and external names", where);
    for (const std::string& letter : rules.filter.letters) known(letter, where);
    if (rules.derivationLength) expression(*rules.derivationLength, {});
    for (const ArrayDeclaration& array : rules.arrays) {
      if (array.sizes.empty() || std::any_of(array.sizes.begin(), array.sizes.end(), [](int size) { return size < 1; }))
        report_.error(where, "array '" + array.name + "' needs sizes of 1 or more");
      arrays_.insert(array.name);
      for (const ExprId value : array.initial) expression(value, {});
    }
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) statements(*block, {});
  }
  void assignedNames(const Block& block, Scope& names) const {
    for (const Statement& s : block) {
      if (const auto* assign = std::get_if<Assign>(&s.node)) names.push_back(assign->name);
      if (const auto* branch = std::get_if<If>(&s.node)) {
        assignedNames(branch->yes, names);
        assignedNames(branch->no, names);
      }
      if (const auto* loop = std::get_if<While>(&s.node)) assignedNames(loop->body, names);
    }
  }
  void productions(const std::vector<Production>& list) {
    for (const Production& p : list) production(p);
  }
  void production(const Production& p) {
    Scope names;
    for (const std::vector<Module>* side : {&p.left, &p.predecessor, &p.right}) bind(*side, names);
    asked(p);
    if (!p.before.empty() || !p.after.empty()) since11("statements", p.where);
    assignedNames(p.before, names);
    assignedNames(p.after, names);
    statements(p.before, names);
    if (p.condition) expression(*p.condition, names);
    statements(p.after, names);
    successors(p, names);
  }
  void bind(const std::vector<Module>& side, Scope& names) {
    for (const Module& m : side) {
      for (const ExprId argument : m.arguments) {
        const Name* name = nameIn(grammar_, argument);
        if (!name) continue;
        if (std::find(names.begin(), names.end(), name->name) != names.end())
          report_.error(grammar_.at(argument).where, "'" + name->name + "' is bound a second time",
                        "use another name and compare the two in a condition");
        names.push_back(name->name);
      }
    }
  }
  void asked(const Production& p) {
    if (p.predecessor.size() > 1) since11("several modules before '->'", p.where);
    for (const Module& m : p.predecessor)
      if (m.letter == "[" || m.letter == "]")
        report_.error(m.where, "a bracket cannot be rewritten", "brackets stand in contexts and in what a rule makes");
    for (const std::vector<Module>* side : {&p.left, &p.predecessor, &p.right}) {
      for (const Module& m : *side) {
        letter(m);
        for (const ExprId argument : m.arguments)
          if (!nameIn(grammar_, argument) && !numberIn(grammar_, argument))
            report_.error(grammar_.at(argument).where, "before '->' an argument is a name or a number",
                          "compute it after '->', or compare it in a condition");
      }
    }
    brackets(p.left);
    brackets(p.right);
  }
  void successors(const Production& p, const Scope& names) {
    double sum = 0;
    bool allKnown = true;
    std::size_t weights = 0;
    for (const Successor& s : p.successors) {
      if (s.weight) {
        ++weights;
        since11("weighted successors", grammar_.at(*s.weight).where);
        expression(*s.weight, names);
        const Number* number = numberIn(grammar_, *s.weight);
        if (number && number->value < 0) report_.error(grammar_.at(*s.weight).where, "a successor's weight must not be negative");
        allKnown = allKnown && number != nullptr;
        sum += number ? number->value : 0;
      }
      modules(s.modules, names);
    }
    if (p.successors.size() > 1) since11("several successors", p.where);
    if (p.successors.size() > 1 && weights < p.successors.size())
      report_.error(p.where, "each of several successors needs its weight", "for example: A(i) -> 0.7: S(i) | 0.3: L(1) ;");
    if (weights == p.successors.size() && weights > 0 && allKnown && !(sum > 0))
      report_.error(p.where, "all weights of the rule are 0", "give one of them more");
    if (p.successors.size() == 1 && weights == 1)
      report_.warning(p.where, "a weight has no effect where there is one successor", "add another one after '|'");
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

  // ---- expressions and statements ----

  void statements(const Block& block, const Scope& names, int depth = 0) {
    if (block.empty()) return;
    if (depth > kMostDepth) return report_.error(block.front().where, "statements are nested deeper than " + std::to_string(kMostDepth));
    since11("statements", block.front().where);
    for (const Statement& s : block)
      std::visit(overloaded{[&](const Assign& n) { expression(n.value, names); },
                            [&](const AssignElement& n) {
                              array(n.array, s.where);
                              for (const ExprId index : n.indices) expression(index, names);
                              expression(n.value, names);
                            },
                            [&](const Evaluate& n) { expression(n.value, names); },
                            [&](const If& n) {
                              expression(n.condition, names);
                              statements(n.yes, names, depth + 1);
                              statements(n.no, names, depth + 1);
                            },
                            [&](const While& n) {
                              expression(n.condition, names);
                              statements(n.body, names, depth + 1);
                            }},
                 s.node);
  }
  void array(const std::string& name, SourceSpan where) {
    if (!arrays_.contains(name)) report_.error(where, "unknown array '" + name + "'", "declare it in Grow: array " + name + "[10];");
  }
  void expression(ExprId id, const Scope& names, int depth = 0) {
    if (!id.valid()) return;
    const Expr& expr = grammar_.at(id);
    if (depth > kMostDepth) return report_.error(expr.where, "the expression is nested deeper than " + std::to_string(kMostDepth));
    const auto inner = [&](ExprId child) { expression(child, names, depth + 1); };
    std::visit(overloaded{[&](const Number& n) {
                            if (!std::isfinite(n.value)) report_.error(expr.where, "a number is not finite");
                          },
                          [&](const Name& n) { name(n, expr.where, names); }, [&](const Text& n) { oneLine(n.text, expr.where, "a text"); },
                          [&](const Unary& n) {
                            if (n.op == UnaryOp::Not) since11("operators such as !", expr.where);
                            inner(n.operand);
                          },
                          [&](const Binary& n) {
                            binary(n, expr.where);
                            inner(n.left);
                            inner(n.right);
                          },
                          [&](const Chain& n) {
                            for (const ExprId operand : n.operands) inner(operand);
                          },
                          [&](const Conditional& n) {
                            since11("operators such as ?:", expr.where);
                            inner(n.condition);
                            inner(n.yes);
                            inner(n.no);
                          },
                          [&](const Call& n) {
                            call(n, expr.where);
                            for (const ExprId argument : n.arguments) inner(argument);
                          },
                          [&](const Element& n) {
                            array(n.array, expr.where);
                            for (const ExprId index : n.indices) inner(index);
                          }},
               expr.node);
  }
  void name(const Name& n, SourceSpan where, const Scope& names) {
    if (std::find(names.begin(), names.end(), n.name) != names.end() || globals_.contains(n.name)) return;
    if (environment_.contains(n.name)) return since11("names of attributes in expressions", where);
    const auto words = attributeWords();
    const bool isAttribute = std::any_of(words.begin(), words.end(), [&](const AttributeWord& w) { return w.name == n.name; });
    Scope all = names;
    all.insert(all.end(), globals_.begin(), globals_.end());
    all.insert(all.end(), environment_.begin(), environment_.end());
    std::string hint = isAttribute ? "give it a value: " + n.name + " = 1;" : didYouMean(n.name, all);
    if (n.name == "pi" || n.name == "PI") hint = "write 3.141593, or give it a value in the EcoSystem: " + n.name + " = 3.141593;";
    if (hint.empty()) hint = "a rule's own names stand in its predecessor, for example S(" + n.name + ") -> ...";
    report_.error(where, "unknown name '" + n.name + "'", hint);
  }
  void binary(const Binary& n, SourceSpan where) {
    const bool divides = n.op == BinaryOp::Divide || n.op == BinaryOp::Remainder;
    const auto divisor = divides ? foldedWith(grammar_, n.right, {}, 0) : std::nullopt;
    if (divisor && *divisor == 0) report_.error(grammar_.at(n.right).where, "division by zero");
    if (n.op == BinaryOp::Remainder || n.op == BinaryOp::Power) since11("operators such as % and ^", where);
    if (n.op == BinaryOp::And || n.op == BinaryOp::Or) since11("operators such as && and ||", where);
  }
  [[nodiscard]] std::string functionHint(const std::string& function) const {
    if (function == "for") return "write i = 0; while (i < 3) { ...; i = i+1; }";
    if (function == "rand" || function == "ran") return "random(low, high) draws a number between the two";
    return didYouMean(function, functionNames_);
  }
  void call(const Call& n, SourceSpan where) {
    const auto words = functionWords();
    const auto word = std::find_if(words.begin(), words.end(), [&](const FunctionWord& w) { return w.name == n.function; });
    if (word == words.end()) return report_.error(where, "unknown function '" + n.function + "'", functionHint(n.function));
    if (word->since11)
      since11(n.function == "random" || n.function == "normal" ? "random numbers" : "functions such as " + n.function, where);
    const auto count = static_cast<int>(n.arguments.size());
    if (count >= word->fewest && (word->most < 0 || count <= word->most)) {
      return;
    }
    const std::string wanted = (word->fewest == word->most ? "" : "at least ") + std::to_string(word->fewest);
    report_.error(where, "'" + n.function + "' takes " + wanted + (word->fewest == 1 ? " argument" : " arguments") + ", not " +
                             std::to_string(count));
  }

  // ---- what nothing ever reaches ----

  /// Rules that rules above them or their own condition keep from firing, and rules for modules that nothing makes.
  void neverFired(const std::vector<Production>& productions) {
    const auto unreached = unreachedRules(grammar_, productions, Order::FirstThatFits);
    for (std::size_t i = 0; i < productions.size(); ++i) {
      const Production& p = productions[i];
      if (p.predecessor.empty()) continue;
      const std::string module = printModule(grammar_, p.predecessor[0]);
      if (unreached[i] == Unreached::ByItsCondition) {
        report_.warning(p.where, "the rule never fires: its condition never holds", "compare again, or leave the rule out");
      } else if (unreached[i] == Unreached::ByRulesAbove) {
        report_.warning(p.where, p.condition ? "the rule never fires: rules above rewrite every " + module + " for which its condition holds" : "the rule never fires: a rule above rewrites every " + module,
                        "move it up, or for a choice write both successors in one rule with weights");
      } else if (p.predecessor.size() == 1 && isNeverMade(p.predecessor[0])) {
        report_.warning(p.where, "the rule never fires: nothing makes " + module);
      }
    }
  }
  bool isNeverMade(const Module& m) const {
    const auto use = uses_.find(m.letter);
    if (use == uses_.end() || use->second.madeByValue || !organOfLetter(m.letter)) return false;
    if (use->second.made.empty()) return true;
    const Number* number = m.arguments.empty() ? nullptr : numberIn(grammar_, m.arguments[0]);
    return number && !use->second.made.contains(number->value);
  }
  void unusedStages(const PlantGrammar& p) {
    for (const OrganBlock& o : p.organs) {
      const LetterUse& use = uses_[letterOf(o.kind)];
      if (use.madeByValue) continue;
      for (const Stage& s : o.stages)
        if (!use.made.contains(s.number))
          report_.warning(s.where, std::string(keywordOf(o.kind)) + " Stage " + std::to_string(s.number) + " is never used",
                          "no rule makes " + std::string(letterOf(o.kind)) + "(" + std::to_string(s.number) + ")");
    }
  }

  const Grammar& grammar_;
  bool is10_;
  Report report_;
  std::vector<std::string_view> attributeNames_;
  std::vector<std::string_view> functionNames_;
  std::vector<std::string_view> letterNames_;
  std::unordered_set<std::string_view> usedNames_;
  std::set<std::string> toldFeatures_;
  std::map<std::string, std::set<double>> stages_;
  std::map<std::pair<std::string, double>, std::size_t> stageArguments_;  ///< how many further arguments a stage names
  std::map<std::string, LetterUse> uses_;
  std::map<std::string, std::unordered_map<double, bool>> answered_;
  std::unordered_set<std::string_view> arrays_;
  std::set<std::string_view> globals_;
  std::set<std::string_view> environment_;
};

}  // namespace

std::vector<Diagnostic> check(const Grammar& grammar) {
  return grammar.language == Language::LSystem ? checkLSystem(grammar) : Checker(grammar).run();
}

}  // namespace axil::simeco
