#pragma once
/// \file
/// Statements, arrays and blocks of a rule set in the two turtle languages. Private to this room.

#include "emit/turtle_syntax.hpp"

#include <set>
#include <string>
#include <vector>

namespace axil::emit {

class StatementWriter {
 public:
  /// Both must outlive it. Expressions are written by `writer`, whose draws come before the statement that needs them.
  StatementWriter(const simeco::RuleSet& rules, ExpressionWriter& writer) : rules_(rules), writer_(writer) {}

  [[nodiscard]] std::string cpfgStatements(const simeco::Block& block, const std::vector<std::string>& draws = {});
  /// "Start: {...}"; nothing for an empty one.
  [[nodiscard]] std::string cpfgBlock(const char* name, const simeco::Block& block, const std::vector<std::string>& draws = {});
  [[nodiscard]] std::string cpfgArrays();

  [[nodiscard]] std::string pythonStatements(const simeco::Block& block, const std::string& indent);
  /// "def Start():"; nothing for an empty one.
  [[nodiscard]] std::string pythonBlock(const char* name, const simeco::Block& block);
  [[nodiscard]] std::string pythonArray(const simeco::ArrayDeclaration& array);
  /// "global a, b": what a function or rule of Python must say of the variables that blocks set.
  [[nodiscard]] std::string globalLine(const std::string& indent) const;
  /// Variables that blocks set.
  [[nodiscard]] std::set<std::string> globals() const;

 private:
  std::string bodyOf(const simeco::Block& block, const std::string& indent);

  const simeco::RuleSet& rules_;
  ExpressionWriter& writer_;
};

}  // namespace axil::emit
