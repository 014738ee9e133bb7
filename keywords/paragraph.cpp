#include "keywords/paragraph.hpp"

#include "base/result.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {
constexpr double sureShare = 0.9;  // of the words that are known, in what is a description throughout
}

const Concept& organNamed(std::string_view name) {
  const std::vector<Concept>& organs = categoryOf("organ").concepts;
  const auto found = std::find_if(organs.begin(), organs.end(), [&](const Concept& c) { return c.name == name; });
  AXIL_ASSERT(found != organs.end(), "the vocabulary lacks an organ that the reader speaks of");
  return *found;
}

ParagraphReader::ParagraphReader(std::string_view text, std::uint32_t firstByte, const TokenList& list, const Concept* organBefore)
    : text_(text), firstByte_(firstByte), tokens_(list.tokens), found_(findPhrases(list.tokens)) {
  scope_.organ = organBefore;
  bareTerms_ = organBefore == nullptr && isNothingButTerms();
}

bool ParagraphReader::isCapital(std::size_t i) const {
  const char first = text_[tokens_[i].begin - firstByte_];
  return first >= 'A' && first <= 'Z';
}

bool ParagraphReader::isSentenceEnd(std::size_t i) const {
  if (isAny(i, {"。", "!", "?", "．"})) return true;
  if (!is(i, ".")) return false;
  if (i + 1 == tokens_.size()) return true;
  if (i > 0 && isAny(i - 1, {"ca", "c", "diam", "var", "subsp", "ssp", "e", "g", "i", "cf", "approx", "fig", "d", "b"})) return false;
  return isHan(i + 1) || (tokens_[i + 1].spaceBefore && isCapital(i + 1));
}

bool ParagraphReader::startsSentence(std::size_t i) const { return i == 0 || isSentenceEnd(i - 1) || startsALine(i); }

bool ParagraphReader::opensSentence(std::size_t i) const {
  constexpr std::size_t most = 4;
  for (std::size_t back = 0; back <= most && back <= i; ++back) {
    if (startsSentence(i - back)) return true;
    const Token& before = tokens_[i - back - 1];
    const bool hyphen = before.text == "-";
    if (before.kind == TokenKind::Number || (before.kind == TokenKind::Sign && !hyphen) || found_[i - back - 1].conceptAs("organ") != nullptr) return false;
  }
  return false;
}

// Reads what begins at token i; the token after it.
std::size_t ParagraphReader::step(std::size_t i) {
  if (tokens_[i].kind == TokenKind::Sign) noteSign(i);
  if (const std::size_t end = afterExcept(i)) return end;
  if (const std::size_t end = afterComparison(i)) return end;
  const bool termFirst = found_[i] && hasTraitMeaning(i) && found_[i].end > i + 1;  // 三出複葉, "3-nerved"
  if (!termFirst) {
    if (const std::size_t end = readAngle(i)) return end;
    if (const std::size_t end = readSizes(i)) return end;
    if (const std::size_t end = readDivisions(i)) return end;
    if (const std::size_t end = readCount(i)) return end;
  }
  if (const std::size_t end = readInThrees(i)) return end;
  if (const std::size_t end = readNumerous(i)) return end;
  if (const std::size_t end = readAbsent(i)) return end;
  const Found& f = found_[i];
  if (!f) return i + 1;
  const bool ofNumber = i > 1 && is(i - 1, "-") && tokens_[i - 2].kind == TokenKind::Number;  // "16-29-jug"
  if (f.conceptAs("foreign") != nullptr && !ofNumber) weighForeign(f);
  if (f.conceptAs("stop") != nullptr) noteScar(i);
  if (f.conceptAs("which") != nullptr && f.as("organ") == nullptr) noteWhich(i);
  if (f.conceptAs("organ") != nullptr) noteNoun(i);
  const std::size_t traits = result_.traits.size() + result_.denials.size();
  readTerm(i);
  // 先端二裂 is of the apex, 花瓣二裂 a count of lobes.
  const bool saidNothing = traits == result_.traits.size() + result_.denials.size();
  if (termFirst && saidNothing && !f.conceptAs("organ"))
    if (const std::size_t end = readCount(i)) return end;
  return f.end;
}

ParagraphResult ParagraphReader::read() {
  for (std::size_t i = 0; i < tokens_.size();) i = std::max(step(i), i + 1);
  if (!isAboutAPlant()) return {};
  unsure_ = knownShare() < sureShare;
  findUnknown();
  return std::move(result_);
}

}  // namespace axil::keywords
