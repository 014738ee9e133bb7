#pragma once
/// \file
/// The layers of the SimEco parser, first: where it stands in the text, what went wrong, which comments and blocks are open.
/// Internal to the front end. After an error the parser goes on at the next place where an item can start, so that one
/// mistake gives one message and the mistakes behind it are found as well.

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "simeco/grammar.hpp"
#include "simeco/lexer.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

namespace axil::simeco::syntax {

enum class Level { Ecosystem, Plant, Organ, Stage, Grow, SubRules };

/// A block whose } has not come yet.
struct OpenBlock {
  Level level;
  SourceSpan header;  ///< `Stage 3`, for messages
};

inline std::string_view signOf(TokenKind kind) {
  switch (kind) {
    case TokenKind::LeftBrace:
      return "{";
    case TokenKind::RightBrace:
      return "}";
    case TokenKind::LeftParen:
      return "(";
    case TokenKind::RightParen:
      return ")";
    case TokenKind::RightBracket:
      return "]";
    case TokenKind::Comma:
      return ",";
    case TokenKind::Semicolon:
      return ";";
    case TokenKind::Assign:
      return "=";
    case TokenKind::Colon:
      return ":";
    case TokenKind::Arrow:
      return "->";
    default:
      return "?";
  }
}

class Cursor {
 protected:
  explicit Cursor(std::string_view text) : text_(text), lexer_(text, report_) { advance(); }

  // ---- tokens ----

  void advance() {
    previousEnd_ = token_.span.end;
    if (peeked_) {
      token_ = *peeked_;
      peeked_.reset();
    } else {
      token_ = lexer_.next();
    }
  }
  const Token& peek() {
    if (!peeked_) peeked_ = lexer_.next();
    return *peeked_;
  }
  void rewind(const Token& token) {
    peeked_.reset();
    lexer_.rewind(token);
    token_ = lexer_.next();
  }
  [[nodiscard]] bool is(TokenKind kind) const { return token_.kind == kind; }
  [[nodiscard]] bool isWord(std::string_view word) const { return is(TokenKind::Word) && textOf(token_) == word; }
  [[nodiscard]] std::string_view textOf(const Token& token) const { return textOf(token.span); }
  [[nodiscard]] std::string_view textOf(SourceSpan span) const { return text_.substr(span.begin, span.end - span.begin); }
  [[nodiscard]] SourceSpan spanFrom(std::uint32_t begin) const { return {begin, std::max(begin, previousEnd_)}; }
  bool take(TokenKind kind) {
    if (!is(kind)) return false;
    advance();
    return true;
  }

  // ---- trouble ----

  /// The first error of an item is told, what follows from it is not.
  void error(SourceSpan span, std::string message, std::string hint = {}) {
    if (panic_) return;
    panic_ = true;
    report_.error(span, std::move(message), std::move(hint));
  }
  /// An error that does not spoil what comes after it.
  void slip(SourceSpan span, std::string message, std::string hint = {}) {
    if (!panic_) report_.error(span, std::move(message), std::move(hint));
  }
  [[nodiscard]] std::string seen() const {
    if (is(TokenKind::End)) return "the file ends";
    constexpr std::size_t kLongest = 24;
    const std::string_view text = textOf(token_);
    if (countCharacters(text) <= kLongest) return "'" + std::string(text) + "' stands";
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < kLongest; ++i) bytes += utf8Length(text[bytes]);
    return "'" + std::string(text.substr(0, bytes)) + "…' stands";
  }
  /// Where something is missing: at the token, or right behind the last one when the line ended there.
  [[nodiscard]] SourceSpan gap() const {
    return token_.startsLine || is(TokenKind::End) ? SourceSpan{previousEnd_ > 0 ? previousEnd_ - 1 : 0, previousEnd_} : token_.span;
  }
  /// "after the arguments of" "rotr": the words are only put together when they are needed.
  static std::string placeWords(std::string_view where, std::string_view subject) {
    return std::string(where) + (subject.empty() ? "" : " '" + std::string(subject) + "'");
  }
  void missing(TokenKind kind, std::string_view where, std::string_view subject) {
    slip(gap(), "missing '" + std::string(signOf(kind)) + "' " + placeWords(where, subject));
  }
  bool expect(TokenKind kind, std::string_view where, std::string_view subject = {}, std::string_view hint = {}) {
    if (take(kind)) return true;
    error(gap(), "'" + std::string(signOf(kind)) + "' is expected " + placeWords(where, subject) + ", but here " + seen(), std::string(hint));
    return false;
  }
  void endItem(const char* what) {
    if (panic_) return skipItem();
    if (take(TokenKind::Semicolon)) return;
    if (token_.startsLine || is(TokenKind::RightBrace) || is(TokenKind::End)) {
      slip({previousEnd_ > 0 ? previousEnd_ - 1 : 0, previousEnd_}, std::string("missing ';' after the ") + what, "end it with ';'");
      return;
    }
    error(token_.span, std::string("';' is expected after the ") + what + ", but here " + seen(), is(TokenKind::Comma) ? "items end with ';', decimals stand behind a point" : "");
    skipItem();
  }
  /// To where the next item can start.
  void skipItem() {
    panic_ = false;
    std::size_t depth = 0;
    for (bool first = true; !is(TokenKind::End); first = false) {
      if (depth == 0 && !first && startsItem()) return;
      if (is(TokenKind::LeftBrace)) ++depth;
      if (is(TokenKind::RightBrace)) {
        if (depth == 0) return;
        if (--depth == 0) return advance();
      }
      if (is(TokenKind::Semicolon) && depth == 0) return advance();
      advance();
    }
  }
  [[nodiscard]] bool startsItem() {
    if (!token_.startsLine || !is(TokenKind::Word)) return false;
    if (peek().kind == TokenKind::Assign || peek().kind == TokenKind::LeftBrace) return true;
    const std::size_t lineEnd = text_.find('\n', token_.span.begin);
    constexpr std::size_t kLongestLook = 4096;
    const std::string_view line = text_.substr(token_.span.begin, std::min(lineEnd - token_.span.begin, kLongestLook));
    return line.find("->") != std::string_view::npos || atBlock();
  }
  /// Whether a block with a keyword starts here.
  [[nodiscard]] bool atBlock() {
    if (!is(TokenKind::Word)) return false;
    const TokenKind next = peek().kind;
    if (next != TokenKind::LeftBrace && next != TokenKind::Text && next != TokenKind::Number) return false;
    const std::string_view word = textOf(token_);
    if (word == "Plant") return next != TokenKind::Number;
    if (word == "Stage") return next == TokenKind::Number;
    return (word == "Grow" || organOfKeyword(word)) && next == TokenKind::LeftBrace;
  }

  // ---- comments ----

  [[nodiscard]] std::string commentText(const CommentToken& comment) const {
    std::string text(textOf(comment.span));
    std::erase(text, '\r');
    if (text.starts_with("//"))
      while (text.ends_with(' ') || text.ends_with('\t')) text.pop_back();
    else if (!text.ends_with("*/") || text.size() < 4)
      text += "*/";  // never closed; reported
    return text;
  }
  /// Comments in front of byte `end`, as lines; a blank line above one, or above what follows, is an empty line.
  void takeLines(std::vector<std::string>& lines, std::uint32_t end) {
    std::vector<CommentToken>& pending = lexer_.comments();
    std::size_t taken = 0;
    for (; taken < pending.size() && pending[taken].span.begin < end; ++taken) {
      if (pending[taken].blankBefore && !firstInBlock_) lines.emplace_back();
      firstInBlock_ = false;
      lines.push_back(commentText(pending[taken]));
    }
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(taken));
  }
  /// Comments that go on with the line of the token before.
  void takeRestOfLine(std::string& line) {
    std::vector<CommentToken>& pending = lexer_.comments();
    std::size_t taken = 0;
    while (taken < pending.size() && !pending[taken].startsLine && pending[taken].span.begin < token_.span.begin) {
      if (!line.empty()) line += ' ';
      line += commentText(pending[taken++]);
    }
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(taken));
  }
  [[nodiscard]] Comments leading() {
    Comments comments;
    if (!lexer_.comments().empty()) takeLines(comments.before, token_.span.begin);
    if (token_.blankBefore && !firstInBlock_) comments.before.emplace_back();
    firstInBlock_ = false;
    return comments;
  }
  /// Comments inside the item move above it; those behind it on its line stay.
  void trailing(Comments& comments) {
    if (lexer_.comments().empty()) return;
    takeLines(comments.before, previousEnd_);
    takeRestOfLine(comments.trailing);
  }

  // ---- blocks ----

  void openBlock(Level level, SourceSpan header, Comments& comments) {
    if (panic_) recoverHeader();
    if (!is(TokenKind::LeftBrace)) missing(TokenKind::LeftBrace, "after", textOf(header));
    open_.push_back({level, header});
    if (is(TokenKind::LeftBrace)) advance();
    if (!lexer_.comments().empty()) {
      takeLines(comments.before, previousEnd_);
      takeRestOfLine(comments.opening);
    }
    firstInBlock_ = true;
  }
  /// A broken header: its block starts at the next { of the same line or of the line below.
  void recoverHeader() {
    panic_ = false;
    while (!is(TokenKind::LeftBrace) && !is(TokenKind::RightBrace) && !is(TokenKind::Semicolon) && !is(TokenKind::End) &&
           !token_.startsLine)
      advance();
  }
  void closeBlock(Comments& comments) {
    const OpenBlock block = open_.back();
    open_.pop_back();
    if (!lexer_.comments().empty()) takeLines(comments.inside, token_.span.begin);
    firstInBlock_ = false;
    if (take(TokenKind::RightBrace)) {
      if (!lexer_.comments().empty()) takeRestOfLine(comments.trailing);
      return;
    }
    if (!is(TokenKind::End)) {
      slip(token_.span, "missing '}': '" + std::string(textOf(block.header)) + "' is still open where " + seen(),
           "close it with '}' above");
    } else if (!endReported_) {
      endReported_ = true;
      const std::size_t count = open_.size() + 1;
      report_.error(gap(),
                    "the file ends inside '" + std::string(textOf(block.header)) + "'; " + std::to_string(count) +
                        (count == 1 ? " '}' is missing" : " '}' are missing"),
                    "close every block that is open, or look for a '}' that was lost above");
    }
  }
  /// Whether a block of `level` is over: at its }, at the end, or because something starts that cannot be inside it.
  [[nodiscard]] bool blockEnds(Level level) {
    if (is(TokenKind::RightBrace) || is(TokenKind::End)) return true;
    if (!is(TokenKind::Word) || level == Level::Ecosystem || !atBlock()) return false;
    const std::string_view word = textOf(token_);
    if (word == "Plant") return true;
    if (level == Level::Plant) return false;
    if (word == "Stage") return level == Level::Stage;
    return true;
  }
  template <class T>
  std::optional<T> wholeNumber(const char* what, const char* range) {
    T value{};
    const std::string_view said = textOf(token_);
    const auto [end, code] = std::from_chars(said.data(), said.data() + said.size(), value);
    const bool good = is(TokenKind::Number) && code == std::errc{} && end == said.data() + said.size();
    if (!good)
      error(is(TokenKind::End) ? gap() : token_.span, std::string(what) + " must be a whole number, " + range + ", but here " + seen());
    if (is(TokenKind::Number)) advance();
    return good ? std::optional<T>(value) : std::nullopt;
  }

  std::string_view text_;
  Report report_;
  Lexer lexer_;
  Grammar grammar_;
  Token token_;
  std::optional<Token> peeked_;
  std::uint32_t previousEnd_ = 0;
  std::vector<OpenBlock> open_;
  int nesting_ = 0;
  bool panic_ = false;  ///< an item is broken: say nothing more until it ends
  bool endReported_ = false;
  bool firstInBlock_ = true;  ///< so that a block does not start with a blank line
};

}  // namespace axil::simeco::syntax
