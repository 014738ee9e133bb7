#pragma once
/// \file
/// The reader under the L-system parser: a place in the preprocessed text, expressions, statement blocks and strings of
/// modules. Reading goes on to `limit`; the first error of a statement sets `broken`, and what reads it leaves early.

#include "simeco/lsystem_preprocess.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// A function of the classic language, or one of ours beside them.
struct LSystemFunction {
  std::string_view name;
  int fewest = 1;
  int most = 1;
  bool takesText = false;  ///< a quoted text may be an argument
};
inline constexpr int kManyArguments = 1000;
/// Null when there is none of that name.
[[nodiscard]] const LSystemFunction* lsystemFunction(std::string_view name);

/// What a string of modules may hold.
enum class ModuleText { Formal, RightContext, Evaluated };

class LSystemReader {
 public:
  LSystemReader(const Preprocessed& source, Grammar& grammar, std::vector<Diagnostic>& diagnostics)
      : source_(source), text_(source.text), grammar_(grammar), diagnostics_(diagnostics), limit_(source.text.size()) {}

 protected:
  // ---- places
  [[nodiscard]] char peek(std::size_t ahead = 0) const { return at_ + ahead < limit_ ? text_[at_ + ahead] : '\0'; }
  [[nodiscard]] bool atEnd() const { return at_ >= limit_; }
  [[nodiscard]] bool atArrow() const { return text_.substr(at_, limit_ - at_).starts_with("-->"); }
  void skip();
  /// Skips blanks, then takes `token` if it stands there.
  bool eat(std::string_view token);
  void expect(std::string_view token, std::string_view what);
  [[nodiscard]] SourceSpan spanFrom(std::size_t begin) const { return source_.originOf(begin, at_); }

  // ---- trouble
  void error(std::size_t begin, std::size_t end, std::string message, std::string hint = {});
  /// At the token that stands here.
  void errorHere(std::string message, std::string hint = {});
  void warn(std::size_t begin, std::size_t end, std::string message, std::string hint = {});
  /// What stands here, for messages: 'x', or "the end of the line".
  [[nodiscard]] std::string found() const;

  // ---- expressions
  ExprId expression();
  ExprId add(ExprNode node, std::size_t begin);

  // ---- statements
  Block block();
  std::string name(std::string_view what);
  std::vector<ExprId> indices();

  // ---- strings
  std::vector<Module> modules(ModuleText kind);

  const Preprocessed& source_;
  std::string_view text_;
  Grammar& grammar_;
  std::vector<Diagnostic>& diagnostics_;
  std::size_t at_ = 0;
  std::size_t limit_ = 0;
  bool broken_ = false;
  bool openText_ = false;   ///< a text that is not closed was said; it takes what follows on its line

 private:
  ExprId conditional();
  ExprId binary(int level);
  ExprId unary();
  ExprId primary();
  /// What someone may have meant who wrote no value here.
  [[nodiscard]] std::string valueHint() const;
  ExprId number();
  ExprId quotedText();
  ExprId called(std::string function, std::size_t begin);
  void warnAboutPower(ExprId left, bool again, std::size_t begin);
  bool enter();
  void leave() { --depth_; }
  Statement statement();
  Statement ifStatement();
  Statement whileStatement();
  Statement doStatement();
  ExprId parenthesised();
  Statement assignment(std::string name, std::size_t begin);
  void skipStatement();
  Module module(ModuleText kind);
  void arguments(Module& module, ModuleText kind);

  std::vector<int> heights_;  ///< of each expression's tree
  int depth_ = 0;
};

}  // namespace axil::simeco
