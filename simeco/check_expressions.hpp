#pragma once
/// \file
/// The layers of the SimEco checks, first: expressions and statements, and what version 1.0 does not have. Internal to `check`.

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "simeco/check_fold.hpp"
#include "simeco/fold.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace axil::simeco::checking {

class ExpressionCheck {
 protected:
  explicit ExpressionCheck(const Grammar& grammar) : grammar_(grammar), is10_(grammar.version == "1.0") {
    for (const FunctionWord& word : functionWords()) functionNames_.push_back(word.name);
  }

  /// A rule's own names. Those of the block and of the environment are members: they are looked up behind them.
  using Scope = std::vector<std::string_view>;

  // ---- what version 1.0 does not have ----

  /// Told once a feature: the fix is the same everywhere.
  void since11(const std::string& feature, SourceSpan where) {
    if (is10_ && toldFeatures_.insert(feature).second)
      report_.error(where, feature + " need SimEco 1.1", "begin the file with: EcoSystem 1.1");
  }
  void oneLine(std::string_view words, SourceSpan where, const char* what) {
    if (words.find_first_of("\n\r") != std::string_view::npos)
      report_.error(where, std::string(what) + " has a line break", "write it on one line");
  }

  // ---- expressions and statements ----

  void statements(const Block& block, const Scope& names, int depth = 0) {
    if (block.empty()) return;
    if (depth > kMostDepth) return report_.error(block.front().where, "statements are nested deeper than " + std::to_string(kMostDepth));
    since11("statements", block.front().where);
    for (const Statement& s : block)
      std::visit(overloaded{[&](const Assign& n) { expression(n.value, names); },
                            [&](const AssignElement& n) {
                              array(n.array, s.where);
                              for (const ExprId index : n.indices) expression(index, names);
                              expression(n.value, names);
                            },
                            [&](const Evaluate& n) { expression(n.value, names); },
                            [&](const If& n) {
                              expression(n.condition, names);
                              statements(n.yes, names, depth + 1);
                              statements(n.no, names, depth + 1);
                            },
                            [&](const While& n) {
                              expression(n.condition, names);
                              statements(n.body, names, depth + 1);
                            }},
                 s.node);
  }
  void array(const std::string& name, SourceSpan where) {
    if (!arrays_.contains(name)) report_.error(where, "unknown array '" + name + "'", "declare it in Grow: array " + name + "[10];");
  }
  void expression(ExprId id, const Scope& names, int depth = 0) {
    if (!id.valid()) return;
    const Expr& expr = grammar_.at(id);
    if (depth > kMostDepth) return report_.error(expr.where, "the expression is nested deeper than " + std::to_string(kMostDepth));
    const auto inner = [&](ExprId child) { expression(child, names, depth + 1); };
    std::visit(overloaded{[&](const Number& n) {
                            if (!std::isfinite(n.value)) report_.error(expr.where, "a number is not finite");
                          },
                          [&](const Name& n) { name(n, expr.where, names); }, [&](const Text& n) { oneLine(n.text, expr.where, "a text"); },
                          [&](const Unary& n) {
                            if (n.op == UnaryOp::Not) since11("operators such as !", expr.where);
                            inner(n.operand);
                          },
                          [&](const Binary& n) {
                            binary(n, expr.where);
                            inner(n.left);
                            inner(n.right);
                          },
                          [&](const Chain& n) {
                            for (const ExprId operand : n.operands) inner(operand);
                          },
                          [&](const Conditional& n) {
                            since11("operators such as ?:", expr.where);
                            inner(n.condition);
                            inner(n.yes);
                            inner(n.no);
                          },
                          [&](const Call& n) {
                            call(n, expr.where);
                            for (const ExprId argument : n.arguments) inner(argument);
                          },
                          [&](const Element& n) {
                            array(n.array, expr.where);
                            for (const ExprId index : n.indices) inner(index);
                          }},
               expr.node);
  }
  void name(const Name& n, SourceSpan where, const Scope& names) {
    if (std::find(names.begin(), names.end(), n.name) != names.end() || globals_.contains(n.name)) return;
    if (environment_.contains(n.name)) return since11("names of attributes in expressions", where);
    const auto words = attributeWords();
    const bool isAttribute = std::any_of(words.begin(), words.end(), [&](const AttributeWord& w) { return w.name == n.name; });
    Scope all = names;
    all.insert(all.end(), globals_.begin(), globals_.end());
    all.insert(all.end(), environment_.begin(), environment_.end());
    std::string hint = isAttribute ? "give it a value: " + n.name + " = 1;" : didYouMean(n.name, all);
    if (n.name == "pi" || n.name == "PI") hint = "write 3.141593, or give it a value in the EcoSystem: " + n.name + " = 3.141593;";
    if (hint.empty()) hint = "a rule's own names stand in its predecessor, for example S(" + n.name + ") -> ...";
    report_.error(where, "unknown name '" + n.name + "'", hint);
  }
  void binary(const Binary& n, SourceSpan where) {
    const bool divides = n.op == BinaryOp::Divide || n.op == BinaryOp::Remainder;
    const auto divisor = divides ? foldedAlone(grammar_, n.right) : std::nullopt;
    if (divisor && *divisor == 0) report_.error(grammar_.at(n.right).where, "division by zero");
    if (n.op == BinaryOp::Remainder || n.op == BinaryOp::Power) since11("operators such as % and ^", where);
    if (n.op == BinaryOp::And || n.op == BinaryOp::Or) since11("operators such as && and ||", where);
  }
  [[nodiscard]] std::string functionHint(const std::string& function) const {
    if (function == "for") return "write i = 0; while (i < 3) { ...; i = i+1; }";
    if (function == "rand" || function == "ran") return "random(low, high) draws a number between the two";
    return didYouMean(function, functionNames_);
  }
  void call(const Call& n, SourceSpan where) {
    const auto words = functionWords();
    const auto word = std::find_if(words.begin(), words.end(), [&](const FunctionWord& w) { return w.name == n.function; });
    if (word == words.end()) return report_.error(where, "unknown function '" + n.function + "'", functionHint(n.function));
    if (word->since11)
      since11(n.function == "random" || n.function == "normal" ? "random numbers" : "functions such as " + n.function, where);
    const auto count = static_cast<int>(n.arguments.size());
    if (count >= word->fewest && (word->most < 0 || count <= word->most)) {
      return;
    }
    const std::string wanted = (word->fewest == word->most ? "" : "at least ") + std::to_string(word->fewest);
    report_.error(where, "'" + n.function + "' takes " + wanted + (word->fewest == 1 ? " argument" : " arguments") + ", not " +
                             std::to_string(count));
  }

  const Grammar& grammar_;
  bool is10_;
  Report report_;
  std::vector<std::string_view> functionNames_;
  std::set<std::string> toldFeatures_;
  std::unordered_set<std::string_view> arrays_;
  std::set<std::string_view> globals_;
  std::set<std::string_view> environment_;
};

}  // namespace axil::simeco::checking
