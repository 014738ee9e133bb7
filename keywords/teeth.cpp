// Teeth of a margin: what kind they are may be said by words that stand apart from them (圓鈍的齒, 鋸齒細小, "with gland-tipped teeth").
#include "keywords/paragraph.hpp"

#include "base/table.hpp"

namespace axil::keywords {

namespace {

bool isHanAdjective(std::string_view word) {
  return isOneOf(word, {"的", "之", "而", "且", "狀", "状", "粗", "大", "尖", "銳", "锐", "利", "疏", "密", "淺", "浅", "深", "稀", "離", "离", "整", "齊", "齐", "不", "規", "规", "則", "则",
                              "明", "顯", "显", "均", "勻", "匀", "等", "短", "質", "质", "軟", "软", "骨", "腺", "白", "色", "紅", "红"});
}
bool isFine(std::string_view word) { return isOneOf(word, {"細", "细", "小"}); }
bool isBlunt(std::string_view word) { return isOneOf(word, {"圓", "圆", "鈍", "钝"}); }

// What teeth of that kind are, where they are small or round.
std::string_view kindOf(std::string_view value, bool fine, bool blunt) {
  const bool saw = isOneOf(value, {"serrate", "serrulate"});
  if (!saw && !isOneOf(value, {"dentate", "denticulate"})) return value;
  fine = fine || isOneOf(value, {"serrulate", "denticulate"});
  if (blunt) return fine ? "crenulate" : "crenate";
  if (!fine) return value;
  return saw ? "serrulate" : "denticulate";
}

}  // namespace

// Where the adjectives of the teeth at token i begin, and behind them ("鋸齒圓鈍"): what they say.
ParagraphReader::Teeth ParagraphReader::teethAt(std::size_t i, std::size_t end) const {
  constexpr std::size_t far = 14;
  Teeth teeth{i, false, false};
  const auto textAt = [&](std::size_t at) { return at < tokens_.size() ? tokens_[at].text : std::string_view{}; };
  const auto note = [&](std::size_t at) {
    const bool fine = isFine(textAt(at)) && !(at > 0 && is(at - 1, "大"));  // 大小不等
    const bool blunt = isBlunt(textAt(at)) && !isAny(at + 1, {"尖"});  // 鈍尖: their tips
    teeth.fine = teeth.fine || fine;
    teeth.blunt = teeth.blunt || blunt;
    return fine || blunt;
  };
  while (teeth.first > 0 && teeth.first + far > i && (note(teeth.first - 1) || isHanAdjective(textAt(teeth.first - 1)) || isFine(textAt(teeth.first - 1)))) --teeth.first;
  std::size_t behind = end;
  while (isAny(behind, {"較", "较", "甚", "極", "极", "均", "皆", "頗", "颇", "很"})) ++behind;
  if (nounAt(behind) == nullptr && (isFine(textAt(behind)) || isBlunt(textAt(behind)))) {
    std::size_t last = behind;
    while (isFine(textAt(last)) || isBlunt(textAt(last)) || isAny(last, {"密", "尖", "淺", "浅", "疏", "短"})) ++last;
    if (last >= tokens_.size() || tokens_[last].kind == TokenKind::Sign || isAny(last, {"而", "且", "或", "至"}))
      for (std::size_t at = behind; at < last; ++at) note(at);
  }
  return teeth;
}

// 細密而尖的鋸齒 are small, 鋸齒圓鈍 round.
std::optional<Meaning> ParagraphReader::finerTeeth(std::size_t i, const Meaning& meaning) const {
  if (!isHan(i) || meaning.category->property != "margin" || !isAny(found_[i].end - 1, {"齒", "齿"})) return std::nullopt;
  const Teeth teeth = teethAt(i, found_[i].end);
  const std::string_view value = kindOf(meaning.entry->name, teeth.fine, teeth.blunt);
  if (value == meaning.entry->name) return std::nullopt;
  for (const Concept& entry : meaning.category->concepts)
    if (entry.name == value) return Meaning{meaning.category, &entry, meaning.everyday};
  return std::nullopt;
}

// 具圓鈍的齒, 葉緣的齒細小: teeth that only their adjectives describe.
bool ParagraphReader::readHanTeeth(std::size_t i, const Concept& owner) {
  if (!isAny(i, {"齒", "齿"}) || found_[i].end != i + 1) return false;
  const Teeth teeth = teethAt(i, i + 1);
  const bool atMargin = scope_.place != nullptr && scope_.place->name == "margin" && !scope_.commaSincePlace;
  const bool described = teeth.fine || teeth.blunt || (teeth.first + 1 < i && (atMargin || owner.name == "indusium"));
  if (!described || isNegated(teeth.first)) return false;
  Trait trait = traitAt(teeth.first, i + 1, owner.name, "margin");
  trait.value = kindOf("dentate", teeth.fine, teeth.blunt);
  trait.which = scope_.which;
  if (scope_.piece != nullptr && scope_.piece->name != "blade") trait.part = scope_.piece->name;
  keep(std::move(trait), true);
  return true;
}

// "margins entire or with a few blunt teeth", "bearing gland-tipped teeth": toothed, where nothing but adjectives stands between.
bool ParagraphReader::readTeeth(std::size_t i, const Concept& owner) {
  const bool ofPiece = scope_.piece != nullptr && !isOneOf(scope_.piece->name, {"blade", "lobe", "segment"});
  const bool atMargin = scope_.place != nullptr && scope_.place->name == "margin";
  if ((!atMargin && !isOneOf(owner.name, {"leaf", "leaflet", "pinna", "petal", "sepal", "bract", "stipule", "tepal", "bracteole", "indusium"})) || ofPiece || !scope_.organInSentence) return false;
  if (isHan(i)) return readHanTeeth(i, owner);
  if (!is(i, "teeth")) return false;
  std::size_t at = i;
  bool saidByTerm = false;  // "with spiny teeth"
  std::string_view value = "dentate";
  while (at > 0 && at + 8 > i) {
    const std::size_t word = at - 1;
    if (isAny(word, {"with", "bearing", "having"}) || tokens_[word].kind == TokenKind::Number) break;
    const bool hyphenated = is(word, "-") || is(at, "-") || (word > 0 && is(word - 1, "-"));
    const bool plain = isAny(word, {"a", "few", "some", "several", "very", "obscure", "coarse", "fine", "blunt", "sharp", "broad", "shallow", "remote", "small", "minute", "large", "scattered", "distant", "low", "tiny", ","});
    if (!hyphenated && !plain && !looksAdjectival(word) && !hasTraitMeaning(word) && qualifierOf(tokens_[word].text).empty()) break;
    saidByTerm = saidByTerm || found_[word].as("margin") != nullptr;
    if (isAny(word, {"fine", "small", "minute", "tiny"})) value = value == "serrate" ? "serrulate" : "denticulate";
    if (isAny(word, {"forward", "antrorse", "saw", "ascending"})) value = value == "denticulate" ? "serrulate" : "serrate";
    if (isAny(word, {"spine", "thorn", "prickle"})) value = "spinose";
    if (is(word, "rounded")) value = "crenate";
    --at;
  }
  if (at == 0 || !isAny(at - 1, {"with", "bearing", "having", "bears", "bear", "has", "have"}) || isNegated(at - 1)) return false;
  const bool saidBefore = last_.kept && last_.category != nullptr && last_.category->property == "margin" && last_.end + 1 == at;  // "serrate with bristle-tipped teeth"
  if (saidByTerm || saidBefore) return i + 1 >= tokens_.size() || tokens_[i + 1].kind != TokenKind::Number;  // "with teeth 6-10 per side"
  Trait trait = traitAt(at, i + 1, owner.name, "margin");
  trait.value = value;
  trait.which = scope_.which;
  if (scope_.piece != nullptr && scope_.piece->name != "blade") trait.part = scope_.piece->name;
  keep(std::move(trait), true);
  return true;
}

// 葉緣有銳刺, "margins beset with minute spines".
bool ParagraphReader::readSpinesOfMargin(std::size_t i, const Concept& organ) {
  const bool atMargin = scope_.place != nullptr && scope_.place->name == "margin" && !scope_.commaSincePlace && scope_.organEnd < i && scope_.organEnd + 10 > i;
  if (organ.name != "thorn" || !atMargin || scope_.organ == nullptr || !isOneOf(scope_.organ->name, {"leaf", "leaflet", "pinna", "bract", "petiole"})) return false;
  for (std::size_t at = scope_.organEnd; at < i; ++at)
    if (negates(tokens_[at].text) || tokens_[at].kind == TokenKind::Number) return false;
  Trait trait = traitAt(i, found_[i].end, scope_.organ->name, "margin");
  trait.value = "spinose";
  trait.which = scope_.which;
  if (result_.traits.empty() || result_.traits.back().property != "margin" || result_.traits.back().value != "spinose") keep(std::move(trait), true);
  return true;
}

// "doubly or rarely simply serrate": the first manner says its margin too.
void ParagraphReader::readElidedDouble(std::size_t i, const LastTerm& now) {
  const Concept* entry = found_[i].conceptAs("margin");
  if (entry == nullptr || entry->name != "serrate" || now.negated) return;
  std::size_t at = i;
  while (at > 0 && at + 5 > i && (isAny(at - 1, {"or", "to", "singly", "simply", "once"}) || !qualifierOf(tokens_[at - 1].text).empty())) --at;
  if (at == i || at == 0 || !is(at - 1, "doubly") || !isAny(at, {"or", "to"})) return;
  Trait trait = traitAt(at - 1, found_[i].end, scope_.organ != nullptr ? scope_.organ->name : std::string("leaf"), "margin");
  trait.value = "doubly serrate";
  trait.qualifier = qualifierBefore(at - 1);
  keep(std::move(trait), true);
}

// "margins entire or with 2-3 shallow lobes": lobed, beside the number of lobes.
void ParagraphReader::readFewLobes(std::size_t i, const Concept& owner) {
  const bool ofMargin = scope_.place != nullptr && scope_.place->name == "margin" && !scope_.commaSincePlace && scope_.piece == nullptr;
  if (!is(i, "lobes") || !ofMargin || !isOneOf(owner.name, {"leaf", "leaflet"})) return;
  std::size_t at = i;
  while (at > 0 && at + 8 > i && (tokens_[at - 1].kind == TokenKind::Number || looksAdjectival(at - 1) || isAny(at - 1, {"-", "or", "to", "a", "few", "several", "shallow", "coarse", "broad", "blunt", "deep"}) || numberAt(tokens_, at - 1))) --at;
  if (at == 0 || at == i || !is(at - 1, "with") || isNegated(at - 1)) return;
  Trait trait = traitAt(at, i + 1, owner.name, "margin");
  trait.value = "lobed";
  trait.which = scope_.which;
  keep(std::move(trait), true);
}

}  // namespace axil::keywords
