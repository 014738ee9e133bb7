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
constexpr double leastShare = 0.6;      // of the words that are known, in a description
constexpr double proseShare = 0.4;      // in one that is told in whole sentences, and has much evidence
constexpr double muchEvidence = 6;
constexpr double bodyShare = 0.75;      // where only stems or branches are named, as rivers and pipes have them too
constexpr double fragmentShare = 0.99;  // nothing but vocabulary

// Everyday words that nearly always mean parts of a plant where botany is spoken beside them. Others of the vocabulary are parts of
// animals, books and machines as often (ovary, spine, blade, crown).
bool isPlainlyOfPlants(std::string_view word) {
  return isOneOf(word, {"leaf", "leaves", "foliage", "flower", "flowers", "fruit", "fruits", "seed", "seeds", "葉", "叶", "花", "果", "種", "种"});
}
bool isBody(const Concept& organ) { return isOneOf(organ.name, {"stem", "branch", "trunk", "root", "bark", "thorn"}); }

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

void ParagraphReader::weighForeign(const Found& f) {
  std::string words;
  for (const std::string& word : f.phrase->words) words += word + " ";
  if (foreignSeen_.insert(words).second) evidence_ -= foreignThing;
}

bool ParagraphReader::isKnown(std::size_t i) const {
  const Token& token = tokens_[i];
  if (token.kind == TokenKind::Number || token.kind == TokenKind::Sign) return true;
  if (isFiller(token.text) || countedBy(i).end != 0 || isAny(i, {"merous", "above", "below", "long", "palmately", "pinnately", "digitately", "node", "nodes", "small", "large", "medium", "tall", "slender", "夾", "夹", "角"}) || !qualifierOf(token.text).empty() || negates(token.text) || numberAt(tokens_, i)) return true;
  return false;
}

// How many of its words the reader knows: vocabulary, numbers, little words.
double ParagraphReader::knownShare() const {
  double known = 0;
  double all = 0;
  for (std::size_t i = 0; i < tokens_.size();) {
    if (tokens_[i].kind == TokenKind::Sign || tokens_[i].kind == TokenKind::Number) {
      ++i;
      continue;
    }
    const Concept* stop = found_[i].conceptAs("stop");
    const bool phrase = found_[i] && found_[i].conceptAs("foreign") == nullptr && (stop == nullptr || stop->name == "place");
    const std::size_t end = found_[i] ? found_[i].end : i + 1;
    all += static_cast<double>(end - i);
    if (phrase || (!found_[i] && isKnown(i))) known += static_cast<double>(end - i);
    i = end;
  }
  return all == 0 ? 0 : known / all;
}

// Verbs and articles of sentences that tell something; descriptions do without.
bool ParagraphReader::isTold() const {
  for (std::size_t i = 0; i < tokens_.size(); ++i)
    if (isAny(i, {"has", "have", "was", "were", "is", "each", "be"})) return true;
  return false;
}

bool ParagraphReader::isAboutAPlant() const {
  if (result_.traits.empty() && result_.denials.empty()) return false;
  const double share = knownShare();
  // "Leaves opposite", 對生: everyday words too, where there are no others.
  if (foreignSeen_.empty() && share >= fragmentShare && (organSeen_ || bodySeen_ || evidence_ >= strongTerm) && (strongSeen_ || !isTold())) return true;
  if (evidence_ < (foreignSeen_.empty() ? enoughEvidence : enoughBesidesForeign)) return false;
  if (!strongSeen_ && isTold()) return false;
  // "blade suborbiculate to ovate-cordate": no organ that only plants have, but words that only botany has.
  const bool manyTerms = strongTerms_ >= 3 && foreignSeen_.empty() && share >= bodyShare;
  if (!organSeen_ && !manyTerms) return bodySeen_ && foreignSeen_.empty() && share >= bodyShare;
  return share >= leastShare || (share >= proseShare && evidence_ >= muchEvidence);
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
