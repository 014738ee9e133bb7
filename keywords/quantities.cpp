// Sizes: a range, its unit, what it measures, and the words before it.
#include "keywords/quantities.hpp"

#include "base/text.hpp"
#include "keywords/token_tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace axil::keywords {

namespace {

struct Named {
  std::string name;
  std::size_t end = 0;
};

std::optional<Named> namedAt(const std::vector<Found>& found, std::size_t at, std::string_view property) {
  if (at >= found.size()) return std::nullopt;
  const Concept* entry = found[at].conceptAs(property);
  return entry == nullptr ? std::nullopt : std::optional(Named{entry->name, found[at].end});
}

std::optional<Named> dimensionEndingAt(const std::vector<Found>& found, std::size_t end) {
  for (std::size_t back = std::min<std::size_t>(4, end); back >= 1; --back) {
    const Found& f = found[end - back];
    if (f && f.end == end && f.conceptAs("dimension") != nullptr) return Named{f.conceptAs("dimension")->name, end - back};
  }
  return std::nullopt;
}

struct Measured {
  NumberRange range;
  std::string unit;
  std::string dimension;
  std::size_t end = 0;
  std::string also = {};       // "3 m tall and wide": the second dimension
  std::string qualifier = {};  // "15-21 × ca. 8 mm"
};

bool isTimes(const Tokens& tokens, std::size_t i) { return isAny(tokens, i, {"*", "x", "by"}); }

// 長3公分寬2公分: the word of dimension belongs to the number that follows it.
bool leadsToNumber(const Tokens& tokens, std::size_t at) {
  while (isAny(tokens, at, {"約", "约", "可", "達", "达", "各", "為", "为"})) ++at;
  return numberAt(tokens, at).has_value() || isOpen(tokens, at);
}

std::string takeDimension(const Tokens& tokens, const std::vector<Found>& found, std::size_t& end) {
  std::size_t next = end;
  if (isAny(tokens, next, {"-", "."})) ++next;
  if (is(tokens, next, "or") && isAny(tokens, next + 1, {"more", "less"})) next += 2;
  if (is(tokens, next, "(") ) return {};
  const auto dimension = namedAt(found, next, "dimension");
  if (!dimension || (tokens[next].kind == TokenKind::Han && leadsToNumber(tokens, dimension->end))) return {};
  end = dimension->end;
  return dimension->name;
}

double metresIn(std::string_view unit) {
  for (const Concept& entry : categoryOf("unit").concepts)
    if (entry.name == unit) return parseNumber(entry.columns.at("metres")).value_or(0);
  return 0;
}

// "in" is an inch and much more often a little word: "5 in long", "5 in.", but not "13 in 2 series".
bool isInchRatherThanIn(const Tokens& tokens, const std::vector<Found>& found, std::size_t unitAt, std::size_t end) {
  if (!is(tokens, unitAt, "in") || end >= tokens.size() || tokens[end].kind == TokenKind::Sign) return true;
  return namedAt(found, end, "dimension").has_value() || isAny(tokens, end, {"x", "by", "or", "and", "tall", "deep"});
}

// "5 mm-1 cm", 2公分至5公分: the upper end with a unit of its own. The range becomes one in that unit.
void takeUpperWithUnit(const Tokens& tokens, const std::vector<Found>& found, NumberRange& range, std::string& unit, std::size_t& end) {
  if (range.low != range.high || range.minimum || range.maximum || !isAny(tokens, end, {"-", "to", "至", "到"})) return;
  const std::optional<NumberRange> upper = rangeAt(tokens, end + 1);
  if (!upper || upper->low != upper->high) return;
  const auto upperUnit = namedAt(found, upper->end, "unit");
  if (!upperUnit || metresIn(upperUnit->name) <= 0) return;
  const double low = upperUnit->name == unit ? range.low : std::round(range.low * metresIn(unit) / metresIn(upperUnit->name) * 1e6) / 1e6;
  if (low > upper->high) return;
  range.low = low;
  range.high = upper->high;
  range.maximum = upper->maximum;
  unit = upperUnit->name;
  end = upperUnit->end;
}

// 長5-8、寬3-4公分, "5-8 long and 3-4 cm wide": the unit stands once, behind the last. Nothing where it does not.
std::string unitOfNext(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  if (!isAny(tokens, at, {",", "、", "and", "by"})) return {};
  std::size_t next = at + 1;
  const bool named = namedAt(found, next, "dimension").has_value();
  if (named) next = found[next].end;
  while (isAny(tokens, next, {"約", "约", "about", "ca", "."})) ++next;
  const std::optional<NumberRange> range = rangeAt(tokens, next);
  if (!range) return {};
  const auto unit = namedAt(found, range->end, "unit");
  if (!unit || (!named && !namedAt(found, unit->end, "dimension"))) return {};
  return isInchRatherThanIn(tokens, found, range->end, unit->end) ? unit->name : std::string();
}

// "3-10（多為5-8）公分": what is usual within the range, between the numbers and their unit. The token after it.
std::size_t afterUsual(const Tokens& tokens, std::size_t at) {
  constexpr std::size_t longest = 10;
  if (!isOpen(tokens, at) || at + 1 >= tokens.size()) return at;
  if (qualifierOf(tokens[at + 1].text) != "usually" && !isAny(tokens, at + 1, {"mean", "average", "averaging", "通", "平"})) return at;
  for (std::size_t next = at + 2; next < tokens.size() && next < at + longest; ++next)
    if (isClose(tokens, next)) return next + 1;
  return at;
}

// "8-16公分（稀達25公分）", "5-8 cm (rarely to 12 cm)": the exception with a unit of its own.
void takeRareMaximum(const Tokens& tokens, const std::vector<Found>& found, NumberRange& range, const std::string& unit, std::size_t& end) {
  if (!isOpen(tokens, end)) return;
  std::size_t at = end + 1;
  while (isAny(tokens, at, {"可", "達", "达", "長", "长", "至", "to", "up", "-"}) || (at < tokens.size() && isOneOf(qualifierOf(tokens[at].text), {"rarely", "sometimes"}))) ++at;
  const auto maximum = at > end + 1 ? numberAt(tokens, at) : std::nullopt;
  if (!maximum || maximum->value <= range.high) return;
  const auto same = namedAt(found, maximum->end, "unit");
  if (!same || same->name != unit || !isClose(tokens, same->end)) return;
  range.maximum = maximum->value;
  end = same->end + 1;
}

// A range, its unit and the word after it, as far as they stand.
std::optional<Measured> measuredAt(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  const std::optional<NumberRange> range = rangeAt(tokens, at);
  if (!range) return std::nullopt;
  Measured m{*range, {}, {}, afterUsual(tokens, range->end)};
  const std::size_t unitAt = is(tokens, m.end, "-") && namedAt(found, m.end + 1, "unit") ? m.end + 1 : m.end;  // "a 3-cm-long blade"
  const auto unit = namedAt(found, unitAt, "unit");
  if (unit && isInchRatherThanIn(tokens, found, unitAt, unit->end)) {
    m.unit = unit->name;
    m.end = unit->end;
    takeUpperWithUnit(tokens, found, m.range, m.unit, m.end);
    // "5-8 cm (-12)": the exception behind the unit.
    if (!m.range.maximum) m.range.maximum = takeMaximum(tokens, m.end, m.range.high);
    if (!m.range.maximum) takeRareMaximum(tokens, found, m.range, m.unit, m.end);
    m.dimension = takeDimension(tokens, found, m.end);
    const auto second = is(tokens, m.end, "and") && !m.dimension.empty() ? namedAt(found, m.end + 1, "dimension") : std::nullopt;
    if (second && !numberAt(tokens, second->end)) {
      m.also = second->name;
      m.end = second->end;
    }
    return m;
  }
  // 10x0.6 (公分)
  if (isOpen(tokens, m.end))
    if (const auto inside = namedAt(found, m.end + 1, "unit"); inside && isClose(tokens, inside->end)) {
      m.unit = inside->name;
      m.end = inside->end + 1;
      return m;
    }
  const bool dimensionBefore = dimensionEndingAt(found, at).has_value();
  const auto dimensionBehind = namedAt(found, m.end, "dimension");
  if (dimensionBefore) {
    m.unit = unitOfNext(tokens, found, m.end);
  } else if (dimensionBehind && tokens[m.end].kind == TokenKind::Word) {
    m.unit = unitOfNext(tokens, found, dimensionBehind->end);
    if (m.unit.empty()) return m;
    m.dimension = dimensionBehind->name;
    m.end = dimensionBehind->end;
  }
  return m;
}

constexpr std::array<const char*, 3> dimensionsInOrder{"length", "width", "thickness"};

std::vector<Measured> chainAt(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  std::vector<Measured> chain;
  std::optional<Measured> next = measuredAt(tokens, found, at);
  while (next) {
    chain.push_back(*next);
    if (chain.size() == dimensionsInOrder.size() || !isTimes(tokens, next->end)) break;
    std::size_t begin = next->end + 1;
    std::string qualifier;
    for (; isAny(tokens, begin, {"ca", "c", "about", "±", ".", "to", "up", "約", "约", "approximately"}); ++begin)
      if (!is(tokens, begin, ".")) qualifier = isAny(tokens, begin, {"to", "up"}) ? "up to" : "about";
    next = measuredAt(tokens, found, begin);
    if (next) next->qualifier = qualifier;
  }
  // A unit stands for those before it: "3-5 × 2 cm".
  for (std::size_t i = chain.size(); i-- > 1;)
    if (chain[i - 1].unit.empty()) chain[i - 1].unit = chain[i].unit;
  return chain;
}

}  // namespace

Lead leadBefore(const Tokens& tokens, const std::vector<Found>& found, std::size_t number) {
  Lead lead{{}, {}, number};
  std::size_t at = number;
  for (int steps = 0; at > 0 && steps < 6; ++steps) {
    if (const auto dimension = dimensionEndingAt(found, at)) {
      lead.dimensions.insert(lead.dimensions.begin(), dimension->name);
      lead.first = at = dimension->end;
      // 長寬: the word right before measures the same number.
      if (tokens[at].kind == TokenKind::Han && dimensionEndingAt(found, at)) continue;
      return lead;
    }
    const std::string_view before = tokens[at - 1].text;
    const auto isBefore = [&](std::size_t back, Words words) { return at > back && isOneOf(tokens[at - 1 - back].text, words); };
    const bool notReaching = isOneOf(before, {"及", "到", "足", "逾"}) && isBefore(1, {"不", "未"});
    const bool notBeyond = isOneOf(before, {"過", "过"}) && isBefore(1, {"超"}) && isBefore(2, {"不"});
    if (notReaching || notBeyond || (isOneOf(before, {"過", "过"}) && isBefore(1, {"不"}))) {
      lead.qualifier = "up to";
      lead.first = at -= notBeyond ? 3 : 2;
      continue;
    }
    if (isOneOf(before, {"過", "过"}) && isBefore(1, {"超"})) {
      lead.qualifier = "more than";
      lead.first = at -= 2;
      continue;
    }
    if (isOneOf(before, {"to", "達", "达", "reaching", "reaches", "≤", "<", "under", "attaining", "attains"})) {
      lead.qualifier = "up to";
      lead.first = at - 1;
    } else if (isOneOf(before, {"ca", "about", "approximately", "約", "约", "approx", "c", "circa", "±", "around", "roughly"})) {
      lead.qualifier = lead.qualifier.empty() ? "about" : lead.qualifier;
      lead.first = at - 1;
    } else if (before == "exceeding" && isBefore(1, {"not"})) {
      lead.qualifier = "up to";
      lead.first = at -= 2;
      continue;
    } else if (isOneOf(before, {"over", ">", "≥", "exceeding"})) {
      lead.qualifier = "more than";
      lead.first = at - 1;
    } else if (isOneOf(before, {"up", "可", "長可", "最"}) && lead.qualifier == "up to") {
      lead.first = at - 1;
    } else if (isOneOf(before, {"than"}) && at > 1 && isOneOf(tokens[at - 2].text, {"less"})) {
      lead.qualifier = "up to";
      lead.first = at - 2;
      return lead;
    } else if (before == "than" && isBefore(1, {"more"})) {
      const bool most = isBefore(2, {"not", "no"});
      lead.qualifier = most ? "up to" : "more than";
      lead.first = at - (most ? 3 : 2);
      return lead;
    } else if (!isOneOf(before, {".", ":", "為", "为", "有", "is", "are", "of", "各", "皆", "均", "都", "from", "between"})) {
      return lead;
    }
    --at;
  }
  return lead;
}

std::vector<Size> sizesAt(const Tokens& tokens, const std::vector<Found>& found, std::size_t at) {
  const std::vector<Measured> chain = chainAt(tokens, found, at);
  if (chain.empty() || chain.front().unit.empty()) return {};
  const Lead lead = leadBefore(tokens, found, at);
  std::vector<Size> sizes;
  const auto add = [&](const Measured& m, const std::string& dimension) {
    sizes.push_back({m.range, m.unit, dimension, m.qualifier.empty() ? lead.qualifier : m.qualifier, lead.first, chain.back().end});
  };
  if (chain.size() == 1) {
    const Measured& only = chain.front();
    if (!only.also.empty()) add(only, only.also);
    if (!only.dimension.empty()) add(only, only.dimension);
    else if (lead.dimensions.empty()) add(only, {});
    else
      for (const std::string& dimension : lead.dimensions) add(only, dimension);
    return sizes;
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const bool named = !chain[i].dimension.empty() && (i == 0 || chain[i].dimension != sizes.front().dimension);
    add(chain[i], named ? chain[i].dimension : dimensionsInOrder[i]);
  }
  return sizes;
}

}  // namespace axil::keywords
