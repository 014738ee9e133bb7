#include "keywords/read.hpp"

#include "keywords/lexicon.hpp"
#include "keywords/quantities.hpp"
#include "keywords/tokens.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace axil::keywords {

namespace {

constexpr std::size_t blockBytes = 64 * 1024;

// A paragraph is about a plant when it says so: with one word that only botany uses, or with everyday ones that support each
// other ("leaves" and, right beside it, "opposite"). Otherwise it is about something else, and yields nothing.
constexpr int enoughEvidence = 2;

using Words = std::initializer_list<std::string_view>;
bool isOneOf(std::string_view text, Words words) { return std::find(words.begin(), words.end(), text) != words.end(); }

bool isGrammarWord(const Category& category) {
  return isOneOf(category.property, {"organ", "unit", "dimension", "stop"});
}

// ---- what the words around a token do

bool negates(std::string_view word) {
  return isOneOf(word, {"not", "never", "non", "neither", "nor", "without", "lacking", "不", "非", "無", "无", "未", "沒", "没"});
}

std::string_view qualifierOf(std::string_view word) {
  if (isOneOf(word, {"rarely", "seldom", "稀", "罕", "偶", "occasionally", "exceptionally"})) return "rarely";
  if (isOneOf(word, {"sometimes", "有時", "时"})) return "sometimes";
  if (isOneOf(word, {"usually", "mostly", "often", "generally", "commonly", "typically", "mainly", "多", "常"})) return "usually";
  if (isOneOf(word, {"narrowly", "narrow", "狹", "狭", "窄"})) return "narrowly";
  if (isOneOf(word, {"broadly", "broad", "widely", "闊", "阔", "寬", "宽", "廣", "广"})) return "broadly";
  if (isOneOf(word, {"nearly", "almost", "sub", "近", "略", "稍"})) return "nearly";
  return {};
}

// "opposite the window": an everyday word that goes on to a noun of its own is no trait.
bool leadsElsewhere(std::string_view next) {
  return isOneOf(next, {"the", "a", "an", "of", "this", "that", "these", "his", "her", "their", "its", "my", "our", "your", "each", "one", "number"});
}

bool isVerbLeaves(const std::vector<Token>& tokens, std::size_t i) {
  if (tokens[i].text != "leaves") return false;
  const bool object = i + 1 < tokens.size() && isOneOf(tokens[i + 1].text, {"the", "a", "an", "his", "her", "him", "them", "it", "us", "me", "their",
                                                                            "its", "my", "your", "our", "no", "for", "behind", "home", "little", "much"});
  const bool subject = i > 0 && isOneOf(tokens[i - 1].text, {"he", "she", "it", "who", "which", "that", "this", "never", "always", "one", "train", "bus"});
  return object || subject;
}

bool isSentenceEnd(const std::vector<Token>& tokens, std::size_t i, std::string_view text, std::uint32_t firstByte) {
  const std::string_view sign = tokens[i].text;
  if (isOneOf(sign, {"。", "!", "?", "．"})) return true;
  if (sign != ".") return false;
  if (i + 1 == tokens.size()) return true;
  const Token& next = tokens[i + 1];
  if (i > 0 && isOneOf(tokens[i - 1].text, {"ca", "c", "diam", "var", "subsp", "ssp", "e", "g", "i", "cf", "approx", "fig"})) return false;
  const char first = text[next.begin - firstByte];
  return next.kind == TokenKind::Han || (next.spaceBefore && first >= 'A' && first <= 'Z');
}

// Statements about form do not fit a whole plant or its stem; strong words said there are about the leaves.
bool isBody(const Concept& organ) { return isOneOf(organ.name, {"plant", "stem", "root", "bark"}); }

// ---- one block of text

struct Scope {
  const Concept* organ = nullptr;
  const Concept* part = nullptr;
  std::size_t organEnd = 0;         // token after the organ's name
  bool organInSentence = false;
  bool subjectInClause = false;     // since the last . or ;
  bool subjectInSegment = false;    // since the last comma too
  bool commaSincePart = false;
};

class BlockReader {
 public:
  BlockReader(std::string_view text, std::uint32_t firstByte, const TokenList& list, const Concept* organBefore, Traits& out)
      : text_(text), firstByte_(firstByte), tokens_(list.tokens), found_(findPhrases(list.tokens)), traits_(out) {
    scope_.organ = organBefore;
  }

  const Concept* read() {
    const std::size_t before = traits_.size();
    for (std::size_t i = 0; i < tokens_.size();) i = std::max(step(i), i + 1);
    if (evidence_ < enoughEvidence) traits_.resize(before);
    return scope_.organ;
  }

 private:
  struct LastTerm {
    std::size_t end = 0;
    const Category* category = nullptr;
    std::string qualifier;
    bool negated = false;
    bool kept = false;
  };

  [[nodiscard]] bool is(std::size_t i, std::string_view text) const { return i < tokens_.size() && tokens_[i].text == text; }
  [[nodiscard]] bool isAny(std::size_t i, Words words) const { return i < tokens_.size() && isOneOf(tokens_[i].text, words); }
  [[nodiscard]] const Concept* organAt(std::size_t i, std::string_view role) const {
    if (i >= tokens_.size() || isVerbLeaves(tokens_, i)) return nullptr;
    const Concept* organ = found_[i].conceptAs("organ");
    return organ != nullptr && organ->columns.at("role") == role ? organ : nullptr;
  }

  // Reads what begins at token i; the token after it.
  std::size_t step(std::size_t i) {
    if (tokens_[i].kind == TokenKind::Sign) noteSign(i);
    if (const std::size_t end = readCount(i)) return end;
    if (const std::size_t end = readSizes(i)) return end;
    const Found& f = found_[i];
    if (!f) return i + 1;
    if (f.conceptAs("organ") != nullptr) noteOrgan(i);
    readTerm(i);
    return f.end;
  }

  void noteSign(std::size_t i) {
    const bool sentence = isSentenceEnd(tokens_, i, text_, firstByte_);
    if (sentence) scope_.organInSentence = false;
    if (sentence || isAny(i, {";", "；"})) {
      scope_.subjectInClause = scope_.subjectInSegment = false;
      scope_.part = nullptr;
    }
    if (isAny(i, {",", "、"})) {
      scope_.subjectInSegment = false;
      scope_.commaSincePart = true;
    }
  }

  // "in the axils of leaves": an organ that is only the place of another does not take over.
  [[nodiscard]] bool isPlaceOnly(std::size_t i) const {
    const bool isMeasuredItself = found_[i].end < tokens_.size() && tokens_[found_[i].end].kind == TokenKind::Number;  // "in racemes 5-10 cm long"
    if (!scope_.organInSentence || i == 0 || isMeasuredItself) return false;
    std::size_t before = i - 1;
    if (before > 0 && isAny(before, {"the", "its", "each", "a"})) --before;
    if (before > 0 && is(before, "of") && isAny(before - 1, {"pairs", "pair", "whorls", "clusters"})) return false;
    return isAny(before, {"of", "in", "from", "on", "than", "to", "opposite", "exceeding", "between", "above", "below", "among", "towards", "near", "at", "於", "于"});
  }

  void noteOrgan(std::size_t i) {
    if (const Concept* part = organAt(i, "part")) {
      // "cordate at base" has taken its part along; "at base cordate" opens one.
      if (!isPartOfTermBefore(i)) scope_.part = part;
      scope_.commaSincePart = false;
      return;
    }
    const Concept* organ = organAt(i, "organ");
    if (organ == nullptr) return;
    weighOrgan(i, *organ);
    if (isPlaceOnly(i)) return;
    // A plant or a twig bears what follows ("a shrub with opposite, ovate leaves"); it is not what the adjectives are about.
    const bool bears = isBody(*organ) || organ->name == "branch";
    scope_ = {organ, nullptr, found_[i].end, true, !bears, true, false};
  }

  // Everyday organs count once each, and words for whole plants not at all: power plants and family trees abound.
  void weighOrgan(std::size_t i, const Concept& organ) {
    if (!found_[i].as("organ")->everyday) {
      evidence_ += 2;
    } else if (organ.name != "plant" && std::find(organsSeen_.begin(), organsSeen_.end(), &organ) == organsSeen_.end()) {
      organsSeen_.push_back(&organ);
      evidence_ += 1 + (opensAStatement(i) ? 1 : 0);
    }
  }

  // "Leaves not whorled", "Seeds 3-6": an organ that begins a sentence and goes on without a verb, as descriptions do.
  [[nodiscard]] bool opensAStatement(std::size_t i) const {
    const bool begins = i == 0 || isSentenceEnd(tokens_, i - 1, text_, firstByte_);
    const std::size_t next = found_[i].end;
    if (!begins || next >= tokens_.size()) return false;
    return isAny(next, {"not"}) || tokens_[next].kind == TokenKind::Number || !qualifierOf(tokens_[next].text).empty();
  }

  [[nodiscard]] bool isRightBehindOrgan(std::size_t i) const {
    std::size_t at = i;
    while (at > scope_.organEnd && (isAny(at - 1, {"are", ":", "呈", "為", "为"}) || !qualifierOf(tokens_[at - 1].text).empty())) --at;
    return scope_.organ != nullptr && at == scope_.organEnd && i >= scope_.organEnd;
  }

  [[nodiscard]] bool isPartOfTermBefore(std::size_t i) const {
    std::size_t at = i;
    while (at > 0 && isAny(at - 1, {"the", "at", "toward", "towards", "near", "its"})) --at;
    return at < i && last_.end == at && last_.kept;
  }

  // ---- terms

  // The part in "cordate at the base".
  [[nodiscard]] const Concept* partAfter(std::size_t end) const {
    if (!isAny(end, {"at", "toward", "towards", "near"})) return nullptr;
    std::size_t at = end + 1;
    while (isAny(at, {"the", "its", "both"})) ++at;
    return organAt(at, "part");
  }

  // The organ in "opposite, broadly ovate leaves", "對生的葉", seen from behind an adjective.
  [[nodiscard]] const Concept* organAfter(std::size_t end) const {
    bool comma = false;
    bool linked = false;  // 的
    std::size_t at = end;
    for (int steps = 0; steps < 10 && at < tokens_.size(); ++steps) {
      if (const Concept* organ = organAt(at, "organ")) {
        if (startsALine(at) || (at > 0 && isAny(at - 1, {",", "、", ";"}))) return nullptr;
        if (tokens_[at].kind == TokenKind::Han) return linked || !scope_.subjectInSegment ? organ : nullptr;
        return !comma || !scope_.subjectInClause ? organ : nullptr;
      }
      if (isAny(at, {"的", "之"})) {
        linked = true;
        ++at;
      } else if (isAny(at, {",", "、"})) {
        comma = true;
        ++at;
      } else if (isAny(at, {"and", "or", "to", "-", "至", "或", "和"}) || !qualifierOf(tokens_[at].text).empty()) {
        ++at;
      } else if (hasTraitMeaning(at)) {
        at = found_[at].end;
      } else {
        return nullptr;
      }
    }
    return nullptr;
  }

  // A list of lines without full stops: "Leaves: opposite / Flowers: white".
  [[nodiscard]] bool startsALine(std::size_t i) const {
    if (!tokens_[i].lineBreakBefore) return false;
    const char first = text_[tokens_[i].begin - firstByte_];
    return tokens_[i].kind == TokenKind::Han || (first >= 'A' && first <= 'Z');
  }

  [[nodiscard]] bool hasTraitMeaning(std::size_t i) const {
    return found_[i] && std::any_of(found_[i].phrase->meanings.begin(), found_[i].phrase->meanings.end(),
                                    [](const Meaning& m) { return !isGrammarWord(*m.category); });
  }

  // Of a phrase's meanings the one that fits the part in scope: "cordate" of a base, "rounded" of an apex.
  [[nodiscard]] const Meaning* meaningFor(const Found& f, const Concept* part) const {
    const Meaning* whole = nullptr;
    const Meaning* any = nullptr;
    for (const Meaning& m : f.phrase->meanings) {
      if (isGrammarWord(*m.category)) continue;
      if (part != nullptr && m.category->part == part->name) return &m;
      if (m.category->part.empty() && whole == nullptr) whole = &m;
      if (any == nullptr) any = &m;
    }
    return whole != nullptr ? whole : any;
  }

  [[nodiscard]] bool isNegated(std::size_t i) const {
    const bool linkedToNegated = last_.negated && i > 0 && last_.end == i - 1 && isAny(i - 1, {"or", "nor", "或"});
    if (linkedToNegated) return true;
    for (std::size_t back = 1; back <= 3 && back <= i; ++back) {
      const std::string_view word = tokens_[i - back].text;
      if (negates(word)) return tokens_[i].kind == TokenKind::Han ? back <= 2 : true;
      const bool passes = isOneOf(word, {"-", "truly", "strictly", "in", "呈", "為", "为", "具", "是", "a", "all"});
      if (!passes && qualifierOf(word).empty()) return false;
    }
    return false;
  }

  [[nodiscard]] std::string qualifierBefore(std::size_t i) const {
    if (i == 0) return {};
    std::string qualifier(qualifierOf(tokens_[i - 1].text));
    // "rarely in whorls", "usually very broadly ovate": one word further.
    if (qualifier.empty() && i > 1 && isAny(i - 1, {"-", "very", "為", "为", "呈"})) qualifier = qualifierOf(tokens_[i - 2].text);
    const bool linked = (last_.qualifier == "rarely" || last_.qualifier == "sometimes") && last_.end + 1 == i && isAny(i - 1, {"or", "或"});
    return qualifier.empty() && linked ? last_.qualifier : qualifier;
  }

  // "ovate-lanceolate", 卵狀披針形: the second half of one form.
  [[nodiscard]] bool continuesCompound(std::size_t i, const Category& category) const {
    if (!last_.kept || last_.category != &category || category.property != "shape") return false;
    if (tokens_[i].kind == TokenKind::Han) return last_.end == i && isAny(i - 1, {"狀", "状", "圓"});
    return last_.end + 1 == i && is(i - 1, "-");
  }

  // "opposite the window", but not "whorls of 4".
  [[nodiscard]] bool goesElsewhere(std::size_t end) const {
    if (end >= tokens_.size() || !leadsElsewhere(tokens_[end].text)) return false;
    return !(is(end, "of") && countAt(tokens_, end + 1));
  }

  void readTerm(std::size_t i) {
    const Found& f = found_[i];
    const Concept* partOfTerm = partAfter(f.end);
    const Concept* part = partOfTerm != nullptr ? partOfTerm : scope_.part;
    const Meaning* meaning = meaningFor(f, part);
    if (meaning == nullptr) return;
    const Concept* attributive = organAfter(f.end);
    const bool inSentence = scope_.organInSentence || attributive != nullptr;
    const bool atItsPart = part != nullptr && part->name == meaning->category->part;
    if (meaning->everyday && meaning->category->part == "base" && !atItsPart) return;  // "sepals unequal"
    if (meaning->everyday && (!inSentence || goesElsewhere(f.end))) return;

    LastTerm now{f.end, meaning->category, qualifierBefore(i), isNegated(i), false};
    const Concept* organ = attributive != nullptr ? attributive : scope_.organ;
    const bool ofForm = isOneOf(meaning->category->property, {"arrangement", "shape", "type"});
    if (ofForm && organ != nullptr && isBody(*organ) && meaning->everyday) return;
    if (!meaning->everyday) evidence_ += 2;
    if (meaning->everyday && f.as("organ") == nullptr && (attributive != nullptr || isRightBehindOrgan(i))) ++evidence_;
    if (!now.negated) {
      now.kept = true;
      if (continuesCompound(i, *meaning->category)) {
        extendCompound(f, meaning->entry->name);
      } else {
        const bool takesPart = part != nullptr && isOneOf(part->name, {"apex", "base"}) && meaning->category->property == "shape";
        const bool ofPart = takesPart && (partOfTerm != nullptr || !scope_.commaSincePart);
        const bool takesDefault = organ == nullptr || meaning->category->ownOrgan || (ofForm && isBody(*organ));
        addTerm(f, takesDefault ? meaning->category->defaultOrgan : organ->name, ofPart ? part->name : meaning->category->property,
                meaning->entry->name, now.qualifier);
      }
    }
    last_ = now;
    // 羽狀複葉,長20公分: the phrase has named the leaf itself.
    const auto isLeafWord = [](const std::string& word) { return isOneOf(word, {"葉", "叶"}); };
    const bool namesLeaf = isLeafWord(f.phrase->words.front()) || isLeafWord(f.phrase->words.back());
    if (namesLeaf && f.as("organ") == nullptr) enterLeaf(f.end);
  }

  void enterLeaf(std::size_t end) {
    for (const Concept& organ : categoryOf("organ").concepts)
      if (organ.name == "leaf") scope_ = {&organ, nullptr, end, true, true, true, false};
  }

  void addTerm(const Found& f, const std::string& organ, const std::string& property, const std::string& value, const std::string& qualifier) {
    Trait trait;
    trait.organ = organ;
    trait.property = property;
    trait.value = value;
    trait.qualifier = qualifier;
    quote(trait, f.first, f.end);
    traits_.push_back(std::move(trait));
  }

  void extendCompound(const Found& f, const std::string& value) {
    Trait& trait = traits_.back();
    trait.value += "-" + value;
    trait.span.end = tokens_[f.end - 1].end;
    trait.end = tokens_[f.end - 1].stop;
    trait.text = std::string(text_.substr(trait.span.begin - firstByte_, trait.span.end - trait.span.begin));
  }

  void quote(Trait& trait, std::size_t first, std::size_t end) const {
    trait.span = {tokens_[first].begin, tokens_[end - 1].end};
    trait.start = tokens_[first].start;
    trait.end = tokens_[end - 1].stop;
    trait.text = std::string(text_.substr(trait.span.begin - firstByte_, trait.span.end - trait.span.begin));
  }

  // ---- numbers

  [[nodiscard]] bool isAltitude(std::size_t i) const {
    for (std::size_t back = 1; back <= 6 && back <= i; ++back) {
      if (isAny(i - back, {"elevation", "elevations", "altitude", "altitudes", "alt", "elev", "拔", "depth"})) return true;
      if (isAny(i - back, {";", "。"})) return false;
    }
    return false;
  }

  std::size_t readSizes(std::size_t i) {
    if (tokens_[i].kind != TokenKind::Number && !isAny(i, {"(", "["})) return 0;
    const std::vector<Size> sizes = sizesAt(tokens_, found_, i);
    if (sizes.empty()) return 0;
    const std::size_t end = sizes.front().end;
    const bool ofPart = scope_.part != nullptr && !scope_.commaSincePart;
    const bool aboveSea = isAltitude(i) || isAny(end, {"a", "above", "asl"});
    if (!scope_.organInSentence || ofPart || aboveSea) return end;
    for (const Size& size : sizes) {
      const std::string property = size.dimension.empty() ? scope_.organ->columns.at("size") : size.dimension;
      // A bare size belongs to a whole plant only right behind its name: "Shrub 2-3 m".
      const bool isFar = i > scope_.organEnd + 4;
      if (size.dimension.empty() && property == "height" && isFar) continue;
      evidence_ += (size.dimension.empty() ? 0 : 1) + (isRightBehindOrgan(size.first) ? 1 : 0);
      addSize(size, property);
    }
    return end;
  }

  void addSize(const Size& size, const std::string& property) {
    Trait trait;
    trait.organ = scope_.organ->name;
    trait.property = property;
    const bool onlyUpTo = size.qualifier == "up to" && size.range.low == size.range.high;
    if (!onlyUpTo) trait.low = size.range.low;
    trait.high = size.range.high;
    trait.minimum = size.range.minimum;
    trait.maximum = size.range.maximum;
    trait.unit = size.unit;
    trait.qualifier = size.qualifier;
    quote(trait, size.first, size.end);
    traits_.push_back(std::move(trait));
  }

  void addCount(std::size_t first, std::size_t end, const std::string& organ, const NumberRange& range, const std::string& unit) {
    Trait trait;
    trait.organ = organ;
    trait.property = unit == "merous" ? "merosity" : "count";
    trait.low = range.low;
    trait.high = range.high;
    trait.minimum = range.minimum;
    trait.maximum = range.maximum;
    trait.unit = unit == "merous" ? "" : unit;
    quote(trait, first, end);
    traits_.push_back(std::move(trait));
  }

  // The token after "per node", "at each node", "in each whorl".
  [[nodiscard]] std::size_t afterPerNode(std::size_t i) const {
    const bool per = is(i, "per");
    const bool each = isAny(i, {"at", "in", "to"}) && isAny(i + 1, {"each", "a", "every"});
    const std::size_t noun = per ? i + 1 : each ? i + 2 : i;
    if (!per && !each) return 0;
    return isAny(noun, {"node", "whorl", "fascicle", "bundle", "cluster"}) ? noun + 1 : 0;
  }

  [[nodiscard]] bool isGathered(std::size_t i) const {
    if (i >= tokens_.size()) return false;
    const Concept* arrangement = found_[i].conceptAs("arrangement");
    return arrangement != nullptr && isOneOf(arrangement->name, {"whorled", "fascicled"});
  }

  // How many leaves one node carries: "whorls of 4", "4-whorled", "4 leaves per node", 4葉輪生, 每節4枚.
  std::size_t readLeavesPerNode(std::size_t i, const NumberRange& range) {
    const bool ofWhorls = i >= 2 && is(i - 1, "of") && isGathered(i - 2);
    const bool ofInWhorls = !ofWhorls && i >= 3 && is(i - 1, "of") && found_[i - 3] && found_[i - 3].end == i - 1 && isGathered(i - 3);
    const bool perNodeHan = i >= 2 && is(i - 2, "每") && isAny(i - 1, {"節", "节", "輪", "轮", "束"});
    std::size_t at = range.end;
    while (isAny(at, {"枚", "片", "張", "张", "-"}) || (at < tokens_.size() && organAt(at, "organ") != nullptr && organAt(at, "organ")->name == "leaf"))
      at = std::max(at + 1, found_[at].end);
    const std::size_t perNode = afterPerNode(at);
    if (ofWhorls || ofInWhorls || perNodeHan) {
      addCount(ofInWhorls ? i - 3 : i - 2, range.end, "leaf", range, "per node");
      return range.end;
    }
    if (perNode != 0 && leafIsMeant(range.end, at)) {
      addCount(i, perNode, "leaf", range, "per node");
      return perNode;
    }
    if (isGathered(at) && leafIsMeant(range.end, at)) {
      addCount(i, found_[at].end, "leaf", range, "per node");
      return at;  // the arrangement itself is read next
    }
    return 0;
  }

  [[nodiscard]] bool leafIsMeant(std::size_t from, std::size_t to) const {
    for (std::size_t k = from; k < to; ++k)
      if (organAt(k, "organ") != nullptr) return true;
    return scope_.organ != nullptr && scope_.organ->name == "leaf" && scope_.organInSentence;
  }

  std::size_t readCount(std::size_t i) {
    const std::optional<NumberRange> range = countAt(tokens_, i);
    if (!range || range->high > 999 || range->low != std::floor(range->low) || range->high != std::floor(range->high)) return 0;
    if (const std::size_t end = readLeavesPerNode(i, *range)) return end;
    if (is(range->end, "-") && is(range->end + 1, "merous")) return addMerosity(i, range->end + 2, *range);
    if (isAny(range->end, {"merous"}) || (isAny(range->end, {"數", "数"}) && scope_.organInSentence)) return addMerosity(i, range->end + 1, *range);
    if (const std::size_t end = readCountOfOrganBefore(i, *range)) return end;
    return readCountOfOrganAfter(i, *range);
  }

  std::size_t addMerosity(std::size_t i, std::size_t end, const NumberRange& range) {
    addCount(i, end, "flower", range, "merous");
    return end;
  }

  // A measure word, and whether it makes pairs.
  struct Measure {
    std::size_t end = 0;
    std::string unit;
  };
  [[nodiscard]] Measure measureAt(std::size_t i) const {
    if (isAny(i, {"pairs", "pair", "對", "对", "雙", "双"})) return {is(i + 1, "of") ? i + 2 : i + 1, "pairs"};
    if (isAny(i, {"枚", "片", "個", "个", "朵", "條", "条", "根", "瓣", "粒", "顆", "颗"})) return {i + 1, ""};
    return {i, ""};
  }

  [[nodiscard]] static bool isCountable(const Concept& organ) { return organ.columns.at("countable") == "yes"; }

  // "petals 5", "leaflets 5-8 pairs", 小葉8-12對. A number that goes on as "5-lobed" or as a size counts nothing.
  std::size_t readCountOfOrganBefore(std::size_t i, const NumberRange& range) {
    if (scope_.organ == nullptr || !isCountable(*scope_.organ) || !scope_.organInSentence) return 0;
    std::size_t before = i;
    while (before > scope_.organEnd && isAny(before - 1, {":", "有", "為", "为", "約", "约", "ca", ".", "usually", "通", "常", "mostly", "多"})) --before;
    if (before != scope_.organEnd || isWordWithNumber(range.end)) return 0;
    if (!sizesAt(tokens_, found_, i).empty()) return 0;
    const Measure measure = measureAt(range.end);
    addCount(i, measure.end, scope_.organ->name, range, measure.unit);
    return measure.end;
  }

  [[nodiscard]] bool isWordWithNumber(std::size_t i) const {
    return (is(i, "-") && i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::Word) || isAny(i, {"*", "/", "%", "°", "裂", "出", "脈", "脉", "times"});
  }

  // "5 petals", "10 pairs of leaflets", 5枚花瓣.
  std::size_t readCountOfOrganAfter(std::size_t i, const NumberRange& range) {
    Measure measure = measureAt(range.end);
    std::size_t at = measure.end;
    if (isAny(at, {"的"})) ++at;
    const Concept* organ = organAt(at, "organ");
    if (organ == nullptr || !isCountable(*organ)) return 0;
    const bool oneOfMany = isAny(i, {"one", "一"});
    if (oneOfMany) return 0;
    addCount(i, found_[at].end, organ->name, range, measure.unit);
    return at;  // the organ itself is read next
  }

  std::string_view text_;
  std::uint32_t firstByte_;
  const std::vector<Token>& tokens_;
  std::vector<Found> found_;
  Traits& traits_;
  Scope scope_;
  LastTerm last_;
  int evidence_ = 0;
  std::vector<const Concept*> organsSeen_;
};

// ---- blocks

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

struct Block {
  std::size_t end = 0;
  bool endsParagraph = false;
};

// Up to the next empty line, but not much more than blockBytes: a longer paragraph is cut at a blank, an endless line between
// two characters.
Block blockFrom(std::string_view text, std::size_t begin) {
  // Nothing beyond this window is looked at, or an endless line would be read again for every block.
  const std::string_view window = text.substr(begin, blockBytes);
  for (std::size_t at = window.find('\n'); at != std::string_view::npos; at = window.find('\n', at + 1)) {
    const std::size_t next = window.find_first_not_of(" \t\r", at + 1);
    if (next != std::string_view::npos && window[next] == '\n') return {begin + next + 1, true};
  }
  if (begin + window.size() == text.size()) return {text.size(), true};
  const std::size_t blank = window.find_last_of(" \n");
  if (blank != std::string_view::npos && blank > window.size() / 2) return {begin + blank + 1, false};
  std::size_t length = window.size();
  while (length > 1 && isContinuation(text[begin + length])) --length;
  return {begin + length, false};
}

}  // namespace

Result<DecodedText> decodeDescription(std::string_view bytes) {
  if (bytes.size() > descriptionLimitBytes)
    return fail(ErrorCode::LimitReached, "the description has " + std::to_string(bytes.size() / 1'000'000) + " MB; the limit is 100 MB, so cut it into parts");
  std::optional<DecodedText> text = decodeText(bytes);
  if (!text) return fail(ErrorCode::BadInput, "the description is no text; it must be UTF-8, UTF-16 with a byte-order mark, or Big5");
  if (text->utf8.find_first_not_of(" \t\r\n\f\v") == std::string::npos)
    return fail(ErrorCode::BadInput, "the description is empty; write what the plant looks like, for example \"Leaves opposite, ovate, 3-8 cm long.\"");
  return std::move(*text);
}

Result<Traits> readTraits(std::string_view text) {
  if (text.size() > descriptionLimitBytes || text.find_first_not_of(" \t\r\n\f\v") == std::string_view::npos || text.find('\0') != std::string_view::npos) {
    const Result<DecodedText> decoded = decodeDescription(text);
    if (!decoded) return decoded.failure();
  }
  if (!isUtf8(text)) return fail(ErrorCode::BadInput, "the description is not UTF-8; convert it with decodeDescription first");
  Traits traits;
  const Concept* organ = nullptr;
  std::size_t character = 0;
  TokenList list;
  for (std::size_t begin = 0; begin < text.size();) {
    const Block block = blockFrom(text, begin);
    const std::string_view piece = text.substr(begin, block.end - begin);
    tokenize(piece, static_cast<std::uint32_t>(begin), character, list);
    organ = BlockReader(piece, static_cast<std::uint32_t>(begin), list, organ, traits).read();
    if (block.endsParagraph) organ = nullptr;
    character += countCharacters(piece);
    begin = block.end;
  }
  return traits;
}

}  // namespace axil::keywords
