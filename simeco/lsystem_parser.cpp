#include "simeco/lsystem_language.hpp"

#include "simeco/lsystem_reader.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace axil::simeco {

namespace {

constexpr std::int64_t kArrayElements = 10'000'000;
constexpr int kArrayDimensions = 16;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

enum class HeaderItem { Seed, Length, Ring, Ignore, Consider, Define, Start, StartEach, EndEach, End, ExternStart, ExternStartEach, Axiom };
struct HeaderRow {
  std::string_view words;  ///< a ':' at the end belongs to it; blanks are optional
  HeaderItem item;
};
constexpr HeaderRow kHeader[] = {
    {"seed:", HeaderItem::Seed}, {"derivation length:", HeaderItem::Length}, {"ring lsystem", HeaderItem::Ring},
    {"ignore:", HeaderItem::Ignore}, {"consider:", HeaderItem::Consider}, {"define:", HeaderItem::Define},
    {"start each:", HeaderItem::StartEach}, {"start:", HeaderItem::Start}, {"end each:", HeaderItem::EndEach}, {"end:", HeaderItem::End},
    {"extern start each:", HeaderItem::ExternStartEach}, {"extern each start:", HeaderItem::ExternStartEach},
    {"extern start:", HeaderItem::ExternStart}, {"axiom:", HeaderItem::Axiom},
};

enum class SectionItem { Decomposition, Homomorphism, Interaction, MaximumDepth, Seed, EndLSystem, NextLSystem };
struct SectionRow {
  std::string_view words;
  SectionItem item;
};
constexpr SectionRow kSections[] = {
    {"decomposition", SectionItem::Decomposition}, {"homomorphism", SectionItem::Homomorphism}, {"interaction", SectionItem::Interaction},
    {"maximum depth:", SectionItem::MaximumDepth}, {"seed:", SectionItem::Seed}, {"end lsystem", SectionItem::EndLSystem},
    {"lsystem:", SectionItem::NextLSystem},
};

enum class Section { Productions, Decomposition, Homomorphism, Interaction };

class LSystemParser : private LSystemReader {
 public:
  LSystemParser(const Preprocessed& source, Parsed& parsed) : LSystemReader(source, parsed.grammar, parsed.diagnostics) {}

  void run() {
    grammar_.language = Language::LSystem;
    grammar_.version.clear();
    grammar_.plants.emplace_back();
    bool first = true;
    while (skipLines(), !atTextEnd() || first) {
      if (!first && !sees("lsystem:")) {
        restOfLine();
        errorHere("there is text after endlsystem", "only another Lsystem: may follow");
        break;
      }
      RuleSet rules = lsystem(first);
      if (first) grammar_.plants[0].rules = std::move(rules);
      else grammar_.plants[0].subRules.push_back(std::move(rules));
      first = false;
    }
    takeComments(text_.size() + 1, grammar_.closing);
    // Without a length the result is the axiom.
    if (!grammar_.plants[0].rules.derivationLength) grammar_.plants[0].rules.derivationLength = grammar_.add(Number{0, -1});
    grammar_.name = grammar_.plants[0].name = grammar_.plants[0].rules.label;
  }

 private:
  // ---- lines and keywords

  [[nodiscard]] bool atTextEnd() const { return at_ >= text_.size(); }

  void wholeText() {
    limit_ = text_.size();
    broken_ = false;
  }
  void skipLines() {
    wholeText();
    skip();
  }
  void restOfLine() { limit_ = lineEnd(at_); }
  [[nodiscard]] std::size_t lineEnd(std::size_t from) const { return std::min(text_.find('\n', from), text_.size()); }
  void nextLine(std::size_t end) {
    at_ = end;
    wholeText();
  }

  /// The end of `words` if they stand here, whatever their case; npos otherwise.
  [[nodiscard]] std::size_t keywordEnd(std::string_view words) const {
    std::size_t i = at_;
    for (const char c : words) {
      if (c == ' ' || c == ':')
        while (i < limit_ && isBlank(text_[i])) ++i;
      if (c == ' ') continue;
      if (i >= limit_ || lower(text_[i]) != c) return std::string_view::npos;
      ++i;
    }
    const bool wholeWord = words.back() == ':' || i >= limit_ || !isLetter(text_[i]);
    return wholeWord ? i : std::string_view::npos;
  }
  [[nodiscard]] bool sees(std::string_view words) const { return keywordEnd(words) != std::string_view::npos; }

  /// Takes the keyword. Only the first letter of each of its words may be a capital.
  void takeKeyword(std::string_view words) {
    const std::size_t begin = at_;
    const std::size_t end = keywordEnd(words);
    std::size_t i = at_;
    bool first = true;
    bool spelled = true;
    for (const char c : words) {
      if (c == ' ' || c == ':')
        while (isBlank(text_[i])) ++i;
      if (c != ' ') spelled = spelled && (text_[i] == c || first), ++i;
      first = c == ' ';
    }
    at_ = end;
    if (!spelled) error(begin, end, "this keyword is not spelled so", "write " + std::string(words) + "; only the first letter of a word may be a capital");
  }

  // ---- comments

  void takeComments(std::size_t before, std::vector<std::string>& into) {
    for (; comment_ < source_.comments.size() && source_.comments[comment_].at < before; ++comment_) into.push_back(source_.comments[comment_].text);
  }

  /// Comments within [.., end] that stand in a statement, as one line.
  std::string trailingComments(std::size_t end) {
    std::vector<std::string> all;
    takeComments(end + 1, all);
    std::string line;
    for (std::size_t i = 0; i < all.size(); ++i) {
      // A // would swallow what follows it on the line.
      if (i + 1 < all.size() && all[i].starts_with("//")) all[i] = "/*" + all[i].substr(2) + " */";
      line += (i == 0 ? "" : " ") + all[i];
    }
    return line;
  }

  // ---- one L-system

  RuleSet lsystem(bool first) {
    RuleSet rules;
    classicEnd_ = true;
    takeComments(at_, first ? grammar_.comments.before : rules.axiomComments.before);
    label(rules);
    header(rules);
    body(rules);
    return rules;
  }

  void label(RuleSet& rules) {
    const std::size_t end = lineEnd(at_);
    limit_ = end;
    if (!sees("lsystem:")) {
      const bool colon = lower(peek()) == 'l' && sees("lsystem");
      errorHere(atTextEnd() ? "the text has no L-system" : "expected Lsystem: and a label, found " + found(), colon ? "the colon is missing: write Lsystem: 1" : "a file starts with Lsystem: 1");
      ended_ = true;
      const bool goesOn = std::any_of(std::begin(kHeader), std::end(kHeader), [&](const HeaderRow& row) { return sees(row.words); });
      if (!goesOn) at_ = end;
      return wholeText();
    }
    takeKeyword("lsystem:");
    skip();
    const std::size_t begin = at_;
    std::size_t stop = end;
    while (stop > begin && isBlank(text_[stop - 1])) --stop;
    rules.label = std::string(text_.substr(begin, stop - begin));
    if (rules.label.empty()) errorHere("the label of the L-system is missing", "write Lsystem: 1");
    if (const std::size_t bad = rules.label.find_first_of("<>:*"); bad != std::string::npos)
      error(begin + bad, begin + bad + 1, "a label holds no < > : or *", "a line that starts with a tab continues the line before");
    nextLine(end);
  }

  void header(RuleSet& rules) {
    while (true) {
      skipLines();
      const HeaderRow* row = headerRowHere();
      if (row == nullptr) {
        limit_ = lineEnd(at_);
        const bool over = atTextEnd() || atSection() || looksLikeProduction();
        if (!over || !ended_) errorHere(missingAxiom(), keywordHint(kHeader, "write Axiom: and a string before the first rule"));
        ended_ = true;
        if (atSection() || looksLikeProduction()) return wholeText();
        if (atTextEnd()) return;
        nextLine(limit_);
        continue;
      }
      const std::size_t end = headerEnd();
      takeComments(at_, rules.axiomComments.before);
      limit_ = end;
      takeKeyword(row->words);
      headerItem(row->item, rules, end);
      const bool axiom = row->item == HeaderItem::Axiom;
      if (axiom) rules.axiomComments.trailing = trailingComments(end);
      else takeComments(end + 1, rules.axiomComments.before);
      nextLine(end);
      if (axiom) return;
    }
  }

  [[nodiscard]] std::string missingAxiom() const {
    if (atEnd() && limit_ == text_.size()) return "the text ends before an Axiom:";
    return "expected a header item or Axiom:, found " + found();
  }
  /// The keyword that the line here was most likely meant to be, as a hint; else `otherwise`.
  template <class Rows>
  [[nodiscard]] std::string keywordHint(const Rows& rows, std::string otherwise) const {
    std::string words;
    for (std::size_t i = at_; i < limit_ && (isLetter(text_[i]) || isBlank(text_[i])); ++i)
      if (!isBlank(text_[i])) words += lower(text_[i]);
    // What other programs call it.
    static const std::map<std::string_view, std::string_view> kOtherNames{{"omega", "axiom:"}, {"w", "axiom:"}, {"start", "start:"}, {"iterations", "derivation length:"},
                                                                          {"steps", "derivation length:"}, {"end", "endlsystem"}, {"angle", "angle increment: in a .v file beside this one"}};
    if (const auto other = kOtherNames.find(words); other != kOtherNames.end()) return "write " + std::string(other->second);
    std::string best;
    std::size_t fewest = words.size() / 4 + 1;
    for (const auto& row : rows) {
      std::string known;
      for (const char c : row.words)
        if (c != ' ' && c != ':') known += c;
      if (row.words.ends_with(':') && words.starts_with(known)) return "the colon is missing: write " + std::string(row.words);
      const std::size_t edits = editDistance(std::string_view(words).substr(0, known.size() + 2), known);
      if (edits < fewest) fewest = edits, best = row.words;
    }
    return best.empty() ? otherwise : "did you mean " + best + "?";
  }
  [[nodiscard]] bool atSection() const {
    return std::any_of(std::begin(kSections), std::end(kSections), [&](const SectionRow& row) { return sees(row.words); });
  }
  [[nodiscard]] bool looksLikeProduction() const { return text_.substr(at_, limit_ - at_).find("-->") != std::string_view::npos; }

  [[nodiscard]] const HeaderRow* headerRowHere() const {
    const auto row = std::find_if(std::begin(kHeader), std::end(kHeader), [&](const HeaderRow& r) { return sees(r.words); });
    return row == std::end(kHeader) ? nullptr : row;
  }

  /// Where the header item that starts here ends: at its line's end, or behind the braces that open on that line.
  [[nodiscard]] std::size_t headerEnd() const {
    const std::size_t line = lineEnd(at_);
    if (sees("axiom:") || sees("ignore:") || sees("consider:")) return line;
    const std::size_t open = text_.find('{', at_);
    if (open >= line) return line;
    return lineEnd(closing(open).value_or(line));
  }

  /// The } of the { at `open`; none if a rule's arrow or the end comes first.
  [[nodiscard]] std::optional<std::size_t> closing(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '"') i = quoteEnd(i);
      else if (c == '{') ++depth;
      else if (c == '}' && --depth == 0) return i;
      else if (c == '-' && text_.substr(i).starts_with("-->")) return std::nullopt;
    }
    return std::nullopt;
  }
  /// The closing quote of the text at `i`, or `i` when it is not closed on its line.
  [[nodiscard]] std::size_t quoteEnd(std::size_t i) const {
    for (std::size_t j = i + 1; j < text_.size() && text_[j] != '\n'; ++j) {
      if (text_[j] == '\\') ++j;
      else if (text_[j] == '"') return j;
    }
    return i;
  }

  void headerItem(HeaderItem item, RuleSet& rules, std::size_t end) {
    switch (item) {
      case HeaderItem::Seed: rules.seed = seed(); break;
      case HeaderItem::Length: rules.derivationLength = expression(); break;
      case HeaderItem::Ring: rules.ring = true; eat(":"); break;
      case HeaderItem::Ignore: rules.filter = filter(ContextFilter::Mode::Ignore); break;
      case HeaderItem::Consider: rules.filter = filter(ContextFilter::Mode::Consider); break;
      case HeaderItem::Define: define(rules); break;
      case HeaderItem::Start: rules.start = headerBlock(); break;
      case HeaderItem::StartEach: rules.startEach = headerBlock(); break;
      case HeaderItem::EndEach: rules.endEach = headerBlock(); break;
      case HeaderItem::End: rules.end = headerBlock(); break;
      case HeaderItem::ExternStart: classicEnd_ = false; rules.start = headerBlock(); break;
      case HeaderItem::ExternStartEach: classicEnd_ = false; rules.startEach = headerBlock(); break;
      case HeaderItem::Axiom: axiom(rules); break;
    }
    skip();
    if (at_ < end && !broken_) errorHere("expected the end of the line, found " + found(), "each header item stands on a line of its own");
  }

  std::uint64_t seed() {
    const std::size_t begin = (skip(), at_);
    const auto value = constant("a seed");
    if (value && (*value < 0 || *value > 9e15 || *value != std::floor(*value))) error(begin, at_, "a seed is a whole number of at least 0");
    return value && !broken_ ? static_cast<std::uint64_t>(*value) : 0;
  }

  std::optional<double> constant(std::string_view what) {
    const std::size_t begin = (skip(), at_);
    const ExprId id = expression();
    if (broken_) return std::nullopt;
    const auto value = constantOf(id);
    if (!value || !std::isfinite(*value)) error(begin, at_, std::string(what) + " must be a constant number");
    return broken_ ? std::nullopt : value;
  }

  ContextFilter filter(ContextFilter::Mode mode) {
    ContextFilter result{mode, {}};
    for (skip(); !atEnd() && !broken_; skip()) {
      const char c = text_[at_];
      if (std::string_view("<>:*()").find(c) != std::string_view::npos || static_cast<unsigned char>(c) >= 0x80)
        errorHere(found() + " is no letter of a string", "list the letters one after the other");
      result.letters.emplace_back(1, c);
      ++at_;
    }
    if (result.letters.empty() && !broken_) errorHere("the list of letters is empty", "leave the line out");
    return result;
  }

  bool bodyOpens(std::string_view what) {
    skip();
    if (peek() == '{') {
      if (closing(at_)) return true;
      error(at_, at_ + 1, "this { is never closed", "add the missing }");
    } else {
      errorHere("expected { after " + std::string(what) + ", found " + found(), "the { stands on the line of the keyword");
    }
    at_ = limit_;
    return false;
  }

  Block headerBlock() { return bodyOpens("the keyword") ? block() : Block{}; }

  void axiom(RuleSet& rules) {
    skip();
    if (atEnd()) return errorHere("the axiom is empty", "write the string to start with");
    rules.axiom = modules(ModuleText::Evaluated);
    if (!broken_ && rules.axiom.empty()) errorHere("the axiom is empty", "write the string to start with");
  }

  // ---- define: { array ...; external ...; }

  void define(RuleSet& rules) {
    if (!bodyOpens("define:")) return;
    expect("{", "after define:");
    while (!broken_ && (skip(), peek() != '}')) {
      const std::string what = name("array or external");
      if (broken_) return;
      if (what == "array") arrays(rules);
      else if (what == "external") externals(rules);
      else error(at_ - what.size(), at_, "expected array or external, found '" + what + "'");
      expect(";", "after the declaration");
    }
    expect("}", "to close define:");
  }

  void externals(RuleSet& rules) {
    do rules.externals.push_back(name("a variable"));
    while (!broken_ && eat(","));
  }

  void arrays(RuleSet& rules) {
    do {
      const std::size_t begin = (skip(), at_);
      ArrayDeclaration array;
      array.name = name("the name of an array");
      sizes(array, begin);
      if (!broken_ && eat("=")) initial(array);
      const bool twice = std::any_of(rules.arrays.begin(), rules.arrays.end(), [&](const ArrayDeclaration& a) { return a.name == array.name; });
      if (twice && !broken_) error(begin, begin + array.name.size(), "array " + array.name + " is declared twice");
      rules.arrays.push_back(std::move(array));
    } while (!broken_ && eat(","));
  }

  void sizes(ArrayDeclaration& array, std::size_t begin) {
    std::int64_t elements = 1;
    skip();
    if (!broken_ && peek() != '[') errorHere("array " + array.name + " has no size", "write array " + array.name + "[3]");
    while (!broken_ && eat("[")) {
      const std::size_t at = (skip(), at_);
      const auto size = constant("the size of an array");
      skip();
      if (!broken_ && peek() == ',') errorHere("one pair of brackets holds one size", "write array " + array.name + "[2][2]");
      expect("]", "after the size");
      if (broken_) return;
      const bool whole = *size >= 1 && *size <= static_cast<double>(kArrayElements) && *size == std::floor(*size);
      if (!whole) return error(at, at_, "the size of an array is a whole number from 1 to " + std::to_string(kArrayElements));
      array.sizes.push_back(static_cast<int>(*size));
      elements *= array.sizes.back();
      if (elements > kArrayElements || array.sizes.size() > kArrayDimensions)
        return error(begin, at_, "array " + array.name + " has more than " + std::to_string(kArrayElements) + " elements or " + std::to_string(kArrayDimensions) + " dimensions");
    }
  }

  void initial(ArrayDeclaration& array) {
    const std::size_t begin = (skip(), at_);
    expect("{", "before the first values");
    if (!broken_)
      do array.initial.push_back(expression());
      while (!broken_ && eat(","));
    expect("}", "after the first values");
    std::int64_t elements = 1;
    for (const int size : array.sizes) elements *= size;
    if (broken_) return;
    const auto given = static_cast<std::int64_t>(array.initial.size());
    if (given > elements) {
      warn(begin, at_, "array " + array.name + " has " + std::to_string(elements) + " elements, but " + std::to_string(given) + " values", "the last ones are dropped");
      array.initial.resize(static_cast<std::size_t>(elements));
    } else if (given < elements) {
      warn(begin, at_, "array " + array.name + " has " + std::to_string(elements) + " elements, but " + std::to_string(given) + " values", "the others are 0");
    }
  }

  // ---- productions and sections

  void body(RuleSet& rules) {
    section_ = Section::Productions;
    while (true) {
      skipLines();
      if (atTextEnd()) {
        if (classicEnd_ && !ended_) errorHere("the text ends without endlsystem", "add a line endlsystem");
        return;
      }
      const std::size_t begin = at_;
      const std::size_t end = statementEnd(begin);
      limit_ = end;
      const bool rule = looksLikeProduction();
      const SectionRow* row = rule ? nullptr : sectionRowHere();
      if (row != nullptr && row->item == SectionItem::NextLSystem) {
        if (classicEnd_) errorHere("endlsystem is missing before the next Lsystem:", "add a line endlsystem");
        return wholeText();
      }
      if (row != nullptr) {
        takeKeyword(row->words);
        sectionItem(row->item, rules, begin);
        skip();
        if (!broken_ && !atEnd()) errorHere("expected the end of the line, found " + found());
        const bool ended = row->item == SectionItem::EndLSystem;
        if (ended) {
          takeComments(end + 1, grammar_.closing);
          nextLine(end);
          return;
        }
      } else if (const HeaderRow* extern_ = rule ? nullptr : externRowHere(); extern_ != nullptr && rules.productions.empty()) {
        externBlock(*extern_, rules);
        continue;
      } else if (const HeaderRow* misplaced = rule ? nullptr : headerRowHere(); misplaced != nullptr) {
        if (misplaced->item == HeaderItem::Axiom) errorHere("an Axiom: stands behind the first rule or a second time", "write one, before the rules");
        else errorHere("a header item stands after the axiom", "move it before Axiom:");
      } else {
        Production next = production(begin, end);
        if (!broken_) rulesOfSection(rules).push_back(std::move(next));
      }
      nextLine(end);
    }
  }

  /// RTIL writes its blocks between the axiom and the rules.
  [[nodiscard]] const HeaderRow* externRowHere() const {
    const HeaderRow* row = headerRowHere();
    return row != nullptr && (row->item == HeaderItem::ExternStart || row->item == HeaderItem::ExternStartEach) ? row : nullptr;
  }
  void externBlock(const HeaderRow& row, RuleSet& rules) {
    wholeText();
    const std::size_t end = headerEnd();
    takeComments(end + 1, rules.axiomComments.before);
    limit_ = end;
    takeKeyword(row.words);
    headerItem(row.item, rules, end);
    nextLine(end);
  }

  [[nodiscard]] const SectionRow* sectionRowHere() const {
    const auto row = std::find_if(std::begin(kSections), std::end(kSections), [&](const SectionRow& r) { return sees(r.words); });
    return row == std::end(kSections) ? nullptr : row;
  }

  std::vector<Production>& rulesOfSection(RuleSet& rules) {
    switch (section_) {
      case Section::Decomposition: return rules.decomposition->productions;
      case Section::Homomorphism: return rules.homomorphism->productions;
      case Section::Interaction: return rules.interaction;
      case Section::Productions: break;
    }
    return rules.productions;
  }

  void sectionItem(SectionItem item, RuleSet& rules, std::size_t begin) {
    switch (item) {
      case SectionItem::Decomposition:
        if (section_ == Section::Homomorphism) error(begin, at_, "decomposition must come before homomorphism");
        return openSubRules(rules.decomposition, Section::Decomposition, begin);
      case SectionItem::Homomorphism: return openSubRules(rules.homomorphism, Section::Homomorphism, begin);
      case SectionItem::Interaction:
        section_ = Section::Interaction;
        classicEnd_ = false;
        eat(":");
        return;
      case SectionItem::MaximumDepth: {
        SubRules* sub = openSub(rules, begin, "maximum depth:");
        const std::size_t at = (skip(), at_);
        const auto depth = constant("the maximum depth");
        if (depth && (*depth < 0 || *depth > 1e6 || *depth != std::floor(*depth))) error(at, at_, "the maximum depth is a whole number from 0 to 1000000");
        if (sub != nullptr && depth && !broken_) sub->maximumDepth = static_cast<int>(*depth);
        return;
      }
      case SectionItem::Seed: {
        SubRules* sub = openSub(rules, begin, "seed:");
        const std::uint64_t value = seed();
        if (sub != nullptr && !broken_) sub->seed = value;
        return;
      }
      case SectionItem::EndLSystem:
      case SectionItem::NextLSystem: return;
    }
  }

  SubRules* openSub(RuleSet& rules, std::size_t begin, std::string_view what) {
    if (section_ == Section::Decomposition && rules.decomposition) return &*rules.decomposition;
    if (section_ == Section::Homomorphism && rules.homomorphism) return &*rules.homomorphism;
    const bool seed = what == "seed:";
    error(begin, at_, std::string(what) + (seed ? " of the L-system stands before Axiom:" : " belongs to decomposition or homomorphism"),
          seed ? "move it before Axiom:" : "write it below one of these lines");
    return nullptr;
  }

  void openSubRules(std::optional<SubRules>& sub, Section section, std::size_t begin) {
    section_ = section;
    if (sub) error(begin, at_, "this section stands here a second time", "put its rules together");
    else sub.emplace();
    eat(":");
    skip();
    if (sees("no warnings")) {
      at_ = keywordEnd("no warnings");
      sub->warnAtMaximumDepth = false;
    } else if (sees("warnings")) {
      at_ = keywordEnd("warnings");
    }
  }

  /// Where the rule that starts at `begin` ends: at the end of its line, but braces of its blocks may span lines.
  [[nodiscard]] std::size_t statementEnd(std::size_t begin) const {
    bool colon = false;
    int depth = 0;
    for (std::size_t i = begin; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '-' && text_.substr(i).starts_with("-->")) return lineEnd(i);
      if (c == '\n' && depth <= 0) return i;
      if (c == ':') colon = true;
      if (colon && c == '"') i = quoteEnd(i);
      if (colon && c == '{') ++depth;
      if (colon && c == '}') --depth;
    }
    return colon && depth > 0 ? lineEnd(begin) : text_.size();
  }

  Production production(std::size_t begin, std::size_t end) {
    Production result;
    takeComments(begin, result.comments.before);
    if (!looksLikeProduction()) reportOtherArrow();
    if (!broken_) sides(result);
    const std::size_t afterSides = at_;
    if (!broken_ && eat(":")) conditionAndBlocks(result);
    skip();
    if (!broken_ && !atArrow()) reportMissingArrow(begin, afterSides);
    if (!broken_) {
      at_ += 3;
      result.successors.push_back(successor());
    }
    result.comments.trailing = trailingComments(end);
    at_ = end;
    while (at_ > begin && isBlank(text_[at_ - 1])) --at_;
    result.where = spanFrom(begin);
    return result;
  }

  void sides(Production& rule) {
    const std::size_t begin = at_;
    rule.predecessor = modules(ModuleText::Formal);
    if (!broken_ && eat("<")) {
      rule.left = std::move(rule.predecessor);
      rule.predecessor = modules(ModuleText::Formal);
    }
    if (rule.predecessor.empty() && !broken_ && (atArrow() || peek() == ':' || peek() == '>'))
      error(begin, std::max(at_, begin + 1), "a rule needs at least one module to rewrite");
    skip();
    if (broken_ || peek() != '>') return;
    ++at_;
    rule.right = modules(ModuleText::RightContext);
    if (!broken_ && (peek() == '<' || peek() == '>')) errorHere("a rule has one left context and one right context", "left < predecessor > right --> successor");
  }

  /// On a line without an arrow: what other notations write for it.
  void reportOtherArrow() {
    for (const std::string_view arrow : {"::=", "==>", "-- >", "- ->", "=>", "->", ":="})
      if (const std::size_t place = text_.substr(at_, limit_ - at_).find(arrow); place != std::string_view::npos)
        return error(at_ + place, at_ + place + arrow.size(), "an arrow is written -->", "predecessor --> successor");
  }

  void reportMissingArrow(std::size_t begin, std::size_t at) {
    const bool indented = begin > 0 && isBlank(text_[begin - 1]) && (begin < 2 || text_[begin - 2] != '\n' || text_[begin - 1] != '\t');
    const std::string hint = indented ? "a line that continues the one before must start with a tab" : "a rule is written predecessor --> successor";
    if (atEnd()) {
      const std::size_t end = std::exchange(at_, begin);
      const std::string meant = keywordHint(kSections, hint);
      at_ = end;
      return error(begin, std::max(at, begin + 1), "this line is neither a rule nor a keyword: there is no -->", meant);
    }
    if (peek() == '=') errorHere("a single = gives a value, it does not compare", "write ==");
    else if (peek() == '<' || peek() == '>') errorHere("a rule has one left context and one right context", "left < predecessor > right --> successor");
    else if (const std::string word = found(); word == "'&'" || word == "'and'") errorHere("conditions are not joined by " + word, "write &&");
    else if (word == "'|'" || word == "'or'") errorHere("conditions are not joined by " + word, "write ||");
    else errorHere("expected -->, found " + found(), hint);
  }

  void conditionAndBlocks(Production& rule) {
    skip();
    const std::size_t begin = at_;
    if (peek() == '{') {
      blockEndsInside();
      if (!broken_) rule.before = block();
      skip();
      if (!broken_ && (atArrow() || atEnd())) return error(begin, at_, "a block needs a condition beside it", "write * for a condition that always holds");
    }
    skip();
    if (broken_) return;
    if (atArrow() || atEnd()) return errorHere("the condition after : is missing", "write * for a condition that always holds");
    if (peek() == '*') ++at_;
    else rule.condition = expression();
    skip();
    if (!broken_ && peek() == '{') {
      blockEndsInside();
      if (!broken_) rule.after = block();
    }
  }

  void blockEndsInside() {
    const auto end = closing(at_);
    if (!end || *end >= limit_) error(at_, at_ + 1, "this { is never closed", "add the missing }");
  }

  Successor successor() {
    Successor result;
    skip();
    if (atEnd()) {
      errorHere("the successor is missing", "write * for nothing");
      return result;
    }
    const bool nothing = peek() == '*';
    result.modules = modules(ModuleText::Evaluated);
    if (!broken_ && atArrow()) errorHere("a second --> on one line", "a line that starts with a tab continues the rule before");
    if (!broken_ && result.modules.empty() && !nothing) errorHere("the successor is missing", "write * for nothing");
    if (!broken_ && eat(":")) result.weight = weight();
    skip();
    if (!broken_ && !atEnd()) errorHere("expected the end of the rule, found " + found());
    return result;
  }

  ExprId weight() {
    std::size_t end = limit_;
    while (end > at_ && isBlank(text_[end - 1])) --end;
    if (end > at_ && text_[end - 1] == '%') error(end - 1, end, "a weight is a number, not a percentage", "write 0.5 for 50%");
    return expression();
  }

  std::size_t comment_ = 0;
  bool ended_ = false;           ///< that the text is no whole L-system was said
  Section section_ = Section::Productions;
  bool classicEnd_ = true;       ///< false in RTIL files, which the end of the text closes
};

}  // namespace

Parsed parseLSystem(std::string_view text, const LSystemOptions& options) {
  Parsed parsed;
  if (text.size() > kMostBytes) {
    parsed.diagnostics.push_back({Severity::Error, {}, "the text is larger than 32 MB", "let rules make what the axiom spells out"});
    return parsed;
  }
  const Preprocessed source = preprocessLSystem(text, options);
  LSystemParser(source, parsed).run();
  parsed.grammar.source = linesOf(text);
  parsed.diagnostics.insert(parsed.diagnostics.end(), source.diagnostics.begin(), source.diagnostics.end());
  parsed.diagnostics = limited(std::move(parsed.diagnostics));
  return parsed;
}

}  // namespace axil::simeco
