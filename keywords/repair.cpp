#include "keywords/repair.hpp"

#include "base/text.hpp"
#include "keywords/lexicon.hpp"
#include "keywords/words.hpp"

#include <algorithm>
#include <string>

namespace axil::keywords {

namespace {

// Letters are only ever added within what was reserved, since tokens view them.
std::string_view stored(std::string& letters, std::string_view text) {
  if (letters.size() + text.size() > letters.capacity()) return {};
  const std::size_t from = letters.size();
  letters += text;
  return std::string_view(letters).substr(from);
}

bool touches(const std::vector<Token>& tokens, std::size_t i) { return i < tokens.size() && !tokens[i].spaceBefore; }

bool isDigitLike(char c) { return (c >= '0' && c <= '9') || c == 'l' || c == 'i' || c == 'o' || c == '.'; }

std::string asNumber(std::string text) {
  for (char& c : text) c = c == 'o' ? '0' : c == 'l' || c == 'i' ? '1' : c;
  return text;
}

std::string asWord(std::string text, char one) {
  for (char& c : text) c = c == '0' ? 'o' : c == '1' ? one : c == '5' ? 's' : c;
  return text;
}

// Tokens [at, end) as one.
Token joined(const std::vector<Token>& tokens, std::size_t at, std::size_t end, TokenKind kind, std::string_view text) {
  Token token = tokens[at];
  token.kind = kind;
  token.text = text;
  token.end = tokens[end - 1].end;
  token.stop = tokens[end - 1].stop;
  if (kind == TokenKind::Number) token.number = parseNumber(text).value_or(0);
  return token;
}

class Repair {
 public:
  explicit Repair(TokenList& list) : letters_(list.letters), tokens_(list.tokens) {}

  std::vector<Token> all() {
    std::vector<Token> out;
    out.reserve(tokens_.size());
    for (std::size_t i = 0; i < tokens_.size();) {
      const std::size_t taken = repairAt(i, out);
      if (taken == 0) out.push_back(tokens_[i]);
      i += std::max<std::size_t>(taken, 1);
    }
    return out;
  }

 private:
  [[nodiscard]] bool isWord(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::Word; }
  [[nodiscard]] bool isNumber(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::Number; }
  [[nodiscard]] bool is(std::size_t i, std::string_view text) const { return i < tokens_.size() && tokens_[i].text == text; }

  // Puts a repaired token to `out`; how many tokens it was made of, 0 for none.
  std::size_t repairAt(std::size_t i, std::vector<Token>& out) {
    if (const std::size_t taken = brokenWord(i, out)) return taken;
    if (const std::size_t taken = mixedRun(i, out)) return taken;
    if (const std::size_t taken = letterForDigit(i, out)) return taken;
    if (const std::size_t taken = decimalComma(i, out)) return taken;
    if (const std::size_t taken = decimalList(i, out)) return taken;
    if (const std::size_t taken = fraction(i, out)) return taken;
    return brokenUnit(i, out);
  }

  std::size_t put(std::vector<Token>& out, std::size_t at, std::size_t end, TokenKind kind, const std::string& text) {
    const std::string_view kept = stored(letters_, text);
    if (kept.empty()) return 0;
    out.push_back(joined(tokens_, at, end, kind, kept));
    return end - at;
  }

  // "lanceo-\nlate", "lanceo- late".
  std::size_t brokenWord(std::size_t i, std::vector<Token>& out) {
    if (!isWord(i) || !is(i + 1, "-") || !touches(tokens_, i + 1) || !isWord(i + 2)) return 0;
    if (isKnownWord(tokens_[i].text) && isKnownWord(tokens_[i + 2].text)) return 0;
    const std::string whole = std::string(tokens_[i].text) + std::string(tokens_[i + 2].text);
    return isKnownWord(whole) ? put(out, i, i + 3, TokenKind::Word, whole) : 0;
  }

  // "e1liptic", "1O": letters and digits without a blank between.
  std::size_t mixedRun(std::size_t i, std::vector<Token>& out) {
    std::size_t end = i;
    bool letters = false;
    bool digits = false;
    std::string text;
    while (end < tokens_.size() && (end == i || touches(tokens_, end)) && (isWord(end) || isNumber(end))) {
      letters = letters || isWord(end);
      digits = digits || isNumber(end);
      text += tokens_[end++].text;
    }
    if (!letters || !digits || text.size() > 40) return 0;
    if (std::all_of(text.begin(), text.end(), isDigitLike) && parseNumber(asNumber(text))) return put(out, i, end, TokenKind::Number, asNumber(text));
    for (const char one : {'l', 'i'})
      if (const std::string word = asWord(text, one); isKnownWord(word)) return put(out, i, end, TokenKind::Word, word);
    return 0;
  }

  [[nodiscard]] bool unitFollows(std::size_t i) const {
    for (std::size_t k = i; k < tokens_.size() && k < i + 8; ++k) {
      if (isOneOf(tokens_[k].text, {"cm", "mm", "m", "dm", "公", "厘", "毫", "crn", "rnm"})) return true;
      if (isWord(k) && !isOneOf(tokens_[k].text, {"to", "x", "long", "l", "i", "o", "lo"})) return false;
    }
    return false;
  }

  // "l-3 cm", "O.5 cm": a letter where a number must stand.
  std::size_t letterForDigit(std::size_t i, std::vector<Token>& out) {
    if (!isWord(i) || tokens_[i].text.size() > 3 || !std::all_of(tokens_[i].text.begin(), tokens_[i].text.end(), isDigitLike)) return 0;
    const std::string number = asNumber(std::string(tokens_[i].text));
    if (is(i + 1, ".") && touches(tokens_, i + 1) && isNumber(i + 2) && touches(tokens_, i + 2) && unitFollows(i + 3))
      return put(out, i, i + 3, TokenKind::Number, number + "." + std::string(tokens_[i + 2].text));
    const bool before = i > 1 && is(i - 1, "-") && isNumber(i - 2);
    const bool after = is(i + 1, "-") && isNumber(i + 2);
    return (before || after) && unitFollows(i + 1) ? put(out, i, i + 1, TokenKind::Number, number) : 0;
  }

  // "1,5 cm" and "1,200 m", but not the list "3,5,7".
  std::size_t decimalComma(std::size_t i, std::vector<Token>& out) {
    if (!isNumber(i) || !is(i + 1, ",") || !touches(tokens_, i + 1) || !isNumber(i + 2) || !touches(tokens_, i + 2)) return 0;
    if (is(i + 3, ",") && isNumber(i + 4) && touches(tokens_, i + 4)) return 0;
    const std::string_view whole = tokens_[i].text;
    const std::string_view rest = tokens_[i + 2].text;
    if (whole.find('.') != std::string_view::npos || rest.find('.') != std::string_view::npos || rest.size() > 3) return 0;
    const std::string text = std::string(whole) + (rest.size() == 3 ? "" : ".") + std::string(rest);
    return unitFollows(i + 3) ? put(out, i, i + 3, TokenKind::Number, text) : 0;
  }

  // 長1、8厘米: the point was lost to a sign of lists.
  std::size_t decimalList(std::size_t i, std::vector<Token>& out) {
    if (!isNumber(i) || !is(i + 1, "、") || !isNumber(i + 2) || tokens_[i + 2].text.size() != 1) return 0;
    if (tokens_[i].text.find('.') != std::string_view::npos || (i > 0 && is(i - 1, "、"))) return 0;
    const bool afterDimension = i > 0 && isOneOf(tokens_[i - 1].text, {"長", "长", "寬", "宽", "高", "徑", "径", "約", "约", "至", "-"});
    for (std::size_t k = i + 3; afterDimension && k < tokens_.size() && k < i + 8; ++k) {
      if (isOneOf(tokens_[k].text, {"cm", "mm", "m", "公", "厘", "毫", "米"})) return put(out, i, i + 3, TokenKind::Number, std::string(tokens_[i].text) + "." + std::string(tokens_[i + 2].text));
      if (!isNumber(k) && !isOneOf(tokens_[k].text, {"至", "-", "、", "到"})) return 0;
    }
    return 0;
  }

  [[nodiscard]] bool inchFollows(std::size_t i) const {
    for (std::size_t k = i; k < tokens_.size() && k < i + 6; ++k) {
      if (isOneOf(tokens_[k].text, {"in", "inch", "inches", "ft", "feet", "foot", "\""})) return true;
      if (!isNumber(k) && !isOneOf(tokens_[k].text, {"-", "to", "/", "or"})) return false;
    }
    return false;
  }

  // "1/2 in.", "1 1/4-3 in. long".
  std::size_t fraction(std::size_t i, std::vector<Token>& out) {
    if (!isNumber(i)) return 0;
    const bool mixed = isNumber(i + 1) && is(i + 2, "/") && !is(i + 1, "/");
    const std::size_t top = mixed ? i + 1 : i;
    if (!is(top + 1, "/") || !isNumber(top + 2) || !touches(tokens_, top + 1) || !touches(tokens_, top + 2)) return 0;
    const double numerator = tokens_[top].number;
    const double denominator = tokens_[top + 2].number;
    const bool usual = denominator == 2 || denominator == 3 || denominator == 4 || denominator == 8 || denominator == 16;
    if (!usual || numerator <= 0 || numerator >= denominator || !inchFollows(top + 3)) return 0;
    const double value = (mixed ? tokens_[i].number : 0) + numerator / denominator;
    return put(out, i, top + 3, TokenKind::Number, fixed(value, 3));
  }

  // 1-3' tall, 2-4" long: signs for feet and inches, right behind a number and before a word of dimension.
  std::size_t footOrInch(std::size_t i, std::vector<Token>& out) {
    if (!(is(i, "'") || is(i, "\"")) || !touches(tokens_, i)) return 0;
    const bool measured = i + 1 < tokens_.size() && isOneOf(tokens_[i + 1].text, {"long", "wide", "tall", "high", "across", "broad", "thick", "in", "by", "x", "*", "diameter"});
    const bool timesBefore = i > 1 && isOneOf(tokens_[i - 2].text, {"x", "*", "by"});
    return measured || timesBefore ? put(out, i, i + 1, TokenKind::Word, is(i, "'") ? "ft" : "in") : 0;
  }

  std::size_t brokenUnit(std::size_t i, std::vector<Token>& out) {
    if (i == 0 || !isNumber(i - 1)) return 0;
    if (const std::size_t taken = footOrInch(i, out)) return taken;
    if ((is(i, "c") || is(i, "m")) && is(i + 1, "m") && !(i + 2 < tokens_.size() && isWord(i + 2) && touches(tokens_, i + 2)))
      return put(out, i, i + 2, TokenKind::Word, is(i, "c") ? "cm" : "mm");
    if (is(i, "crn")) return put(out, i, i + 1, TokenKind::Word, "cm");
    return isWord(i) && isOneOf(tokens_[i].text, {"rnm", "mrn", "rnrn"}) ? put(out, i, i + 1, TokenKind::Word, "mm") : 0;
  }

  std::string& letters_;
  const std::vector<Token>& tokens_;
};

}  // namespace

void repairTokens(TokenList& list) {
  std::vector<Token> repaired = Repair(list).all();
  list.tokens = std::move(repaired);
}

}  // namespace axil::keywords
