// Whether a paragraph is about a plant, and what stands in the places of statements without being understood.
//
// A text earns its reading. Each organ and each term of the vocabulary counts once: those that only botany uses more, everyday
// ones ("leaves", "opposite", "round") little, and only beside each other. Things of other fields count against it. And most
// words of a description are words of the vocabulary, while prose about other things only happens to use a few.
#include "keywords/paragraph.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

constexpr double enoughEvidence = 2;
constexpr double enoughBesidesForeign = 4;
constexpr double strongOrgan = 1.5;
constexpr double weakOrgan = 0.5;
constexpr double strongTerm = 1;
constexpr double linkedTerm = 1;
constexpr double foreignThing = 5;
constexpr double pronoun = 1;
constexpr double leastShare = 0.66;     // of the words that are known, in a description
constexpr double leastEverydayShare = 0.85;  // in one that has no word that only botany uses
constexpr double leastClauseShare = 0.7;     // between the first statement and the last, where the rest of the sentence is prose
constexpr double enoughInClauses = 4;
constexpr double proseShare = 0.4;      // in one that is told in whole sentences, and has much evidence
constexpr double muchEvidence = 6;
constexpr double bodyShare = 0.75;      // where only stems or branches are named, as rivers and pipes have them too
constexpr double someStrange = 0.24;      // of the clauses are about what the vocabulary does not have
constexpr double enoughAmongSome = 7;
constexpr double mostlyStrange = 0.45;
constexpr double enoughAmongMost = 12;
constexpr double fragmentShare = 0.99;  // nothing but vocabulary

// Everyday words that nearly always mean parts of a plant where botany is spoken beside them. Others of the vocabulary are parts of
// animals, books and machines as often (ovary, spine, blade, crown).
bool isPlainlyOfPlants(std::string_view word) {
  return isOneOf(word, {"leaf", "leaves", "foliage", "flower", "flowers", "fruit", "fruits", "seed", "seeds", "葉", "叶", "花", "果", "種", "种"});
}
bool isBody(const Concept& organ) { return isOneOf(organ.name, {"stem", "branch", "trunk", "root", "bark", "thorn"}); }

// People speak of their plants: "my plant has opposite leaves".
bool isPronoun(std::string_view word) {
  return isOneOf(word, {"i", "my", "we", "our", "us", "me", "you", "your", "he", "she", "his", "her", "him", "they", "them", "我", "你", "您", "他", "她"});
}

// 這棵, 該種: which plant is meant.
bool pointsAt(std::string_view word) { return isOneOf(word, {"這", "这", "該", "该", "此", "其", "它", "棵", "株", "款", "these", "those"}); }

bool isLatin(const Token& token) { return token.kind == TokenKind::Word; }

// Adjectives of botany end so; a lone word between commas that does is taken for a term that the vocabulary lacks.
bool looksLikeATerm(std::string_view word) {
  if (word.size() < 5) return false;
  for (const std::string_view end : {"ate", "ous", "ose", "ar", "al", "oid", "form", "ic", "ed", "ent", "ant", "ile", "ish", "ine", "ulate", "less", "y"})
    if (word.ends_with(end)) return true;
  return false;
}

bool looksLikeAHanTerm(std::string_view last) {
  return isOneOf(last, {"形", "狀", "状", "質", "质", "生", "緣", "缘", "毛", "裂", "齒", "齿", "尖", "色", "曲", "折", "柄", "毛"});
}

}  // namespace

void ParagraphReader::weighNoun(std::size_t i, const Concept& organ) {
  const bool everyday = found_[i].as("organ")->everyday;
  strongSeen_ = strongSeen_ || !everyday;
  organSeen_ = organSeen_ || !everyday || isPlainlyOfPlants(tokens_[i].text);
  bodySeen_ = bodySeen_ || isBody(organ);
  // 植物, "shrub", "tree": but not the tree in 樹枝.
  plantNamed_ = plantNamed_ || (organ.name == "plant" && !(everyday && isHan(i) && found_[i].end == i + 1));
  // Words for whole plants do not count: power plants and family trees abound.
  if (!organsWeighed_.insert(&organ).second || (everyday && organ.name == "plant")) return;
  evidence_ += everyday ? weakOrgan : strongOrgan;
}

void ParagraphReader::weighTerm(std::size_t i, const Meaning& meaning, bool linked) {
  const bool isNew = termsWeighed_.insert(meaning.entry).second;
  if (!isNew) return;
  strongSeen_ = strongSeen_ || !meaning.everyday;
  if (!meaning.everyday) {
    evidence_ += strongTerm;
    ++strongTerms_;
  }
  if (linked && found_[i].as("organ") == nullptr) evidence_ += linkedTerm;
  if (!meaning.everyday && meaning.category->property == "life form") organSeen_ = true;
}

// "Found along rivers and lakes", 生於海岸: where a plant grows says nothing against it.
bool ParagraphReader::isHabitat(std::size_t i) const {
  for (std::size_t back = 1; back <= 14 && back <= i; ++back) {
    if (isSentenceEnd(i - back)) return false;
    if (isAny(i - back, {"grow", "grows", "growing", "found", "occurs", "occurring", "occur", "native", "common", "endemic", "distributed", "widespread", "habitat", "habitats", "naturalized", "naturalised", "frequent",
                         "near", "along", "生", "產", "产", "佈", "布", "見", "见", "於", "于", "长", "長"}))
      return true;
  }
  return false;
}

// "Used to treat stomach pain", 民間用來治療胃病: nor does what it is good for.
bool ParagraphReader::isUse(std::size_t i) const {
  const auto saysUse = [&](std::size_t k) { return isAny(k, {"used", "use", "uses", "medicinal", "medicinally", "medicine", "remedy", "treat", "treats", "treating", "cure", "cures", "tea", "藥", "药", "治", "療", "疗", "煎", "服"}); };
  for (std::size_t back = 0; back <= 14 && back <= i && !isSentenceEnd(i - back); ++back)
    if (saysUse(i - back)) return true;
  for (std::size_t ahead = i + 1; ahead < tokens_.size() && ahead < i + 8 && !isSentenceEnd(ahead); ++ahead)
    if (saysUse(ahead)) return true;
  return false;
}

void ParagraphReader::weighForeign(const Found& f) {
  const std::string& field = f.conceptAs("foreign")->name;
  if ((field == "nature" && isHabitat(f.first)) || (field == "medicine" && isUse(f.first))) return;
  if (isPronoun(f.phrase->words.front())) {
    pronounSeen_ = true;
    return;
  }
  std::string words;
  for (const std::string& word : f.phrase->words) words += word + " ";
  if (foreignSeen_.insert(words).second) evidence_ -= foreignThing;
}

bool ParagraphReader::isKnown(std::size_t i) const {
  const Token& token = tokens_[i];
  if (token.kind == TokenKind::Number || token.kind == TokenKind::Sign) return true;
  if (isFiller(token.text) || countedBy(i).end != 0 || isAny(i, {"merous", "absent", "present", "minute", "row", "rows", "series", "ranks", "equal", "unequal", "free", "distinct", "thin", "thick", "ones", "minutely", "above", "below", "growth", "habit", "long", "diverging", "divergence", "diverge", "angle", "angles", "palmately", "pinnately", "digitately", "node", "nodes", "small", "large", "medium", "tall", "slender", "夾", "夹", "角"}) || !qualifierOf(token.text).empty() || negates(token.text) || numberAt(tokens_, i)) return true;
  return false;
}

// Terms of the vocabulary, joined by little words, and no sentence: "opposite", "simple, entire or serrate".
bool ParagraphReader::isNothingButTerms() const {
  constexpr std::size_t most = 10;
  if (tokens_.size() > most) return false;
  for (std::size_t i = 0; i < tokens_.size();) {
    const bool joins = tokens_[i].kind == TokenKind::Sign || isAny(i, {"or", "and", "to", "或", "至", "和"}) || !qualifierOf(tokens_[i].text).empty();
    if (!joins && !hasTraitMeaning(i)) return false;
    i = found_[i] ? found_[i].end : i + 1;
  }
  return !tokens_.empty();
}

// The sentences that say something; where a plant grows or what it is good for may be told beside them at any length.
std::vector<ParagraphReader::Stretch> ParagraphReader::tellingSentences() const {
  std::vector<std::uint32_t> places;
  for (const Trait& trait : result_.traits) places.push_back(trait.span.begin);
  for (const Denial& denial : result_.denials) places.push_back(denial.trait.span.begin);
  std::sort(places.begin(), places.end());
  std::vector<Stretch> sentences;
  std::size_t first = 0;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (i + 1 < tokens_.size() && !isSentenceEnd(i)) continue;
    const auto place = std::lower_bound(places.begin(), places.end(), tokens_[first].begin);
    if (place != places.end() && *place < tokens_[i].end) sentences.push_back({first, i + 1});
    first = i + 1;
  }
  return sentences;
}

// From the clause of the first statement to that of the last.
ParagraphReader::Stretch ParagraphReader::tellingClauses() const {
  std::uint32_t begin = result_.traits.front().span.begin;
  std::uint32_t end = 0;
  for (const Trait& trait : result_.traits) {
    begin = std::min(begin, trait.span.begin);
    end = std::max(end, trait.span.end);
  }
  Stretch stretch{0, tokens_.size()};
  for (std::size_t i = 0; i < tokens_.size() && tokens_[i].begin < begin; ++i)
    if (tokens_[i].kind == TokenKind::Sign) stretch.first = i + 1;
  for (std::size_t i = tokens_.size(); i > 0 && tokens_[i - 1].begin >= end; --i)
    if (tokens_[i - 1].kind == TokenKind::Sign) stretch.end = i;
  return stretch;
}

double ParagraphReader::knownShare() const { return knownShare({{0, tokens_.size()}}); }

// The words that stand in what was read: "80-90 degrees" too.
std::vector<bool> ParagraphReader::tokensOfTraits() const {
  std::vector<bool> inside(tokens_.size(), false);
  for (const Trait& trait : result_.traits) {
    const auto first = std::lower_bound(tokens_.begin(), tokens_.end(), trait.span.begin, [](const Token& token, std::uint32_t begin) { return token.begin < begin; });
    for (auto token = first; token != tokens_.end() && token->begin < trait.span.end; ++token) inside[static_cast<std::size_t>(token - tokens_.begin())] = true;
  }
  return inside;
}

// How many of the words there the reader knows: vocabulary, numbers, little words.
double ParagraphReader::knownShare(const std::vector<Stretch>& stretches) const {
  const std::vector<bool> inTraits = tokensOfTraits();
  double known = 0;
  double all = 0;
  for (const Stretch& stretch : stretches) {
    for (std::size_t i = stretch.first; i < stretch.end;) {
      if (tokens_[i].kind == TokenKind::Sign || tokens_[i].kind == TokenKind::Number) {
        ++i;
        continue;
      }
      // "leaves opposite, glabriuscule, ...": a word alone between commas is a term that the vocabulary lacks.
      const bool lone = isLatin(tokens_[i]) && !found_[i] && i > 0 && tokens_[i - 1].kind == TokenKind::Sign && i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::Sign;
      if (lone && looksLikeATerm(tokens_[i].text)) {
        ++i;
        continue;
      }
      const Concept* stop = found_[i].conceptAs("stop");
      const bool phrase = found_[i] && found_[i].conceptAs("foreign") == nullptr && (stop == nullptr || stop->name == "place");
      const std::size_t end = found_[i] ? found_[i].end : i + 1;
      all += static_cast<double>(end - i);
      if (phrase || (!found_[i] && (inTraits[i] || isKnown(i)))) known += static_cast<double>(end - i);
      i = end;
    }
  }
  return all == 0 ? 0 : known / all;
}

// Verbs and articles of sentences that tell something; descriptions do without.
bool ParagraphReader::isTold(const std::vector<Stretch>& stretches) const {
  for (const Stretch& stretch : stretches)
    for (std::size_t i = stretch.first; i < stretch.end; ++i)
      if (isAny(i, {"has", "have", "was", "were", "is", "each", "be"})) return true;
  return false;
}

// Whether a clause is about something that the vocabulary does not have: "the design shows a lily", 盾面銀色.
bool ParagraphReader::beginsStrangely(std::size_t first, std::size_t end) const {
  std::size_t at = first;
  while (at < end && (tokens_[at].kind == TokenKind::Sign || tokens_[at].kind == TokenKind::Number || (!found_[at] && (isKnown(at) || pointsAt(tokens_[at].text))))) ++at;
  if (at == end) return false;
  const bool other = !found_[at] || found_[at].conceptAs("foreign") != nullptr;
  const std::string_view word = tokens_[at].text;
  const bool lone = at + 1 == end;  // "leaves opposite, glabriuscule": a term that is not known
  if (!isHan(at)) return other && !lone && word.size() > 2 && !looksLikeATerm(word) && !word.ends_with("ing") && !word.ends_with("er") && !isOneOf(word, {"growth", "dense", "loose", "stout"});
  const bool alone = at + 1 == end || tokens_[at + 1].kind != TokenKind::Han;
  return other && !alone && !found_[at + 1];
}

// How many of the clauses there are so; none where it is a single one in the middle.
double ParagraphReader::strangeShare(const std::vector<Stretch>& stretches) const {
  double strange = 0;
  double all = 0;
  bool atFirst = false;
  for (const Stretch& stretch : stretches) {
    std::size_t first = stretch.first;
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      if (i + 1 < stretch.end && !isAny(i, {",", ";", ":", "、", "。", "."})) continue;
      if (i > first) {
        const bool begins = beginsStrangely(first, i);
        atFirst = atFirst || (begins && all == 0);
        strange += begins ? 1 : 0;
        all += 1;
      }
      first = i + 1;
    }
  }
  return strange == 0 || (strange == 1 && !atFirst) ? 0 : strange / all;
}

// Whether the clauses speak of other things than plants, and too little is said that only botany says.
bool ParagraphReader::isAboutStrangeThings(const std::vector<Stretch>& stretches) const {
  const double strange = strangeShare(stretches);
  return (strange >= someStrange && evidence_ < enoughAmongSome && !plantNamed_) || (strange >= mostlyStrange && evidence_ < enoughAmongMost);
}

bool ParagraphReader::isAboutAPlant() const {
  if (result_.traits.empty() && result_.denials.empty()) return false;
  const std::vector<Stretch> telling = tellingSentences();
  const double share = knownShare(telling);
  if (bareTerms_) return true;
  if (isAboutStrangeThings(telling)) return false;
  // "Leaves opposite", 對生: everyday words too, where there are no others.
  if (foreignSeen_.empty() && share >= fragmentShare && (organSeen_ || bodySeen_ || evidence_ >= strongTerm) && (strongSeen_ || organSeen_ || !isTold(telling))) return true;
  if (evidence_ < (foreignSeen_.empty() ? enoughEvidence : enoughBesidesForeign) + (pronounSeen_ ? pronoun : 0)) return false;
  if (!strongSeen_ && (isTold(telling) || share < leastEverydayShare)) return false;
  // "blade suborbiculate to ovate-cordate": no organ that only plants have, but words that only botany has.
  const bool manyTerms = strongTerms_ >= 3 && foreignSeen_.empty() && share >= bodyShare;
  if (!organSeen_ && !manyTerms) return bodySeen_ && foreignSeen_.empty() && share >= bodyShare;
  if (share >= leastShare || (share >= proseShare && evidence_ >= muchEvidence)) return true;
  if (!foreignSeen_.empty() || result_.traits.empty()) return false;
  const double clauseShare = knownShare({tellingClauses()});
  return (strongTerms_ >= 1 && evidence_ >= enoughInClauses && clauseShare >= leastClauseShare) || (strongSeen_ && !pronounSeen_ && evidence_ >= enoughEvidence && clauseShare >= fragmentShare);
}

// ---- words that were seen but not understood

void ParagraphReader::noteUnknownSegment(std::size_t first, std::size_t end) {
  std::size_t begin = first;
  while (begin < end && tokens_[begin].kind != TokenKind::Number && (found_[begin] || isKnown(begin))) begin = found_[begin] ? std::max(found_[begin].end, begin + 1) : begin + 1;
  std::size_t stop = begin;
  while (stop < end && !found_[stop] && (isHan(stop) || !isKnown(stop))) ++stop;
  // Only a segment that ends with the unknown words is a statement in a list: ", farinulent," but not ", used by healers in".
  if (begin >= stop || stop != end || stop - begin > 6) return;
  const bool latin = isLatin(tokens_[begin]);
  if (latin && (stop - begin > 2 || !looksLikeATerm(tokens_[stop - 1].text))) return;
  if (!latin && !looksLikeAHanTerm(tokens_[stop - 1].text)) return;
  UnknownTerm term;
  const auto next = std::upper_bound(organFrom_.begin(), organFrom_.end(), begin, [](std::size_t at, const auto& named) { return at < named.first; });
  if (next != organFrom_.begin()) term.organ = std::prev(next)->second;
  if (term.organ.empty()) return;
  Trait place = traitAt(begin, stop, term.organ, {});
  term.text = place.text;
  term.span = place.span;
  term.start = place.start;
  term.end = place.end;
  result_.unknown.push_back(std::move(term));
}

void ParagraphReader::findUnknown() {
  std::size_t first = 0;
  for (std::size_t i = 0; i <= tokens_.size(); ++i) {
    const bool ends = i == tokens_.size() || isAny(i, {",", ";", ".", "、", "。", "；", ":"});
    if (!ends) continue;
    if (i > first) noteUnknownSegment(first, i);
    first = i + 1;
  }
}

}  // namespace axil::keywords
