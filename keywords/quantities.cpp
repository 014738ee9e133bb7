#include "keywords/quantities.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace axil::keywords {

namespace {

using Tokens = std::vector<Token>;

bool is(const Tokens& tokens, std::size_t i, std::string_view text) { return i < tokens.size() && tokens[i].text == text; }
bool isNumber(const Tokens& tokens, std::size_t i) { return i < tokens.size() && tokens[i].kind == TokenKind::Number; }
bool isOpen(const Tokens& tokens, std::size_t i) { return is(tokens, i, "(") || is(tokens, i, "["); }
bool isClose(const Tokens& tokens, std::size_t i) { return is(tokens, i, ")") || is(tokens, i, "]"); }
bool isTo(const Tokens& tokens, std::size_t i) { return is(tokens, i, "-") || is(tokens, i, "to") || is(tokens, i, "至") || is(tokens, i, "到"); }

bool isOneOf(std::string_view text, std::initializer_list<std::string_view> words) { return std::find(words.begin(), words.end(), text) != words.end(); }

// "(12-)" or "(12)-" before a range.
std::optional<double> takeMinimum(const Tokens& tokens, std::size_t& at) {
  if (!isOpen(tokens, at) || !isNumber(tokens, at + 1)) return std::nullopt;
  const bool inside = is(tokens, at + 2, "-") && isClose(tokens, at + 3);
  const bool outside = isClose(tokens, at + 2) && is(tokens, at + 3, "-");
  if (!(inside || outside) || !isNumber(tokens, at + 4)) return std::nullopt;
  const double minimum = tokens[at + 1].number;
  at += 4;
  return minimum;
}

// "(-40)", "-(40)" after a range.
std::optional<double> takeMaximum(const Tokens& tokens, std::size_t& at) {
  const bool inside = isOpen(tokens, at) && is(tokens, at + 1, "-") && isNumber(tokens, at + 2) && isClose(tokens, at + 3);
  const bool outside = is(tokens, at, "-") && isOpen(tokens, at + 1) && isNumber(tokens, at + 2) && isClose(tokens, at + 3);
  if (!inside && !outside) return std::nullopt;
  const double maximum = tokens[at + 2].number;
  at += 4;
  return maximum;
}

std::optional<int> wordNumber(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, int>, 22> words{{{"one", 1},   {"two", 2},  {"three", 3}, {"four", 4}, {"five", 5}, {"six", 6},
                                                                    {"seven", 7}, {"eight", 8}, {"nine", 9}, {"ten", 10}, {"一", 1},   {"二", 2},
                                                                    {"兩", 2},    {"两", 2},   {"三", 3},    {"四", 4},   {"五", 5},   {"六", 6},
                                                                    {"七", 7},    {"八", 8},   {"九", 9},    {"十", 10}}};
  for (const auto& [text, number] : words)
    if (text == word) return number;
  return std::nullopt;
}

bool isTimes(const Tokens& tokens, std::size_t i) { return is(tokens, i, "*") || is(tokens, i, "x") || is(tokens, i, "by"); }

struct Named {
  std::string name;
  std::size_t end = 0;
};

std::optional<Named> namedAt(const std::vector<Found>& found, std::size_t at, std::string_view property) {
  if (at >= found.size()) return std::nullopt;
  const Concept* entry = found[at].conceptAs(property);
  return entry == nullptr ? std::nullopt : std::optional(Named{entry->name, found[at].end});
}

// What stands before the number: "length ca.", 長約, "up to". Backwards over the little words to a word of dimension.
struct Lead {
  std::string dimension;
  std::string qualifier;
  std::size_t first = 0;
};

std::optional<Named> dimensionEndingAt(const std::vector<Found>& found, std::size_t end) {
  for (std::size_t back = 1; back <= 3 && back <= end; ++back) {
    const Found& f = found[end - back];
    if (f && f.end == end && f.conceptAs("dimension") != nullptr) return Named{f.conceptAs("dimension")->name, end - back};
  }
  return std::nullopt;
}

Lead leadBefore(const Tokens& tokens, const std::vector<Found>& found, std::size_t number) {
  Lead lead{{}, {}, number};
  std::size_t at = number;
  for (int steps = 0; at > 0 && steps < 5; ++steps) {
    if (const auto dimension = dimensionEndingAt(found, at)) {
      lead.dimension = dimension->name;
      lead.first = dimension->end;
      return lead;
    }
    const std::string_view before = tokens[at - 1].text;
    if (isOneOf(before, {"to", "達", "达"})) {
      lead.qualifier = "up to";
      lead.first = at - 1;
    } else if (isOneOf(before, {"ca", "about", "approximately", "約", "约"})) {
      lead.qualifier = lead.qualifier.empty() ? "about" : lead.qualifier;
      lead.first = at - 1;
    } else if (isOneOf(before, {"up", "可"}) && lead.qualifier == "up to") {
      lead.first = at - 1;
    } else if (!isOneOf(before, {".", ":", "為", "为", "有", "is", "are", "of"})) {
      return lead;
    }
    --at;
  }
  return lead;
}

Size sizeOf(const NumberRange& range, std::string unit, std::string dimension, const Lead& lead, std::size_t end) {
  return {range, std::move(unit), dimension.empty() ? lead.dimension : std::move(dimension), lead.qualifier, lead.first, end};
}

struct Measured {
  NumberRange range;
  std::string unit;
  std::string dimension;
  std::size_t end = 0;
};

// A range, its unit and the word after it, as far as they stand.
std::optional<Measured> measuredAt(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  const std::optional<NumberRange> range = rangeAt(tokens, at);
  if (!range) return std::nullopt;
  Measured m{*range, {}, {}, range->end};
  if (is(tokens, m.end, "-")) {  // "a 3-cm-long blade"
    if (namedAt(found, m.end + 1, "unit")) ++m.end;
  }
  if (const auto unit = namedAt(found, m.end, "unit")) {
    m.unit = unit->name;
    m.end = unit->end;
    std::size_t next = m.end;
    if (is(tokens, next, "-") || is(tokens, next, ".")) ++next;
    // 3 cm 長: the word of a following pair "長3公分寬2公分" belongs to the next number.
    const auto dimension = namedAt(found, next, "dimension");
    if (dimension && !isNumber(tokens, dimension->end) && !is(tokens, dimension->end, "約") && !is(tokens, dimension->end, "约")) {
      m.dimension = dimension->name;
      m.end = dimension->end;
    }
  }
  return m;
}

}  // namespace

std::optional<NumberRange> rangeAt(const Tokens& tokens, std::size_t first) {
  NumberRange range;
  std::size_t at = first;
  range.minimum = takeMinimum(tokens, at);
  if (!isNumber(tokens, at)) return std::nullopt;
  range.low = range.high = tokens[at].number;
  ++at;
  if (isTo(tokens, at) && isNumber(tokens, at + 1) && tokens[at + 1].number >= range.low) {
    range.high = tokens[at + 1].number;
    at += 2;
  }
  range.maximum = takeMaximum(tokens, at);
  range.end = at;
  return range;
}

std::optional<NumberRange> countAt(const Tokens& tokens, std::size_t first) {
  if (auto range = rangeAt(tokens, first)) return range;
  if (first >= tokens.size()) return std::nullopt;
  const std::optional<int> low = wordNumber(tokens[first].text);
  if (!low) return std::nullopt;
  NumberRange range;
  range.low = range.high = *low;
  range.end = first + 1;
  const bool joined = isTo(tokens, range.end) || is(tokens, range.end, "or") || is(tokens, range.end, "或");
  if (const auto high = joined && range.end + 1 < tokens.size() ? wordNumber(tokens[range.end + 1].text) : std::nullopt; high && *high > *low) {
    range.high = *high;
    range.end += 2;
  }
  return range;
}

std::vector<Size> sizesAt(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  std::optional<Measured> one = measuredAt(tokens, found, at);
  if (!one) return {};
  Lead lead = leadBefore(tokens, found, at);
  // "3 to 5 cm": the word before a second number is no "up to".
  if (isTimes(tokens, one->end)) {
    const std::optional<Measured> other = measuredAt(tokens, found, one->end + 1);
    if (other && !other->unit.empty()) {
      const std::string unit = one->unit.empty() ? other->unit : one->unit;
      const std::string first = one->dimension.empty() ? "length" : one->dimension;
      const std::string second = other->dimension.empty() || other->dimension == first ? "width" : other->dimension;
      return {sizeOf(one->range, unit, first, lead, other->end), sizeOf(other->range, other->unit, second, lead, other->end)};
    }
  }
  if (one->unit.empty()) return {};
  return {sizeOf(one->range, one->unit, one->dimension, lead, one->end)};
}

}  // namespace axil::keywords
