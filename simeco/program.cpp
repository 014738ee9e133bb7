#include "simeco/program.hpp"

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "simeco/engine_arithmetic.hpp"
#include "simeco/lsystem_files.hpp"
#include "simeco/engine_identity.hpp"

#include <bit>
#include <map>
#include <set>

namespace axil::simeco {

namespace {

constexpr FunctionRow kBoth[] = {{"exp", 1, Function::Exp},   {"log", 1, Function::Log},     {"sqrt", 1, Function::Sqrt},
                                 {"floor", 1, Function::Floor}, {"ceil", 1, Function::Ceil}, {"sign", 1, Function::Sign}};
constexpr FunctionRow kSimeco[] = {{"sin", 1, Function::Sin},       {"cos", 1, Function::Cos},     {"tan", 1, Function::Tan},
                                   {"asin", 1, Function::Asin},     {"acos", 1, Function::Acos},   {"atan", 1, Function::Atan},
                                   {"atan2", 2, Function::Atan2},   {"abs", 1, Function::Absolute}, {"round", 1, Function::Round},
                                   {"min", 2, Function::Minimum},   {"max", 2, Function::Maximum}, {"pow", 2, Function::Power},
                                   {"random", 2, Function::Random}, {"normal", 2, Function::Normal}};
constexpr FunctionRow kClassic[] = {{"sin", 1, Function::SinDegrees},   {"cos", 1, Function::CosDegrees},   {"tan", 1, Function::TanDegrees},
                                    {"asin", 1, Function::AsinDegrees}, {"acos", 1, Function::AcosDegrees}, {"atan", 1, Function::AtanDegrees},
                                    {"atan2", 2, Function::Atan2Degrees}, {"fabs", 1, Function::Absolute},  {"trunc", 1, Function::Round},
                                    {"ran", 1, Function::Ran},          {"nran", 2, Function::Nran},        {"bran", 2, Function::Bran},
                                    {"biran", 2, Function::Biran},      {"srand", 1, Function::SeedRandom}, {"stop", 1, Function::Stop},
                                    {"SetDerivationLength", 1, Function::SetLength}, {"GetDerivationLength", 1, Function::GetLength}};

Op opOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Add: return Op::Add;
    case BinaryOp::Subtract: return Op::Subtract;
    case BinaryOp::Multiply: return Op::Multiply;
    case BinaryOp::Divide: return Op::Divide;
    case BinaryOp::Remainder: return Op::Remainder;
    case BinaryOp::Power: return Op::Power;
    case BinaryOp::Less: return Op::Less;
    case BinaryOp::LessEqual: return Op::LessEqual;
    case BinaryOp::Greater: return Op::Greater;
    case BinaryOp::GreaterEqual: return Op::GreaterEqual;
    case BinaryOp::Equal: return Op::Equal;
    case BinaryOp::NotEqual: return Op::NotEqual;
    case BinaryOp::And:
    case BinaryOp::Or: break;
  }
  AXIL_ASSERT(false, "&& and || are jumps, not operators");
  return Op::Add;
}

bool isComparison(Op op) { return op >= Op::Less && op <= Op::NotEqual; }

/// -0 and 0 are one number where rules are looked up by it.
std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value); }

/// Which names mean what, inside one rule or block.
struct Scope {
  std::map<std::string, std::uint16_t, std::less<>> locals;
  const System* system = nullptr;
};

std::optional<std::int32_t> indexIn(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::int32_t>(found - names.begin());
}

class Compiler {
 public:
  Compiler(const Grammar& grammar, const CompileOptions& options) : grammar_(grammar), options_(options) { program_.language = grammar.language; }

  void plant(std::size_t index) {
    const PlantGrammar& plant = grammar_.plants[index];
    plant_ = index;
    readEnvironment(grammar_.attributes);
    readEnvironment(plant.attributes);
    internAll(plant.rules);
    for (const RuleSet& rules : plant.subRules) internAll(rules);
    // What is detached goes on behind a module of its own.
    if (codes_.contains({"%", 1})) (void)codeOf("%", 2);
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
  void error(std::string message) {
    if (std::find(errors_.begin(), errors_.end(), message) == errors_.end()) errors_.push_back(where_ + std::move(message));
  }
  void warning(const std::string& message) {
    const std::string text = where_ + message;
    if (std::find(program_.warnings.begin(), program_.warnings.end(), text) == program_.warnings.end()) program_.warnings.push_back(text);
  }

  // ---- symbols -----------------------------------------------------------------------------------------------------

  SymbolCode codeOf(const std::string& letter, std::size_t parameters) {
    const std::pair<std::string, std::size_t> key{letter, parameters};
    if (const auto known = codes_.find(key); known != codes_.end()) return known->second;
    if (parameters > 255) {
      error("module " + letter + " has " + std::to_string(parameters) + " parameters; at most 255 are possible");
      return 0;
    }
    if (symbols_.size() >= maximumSymbols) {
      error("more than " + std::to_string(maximumSymbols) + " different modules (a letter with a number of parameters); use fewer letters");
      return 0;
    }
    const auto code = static_cast<SymbolCode>(symbols_.size());
    symbols_.push_back({letter, static_cast<int>(parameters)});
    codes_.emplace(key, code);
    return code;
  }
  SymbolCode codeOf(const Module& module) { return codeOf(module.letter, module.arguments.size()); }

  void intern(const std::vector<Module>& modules) {
    for (const Module& module : modules) (void)codeOf(module);
  }
  void intern(const std::vector<Production>& productions) {
    for (const Production& production : productions) {
      intern(production.left);
      intern(production.predecessor);
      intern(production.right);
      for (const Successor& successor : production.successors) intern(successor.modules);
    }
  }
  void internAll(const RuleSet& rules) {
    intern(rules.axiom);
    intern(rules.productions);
    intern(rules.interaction);
    if (rules.decomposition) intern(rules.decomposition->productions);
    if (rules.homomorphism) intern(rules.homomorphism->productions);
  }
  void describeSymbols() {
    for (std::size_t code = 0; code < symbols_.size(); ++code) {
      const Symbol& symbol = symbols_[code];
      program_.parameterCount[code] = static_cast<std::uint8_t>(symbol.parameters);
      program_.opens[code] = symbol.letter == "[";
      program_.closes[code] = symbol.letter == "]";
      if (symbol.letter == "%" && symbol.parameters == 0) program_.cut = static_cast<int>(code);
      if (symbol.letter == "%" && symbol.parameters == 1) program_.detach = static_cast<int>(code);
      if (symbol.letter == "%" && symbol.parameters == 2) program_.detached = static_cast<int>(code);
      if (symbol.letter == "?" && symbol.parameters == 2) program_.enter = static_cast<int>(code);
      if (symbol.letter == "$" && symbol.parameters == 0) program_.leave = static_cast<int>(code);
    }
  }

  // ---- expressions -------------------------------------------------------------------------------------------------

  void readEnvironment(const std::vector<Attribute>& attributes) {
    if (grammar_.language != Language::SimEco) return;
    for (const Attribute& attribute : attributes)
      if (depthOf(attribute.value, options_.expressionDepth) <= options_.expressionDepth)
        if (const auto value = constantOf(attribute.value, {})) environment_[attribute.name] = *value;
  }

  /// Of the expression, or more than `limit` when it is deeper than that.
  int depthOf(ExprId id, int limit) const {
    if (limit <= 0) return 1;
    int deepest = 0;
    for (const ExprId child : childrenOf(id)) {
      deepest = std::max(deepest, depthOf(child, limit - 1));
      if (deepest > limit - 1) break;
    }
    return 1 + deepest;
  }
  std::vector<ExprId> childrenOf(ExprId id) const {
    return std::visit(overloaded{[](const Number&) { return std::vector<ExprId>{}; }, [](const Name&) { return std::vector<ExprId>{}; },
                                 [](const Text&) { return std::vector<ExprId>{}; }, [](const Unary& x) { return std::vector<ExprId>{x.operand}; },
                                 [](const Binary& x) { return std::vector<ExprId>{x.left, x.right}; },
                                 [](const Chain& x) { return x.operands; },
                                 [](const Conditional& x) { return std::vector<ExprId>{x.condition, x.yes, x.no}; },
                                 [](const Call& x) { return x.arguments; }, [](const Element& x) { return x.indices; }},
                      grammar_.at(id).node);
  }

  const FunctionRow* functionNamed(const std::string& name) const {
    const auto search = [&](const auto& rows) -> const FunctionRow* {
      for (const FunctionRow& row : rows)
        if (name == row.name) return &row;
      return nullptr;
    };
    if (const FunctionRow* row = search(kBoth)) return row;
    return grammar_.language == Language::SimEco ? search(kSimeco) : search(kClassic);
  }

  bool isVariable(const std::string& name, const Scope& scope) const {
    return scope.locals.contains(name) || (scope.system != nullptr && indexIn(scope.system->globals, name).has_value());
  }

  /// The value of an expression that no variable, draw or host can change.
  std::optional<double> constantOf(ExprId id, const Scope& scope) const {
    using Value = std::optional<double>;
    return std::visit(overloaded{
                          [](const Number& x) -> Value { return x.value; },
                          [&](const Name& x) -> Value {
                            const auto found = environment_.find(x.name);
                            return found == environment_.end() || isVariable(x.name, scope) ? Value{} : Value{found->second};
                          },
                          [](const Text&) -> Value { return {}; },
                          [&](const Unary& x) -> Value {
                            const Value v = constantOf(x.operand, scope);
                            if (!v) return {};
                            return x.op == UnaryOp::Minus ? -*v : (*v == 0 ? 1.0 : 0.0);
                          },
                          [&](const Binary& x) -> Value { return constantBinary(x, scope); },
                          [&](const Chain& x) -> Value { return constantChain(x, scope); },
                          [&](const Conditional& x) -> Value {
                            const Value c = constantOf(x.condition, scope);
                            if (!c) return {};
                            return constantOf(*c != 0 ? x.yes : x.no, scope);
                          },
                          [&](const Call& x) -> Value { return constantCall(x, scope); },
                          [](const Element&) -> Value { return {}; },
                      },
                      grammar_.at(id).node);
  }
  std::optional<double> constantBinary(const Binary& x, const Scope& scope) const {
    const auto a = constantOf(x.left, scope);
    if (!a) return {};
    if (x.op == BinaryOp::And && *a == 0) return 0.0;
    if (x.op == BinaryOp::Or && *a != 0) return 1.0;
    const auto b = constantOf(x.right, scope);
    if (!b) return {};
    if (x.op == BinaryOp::And || x.op == BinaryOp::Or) return *b != 0 ? 1.0 : 0.0;
    const Op op = opOf(x.op);
    if (dividesByZero(op, *b)) return {};
    return arithmetic(op, *a, *b);
  }
  std::optional<double> constantChain(const Chain& x, const Scope& scope) const {
    std::vector<double> values;
    for (const ExprId operand : x.operands) {
      const auto value = constantOf(operand, scope);
      if (!value) return {};
      values.push_back(*value);
    }
    for (std::size_t i = 0; i < x.comparisons.size(); ++i)
      if (!compared(opOf(x.comparisons[i]), values[i], values[i + 1])) return 0.0;
    return 1.0;
  }
  std::optional<double> constantCall(const Call& x, const Scope& scope) const {
    const FunctionRow* row = functionNamed(x.function);
    if (row == nullptr || static_cast<std::size_t>(row->arguments) != x.arguments.size()) return {};
    double values[2] = {0, 0};
    for (std::size_t i = 0; i < x.arguments.size(); ++i) {
      const auto value = constantOf(x.arguments[i], scope);
      if (!value) return {};
      values[i] = *value;
    }
    return pureFunction(row->function, values);
  }

  std::int32_t here() const { return static_cast<std::int32_t>(program_.instructions.size()); }
  void emit(Op op, int pushed, std::int32_t index = 0, std::size_t count = 0, double value = 0) {
    program_.instructions.push_back({op, static_cast<std::uint8_t>(count), index, value});
    depth_ += pushed;
    deepest_ = std::max(deepest_, depth_);
  }
  std::int32_t emitJump(Op op) {
    emit(op, op == Op::JumpIfZero ? -1 : 0, -1);
    return here() - 1;
  }
  void land(std::int32_t jump) { program_.instructions[static_cast<std::size_t>(jump)].index = here(); }

  void expression(ExprId id, const Scope& scope) {
    if (const auto value = constantOf(id, scope)) return emit(Op::Constant, 1, 0, 0, *value);
    std::visit(overloaded{
                   [](const Number&) {}, [&](const Name& x) { name(x.name, scope); },
                   [&](const Text&) {
                     error("a quoted text stands where a number is needed");
                     emit(Op::Constant, 1);
                   },
                   [&](const Unary& x) {
                     expression(x.operand, scope);
                     emit(x.op == UnaryOp::Minus ? Op::Minus : Op::Not, 0);
                   },
                   [&](const Binary& x) { binary(x, scope); }, [&](const Chain& x) { chain(x, scope); },
                   [&](const Conditional& x) { conditional(x, scope); }, [&](const Call& x) { call(x, scope); },
                   [&](const Element& x) { element(x.array, x.indices, scope, Op::Element); },
               },
               grammar_.at(id).node);
  }

  void name(const std::string& variable, const Scope& scope) {
    if (const auto local = scope.locals.find(variable); local != scope.locals.end()) return emit(Op::Local, 1, local->second);
    if (scope.system != nullptr)
      if (const auto global = indexIn(scope.system->globals, variable)) return emit(Op::Global, 1, *global);
    if (grammar_.language == Language::SimEco)
      error("nothing is called " + variable + " here; name a parameter of the predecessor or its contexts, or an attribute");
    else
      warning("nothing is assigned to " + variable + "; it is 0");
    emit(Op::Constant, 1);
  }

  void binary(const Binary& x, const Scope& scope) {
    expression(x.left, scope);
    if (x.op == BinaryOp::And || x.op == BinaryOp::Or) return logic(x, scope);
    expression(x.right, scope);
    emit(opOf(x.op), -1);
  }
  /// The right side is only looked at when the left one does not decide.
  void logic(const Binary& x, const Scope& scope) {
    if (x.op == BinaryOp::Or) emit(Op::Not, 0);
    const std::int32_t decided = emitJump(Op::JumpIfZero);
    expression(x.right, scope);
    emit(Op::Truth, 0);
    const std::int32_t done = emitJump(Op::Jump);
    land(decided);
    --depth_;
    emit(Op::Constant, 1, 0, 0, x.op == BinaryOp::Or ? 1 : 0);
    land(done);
  }
  void chain(const Chain& x, const Scope& scope) {
    std::vector<std::int32_t> failed;
    for (std::size_t i = 0; i < x.comparisons.size(); ++i) {
      expression(x.operands[i], scope);
      expression(x.operands[i + 1], scope);
      emit(opOf(x.comparisons[i]), -1);
      failed.push_back(emitJump(Op::JumpIfZero));
    }
    emit(Op::Constant, 1, 0, 0, 1);
    const std::int32_t done = emitJump(Op::Jump);
    --depth_;
    for (const std::int32_t jump : failed) land(jump);
    emit(Op::Constant, 1);
    land(done);
  }
  void conditional(const Conditional& x, const Scope& scope) {
    expression(x.condition, scope);
    const std::int32_t otherwise = emitJump(Op::JumpIfZero);
    expression(x.yes, scope);
    const std::int32_t done = emitJump(Op::Jump);
    --depth_;
    land(otherwise);
    expression(x.no, scope);
    land(done);
  }

  void element(const std::string& array, const std::vector<ExprId>& indices, const Scope& scope, Op op) {
    const auto& arrays = scope.system->arrays;
    const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const ArrayLayout& a) { return a.name == array; });
    if (found == arrays.end())
      error("no array is called " + array + "; declare it in a define block");
    else if (found->sizes.size() != indices.size())
      error("array " + array + " has " + std::to_string(found->sizes.size()) + " indices, not " + std::to_string(indices.size()));
    for (const ExprId index : indices) expression(index, scope);
    const int consumed = static_cast<int>(indices.size());
    emit(op, op == Op::Element ? 1 - consumed : -1 - consumed, static_cast<std::int32_t>(found - arrays.begin()), indices.size());
  }

  void call(const Call& x, const Scope& scope) {
    if (x.arguments.size() > 250) return error("function " + x.function + " has more than 250 arguments");
    if (x.function == "func") return hostFunction(x, scope);
    if (x.function == "com") return hostExchange(x, scope);
    if (x.function == "printf" && grammar_.language == Language::LSystem) return hostPrint(x, scope);
    if (grammar_.language == Language::LSystem && isSessionCall(x.function)) return sessionCall(x, scope);
    if (grammar_.language == Language::LSystem && (x.function == "fopen" || x.function == "fclose" || x.function == "fscanf")) return fileCall(x, scope);
    const FunctionRow* row = functionNamed(x.function);
    const int arguments = static_cast<int>(x.arguments.size());
    if (row == nullptr)
      error("no function is called " + x.function);
    else if (row->arguments != arguments)
      error("function " + x.function + " takes " + std::to_string(row->arguments) + " argument" + (row->arguments == 1 ? "" : "s") + ", not " +
            std::to_string(arguments));
    for (const ExprId argument : x.arguments) expression(argument, scope);
    if (row != nullptr && (drawsRandom(row->function))) random_ = true;
    if (row != nullptr && row->function >= Function::SeedRandom) effects_ = true;
    emit(Op::Call, 1 - arguments, row == nullptr ? 0 : static_cast<std::int32_t>(row->function), x.arguments.size());
  }
  void hostFunction(const Call& x, const Scope& scope) {
    if (x.arguments.empty()) return error("func needs the number of the function first: func(1, x)");
    effects_ = true;
    for (const ExprId argument : x.arguments) expression(argument, scope);
    emit(Op::HostFunction, 1 - static_cast<int>(x.arguments.size()), 0, x.arguments.size());
  }
  /// com(x, y): the host may change the variables, so they are stored back from the last to the first.
  void hostExchange(const Call& x, const Scope& scope) {
    effects_ = true;
    for (const ExprId argument : x.arguments) expression(argument, scope);
    emit(Op::HostExchange, 0, 0, x.arguments.size());
    for (auto argument = x.arguments.rbegin(); argument != x.arguments.rend(); ++argument) {
      const Name* variable = std::get_if<Name>(&grammar_.at(*argument).node);
      if (variable == nullptr) error("com hands over variables, so each of its arguments must be a name");
      if (variable != nullptr) store(variable->name, scope);
    }
    emit(Op::Constant, 1);
  }
  /// What only a window or a written file would show: nothing happens, its arguments are computed and it is 0.
  static bool isSessionCall(const std::string& function) {
    static const std::set<std::string, std::less<>> kNames{"Display", "play", "fprintf", "fflush", "vvXmin", "vvXmax", "vvYmin", "vvYmax", "vvZmin", "vvZmax", "vvScale"};
    return kNames.contains(function);
  }
  void sessionCall(const Call& x, const Scope& scope) {
    effects_ = true;
    for (const ExprId argument : x.arguments) {
      if (std::holds_alternative<Text>(grammar_.at(argument).node)) continue;
      expression(argument, scope);
      emit(Op::Drop, -1);
    }
    emit(Op::Constant, 1);
  }
  /// fscanf stores what it read back, from the last variable to the first, and leaves how many there were.
  void fileCall(const Call& x, const Scope& scope) {
    effects_ = true;
    std::string text;
    for (const ExprId argument : x.arguments) {
      if (const Text* words = std::get_if<Text>(&grammar_.at(argument).node)) text += words->text + '\n';
      else expression(argument, scope);
    }
    program_.texts.push_back(text);
    const auto texts = std::count_if(x.arguments.begin(), x.arguments.end(), [&](ExprId id) { return std::holds_alternative<Text>(grammar_.at(id).node); });
    const std::size_t values = x.arguments.size() - static_cast<std::size_t>(texts);
    const FileCall call = x.function == "fopen" ? FileCall::Open : x.function == "fclose" ? FileCall::Close : FileCall::Scan;
    if (call == FileCall::Open ? texts != 2 : call == FileCall::Close ? values != 1 : (texts != 1 || values < 1)) return error(x.function + " is not called as it should be");
    emit(Op::HostFile, call == FileCall::Open ? 1 : 0, static_cast<std::int32_t>(program_.texts.size() - 1), values, static_cast<double>(call));
    for (std::size_t i = x.arguments.size(); call == FileCall::Scan && i-- > 2;) {
      const Name* variable = std::get_if<Name>(&grammar_.at(x.arguments[i]).node);
      if (variable == nullptr) error("fscanf reads into variables, so each of its further arguments must be a name");
      if (variable != nullptr) store(variable->name, scope);
      else emit(Op::Drop, -1);
    }
  }
  void hostPrint(const Call& x, const Scope& scope) {
    const Text* format = x.arguments.empty() ? nullptr : std::get_if<Text>(&grammar_.at(x.arguments[0]).node);
    if (format == nullptr) return error("printf needs a quoted format first");
    effects_ = true;
    for (std::size_t i = 1; i < x.arguments.size(); ++i) expression(x.arguments[i], scope);
    program_.texts.push_back(format->text);
    const auto count = x.arguments.size() - 1;
    emit(Op::HostPrint, 1 - static_cast<int>(count), static_cast<std::int32_t>(program_.texts.size() - 1), count);
  }

  Code code(ExprId id, const Scope& scope) {
    return recorded([&] { expression(id, scope); });
  }
  template <class Emit>
  Code recorded(Emit emitAll) {
    depth_ = deepest_ = 0;
    const std::int32_t first = here();
    emitAll();
    return {first, here(), deepest_ + 1};
  }

  bool tooDeep(ExprId id) {
    if (depthOf(id, options_.expressionDepth) <= options_.expressionDepth) return false;
    error("an expression is nested deeper than the limit of " + std::to_string(options_.expressionDepth));
    return true;
  }

  Term term(ExprId id, const Scope& scope) {
    if (tooDeep(id)) return {};
    // In SimEco a constant that is no finite number is left to the run, which says whose it is.
    const auto value = constantOf(id, scope);
    if (value && (std::isfinite(*value) || grammar_.language == Language::LSystem)) return {.value = *value};
    if (const auto slot = localOf(id, scope)) return {.kind = Term::Kind::Local, .slot = *slot};
    if (const auto quick = quickTerm(id, scope)) return *quick;
    program_.codes.push_back(code(id, scope));
    return {.kind = Term::Kind::Coded, .code = static_cast<std::int32_t>(program_.codes.size() - 1)};
  }
  std::optional<std::uint16_t> localOf(ExprId id, const Scope& scope) const {
    const Name* variable = std::get_if<Name>(&grammar_.at(id).node);
    if (variable == nullptr) return {};
    const auto local = scope.locals.find(variable->name);
    return local == scope.locals.end() ? std::nullopt : std::optional(local->second);
  }
  /// local + c, local - c, local * c, local / c, c + local, c * local, local < c and the like.
  std::optional<Term> quickTerm(ExprId id, const Scope& scope) const {
    const Binary* x = std::get_if<Binary>(&grammar_.at(id).node);
    if (x == nullptr || x->op == BinaryOp::And || x->op == BinaryOp::Or) return {};
    auto local = localOf(x->left, scope);
    auto value = constantOf(x->right, scope);
    if (!local && (x->op == BinaryOp::Add || x->op == BinaryOp::Multiply)) {
      local = localOf(x->right, scope);
      value = constantOf(x->left, scope);
    }
    if (!local || !value) return {};
    const Op op = opOf(x->op);
    if (op == Op::Add) return Term{.kind = Term::Kind::LocalPlus, .slot = *local, .value = *value};
    if (op == Op::Subtract) return Term{.kind = Term::Kind::LocalPlus, .slot = *local, .value = -*value};
    if (op == Op::Multiply) return Term{.kind = Term::Kind::LocalTimes, .slot = *local, .value = *value};
    if (op == Op::Divide && *value != 0) return Term{.kind = Term::Kind::LocalOver, .slot = *local, .value = *value};
    if (isComparison(op)) return Term{.kind = Term::Kind::LocalCompared, .comparison = op, .slot = *local, .value = *value};
    return {};
  }

  // ---- statements --------------------------------------------------------------------------------------------------

  void store(const std::string& variable, const Scope& scope) {
    if (const auto local = scope.locals.find(variable); local != scope.locals.end()) return emit(Op::StoreLocal, -1, local->second);
    if (const auto global = indexIn(scope.system->globals, variable)) return emit(Op::StoreGlobal, -1, *global);
    error("nothing is called " + variable + " here, so it cannot be given a value");
    emit(Op::Drop, -1);
  }
  void checkedExpression(ExprId id, const Scope& scope) {
    if (tooDeep(id))
      emit(Op::Constant, 1);
    else
      expression(id, scope);
  }
  void statement(const Statement& s, const Scope& scope, int nesting) {
    std::visit(overloaded{
                   [&](const Assign& x) {
                     checkedExpression(x.value, scope);
                     store(x.name, scope);
                   },
                   [&](const AssignElement& x) {
                     checkedExpression(x.value, scope);
                     for (const ExprId index : x.indices)
                       if (tooDeep(index)) return;
                     element(x.array, x.indices, scope, Op::StoreElement);
                   },
                   [&](const Evaluate& x) {
                     checkedExpression(x.value, scope);
                     emit(Op::Drop, -1);
                   },
                   [&](const If& x) {
                     checkedExpression(x.condition, scope);
                     const std::int32_t otherwise = emitJump(Op::JumpIfZero);
                     block(x.yes, scope, nesting);
                     const std::int32_t done = emitJump(Op::Jump);
                     land(otherwise);
                     block(x.no, scope, nesting);
                     land(done);
                   },
                   [&](const While& x) { loop(x, scope, nesting); },
               },
               s.node);
  }
  void loop(const While& x, const Scope& scope, int nesting) {
    const std::int32_t again = here();
    std::int32_t done = -1;
    if (x.testFirst) {
      checkedExpression(x.condition, scope);
      done = emitJump(Op::JumpIfZero);
    }
    block(x.body, scope, nesting);
    if (!x.testFirst) {
      checkedExpression(x.condition, scope);
      done = emitJump(Op::JumpIfZero);
    }
    emit(Op::LoopBack, 0, again);
    land(done);
  }
  void block(const Block& statements, const Scope& scope, int nesting) {
    if (nesting >= options_.expressionDepth) return error("statements are nested deeper than the limit of " + std::to_string(options_.expressionDepth));
    for (const Statement& s : statements) statement(s, scope, nesting + 1);
  }
  Code blockCode(const Block& statements, const Scope& scope) {
    if (statements.empty()) return {};
    return recorded([&] { block(statements, scope, 0); });
  }

  /// fscanf gives its variables a value.
  void scannedNames(ExprId id, std::vector<std::string>& names) const {
    const auto* call = std::get_if<Call>(&grammar_.at(id).node);
    if (call == nullptr || call->function != "fscanf") return;
    for (const ExprId argument : call->arguments)
      if (const auto* name = std::get_if<Name>(&grammar_.at(argument).node); name != nullptr && !indexIn(names, name->name)) names.push_back(name->name);
  }
  void assignedNames(const Block& statements, std::vector<std::string>& names) const {
    for (const Statement& s : statements) {
      if (const auto* assign = std::get_if<Assign>(&s.node)) {
        if (!indexIn(names, assign->name)) names.push_back(assign->name);
        scannedNames(assign->value, names);
      } else if (const auto* evaluated = std::get_if<Evaluate>(&s.node)) {
        scannedNames(evaluated->value, names);
      } else if (const auto* choice = std::get_if<If>(&s.node)) {
        assignedNames(choice->yes, names);
        assignedNames(choice->no, names);
      } else if (const auto* repeat = std::get_if<While>(&s.node)) {
        assignedNames(repeat->body, names);
      }
    }
  }

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
    s.hasWeight = source.weight.has_value();
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
    system.stochastic = rules.seed.has_value();
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
    if (grammar_.language == Language::LSystem && !rules.seed)
      for (const CompiledRule& r : system.productions.rules)
        if (r.successors.front().hasWeight) warning("the rule " + r.name + " has a probability, but without a seed: line it is not used");
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
      if (layout.initial.size() > elements) warning("more initial values than elements; the rest is not used");
      layout.initial.resize(std::min(layout.initial.size(), elements));
      where_.clear();
      system.arrayElements += elements;
      system.arrays.push_back(std::move(layout));
    }
  }

  const Grammar& grammar_;
  CompileOptions options_;
  Program program_;
  std::size_t plant_ = 0;
  std::vector<Symbol> symbols_;
  std::map<std::pair<std::string, std::size_t>, SymbolCode> codes_;
  std::map<std::string, double> environment_;
  std::vector<std::string> errors_;
  std::string where_;
  int depth_ = 0;
  int deepest_ = 0;
  bool random_ = false;
  bool effects_ = false;
};

Failure refused(const std::vector<std::string>& errors) {
  const std::string more = errors.size() > 1 ? " (and " + std::to_string(errors.size() - 1) + " more)" : "";
  return fail(Error{ErrorCode::BadGrammar, "the grammar cannot be run: " + errors.front() + more, errors});
}

}  // namespace

std::vector<FunctionRow> functionsOf(Language language) {
  std::vector<FunctionRow> rows(std::begin(kBoth), std::end(kBoth));
  if (language == Language::SimEco)
    rows.insert(rows.end(), std::begin(kSimeco), std::end(kSimeco));
  else
    rows.insert(rows.end(), std::begin(kClassic), std::end(kClassic));
  return rows;
}

Result<std::shared_ptr<const Program>> compile(const Grammar& grammar, std::size_t plant, const CompileOptions& options) {
  if (plant >= grammar.plants.size())
    return fail(ErrorCode::NotFound, "the grammar has " + std::to_string(grammar.plants.size()) + " plants; there is no plant number " +
                                         std::to_string(plant + 1));
  Compiler compiler(grammar, options);
  compiler.plant(plant);
  if (!compiler.errors().empty()) return refused(compiler.errors());
  return compiler.take();
}

Result<CompiledExpression> compileExpression(const Grammar& grammar, ExprId id, const std::vector<std::string>& locals, const CompileOptions& options) {
  Compiler compiler(grammar, options);
  const Term term = compiler.single(id, locals);
  if (!compiler.errors().empty()) return refused(compiler.errors());
  if (term.kind == Term::Kind::Constant) return CompiledExpression{nullptr, term};
  return CompiledExpression{compiler.take(), term};
}

}  // namespace axil::simeco
