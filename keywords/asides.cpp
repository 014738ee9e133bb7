// Turns of speech that lead away from what is being spoken of: brackets, parts that the vocabulary does not have, stalks of
// whatever was named before, exceptions.
#include "keywords/paragraph.hpp"

namespace axil::keywords {

// "Stems (from short rhizomes) branched": behind the bracket the stems are spoken of again.
void ParagraphReader::noteBracket(std::size_t i) {
  constexpr std::size_t deepest = 4;
  if (isAny(i, {"(", "["})) {
    if (outside_.size() < deepest) outside_.push_back(scope_);
    return;
  }
  if (outside_.empty()) return;
  const Scope before = outside_.back();
  outside_.pop_back();
  if (before.organ == nullptr || before.organ == scope_.organ || !before.organInSentence) return;
  scope_ = before;
  scope_.organEnd = i + 1;
}

// A word that the vocabulary does not have and that is told by its end.
bool ParagraphReader::looksAdjectival(std::size_t i) const {
  if (tokens_[i].kind != TokenKind::Word || found_[i]) return false;
  for (const std::string_view ending : {"ly", "ed", "ing", "ous", "ate", "ose", "ar", "ic", "ent", "oid", "ish", "less", "y"})
    if (tokens_[i].text.size() > 4 && tokens_[i].text.ends_with(ending)) return true;
  return isAny(i, {"large", "small", "long", "short", "thin", "thick", "slender", "tiny", "equal", "unequal", "free", "stout", "minute", "older", "younger"});
}

// A noun that is not in the vocabulary, at the begin of a clause and with statements behind it: "connectives 2-4 mm",
// "scutellum spreading". Adjectives are told by their ends.
bool ParagraphReader::isStranger(std::size_t i, std::size_t end) const {
  if (i >= tokens_.size() || tokens_[i].kind != TokenKind::Word || found_[i] || tokens_[i].text.size() < 4 || isKnown(i)) return false;
  const std::string_view word = tokens_[i].text;
  for (const std::string_view ending : {"ate", "ous", "ose", "ar", "al", "oid", "ic", "ed", "ent", "ant", "ile", "ish", "ine", "less", "y", "ing", "able", "ible", "form", "ive", "en", "ward", "wards"})
    if (word.ends_with(ending)) return false;
  if (isOneOf(word, {"robust", "stout", "stiff", "rigid", "firm", "soft", "pale", "dark", "dull", "bright", "close", "over", "around", "under", "circa", "roughly", "mean", "coarse", "fine", "simple", "weak", "strong", "found",
                     "grown", "native", "with", "without", "some", "such", "like", "other", "others", "most", "same", "then", "when", "where", "while", "also", "even", "just", "only", "rather", "quite", "about", "after",
                     "later", "before", "during", "until", "every", "both", "several", "single", "double", "total", "average", "reaching", "time", "times", "less", "more", "than", "least", "wider", "longer", "shorter",
                     "broader", "narrower", "larger", "smaller", "fully", "part", "parts", "rest", "plus"}))
    return false;
  const bool measured = end < tokens_.size() && (tokens_[end].kind == TokenKind::Number || isAny(end, {"ca", "c", "±"}));
  const bool described = hasTraitMeaning(end) && nounAt(end) == nullptr;
  return measured || described;
}

void ParagraphReader::noteStranger(std::size_t i) {
  if (namedAt_.empty() || i + 1 >= tokens_.size()) return;
  std::size_t noun = i + 1;
  const bool comma = is(i, ",");
  if (!found_[noun].as("organ") && (hasTraitMeaning(noun) || found_[noun].as("which")) && found_[noun].end < tokens_.size()) noun = found_[noun].end;  // "upper arms"
  if (!isStranger(noun, noun + 1)) return;
  if (comma && !(noun + 1 < tokens_.size() && (tokens_[noun + 1].kind == TokenKind::Number || isAny(noun + 1, {"ca"})))) return;
  scope_.stranger = true;
  scope_.organInSentence = scope_.organInSentence && comma;
}

// 葉痕大，倒卵形; "leaf scars broad, reniform"; 橫切面半圓形: statements about what the vocabulary knows as a place.
void ParagraphReader::noteScar(std::size_t i) {
  const bool opens = i == 0 || tokens_[i - 1].kind == TokenKind::Sign;
  const bool scar = isAny(found_[i].end - 1, {"痕", "面", "scar", "scars", "section"});
  if (opens && scar) scope_.stranger = true;
}

// "Capsule brown; stalk 2 mm", 葉具短柄，柄長5公釐: the stalk of what is spoken of.
const Concept& ParagraphReader::stalkOf(const Concept& stalk) const {
  const Concept* organ = scope_.organ;
  if (organ == nullptr) return organNamed("stem");
  if (isOneOf(organ->name, {"leaf", "petiole", "vein", "stipule"})) return organNamed("petiole");
  if (isOneOf(organ->name, {"leaflet", "petiolule", "pinna"})) return organNamed("petiolule");
  if (isOneOf(organ->name, {"inflorescence", "peduncle", "spikelet"})) return organNamed("peduncle");
  if (isOneOf(organ->name, {"flower", "calyx", "corolla", "petal", "sepal", "pedicel", "fruit", "perianth", "tepal"})) return organNamed("pedicel");
  if (isOneOf(organ->name, {"plant", "stem", "branch", "root", "rhizome", "bulb"})) return organNamed("stem");
  return stalk;
}

// Of a fern the stalk of its leaf, elsewhere that of an ovary or a fruit.
const Concept& ParagraphReader::stipeOf(const Concept& stipe) const {
  const bool ofFruit = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"fruit", "pistil", "ovary", "flower", "calyx", "seed", "carpel", "style", "stamen", "ovule", "petal", "inflorescence"});
  return ofFruit ? stipe : organNamed("petiole");
}

// 除基部為全緣外: what is excepted is not said. The token after it; 0 where none is.
std::size_t ParagraphReader::afterExcept(std::size_t i) const {
  if (!is(i, "除")) return 0;
  constexpr std::size_t longest = 24;
  for (std::size_t at = i + 1; at < tokens_.size() && at < i + longest; ++at) {
    if (isAny(at, {",", ";", "。", "；"}) || isSentenceEnd(at)) return 0;
    if (isAny(at, {"毛"}) && isAny(at - 1, {"緣", "缘", "睫", "纖", "纤"})) return 0;  // 除緣毛外無毛
    if (is(at, "外")) return at + 1;
  }
  return 0;
}

// Whether what follows is said of another kind of plant: "unlike", "but in A. alba", 後者, 有別於, 與具鋸齒的近緣種相似.
bool ParagraphReader::beginsComparison(std::size_t i) const {
  constexpr std::size_t far = 18;
  if (isAny(i, {"unlike", "vs", "versus", "latter", "contrast"})) return true;
  if (is(i, "in") && i + 2 < tokens_.size() && tokens_[i + 1].text.size() == 1 && tokens_[i + 1].kind == TokenKind::Word && isCapital(i + 1) && is(i + 2, ".") && !isSentenceEnd(i + 2)) return true;
  if (is(i, "in") && i > 0 && isAny(i - 1, {"whereas", "while", "but", "not"})) {
    for (std::size_t at = i + 1; at < i + 6; ++at)
      if (isAny(at, {"species", "relatives", "allies", "congeners", "taxa", "taxon"})) return true;
  }
  if (!isHan(i)) return false;
  if (isAny(i, {"後", "后"}) && is(i + 1, "者")) return true;
  if (isAny(i, {"近", "相"}) && isAny(i + 1, {"緣", "缘", "似", "近"}) && isAny(i + 2, {"種", "种", "類", "类", "屬", "属"}) && !isAny(i + 3, {"子"})) return true;
  if (isAny(i, {"於", "于"}) && i > 0 && isAny(i - 1, {"別", "别", "同", "異", "异"})) return true;
  if (!isAny(i, {"與", "与", "和"})) return false;
  bool kin = false;
  for (std::size_t at = i + 1; at < i + far && isHan(at); ++at) {
    kin = kin || (isAny(at, {"種", "种", "屬", "属", "者"}) && !is(at + 1, "子"));
    if (kin && isAny(at, {"區", "区", "別", "别", "異", "异", "似", "同"})) return true;
  }
  return false;
}

// The token after what is only said of another kind of plant; 0 where none is spoken of.
std::size_t ParagraphReader::afterComparison(std::size_t i) const {
  if (!scope_.organInSentence && !isHan(i)) return 0;
  if (!beginsComparison(i)) return 0;
  const bool clause = isAny(i, {"latter", "in"});  // commas go on about it
  std::size_t at = i + 1;
  while (at < tokens_.size() && !isSentenceEnd(at) && !isAny(at, {";", "；", ")", "]"}) && (clause || !isAny(at, {",", "，"}))) ++at;
  return at;
}

}  // namespace axil::keywords
