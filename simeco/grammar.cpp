#include "simeco/grammar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/text.hpp"

namespace axil::simeco {

namespace {

// Further digits than these are noise of the binary fraction, and very large numbers would print hundreds of digits.
constexpr int kMostDecimals = 17;
constexpr double kLargestFixed = 1e15;

/// Compares two grammars, each expression in its own arena.
class Comparer {
 public:
  Comparer(const Grammar& a, const Grammar& b) : a_(a), b_(b) {}

  [[nodiscard]] bool grammars() const {
    return a_.language == b_.language && a_.version == b_.version && a_.name == b_.name && a_.comments == b_.comments &&
           a_.closing == b_.closing && same(a_.attributes, b_.attributes) && same(a_.plants, b_.plants);
  }

 private:
  template <class T>
  [[nodiscard]] bool same(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [this](const T& x, const T& y) { return same(x, y); });
  }
  template <class T>
  [[nodiscard]] bool same(const std::optional<T>& a, const std::optional<T>& b) const {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
  }
  template <class... Ts>
  [[nodiscard]] bool same(const std::variant<Ts...>& a, const std::variant<Ts...>& b) const {
    if (a.index() != b.index()) return false;
    return std::visit([&]<class T>(const T& x) { return same(x, std::get<T>(b)); }, a);
  }

  [[nodiscard]] bool same(ExprId a, ExprId b) const {
    if (!a.valid() || !b.valid()) return a.valid() == b.valid();
    return same(a_.at(a).node, b_.at(b).node);
  }
  [[nodiscard]] bool same(const Number& a, const Number& b) const { return a == b || textOf(a) == textOf(b); }
  [[nodiscard]] bool same(const Name& a, const Name& b) const { return a.name == b.name; }
  [[nodiscard]] bool same(const Text& a, const Text& b) const { return a.text == b.text; }
  [[nodiscard]] bool same(const Unary& a, const Unary& b) const { return a.op == b.op && same(a.operand, b.operand); }
  [[nodiscard]] bool same(const Binary& a, const Binary& b) const { return a.op == b.op && same(a.left, b.left) && same(a.right, b.right); }
  [[nodiscard]] bool same(const Chain& a, const Chain& b) const { return a.comparisons == b.comparisons && same(a.operands, b.operands); }
  [[nodiscard]] bool same(const Conditional& a, const Conditional& b) const {
    return same(a.condition, b.condition) && same(a.yes, b.yes) && same(a.no, b.no);
  }
  [[nodiscard]] bool same(const Call& a, const Call& b) const { return a.function == b.function && same(a.arguments, b.arguments); }
  [[nodiscard]] bool same(const Element& a, const Element& b) const { return a.array == b.array && same(a.indices, b.indices); }

  [[nodiscard]] bool same(const Assign& a, const Assign& b) const { return a.name == b.name && same(a.value, b.value); }
  [[nodiscard]] bool same(const AssignElement& a, const AssignElement& b) const {
    return a.array == b.array && same(a.indices, b.indices) && same(a.value, b.value);
  }
  [[nodiscard]] bool same(const Evaluate& a, const Evaluate& b) const { return same(a.value, b.value); }
  [[nodiscard]] bool same(const If& a, const If& b) const {
    return same(a.condition, b.condition) && same(a.yes, b.yes) && same(a.no, b.no);
  }
  [[nodiscard]] bool same(const While& a, const While& b) const {
    return a.testFirst == b.testFirst && same(a.condition, b.condition) && same(a.body, b.body);
  }
  [[nodiscard]] bool same(const Statement& a, const Statement& b) const { return same(a.node, b.node); }

  [[nodiscard]] bool same(const Module& a, const Module& b) const { return a.letter == b.letter && same(a.arguments, b.arguments); }
  [[nodiscard]] bool same(const Successor& a, const Successor& b) const { return same(a.weight, b.weight) && same(a.modules, b.modules); }
  [[nodiscard]] bool same(const Production& a, const Production& b) const {
    return same(a.left, b.left) && same(a.predecessor, b.predecessor) && same(a.right, b.right) && same(a.before, b.before) &&
           same(a.condition, b.condition) && same(a.after, b.after) && placeOfCondition(a_, a) == placeOfCondition(b_, b) &&
           same(a.successors, b.successors) && a.comments == b.comments;
  }
  [[nodiscard]] bool same(const ArrayDeclaration& a, const ArrayDeclaration& b) const {
    return a.name == b.name && a.sizes == b.sizes && same(a.initial, b.initial);
  }
  [[nodiscard]] bool same(const SubRules& a, const SubRules& b) const {
    return a.maximumDepth == b.maximumDepth && a.seed == b.seed && a.warnAtMaximumDepth == b.warnAtMaximumDepth &&
           same(a.productions, b.productions);
  }
  [[nodiscard]] bool same(const RuleSet& a, const RuleSet& b) const {
    return labelOf(a) == labelOf(b) && same(a.axiom, b.axiom) && same(a.productions, b.productions) &&
           same(a.decomposition, b.decomposition) && same(a.homomorphism, b.homomorphism) && same(a.interaction, b.interaction) &&
           a.filter == b.filter && a.ring == b.ring && a.seed == b.seed && same(a.derivationLength, b.derivationLength) &&
           same(a.arrays, b.arrays) && a.externals == b.externals && same(a.start, b.start) && same(a.startEach, b.startEach) &&
           same(a.endEach, b.endEach) && same(a.end, b.end) && a.axiomComments == b.axiomComments && a.comments == b.comments;
  }

  [[nodiscard]] bool same(const Attribute& a, const Attribute& b) const {
    return a.name == b.name && same(a.value, b.value) && a.comments == b.comments;
  }
  [[nodiscard]] bool same(const Stage& a, const Stage& b) const {
    return a.number == b.number && a.parameters == b.parameters && same(a.attributes, b.attributes) && a.comments == b.comments;
  }
  [[nodiscard]] bool same(const OrganBlock& a, const OrganBlock& b) const {
    return a.kind == b.kind && same(a.attributes, b.attributes) && same(a.stages, b.stages) && a.comments == b.comments;
  }
  [[nodiscard]] bool same(const PlantGrammar& a, const PlantGrammar& b) const {
    return a.name == b.name && same(a.attributes, b.attributes) && same(a.organs, b.organs) && same(a.rules, b.rules) &&
           same(a.subRules, b.subRules) && a.comments == b.comments;
  }

  /// An axiom without a name is `w`.
  static std::string_view labelOf(const RuleSet& rules) {
    return rules.label.empty() ? std::string_view("w") : std::string_view(rules.label);
  }

  const Grammar& a_;
  const Grammar& b_;
};

struct OrganWord {
  OrganKind kind;
  const char* letter;
  const char* keyword;
};
constexpr std::array<OrganWord, 6> kOrgans{{{OrganKind::Apex, "A", "Apex"},
                                            {OrganKind::Stem, "S", "Stem"},
                                            {OrganKind::Leaf, "L", "Leaf"},
                                            {OrganKind::Root, "R", "Root"},
                                            {OrganKind::Fruit, "F", "Fruit"},
                                            {OrganKind::Flower, "W", "Flower"}}};

const OrganWord& wordOf(OrganKind kind) { return kOrgans[static_cast<std::size_t>(kind)]; }

}  // namespace

Number fixedNumber(double value, int decimals) { return {roundedTo(value, decimals), decimals}; }

std::string textOf(const Number& number) {
  if (number.decimals < 0 || number.decimals > kMostDecimals || !(std::abs(number.value) < kLargestFixed)) return shortest(number.value);
  std::string text = fixed(number.value, number.decimals);
  // A value that was never rounded to its decimals keeps all its digits: text must read back as the same number.
  return parseNumber(text) == number.value ? text : shortest(number.value);
}

bool operator==(const Comments& a, const Comments& b) {
  const auto spoken = [](const std::vector<std::string>& lines) {
    std::vector<std::string_view> kept;
    for (const std::string& line : lines)
      if (!line.empty()) kept.push_back(line);
    return kept;
  };
  return a.opening == b.opening && a.trailing == b.trailing && spoken(a.before) == spoken(b.before) && spoken(a.inside) == spoken(b.inside);
}

const char* letterOf(OrganKind kind) { return wordOf(kind).letter; }

const char* keywordOf(OrganKind kind) { return wordOf(kind).keyword; }

std::optional<OrganKind> organOfLetter(const std::string& letter) {
  for (const OrganWord& organ : kOrgans)
    if (letter == organ.letter) return organ.kind;
  return std::nullopt;
}

bool isCondition(const Grammar& grammar, ExprId id) {
  const ExprNode& node = grammar.at(id).node;
  if (const auto* unary = std::get_if<Unary>(&node)) return unary->op == UnaryOp::Not;
  if (const auto* binary = std::get_if<Binary>(&node)) return binary->op >= BinaryOp::Less;
  return std::holds_alternative<Chain>(node);
}

ConditionPlace placeOfCondition(const Grammar& grammar, const Production& production) {
  if (!production.condition || production.conditionPlace == ConditionPlace::AfterColon || !isCondition(grammar, *production.condition))
    return ConditionPlace::AfterColon;
  const auto holds = [](const Module& module) { return module.letter != "[" && module.letter != "]"; };
  if (production.conditionPlace == ConditionPlace::InPredecessor)
    return !production.predecessor.empty() && holds(production.predecessor.back()) ? ConditionPlace::InPredecessor
                                                                                   : ConditionPlace::AfterColon;
  const bool inSuccessor = production.successors.size() == 1 &&
                           std::any_of(production.successors[0].modules.begin(), production.successors[0].modules.end(), holds);
  return inSuccessor ? ConditionPlace::InSuccessor : ConditionPlace::AfterColon;
}

ExprId Grammar::add(ExprNode node, SourceSpan where) {
  expressions.push_back({std::move(node), where});
  return ExprId(static_cast<std::int32_t>(expressions.size() - 1));
}

bool operator==(const Grammar& a, const Grammar& b) { return Comparer(a, b).grammars(); }

SourceLines linesOf(std::string_view text) {
  SourceLines lines;
  if (!text.empty()) lines.starts.push_back(0);
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) lines.starts.push_back(static_cast<std::uint32_t>(at + 1));
  return lines;
}

std::string lineOf(const Grammar& grammar, SourceSpan where) {
  const std::vector<std::uint32_t>& starts = grammar.source.starts;
  if (starts.empty() || where.end == 0) return "";
  const auto line = std::upper_bound(starts.begin(), starts.end(), where.begin) - starts.begin();
  return (grammar.source.file.empty() ? "line " : grammar.source.file + ":") + std::to_string(line);
}

}  // namespace axil::simeco
