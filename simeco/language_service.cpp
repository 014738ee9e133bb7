#include "simeco/language_service.hpp"

#include "simeco/report.hpp"
#include "simeco/service_index.hpp"
#include "simeco/service_words.hpp"
#include "simeco/vocabulary.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace axil::simeco {

namespace {

constexpr std::size_t kMostShown = 100;  ///< bytes of a rule in a hover
constexpr std::size_t kMostRules = 6;    ///< of them

std::string_view textAt(const Analysis& a, SourceSpan span) {
  const std::size_t begin = std::min<std::size_t>(span.begin, a.text.size());
  return std::string_view(a.text).substr(begin, std::max<std::size_t>(span.end, begin) - begin);
}

/// A rule or value on one line, cut where it is long.
std::string oneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!blank) line += c;
    else if (!line.empty() && line.back() != ' ') line += ' ';
  }
  if (line.size() <= kMostShown) return line;
  std::size_t end = kMostShown;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0u) == 0x80u) --end;
  return line.substr(0, end) + " ...";
}

std::string lineOf(const Analysis& a, std::uint32_t offset) { return "line " + std::to_string(placeOf(a.text, offset).line); }

// ---- symbols -----------------------------------------------------------------------------------------------------------

std::string joined(const Grammar& grammar, const std::vector<Module>& modules) {
  std::string text;
  for (const Module& m : modules) text += printModule(grammar, m);
  return text;
}

class Outline {
 public:
  explicit Outline(const Analysis& a) : a_(a), grammar_(a.parsed.grammar) {}

  std::vector<ServiceSymbol> run() {
    macros();
    int level = 0;
    if (grammar_.language == Language::SimEco && !grammar_.name.empty()) symbols_.push_back({SymbolKind::Ecosystem, grammar_.name, {0, end()}, level++});
    attributes(grammar_.attributes, level);
    for (const PlantGrammar& plant : grammar_.plants) this->plant(plant, level);
    std::stable_sort(symbols_.begin(), symbols_.end(), [](const auto& a, const auto& b) { return a.where.begin < b.where.begin; });
    return std::move(symbols_);
  }

 private:
  [[nodiscard]] std::uint32_t end() const { return static_cast<std::uint32_t>(a_.text.size()); }
  void macros() {
    for (std::size_t i = 1; i < a_.tokens.size(); ++i)
      if (a_.tokens[i].role == TokenRole::Macro && a_.tokens[i - 1].role == TokenRole::Directive && textAt(a_, a_.tokens[i - 1].span).ends_with("define"))
        symbols_.push_back({SymbolKind::Macro, std::string(textAt(a_, a_.tokens[i].span)), a_.tokens[i].span, 0});
  }
  void attributes(const std::vector<Attribute>& list, int level) {
    for (const Attribute& a : list) symbols_.push_back({SymbolKind::Attribute, a.name, a.where, level});
  }
  void plant(const PlantGrammar& plant, int level) {
    if (grammar_.language == Language::SimEco) {
      symbols_.push_back({SymbolKind::Plant, plant.name, plant.where, level++});
      attributes(plant.attributes, level);
      for (const OrganBlock& organ : plant.organs) {
        symbols_.push_back({SymbolKind::Organ, keywordOf(organ.kind), organ.where, level});
        attributes(organ.attributes, level + 1);
        for (const Stage& stage : organ.stages) {
          symbols_.push_back({SymbolKind::Stage, "Stage " + std::to_string(stage.number), stage.where, level + 1});
          attributes(stage.attributes, level + 2);
        }
      }
    }
    rules(plant.rules, level);
    for (const RuleSet& further : plant.subRules) rules(further, level);
  }
  void rules(const RuleSet& rules, int level) {
    const bool classic = grammar_.language == Language::LSystem;
    if (classic && !rules.axiom.empty()) symbols_.push_back({SymbolKind::System, rules.label, systemPlace(rules), level++});
    if (!rules.axiom.empty()) {
      const SourceSpan where{rules.axiom.front().where.begin, std::max(rules.axiom.front().where.begin, rules.axiom.back().where.end)};
      symbols_.push_back({SymbolKind::Axiom, classic ? "Axiom" : rules.label, where, level});
    }
    productions(rules.productions, level);
    if (rules.decomposition) productions(rules.decomposition->productions, level);
    if (rules.homomorphism) productions(rules.homomorphism->productions, level);
    productions(rules.interaction, level);
  }
  /// The label of an L-system: the last one in front of its axiom.
  [[nodiscard]] SourceSpan systemPlace(const RuleSet& rules) const {
    SourceSpan place = rules.axiom.front().where;
    for (std::size_t i = 0; i < a_.tokens.size() && a_.tokens[i].span.begin < rules.axiom.front().where.begin; ++i)
      if (a_.tokens[i].role == TokenRole::Text && textAt(a_, a_.tokens[i].span) == rules.label) place = a_.tokens[i].span;
    return place;
  }
  void productions(const std::vector<Production>& list, int level) {
    for (const Production& p : list) symbols_.push_back({SymbolKind::Rule, joined(grammar_, p.predecessor), p.where, level});
  }

  const Analysis& a_;
  const Grammar& grammar_;
  std::vector<ServiceSymbol> symbols_;
};

// ---- the same thing ----------------------------------------------------------------------------------------------------

bool sameSubject(const Mention& a, const Mention& b) {
  if (a.kind != b.kind || a.key != b.key || a.scope != b.scope) return false;
  return !a.number || !b.number || *a.number == *b.number;
}

/// Of modules the rules and stages; of others the first place that makes them.
std::vector<const Mention*> definers(const std::vector<Mention>& mentions, const Mention& asked) {
  std::vector<const Mention*> found;
  for (const Mention& m : mentions)
    if (m.defines && sameSubject(m, asked) && (found.empty() || asked.kind == SubjectKind::Module)) found.push_back(&m);
  return found;
}

// ---- hover -------------------------------------------------------------------------------------------------------------

std::string noted(const WordNote& note) { return (note.form.empty() ? std::string(note.word) : std::string(note.form)) + ": " + std::string(note.text); }

std::string wordText(Language language, CompletionKind kind, std::string_view word) {
  const WordNote* note = wordNote(language, kind, word);
  return note == nullptr ? std::string{} : noted(*note);
}

std::string moduleText(const Analysis& a, const std::vector<Mention>& mentions, const Mention& m) {
  const std::string letter = m.key.substr(0, m.key.rfind('/'));
  std::string text = wordText(a.language, CompletionKind::Module, letter);
  if (text.empty()) text = "letter " + letter;
  std::size_t rules = 0;
  std::string shown;
  for (const Mention* d : definers(mentions, m)) {
    if (++rules > kMostRules) continue;
    shown += "\n" + lineOf(a, d->where.begin) + ": " + oneLine(textAt(a, d->whole));
  }
  if (rules > kMostRules) shown += "\nand " + std::to_string(rules - kMostRules) + " more";
  return text + (rules == 0 ? "\nno rule rewrites it" : shown);
}

std::string nameText(const Analysis& a, const std::vector<Mention>& mentions, const Mention& m) {
  const auto made = definers(mentions, m);
  if (made.empty()) return m.key + ": nothing sets it";
  return m.key + ": made in " + lineOf(a, made.front()->where.begin) + ": " + oneLine(textAt(a, made.front()->whole.end > 0 ? made.front()->whole : made.front()->where));
}

std::string attributeText(const Analysis& a, const std::vector<Mention>& mentions, const Mention& m) {
  std::string text = wordText(a.language, CompletionKind::Attribute, m.key);
  const auto made = definers(mentions, m);
  if (!made.empty()) text += (text.empty() ? "" : "\n") + lineOf(a, made.front()->where.begin) + ": " + oneLine(textAt(a, made.front()->whole));
  return text;
}

std::string macroText(const Analysis& a, const std::vector<Mention>& mentions, const Mention& m) {
  const auto made = definers(mentions, m);
  if (made.empty()) return {};
  const std::size_t begin = a.text.rfind('#', made.front()->where.begin);
  return oneLine(std::string_view(a.text).substr(begin, a.text.find('\n', begin) - begin));
}

std::string keywordText(const Analysis& a, const Mention& m) {
  // However it is spelled: blanks and capitals do not matter.
  const auto plain = [](std::string_view word) {
    std::string small;
    for (const char c : word)
      if (c != ' ' && c != '\t') small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return small;
  };
  for (const WordNote& note : wordNotes(a.language))
    if (note.kind == CompletionKind::Keyword && plain(note.word) == plain(m.key)) return noted(note);
  return {};
}

std::string hoverText(const Analysis& a, const std::vector<Mention>& mentions, const Mention& m) {
  switch (m.kind) {
    case SubjectKind::Module: return moduleText(a, mentions, m);
    case SubjectKind::Name: return nameText(a, mentions, m);
    case SubjectKind::Attribute: return attributeText(a, mentions, m);
    case SubjectKind::Macro: return macroText(a, mentions, m);
    case SubjectKind::Function: return wordText(a.language, CompletionKind::Function, m.key);
    case SubjectKind::Label: return "the L-system " + m.key;
    case SubjectKind::Keyword: return keywordText(a, m);
  }
  return {};
}

// ---- completion --------------------------------------------------------------------------------------------------------

bool isWordPart(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '#' || static_cast<unsigned char>(c) >= 0x80;
}

/// The keyword of the block that byte `offset` stands in: "", "EcoSystem", "Plant", "Stem", "Stage", "Grow" ...
std::string blockAt(const Analysis& a, std::size_t offset) {
  std::vector<std::string> open{""};
  std::string last;
  for (const ServiceToken& token : a.tokens) {
    if (token.span.begin >= offset) break;
    const std::string_view word = textAt(a, token.span);
    if (token.role == TokenRole::Keyword) last = word;
    if (token.role != TokenRole::Separator) continue;
    if (word == "{") open.push_back(last);
    if (word == "}" && open.size() > 1) open.pop_back();
  }
  return open.back();
}

std::uint8_t placesOf(const std::string& block) {
  if (block == "EcoSystem") return InEcosystem;
  if (block == "Plant") return InPlant;
  return block == "Stage" || organOfKeyword(block) ? InOrgan : 0;
}

bool keywordFits(std::string_view word, const std::string& block) {
  const bool organ = organOfKeyword(word).has_value();
  if (block.empty()) return word == "EcoSystem";
  if (block == "EcoSystem") return word == "Plant";
  if (block == "Plant") return organ || word == "Grow";
  if (organOfKeyword(block)) return word == "Stage";
  return block != "Stage" && word != "EcoSystem" && word != "Plant" && word != "Stage" && word != "Grow" && !organ;
}

class Completer {
 public:
  Completer(const Analysis& a, std::size_t offset) : a_(a) {
    const std::size_t end = std::min(offset, a.text.size());
    std::size_t begin = end;
    while (begin > 0 && isWordPart(a.text[begin - 1])) --begin;
    found_.replaces = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    prefix_ = a.text.substr(begin, end - begin);
  }

  Completions run() {
    for (const ServiceToken& t : a_.tokens)
      if ((t.role == TokenRole::Comment || t.role == TokenRole::Text) && t.span.begin < found_.replaces.begin && found_.replaces.end < t.span.end) return std::move(found_);
    a_.language == Language::SimEco ? simeco() : lsystem();
    namesHere();
    std::sort(found_.entries.begin(), found_.entries.end(), [](const auto& a, const auto& b) { return a.text < b.text; });
    return std::move(found_);
  }

 private:
  void offer(std::string_view text, std::string_view detail, CompletionKind kind) {
    if (!text.starts_with(prefix_) || text == prefix_ || !seen_.insert(std::string(text)).second) return;
    found_.entries.push_back({std::string(text), std::string(detail), kind});
  }
  void simeco() {
    const std::string block = blockAt(a_, found_.replaces.begin);
    const std::uint8_t places = placesOf(block);
    const bool inRules = !block.empty() && places == 0;
    for (const WordNote& note : wordNotes(Language::SimEco)) {
      if (note.kind == CompletionKind::Keyword && keywordFits(note.word, block)) offer(note.word, note.text, note.kind);
      if (note.kind == CompletionKind::Attribute && fits(note.word, places)) offer(note.word, note.text, note.kind);
      if (note.kind == CompletionKind::Module && inRules) offer(note.word, note.text, note.kind);
      if (note.kind == CompletionKind::Function && !block.empty()) offer(note.word, note.text, note.kind);
    }
  }
  static bool fits(std::string_view attribute, std::uint8_t places) {
    const auto words = attributeWords();
    return std::any_of(words.begin(), words.end(), [&](const AttributeWord& w) { return w.name == attribute && (w.places & places) != 0; });
  }
  /// Keywords begin a line; elsewhere functions. Letters are one character and need no completion.
  void lsystem() {
    const std::size_t lineBegin = a_.text.rfind('\n', found_.replaces.begin == 0 ? 0 : found_.replaces.begin - 1);
    const std::string_view before = std::string_view(a_.text).substr(lineBegin == std::string::npos ? 0 : lineBegin, found_.replaces.begin - (lineBegin == std::string::npos ? 0 : lineBegin));
    const bool first = before.find_first_not_of(" \t\r\n") == std::string_view::npos;
    for (const WordNote& note : wordNotes(Language::LSystem)) {
      if (note.kind == CompletionKind::Keyword && first) offer(note.word, note.text, note.kind);
      if (note.kind == CompletionKind::Function) offer(note.word, note.text, note.kind);
    }
  }
  void namesHere() {
    for (const Mention& m : mentionsIn(a_)) {
      const bool near = m.whole.begin <= found_.replaces.begin && found_.replaces.begin <= m.whole.end;
      const bool shared = m.whole.end == 0 || m.kind == SubjectKind::Attribute;
      if (m.kind == SubjectKind::Macro && m.defines) offer(m.key, "macro", CompletionKind::Macro);
      if ((m.kind == SubjectKind::Name || m.kind == SubjectKind::Attribute) && m.defines && (near || shared) && !known(m.key)) offer(m.key, "", CompletionKind::Name);
    }
  }
  /// Attributes of the language are offered where they belong only.
  static bool known(const std::string& name) { return wordNote(Language::SimEco, CompletionKind::Attribute, name) != nullptr; }

  const Analysis& a_;
  Completions found_;
  std::string prefix_;
  std::set<std::string, std::less<>> seen_;
};

}  // namespace

Analysis analyse(std::string_view text, Language language, const LSystemOptions& options) {
  Analysis a;
  a.language = language;
  a.text = text;
  a.tokens = tokensOf(text, language);
  a.parsed = language == Language::LSystem ? parseLSystem(text, options) : parseSimeco(text);
  addChecked(a.parsed);
  a.symbols = Outline(a).run();
  return a;
}

std::optional<Hover> hoverAt(const Analysis& analysis, std::size_t offset) {
  const std::vector<Mention> mentions = mentionsIn(analysis);
  const Mention* m = mentionAt(mentions, offset);
  if (m == nullptr) return std::nullopt;
  std::string text = hoverText(analysis, mentions, *m);
  if (text.empty()) return std::nullopt;
  return Hover{m->where, std::move(text)};
}

std::vector<SourceSpan> definitionsAt(const Analysis& analysis, std::size_t offset) {
  const std::vector<Mention> mentions = mentionsIn(analysis);
  std::vector<SourceSpan> places;
  const Mention* m = mentionAt(mentions, offset);
  if (m == nullptr) return places;
  for (const Mention* d : definers(mentions, *m)) places.push_back(d->where);
  return places;
}

std::vector<SourceSpan> referencesAt(const Analysis& analysis, std::size_t offset) {
  const std::vector<Mention> mentions = mentionsIn(analysis);
  std::vector<SourceSpan> places;
  const Mention* asked = mentionAt(mentions, offset);
  if (asked == nullptr) return places;
  for (const Mention& m : mentions)
    if (sameSubject(m, *asked) && (places.empty() || !(places.back() == m.where))) places.push_back(m.where);
  return places;
}

Completions completionsAt(const Analysis& analysis, std::size_t offset) { return Completer(analysis, offset).run(); }

}  // namespace axil::simeco
