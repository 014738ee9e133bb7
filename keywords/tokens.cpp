#include "keywords/tokens.hpp"

#include "base/text.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

struct Decoded {
  char32_t code = 0;
  std::size_t length = 1;
};

Decoded decodeAt(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<char32_t>(static_cast<unsigned char>(text[i + k])); };
  const std::size_t length = utf8Length(text[i]);
  switch (length) {
    case 2: return {((byte(0) & 0x1F) << 6) | (byte(1) & 0x3F), 2};
    case 3: return {((byte(0) & 0x0F) << 12) | ((byte(1) & 0x3F) << 6) | (byte(2) & 0x3F), 3};
    case 4: return {((byte(0) & 0x07) << 18) | ((byte(1) & 0x3F) << 12) | ((byte(2) & 0x3F) << 6) | (byte(3) & 0x3F), 4};
    default: return {byte(0), 1};
  }
}

bool isDash(char32_t c) {
  return (c >= 0x2010 && c <= 0x2015) || c == 0x2212 || c == 0x223C || c == 0x301C || c == '~' || c == 0x02D7 || c == 0x30FC || c == 0x00AD;
}

bool isTimes(char32_t c) { return c == 0xD7 || c == 0x2715 || c == 0x2716 || c == 0x2A2F || c == 0x2A09; }

// Full-width forms to plain ones, all dashes to one, all multiplication signs to one, letters to lower case.
char32_t folded(char32_t c) {
  if (c >= 0xFF01 && c <= 0xFF5E) c -= 0xFEE0;
  if (c == 0x3000 || c == 0xA0 || c == 0x2009 || c == 0x202F || c == 0xFEFF || c == 0x200B) return ' ';
  if (isDash(c)) return '-';
  if (isTimes(c)) return '*';
  if (c == 0x3014 || c == 0x3010) return '(';
  if (c == 0x3015 || c == 0x3011) return ')';
  if (c >= 'A' && c <= 'Z') return c + 32;
  if (c >= 0xC0 && c <= 0xDE && c != 0xD7) return c + 32;
  return c;
}

bool isBlank(char32_t c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
bool isDigit(char32_t c) { return c >= '0' && c <= '9'; }
bool isHan(char32_t c) {
  return (c >= 0x3400 && c <= 0x9FFF) || (c >= 0xF900 && c <= 0xFAFF) || (c >= 0x20000 && c <= 0x323AF) || c == 0x3007;
}
// Latin letters with their accents, Greek and Cyrillic: all that a word may be spelled with.
bool isLetter(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 0xDF && c <= 0x52F && c != 0xF7); }

void appendUtf8(std::string& out, char32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | (c >> 6));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | (c >> 12));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | (c >> 18));
    out += static_cast<char>(0x80 | ((c >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  }
}

// Reads one character after another, folded, and remembers places.
struct Reader {
  std::string_view text;
  std::uint32_t firstByte;
  std::size_t at = 0;
  std::size_t character = 0;

  [[nodiscard]] bool done() const { return at >= text.size(); }
  [[nodiscard]] char32_t peek() const { return done() ? 0 : folded(decodeAt(text, at).code); }
  [[nodiscard]] char32_t peekSecond() const {
    const std::size_t next = at + decodeAt(text, at).length;
    return next >= text.size() ? 0 : folded(decodeAt(text, next).code);
  }
  char32_t take() {
    const Decoded d = decodeAt(text, at);
    at += d.length;
    ++character;
    return folded(d.code);
  }
  [[nodiscard]] std::uint32_t byte() const { return firstByte + static_cast<std::uint32_t>(at); }
};

TokenKind takeToken(Reader& reader, std::string& letters) {
  const char32_t first = reader.take();
  appendUtf8(letters, first);
  if (isHan(first)) return TokenKind::Han;
  if (isDigit(first)) {
    while (isDigit(reader.peek()) || (reader.peek() == '.' && isDigit(reader.peekSecond()))) appendUtf8(letters, reader.take());
    return TokenKind::Number;
  }
  if (!isLetter(first)) return TokenKind::Sign;
  while (isLetter(reader.peek())) appendUtf8(letters, reader.take());
  return TokenKind::Word;
}

}  // namespace

void tokenize(std::string_view text, std::uint32_t firstByte, std::size_t firstCharacter, TokenList& into) {
  into.tokens.clear();
  into.letters.clear();
  // Folding never lengthens a character, so the letters stay where they are while tokens view them.
  into.letters.reserve(text.size());
  Reader reader{text, firstByte, 0, firstCharacter};
  bool space = false;
  bool lineBreak = false;
  while (!reader.done()) {
    if (isBlank(reader.peek())) {
      lineBreak = lineBreak || reader.peek() == '\n';
      space = true;
      reader.take();
      continue;
    }
    Token token;
    token.spaceBefore = space;
    token.lineBreakBefore = lineBreak;
    token.begin = reader.byte();
    token.start = reader.character;
    const std::size_t from = into.letters.size();
    token.kind = takeToken(reader, into.letters);
    token.text = std::string_view(into.letters).substr(from);
    token.end = reader.byte();
    token.stop = reader.character;
    if (token.kind == TokenKind::Number) {
      const auto number = parseNumber(token.text);
      if (number) token.number = *number; else token.kind = TokenKind::Sign;
    }
    into.tokens.push_back(token);
    space = lineBreak = false;
  }
}

std::vector<std::string> wordsOf(std::string_view term) {
  TokenList list;
  tokenize(term, 0, 0, list);
  std::vector<std::string> words;
  for (const Token& token : list.tokens)
    if (token.text != "-") words.emplace_back(token.text);
  return words;
}

}  // namespace axil::keywords
