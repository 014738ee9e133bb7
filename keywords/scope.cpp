// What is being spoken of: organs, their pieces and places, from noun to noun.
#include "keywords/paragraph.hpp"

#include "base/table.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

// Statements about form do not fit a whole plant or what carries leaves; an adjective that follows them may be about what they bear.
bool bears(const Concept& organ) { return isOneOf(organ.name, {"plant", "stem", "root", "bark", "branch", "trunk"}); }

const std::string& roleOf(const Concept& noun) { return noun.columns.at("role"); }

// The words of kinds, by their characters: 基生, 雄.
struct HanKind {
  std::vector<std::string> words;
  const Concept* which = nullptr;
};

const std::vector<HanKind>& hanKinds() {
  static const std::vector<HanKind> kinds = [] {
    std::vector<HanKind> all;
    for (const Concept& which : categoryOf("which").concepts)
      for (const std::vector<Term>* terms : {&which.traditional, &which.simplified})
        for (const Term& term : *terms) all.push_back({wordsOf(term.words), &which});
    return all;
  }();
  return kinds;
}

std::vector<std::string> ownersOf(const Concept& piece) { return splitList(piece.columns.at("partOf"), ' '); }

}  // namespace

bool ParagraphReader::isVerbLeaves(std::size_t i) const {
  if (!is(i, "leaves")) return false;
  // "Leaves at flowering time 3-6 cm": at the begin of a sentence or clause they are leaves.
  const bool opens = startsSentence(i) || isAny(i - 1, {";", ":", ",", "(", ")"}) || (found_[i - 1] && isAny(i - 1, {"basal", "lower", "upper", "cauline", "stem", "young", "mature"}));
  if (opens && isAny(i + 1, {"at", "to", "after", "early", "no", "for", "behind"})) return false;
  const bool object = isAny(i + 1, {"the", "a", "an", "his", "her", "him", "them", "it", "us", "me", "their", "its", "my", "your", "our", "no", "for", "behind", "home", "little", "much",
                                    "every", "at", "to", "after", "early", "tomorrow", "town"});
  const bool subject = i > 0 && isAny(i - 1, {"he", "she", "it", "who", "which", "that", "this", "never", "always", "one", "train", "bus"});
  return object || subject;
}

bool ParagraphReader::isFlowerSpokenOf() const {
  return std::any_of(namedAt_.begin(), namedAt_.end(), [](const auto& named) {
    return isOneOf(named.first->name, {"flower", "corolla", "petal", "calyx", "sepal", "inflorescence", "perianth", "wing petal"});
  });
}

// 分枝橢圓形: branches, and not that something is branched, where the words open a clause that goes on about them.
bool ParagraphReader::isBranchNoun(std::size_t i) const {
  if (i > 0 && is(i - 1, "每")) return true;
  const bool opens = i == 0 || tokens_[i - 1].kind == TokenKind::Sign || startsALine(i);
  const std::size_t next = i + 2;
  const bool goesOn = next < tokens_.size() && tokens_[next].kind != TokenKind::Sign && !isAny(next, {"多", "少", "繁", "稀", "密", "疏", "甚", "極", "极", "較", "较", "性", "生", "於", "于", "或", "成"});
  return opens ? goesOn : next < tokens_.size() && tokens_[next].kind == TokenKind::Number;
}

// "A tufted perennial reaching 30 cm", "Annuals, 10-60 cm", but not "leaves evergreen".
bool ParagraphReader::isPlantNoun(std::size_t i) const {
  if (!isAny(i, {"annual", "annuals", "biennial", "biennials", "perennial", "perennials", "evergreen", "evergreens", "succulent"}) || !opensSentence(i)) return false;
  const std::size_t next = i + 1;
  if (next >= tokens_.size()) return true;
  return tokens_[next].kind == TokenKind::Number || isAny(next, {",", ";", ".", "to", "reaching", "with", "up", "growing", "about", "ca", "from", "forming", "(", "usually"});
}

// Words that name an organ and say something as well, where here they only say something.
bool ParagraphReader::isSwitchedOff(std::size_t i) const { return is(i, "分") && found_[i].end == i + 2 && !isBranchNoun(i); }

// "Standard orbicular, emarginate": at the begin of a sentence, with a shape behind it.
bool ParagraphReader::opensDescription(std::size_t i) const {
  if (!startsSentence(i) || namedAt_.empty() || i + 1 >= tokens_.size()) return false;
  const Meaning* shape = found_[i + 1].as("shape");
  return shape != nullptr;
}

// The organ, piece or place that the phrase at token i names, of that role where one is given.
const Concept* ParagraphReader::nounAt(std::size_t i, std::string_view role) const {
  if (i >= tokens_.size() || isVerbLeaves(i)) return nullptr;
  const Concept* noun = found_[i].conceptAs("organ");
  if (noun == nullptr || (!role.empty() && roleOf(*noun) != role) || isSwitchedOff(i)) return nullptr;
  const std::size_t end = found_[i].end;
  if (isHan(i) && isAny(end, {"狀", "状"}) && roleOf(*noun) == "organ") return nullptr;  // 花瓣狀
  const bool likeness = is(end, "like") || (is(end, "-") && isAny(end + 1, {"like", "shaped"}));  // "grass-like leaves"
  if (likeness || (isAny(i, {"standard", "keel", "lip", "column", "columns"}) && end == i + 1 && !isFlowerSpokenOf() && !opensDescription(i))) return nullptr;
  // 花 in 花費, 葉 in a name: one character of a longer word that the vocabulary does not know.
  const bool oneHan = isHan(i) && found_[i].end == i + 1;
  const bool aloneInWord = oneHan && tokens_[i].insideWord && !(i + 1 < tokens_.size() && found_[i + 1]) && !(i > 0 && (found_[i - 1] || isAny(i - 1, {"的", "本", "具"})));
  return aloneInWord ? nullptr : noun;
}

// A list of lines without full stops: "Leaves: opposite / Flowers: white".
bool ParagraphReader::startsALine(std::size_t i) const { return tokens_[i].lineBreakBefore && (isHan(i) || isCapital(i)); }

// "Leaves simple, opposite or whorled": one term after another, the first right behind the organ.
bool ParagraphReader::isChained(std::size_t i) const {
  std::size_t at = i;
  while (at > last_.end && (isAny(at - 1, {",", "、", "or", "and", "to", "-", "至", "或", "及", "和", "~"}) || !qualifierOf(tokens_[at - 1].text).empty())) --at;
  return last_.linked && at == last_.end;
}

bool ParagraphReader::isRightBehindOrgan(std::size_t i) const {
  std::size_t at = i;
  while (at > scope_.organEnd && (isAny(at - 1, {"are", "is", ":", "呈", "為", "为", "有", "具", "ca", ".", "up", "to", "約", "约", "長", "长", "高", "(", "可", "達", "达", "reaching", "均", "from", "between", "±", "about", "less", "than",
                                              "not", "exceeding", "over", "under", "僅", "仅", "只", "全", "皆", "都"}) || !qualifierOf(tokens_[at - 1].text).empty()))
    --at;
  return scope_.organ != nullptr && at == scope_.organEnd && i >= scope_.organEnd;
}

// The organ that a piece belongs to: one that the word itself names (萼筒), the organ in scope, the one named last, else the first
// that can have it.
const Concept* ParagraphReader::ownerOf(const Concept& piece, std::size_t i) const {
  const std::vector<std::string> owners = ownersOf(piece);
  for (std::size_t k = i; k < found_[i].end; ++k) {
    if (is(k, "萼") && !(k > 0 && is(k - 1, "副"))) return &organNamed("calyx");
    if (is(k, "冠")) return &organNamed("corolla");
    if (is(k, "被")) return &organNamed("perianth");
    if (isAny(k, {"柱", "style", "stylar"})) return &organNamed("style");
  }
  const auto canHave = [&](const Concept& organ) { return std::find(owners.begin(), owners.end(), organ.name) != owners.end(); };
  if (scope_.organ != nullptr && canHave(*scope_.organ)) return scope_.organ;
  const Concept* latest = nullptr;
  std::size_t latestAt = 0;
  for (const auto& [organ, at] : subjectAt_)
    if (canHave(*organ) && (latest == nullptr || at > latestAt)) {
      latest = organ;
      latestAt = at;
    }
  return latest != nullptr ? latest : &organNamed(owners.front());
}

// "basal leaves", 基生葉, "staminate flowers".
std::string ParagraphReader::whichBefore(std::size_t i) const {
  if (i > 0)
    for (std::size_t back = 1; back <= 2 && back <= i; ++back) {
      const Found& before = found_[i - back];
      if (before && before.end == i)
        if (const Concept* which = before.conceptAs("which")) return which->name;
    }
  // 雄蕊 is a stamen and not the male kind of one.
  const Concept* noun = found_[i].conceptAs("organ");
  if (!isHan(i) || found_[i].end < i + 2 || (noun != nullptr && isOneOf(noun->name, {"stamen", "pistil", "column"}))) return {};
  for (const auto& [words, which] : hanKinds()) {
    bool same = i + words.size() < found_[i].end;
    for (std::size_t k = 0; same && k < words.size(); ++k) same = is(i + k, words[k]);
    if (same) return which->name;
  }
  return {};
}

void ParagraphReader::noteSign(std::size_t i) {
  const bool sentence = isSentenceEnd(i);
  if (isAny(i, {"(", "[", ")", "]"})) return noteBracket(i);
  if (sentence) outside_.clear();
  if (sentence || isAny(i, {";", "；"})) scope_.stranger = false;
  if (sentence) {
    sentenceBegin_ = i + 1;
    plantInSentence_ = false;
    scope_.organInSentence = false;
    scope_.piece = nullptr;
    scope_.which.clear();
  }
  if (sentence || isAny(i, {";", "；"})) {
    scope_.subjectInClause = scope_.subjectInSegment = false;
    scope_.place = nullptr;
    scope_.partner = nullptr;
  }
  if (isAny(i, {",", "、"})) {
    scope_.subjectInSegment = false;
    scope_.commaSincePlace = true;
    if (scope_.whichInSegment) scope_.which.clear();
  }
  if (sentence || isAny(i, {";", "；", ","})) noteStranger(i);
}

// The lamina of a ray floret is a piece of it, and behind the leaflets of a sentence "blade" is theirs. Null: the leaf's.
const Concept* ParagraphReader::bladeOwner(std::size_t i) const {
  if (!isAny(i, {"lamina", "laminae", "blade", "blades"}) || scope_.organ == nullptr || !scope_.organInSentence) return nullptr;
  if (isOneOf(scope_.organ->name, {"ray floret", "petal", "lip", "standard", "tepal", "bract", "sepal", "bracteole"})) return scope_.organ;
  const Concept& leaflet = organNamed("leaflet");
  return bladeNamedLast() == &leaflet ? &leaflet : nullptr;
}

void ParagraphReader::noteNoun(std::size_t i) {
  const Concept* noun = nounAt(i);
  if (noun == nullptr) return;
  const std::string& role = roleOf(*noun);
  if (role == "region") return notePlace(i, *noun);
  if (role == "sub") return notePiece(i, *noun);
  if (role == "blade") {
    if (const Concept* owner = bladeOwner(i)) {
      scope_.organ = owner;
      scope_.piece = noun;
      scope_.place = nullptr;
      scope_.organEnd = found_[i].end;
      scope_.subjectInSegment = true;
      return;
    }
    const std::string which = whichBefore(i);
    noteOrgan(i, organNamed("leaf"));
    if (scope_.organEnd == found_[i].end) {
      scope_.piece = noun;
      scope_.which = which;
    }
    return;
  }
  if (noun->name == "stipe" && !isHan(i)) return noteOrgan(i, stipeOf(*noun));
  if (noun->name != "stalk") return noteOrgan(i, *noun);
  // 具短柄 says that there is one; at the begin of a clause its own statements follow, as in 具肉質柄，長約7公分.
  const bool measured = is(found_[i].end, ",") && isAny(found_[i].end + 1, {"長", "长"});
  if (isHan(i) && i > 0 && tokens_[i - 1].kind != TokenKind::Sign && !measured) return;
  noteOrgan(i, stalkOf(*noun));
}

// Whether that organ is named once more, in one of the next clauses.
bool ParagraphReader::isNamedAgain(std::size_t i, const Concept& organ) const {
  constexpr std::size_t near = 60;
  bool otherClause = false;
  for (std::size_t at = found_[i].end; at < tokens_.size() && at < i + near; ++at) {
    otherClause = otherClause || isAny(at, {";", "；", ".", "。"});
    if (otherClause && found_[at].conceptAs("organ") == &organ) return true;
  }
  return false;
}

void ParagraphReader::noteOrgan(std::size_t i, const Concept& organ) {
  weighNoun(i, organ);
  namedAt_[&organ] = i;
  const bool isTime = i > 0 && is(i - 1, "in") && isAny(i, {"fruit", "flower", "bud", "bloom", "leaf"}) && scope_.organInSentence;  // "elongating in fruit to 20 cm"
  if (isTime) return;
  const std::size_t of = i > 0 && isAny(i - 1, {"the", "its"}) ? i - 1 : i;
  if (scope_.place != nullptr && of > 0 && is(of - 1, "of") && scope_.organEnd == of - 1) {  // "margins of leaflets spinose"
    scope_.organ = &organ;
    scope_.piece = nullptr;
    scope_.organEnd = found_[i].end;
    return;
  }
  const bool ofOrgan = scope_.piece != nullptr && of > 0 && is(of - 1, "of") && scope_.organEnd == of - 1;  // "lobes of the corolla 5"
  if (const auto owners = ofOrgan ? ownersOf(*scope_.piece) : std::vector<std::string>{}; std::find(owners.begin(), owners.end(), organ.name) != owners.end()) {
    scope_.organ = &organ;
    scope_.organEnd = found_[i].end;
    return;
  }
  if (readSpinesOfMargin(i, organ)) return;
  const bool thoseOf = of > 1 && is(of - 1, "of") && isAny(of - 2, {"those", "that"}) && of > 2 && (tokens_[of - 3].kind == TokenKind::Sign || isAny(of - 3, {"and", "but", "while", "whereas"}));
  if (thoseOf && scope_.place != nullptr) {  // "margins of the leaflets serrate, those of the stipules entire"
    const Concept* place = scope_.place;
    scope_ = {&organ, nullptr, nullptr, place, whichBefore(i), found_[i].end, true, true, true, false, nullptr, nullptr, nullptr};
    return;
  }
  if (isPlaceOnly(i) || isOfPlaceBefore(i)) {
    placeOnlyEnd_ = found_[i].end;
    return;
  }
  subjectAt_[&organ] = i;
  // "Panicles terminal, branches racemose": the panicle's own.
  const bool ofInflorescence = is(i, "branches") && scope_.organ != nullptr && scope_.organ->name == "inflorescence" && scope_.organInSentence && i > 0 && is(i - 1, ",") && hasTraitMeaning(found_[i].end);
  if (ofInflorescence) return;
  const bool isMeasuredAgainst = isAny(found_[i].end, {"呈", "成", "夾", "夹", "間", "间", "之", "的", "等", "對", "对", "同"});
  const std::size_t joint = !isHan(i) && i > 1 && (found_[i - 1].conceptAs("which") != nullptr || looksAdjectival(i - 1)) ? i - 1 : i;  // "sepals and lateral petals"
  const bool together = !isMeasuredAgainst && joint > 0 && isAny(joint - 1, {"and", "及", "和", "與", "与"}) && scope_.organEnd == joint - 1 && scope_.organ != nullptr && scope_.organ != &organ;
  const Concept* partner = together ? scope_.organ : nullptr;
  // A plant or a twig bears what follows ("a shrub with opposite, ovate leaves"); it is not what the adjectives are about.
  const bool isSubject = !bears(organ) || isRightBehindOrgan(i);
  plantInSentence_ = plantInSentence_ || organ.name == "plant";
  const bool counted = i > 0 && (tokens_[i - 1].kind == TokenKind::Number || isAny(i - 1, {"朵", "個", "个", "含", "具", "有"}));
  const bool inInflorescence = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"inflorescence", "spikelet"}) && scope_.subjectInClause;
  const bool ofFlowers = organ.name == "flower" && inInflorescence && counted;
  const bool ofLeaf = organ.name == "leaflet" && counted && scope_.organ != nullptr && scope_.organ->name == "leaf" && scope_.subjectInSegment && isNamedAgain(i, organ);
  const bool madeOf = organ.name == "inflorescence" && i > 0 && isAny(i - 1, {"成", "為", "为", "呈"}) && scope_.organ != nullptr && scope_.organ->name == "flower" && scope_.subjectInClause;
  std::size_t in = i;  // "flowers 20 in a tight head, 5 mm across"
  while (in > 0 && in + 4 > i && tokens_[in - 1].kind == TokenKind::Word && !is(in - 1, "in")) --in;
  const bool gathered = organ.name == "inflorescence" && in > 0 && is(in - 1, "in") && scope_.organ != nullptr && scope_.organ->name == "flower" && scope_.subjectInClause;
  const Concept* member = madeOf || gathered ? scope_.organ : nullptr;
  const Concept* container = ofFlowers || ofLeaf ? scope_.organ : nullptr;
  const bool armed = organ.name == "thorn" && scope_.organ != nullptr && scope_.organ->name == "fruit";
  const bool minor = armed || isOneOf(organ.name, {"gland", "hair", "seta", "lenticel"});
  const Concept* host = minor && scope_.organInSentence && scope_.organ != nullptr && i > 0 && tokens_[i - 1].kind != TokenKind::Sign ? scope_.organ : nullptr;
  scope_ = {&organ, partner, nullptr, nullptr, whichBefore(i), found_[i].end, true, isSubject, true, false, container, member, host};
  organFrom_.emplace_back(i, organ.name);
}

void ParagraphReader::notePiece(std::size_t i, const Concept& piece) {
  // "wings", "teeth", "scale" are no pieces of a plant before any of its organs was named.
  const bool isWeak = found_[i].as("organ")->everyday && namedAt_.empty() && scope_.organ == nullptr && !startsSentence(i);
  if (isOfPlaceBefore(i)) placeOnlyEnd_ = found_[i].end;
  const bool bareTube = is(i, "管") && found_[i].end == i + 1 && !(i > 0 && tokens_[i - 1].kind == TokenKind::Sign);  // 導管
  if (isWeak || isPlaceOnly(i) || placeOnlyEnd_ == found_[i].end || bareTube) return;
  const Concept* owner = ownerOf(piece, i);
  if (readTeeth(i, *owner)) return;
  readFewLobes(i, *owner);
  if (!found_[i].as("organ")->everyday) weighNoun(i, *owner);
  scope_.organ = owner;
  scope_.piece = &piece;
  scope_.place = scope_.partner = nullptr;
  scope_.organEnd = found_[i].end;
  // 蒴果具三翅，長2公分: behind the comma the fruit is measured.
  const bool counted = i > 0 && (tokens_[i - 1].kind == TokenKind::Number || numberAt(tokens_, i - 1).has_value());
  const bool withNumber = !isHan(i) && counted && ((i > 1 && is(i - 2, "with")) || (i > 3 && is(i - 3, "-") && is(i - 5, "with")) || (i > 3 && is(i - 4, "with")));
  const bool given = counted && (isHan(i) || withNumber);
  scope_.container = given ? owner : nullptr;
  scope_.stranger = false;
  scope_.organInSentence = scope_.subjectInClause = scope_.subjectInSegment = true;
  scope_.commaSincePlace = false;
  organFrom_.emplace_back(i, owner->name);
}

void ParagraphReader::notePlace(std::size_t i, const Concept& place) {
  // 草本，基部分枝: where the plant branches.
  const bool ofPlant = scope_.organ != nullptr && isOneOf(scope_.organ->name, {"plant", "stem"});
  const std::size_t branches = found_[i].end + (isAny(found_[i].end, {"多", "少", "密", "常"}) ? 1 : 0);  // 基部多分枝
  if (ofPlant && is(branches, "分") && is(branches + 1, "枝")) return;
  if (ofPlant && i > 0 && (is(i - 1, "from") || (i > 1 && is(i - 1, "the") && is(i - 2, "from")))) return;  // "annual, branched from the base, 5-40 cm"
  // "cordate at base" has taken its place along; "at base cordate" opens one.
  if (isPlaceOfTermBefore(i)) {
    scope_.commaSincePlace = true;
    return;
  }
  if (isOfPlaceBefore(i)) return;
  if (scope_.host != nullptr) {
    scope_.organ = scope_.host;
    scope_.host = scope_.piece = nullptr;
  }
  if (!found_[i].as("organ")->everyday) {  // 葉緣 names the leaf too
    evidence_ += 1;
    organSeen_ = organSeen_ || isHan(i);
  }
  if (scope_.organ == nullptr || (isOneOf(scope_.organ->name, {"plant", "petiole", "vein", "stipule"}) && !(place.name == "surface" && scope_.organEnd == i) && !(scope_.organ->name == "stipule" && scope_.subjectInClause))) {
    scope_.organ = scope_.organ != nullptr && scope_.organ->name == "vein" ? bladeNamedLast() : &organNamed("leaf");
    scope_.piece = nullptr;
    scope_.which.clear();
  }
  const bool namesLeaf = isHan(i) && isAny(i, {"葉", "叶"});
  if (namesLeaf && scope_.organ->name != "leaflet") scope_.organ = &organNamed("leaf");
  // "lobes with blunt teeth, base cordate", "lobes acuminate, margins dentate": behind a comma the blade again.
  const bool ofBladeAgain = scope_.piece != nullptr && (scope_.piece->name == "tooth" || (scope_.piece->name == "lobe" && place.name == "margin" && isAny(i, {"margins", "margin"}) && scope_.organ != nullptr && scope_.organ->name == "leaf"));
  if (ofBladeAgain && i > 0 && tokens_[i - 1].kind == TokenKind::Sign) scope_.piece = nullptr;
  scope_.stranger = false;
  scope_.organInSentence = scope_.subjectInSegment = true;
  scope_.place = &place;
  scope_.organEnd = found_[i].end;
  scope_.commaSincePlace = false;
}

// 下部互生，上部對生: without an organ behind it the word holds until the next of its kind.
void ParagraphReader::noteWhich(std::size_t i) {
  const std::size_t end = found_[i].end;
  // "lower ones to 20 cm", 莖上部者互生.
  if (scope_.organInSentence && isAny(end, {"ones", "者"})) {
    scope_.which = found_[i].conceptAs("which")->name;
    scope_.place = nullptr;
    scope_.organEnd = end + 1;
    scope_.subjectInClause = scope_.subjectInSegment = true;
    return;
  }
  if (found_[i].as("position") != nullptr) return;  // 花序頂生
  const bool opensSegment = i == 0 || isAny(i - 1, {",", ";", "、", "；"}) || (scope_.organ != nullptr && scope_.organEnd == i);
  if (!opensSegment || !isHan(i) || nounAt(end) != nullptr || !scope_.organInSentence) return;
  scope_.which = found_[i].conceptAs("which")->name;
  scope_.whichInSegment = true;
}

void ParagraphReader::enterLeaf(std::size_t end) {
  const std::string which = scope_.organ != nullptr && scope_.organ->name == "leaf" ? scope_.which : "";
  scope_ = {&organNamed("leaf"), nullptr, nullptr, nullptr, which, end, true, true, true, false, nullptr, nullptr, nullptr};
  namedAt_[scope_.organ] = end;
}

}  // namespace axil::keywords
