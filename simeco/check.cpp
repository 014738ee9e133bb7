// What is wrong with a SimEco grammar that parsed. Every finding stands at the place that the author has to change. Its layers are
// check_expressions, check_attributes and check_modules.

#include "simeco/check_modules.hpp"
#include "simeco/check_reach.hpp"
#include "simeco/check_runaway.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"

namespace axil::simeco {

namespace {

class Checker : private checking::ModuleCheck {
 public:
  explicit Checker(const Grammar& grammar) : ModuleCheck(grammar) {}

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
  // ---- rules ----

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
      const checking::LetterUse& use = uses_[letterOf(o.kind)];
      if (use.madeByValue) continue;
      for (const Stage& s : o.stages)
        if (!use.made.contains(s.number))
          report_.warning(s.where, std::string(keywordOf(o.kind)) + " Stage " + std::to_string(s.number) + " is never used",
                          "no rule makes " + std::string(letterOf(o.kind)) + "(" + std::to_string(s.number) + ")");
    }
  }
};

}  // namespace

std::vector<Diagnostic> check(const Grammar& grammar) {
  return grammar.language == Language::LSystem ? checkLSystem(grammar) : Checker(grammar).run();
}

}  // namespace axil::simeco
