#include "simeco/lexer.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/text.hpp"

namespace axil::simeco {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isWordPart(char c) { return isWordStart(c) || isDigit(c); }
bool isWide(char c) { return static_cast<unsigned char>(c) >= 0x80; }

constexpr std::string_view kWideBlanks[] = {"\u3000", "\u00A0", "\uFEFF"};

struct WideSign {
  std::string_view wide;
  char plain;
};
// What a Chinese keyboard gives for our signs, beyond the full-width forms of ASCII.
constexpr WideSign kWideSigns[] = {{"“", '"'}, {"”", '"'}, {"、", ','}, {"。", '.'}, {"【", '['}, {"】", ']'}, {"−", '-'}, {"–", '-'}};

std::size_t wideBlankAt(std::string_view rest) {
  for (const std::string_view blank : kWideBlanks)
    if (rest.starts_with(blank)) return blank.size();
  return 0;
}

/// The ASCII sign that the character at the front of `rest` is a wide form of, or 0. Wide letters and digits are words.
char plainSign(std::string_view rest) {
  for (const WideSign& sign : kWideSigns)
    if (rest.starts_with(sign.wide)) return sign.plain;
  if (rest.size() < 3 || rest[0] != '\xEF') return '\0';
  const auto second = static_cast<unsigned char>(rest[1]);
  const auto third = static_cast<unsigned char>(rest[2]);
  if ((second != 0xBC || third < 0x81) && (second != 0xBD || third > 0x9E)) return '\0';
  const int code = (second == 0xBC ? third - 0x80 : third - 0x80 + 0x40) + 0x20;  // U+FF01 is '!'
  const char plain = static_cast<char>(code);
  return isWordPart(plain) ? '\0' : plain;
}

}  // namespace

void Lexer::report(SourceSpan span, std::string message, std::string hint) {
  if (span.begin < reportedUpTo_) return;
  reportedUpTo_ = span.begin + 1;
  report_.error(span, std::move(message), std::move(hint));
}

Token Lexer::next() {
  for (;;) {
    const Gap gap = skipBlanks();
    const std::size_t begin = position_;
    if (begin >= text_.size()) return {TokenKind::End, gap.newline, gap.blank, from(begin)};
    if (text_[begin] == '/' && (at(begin + 1) == '/' || at(begin + 1) == '*')) {
      skipComment();
      comments_.push_back({gap.newline, gap.blank, from(begin)});
      continue;
    }
    const TokenKind kind = scan();
    if (kind != TokenKind::End) return {kind, gap.newline, gap.blank, from(begin)};
    skipUnknown();
    carried_ = gap;
  }
}

void Lexer::rewind(const Token& token) {
  position_ = token.span.begin;
  carried_ = {token.startsLine, token.blankBefore};
  while (!comments_.empty() && comments_.back().span.begin >= position_) comments_.pop_back();
}

Lexer::Gap Lexer::skipBlanks() {
  Gap gap = std::exchange(carried_, {});
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '\n') {
      gap.blank = gap.blank || gap.newline;
      gap.newline = true;
    } else if (isWide(c)) {
      const std::size_t length = wideBlankAt(text_.substr(position_));
      if (length == 0) break;
      position_ += length - 1;
    } else if (c != ' ' && c != '\t' && c != '\r' && c != '\f' && c != '\v') {
      break;
    }
    ++position_;
  }
  return gap;
}

void Lexer::skipComment() {
  const std::size_t begin = position_;
  const bool toLineEnd = text_[begin + 1] == '/';
  const std::size_t end = toLineEnd ? text_.find('\n', begin) : text_.find("*/", begin + 2);
  if (end == std::string_view::npos && !toLineEnd)
    report({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + 2)}, "the comment is never closed", "end it with */");
  position_ = end == std::string_view::npos ? text_.size() : (toLineEnd ? end : end + 2);
}

TokenKind Lexer::scan() {
  const char c = text_[position_];
  if (isWordStart(c)) return scanWord();
  if (isDigit(c) || (c == '.' && isDigit(at(position_ + 1)))) return scanNumber();
  if (c == '"') return scanText();
  return isWide(c) ? scanWide() : scanSign();
}

TokenKind Lexer::scanWord() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (isWide(c)) {
      const std::string_view rest = text_.substr(position_);
      if (plainSign(rest) != '\0' || wideBlankAt(rest) > 0) break;
      position_ += utf8Length(c);
    } else if (isWordPart(c)) {
      ++position_;
    } else {
      break;
    }
  }
  return TokenKind::Word;
}

TokenKind Lexer::scanNumber() {
  const auto digits = [this] {
    while (isDigit(at(position_))) ++position_;
  };
  digits();
  if (at(position_) == '.') {
    ++position_;
    digits();
  }
  const char e = at(position_);
  const char sign = at(position_ + 1);
  const std::size_t skip = sign == '+' || sign == '-' ? 2 : 1;
  if ((e == 'e' || e == 'E') && isDigit(at(position_ + skip))) {
    position_ += skip;
    digits();
  }
  return TokenKind::Number;
}

// A doubled quote stands for a quote; a backslash is itself, since the texts are file names.
TokenKind Lexer::scanText() {
  const std::size_t begin = position_++;
  for (; position_ < text_.size() && text_[position_] != '\n'; ++position_) {
    if (text_[position_] != '"') continue;
    ++position_;
    if (at(position_) != '"') return TokenKind::Text;
  }
  report(from(begin), "the text has no closing quote on its line", "end it with \"");
  return TokenKind::Text;
}

// A wide form of one of our signs is reported and then read as the sign, so that nothing else goes wrong because of it.
TokenKind Lexer::scanWide() {
  const std::string_view rest = text_.substr(position_);
  const char plain = plainSign(rest);
  if (plain == '\0') return scanWord();
  const std::size_t begin = position_;
  position_ += utf8Length(rest[0]);
  report(from(begin), "'" + std::string(rest.substr(0, position_ - begin)) + "' is the wide form of a sign",
         std::string("write '") + plain + "'");
  switch (plain) {
    case '(':
      return TokenKind::LeftParen;
    case ')':
      return TokenKind::RightParen;
    case '[':
      return TokenKind::LeftBracket;
    case ']':
      return TokenKind::RightBracket;
    case '{':
      return TokenKind::LeftBrace;
    case '}':
      return TokenKind::RightBrace;
    case ';':
      return TokenKind::Semicolon;
    case ',':
      return TokenKind::Comma;
    case ':':
      return TokenKind::Colon;
    case '=':
      return TokenKind::Assign;
    case '+':
      return TokenKind::Plus;
    case '-':
      return TokenKind::Minus;
    case '*':
      return TokenKind::Star;
    case '/':
      return TokenKind::Slash;
    case '<':
      return TokenKind::Less;
    case '>':
      return TokenKind::Greater;
    case '"':
      return finishWideText();
    default:
      position_ = begin;
      return TokenKind::End;
  }
}

TokenKind Lexer::finishWideText() {
  while (position_ < text_.size() && text_[position_] != '\n') {
    const std::string_view rest = text_.substr(position_);
    position_ += utf8Length(rest[0]);
    if (rest[0] == '"' || plainSign(rest) == '"') break;
  }
  return TokenKind::Text;
}

TokenKind Lexer::scanSign() {
  const auto take = [this](std::size_t length, TokenKind kind) {
    position_ += length;
    return kind;
  };
  const char second = at(position_ + 1);
  switch (text_[position_]) {
    case '{':
      return take(1, TokenKind::LeftBrace);
    case '}':
      return take(1, TokenKind::RightBrace);
    case '(':
      return take(1, TokenKind::LeftParen);
    case ')':
      return take(1, TokenKind::RightParen);
    case '[':
      return take(1, TokenKind::LeftBracket);
    case ']':
      return take(1, TokenKind::RightBracket);
    case ',':
      return take(1, TokenKind::Comma);
    case ';':
      return take(1, TokenKind::Semicolon);
    case ':':
      return take(1, TokenKind::Colon);
    case '+':
      return take(1, TokenKind::Plus);
    case '*':
      return take(1, TokenKind::Star);
    case '/':
      return take(1, TokenKind::Slash);
    case '%':
      return take(1, TokenKind::Percent);
    case '^':
      return take(1, TokenKind::Caret);
    case '?':
      return take(1, TokenKind::Question);
    case '-':
      return second == '>' ? take(2, TokenKind::Arrow) : take(1, TokenKind::Minus);
    case '=':
      return second == '=' ? take(2, TokenKind::Equal) : take(1, TokenKind::Assign);
    case '!':
      return second == '=' ? take(2, TokenKind::NotEqual) : take(1, TokenKind::Not);
    case '<':
      return second == '=' ? take(2, TokenKind::LessEqual) : take(1, TokenKind::Less);
    case '>':
      return second == '=' ? take(2, TokenKind::GreaterEqual) : take(1, TokenKind::Greater);
    case '|':
      return second == '|' ? take(2, TokenKind::OrOr) : take(1, TokenKind::Bar);
    case '&':
      return second == '&' ? take(2, TokenKind::AndAnd) : TokenKind::End;
    default:
      return TokenKind::End;
  }
}

namespace {

/// What someone may have meant with signs that SimEco does not know.
std::string meantBy(std::string_view run) {
  if (run.starts_with('&')) return "write && for and";
  if (run.starts_with('#')) return "a comment starts with //";
  if (run.starts_with('\'') || run.starts_with("\u2018") || run.starts_with("\u2019") || run.starts_with("\u201c") || run.starts_with("\u201d")) return "names and texts stand in \"...\"";
  if (run.starts_with("\u2212") || run.starts_with("\u2013")) return "the minus sign is -";
  if (run.starts_with("\u2192")) return "the arrow is ->";
  return "remove it";
}

/// At most so many bytes, and no sign cut in two.
std::size_t validPrefix(std::string_view text, std::size_t most) {
  std::size_t end = 0;
  while (end < text.size() && end + utf8Length(text[end]) <= most) end += utf8Length(text[end]);
  return std::min(end, text.size());
}

}  // namespace

void Lexer::skipUnknown() {
  const std::size_t begin = position_;
  constexpr std::string_view known = " \t\r\n\f\v{}()[],;:+-*/%^?=!<>|\"";
  position_ += utf8Length(text_[position_]);
  while (position_ < text_.size() && !isWordPart(text_[position_]) && !isWide(text_[position_]) &&
         known.find(text_[position_]) == std::string_view::npos)
    ++position_;
  const std::string_view run = text_.substr(begin, position_ - begin);
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  const bool printable = std::none_of(run.begin(), run.end(), isControl);
  report(from(begin), printable ? "'" + std::string(run.substr(0, validPrefix(run, 20))) + "' means nothing here" : "a control character means nothing here", meantBy(run));
}

}  // namespace axil::simeco
