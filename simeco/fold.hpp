#pragma once
/// \file
/// What an expression is worth before anything is derived, in one place for all who ask: the parser for seeds and depths, the checks
/// for rules that never fire, the compiler for the numbers it writes into a program. It computes as a running program does
/// (engine_arithmetic), so what is folded and what is run have the same bits. Internal to the room.

#include "base/overloaded.hpp"
#include "simeco/engine_arithmetic.hpp"
#include "simeco/grammar.hpp"
#include "simeco/vocabulary.hpp"

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

namespace axil::simeco {

/// Folds expressions of one grammar. `ValueOfName(name)` and `ValueOfCall(call, values)` give what a name and a function of known values
/// are worth, or nothing. A division by zero has no value: it ends the derivation where it is run.
template <class ValueOfName, class ValueOfCall>
class Folding {
 public:
  using Value = std::optional<double>;
  Folding(const Grammar& grammar, const ValueOfName& ofName, const ValueOfCall& ofCall) : grammar_(grammar), ofName_(ofName), ofCall_(ofCall) {}

  [[nodiscard]] Value at(ExprId id, int depth = 0) const {
    if (depth > kMostDepth) return {};
    return std::visit(overloaded{[](const Number& n) -> Value { return n.value; }, [&](const Name& n) -> Value { return ofName_(n.name); },
                                 [](const Text&) -> Value { return {}; }, [&](const Unary& n) { return unary(n, depth); },
                                 [&](const Binary& n) { return binary(n, depth); }, [&](const Chain& n) { return chain(n, depth); },
                                 [&](const Conditional& n) { return conditional(n, depth); }, [&](const Call& n) { return call(n, depth); },
                                 [](const Element&) -> Value { return {}; }},
                      grammar_.at(id).node);
  }

 private:
  [[nodiscard]] Value unary(const Unary& n, int depth) const {
    const Value v = at(n.operand, depth + 1);
    if (!v) return {};
    return n.op == UnaryOp::Minus ? -*v : (*v == 0 ? 1.0 : 0.0);
  }
  [[nodiscard]] Value binary(const Binary& n, int depth) const {
    const Value a = at(n.left, depth + 1);
    if (!a) return {};
    if (n.op == BinaryOp::And && *a == 0) return 0.0;
    if (n.op == BinaryOp::Or && *a != 0) return 1.0;
    const Value b = at(n.right, depth + 1);
    if (!b) return {};
    if (n.op == BinaryOp::And || n.op == BinaryOp::Or) return *b != 0 ? 1.0 : 0.0;
    const Op op = opOf(n.op);
    if (dividesByZero(op, *b)) return {};
    return arithmetic(op, *a, *b);
  }
  [[nodiscard]] Value chain(const Chain& n, int depth) const {
    std::vector<double> values;
    for (const ExprId operand : n.operands) {
      const Value value = at(operand, depth + 1);
      if (!value) return {};
      values.push_back(*value);
    }
    for (std::size_t i = 0; i < n.comparisons.size(); ++i)
      if (!compared(opOf(n.comparisons[i]), values[i], values[i + 1])) return 0.0;
    return 1.0;
  }
  [[nodiscard]] Value conditional(const Conditional& n, int depth) const {
    const Value c = at(n.condition, depth + 1);
    if (!c) return {};
    return at(*c != 0 ? n.yes : n.no, depth + 1);
  }
  [[nodiscard]] Value call(const Call& n, int depth) const {
    std::vector<double> values;
    for (const ExprId argument : n.arguments) {
      const Value value = at(argument, depth + 1);
      if (!value) return {};
      values.push_back(*value);
    }
    return ofCall_(n, values);
  }

  const Grammar& grammar_;
  const ValueOfName& ofName_;
  const ValueOfCall& ofCall_;
};

/// The value of `id`, whose names are worth what `ofName` says and whose functions are worth nothing.
template <class ValueOfName>
[[nodiscard]] std::optional<double> foldedBy(const Grammar& grammar, ExprId id, const ValueOfName& ofName) {
  const auto noCall = [](const Call&, const std::vector<double>&) -> std::optional<double> { return {}; };
  return Folding(grammar, ofName, noCall).at(id);
}

/// The value of `id` if it asks for nothing but its own numbers.
[[nodiscard]] inline std::optional<double> foldedAlone(const Grammar& grammar, ExprId id) {
  return foldedBy(grammar, id, [](const std::string&) -> std::optional<double> { return {}; });
}

}  // namespace axil::simeco
