#include "simeco/check_fold.hpp"

#include "base/overloaded.hpp"
#include "simeco/engine_arithmetic.hpp"
#include "simeco/vocabulary.hpp"

#include <algorithm>
#include <cmath>

namespace axil::simeco {

namespace {

constexpr std::size_t kMostLimits = 64;  // each is tried: the work must stay linear in the text

double valueOf(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::Add: return a + b;
    case BinaryOp::Subtract: return a - b;
    case BinaryOp::Multiply: return a * b;
    case BinaryOp::Divide: return a / b;
    case BinaryOp::Remainder: return remainder(a, b);
    case BinaryOp::Power: return std::pow(a, b);
    case BinaryOp::Less: return a < b ? 1 : 0;
    case BinaryOp::LessEqual: return a <= b ? 1 : 0;
    case BinaryOp::Greater: return a > b ? 1 : 0;
    case BinaryOp::GreaterEqual: return a >= b ? 1 : 0;
    case BinaryOp::Equal: return a == b ? 1 : 0;
    case BinaryOp::NotEqual: return a != b ? 1 : 0;
    case BinaryOp::And: return a != 0 && b != 0 ? 1 : 0;
    case BinaryOp::Or: return a != 0 || b != 0 ? 1 : 0;
  }
  return 0;
}

/// A division by zero ends the derivation; it is no value.
bool failsOn(BinaryOp op, double b) { return (op == BinaryOp::Divide && b == 0) || (op == BinaryOp::Remainder && truncated(b) == 0); }

bool compares(BinaryOp op) {
  switch (op) {
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual:
    case BinaryOp::Equal:
    case BinaryOp::NotEqual: return true;
    default: return false;
  }
}

class Folder {
 public:
  Folder(const Grammar& grammar, std::string_view parameter, double value) : grammar_(grammar), parameter_(parameter), value_(value) {}

  [[nodiscard]] std::optional<double> at(ExprId id, int depth = 0) const {
    if (depth > kMostDepth) return std::nullopt;
    using Value = std::optional<double>;
    return std::visit(overloaded{[](const Number& n) -> Value { return n.value; },
                                 [&](const Name& n) -> Value { return n.name == parameter_ ? Value(value_) : std::nullopt; },
                                 [](const Text&) -> Value { return std::nullopt; },
                                 [&](const Unary& n) -> Value {
                                   const Value v = at(n.operand, depth + 1);
                                   if (!v) return std::nullopt;
                                   return n.op == UnaryOp::Minus ? -*v : (*v == 0 ? 1.0 : 0.0);
                                 },
                                 [&](const Binary& n) -> Value {
                                   const Value a = at(n.left, depth + 1);
                                   const Value b = at(n.right, depth + 1);
                                   return a && b && !failsOn(n.op, *b) ? Value(valueOf(n.op, *a, *b)) : std::nullopt;
                                 },
                                 [&](const Chain& n) -> Value { return chain(n, depth); },
                                 [&](const Conditional& n) -> Value {
                                   const Value c = at(n.condition, depth + 1);
                                   if (!c) return std::nullopt;
                                   return at(*c != 0 ? n.yes : n.no, depth + 1);
                                 },
                                 [](const Call&) -> Value { return std::nullopt; }, [](const Element&) -> Value { return std::nullopt; }},
                      grammar_.at(id).node);
  }

 private:
  [[nodiscard]] std::optional<double> chain(const Chain& n, int depth) const {
    for (std::size_t i = 0; i + 1 < n.operands.size(); ++i) {
      const auto a = at(n.operands[i], depth + 1);
      const auto b = at(n.operands[i + 1], depth + 1);
      if (!a || !b) return std::nullopt;
      if (valueOf(n.comparisons[i], *a, *b) == 0) return 0;
    }
    return 1;
  }
  const Grammar& grammar_;
  std::string_view parameter_;
  double value_;
};

/// Collects what a condition compares its one name with; false where it does anything else with a name.
class Comparisons {
 public:
  explicit Comparisons(const Grammar& grammar) : grammar_(grammar) {}

  bool read(ExprId id, int depth = 0) {
    if (depth > kMostDepth) return false;
    return std::visit(overloaded{[](const Number&) { return true; }, [](const Name&) { return false; }, [](const Text&) { return false; },
                                 [&](const Unary& n) { return read(n.operand, depth + 1); },
                                 [&](const Binary& n) { return compares(n.op) ? comparison(n.left, n.right, depth) : joined(n, depth); },
                                 [&](const Chain& n) {
                                   for (std::size_t i = 0; i + 1 < n.operands.size(); ++i)
                                     if (!compares(n.comparisons[i]) || !comparison(n.operands[i], n.operands[i + 1], depth)) return false;
                                   return true;
                                 },
                                 [&](const Conditional& n) { return read(n.condition, depth + 1) && read(n.yes, depth + 1) && read(n.no, depth + 1); },
                                 [](const Call&) { return false; }, [](const Element&) { return false; }},
                      grammar_.at(id).node);
  }
  [[nodiscard]] Comparing take() && { return std::move(found_); }

 private:
  bool joined(const Binary& n, int depth) { return read(n.left, depth + 1) && read(n.right, depth + 1); }
  bool comparison(ExprId left, ExprId right, int depth) {
    const Name *a = nameIn(grammar_, left), *b = nameIn(grammar_, right);
    if (a == nullptr && b == nullptr) return read(left, depth + 1) && read(right, depth + 1);
    const auto limit = a != nullptr && b != nullptr ? std::nullopt : foldedWith(grammar_, a != nullptr ? right : left, {}, 0);
    const std::string_view name = a != nullptr ? a->name : b->name;
    if (!limit || (!found_.name.empty() && found_.name != name) || found_.limits.size() >= kMostLimits) return false;
    found_.name = name;
    found_.limits.push_back(*limit);
    return true;
  }

  const Grammar& grammar_;
  Comparing found_;
};

}  // namespace

const Number* numberIn(const Grammar& grammar, ExprId id) { return id.valid() ? std::get_if<Number>(&grammar.at(id).node) : nullptr; }
const Name* nameIn(const Grammar& grammar, ExprId id) { return id.valid() ? std::get_if<Name>(&grammar.at(id).node) : nullptr; }

std::optional<double> foldedWith(const Grammar& grammar, ExprId id, std::string_view parameter, double value) { return Folder(grammar, parameter, value).at(id); }

std::optional<Comparing> comparingIn(const Grammar& grammar, ExprId condition) {
  Comparisons comparisons(grammar);
  if (!comparisons.read(condition)) return std::nullopt;
  return std::move(comparisons).take();
}

}  // namespace axil::simeco
