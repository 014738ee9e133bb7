// Words in the place of numbers: "numerous", "absent", and how often a leaf is divided.
#include "keywords/paragraph.hpp"

#include <algorithm>
#include <array>

namespace axil::keywords {

// "stamens numerous", "numerous stamens", 雄蕊多數: more than the author counted.
std::size_t ParagraphReader::readNumerous(std::size_t i) {
  const bool han = is(i, "多") && isAny(i + 1, {"數", "数"});
  if (!han && !isAny(i, {"numerous", "many", "∞", "innumerable"})) return 0;
  const std::size_t end = han ? i + 2 : i + 1;
  const Concept* noun = scope_.piece != nullptr && scope_.piece->name != "blade" ? scope_.piece : scope_.organ;
  const bool behind = scope_.organInSentence && noun != nullptr && beforeCount(i) == scope_.organEnd && scope_.place == nullptr;
  const Concept* ahead = nounAt(end);
  std::size_t at = end;
  while (han && at < end + 6 && at < tokens_.size() && (isAny(at, {"的", "之", "密", "疏", "生"}) || (hasTraitMeaning(at) && nounAt(at) == nullptr))) at = std::max(at + 1, found_[at].end);
  const Concept* given = han && i > 0 && isAny(i - 1, {"具", "有", "含"}) ? nounAt(at) : nullptr;  // 具多數密生的花
  if (given != nullptr && isCountable(*given) && given->columns.at("role") == "organ" && scope_.organInSentence) {
    Trait trait = traitAt(i, end, given->name, "count");
    trait.value = "numerous";
    keep(std::move(trait), true);
    return end;
  }
  const bool before = !behind && !han && is(i, "numerous") && ahead != nullptr && !found_[end].as("organ")->everyday && ahead->columns.at("role") == "organ";
  const bool stops = end >= tokens_.size() || tokens_[end].kind == TokenKind::Sign || isAny(end, {"and", "in", "per", "on"}) || hasTraitMeaning(end) || isHan(end);
  if (before) noun = ahead;
  if (!(before || (behind && stops && !is(end, "-"))) || !isCountable(*noun) || isNegated(i)) return 0;
  const bool ofPiece = behind && noun == scope_.piece;
  Trait trait = traitAt(i, end, ofPiece ? scope_.organ->name : noun->name, "count");
  trait.value = "numerous";
  if (ofPiece) trait.part = noun->name;
  if (behind) trait.which = scope_.which;
  evidence_ += 0.5;
  keep(std::move(trait), before || ofPiece);
  return end;
}

// "2-3-pinnate", 二至三回羽狀複葉: each way that the range names; the last is read as the phrase that it is.
std::size_t ParagraphReader::readDivisions(std::size_t i) {
  const std::optional<NumberRange> range = rangeAt(tokens_, i);
  if (!range || range->low >= range->high || range->high > 3 || range->low < 1) return 0;
  std::size_t last = i + 1;
  while (last < range->end + 1 && !(found_[last] && found_[last].end > range->end && numberAt(tokens_, last) && numberAt(tokens_, last)->value == range->high)) ++last;
  if (last > range->end || last >= tokens_.size()) return 0;
  constexpr std::array<std::array<std::string_view, 3>, 3> series{{{"pinnate", "bipinnate", "tripinnate"}, {"trifoliolate", "biternate", "triternate"}, {"pinnately lobed", "bipinnatifid", "bipinnatifid"}}};
  for (const auto& names : series)
    for (const std::string_view property : {"type", "shape"}) {
      const Concept* entry = found_[last].conceptAs(property);
      if (entry == nullptr || entry->name != names[static_cast<std::size_t>(range->high) - 1]) continue;
      for (int n = static_cast<int>(range->low); n < static_cast<int>(range->high); ++n) {
        const std::string_view name = names[static_cast<std::size_t>(n) - 1];
        if (name == entry->name) continue;
        Trait trait = traitAt(i, found_[last].end, "leaf", std::string(property));
        trait.value = std::string(name);
        trait.qualifier = qualifierBefore(i);
        if (scope_.organ != nullptr && scope_.organ->name == "leaf") trait.which = scope_.which;
        keep(std::move(trait), true);
      }
      return last;
    }
  return 0;
}

// "sepals absent", 花瓣缺: none of them.
std::size_t ParagraphReader::readAbsent(std::size_t i) {
  if (!isAny(i, {"absent", "wanting", "lacking", "none", "obsolete", "缺", "缺如", "不存在"}) || scope_.organ == nullptr || !scope_.organInSentence) return 0;
  const std::size_t end = is(i, "缺") && is(i + 1, "如") ? i + 2 : i + 1;
  const bool stops = end >= tokens_.size() || tokens_[end].kind == TokenKind::Sign || isAny(end, {"or", "或"});
  const bool counted = isOneOf(scope_.organ->name, {"petal", "sepal", "tepal", "stipule", "bract", "bracteole", "ray floret", "stamen", "tendril", "septum", "epicalyx", "pappus", "thorn", "awn"});
  if (!stops || !counted || scope_.piece != nullptr || i != scope_.organEnd || isNegated(i)) return 0;
  Trait trait = traitAt(i, end, scope_.organ->name, "count");
  trait.low = trait.high = 0;
  trait.which = scope_.which;
  evidence_ += 0.5;
  lastCount_ = {end, trait.organ, {}, {}};
  keep(std::move(trait), false);
  return end;
}

}  // namespace axil::keywords
