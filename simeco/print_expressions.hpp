#pragma once
/// \file
/// The layers of the SimEco printer, second: expressions, with as few parentheses as mean the same. Private to print.cpp.

#include "simeco/print_lines.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace axil::simeco::printing {

// What an expression is as an operand: the higher, the closer it binds.
enum Binding { kChoice, kOr, kAnd, kCompare, kSum, kProduct, kUnary, kPower, kPrimary };

struct OperatorText {
  std::string_view text;
  Binding binding;
};
// In the order of BinaryOp.
inline constexpr std::array<OperatorText, 14> kOperators{{{"+", kSum},
                                                   {"-", kSum},
                                                   {"*", kProduct},
                                                   {"/", kProduct},
                                                   {"%", kProduct},
                                                   {"^", kPower},
                                                   {" < ", kCompare},
                                                   {" <= ", kCompare},
                                                   {" > ", kCompare},
                                                   {" >= ", kCompare},
                                                   {" == ", kCompare},
                                                   {" != ", kCompare},
                                                   {" && ", kAnd},
                                                   {" || ", kOr}}};

inline const OperatorText& textOf(BinaryOp op) { return kOperators[static_cast<std::size_t>(op)]; }

/// Whether a literal is written with a minus; -0.0 with decimals is not.
inline bool isNegative(const Number& number) { return std::signbit(number.value) && simeco::textOf(number).starts_with('-'); }

class ExpressionPrinter : protected LinePrinter {
 public:
  using LinePrinter::LinePrinter;

 protected:
  // ---- expressions ----

  /// `id` where something that binds at least as `least` is needed; parentheses where it binds less.
  void expression(ExprId id, Binding least) {
    const ExprNode& node = grammar_.at(id).node;
    const bool enclosed = bindingOf(node) < least;
    if (enclosed) out_ += '(';
    std::visit([this](const auto& n) { expression(n); }, node);
    if (enclosed) out_ += ')';
  }
  static Binding bindingOf(const ExprNode& node) {
    if (const auto* number = std::get_if<Number>(&node)) return isNegative(*number) ? kUnary : kPrimary;
    if (const auto* binary = std::get_if<Binary>(&node)) return textOf(binary->op).binding;
    if (std::holds_alternative<Chain>(node)) return kCompare;
    if (std::holds_alternative<Unary>(node)) return kUnary;
    return std::holds_alternative<Conditional>(node) ? kChoice : kPrimary;
  }
  static Binding above(Binding binding) { return static_cast<Binding>(binding + 1); }

  void expression(const Number& n) { out_ += simeco::textOf(n); }
  void expression(const Name& n) { out_ += n.name; }
  void expression(const Text& n) { quoted(n.text); }
  void expression(const Unary& n) {
    out_ += n.op == UnaryOp::Minus ? '-' : '!';
    // -(5) is a minus before a literal, -5 is a literal.
    const bool literal = std::holds_alternative<Number>(grammar_.at(n.operand).node);
    if (!literal || n.op == UnaryOp::Not) return expression(n.operand, kUnary);
    out_ += '(';
    expression(n.operand, kChoice);
    out_ += ')';
  }
  void expression(const Binary& n) {
    const OperatorText& sign = textOf(n.op);
    if (n.op == BinaryOp::Power) {  // binds to the right, and a minus may follow it
      expression(n.left, kPrimary);
      out_ += sign.text;
      return expression(n.right, kUnary);
    }
    expression(n.left, sign.binding == kCompare ? kSum : sign.binding);
    out_ += sign.text;
    const bool arithmetic = sign.binding == kSum || sign.binding == kProduct;
    const auto* number = std::get_if<Number>(&grammar_.at(n.right).node);
    const bool negative = arithmetic && number && isNegative(*number);
    expression(n.right, negative ? kPrimary : above(sign.binding));
  }
  void expression(const Chain& n) {
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      if (i > 0) out_ += textOf(n.comparisons[i - 1]).text;
      expression(n.operands[i], kSum);
    }
  }
  void expression(const Conditional& n) {
    expression(n.condition, kOr);
    out_ += " ? ";
    expression(n.yes, kChoice);
    out_ += " : ";
    expression(n.no, kChoice);
  }
  void expression(const Call& n) {
    out_ += n.function;
    out_ += '(';
    list(n.arguments);
    out_ += ')';
  }
  void expression(const Element& n) { element(n.array, n.indices); }
  void element(const std::string& name, const std::vector<ExprId>& indices) {
    out_ += name;
    for (const ExprId index : indices) {
      out_ += '[';
      expression(index, kChoice);
      out_ += ']';
    }
  }
  void list(const std::vector<ExprId>& ids) {
    bool first = true;
    for (const ExprId id : ids) {
      if (!std::exchange(first, false)) out_ += ", ";
      expression(id, kChoice);
    }
  }
};

}  // namespace axil::simeco::printing
