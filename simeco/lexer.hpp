#pragma once
/// \file
/// Lexer: SimEco text as tokens, one at a time, without an allocation per token. Tokens are places in the text; comments
/// are kept aside, in order, until the parser asks for them. Bytes that belong to no token are reported once per run.
/// An editor's colouring reads the same tokens.

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/source.hpp"
#include "simeco/report.hpp"

namespace axil::simeco {

enum class TokenKind : std::uint8_t {
  End,
  Word,
  Number,
  Text,
  LeftBrace,
  RightBrace,
  LeftParen,
  RightParen,
  LeftBracket,
  RightBracket,
  Comma,
  Semicolon,
  Assign,
  Colon,
  Bar,
  Arrow,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Equal,
  NotEqual,
  Plus,
  Minus,
  Star,
  Slash,
  Percent,
  Caret,
  AndAnd,
  OrOr,
  Not,
  Question,
};

struct Token {
  TokenKind kind = TokenKind::End;
  bool startsLine = false;   ///< first token of its line
  bool blankBefore = false;  ///< an empty line stands right above it
  SourceSpan span;
};

struct CommentToken {
  bool startsLine = false;
  bool blankBefore = false;
  SourceSpan span;
};

class Lexer {
 public:
  /// `text` must outlive the lexer, be well-formed UTF-8 and shorter than 4 GB.
  Lexer(std::string_view text, Report& report) : text_(text), report_(report) {}

  Token next();
  /// Goes back to `token`, which starts a line, so that it comes next once more.
  void rewind(const Token& token);

  /// Comments that were passed and not taken yet, in text order; the parser empties it.
  std::vector<CommentToken>& comments() { return comments_; }

 private:
  struct Gap {
    bool newline = false;
    bool blank = false;
  };
  Gap skipBlanks();
  void skipComment();
  TokenKind scan();
  TokenKind scanWord();
  TokenKind scanNumber();
  TokenKind scanText();
  TokenKind scanWide();
  TokenKind finishWideText();
  TokenKind scanSign();
  void skipUnknown();
  void report(SourceSpan span, std::string message, std::string hint);
  [[nodiscard]] char at(std::size_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  [[nodiscard]] SourceSpan from(std::size_t begin) const {
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(position_)};
  }

  std::string_view text_;
  Report& report_;
  std::size_t position_ = 0;
  std::size_t reportedUpTo_ = 0;  ///< so that text that is read twice is not reported twice
  Gap carried_ = {true, false};   ///< the first token starts a line
  std::vector<CommentToken> comments_;
};

}  // namespace axil::simeco
