// The L-system parser: whole texts, and the sections of each L-system. Its layers are lsystem_lines, lsystem_header and lsystem_rules.

#include "simeco/lsystem_language.hpp"

#include "simeco/lsystem_rules.hpp"
#include "simeco/vocabulary.hpp"

namespace axil::simeco {

namespace {

using namespace classic;

enum class Section { Productions, Decomposition, Homomorphism, Interaction };

class LSystemParser : private RuleParser {
 public:
  using RuleParser::RuleParser;

  void run() {
    grammar_.language = Language::LSystem;
    grammar_.version.clear();
    grammar_.plants.emplace_back();
    bool first = true;
    ended_ = source_.cutShort;
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

  Section section_ = Section::Productions;
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
