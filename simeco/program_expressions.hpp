#pragma once
/// \file
/// Expressions become instructions, terms or constants. Private to program.cpp.

#include "simeco/fold.hpp"
#include "simeco/lsystem_files.hpp"
#include "simeco/program_symbols.hpp"

namespace axil::simeco {

class ExpressionCompiler : protected SymbolCompiler {
 protected:
  using SymbolCompiler::SymbolCompiler;

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
    const auto ofName = [&](const std::string& name) -> Value {
      const auto found = environment_.find(name);
      return found == environment_.end() || isVariable(name, scope) ? Value{} : Value{found->second};
    };
    const auto ofCall = [&](const Call& call, const std::vector<double>& values) -> Value {
      const FunctionRow* row = functionNamed(call.function);
      return row == nullptr || static_cast<std::size_t>(row->arguments) != values.size() ? Value{} : pureFunction(row->function, values.data());
    };
    return Folding(grammar_, ofName, ofCall).at(id);
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
    emit(Op::Constant, 1);  // in the classic language 0, as `checkLSystem` warns
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

  void store(const std::string& variable, const Scope& scope) {
    if (const auto local = scope.locals.find(variable); local != scope.locals.end()) return emit(Op::StoreLocal, -1, local->second);
    if (const auto global = indexIn(scope.system->globals, variable)) return emit(Op::StoreGlobal, -1, *global);
    error("nothing is called " + variable + " here, so it cannot be given a value");
    emit(Op::Drop, -1);
  }

  std::map<std::string, double> environment_;  ///< attributes that are numbers
  int depth_ = 0;          ///< of the stack, where the code stands now
  int deepest_ = 0;
  bool random_ = false;    ///< what was compiled draws
  bool effects_ = false;   ///< it does something beside giving a number
};

}  // namespace axil::simeco
