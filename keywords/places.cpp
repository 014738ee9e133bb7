// Organs that are only named to say where something stands, or what it is compared with.
#include "keywords/paragraph.hpp"

namespace axil::keywords {

// 在短枝上, 於長枝, 在一年生枝上, 發自去年短枝的腋芽: where something stands.
bool ParagraphReader::isLocative(std::size_t i) const {
  if (!isHan(i)) return false;
  constexpr std::size_t far = 16;
  const bool closed = isAny(found_[i].end, {"上", "中", "內", "内", "處", "处", "旁", "端", "頂", "顶"});
  for (std::size_t back = 1; back <= far && back <= i; ++back) {
    if (tokens_[i - back].kind == TokenKind::Sign || tokens_[i - back].kind == TokenKind::Word) return false;
    if (isAny(i - back, {"在", "於", "于"}) && (back <= 3 || (closed && back <= 8))) return true;
    if (is(i - back, "自") && i > back && isAny(i - back - 1, {"發", "发", "生", "出"})) return true;
  }
  return false;
}

// "in the axils of leaves", "longer than petals", 與葉: an organ that is only named to place or compare another does not take over.
bool ParagraphReader::isPlaceOnly(std::size_t i) const {
  if (i == 0) return false;
  const auto isMeasuredFrom = [&](std::size_t number) { return number < tokens_.size() && tokens_[number].kind == TokenKind::Number; };
  std::size_t reach = found_[i].end;  // "on a peduncle to 25 mm", but not "climbing by roots to 20 m"
  while (nounAt(i) != nullptr && isOneOf(nounAt(i)->name, {"peduncle", "pedicel", "petiole", "stalk", "stipe"}) && isAny(reach, {"to", "up", "ca", "about", "."})) ++reach;
  const bool isMeasuredItself = isMeasuredFrom(found_[i].end) || isMeasuredFrom(reach);  // "in racemes 5-10 cm long"
  std::size_t before = i - 1;
  if (before > 0 && isAny(before, {"the", "its", "each", "a"})) --before;
  while (before > 0 && (looksAdjectival(before) || (!isHan(i) && found_[before].conceptAs("which") != nullptr && nounAt(before) == nullptr) || isAny(before, {"lower", "upper", "young", "basal", "middle", "old", "lateral", "leaf", "short", "long", "spur", "juvenile", "fertile", "sterile", "flowering", "vegetative", "new",
                                      "very", "leafless", "aerial", "slender", "stout", "current", "previous", "year", "second", "adult", "subtending", "ultimate", "leafy", "terminal", "main", "mature", "same", "opposite"})))
    --before;
  if (before > 0 && tokens_[before].kind == TokenKind::Word && !found_[before] && is(before - 1, "on")) --before;  // "on sucker shoots"
  if (before > 0 && isAny(before, {"the", "its", "their"})) --before;  // "in the axils of the upper leaves"
  if (isHan(i) && isAny(before, {"每", "各"})) return scope_.organInSentence;
  if (isGoal(i)) return scope_.organInSentence;
  const std::size_t behind = found_[i].end;  // 莖下部者3-4枚輪生: which of the leaves
  if (isHan(i) && isAny(behind, {"上", "下"}) && isAny(behind + 1, {"者", "的"})) return scope_.organInSentence;
  if (isHan(i) && isAny(behind, {"上", "下", "中", "基", "頂", "顶"}) && is(behind + 1, "部") && is(behind + 2, "者")) return scope_.organInSentence;
  const bool tipOf = isHan(i) && last_.end == i && last_.kept && isAny(found_[i].end, {"端", "頂", "顶", "梢", "先"});  // 單生莖端
  if (tipOf) return scope_.organInSentence;
  std::size_t behindTerms = before;  // "on a pendulous stalk"
  while (behindTerms > 0 && !isHan(i) && (isAny(behindTerms, {"a", "the"}) || (hasTraitMeaning(behindTerms) && nounAt(behindTerms) == nullptr))) --behindTerms;
  if (isAny(behindTerms, {"on", "at", "from", "near"})) before = behindTerms;
  if (is(behindTerms, "of") && behindTerms > 0 && isAny(behindTerms - 1, {"side", "sides"})) return scope_.organInSentence;  // "on each side of the forked rachis"
  if (isLocative(i)) return scope_.organInSentence;
  if (isAny(before, {"without", "lacking", "no", "無", "无", "缺"}) && !is(i, "毛")) return true;
  const bool noneAbove = isHan(i) && i > 2 && is(i - 2, "地") && is(i - 1, "上") && isAny(i - 3, {"無", "无", "缺"});  // 無地上莖
  if (noneAbove) return true;
  if (before > 0 && is(before, "具") && isAny(before - 1, {"不", "未"})) return true;
  if (is(before, "同") && isAny(i, {"葉", "叶"}) && hasTraitMeaning(found_[i].end)) return true;  // 同葉簇生
  if (isAny(before, {"與", "与"}) && isAny(found_[i].end, {"呈", "成", "夾", "夹", "間", "间", "等", "對", "对", "同"})) return true;
  if (isAny(before, {"than", "to", "與", "与", "和", "短", "比", "較", "较", "似", "先", "exceeding", "於", "于", "near", "toward", "towards", "from", "among", "between", "above", "below", "on", "after", "before", "per", "until", "subtending", "opposite"}) && (!isMeasuredItself || isAny(before, {"from", "than", "exceeding"}))) {
    const bool afterTo = is(before, "to") && before > 0 && nounAt(i)->name == "plant" && found_[before - 1];  // "shrubs to small trees"
    return scope_.organInSentence && !afterTo && !(isAny(before, {"和", "與", "与"}) && before > 0 && (nounAt(before - 1) != nullptr || scope_.organEnd == before));
  }
  const bool specifies = scope_.organInSentence && is(before, "of") && before > 0 && scope_.organEnd == before && scope_.organ != nullptr && scope_.organ->name != "inflorescence";  // "tepals of male flowers 4"
  if (specifies) return true;
  if (!scope_.organInSentence || isMeasuredItself) return false;
  if (before > 0 && is(before, "of") && isAny(before - 1, {"pairs", "pair", "whorls", "clusters", "fascicles", "consisting", "composed"})) return false;
  return isAny(before, {"of", "in", "at", "by"}) && nounAt(i) != nullptr && nounAt(i)->name != "inflorescence";
}

// 貼生至花冠裂片, 伸出花冠: what something reaches or stands out from.
bool ParagraphReader::isGoal(std::size_t i) const {
  if (!isHan(i) || i < 2 || nounAt(i) == nullptr || isOneOf(nounAt(i)->name, {"plant", "inflorescence", "flower"})) return false;
  const bool out = isAny(i - 1, {"出", "過", "过"}) && isAny(i - 2, {"露", "伸", "突", "超", "高", "挺", "長", "长"});
  const bool alongVeins = is(i - 1, "沿") || (nounAt(i)->name == "vein" && isAny(found_[i].end, {"上", "腋"}));
  return out || alongVeins || (is(i - 1, "至") && !hasTraitMeaning(i));
}

// 花冠裂片 in 貼生至花冠裂片的基部: the rest of such a place.
bool ParagraphReader::isOfPlaceBefore(std::size_t i) const {
  if (placeOnlyEnd_ == 0 || !isHan(i)) return false;
  return i == placeOnlyEnd_ || (i == placeOnlyEnd_ + 1 && isAny(placeOnlyEnd_, {"的", "之"}));
}

bool ParagraphReader::isPlaceOfTermBefore(std::size_t i) const {
  std::size_t at = i;
  while (at > 0 && isAny(at - 1, {"the", "at", "toward", "towards", "near", "its"})) --at;
  return at < i && last_.end == at && last_.kept;
}

}  // namespace axil::keywords
