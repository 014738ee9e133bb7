// Terms of the vocabulary: what each says, of what, how surely.
#include "keywords/paragraph.hpp"

#include "base/table.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

bool isGrammarWord(const Category& category) { return isOneOf(category.property, {"organ", "which", "unit", "dimension", "stop", "foreign"}); }

bool contains(const std::vector<std::string>& list, const std::string& name) { return std::find(list.begin(), list.end(), name) != list.end(); }

bool isBody(const Concept& organ) { return isOneOf(organ.name, {"plant", "stem", "trunk", "bark", "root"}); }

// A shape that a flat outline draws, or one of a body.
bool isOutline(const Category& category, const Concept& entry) { return category.property == "shape" && entry.columns.contains("shape"); }

}  // namespace

bool ParagraphReader::hasTraitMeaning(std::size_t i) const {
  return i < found_.size() && found_[i] && std::any_of(found_[i].phrase->meanings.begin(), found_[i].phrase->meanings.end(),
                                  [](const Meaning& m) { return !isGrammarWord(*m.category); });
}

// The place in "cordate at the base", "serrated margins".
const Concept* ParagraphReader::placeAfter(std::size_t end) const {
  if (const Concept* right = nounAt(end, "region"); right != nullptr && !isHan(end)) return right;
  if (!isAny(end, {"at", "toward", "towards", "near", "above", "on"})) return nullptr;
  std::size_t at = end + 1;
  while (isAny(at, {"the", "its", "both"})) ++at;
  return nounAt(at, "region");
}

// The organ in "opposite, broadly ovate leaves", "對生的葉", seen from behind an adjective; or the piece in "5 triangular lobes".
ParagraphReader::Ahead ParagraphReader::nounAhead(std::size_t end) const {
  bool comma = false;
  bool afterComma = false;  // with no term since: 卵形，側裂片
  bool linked = false;  // 的
  std::size_t at = end;
  for (int steps = 0; steps < 10 && at < tokens_.size(); ++steps) {
    if (isPlantNoun(at)) return {&organNamed("plant"), nullptr};
    // "adnate to petiole", "sessile and leaves": what a connecting word leads to must be another adjective.
    if (at > end && isAny(at - 1, {"to", "and", "or", "至", "或", "和"}) && nounAt(at) != nullptr) return {};
    if (const Concept* organ = nounAt(at); organ != nullptr && organ->columns.at("role") != "region") {
      const bool ofPlace = isHan(at) && !linked && isAny(found_[at].end, {"端", "頂", "顶", "先", "上", "梢", "腋"});  // 叢生小枝先端
      if (startsALine(at) || afterComma || ofPlace) return {};
      const bool isPiece = organ->columns.at("role") == "sub";
      const Concept* named = organ->columns.at("role") == "blade" ? &organNamed("leaf") : isPiece ? ownerOf(*organ, at) : organ;
      const bool holds = isHan(at) ? linked || !scope_.subjectInSegment : !comma || !scope_.subjectInClause;
      return holds ? Ahead{named, isPiece ? organ : nullptr} : Ahead{};
    }
    if (isAny(at, {"的", "之"})) {
      linked = true;
      ++at;
    } else if (isAny(at, {",", "、"})) {
      comma = afterComma = true;
      ++at;
    } else if (isAny(at, {"and", "or", "to", "-", "至", "或", "和"}) || !qualifierOf(tokens_[at].text).empty()) {
      ++at;
    } else if (hasTraitMeaning(at) || (found_[at] && found_[at].conceptAs("which") != nullptr)) {
      afterComma = afterComma && !hasTraitMeaning(at);
      at = found_[at].end;
    } else if (tokens_[at].kind == TokenKind::Word && !found_[at] && nounAt(at + 1) != nullptr && nounAt(at + 1)->name == "plant") {  // "aquatic or marsh herb"
      ++at;
    } else {
      return {};
    }
  }
  return {};
}

const Concept* ParagraphReader::organAfter(std::size_t end) const {
  const Ahead ahead = nounAhead(end);
  return ahead.piece == nullptr ? ahead.organ : nullptr;
}

bool ParagraphReader::accepts(const Category& category, const Concept* organ) const {
  const std::string& name = organ != nullptr ? organ->name : category.defaultOrgan;
  if (category.ownOrgan) return true;
  return (category.organs.empty() || contains(category.organs, name)) && !contains(category.notOrgans, name);
}

// Of a phrase's meanings the one that fits: "cordate" of a base, "rounded" of an apex, "erect" of a stem or of a pedicel.
const Meaning* ParagraphReader::meaningFor(const Found& f, const Concept* organ, const Concept* place) const {
  const bool ofBranching = organ != nullptr && organ->name == "plant" && is(f.first, "simple") && isAny(f.end, {"or", "to"});  // "annual, simple or branched"
  for (const Meaning& m : f.phrase->meanings)
    if (ofBranching && m.category->property == "branching") return &m;
  const Meaning* whole = nullptr;
  const Meaning* loose = nullptr;  // of a place that is not named: "leaves ovate, acute, entire"
  const Meaning* other = nullptr;
  const Meaning* own = nullptr;  // "stems succulent" is of the stem, "plants succulent" a life form
  const bool ofOrgan = organ != nullptr && organ->name != "plant";
  const bool ofInflorescence = organ != nullptr && organ->name == "inflorescence";
  for (const Meaning& m : f.phrase->meanings)
    if (ofInflorescence && isHan(f.first) && m.category->property == "type" && m.category->defaultOrgan == "inflorescence") return &m;  // 花序圓錐狀: no cone
  for (const Meaning& m : f.phrase->meanings) {
    if (isGrammarWord(*m.category)) continue;
    if (place != nullptr && m.category->part == place->name) return &m;
    const bool amongMargins = m.category->property == "margin" && last_.kept && last_.category == m.category && f.first < last_.end + 4;  // 全緣，稍反捲
    if (amongMargins && place == nullptr && (isHan(f.first) || f.as("orientation") == nullptr)) return &m;
    const bool fits = accepts(*m.category, organ);
    if (fits && ofOrgan && m.category->ownOrgan && own == nullptr) own = &m;
    else if (fits && m.category->part.empty() && whole == nullptr) whole = &m;
    const bool ofStalk = organ != nullptr && organ->name == "petiole" && m.category->part == "base";  // 葉柄短，圓形: the leaf is
    if (fits && !ofStalk && !m.category->part.empty() && loose == nullptr) loose = &m;
    if (!fits && other == nullptr) other = &m;
  }
  if (whole != nullptr) return whole;
  if (own != nullptr && (loose == nullptr || !(scope_.subjectInClause || isRightBehindOrgan(f.first)))) return own;
  return loose != nullptr ? loose : other;
}

bool ParagraphReader::isNegated(std::size_t i) const {
  const bool linkedToNegated = last_.negated && i > 0 && last_.end == i - 1 && isAny(i - 1, {"or", "nor", "或"});
  if (linkedToNegated) return true;
  for (std::size_t back = 1; back <= 4 && back <= i; ++back) {
    const std::string_view word = tokens_[i - back].text;
    if (negates(word)) return isHan(i) ? back <= 2 : true;
    const bool passes = isOneOf(word, {"-", "truly", "strictly", "in", "呈", "為", "为", "具", "是", "被", "a", "all", "有"});
    if (!passes && qualifierOf(word).empty()) return false;
  }
  return false;
}

std::string ParagraphReader::qualifierBefore(std::size_t i) const {
  if (i == 0) return {};
  std::string qualifier(qualifierOf(tokens_[i - 1].text));
  // "rarely in whorls", "usually very broadly ovate": a word further.
  for (std::size_t back = 2; qualifier.empty() && back <= 3 && back <= i; ++back)
    if (isAny(i - back + 1, {"-", "very", "為", "为", "呈", "in", "具", "有", "被"})) qualifier = qualifierOf(tokens_[i - back].text);
  const bool linked = (last_.qualifier == "rarely" || last_.qualifier == "sometimes") && last_.end + 1 == i && isAny(i - 1, {"or", "或"});
  return qualifier.empty() && linked ? last_.qualifier : qualifier;
}

// "ovate-lanceolate", 卵狀披針形, "purplish black": the second half of one form or colour.
bool ParagraphReader::continuesCompound(std::size_t i, const Category& category) const {
  if (!last_.kept || last_.category != &category || result_.traits.empty()) return false;
  if (category.property == "colour") return last_.end == i || (last_.end + 1 == i && is(i - 1, "-"));
  if (!isOneOf(category.property, {"shape", "margin"})) return false;
  const bool broadly = last_.end + 1 == i && i > 1 && isAny(i - 2, {"狀", "状"}) && isAny(i - 1, {"寬", "宽", "狹", "狭", "闊", "阔", "長", "长"});  // 匙狀寬卵形
  // 圓齒狀鋸齒 is one kind of tooth, 刺狀細齒 says two things.
  if (isHan(i) && category.property == "margin") return last_.end == i && isAny(i - 1, {"狀", "状"}) && !isOneOf(result_.traits.back().value, {"spinose", "ciliate"});
  if (isHan(i)) return category.property == "shape" && (broadly || (last_.end == i && isHan(i - 1) && !is(i - 1, "形")));
  if (category.property == "margin" && last_.end == i && tokens_[i - 1].text.ends_with("ly")) return true;  // "sinuately toothed"
  return last_.end + 1 == i && is(i - 1, "-");
}

// "opposite the window", but not "whorls of 4", "spikes 5 cm long".
bool ParagraphReader::goesElsewhere(std::size_t i, std::size_t end) const {
  if (end >= tokens_.size() || nounAt(i) != nullptr || !leadsElsewhere(tokens_[end].text)) return false;
  return !(is(end, "of") && rangeAt(tokens_, end + 1));
}

// "tendrils simple, opposite leaves": where the leaves only say the place.
bool ParagraphReader::isOppositeOfLeaves(std::size_t i) const {
  const bool besides = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"tendril", "inflorescence", "peduncle", "stipule", "bud"}) && scope_.subjectInClause;
  const Concept* next = nounAt(found_[i].end);
  const bool ofFlowerParts = next != nullptr && isOneOf(next->name, {"sepal", "petal", "tepal", "calyx", "corolla"});  // "stamens 5, (opposite sepals)"
  return is(i, "opposite") && ((besides && next != nullptr && next->name == "leaf") || ofFlowerParts);
}

void ParagraphReader::quote(Trait& trait, std::size_t first, std::size_t end) const {
  trait.span = {tokens_[first].begin, tokens_[end - 1].end};
  trait.start = tokens_[first].start;
  trait.end = tokens_[end - 1].stop;
  trait.text = std::string(text_.substr(trait.span.begin - firstByte_, trait.span.end - trait.span.begin));
}

Trait ParagraphReader::traitAt(std::size_t first, std::size_t end, const std::string& organ, const std::string& property) const {
  Trait trait;
  trait.organ = organ;
  trait.property = property;
  quote(trait, first, end);
  return trait;
}

// What is said of two organs together is said of each.
void ParagraphReader::keep(Trait trait, bool attributive) {
  const bool ofBoth = !attributive && scope_.partner != nullptr && scope_.organ != nullptr && trait.organ == scope_.organ->name;
  if (ofBoth) {
    Trait other = trait;
    other.organ = scope_.partner->name;
    result_.traits.push_back(std::move(other));
  }
  result_.traits.push_back(std::move(trait));
}

void ParagraphReader::extendCompound(const Found& f, const std::string& value) {
  Trait& trait = result_.traits.back();
  if (trait.value != value) trait.value += "-" + value;  // "pentagonal-angulate" says one thing twice
  trait.span.end = tokens_[f.end - 1].end;
  trait.end = tokens_[f.end - 1].stop;
  trait.text = std::string(text_.substr(trait.span.begin - firstByte_, trait.span.end - trait.span.begin));
}

void ParagraphReader::keepTerm(std::size_t i, const Meaning& meaning, const Subject& subject, const LastTerm& now) {
  const Found& f = found_[i];
  const auto& [organ, piece, attributive, place, placeNamed] = subject;
  const Category& category = *meaning.category;
  const bool ofForm = isOneOf(category.property, {"arrangement", "shape", "type", "margin", "apex", "base"});
  const bool fitsBody = organ != nullptr && category.property == "shape" && (organ->name == "root" || (organ->name == "plant" && !isOutline(category, *meaning.entry)));
  const bool perennial = category.property == "duration" && isOneOf(meaning.entry->name, {"annual", "biennial", "perennial"});
  // 節片倒卵形: a flat shape said of a stem itself stays with it.
  const bool ofStemItself = organ != nullptr && category.property == "shape" && !attributive && now.linked && contains(category.notOrgans, organ->name);
  const bool takesDefault = organ == nullptr || category.ownOrgan || perennial || (!ofStemItself && (!accepts(category, organ) || (ofForm && isBody(*organ) && !fitsBody)));
  // Leaves stand opposite, where no sentence names what does.
  const bool ofNoneNamed = organ != nullptr && category.property == "arrangement" && !scope_.organInSentence && !attributive && isOneOf(organ->name, {"branch", "rhizome", "stem", "root", "tuber", "bulb", "bark", "trunk"});
  // Stems in a tuft are the habit of a plant, leaves in a tuft an arrangement.
  const bool tuft = organ != nullptr && isOneOf(organ->name, {"stem", "plant"}) && category.property == "arrangement" && meaning.entry->name == "fascicled" && (now.linked || attributive);
  const bool placeHolds = place != nullptr && isOneOf(place->name, {"apex", "base"}) && category.property == "shape" && (placeNamed || !scope_.commaSincePlace) &&
                          !isOneOf(meaning.entry->name, {"pinnately lobed", "pinnatisect", "bipinnatifid", "palmately lobed"});
  Trait trait = traitAt(f.first, f.end, takesDefault || ofNoneNamed ? category.defaultOrgan : organ->name, placeHolds ? place->name : category.property);
  trait.value = meaning.entry->name;
  if (tuft) {
    trait.organ = organ->name;
    trait.property = "habit";
    trait.value = "tufted";
  }
  trait.qualifier = now.qualifier;
  if (!takesDefault && piece != nullptr) trait.part = piece->name;
  if (!takesDefault && !attributive) trait.which = scope_.which;
  if (trait.part.empty() && place != nullptr && place->name == "surface" && !scope_.commaSincePlace) trait.part = "surface";
  if (now.negated) {
    result_.denials.push_back({std::move(trait)});
    return;
  }
  if (category.property == "form" && takesDefault) trait.organ = "flower";
  // 葉柄短，橢圓形，長5公分: the blade is what is measured, too.
  const bool backToBlade = takesDefault && !attributive && organ != nullptr && isOneOf(organ->name, {"petiole", "vein"}) && (isOutline(category, *meaning.entry) || category.property == "margin");
  const bool inDigits = category.property == "type" && trait.value == "trifoliolate" && tokens_[f.first].kind == TokenKind::Number && tokens_[f.end - 1].kind == TokenKind::Word;
  keep(std::move(trait), attributive);
  if (backToBlade) enterLeaf(f.end);
  if (inDigits) addCount(f.first, f.end, "leaflet", "", {{}, 3, 3, {}, f.end, false}, {});  // "3-foliolate" is a number too
}

// A phrase that also names an organ is read as a term where it is that organ here (複葉, racemes), or only a term (分枝).
bool ParagraphReader::speaksAsTerm(std::size_t i) const {
  if (is(i, "分") && found_[i].end == i + 2) return isSwitchedOff(i);
  return nounAt(i) != nullptr;
}

// "Biennial, erect, 60-120 cm tall": a description that begins with what only whole plants are.
void ParagraphReader::startWithPlant(std::size_t i) {
  const Meaning* duration = found_[i].as("duration");
  const bool ofYears = duration != nullptr && isOneOf(duration->entry->name, {"annual", "biennial", "perennial", "evergreen", "deciduous"});
  const bool habit = found_[i].as("habit") != nullptr && isAny(found_[i].end, {"by", "over", "up"});  // "Climbing by tendrils"
  const bool lifeForm = found_[i].as("life form") != nullptr && found_[i].as("organ") == nullptr;  // "Aquatic, free-floating"
  const bool begins = startsSentence(i) && (habit || ((ofYears || lifeForm) && isAny(found_[i].end, {",", ";", ".", "，"})));
  if (scope_.organInSentence || (!begins && !isPlantNoun(i))) return;
  enterPlant(i);
}

void ParagraphReader::enterPlant(std::size_t end) {
  plantInSentence_ = plantSeen_ = true;
  scope_ = {&organNamed("plant"), nullptr, nullptr, nullptr, {}, end, true, false, true, false, nullptr, nullptr, nullptr};
}

// 羽狀淺裂至深裂: the second half is of the same kind as the first.
std::optional<Meaning> ParagraphReader::deeperCut(std::size_t i, const Meaning& meaning) const {
  const bool cut = meaning.category->property == "margin" && meaning.entry->name == "lobed" && isHan(i);
  if (!cut || !last_.kept || last_.category == nullptr || last_.category->property != "shape" || last_.end + 1 != i || !isAny(i - 1, {"至", "或", "到", "、"})) return std::nullopt;
  const std::string& before = result_.traits.back().value;
  if (!isOneOf(before, {"pinnately lobed", "pinnatisect", "palmately lobed"})) return std::nullopt;
  const std::string_view value = before == "palmately lobed" ? "palmately lobed" : isAny(i, {"深", "全"}) ? "pinnatisect" : "pinnately lobed";
  for (const Concept& entry : last_.category->concepts)
    if (entry.name == value) return Meaning{last_.category, &entry, false};
  return std::nullopt;
}

void ParagraphReader::readTerm(std::size_t i) {
  const Found& f = found_[i];
  if (!hasTraitMeaning(i) || isOppositeOfLeaves(i) || readTernate(i)) return;
  startWithPlant(i);
  if (f.as("organ") != nullptr && !speaksAsTerm(i)) return;
  if (scope_.host != nullptr && !scope_.subjectInSegment && (f.as("margin") || f.as("arrangement"))) {  // 近基部具2腺體，全緣: the blade again
    scope_.organ = scope_.host;
    scope_.host = scope_.piece = nullptr;
  }
  const Ahead ahead = nounAhead(f.end);
  const Concept* attributive = ahead.organ;
  const bool namesLeaf = isOneOf(f.phrase->words.front(), {"葉", "叶"}) && f.as("organ") == nullptr;  // 葉基生
  const Concept* organ = attributive != nullptr ? attributive : namesLeaf ? &organNamed("leaf") : scope_.organ;
  const Concept* named = placeAfter(f.end);
  const Concept* place = named != nullptr ? named : (attributive != nullptr ? nullptr : scope_.place);
  const Meaning* meaning = meaningFor(f, organ, place);
  if (meaning == nullptr || saysNothingOf(*meaning, i, organ, place)) return;
  if (attributive == nullptr && (scope_.stranger || (!meaning->category->ownOrgan && isAboutTheUnnamed(i)))) return;
  if (isOfAnotherOrgan(*meaning->category, organ, attributive != nullptr || named != nullptr)) return;
  const std::optional<Meaning> deeper = deeperCut(i, *meaning);
  if (deeper) meaning = &*deeper;
  const std::optional<Meaning> finer = finerTeeth(i, *meaning);
  if (finer) meaning = &*finer;
  // 螺旋狀排列的稜: said of what it stands before or of nothing.
  if (attributive != nullptr && !meaning->category->ownOrgan && (!accepts(*meaning->category, attributive) || (ahead.piece != nullptr && (meaning->category->property == "arrangement" || (meaning->category->property == "margin" && ahead.piece->name == "rib"))))) return;
  const bool atItsPlace = place != nullptr && place->name == meaning->category->part;
  const bool ofBase = meaning->category->part == "base" || (meaning->category->part == "apex" && isOneOf(meaning->entry->name, {"rounded", "truncate", "bilobed"}));
  if (meaning->everyday && ofBase && !atItsPlace) return;  // "sepals unequal"
  const bool inSentence = bareTerms_ || scope_.organInSentence || attributive != nullptr || named != nullptr;
  if (meaning->everyday && (!inSentence || goesElsewhere(i, f.end)) && !(meaning->category->ownOrgan && f.as("organ") != nullptr)) return;
  // A place with statements of its own keeps what follows a comma only where the meaning is of that place.
  if (place != nullptr && named == nullptr && scope_.commaSincePlace && !atItsPlace) place = nullptr;
  const bool ofForm = isOneOf(meaning->category->property, {"arrangement", "shape", "type", "margin"});
  const bool bodyShape = organ != nullptr && organ->name == "plant" && meaning->category->property == "shape" && !isOutline(*meaning->category, *meaning->entry);
  if (ofForm && organ != nullptr && isBody(*organ) && meaning->everyday && !bodyShape && f.as("organ") == nullptr && meaning->category->property != "type") return;
  if (meaning->category->property == "type" && meaning->category->defaultOrgan == "leaf" && meaning->everyday && !bareTerms_ && (organ == nullptr || organ->name != "leaf")) return;
  if (bareTerms_ && meaning->everyday && organ == nullptr && !isOneOf(meaning->category->property, {"arrangement", "type", "shape", "margin", "habit", "life form", "duration"})) return;  // "red": what is?
  // "terminal leaflet", 葉叢生枝端: the word says which leaflet, or where the leaves are.
  const bool saysWhere = meaning->category->property == "position" && organ != nullptr;
  if (!accepts(*meaning->category, organ) && (meaning->everyday || saysWhere)) return;

  LastTerm now{f.end, meaning->category, qualifierBefore(i), isNegated(i), false, false};
  now.linked = attributive != nullptr || named != nullptr || isRightBehindOrgan(i) || isChained(i);
  weighTerm(i, *meaning, now.linked);
  now.kept = !now.negated;
  // 齒尖內彎，有時呈波狀; "8-12 spiny teeth": the margin's.
  const Concept* teeth = attributive != nullptr ? ahead.piece : scope_.piece;
  const bool ofTooth = teeth != nullptr && teeth->name == "tooth" && meaning->category->property == "margin";
  const bool ofWhole = attributive == nullptr && scope_.piece != nullptr && scope_.container == scope_.organ && !scope_.subjectInSegment && !isHan(i) && meaning->category->property == "margin";  // "with 3-4 lobes per side, doubly serrate"
  const Subject subject{organ, ofTooth ? nullptr : attributive != nullptr ? ahead.piece : ofWhole ? nullptr : scope_.piece, attributive != nullptr, place, named != nullptr};
  if (now.kept && meaning->category->property == "venation") countVeins(i);
  readElidedPinnate(i, now);
  readElidedCut(i, now);
  readElidedDouble(i, now);
  if (now.kept && continuesCompound(i, *meaning->category)) extendCompound(f, meaning->entry->name);
  else keepTerm(i, *meaning, subject, now);
  last_ = now;
  if (isPlantNoun(i) && scope_.organEnd == i) scope_.organEnd = f.end;
  // "Woody climber reaching 15 m": the phrase has named the plant itself.
  const bool namesPlant = meaning->category->property == "life form" && f.as("organ") == nullptr && attributive == nullptr && !now.negated && (scope_.organ == nullptr || !scope_.organInSentence || scope_.organ->name == "plant");
  if (namesPlant) enterPlant(f.end);
  plantSeen_ = plantSeen_ || meaning->category->property == "life form";
  // 羽狀複葉,長20公分: the phrase has named the leaf itself.
  const auto isLeafWord = [](const std::string& word) { return isOneOf(word, {"葉", "叶"}); };
  const bool endsWithLeaf = isLeafWord(f.phrase->words.back()) && f.as("organ") == nullptr;
  if (namesLeaf || endsWithLeaf) enterLeaf(f.end);
}

}  // namespace axil::keywords
