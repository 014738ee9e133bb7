#include "keywords/lexicon.hpp"

#include "base/result.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
};
// First word -> phrases, longest first.
using Lexicon = std::unordered_map<std::string, std::vector<Phrase>, TextHash, std::equal_to<>>;

void addTerm(Lexicon& lexicon, const Term& term, const Category& category, const Concept& entry) {
  const std::vector<std::string> words = wordsOf(term.words);
  AXIL_ASSERT(!words.empty(), "the vocabulary has an empty term");
  std::vector<Phrase>& phrases = lexicon[words.front()];
  auto phrase = std::find_if(phrases.begin(), phrases.end(), [&](const Phrase& p) { return p.words == words; });
  if (phrase == phrases.end()) phrase = phrases.insert(phrases.end(), Phrase{words, {}});
  // Traditional and simplified forms are often the same characters.
  const auto isSame = [&](const Meaning& m) { return m.entry == &entry; };
  if (std::none_of(phrase->meanings.begin(), phrase->meanings.end(), isSame)) phrase->meanings.push_back({&category, &entry, term.everyday});
}

Lexicon buildLexicon() {
  Lexicon lexicon;
  for (const Category& category : vocabulary())
    for (const Concept& entry : category.concepts)
      for (const std::vector<Term>* terms : {&entry.english, &entry.traditional, &entry.simplified})
        for (const Term& term : *terms) addTerm(lexicon, term, category, entry);
  for (auto& [word, phrases] : lexicon)
    std::stable_sort(phrases.begin(), phrases.end(), [](const Phrase& a, const Phrase& b) { return a.words.size() > b.words.size(); });
  return lexicon;
}

const Lexicon& lexicon() {
  static const Lexicon built = buildLexicon();
  return built;
}

const std::vector<Phrase>* phrasesWith(std::string_view word) {
  const auto found = lexicon().find(word);
  if (found != lexicon().end()) return &found->second;
  constexpr std::string_view prefix = "sub";
  if (word.size() < prefix.size() + 4 || !word.starts_with(prefix)) return nullptr;
  const auto stem = lexicon().find(word.substr(prefix.size()));
  return stem == lexicon().end() ? nullptr : &stem->second;
}

// 球型漿果 is written for 球形漿果.
bool isSameWord(std::string_view token, std::string_view word) { return token == word || (token == "型" && word == "形"); }

// The token after the last word of `phrase` where it stands at `first`; 0 when it does not stand there.
std::size_t endOf(const Phrase& phrase, const std::vector<Token>& tokens, std::size_t first) {
  std::size_t at = first + 1;
  for (std::size_t w = 1; w < phrase.words.size(); ++w) {
    if (at < tokens.size() && tokens[at].text == "-" && tokens[first].kind != TokenKind::Han) ++at;
    if (at >= tokens.size() || !isSameWord(tokens[at].text, phrase.words[w])) return 0;
    ++at;
  }
  return at;
}

}  // namespace

const Meaning* Found::as(std::string_view property) const {
  if (phrase == nullptr) return nullptr;
  for (const Meaning& m : phrase->meanings)
    if (m.category->property == property) return &m;
  return nullptr;
}

const Concept* Found::conceptAs(std::string_view property) const {
  const Meaning* meaning = as(property);
  return meaning == nullptr ? nullptr : meaning->entry;
}

bool isKnownWord(std::string_view word) { return phrasesWith(word) != nullptr; }

std::vector<Found> findPhrases(const std::vector<Token>& tokens) {
  std::vector<Found> found(tokens.size());
  // 具刺狀鋸齒 is 具 and 刺狀鋸齒, not 具刺 and the rest: a verb gives its noun away to a longer word.
  const auto givesWay = [&](const Found& f, std::size_t i) { return tokens[i].kind == TokenKind::Han && (tokens[i].text == "具" || tokens[i].text == "有" || tokens[i].text == "被") && f.end < tokens.size(); };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::vector<Phrase>* phrases = phrasesWith(tokens[i].text);
    if (phrases == nullptr) continue;
    const auto isOther = [&](const Phrase& phrase) { return phrase.words.front() != tokens[i].text && phrase.meanings.front().category->property == "foreign"; };  // "submerged" does not merge
    for (const Phrase& phrase : *phrases)
      if (const std::size_t end = endOf(phrase, tokens, i); end != 0 && !isOther(phrase)) {
        found[i] = {&phrase, i, end};
        break;
      }
  }
  // 葉舌狀 is 葉 and 舌狀, not 葉舌 and the rest.
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const bool split = found[i] && tokens[i].kind == TokenKind::Han && found[i].end == i + 2 && found[i + 1].end == i + 3 && (tokens[i + 2].text == "狀" || tokens[i + 2].text == "状") && found[i].as("organ") != nullptr && found[i + 1].as("shape") != nullptr;
    if (!split) continue;
    for (const Phrase& phrase : *phrasesWith(tokens[i].text))
      if (phrase.words.size() == 1) found[i] = {&phrase, i, i + 1};
  }
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
    if (found[i] && givesWay(found[i], i) && found[i].end < found[i + 1].end) found[i] = {};
  return found;
}

}  // namespace axil::keywords
