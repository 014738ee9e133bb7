#pragma once
/// \file
/// The layers of the SimEco parser, second: expressions and statements. Internal to the front end.

#include <cmath>
#include <variant>

#include "simeco/simeco_cursor.hpp"

namespace axil::simeco::syntax {

struct OperatorRow {
  TokenKind token;
  BinaryOp op;
  int binding;
};
// Comparisons are parsed apart, since they chain; ^ apart, since it binds to the right.
constexpr int kOrBinding = 1, kAndBinding = 2, kComparisonBinding = 3, kSumBinding = 4, kProductBinding = 5;
constexpr OperatorRow kOperators[] = {
    {TokenKind::OrOr, BinaryOp::Or, kOrBinding},
    {TokenKind::AndAnd, BinaryOp::And, kAndBinding},
    {TokenKind::Plus, BinaryOp::Add, kSumBinding},
    {TokenKind::Minus, BinaryOp::Subtract, kSumBinding},
    {TokenKind::Star, BinaryOp::Multiply, kProductBinding},
    {TokenKind::Slash, BinaryOp::Divide, kProductBinding},
    {TokenKind::Percent, BinaryOp::Remainder, kProductBinding},
};
constexpr std::pair<TokenKind, BinaryOp> kComparisons[] = {
    {TokenKind::Less, BinaryOp::Less},       {TokenKind::LessEqual, BinaryOp::LessEqual},
    {TokenKind::Greater, BinaryOp::Greater}, {TokenKind::GreaterEqual, BinaryOp::GreaterEqual},
    {TokenKind::Equal, BinaryOp::Equal},     {TokenKind::NotEqual, BinaryOp::NotEqual},
};

inline const OperatorRow* operatorOf(TokenKind kind) {
  for (const OperatorRow& row : kOperators)
    if (row.token == kind) return &row;
  return nullptr;
}

inline std::optional<BinaryOp> comparisonOf(TokenKind kind) {
  for (const auto& [token, op] : kComparisons)
    if (token == kind) return op;
  return std::nullopt;
}

/// The words of `text` between its quotes; a doubled quote is one.
inline std::string unquoted(std::string_view text) {
  if (text.starts_with("“") || text.starts_with("”"))
    text.remove_prefix(std::string_view("“").size());
  else
    text.remove_prefix(1);
  if (text.ends_with("“") || text.ends_with("”"))
    text.remove_suffix(std::string_view("“").size());
  else if (text.ends_with('"'))
    text.remove_suffix(1);
  std::string words;
  words.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    words += text[i];
    if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
  }
  while (words.ends_with('\r')) words.pop_back();
  return words;
}

/// The number as it will be printed again: its decimals are kept where that gives back the value.
inline Number literal(std::string_view text, double value) {
  std::size_t decimals = 0;
  bool afterPoint = false;
  bool plain = !(value == 0 && std::signbit(value));
  for (const char c : text) {
    if (afterPoint) ++decimals;
    if (c == '.') afterPoint = true;
    if (c == 'e' || c == 'E') plain = false;
  }
  constexpr std::size_t kMostKept = 17;
  return {value, plain && decimals <= kMostKept ? static_cast<int>(decimals) : -1};
}

class ExpressionParser : protected Cursor {
 protected:
  explicit ExpressionParser(std::string_view text) : Cursor(text) {
    grammar_.expressions.reserve(text.size() / 20);
    depths_.reserve(text.size() / 20);
  }

  // ---- expressions ----

  ExprId zero() { return add(Number{}, token_.span, 1); }
  ExprId add(ExprNode node, SourceSpan where, int depth) {
    if (depth > kMostDepth)
      error(where, "the expression is nested deeper than " + std::to_string(kMostDepth), "split it with attributes or variables");
    depths_.push_back(static_cast<std::uint16_t>(std::min(depth, kMostDepth)));
    return grammar_.add(std::move(node), where);
  }
  [[nodiscard]] int depthOf(ExprId id) const { return depths_[static_cast<std::size_t>(id.value)]; }
  [[nodiscard]] int depthOver(const std::vector<ExprId>& children) const {
    int depth = 0;
    for (const ExprId child : children) depth = std::max(depth, depthOf(child));
    return depth + 1;
  }
  /// Parentheses do not make a node, so nesting is counted apart: text must not drive the machine's stack.
  bool enter() {
    if (++nesting_ <= kMostDepth) return true;
    error(token_.span, "the expression is nested deeper than " + std::to_string(kMostDepth), "split it with attributes or variables");
    return false;
  }

  ExprId expression() {
    const std::uint32_t begin = token_.span.begin;
    if (!enter()) {
      --nesting_;
      return zero();
    }
    const ExprId condition = binary(kOrBinding);
    ExprId result = condition;
    if (!panic_ && take(TokenKind::Question)) {
      const ExprId yes = expression();
      expect(TokenKind::Colon, "between the two values of ?:");
      const ExprId no = panic_ ? zero() : expression();
      result = add(Conditional{condition, yes, no}, spanFrom(begin), 1 + std::max({depthOf(condition), depthOf(yes), depthOf(no)}));
    }
    --nesting_;
    return result;
  }
  ExprId binary(int binding) {
    if (binding == kComparisonBinding) return comparison();
    if (binding > kProductBinding) return unary();
    const std::uint32_t begin = token_.span.begin;
    ExprId left = binary(binding + 1);
    for (;;) {
      const OperatorRow* row = operatorOf(token_.kind);
      if (panic_ || !row || row->binding != binding) return left;
      advance();
      const ExprId right = binary(binding + 1);
      left = add(Binary{row->op, left, right}, spanFrom(begin), 1 + std::max(depthOf(left), depthOf(right)));
    }
  }
  ExprId comparison() {
    const std::uint32_t begin = token_.span.begin;
    const ExprId first = binary(kSumBinding);
    auto op = comparisonOf(token_.kind);
    if (panic_ || !op) return first;
    advance();
    const ExprId second = binary(kSumBinding);
    const auto more = comparisonOf(token_.kind);
    if (panic_ || !more) return add(Binary{*op, first, second}, spanFrom(begin), 1 + std::max(depthOf(first), depthOf(second)));
    Chain chain{{first, second}, {*op}};
    while (!panic_ && (op = comparisonOf(token_.kind))) {
      advance();
      chain.comparisons.push_back(*op);
      chain.operands.push_back(binary(kSumBinding));
    }
    const int depth = depthOver(chain.operands);
    return add(std::move(chain), spanFrom(begin), depth);
  }
  ExprId unary() {
    const std::uint32_t begin = token_.span.begin;
    if (!is(TokenKind::Minus) && !is(TokenKind::Not)) return power(primary(), begin);
    const UnaryOp op = is(TokenKind::Minus) ? UnaryOp::Minus : UnaryOp::Not;
    if (op == UnaryOp::Minus && peek().kind == TokenKind::Number) return negativeNumber();
    advance();
    const bool shallow = enter();
    const ExprId operand = shallow ? unary() : zero();
    --nesting_;
    return add(Unary{op, operand}, spanFrom(begin), 1 + depthOf(operand));
  }
  /// -1.5 is one literal; in -2^2 the minus belongs to the power.
  ExprId negativeNumber() {
    const std::uint32_t begin = token_.span.begin;
    advance();
    const ExprId number = primary();
    if (is(TokenKind::Caret)) {
      const ExprId raised = power(number, begin + 1);
      return add(Unary{UnaryOp::Minus, raised}, spanFrom(begin), 1 + depthOf(raised));
    }
    Expr& made = grammar_.expressions.back();
    Number& value = std::get<Number>(made.node);
    value = literal(textOf(made.where), -value.value);
    made.where = spanFrom(begin);
    return number;
  }
  ExprId power(ExprId base, std::uint32_t begin) {
    if (panic_ || !take(TokenKind::Caret)) return base;
    const bool shallow = enter();
    const ExprId exponent = shallow ? unary() : zero();
    --nesting_;
    return add(Binary{BinaryOp::Power, base, exponent}, spanFrom(begin), 1 + std::max(depthOf(base), depthOf(exponent)));
  }
  ExprId primary() {
    const SourceSpan where = token_.span;
    if (is(TokenKind::Number)) return number();
    if (is(TokenKind::Word)) return nameOrCall();
    if (is(TokenKind::Text)) {
      advance();
      return add(Text{unquoted(textOf(where))}, where, 1);
    }
    if (take(TokenKind::LeftParen)) {
      const ExprId inner = expression();
      expect(TokenKind::RightParen, "after the expression", {}, is(TokenKind::Comma) ? "a place or direction is written vector(x, y, z)" : "");
      return lastParenthesised_ = inner;
    }
    error(gap(), "a value is expected, but here " + seen(), valueHint());
    return zero();
  }
  /// What someone may have meant who wrote no value here.
  [[nodiscard]] std::string valueHint() const {
    if (is(TokenKind::Arrow)) return "the arrow is ->, with one -";
    if (is(TokenKind::Plus)) return "a value has no sign +; to count, write x = x+1;";
    return {};
  }
  ExprId number() {
    const SourceSpan where = token_.span;
    const std::string_view said = textOf(token_);
    const auto value = parseNumber(said);
    if (!value)
      slip(where, "the number " + std::string(said.substr(0, 40)) + " is too large or too small to be held",
           "numbers reach from 1e-307 to 1e308");
    advance();
    if (value && is(TokenKind::Word) && token_.span.begin == previousEnd_)
      error({where.begin, token_.span.end}, "'" + std::string(said) + std::string(textOf(token_)) + "' is neither a number nor a name",
            "write '*' between them to multiply");
    return add(literal(said, value.value_or(0)), where, 1);
  }
  ExprId nameOrCall() {
    const std::uint32_t begin = token_.span.begin;
    std::string name(textOf(token_));
    advance();
    if (take(TokenKind::LeftParen)) return call(std::move(name), begin);
    if (!is(TokenKind::LeftBracket)) return add(Name{std::move(name)}, spanFrom(begin), 1);
    Element element{std::move(name), {}};
    while (!panic_ && take(TokenKind::LeftBracket)) {
      element.indices.push_back(expression());
      expect(TokenKind::RightBracket, "after the index");
    }
    const int depth = depthOver(element.indices);
    return add(std::move(element), spanFrom(begin), depth);
  }
  ExprId call(std::string function, std::uint32_t begin) {
    Call call{std::move(function), {}};
    if (!take(TokenKind::RightParen)) {
      do call.arguments.push_back(expression());
      while (!panic_ && take(TokenKind::Comma));
      expect(TokenKind::RightParen, "after the arguments of", call.function);
    }
    const int depth = depthOver(call.arguments);
    return add(std::move(call), spanFrom(begin), depth);
  }

  // ---- statements ----

  Block block() {
    Block statements;
    if (!expect(TokenKind::LeftBrace, "before the statements")) return statements;
    if (++nesting_ > kMostDepth) error(token_.span, "statements are nested deeper than " + std::to_string(kMostDepth));
    while (!is(TokenKind::RightBrace) && !is(TokenKind::End) && !is(TokenKind::Arrow)) {
      if (!panic_) statements.push_back(statement());
      if (panic_) skipStatement();
    }
    --nesting_;
    if (!panic_) expect(TokenKind::RightBrace, "after the statements");
    return statements;
  }
  void skipStatement() {
    panic_ = false;
    std::size_t depth = 0;
    for (; !is(TokenKind::End) && !is(TokenKind::Arrow); advance()) {
      if (is(TokenKind::LeftBrace)) ++depth;
      if (is(TokenKind::RightBrace) && depth-- == 0) return;
      if (is(TokenKind::Semicolon) && depth == 0) return advance();
    }
  }
  Statement statement() {
    Statement made;
    const std::uint32_t begin = token_.span.begin;
    if (isWord("if"))
      made.node = ifStatement();
    else if (isWord("while"))
      made.node = whileStatement();
    else if (isWord("do"))
      made.node = doStatement();
    else
      made.node = simpleStatement();
    made.where = spanFrom(begin);
    return made;
  }
  ExprId parenthesised() {
    if (!expect(TokenKind::LeftParen, "before the expression")) return zero();
    const ExprId value = expression();
    expect(TokenKind::RightParen, "after the expression");
    return value;
  }
  If ifStatement() {
    If made;
    advance();
    made.condition = parenthesised();
    made.yes = block();
    if (!panic_ && isWord("else")) {
      advance();
      made.no = block();
    }
    return made;
  }
  While whileStatement() {
    While made;
    advance();
    made.condition = parenthesised();
    if (!panic_) made.body = block();
    return made;
  }
  While doStatement() {
    While made;
    made.testFirst = false;
    advance();
    made.body = block();
    if (!panic_ && !isWord("while")) error(gap(), "'while' is expected after do { ... }, but here " + seen());
    if (panic_) return made;
    advance();
    made.condition = parenthesised();
    expect(TokenKind::Semicolon, "after do { ... } while (...)");
    return made;
  }
  std::variant<Assign, AssignElement, Evaluate, If, While> simpleStatement() {
    const ExprId value = expression();
    if (!panic_ && is(TokenKind::Assign)) {
      const ExprNode target = grammar_.at(value).node;
      const SourceSpan where = grammar_.at(value).where;
      advance();
      const ExprId assigned = expression();
      expect(TokenKind::Semicolon, "after the statement");
      if (const auto* name = std::get_if<Name>(&target)) return Assign{name->name, assigned};
      if (const auto* element = std::get_if<Element>(&target)) return AssignElement{element->array, element->indices, assigned};
      error(where, "only a name or an array's element can be given a value");
      return Evaluate{assigned};
    }
    expect(TokenKind::Semicolon, "after the statement");
    return Evaluate{value};
  }

  std::vector<std::uint16_t> depths_;  ///< of each expression's tree, beside the arena
  ExprId lastParenthesised_;
};

}  // namespace axil::simeco::syntax
