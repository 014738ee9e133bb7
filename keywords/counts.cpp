// Numbers that count: organs, leaves at a node, the pieces of an organ.
#include "keywords/paragraph.hpp"

#include <algorithm>
#include <cmath>

namespace axil::keywords {

namespace {

bool isCountable(const Concept& noun) { return noun.columns.at("countable") == "yes"; }

bool isWhole(double number) { return number == std::floor(number); }

bool isCount(const NumberRange& range) { return range.high <= 999 && isWhole(range.low) && isWhole(range.high); }

struct CountedWord {
  std::string_view word;
  const char* organ;  // "": the organ in scope
  const char* piece;
  const char* unit;
};

// "5-lobed", "6-seeded": the words behind a number and what they count.
constexpr CountedWord countedWords[] = {
    {"lobed", "", "lobe", ""},        {"parted", "", "lobe", ""},          {"cleft", "", "lobe", ""},       {"fid", "", "lobe", ""},
    {"toothed", "", "tooth", ""},     {"dentate", "", "tooth", ""},        {"seeded", "seed", "", "per fruit"},
    {"flowered", "flower", "", "per inflorescence"}, {"veined", "vein", "", ""}, {"nerved", "vein", "", ""},   {"locular", "ovary", "locule", ""},
    {"loculed", "ovary", "locule", ""}, {"celled", "ovary", "locule", ""}, {"loculate", "ovary", "locule", ""}, {"valved", "fruit", "valve", ""},
    {"foliolate", "leaflet", "", ""}, {"foliate", "leaflet", "", ""},      {"petaled", "petal", "", ""},    {"petalled", "petal", "", ""},
    {"leaved", "leaf", "", ""},       {"leaved", "leaf", "", ""},          {"rayed", "ray floret", "", ""},
};

}  // namespace

void ParagraphReader::addCount(std::size_t first, std::size_t end, const std::string& organ, const std::string& piece, const NumberRange& range, const std::string& unit) {
  Trait trait = traitAt(first, end, organ, unit == "merous" ? "merosity" : "count");
  trait.low = range.low;
  trait.high = range.high;
  trait.minimum = range.minimum;
  trait.maximum = range.maximum;
  trait.unit = unit == "merous" ? "" : unit;
  trait.part = piece;
  if (scope_.organ != nullptr && scope_.organ->name == organ) trait.which = scope_.which;
  keep(std::move(trait), !piece.empty());
}

// The token after "per node", "at each node", "in each whorl", "in a whorl".
std::size_t ParagraphReader::afterPerNode(std::size_t i) const {
  const bool per = is(i, "per");
  const bool each = isAny(i, {"at", "in", "to"}) && isAny(i + 1, {"each", "a", "every"});
  const std::size_t noun = per ? i + 1 : each ? i + 2 : i;
  if (!per && !each) return 0;
  return isAny(noun, {"node", "whorl", "fascicle", "bundle", "cluster", "verticil"}) ? noun + 1 : 0;
}

bool ParagraphReader::isGathered(std::size_t i) const {
  if (i >= tokens_.size()) return false;
  const Concept* arrangement = found_[i].conceptAs("arrangement");
  return arrangement != nullptr && isOneOf(arrangement->name, {"whorled", "fascicled"});
}

bool ParagraphReader::leafIsMeant(std::size_t from, std::size_t to) const {
  for (std::size_t k = from; k < to; ++k)
    if (nounAt(k) != nullptr || isAny(k, {"針", "针"})) return true;
  return scope_.organ != nullptr && scope_.organ->name == "leaf" && scope_.organInSentence;
}

// How many leaves one node carries: "whorls of 4", "4-whorled", "4 leaves per node", 4葉輪生, 每輪4枚.
std::size_t ParagraphReader::readLeavesPerNode(std::size_t i, const NumberRange& range) {
  const bool ofWhorls = i >= 2 && is(i - 1, "of") && isGathered(i - 2);
  const bool ofInWhorls = !ofWhorls && i >= 3 && is(i - 1, "of") && found_[i - 3] && found_[i - 3].end == i - 1 && isGathered(i - 3);
  const bool perNodeHan = i >= 2 && is(i - 2, "每") && isAny(i - 1, {"節", "节", "輪", "轮", "束"});
  if (ofWhorls || ofInWhorls || perNodeHan) {
    addCount(ofInWhorls ? i - 3 : i - 2, range.end, "leaf", "", range, "per node");
    return range.end;
  }
  std::size_t at = range.end;
  while (isAny(at, {"枚", "片", "張", "张", "-", "針", "针"}) || (at < tokens_.size() && nounAt(at) != nullptr && nounAt(at)->name == "leaf")) at = std::max(at + 1, found_[at].end);
  const std::size_t perNode = afterPerNode(at);
  if ((perNode == 0 && !isGathered(at)) || !leafIsMeant(range.end, at)) return 0;
  addCount(i, perNode != 0 ? perNode : found_[at].end, "leaf", "", range, "per node");
  evidence_ += 1;
  if (perNode == 0) return at;  // the arrangement itself is read next
  // "3 or 4 in a whorl" says the arrangement too, where nothing before has said it.
  const bool said = last_.category != nullptr && last_.category->property == "arrangement" && last_.kept;
  return isAny(perNode - 1, {"whorl", "verticil", "fascicle", "bundle", "cluster"}) && !said ? perNode - 1 : perNode;
}

std::size_t ParagraphReader::readCount(std::size_t i) {
  const std::optional<NumberRange> range = rangeAt(tokens_, i);
  if (!range || !isCount(*range)) return 0;
  // 一年生, 二列: numbers inside words of the vocabulary count nothing.
  if (isHan(i) && found_[i] && found_[i].end > range->end) return 0;
  if (const std::size_t end = readLeavesPerNode(i, *range)) return end;
  const std::size_t word = is(range->end, "-") ? range->end + 1 : range->end;
  const bool merousHan = isAny(word, {"數", "数", "基"}) && scope_.organInSentence;
  if (isAny(word, {"merous"}) || merousHan) {
    const std::size_t end = is(word, "基") && isAny(word + 1, {"數", "数"}) ? word + 2 : word + 1;
    addCount(i, end, "flower", "", *range, "merous");
    evidence_ += 2;  // a word that only botany uses
    return end;
  }
  if (const std::size_t end = readCountedWord(i, *range)) return end;
  if (const std::size_t end = readCountOfOrganBefore(i, *range)) return end;
  return readCountOfOrganAfter(i, *range);
}

ParagraphReader::Measure ParagraphReader::measureAt(std::size_t i) const {
  if (isAny(i, {"pairs", "pair", "對", "对", "雙", "双"})) {
    std::size_t end = is(i + 1, "of") ? i + 2 : i + 1;
    return {end, "pairs"};
  }
  if (is(i, "on") && isAny(i + 1, {"each", "either"}) && is(i + 2, "side")) return {i + 3, "per side"};
  if (isAny(i, {"per", "in"}) && (is(i + 1, "locule") || (is(i + 1, "each") && is(i + 2, "locule")))) return {is(i + 1, "each") ? i + 3 : i + 2, "per locule"};
  if (isAny(i, {"枚", "片", "個", "个", "朵", "條", "条", "根", "瓣", "粒", "顆", "颗"})) return {i + 1, ""};
  return {i, ""};
}

// What the word at i counts, after a number: "lobed", 淺裂, 室.
ParagraphReader::Counted ParagraphReader::countedBy(std::size_t i) const {
  const std::size_t at = is(i, "-") ? i + 1 : i;
  for (const CountedWord& word : countedWords)
    if (is(at, word.word)) return {word.organ, word.piece, word.unit, at + 1};
  if (isAny(i, {"瓣"}) && isAny(i + 1, {"裂", "開", "开"})) return {"fruit", "valve", "", i + 2};
  if (isAny(i, {"裂"})) return {"", "lobe", "", i + 1};
  if (isAny(i, {"淺", "浅", "深", "中", "全"}) && is(i + 1, "裂")) return {"", "lobe", "", i + 2};
  if (isAny(i, {"室"})) return {"ovary", "locule", "", i + 1};
  if (isAny(i, {"齒", "齿"}) && !isAny(i + 1, {"狀", "状"})) return {"", "tooth", "", i + 1};
  if (isAny(i, {"脈", "脉"})) return {"vein", "", "", i + 1};
  if (isAny(i, {"出"}) && isAny(i + 1, {"脈", "脉"})) return {"vein", "", "", i + 2};
  return {};
}

std::size_t ParagraphReader::readCountedWord(std::size_t i, const NumberRange& range) {
  const Counted counted = countedBy(range.end);
  if (counted.end == 0) return 0;
  const Concept* attributive = counted.organ.empty() ? organAfter(counted.end) : nullptr;
  if (counted.organ.empty() && attributive == nullptr && (scope_.organ == nullptr || !scope_.organInSentence)) return 0;
  const std::string organ = !counted.organ.empty() ? counted.organ : attributive != nullptr ? attributive->name : scope_.organ->name;
  const bool isMember = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"fruit"}) && counted.piece == "locule";
  const bool cellsOfOvary = counted.piece == "locule" && !isMember && scope_.organ != nullptr && scope_.organ->name == "anther";
  if (isWordWithNumber(range.end) == false && counted.organ.empty() && isOneOf(organ, {"plant", "vein", "bark"})) return 0;
  if (!isNegated(i)) {
    const std::string owner = isMember || cellsOfOvary ? scope_.organ->name : organ;
    addCount(i, counted.end, owner, counted.piece, range, counted.unit);
    evidence_ += 1;
    if (counted.piece == "lobe") addLobedShape(i, counted.end, range);
    if (counted.organ == "leaflet") organSeen_ = true;
    if (counted.organ == "leaflet" && i > 0 && isAny(i - 1, {"digitately", "palmately"})) {
      Trait type = traitAt(i - 1, counted.end, "leaf", "type");
      type.value = range.low == 3 && range.high == 3 ? "trifoliolate" : "palmate";
      keep(std::move(type), true);
    }
  }
  last_ = {counted.end, nullptr, {}, false, false, false};
  return counted.end;
}

// A blade cut into lobes has a shape or a margin by that: "palmately 5-lobed", "3-lobed", "5-9-lobed".
void ParagraphReader::addLobedShape(std::size_t i, std::size_t end, const NumberRange& range) {
  const std::string organ = result_.traits.back().organ;
  if (!isOneOf(organ, {"leaf", "leaflet"}) || (scope_.piece != nullptr && scope_.piece->name != "blade")) return;
  const bool palmate = i > 0 && (is(i - 1, "palmately") || (i > 1 && is(i - 2, "掌") && isAny(i - 1, {"狀", "状"})));
  const bool pinnate = i > 0 && (is(i - 1, "pinnately") || (i > 1 && is(i - 2, "羽") && isAny(i - 1, {"狀", "状"})));
  const std::size_t first = palmate || pinnate ? (isHan(i - 1) ? i - 2 : i - 1) : i;
  const bool plain = !palmate && !pinnate;
  const bool three = plain && range.low == 3 && range.high == 3 && !range.maximum && !range.minimum;
  const bool two = plain && range.low == 2 && range.high == 2 && !range.maximum;
  Trait trait = traitAt(first, end, organ, plain && !three && !two ? "margin" : "shape");
  trait.value = palmate ? "palmately lobed" : pinnate ? "pinnately lobed" : three ? "trilobate" : two ? "bilobed" : "lobed";
  trait.qualifier = qualifierBefore(first);
  trait.which = scope_.which;
  result_.traits.insert(result_.traits.end() - 1, std::move(trait));
}

bool ParagraphReader::isWordWithNumber(std::size_t i) const {
  return (is(i, "-") && i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::Word) || isAny(i, {"*", "/", "%", "°", "裂", "出", "脈", "脉", "times", "倍", "回", "月", "年", "數", "数", "x"}) ||
         (i < found_.size() && found_[i].conceptAs("dimension") != nullptr && !isHan(i));
}

// Where the words between an organ and its count begin: "petals usually 5", 側脈約8對.
std::size_t ParagraphReader::beforeCount(std::size_t i) const {
  std::size_t before = i;
  while (before > scope_.organEnd &&
         (isAny(before - 1, {":", "有", "為", "为", "約", "约", "ca", ".", "about", "通", "常", "多", "each", "are", "各", "共", "含", "(", "具", "in", "number", "c", "is", "up", "to", "達", "达", "可"}) ||
          !qualifierOf(tokens_[before - 1].text).empty()))
    --before;
  return before;
}

// "petals 5", "leaflets 5-8 pairs", 小葉8-12對, 有花3-7朵. A number that goes on as a size counts nothing.
std::size_t ParagraphReader::readCountOfOrganBefore(std::size_t i, const NumberRange& range) {
  if (scope_.organ == nullptr || !scope_.organInSentence) return 0;
  const Concept& noun = scope_.piece != nullptr && scope_.piece->name != "blade" ? *scope_.piece : *scope_.organ;
  if (!isCountable(noun) || beforeCount(i) != scope_.organEnd || isWordWithNumber(range.end)) return 0;
  if (scope_.place != nullptr && scope_.place->name != "surface") return 0;
  const Measure measure = measureAt(range.end);
  const Concept* next = nounAt(measure.end);
  if (next != nullptr && measure.end == range.end && isHan(measure.end) && next != scope_.organ) return 0;  // 具3花
  const bool ofPiece = &noun == scope_.piece;
  addCount(i, measure.end, scope_.organ->name, ofPiece ? noun.name : "", range, measure.unit);
  if (!ofPiece || !found_[scope_.organEnd - 1].as("organ")) evidence_ += 1;
  return is(measure.end, "per") && nounAt(measure.end + 1) != nullptr ? found_[measure.end + 1].end : measure.end;
}

// "5 petals", "10 pairs of leaflets", 5枚花瓣, 具3～7花.
std::size_t ParagraphReader::readCountOfOrganAfter(std::size_t i, const NumberRange& range) {
  const Measure measure = measureAt(range.end);
  std::size_t at = measure.end;
  if (isAny(at, {"的"})) ++at;
  while (at < tokens_.size() && hasTraitMeaning(at) && !isHan(at) && nounAt(at) == nullptr && at < measure.end + 3) at = found_[at].end;  // "5 white petals"
  const Concept* noun = nounAt(at);
  if (noun == nullptr || isAny(i, {"one", "一"})) return 0;
  const std::string& role = noun->columns.at("role");
  const bool inside = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"inflorescence", "spikelet"});
  const bool flowersHan = isHan(at) && noun->name == "flower" && inside;
  if (flowersHan) {
    addCount(i, found_[at].end, "flower", "", range, "per inflorescence");
    evidence_ += 1;
    return found_[at].end;
  }
  if (!isCountable(*noun) || (found_[at].as("organ")->everyday && noun->name != "flower" && role == "organ" && noun->name != "leaf")) return 0;
  if (noun->name == "leaf" && measure.end == range.end && range.low == range.high && !scope_.organInSentence) return 0;  // "2 leaves" in any prose
  const std::string organ = role == "sub" ? ownerOf(*noun, at)->name : noun->name;
  addCount(i, found_[at].end, organ, role == "sub" ? noun->name : "", range, measure.unit);
  return measure.end == at ? at : range.end;  // the adjectives and the organ are read next
}

}  // namespace axil::keywords
