// Words that stand once for two statements, and words that another statement before them gives their sense.
#include "keywords/paragraph.hpp"

#include <algorithm>
#include <array>

namespace axil::keywords {

// "3- or shallowly 5-lobed": where the range ends whose word the number before the hyphen shares; `end` itself where none does.
std::size_t ParagraphReader::afterSharing(std::size_t end) const {
  if (!is(end, "-") || !isAny(end + 1, {"or", "to", ","})) return end;
  std::size_t at = end + 2;
  while (at < end + 5 && (isAny(at, {"or"}) || (at < tokens_.size() && !qualifierOf(tokens_[at].text).empty()))) ++at;
  if (at == end + 2) return end;  // "3- or 5-lobed" is one range
  const std::optional<NumberRange> second = rangeAt(tokens_, at);
  return second ? second->end : end;
}

// "even- or odd-pinnate", 偶數或奇數羽狀複葉: the first half says its type too.
void ParagraphReader::readElidedPinnate(std::size_t i, const LastTerm& now) {
  const Concept* entry = found_[i].conceptAs("type");
  if (entry == nullptr || !isOneOf(entry->name, {"odd-pinnate", "even-pinnate"}) || now.negated) return;
  std::size_t at = i;
  while (at > 0 && (isAny(at - 1, {"or", "to", "或", "至", "、", "/"}) || isOneOf(qualifierOf(tokens_[at - 1].text), {"rarely", "sometimes", "usually"}))) --at;
  if (at == i) return;
  while (at > 0 && isAny(at - 1, {"-", "數", "数"})) --at;
  if (at == 0 || !isAny(at - 1, {"even", "odd", "偶", "奇", "pari", "impari"})) return;
  const bool odd = isAny(at - 1, {"odd", "奇", "impari"});
  if (odd == (entry->name == "odd-pinnate")) return;
  Trait trait = traitAt(at - 1, found_[i].end, "leaf", "type");
  trait.value = odd ? "odd-pinnate" : "even-pinnate";
  trait.qualifier = at > 1 ? std::string(qualifierOf(tokens_[at - 2].text)) : std::string();
  keep(std::move(trait), true);
}

// "ternately to pinnately dissected", "palmately or pinnately lobed": the first manner says its shape too.
void ParagraphReader::readElidedCut(std::size_t i, const LastTerm& now) {
  if (now.negated || i < 2 || !isAny(i - 1, {"or", "to"}) || !isAny(i, {"pinnately", "palmately", "ternately"}) || !isAny(i - 2, {"pinnately", "palmately", "ternately"})) return;
  if (found_[i].conceptAs("shape") == nullptr || found_[i].end != i + 2) return;
  const bool deep = isAny(i + 1, {"dissected", "divided", "parted"});
  Trait trait = traitAt(i - 2, found_[i].end, scope_.organ != nullptr ? scope_.organ->name : std::string("leaf"), "shape");
  trait.value = is(i - 2, "palmately") ? "palmately lobed" : is(i - 2, "ternately") ? "ternatisect" : deep ? "pinnatisect" : "pinnately lobed";
  trait.qualifier = qualifierBefore(i - 2);
  keep(std::move(trait), true);
}

// "opposite, rarely ternate": among arrangements three leaves at a node.
bool ParagraphReader::readTernate(std::size_t i) {
  const bool joined = i > 0 && (is(i - 1, "or") || isOneOf(qualifierOf(tokens_[i - 1].text), {"rarely", "sometimes"}));
  const bool among = last_.kept && last_.category != nullptr && last_.category->property == "arrangement" && i < last_.end + 5;  // "alternate above, rarely ternate"
  if (!is(i, "ternate") || !joined || !among || found_[i].end != i + 1) return false;
  Trait trait = traitAt(i, i + 1, result_.traits.back().organ, "arrangement");
  trait.value = "whorled";
  trait.qualifier = qualifierBefore(i);
  addCount(i, i + 1, trait.organ, {}, {{}, 3, 3, {}, i + 1, false}, "per node");
  keep(std::move(trait), true);
  last_.end = i + 1;
  return true;
}

// "in threes", "whorled in fours": leaves at a node. The token after it.
std::size_t ParagraphReader::readInThrees(std::size_t i) {
  constexpr std::array<std::string_view, 4> names{"threes", "fours", "fives", "sixes"};
  if (!is(i, "in") || i + 1 >= tokens_.size() || scope_.organ == nullptr || !scope_.organInSentence || !isOneOf(scope_.organ->name, {"leaf", "branch", "leaflet"})) return 0;
  const auto name = std::find(names.begin(), names.end(), tokens_[i + 1].text);
  const bool digit = tokens_[i + 1].kind == TokenKind::Number && tokens_[i + 1].number >= 3 && tokens_[i + 1].number <= 20 && is(i + 2, "s");  // "in 3s"
  if (name == names.end() && !digit) return 0;
  const double number = digit ? tokens_[i + 1].number : 3 + static_cast<double>(name - names.begin());
  const std::size_t end = digit ? i + 3 : i + 2;
  const bool said = last_.kept && last_.category != nullptr && last_.category->property == "arrangement" && i < last_.end + 4;  // "whorled, mostly in 3s"
  addCount(i, end, scope_.organ->name, {}, {{}, number, number, {}, end, false}, "per node");
  evidence_ += 1;
  if (said) return end;
  Trait trait = traitAt(i, end, scope_.organ->name, "arrangement");
  trait.value = "whorled";
  trait.qualifier = qualifierBefore(i);
  keep(std::move(trait), false);
  last_ = {end, &categoryOf("arrangement"), {}, false, true, true};
  return end;
}

// "fascicled" in 穗狀圓錐花序, "corymbosely branched": how another inflorescence or a stem is built, and none of its own.
bool ParagraphReader::isMannerOfAnother(std::size_t i, std::string_view value) const {
  std::size_t end = found_[i].end;
  if (!isHan(i)) return tokens_[end - 1].text.ends_with("ly") && isAny(end, {"branched", "branching", "divided", "forked"});
  while (isAny(end, {"式", "狀", "状", "的"})) ++end;
  const Concept* next = nounAt(end);
  if (next == nullptr || next->name != "inflorescence") return false;
  for (const Meaning& m : found_[end].phrase->meanings)
    if (m.category->property == "type" && m.category->defaultOrgan == "inflorescence") return m.entry->name != value;
  return false;
}

// "3-nerved", 三脈: a number of veins too.
void ParagraphReader::countVeins(std::size_t i) {
  const Concept* entry = found_[i].conceptAs("venation");
  const std::size_t veins = found_[i].end - 1;
  const auto number = numberAt(tokens_, i);
  if (entry == nullptr || !number || !(isAny(veins, {"veined", "nerved"}) || (isAny(veins, {"脈", "脉"}) && number->end == veins))) return;
  addCount(i, found_[i].end, "vein", {}, {{}, number->value, number->value, {}, found_[i].end, false}, {});
}

}  // namespace axil::keywords
