#include "simeco/check_fold.hpp"

#include "base/overloaded.hpp"
#include "simeco/fold.hpp"
#include "simeco/vocabulary.hpp"

namespace axil::simeco {

namespace {

constexpr std::size_t kMostLimits = 64;  // each is tried: the work must stay linear in the text

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
    const auto limit = a != nullptr && b != nullptr ? std::nullopt : foldedAlone(grammar_, a != nullptr ? right : left);
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

std::optional<double> foldedWith(const Grammar& grammar, ExprId id, std::string_view parameter, double value) {
  return foldedBy(grammar, id, [&](const std::string& name) { return name == parameter ? std::optional(value) : std::nullopt; });
}

std::optional<Comparing> comparingIn(const Grammar& grammar, ExprId condition) {
  Comparisons comparisons(grammar);
  if (!comparisons.read(condition)) return std::nullopt;
  return std::move(comparisons).take();
}

}  // namespace axil::simeco
