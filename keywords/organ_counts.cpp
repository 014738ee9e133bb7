// Numbers that count the organ named before or behind them.
#include "keywords/paragraph.hpp"

namespace axil::keywords {

// "petals 5", "leaflets 5-8 pairs", 小葉8-12對, 有花3-7朵. A number that goes on as a size counts nothing.
std::size_t ParagraphReader::readCountOfOrganBefore(std::size_t i, const NumberRange& range) {
  if (scope_.organ == nullptr || !scope_.organInSentence) return 0;
  const Concept& noun = scope_.piece != nullptr && scope_.piece->name != "blade" ? *scope_.piece : *scope_.organ;
  if (isWordWithNumber(range.end)) return 0;
  if (last_.kept && last_.category != nullptr && last_.category->property == "venation" && last_.end == i) {  // 掌狀脈5-7條
    const Measure measure = measureAt(range.end);
    addCount(i, measure.end, "vein", "", range, measure.unit);
    return measure.end;
  }
  // "Flowers solitary or 2-3 together", 花單生或2-3朵簇生.
  const std::size_t before = beforeCount(i);
  const bool orSolitary = last_.kept && last_.end != 0 && before == last_.end + 1 && isAny(last_.end, {"or", "或", "to", "至"}) && !result_.traits.empty() && result_.traits.back().value == "solitary";
  // 徑1公分，2-4個腋生; 常3-5朵簇生枝端: how many stand together.
  const Measure counter = measureAt(range.end);
  const bool together = isHan(range.end) && counter.end > range.end && scope_.subjectInClause && before > 0 && tokens_[before - 1].kind == TokenKind::Sign &&
                        ((counter.end < tokens_.size() && found_[counter.end] && (found_[counter.end].as("arrangement") || found_[counter.end].as("position"))) || isAny(counter.end, {"着", "著", "生", "聚"}));
  // 孢子囊群圓形，每小羽片4-6枚
  const bool forEach = isHan(range.end) && counter.end > range.end && beforeEach(i) != i && scope_.subjectInClause && before > 0 && tokens_[before - 1].kind == TokenKind::Sign;
  // 花瓣白色，5枚: a number with its counter alone between commas.
  const bool alone = isHan(range.end) && counter.end > range.end && counter.unit.empty() && scope_.subjectInClause && before > 0 && isAny(before - 1, {",", "，"}) &&
                     (counter.end >= tokens_.size() || tokens_[counter.end].kind == TokenKind::Sign);
  // "Leaves all basal, 6-12, reniform", "spikes 2-6 cm, 2-4 together".
  const bool between = !isHan(i) && scope_.subjectInClause && before == i && i > 0 && is(i - 1, ",") && range.low < range.high && scope_.piece == nullptr && last_.kept && last_.end + 1 == i && range.end < tokens_.size() &&
                       (is(range.end, ",") || (last_.category != nullptr && last_.category->property == "position" && isAny(range.end, {";", "."})));
  const bool gathered = !isHan(i) && scope_.subjectInClause && is(range.end, "together") && isOneOf(noun.name, {"inflorescence", "flower", "fruit"});
  if (between || gathered) {
    addCount(i, range.end, noun.name, "", range, "");
    return range.end;
  }
  if (!isCountable(noun) || (!alone && before != scope_.organEnd && !orSolitary && !together && !forEach && !isBehindRows(before))) return 0;
  if (scope_.place != nullptr && !alone) return 0;
  const bool inBrackets = i > 0 && is(i - 1, "(") && is(range.end, ")") && isAny(range.end + 1, {"pairs", "pair", "對", "对"});  // "(11-16) pairs"
  const Measure measure = measureAt(inBrackets ? range.end + 1 : range.end);
  const Concept* next = nounAt(measure.end);
  // 花八仙, 主根一說: a numeral inside other words counts nothing.
  const bool endsWord = !isHan(i) || measure.end > range.end || !isHan(range.end) || next != nullptr || hasTraitMeaning(range.end) || isAny(range.end, {"或", "至", "及", "和", "簇", "束"});
  if (!endsWord) return 0;
  if (!isHan(measure.end) && isGathered(measure.end)) return 0;  // "in 1 or more clusters of 3-6"
  const bool nextIsCounted = next != nullptr && i == scope_.organEnd && numberAt(tokens_, found_[measure.end].end).has_value();  // 雄蕊5雌蕊1
  if (next != nullptr && isHan(measure.end) && next != scope_.organ && isCountable(*next) && !nextIsCounted) return 0;  // 具3花
  const bool ofSomethingElse = i > 0 && isAny(i - 1, {"具", "有"}) && measure.end > range.end && isHan(measure.end) && next == nullptr && !hasTraitMeaning(measure.end);
  if (ofSomethingElse && (isOneOf(noun.name, {"stem", "branch"}) || is(measure.end, "以"))) return 0;  // 莖具5條以上的溝
  if (isHan(measure.end) && i > 0 && isAny(i - 1, {"具", "有", "含"}) && afterAdjectives(measure.end) != measure.end && isCountable(*nounAt(afterAdjectives(measure.end)))) return 0;  // 具2下垂胚珠
  const bool ofPiece = &noun == scope_.piece;
  const Concept* per = is(measure.end, "per") ? nounAt(measure.end + 1) : nullptr;
  const std::string unit = !measure.unit.empty() ? measure.unit : per != nullptr ? "per " + per->name : unitOfEach(i);
  const bool ofFlowers = measure.end > range.end && is(range.end, "朵") && scope_.organ->name == "inflorescence";  // 聚繖花序頂生，5朵叢生
  addCount(i, measure.end, ofFlowers ? "flower" : scope_.organ->name, ofPiece ? noun.name : "", range, unit);
  evidence_ += ofPiece && found_[scope_.organEnd - 1].as("organ") ? 0.5 : 1;
  return per != nullptr ? found_[measure.end + 1].end : measure.end;
}

// Adjectives between a number and what it counts: "2 slightly exserted stamens", 2片大苞片, 2下垂胚珠. Where the organ stands; `from`
// where none does.
std::size_t ParagraphReader::afterAdjectives(std::size_t from) const {
  constexpr std::size_t most = 9;
  for (std::size_t at = from; at < tokens_.size() && at < from + most;) {
    if (nounAt(at) != nullptr) return at;
    if (isHan(from) != isHan(at) && tokens_[at].kind != TokenKind::Sign) return from;
    if (isHan(at) && found_[at].conceptAs("organ") != nullptr && isAny(found_[at].end, {"狀", "状"})) {  // 4枚花瓣狀總苞片
      at = found_[at].end + 1;
      continue;
    }
    const bool joins = isAny(at, {"的", "之", "-"}) || (is(at, ",") && at > from && !isHan(from));
    if (hasTraitMeaning(at) || (!isHan(at) && found_[at].conceptAs("which") != nullptr)) at = found_[at].end;
    else if (joins || looksAdjectival(at) || !qualifierOf(tokens_[at].text).empty() || isAny(at, {"大", "小", "細", "细", "厚", "薄", "斜"})) ++at;
    else return from;
  }
  return from;
}

// "5 petals", "10 pairs of leaflets", 5枚花瓣, 具3～7花.
std::size_t ParagraphReader::readCountOfOrganAfter(std::size_t i, const NumberRange& range) {
  const Measure measure = measureAt(range.end);
  std::size_t at = measure.end;
  if (isAny(at, {"的"})) ++at;
  const auto isAdjective = [&](std::size_t k) { return k < tokens_.size() && (hasTraitMeaning(k) || (!isHan(k) && found_[k].conceptAs("which") != nullptr)) && nounAt(k) == nullptr && (!isHan(k) || isAny(found_[k].end, {"的", "之"})); };
  while (isAdjective(at) && at < measure.end + 3) at = found_[at].end;  // "5 white petals"
  if (at > measure.end && isAny(at, {"的", "之"})) ++at;
  if (nounAt(at) == nullptr && (isHan(at) ? measure.end > range.end || (i > 0 && isAny(i - 1, {"具", "有", "含"})) : tokens_[i].kind == TokenKind::Number)) at = afterAdjectives(at);
  const bool with = i > 0 && isAny(i - 1, {"with", "having", "bearing"});
  for (int unknown = 0; with && unknown < 2 && at < tokens_.size() && tokens_[at].kind == TokenKind::Word && !found_[at] && !isFiller(tokens_[at].text); ++unknown) ++at;  // "7-13 prominent parallel veins"
  const Concept* noun = nounAt(at);
  const bool oneHeld = is(i, "一") && i > 0 && isAny(i - 1, {"具", "有", "僅", "仅"}) && noun != nullptr && !found_[at].as("organ")->everyday;
  if (noun == nullptr || (isAny(i, {"one", "一"}) && !oneHeld)) return 0;
  const std::string& role = noun->columns.at("role");
  const bool inside = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"inflorescence", "spikelet"});
  const bool flowersHan = isHan(at) && noun->name == "flower" && inside;
  const bool divided = isHan(at) && noun->name == "leaflet" && i >= 2 && isAny(i - 2, {"掌", "羽"}) && isAny(i - 1, {"狀", "状"});
  if (divided && !found_[i - 2].as("type")) {  // 掌狀5小葉
    Trait type = traitAt(i - 2, found_[at].end, "leaf", "type");
    type.value = is(i - 2, "羽") ? "pinnate" : range.low == 3 && range.high == 3 ? "trifoliolate" : "palmate";
    keep(std::move(type), true);
  }
  if (flowersHan) {
    addCount(i, found_[at].end, "flower", "", range, "per inflorescence");
    evidence_ += 1;
    return found_[at].end;
  }
  const bool introduced = scope_.organInSentence && i > 0 && (isAny(i - 1, {"of", "with", "bearing", "具", "有", "含"}) || measure.unit == "pairs");  // "pappus of 20-30 bristles"
  if (!isCountable(*noun) || (found_[at].as("organ")->everyday && !introduced && noun->name != "flower" && role == "organ" && noun->name != "leaf")) return 0;
  if (noun->name == "leaf" && measure.end == range.end && range.low == range.high && !scope_.organInSentence) return 0;  // "2 leaves" in any prose
  const std::string organ = role == "sub" ? ownerOf(*noun, at)->name : noun->name;
  const std::size_t nounEnd = found_[at].end;
  const bool pairsBehind = isAny(nounEnd, {"pairs", "pair"});                             // "10 or more pinna pairs"
  const bool sideBehind = (is(nounEnd, "per") && is(nounEnd + 1, "side")) || (is(nounEnd, "on") && isAny(nounEnd + 1, {"each", "either"}) && is(nounEnd + 2, "side"));
  const std::string unit = pairsBehind ? "pairs" : sideBehind ? "per side" : measure.unit.empty() && isHan(at) ? unitOfEach(i) : measure.unit;
  addCount(i, pairsBehind ? nounEnd + 1 : nounEnd, organ, role == "sub" ? noun->name : "", range, unit);
  return measure.end == at ? at : range.end;  // the adjectives and the organ are read next
}

}  // namespace axil::keywords
