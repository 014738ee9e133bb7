#pragma once
/// \file
/// Rules and whole L-systems: the uppermost layer of compiling a grammar. Private to program.cpp.

#include "simeco/program_statements.hpp"

namespace axil::simeco {

class Compiler : protected StatementCompiler {
 public:
  using StatementCompiler::StatementCompiler;

  void plant(std::size_t index) {
    const PlantGrammar& plant = grammar_.plants[index];
    plant_ = index;
    readEnvironment(grammar_.attributes);
    readEnvironment(plant.attributes);
    internAll(plant.rules);
    for (const RuleSet& rules : plant.subRules) internAll(rules);
    describeSymbols();
    program_.systems.resize(1 + plant.subRules.size());
    compileSystem(plant.rules, program_.systems[0]);
    for (std::size_t i = 0; i < plant.subRules.size(); ++i) compileSystem(plant.subRules[i], program_.systems[i + 1]);
    listRules();
  }

  Term single(ExprId id, const std::vector<std::string>& locals) {
    readEnvironment(grammar_.attributes);
    program_.systems.resize(1);
    Scope scope{{}, &program_.systems[0]};
    for (std::size_t i = 0; i < locals.size(); ++i) scope.locals.emplace(locals[i], static_cast<std::uint16_t>(i));
    return term(id, scope);
  }

  /// Gives every rule its id, and says what draws.
  void listRules() {
    for (std::size_t system = 0; system < program_.systems.size(); ++system) {
      System& s = program_.systems[system];
      program_.draws = program_.draws || s.stochastic || s.productions.draws || s.decomposition.draws;
      program_.imageDraws = program_.imageDraws || s.homomorphism.draws;
      for (auto& [kind, table] : {std::pair{RuleKind::Production, &s.productions}, {RuleKind::Decomposition, &s.decomposition},
                                  {RuleKind::Homomorphism, &s.homomorphism}, {RuleKind::Interaction, &s.interaction}})
        for (CompiledRule& rule : table->rules) {
          rule.id = static_cast<std::uint32_t>(program_.rules.size());
          program_.rules.push_back({kind, plant_, system, rule.number, rule.where, rule.name});
        }
    }
    program_.draws = program_.draws || program_.imageDraws || program_.systems[0].interaction.draws;
  }

  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
  [[nodiscard]] std::shared_ptr<const Program> take() {
    program_.symbols = std::make_shared<const std::vector<Symbol>>(symbols_);
    return std::make_shared<const Program>(std::move(program_));
  }

 private:
  // ---- rules -------------------------------------------------------------------------------------------------------

  std::string describe(const Production& production) const {
    std::string text;
    for (const Module& module : production.predecessor) text += describe(module);
    text += grammar_.language == Language::SimEco ? " -> " : " --> ";
    constexpr std::size_t enough = 60;
    if (production.successors.empty()) return text + "*";
    for (const Module& module : production.successors.front().modules) {
      if (text.size() > enough) return text + "...";
      text += describe(module);
    }
    return text;
  }
  std::string describe(const Module& module) const {
    std::string text = module.letter;
    for (std::size_t i = 0; i < module.arguments.size(); ++i) {
      text += i == 0 ? "(" : ",";
      const ExprNode& node = grammar_.at(module.arguments[i]).node;
      if (const auto* number = std::get_if<Number>(&node))
        text += shortest(number->value);
      else if (const auto* variable = std::get_if<Name>(&node))
        text += variable->name;
      else
        text += "...";
    }
    return module.arguments.empty() ? text : text + ")";
  }

  Pattern pattern(const Module& module, Scope& scope, std::uint16_t& frame) {
    Pattern p;
    p.code = codeOf(module);
    p.slot = frame;
    for (std::size_t i = 0; i < module.arguments.size(); ++i) {
      const auto* formal = std::get_if<Name>(&grammar_.at(module.arguments[i]).node);
      if (formal != nullptr) {
        if (!scope.locals.emplace(formal->name, static_cast<std::uint16_t>(frame + i)).second)
          error("two parameters are called " + formal->name);
      } else if (tooDeep(module.arguments[i])) {
        continue;
      } else if (const auto value = constantOf(module.arguments[i], {})) {
        p.demands.push_back({static_cast<std::uint16_t>(i), *value});
      } else {
        error("the parameters of a predecessor or context are names or numbers");
      }
    }
    frame = static_cast<std::uint16_t>(frame + module.arguments.size());
    return p;
  }

  CompiledRule rule(const Production& production, const System& system, std::uint32_t number) {
    CompiledRule r;
    r.number = number;
    r.name = describe(production);
    r.where = production.where;
    if (const std::string line = lineOf(grammar_, production.where); !line.empty()) r.name += " (" + line + ")";
    where_ = "in the rule " + r.name + ": ";
    Scope scope{{}, &system};
    std::size_t bound = 0;
    for (const auto* modules : {&production.predecessor, &production.left, &production.right})
      for (const Module& module : *modules) bound += module.arguments.size();
    if (bound > 1000) {
      error("more than 1000 parameters in one rule");
      return r;
    }
    for (const Module& module : production.predecessor) r.predecessor.push_back(pattern(module, scope, r.frame));
    for (auto module = production.left.rbegin(); module != production.left.rend(); ++module) r.left.push_back(pattern(*module, scope, r.frame));
    for (const Module& module : production.right) rightPattern(module, r, scope);
    r.bound = r.frame;
    addLocals(production, system, scope, r);
    random_ = effects_ = false;
    r.statements = !production.before.empty() || !production.after.empty();
    r.before = blockCode(production.before, scope);
    if (production.condition) {
      r.hasCondition = true;
      r.condition = term(*production.condition, scope);
      if (r.condition.kind == Term::Kind::Constant && r.condition.value != 0) r.hasCondition = false;
    }
    r.randomCondition = random_;
    r.after = blockCode(production.after, scope);
    for (const Successor& s : production.successors) r.successors.push_back(successor(s, scope));
    if (r.successors.empty()) r.successors.emplace_back();
    r.random = random_ || r.successors.size() > 1;
    r.statements = r.statements || effects_;
    where_.clear();
    return r;
  }
  void rightPattern(const Module& module, CompiledRule& r, Scope& scope) {
    if (module.letter == "=" && module.arguments.empty()) {
      r.right.emplace_back().kind = Pattern::Kind::SkipRest;
      r.simpleRight = false;
      return;
    }
    r.right.push_back(pattern(module, scope, r.frame));
    if (module.letter == "[" || module.letter == "]") r.simpleRight = false;
  }
  void addLocals(const Production& production, const System& system, Scope& scope, CompiledRule& r) {
    std::vector<std::string> names;
    assignedNames(production.before, names);
    assignedNames(production.after, names);
    for (const std::string& variable : names)
      if (!scope.locals.contains(variable) && !indexIn(system.globals, variable)) {
        if (r.frame >= 60000) return error("too many variables in one rule");
        scope.locals.emplace(variable, r.frame++);
      }
  }

  static std::vector<std::uint64_t> keysOf(const std::vector<Module>& modules) {
    std::map<std::pair<std::string, std::size_t>, std::size_t> seen;
    std::vector<std::uint64_t> keys;
    for (const Module& module : modules)
      keys.push_back(childKey(module.letter, module.arguments.size(), seen[{module.letter, module.arguments.size()}]++));
    return keys;
  }
  CompiledSuccessor successor(const Successor& source, const Scope& scope) {
    CompiledSuccessor s;
    for (const Module& module : source.modules) {
      s.codes.push_back(codeOf(module));
      for (const ExprId argument : module.arguments) s.terms.push_back(term(argument, scope));
    }
    for (const Term& t : s.terms) {
      s.constant = s.constant && t.kind == Term::Kind::Constant;
      s.values.push_back(t.value);
    }
    s.keys = keysOf(source.modules);
    s.weight = source.weight ? term(*source.weight, scope) : Term{.value = 1};
    return s;
  }

  RuleTable table(const std::vector<Production>& productions, const System& system) {
    RuleTable t;
    t.bySymbol.resize(symbols_.size());
    for (const Production& production : productions) {
      if (production.predecessor.empty()) {
        error("a rule has no predecessor");
        continue;
      }
      t.rules.push_back(rule(production, system, static_cast<std::uint32_t>(t.rules.size())));
      t.draws = t.draws || t.rules.back().random || t.rules.back().randomCondition;
      t.bySymbol[t.rules.back().predecessor.front().code].all.push_back(static_cast<std::uint32_t>(t.rules.size() - 1));
    }
    for (RuleIndex& index : t.bySymbol) number(index, t);
    return t;
  }
  /// Where a symbol has many rules for one number each, looks them up by that number; text order stays.
  static void number(RuleIndex& index, const RuleTable& t) {
    constexpr std::size_t few = 6;
    if (index.all.size() < few) return;
    const auto demanded = [&](std::uint32_t r) -> std::optional<double> {
      for (const Demand& demand : t.rules[r].predecessor.front().demands)
        if (demand.offset == 0) return demand.value;
      return std::nullopt;
    };
    for (const std::uint32_t r : index.all) {
      const auto value = demanded(r);
      if (value) {
        const auto list = index.byNumber.try_emplace(bitsOf(*value), index.otherwise).first;
        list->second.push_back(r);
      } else {
        index.otherwise.push_back(r);
        for (auto& [bits, list] : index.byNumber) list.push_back(r);
      }
    }
    index.numbered = !index.byNumber.empty();
  }

  RuleTable table(const std::optional<SubRules>& rules, const System& system) {
    if (!rules) {
      RuleTable none;
      none.bySymbol.resize(symbols_.size());
      return none;
    }
    RuleTable t = table(rules->productions, system);
    t.maximumDepth = rules->maximumDepth;
    t.seed = rules->seed;
    t.warn = rules->warnAtMaximumDepth;
    return t;
  }

  // ---- L-systems ---------------------------------------------------------------------------------------------------

  void compileSystem(const RuleSet& rules, System& system) {
    system.label = rules.label;
    system.ring = rules.ring;
    system.seed = rules.seed;
    system.stochastic = rules.seed.has_value() && program_.language == Language::LSystem;  // in SimEco the first rule that fits fires
    system.externals = rules.externals;
    for (const Block* b : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) assignedNames(*b, system.globals);
    for (const std::string& external : rules.externals)
      if (!indexIn(system.globals, external)) system.globals.push_back(external);
    describeFilter(rules.filter, system);
    declareArrays(rules, system);
    const Scope scope{{}, &system};
    system.start = headerCode(rules.start, scope, "in the Start block: ");
    system.startEach = headerCode(rules.startEach, scope, "in the StartEach block: ");
    system.endEach = headerCode(rules.endEach, scope, "in the EndEach block: ");
    system.end = headerCode(rules.end, scope, "in the End block: ");
    where_ = "in the axiom: ";
    for (const Module& module : rules.axiom) {
      system.axiomCodes.push_back(codeOf(module));
      for (const ExprId argument : module.arguments) system.axiomTerms.push_back(term(argument, scope));
    }
    system.axiomKeys = keysOf(rules.axiom);
    where_ = "in the derivation length: ";
    if (rules.derivationLength) system.derivationLength = term(*rules.derivationLength, scope);
    where_.clear();
    system.productions = table(rules.productions, system);
    system.decomposition = table(rules.decomposition, system);
    system.homomorphism = table(rules.homomorphism, system);
    system.interaction = table(rules.interaction, system);
  }
  Code headerCode(const Block& statements, const Scope& scope, const char* where) {
    where_ = where;
    const Code c = blockCode(statements, scope);
    where_.clear();
    return c;
  }
  void describeFilter(const ContextFilter& filter, System& system) const {
    if (filter.mode == ContextFilter::Mode::None) return;
    for (std::size_t code = 0; code < symbols_.size(); ++code) {
      if (program_.opens[code] || program_.closes[code]) continue;
      const bool listed = indexIn(filter.letters, symbols_[code].letter).has_value();
      system.ignored[code] = listed == (filter.mode == ContextFilter::Mode::Ignore);
    }
  }
  void declareArrays(const RuleSet& rules, System& system) {
    constexpr std::size_t most = 10'000'000;
    for (const ArrayDeclaration& declaration : rules.arrays) {
      ArrayLayout layout{declaration.name, declaration.sizes, system.arrayElements, {}};
      std::size_t elements = 1;
      for (const int size : declaration.sizes) elements = size > 0 && elements <= most ? elements * static_cast<std::size_t>(size) : most + 1;
      if (elements > most || declaration.sizes.empty()) {
        error("array " + declaration.name + " must have between 1 and " + std::to_string(most) + " elements");
        continue;
      }
      where_ = "in the array " + declaration.name + ": ";
      const Scope scope{{}, &system};
      for (const ExprId value : declaration.initial) layout.initial.push_back(term(value, scope));
      layout.initial.resize(std::min(layout.initial.size(), elements));
      where_.clear();
      system.arrayElements += elements;
      system.arrays.push_back(std::move(layout));
    }
  }

  std::size_t plant_ = 0;
};

}  // namespace axil::simeco
