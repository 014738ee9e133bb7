#pragma once
/// \file
/// Statements become instructions. Private to program.cpp.

#include "simeco/program_expressions.hpp"

namespace axil::simeco {

class StatementCompiler : protected ExpressionCompiler {
 protected:
  using ExpressionCompiler::ExpressionCompiler;

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
};

}  // namespace axil::simeco
