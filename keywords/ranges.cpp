// Numbers as they are written, in digits, in English words, in Chinese characters, and the ranges of botanists.
#include "keywords/quantities.hpp"

#include "keywords/token_tests.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace axil::keywords {

namespace {

int digitOf(std::string_view han) {
  constexpr std::array<std::pair<std::string_view, int>, 15> digits{{{"零", 0}, {"〇", 0}, {"一", 1}, {"二", 2}, {"兩", 2}, {"两", 2}, {"三", 3}, {"四", 4}, {"五", 5}, {"六", 6},
                                                                      {"七", 7}, {"八", 8}, {"九", 9}, {"壹", 1}, {"貳", 2}}};
  for (const auto& [text, digit] : digits)
    if (text == han) return digit;
  return -1;
}

double scaleOf(std::string_view han) { return han == "十" ? 10 : han == "百" ? 100 : han == "千" ? 1000 : 0; }

// 二十五, 一百二十: digits and what they are multiplied by.
std::optional<SingleNumber> wholeHan(const Tokens& tokens, std::size_t first) {
  double sum = 0;
  int digit = -1;
  std::size_t at = first;
  constexpr std::size_t longest = 12;  // characters of a number; an endless one must not be read again from each of them
  for (; at < tokens.size() && at < first + longest && tokens[at].kind == TokenKind::Han; ++at) {
    if (const int next = digitOf(tokens[at].text); next >= 0) {
      if (digit > 0) break;  // 三四: two numbers side by side
      digit = next;
    } else if (const double scale = scaleOf(tokens[at].text); scale > 0) {
      sum += (digit < 0 ? 1 : digit) * scale;
      digit = -1;
    } else {
      break;
    }
  }
  if (at == first) return std::nullopt;
  return SingleNumber{sum + std::max(digit, 0), at};
}

std::optional<SingleNumber> hanNumber(const Tokens& tokens, std::size_t first) {
  std::optional<SingleNumber> whole = wholeHan(tokens, first);
  if (!whole || !isAny(tokens, whole->end, {"點", "点"})) return whole;
  const int tenths = whole->end + 1 < tokens.size() ? digitOf(tokens[whole->end + 1].text) : -1;
  if (tenths < 0) return whole;
  return SingleNumber{whole->value + 0.1 * tenths, whole->end + 2};
}

std::optional<SingleNumber> englishNumber(const Tokens& tokens, std::size_t first) {
  constexpr std::array<std::string_view, 21> words{"zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen",
                                                   "seventeen", "eighteen", "nineteen", "twenty"};
  constexpr std::array<std::string_view, 10> tens{"", "", "", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"};
  if (const auto found = std::find(words.begin() + 1, words.end(), tokens[first].text); found != words.end()) return SingleNumber{static_cast<double>(found - words.begin()), first + 1};
  if (const auto found = std::find(tens.begin() + 3, tens.end(), tokens[first].text); found != tens.end()) return SingleNumber{10.0 * static_cast<double>(found - tens.begin()), first + 1};
  return std::nullopt;
}

// "(12-)" or "(12)-" or, before a digit, "(12)".
std::optional<double> takeMinimum(const Tokens& tokens, std::size_t& at) {
  if (!isOpen(tokens, at)) return std::nullopt;
  const auto minimum = numberAt(tokens, at + 1);
  if (!minimum) return std::nullopt;
  std::size_t next = minimum->end;
  const bool dashed = isAny(tokens, next, {"-", "to", "或", "or"});
  if (dashed) ++next;
  if (!isClose(tokens, next)) return std::nullopt;
  ++next;
  if (!dashed && is(tokens, next, "-")) ++next;
  const auto low = numberAt(tokens, next);
  if (!low || low->value < minimum->value || isAny(tokens, low->end, {")", "]"})) return std::nullopt;
  at = next;
  return minimum->value;
}

// "10+", 十餘, "1-several", 1至數: no upper end is given. The token after it, 0 where there is none.
std::size_t afterOpenEnd(const Tokens& tokens, std::size_t at) {
  if (is(tokens, at, "+") && !isOpen(tokens, at + 1)) return at + 1;
  if (isAny(tokens, at, {"餘", "余"})) return at + 1;
  const std::size_t joined = isTo(tokens, at) ? at + 1 : 0;
  if (joined == 0) return 0;
  if (isAny(tokens, joined, {"several", "many", "numerous", "more"})) return joined + 1;
  if (isAny(tokens, joined, {"多", "數", "数"}) && isAny(tokens, joined + 1, {"數", "数"})) return joined + 2;
  return isAny(tokens, joined, {"多", "數", "数"}) ? joined + 1 : 0;
}

// "3- or 4-", "3- to 5-": the hyphen belongs to the word that follows.
std::size_t afterJoin(const Tokens& tokens, std::size_t at) {
  if (is(tokens, at, "-") && isAny(tokens, at + 1, {"or", "to", "-"})) return at + 2;
  return isTo(tokens, at) ? at + 1 : 0;
}

// "3(?) cm", "8(-?) cm": the author was not sure; the number stands.
std::size_t afterDoubt(const Tokens& tokens, std::size_t at) {
  if (!isOpen(tokens, at)) return at;
  const std::size_t mark = is(tokens, at + 1, "-") ? at + 2 : at + 1;
  return is(tokens, mark, "?") && isClose(tokens, mark + 1) ? mark + 2 : at;
}

// "0 or 1-4", "5-10 or 20", "3(or 5-9)": what stands beside the usual range is its rare end.
void takeOther(const Tokens& tokens, NumberRange& range, std::size_t& at) {
  const bool bracket = isOpen(tokens, at) && isAny(tokens, at + 1, {"or", "或", "rarely", "-"});
  const bool hyphens = is(tokens, at, "-") && isAny(tokens, at + 1, {"or", "或"});
  std::size_t next = bracket ? at + 2 : hyphens ? at + 2 : isAny(tokens, at, {"or", "或"}) ? at + 1 : 0;
  if (next == 0) return;
  const auto low = numberAt(tokens, next);
  if (!low || low->value <= range.high) return;
  next = low->end;
  double high = low->value;
  if (is(tokens, next, "-"))
    if (const auto upper = numberAt(tokens, next + 1); upper && upper->value > high) {
      high = upper->value;
      next = upper->end;
    }
  if (bracket && !isClose(tokens, next)) return;
  const bool leftIsSingle = range.low == range.high && !range.minimum && !range.maximum;
  if (!bracket && leftIsSingle && high > low->value) {
    range.minimum = range.low;
    range.low = low->value;
    range.high = high;
  } else if (bracket || !leftIsSingle) {
    range.maximum = high;
  } else {
    return;
  }
  at = bracket ? next + 1 : next;
}

}  // namespace

std::optional<double> takeMaximum(const Tokens& tokens, std::size_t& at, double high) {
  std::size_t next = at;
  if (is(tokens, next, "-") && isOpen(tokens, next + 1)) ++next;
  if (!isOpen(tokens, next)) return std::nullopt;
  ++next;
  if (isTo(tokens, next)) ++next;
  if (isAny(tokens, next, {"rarely", "sometimes", "稀", "to"})) ++next;
  const auto maximum = numberAt(tokens, next);
  if (!maximum || maximum->value <= high) return std::nullopt;
  const std::size_t close = is(tokens, maximum->end, "+") ? maximum->end + 1 : maximum->end;  // "(8+)"
  if (!isClose(tokens, close)) return std::nullopt;
  at = close + 1;
  return maximum->value;
}

std::optional<SingleNumber> numberAt(const Tokens& tokens, std::size_t first) {
  if (first >= tokens.size()) return std::nullopt;
  switch (tokens[first].kind) {
    case TokenKind::Number: return SingleNumber{tokens[first].number, first + 1};
    case TokenKind::Han: return hanNumber(tokens, first);
    case TokenKind::Word: return englishNumber(tokens, first);
    case TokenKind::Sign: return std::nullopt;
  }
  return std::nullopt;
}

std::optional<NumberRange> rangeAt(const Tokens& tokens, std::size_t first) {
  NumberRange range;
  std::size_t at = first;
  range.minimum = takeMinimum(tokens, at);
  const auto low = numberAt(tokens, at);
  if (!low) return std::nullopt;
  range.low = range.high = low->value;
  at = low->end;
  if (const std::size_t joined = afterJoin(tokens, at)) {
    const auto high = numberAt(tokens, joined);
    // "0 or 1-4" is not "0 to 1": the second number begins a range of its own.
    const bool beginsRange = high && isAny(tokens, joined - 1, {"or", "或"}) && is(tokens, high->end, "-") && numberAt(tokens, high->end + 1) && !range.minimum;
    if (high && high->value >= range.low && !beginsRange && !isAny(tokens, joined, {"one"})) {
      range.high = high->value;
      at = high->end;
    }
  }
  // "10-33.75-60": lowest, mean, highest.
  if (range.high > range.low && is(tokens, at, "-"))
    if (const auto highest = numberAt(tokens, at + 1); highest && highest->value > range.high && highest->end == at + 2 && !tokens[at].spaceBefore) {
      range.high = highest->value;
      at = highest->end;
    }
  if (const std::size_t open = range.high == range.low ? afterOpenEnd(tokens, at) : 0) {
    range.open = true;
    at = open;
  } else if (is(tokens, at, "+")) {
    ++at;
  }
  for (auto beyond = takeMaximum(tokens, at, range.high); beyond; beyond = takeMaximum(tokens, at, *range.maximum)) range.maximum = beyond;  // "1-64(-90)[-100]"
  takeOther(tokens, range, at);
  if (!range.maximum) range.maximum = takeMaximum(tokens, at, range.high);
  at = afterDoubt(tokens, at);
  range.end = at;
  return range;
}

}  // namespace axil::keywords
