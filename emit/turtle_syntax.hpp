#pragma once
/// \file
/// What the two turtle languages write differently: numbers, expressions, statements. Private to this room.

#include "simeco/grammar.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::emit {

enum class TurtleLanguage { Cpfg, LPy };

/// Texts that stand for names: a stage's arguments where an organ is made.
using Meanings = std::map<std::string, std::string, std::less<>>;

/// Writes expressions of one grammar. Each random draw becomes a variable of its own that is set before the successor is made, because the
/// turtle needs some numbers twice and both must be the same draw.
class ExpressionWriter {
 public:
  ExpressionWriter(const simeco::Grammar& grammar, TurtleLanguage language) : grammar_(grammar), language_(language) {}

  /// Parenthesised wherever a neighbour could bind it otherwise.
  [[nodiscard]] std::string text(simeco::ExprId id, const Meanings& meanings = {});
  /// The value of an expression of nothing but numbers.
  [[nodiscard]] std::optional<double> constant(simeco::ExprId id) const;
  /// "x = nran(0, 1)": the draws since the last call, in order.
  [[nodiscard]] std::vector<std::string> takeDraws();
  /// A name for a value that is needed twice, set like a draw.
  [[nodiscard]] std::string named(const std::string& value);
  [[nodiscard]] const std::vector<std::string>& troubles() const { return troubles_; }
  [[nodiscard]] TurtleLanguage language() const { return language_; }

 private:
  std::string call(const simeco::Call& x, const Meanings& meanings);
  std::string chosen(const std::string& condition, const std::string& yes, const std::string& no) const;

  const simeco::Grammar& grammar_;
  TurtleLanguage language_;
  int drawn_ = 0;
  std::vector<std::string> draws_;
  std::vector<std::string> troubles_;
};

/// A number as both languages read it: with an exponent only behind a point.
[[nodiscard]] std::string turtleNumber(double value);
/// A comment line without its marks, and with nothing that would end a comment of either language.
[[nodiscard]] std::string turtleComment(const std::string& line);

}  // namespace axil::emit
