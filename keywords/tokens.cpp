#include "keywords/tokens.hpp"

#include "base/result.hpp"
#include "base/text.hpp"

#include <unicode/normalizer2.h>
#include <unicode/ubrk.h>
#include <unicode/unistr.h>
#include <unicode/utext.h>

#include <algorithm>
#include <array>
#include <memory>

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
  return (c >= 0x2010 && c <= 0x2015) || c == 0x2212 || c == 0x223C || c == 0x301C || c == '~' || c == 0x02D7 || c == 0x30FC || c == 0xFF5E || c == 0xFE63 || c == '_';
}

bool isTimes(char32_t c) { return c == 0xD7 || c == 0x2715 || c == 0x2716 || c == 0x2A2F || c == 0x2A09; }

constexpr char32_t softHyphen = 0xAD;

// Characters that are written in two ways within one script.
char32_t foldedHan(char32_t c) {
  switch (c) {
    case U'濶': return U'闊';
    case U'葯': return U'藥';
    case U'爲': return U'為';
    case U'綫': return U'線';
    case U'鋭': return U'銳';
    case U'菓': return U'果';
    default: return c;
  }
}

// Signs that Unicode does not fold but botanists use alike.
char32_t foldedSign(char32_t c) {
  if (c == 0x3000 || c == 0xA0 || c == 0x2009 || c == 0x202F || c == 0xFEFF || c == 0x200B) return ' ';
  if (isDash(c)) return '-';
  if (isTimes(c)) return '*';
  if (c == 0x3014 || c == 0x3010) return '(';
  if (c == 0x3015 || c == 0x3011) return ')';
  if (c == 0x2019 || c == 0x2032) return '\'';  // feet
  if (c == 0x201D || c == 0x2033) return '"';   // inches
  return c;
}

// What a character is folded to: mostly one character, for ligatures and units in one sign a few.
struct Folded {
  std::array<char32_t, 3> codes{};
  std::size_t count = 0;
};

Folded foldedByUnicode(char32_t c) {
  UErrorCode status = U_ZERO_ERROR;
  const icu::Normalizer2* normalizer = icu::Normalizer2::getNFKCCasefoldInstance(status);
  AXIL_ASSERT(U_SUCCESS(status) != 0, "ICU has no normalisation data");
  icu::UnicodeString text = normalizer->normalize(icu::UnicodeString(static_cast<UChar32>(c)), status);
  Folded folded;
  if (U_FAILURE(status) != 0 || text.countChar32() > 3) return {{c}, 1};
  for (int32_t i = 0; i < text.length(); i = text.moveIndex32(i, 1)) folded.codes[folded.count++] = static_cast<char32_t>(text.char32At(i));
  return folded;
}

Folded folded(char32_t c) {
  if (c >= 'A' && c <= 'Z') return {{c + 32}, 1};
  if (c < 0x80 && c != '~' && c != '_') return {{c}, 1};
  if (c == softHyphen) return {{c}, 1};
  const char32_t sign = foldedSign(c);
  if (sign != c) return {{sign}, 1};
  if (c >= 0x4E00 && c <= 0x9FFF) return {{foldedHan(c)}, 1};  // the other unified ideographs stand for themselves
  const Folded text = foldedByUnicode(c);
  return text.count == 1 ? Folded{{foldedSign(text.codes[0])}, 1} : text;
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
class Reader {
 public:
  Reader(std::string_view text, std::uint32_t firstByte, std::size_t firstCharacter) : text_(text), firstByte_(firstByte), character_(firstCharacter) { look(); }

  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  [[nodiscard]] char32_t peek() const { return done() ? 0 : here_.codes[0]; }
  [[nodiscard]] Folded peekFolded() const { return done() ? Folded{} : here_; }
  [[nodiscard]] char32_t peekSecond() const {
    const std::size_t next = at_ + length_;
    return next >= text_.size() ? 0 : folded(decodeAt(text_, next).code).codes[0];
  }
  Folded take() {
    const Folded taken = here_;
    at_ += length_;
    ++character_;
    look();
    return taken;
  }
  [[nodiscard]] std::uint32_t byte() const { return firstByte_ + static_cast<std::uint32_t>(at_); }
  [[nodiscard]] std::size_t character() const { return character_; }

 private:
  void look() {
    if (done()) return;
    const Decoded decoded = decodeAt(text_, at_);
    length_ = decoded.length;
    here_ = folded(decoded.code);
  }

  std::string_view text_;
  std::uint32_t firstByte_;
  std::size_t at_ = 0;
  std::size_t character_ = 0;
  std::size_t length_ = 1;
  Folded here_;
};

constexpr char32_t fractionSlash = 0x2044;

// "½" is one character that Unicode folds to "1⁄2"; as decimals, without the zero before the point.
std::string decimalsOf(const Folded& folded) {
  if (folded.count != 3 || folded.codes[1] != fractionSlash) return {};
  const double value = static_cast<double>(folded.codes[0] - '0') / static_cast<double>(folded.codes[2] - '0');
  constexpr double places = 1000;
  std::string digits = std::to_string(static_cast<int>(value * places + 0.5));
  digits.insert(0, 3 - std::min<std::size_t>(3, digits.size()), '0');
  while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
  return "." + digits;
}

void append(std::string& letters, const Folded& folded) {
  for (std::size_t i = 0; i < folded.count; ++i) appendUtf8(letters, folded.codes[i]);
}

TokenKind takeToken(Reader& reader, std::string& letters, const Token& before) {
  const Folded taken = reader.take();
  const char32_t first = taken.codes[0];
  if (const std::string decimals = decimalsOf(taken); !decimals.empty()) {
    letters += "0" + decimals;
    return TokenKind::Number;
  }
  const bool startsWithPoint = first == '.' && before.spaceBefore && isDigit(reader.peek());  // ".3 mm long"
  if (startsWithPoint) letters += '0';
  append(letters, taken);
  if (isHan(first)) return TokenKind::Han;
  if (isDigit(first) || startsWithPoint) {
    for (bool point = startsWithPoint;;) {
      if (const std::string decimals = decimalsOf(reader.peekFolded()); !decimals.empty()) {  // "1½"
        reader.take();
        if (!point) letters += decimals;
        break;
      }
      const bool isPoint = !startsWithPoint && reader.peek() == '.' && isDigit(reader.peekSecond());
      if (!isDigit(reader.peek()) && !isPoint) break;
      point = point || isPoint;
      append(letters, reader.take());
    }
    return TokenKind::Number;
  }
  if (first == '-') {  // "3--5" and "3—5" are one dash
    while (reader.peek() == '-') reader.take();
    return TokenKind::Sign;
  }
  if (!isLetter(first)) return TokenKind::Sign;
  while (isLetter(reader.peek()) || (reader.peek() == softHyphen)) {
    const Folded next = reader.take();
    if (next.codes[0] != softHyphen) append(letters, next);
  }
  return TokenKind::Word;
}

bool isVisible(char32_t c) { return !isBlank(c) && c != softHyphen && c != 0; }

// ---- word breaks

struct CloseBreaks {
  void operator()(UBreakIterator* breaks) const { ubrk_close(breaks); }
};
struct CloseText {
  void operator()(UText* text) const { utext_close(text); }
};

// Chinese has no blanks between words; Unicode's word breaks know a dictionary. A character in a longer word is marked.
void markLongWords(std::string_view text, std::uint32_t firstByte, std::vector<Token>& tokens) {
  UErrorCode status = U_ZERO_ERROR;
  const std::unique_ptr<UText, CloseText> view(utext_openUTF8(nullptr, text.data(), static_cast<std::int64_t>(text.size()), &status));
  static thread_local const std::unique_ptr<UBreakIterator, CloseBreaks> breaks(ubrk_open(UBRK_WORD, "zh", nullptr, 0, &status));
  ubrk_setUText(breaks.get(), view.get(), &status);
  if (U_FAILURE(status) != 0) return;  // without a dictionary every character is a word of its own
  std::size_t token = 0;
  std::int32_t begin = ubrk_first(breaks.get());
  for (std::int32_t end = ubrk_next(breaks.get()); end != UBRK_DONE; begin = end, end = ubrk_next(breaks.get())) {
    while (token < tokens.size() && tokens[token].begin < firstByte + static_cast<std::uint32_t>(begin)) ++token;
    const bool severalHan = end - begin > 4;  // a character has three bytes, rarely four
    for (; token < tokens.size() && tokens[token].end <= firstByte + static_cast<std::uint32_t>(end); ++token)
      tokens[token].insideWord = severalHan && tokens[token].kind == TokenKind::Han;
  }
}

}  // namespace

void tokenize(std::string_view text, std::uint32_t firstByte, std::size_t firstCharacter, TokenList& into) {
  into.tokens.clear();
  into.letters.clear();
  // Tokens view the letters, so these must never move. Folding a character gives at most three, of three bytes at most.
  into.letters.reserve(text.size() * 3 + 16);
  Reader reader(text, firstByte, firstCharacter);
  bool space = false;
  bool lineBreak = false;
  bool anyHan = false;
  while (!reader.done()) {
    if (!isVisible(reader.peek())) {
      lineBreak = lineBreak || reader.peek() == '\n';
      space = space || reader.peek() != softHyphen;
      reader.take();
      continue;
    }
    Token token;
    token.spaceBefore = space;
    token.lineBreakBefore = lineBreak;
    token.begin = reader.byte();
    token.start = reader.character();
    const std::size_t from = into.letters.size();
    token.kind = takeToken(reader, into.letters, token);
    token.text = std::string_view(into.letters).substr(from);
    token.end = reader.byte();
    token.stop = reader.character();
    if (token.kind == TokenKind::Number) {
      const auto number = parseNumber(token.text);
      if (number) token.number = *number; else token.kind = TokenKind::Sign;
    }
    anyHan = anyHan || token.kind == TokenKind::Han;
    into.tokens.push_back(token);
    space = lineBreak = false;
  }
  into.anyHan = anyHan;
}

void markWords(std::string_view text, std::uint32_t firstByte, TokenList& list) {
  if (list.anyHan) markLongWords(text, firstByte, list.tokens);
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
