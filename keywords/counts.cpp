// Numbers that count: organs, leaves at a node, the pieces of an organ.
#include "keywords/paragraph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::keywords {

namespace {

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
    {"leaved", "leaf", "", ""},       {"rayed", "ray floret", "", ""},     {"paired", "", "", "pairs"},     {"jugate", "", "", "pairs"},
    {"awned", "awn", "", ""},
    {"jug", "", "", "pairs"},         {"winged", "", "wing", ""},       {"ribbed", "", "rib", ""},
};

}  // namespace

bool isCountable(const Concept& noun) { return noun.columns.at("countable") == "yes"; }

void ParagraphReader::addCount(std::size_t first, std::size_t end, const std::string& organ, const std::string& piece, const NumberRange& range, const std::string& unit) {
  Trait trait = traitAt(first, end, organ, unit == "merous" ? "merosity" : "count");
  trait.low = range.low;
  trait.high = range.high;
  trait.minimum = range.minimum;
  trait.maximum = range.maximum;
  trait.unit = unit == "merous" ? "" : unit;
  if (scope_.stranger && (scope_.organ == nullptr || scope_.organ->name == organ)) return;
  trait.part = piece;
  trait.qualifier = range.open ? "more than" : qualifierBefore(first);
  if (scope_.organ != nullptr && scope_.organ->name == organ) trait.which = scope_.which;
  keep(std::move(trait), !piece.empty());
  lastCount_ = {end, organ, piece, unit};
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
  if (isAny(i, {"cluster", "clusters", "group", "groups", "tufts"})) return true;
  const Concept* arrangement = found_[i].conceptAs("arrangement");
  return arrangement != nullptr && isOneOf(arrangement->name, {"whorled", "fascicled"});
}

// Whether the clause goes on to say how the leaves of one node stand.
bool ParagraphReader::isGatheredAhead(std::size_t i) const {
  constexpr std::size_t near = 40;  // an endless clause must not be walked again from each of its numbers
  for (const std::size_t end = std::min(i + near, tokens_.size()); i < end && !isSentenceEnd(i) && !is(i, ";"); ++i)
    if (found_[i].conceptAs("arrangement") != nullptr) return true;
  return false;
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
  const bool others = scope_.organ != nullptr && scope_.organInSentence && isOneOf(scope_.organ->name, {"flower", "branch", "bract", "inflorescence", "fruit", "thorn", "leaflet", "tepal"});
  const std::string organ = others ? scope_.organ->name : std::string("leaf");
  const std::size_t counted = isAny(range.end, {"朵", "個", "个", "枚"}) ? range.end + 1 : range.end;
  if (perNodeHan && nounAt(counted) != nullptr && nounAt(counted)->name == "flower") {  // 每輪6-10花
    addCount(i, found_[counted].end, "flower", "", range, "per inflorescence");
    return found_[counted].end;
  }
  if (ofWhorls || ofInWhorls || perNodeHan) {
    addCount(ofInWhorls ? i - 3 : i - 2, range.end, organ, "", range, "per node");
    return range.end;
  }
  std::size_t at = range.end;
  while (isAny(at, {"枚", "片", "張", "张", "-", "針", "针", "呈"}) || (at < tokens_.size() && nounAt(at) != nullptr && nounAt(at)->name == "leaf")) at = std::max(at + 1, found_[at].end);
  const std::size_t perNode = afterPerNode(at);
  const bool othersPerNode = others && perNode != 0 && at == range.end;  // "branches 2 per node"
  if ((perNode == 0 && !isGathered(at)) || !(othersPerNode || leafIsMeant(range.end, at))) return 0;
  // 8-12片聚生莖頂: all of them, and not at one node.
  if (perNode == 0 && isHan(at) && isAny(found_[at].end, {"莖", "茎", "枝", "於", "于", "稈", "秆", "幹", "干"}) && !isAny(at, {"輪", "轮"}) && range.high > 5) return 0;
  addCount(i, perNode != 0 ? perNode : found_[at].end, othersPerNode ? organ : std::string("leaf"), "", range, "per node");
  evidence_ += 1;
  if (perNode == 0) return at;  // the arrangement itself is read next
  // "3 or 4 in a whorl" says the arrangement too, where nothing before has said it.
  const bool said = last_.category != nullptr && last_.category->property == "arrangement" && last_.kept;
  const bool three = range.low >= 3 && is(perNode - 1, "node") && !othersPerNode && !isGatheredAhead(perNode);
  if (three && !said) {  // "leaves three at a node"
    Trait trait = traitAt(i, perNode, "leaf", "arrangement");
    trait.value = "whorled";
    keep(std::move(trait), true);
  }
  return isAny(perNode - 1, {"whorl", "verticil", "fascicle", "bundle", "cluster"}) && !said ? perNode - 1 : perNode;
}

std::size_t ParagraphReader::readCount(std::size_t i) {
  const std::optional<NumberRange> range = rangeAt(tokens_, i);
  if (!range || !isCount(*range)) return 0;
  // 一年生, 二列: numbers inside words of the vocabulary count nothing.
  if (isHan(i) && found_[i] && found_[i].end > range->end) return 0;
  if (const std::size_t end = readLeavesPerNode(i, *range)) return end;
  const std::size_t word = is(range->end, "-") ? range->end + 1 : range->end;
  const bool merousHan = (isAny(word, {"數", "数"}) || (is(word, "基") && isAny(word + 1, {"數", "数"}))) && scope_.organInSentence;
  if (isAny(word, {"merous"}) || merousHan) {
    const std::size_t end = is(word, "基") && isAny(word + 1, {"數", "数"}) ? word + 2 : word + 1;
    addCount(i, end, "flower", "", *range, "merous");
    evidence_ += 2;  // a word that only botany uses
    return end;
  }
  // "cymes of 20-50": flowers, where no organ follows.
  const bool ofInflorescence = i >= 2 && is(i - 1, "of") && scope_.organ != nullptr && scope_.organ->name == "inflorescence" && scope_.organEnd + 1 == i;
  if (ofInflorescence && (range->end >= tokens_.size() || tokens_[range->end].kind == TokenKind::Sign) && !is(range->end, "-")) {
    addCount(i, range->end, "flower", "", *range, "per inflorescence");
    return range->end;
  }
  if (const std::size_t end = readCountedWord(i, *range)) return end;
  // 葉3-5掌狀全裂: the lobes.
  const bool ofLobes = isAny(range->end, {"掌", "羽"}) && isAny(range->end + 1, {"狀", "状"}) && scope_.organ != nullptr && isOneOf(scope_.organ->name, {"leaf", "leaflet"}) && found_[range->end].as("shape") != nullptr;
  if (ofLobes) {
    addCount(i, range->end, scope_.organ->name, "lobe", *range, "");
    return range->end;
  }
  if (const std::size_t end = readCountGoingOn(i, *range)) return end;
  if (const std::size_t end = readCountOfOrganBefore(i, *range)) return end;
  if (const std::size_t end = readCountOfOrganAfter(i, *range)) return end;
  return afterUnread(i, *range);
}

// A range that says nothing here is left as a whole, or its numbers would be read one by one; with it what it is multiplied by:
// "leaf (12-)23-34 × 45-56" has no unit.
std::size_t ParagraphReader::afterUnread(std::size_t i, const NumberRange& range) const {
  for (std::size_t k = i + 1; k < range.end; ++k)
    if (found_[k] && found_[k].end > range.end) return 0;
  std::size_t end = range.end;
  while (is(end, "*")) {
    const std::optional<NumberRange> next = rangeAt(tokens_, end + 1);
    if (!next) break;
    end = next->end;
  }
  return end > i + 1 ? end : 0;
}

ParagraphReader::Measure ParagraphReader::measureAt(std::size_t i) const {
  if (isAny(i, {"pairs", "pair", "對", "对", "雙", "双"})) {
    std::size_t end = is(i + 1, "of") ? i + 2 : i + 1;
    return {end, "pairs"};
  }
  if (is(i, "on") && isAny(i + 1, {"each", "either", "both"}) && isAny(i + 2, {"side", "sides"})) return {i + 3, "per side"};
  if (is(i, "per") && is(i + 1, "side")) return {i + 2, "per side"};
  if (isAny(i, {"per", "in"}) && (isAny(i + 1, {"locule", "cell"}) || (is(i + 1, "each") && isAny(i + 2, {"locule", "cell"})))) return {is(i + 1, "each") ? i + 3 : i + 2, "per locule"};
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
  if (isAny(i, {"淺", "浅"}) && isAny(i + 1, {"圓", "圆"}) && is(i + 2, "裂")) return {"", "lobe", "", i + 3};
  if (isAny(i, {"淺", "浅", "粗", "細", "细"}) && isAny(i + 1, {"齒", "齿"}) && is(i + 2, "裂")) return {"", "tooth", "", i + 3};
  // 具1-3鈍齒, 有粗鋸齒5-8, 具二縱稜: the word behind is read as a term too.
  if (isAny(i, {"鈍", "钝", "尖", "銳", "锐", "粗", "細", "细", "圓", "圆", "大", "小", "疏", "淺", "浅"}) && (isAny(i + 1, {"齒", "齿"}) || (isAny(i + 1, {"鋸", "锯"}) && isAny(i + 2, {"齒", "齿"})))) return {"", "tooth", "", i};
  if (isAny(i, {"縱", "纵"}) && isAny(i + 1, {"稜", "棱", "肋", "脊"})) return {"", "rib", "", i};
  if (isAny(i, {"室"})) return {"ovary", "locule", "", i + 1};
  if (isAny(i, {"齒", "齿"}) && !isAny(i + 1, {"狀", "状"})) return {"", "tooth", "", i + 1};
  if (isAny(i, {"脈", "脉"})) return {"vein", "", "", i + 1};
  if (isAny(i, {"節", "节"}) && !isAny(i + 1, {"間", "间", "莢", "荚"}) && scope_.organ != nullptr && scope_.organ->name == "stem") return {"node", "", "", i + 1};
  if (isAny(i, {"出"}) && isAny(i + 1, {"脈", "脉"})) return {"vein", "", "", i + 2};
  return {};
}

// 每側具3-8個刺狀粗鋸齒: the teeth are named behind a counter and adjectives, and are read as a term too.
ParagraphReader::Counted ParagraphReader::teethBehindCounter(std::size_t i) const {
  if (!isAny(i, {"個", "个", "枚", "對", "对"})) return {};
  const auto areTeeth = [&](std::size_t k) { return found_[k].as("margin") != nullptr && isAny(found_[k].end - 1, {"齒", "齿"}); };
  std::size_t at = i + 1;
  while (at < i + 10 && at < tokens_.size() && !areTeeth(at) && (isAny(at, {"小", "大", "粗", "細", "细", "尖", "鈍", "钝", "的", "狀", "状", "不", "明", "顯", "显", "規", "规", "則", "则", "整", "齊", "齐", "疏", "銳", "锐", "淺", "浅", "之", "圓", "圆"}) || isAny(at + 1, {"狀", "状"}) || isAny(at + 2, {"狀", "状"}))) ++at;
  return at < tokens_.size() && areTeeth(at) ? Counted{"", "tooth", isAny(i, {"對", "对"}) ? "pairs" : "", i + 1} : Counted{};
}

std::size_t ParagraphReader::readCountedWord(std::size_t i, const NumberRange& range) {
  const std::size_t word = afterSharing(range.end);
  Counted counted = countedBy(word);
  if (counted.end == 0) counted = teethBehindCounter(range.end);
  const bool cuts = counted.end == 0 && isAny(range.end, {"個", "个", "枚"}) && !isAny(range.end + 2, {"片"}) && !isAny(range.end + 3, {"片"});
  if (cuts)  // 1-3個淺裂
    if (const Counted cut = countedBy(range.end + 1); cut.piece == "lobe") counted = cut;
  if (counted.end == 0) return 0;
  if (word != range.end) counted.end = range.end + 1;
  const Concept* attributive = counted.organ.empty() ? organAfter(counted.end) : nullptr;
  if (counted.organ.empty() && attributive == nullptr && (scope_.organ == nullptr || !scope_.organInSentence)) return 0;
  // 葉3裂（幼樹偶5裂）: the leaf's.
  const bool aside = attributive == nullptr && scope_.organ != nullptr && scope_.organ->name == "plant" && counted.piece == "lobe";
  const Concept* subject = aside && !outside_.empty() ? outside_.back().organ : scope_.organ;
  if (aside && (subject == nullptr || subject->name == "plant")) return 0;
  const std::string organ = !counted.organ.empty() ? counted.organ : attributive != nullptr ? attributive->name : subject->name;
  const bool apexCut = counted.piece == "lobe" && range.low == 2 && range.high == 2 && attributive == nullptr && scope_.place != nullptr && scope_.place->name == "apex";
  if (apexCut && !isNegated(i)) {  // "apex 2-lobed", 先端二深裂
    Trait trait = traitAt(i, counted.end, organ, "apex");
    trait.value = "bilobed";
    keep(std::move(trait), false);
    return counted.end;
  }
  const bool isMember = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"fruit"}) && counted.piece == "locule";
  const bool cellsOfOvary = counted.piece == "locule" && !isMember && scope_.organ != nullptr && scope_.organ->name == "anther";
  if (isWordWithNumber(range.end) == false && counted.organ.empty() && isOneOf(organ, {"plant", "vein", "bark"})) return 0;
  if (!isNegated(i)) {
    const std::string owner = isMember || cellsOfOvary ? scope_.organ->name : organ;
    const bool opens = scope_.organEnd > 1 && !isAny(scope_.organEnd - 2, {"核", "漿", "浆", "堅", "坚", "瘦"});
    const bool valves = owner == "fruit" && counted.piece == "lobe" && isHan(counted.end - 1) && opens;  // 蒴果三裂
    addCount(i, counted.end, owner, valves ? "valve" : counted.piece, range, counted.unit.empty() && counted.piece == "tooth" ? unitOfEach(i) : counted.unit);
    evidence_ += 1;
    if (counted.piece == "lobe" && !valves) addLobedShape(i, counted.end, range);
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
  if (scope_.stranger || result_.traits.empty()) return;
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
  return (is(i, "-") && i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::Word) || isAny(i, {"*", "/", "%", "°", "裂", "出", "脈", "脉", "times", "倍", "回", "月", "年", "數", "数", "x", "層", "层", "列", "輪", "轮", "系", "岔", "series", "row", "rows", "rank", "ranks", "tiers", "layers", "cycles", "型", "叉", "側", "侧", "面", "端", "邊", "边", "旁", "行", "圈", "體", "体", "強", "强"}) ||
         (i < found_.size() && found_[i].conceptAs("dimension") != nullptr && !isHan(i));
}

// Where the words between an organ and its count begin: "petals usually 5", 側脈約8對.
std::size_t ParagraphReader::beforeCount(std::size_t i) const {
  std::size_t before = i;
  while (before > scope_.organEnd &&
         (isAny(before - 1, {":", "有", "為", "为", "約", "约", "ca", ".", "about", "通", "常", "多", "each", "are", "各", "共", "含", "(", "具", "in", "number", "c", "is", "up", "to", "達", "达", "可",
                                "±", "always", "only", "僅", "仅", "均", "皆"}) ||
          !qualifierOf(tokens_[before - 1].text).empty() || beforeEach(before) != before))
    before = std::min(before - 1, beforeEach(before));
  return before;
}

// "phyllaries in 2 series, 10-14", 總苞片2層，10-14枚: behind the number of rows that of all.
bool ParagraphReader::isBehindRows(std::size_t before) const {
  if (before < 3 || !isAny(before - 1, {",", "、"}) || !isAny(before - 2, {"層", "层", "輪", "轮", "列", "series", "rows", "whorls", "cycles"})) return false;
  const std::size_t from = scope_.organEnd + (is(scope_.organEnd, "in") ? 1 : 0);
  const std::optional<NumberRange> rows = rangeAt(tokens_, from);
  return rows && rows->end + 2 == before;
}

// Where 每 begins in 每室10粒, 每側40枚; `i` itself where it does not.
std::size_t ParagraphReader::beforeEach(std::size_t i) const {
  for (std::size_t back = 2; back <= 5 && back <= i; ++back) {
    if (!is(i - back, "每")) continue;
    const Found& f = found_[i - back + 1];
    return (f && f.end == i) || (back == 2 && isAny(i - 1, {"邊", "边", "側", "侧"})) ? i - back : i;
  }
  return i;
}

// "per locule", "per side" from the words before a number.
std::string ParagraphReader::unitOfEach(std::size_t i) const {
  for (std::size_t at = i; at > scope_.organEnd && at + 8 > i; --at) {
    const std::size_t each = beforeEach(at);
    if (each == at) continue;
    const Concept* noun = nounAt(each + 1);
    if (noun != nullptr) return "per " + noun->name;
    return isAny(each + 1, {"側", "侧", "邊", "边"}) ? "per side" : std::string();
  }
  return {};
}

// "leaflets 5, rarely 3 or 7", 小葉5枚，稀3枚: a second number for what was counted just before.
std::size_t ParagraphReader::readCountGoingOn(std::size_t i, const NumberRange& range) {
  if (lastCount_.end == 0 || i <= lastCount_.end || isWordWithNumber(range.end)) return 0;
  bool qualified = false;
  std::size_t before = i;
  while (before > lastCount_.end) {
    const bool frequency = isOneOf(qualifierOf(tokens_[before - 1].text), {"rarely", "sometimes", "usually"}) || isAny(before - 1, {"通", "極", "极", "有", "間", "间", "occasionally"});
    if (!frequency && !isAny(before - 1, {",", "、", "or", "或", "(", "但", "but", "very", "more", "less", "為", "为", "枚", "片", "朵", "個", "个", "條", "条", "對", "对", "pairs"})) return 0;
    qualified = qualified || frequency || isAny(before - 1, {"or", "或"});
    --before;
  }
  if (!qualified) return 0;
  const Measure measure = measureAt(range.end);
  const Concept* next = nounAt(measure.end);
  if (next != nullptr && next->name != lastCount_.organ && isCountable(*next)) return 0;
  if (scope_.stranger) return measure.end;
  const LastCount last = lastCount_;
  addCount(i, measure.end, last.organ, last.piece, range, measure.unit.empty() ? last.unit : measure.unit);
  if (std::string& qualifier = result_.traits.back().qualifier; qualifier.empty()) qualifier = "sometimes";  // 間有十三枚
  return measure.end;
}

}  // namespace axil::keywords
