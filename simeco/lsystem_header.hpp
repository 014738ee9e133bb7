#pragma once
/// \file
/// The layers of the L-system parser, second: the label, the header and the axiom. Internal to the front end.

#include "simeco/lsystem_lines.hpp"

#include <cstdint>
#include <iterator>

namespace axil::simeco::classic {

inline constexpr std::int64_t kArrayElements = 10'000'000;
inline constexpr int kArrayDimensions = 16;

enum class HeaderItem { Seed, Length, Ring, Ignore, Consider, Define, Start, StartEach, EndEach, End, ExternStart, ExternStartEach, Axiom };
struct HeaderRow {
  std::string_view words;  ///< a ':' at the end belongs to it; blanks are optional
  HeaderItem item;
};
inline constexpr HeaderRow kHeader[] = {
    {"seed:", HeaderItem::Seed}, {"derivation length:", HeaderItem::Length}, {"ring lsystem", HeaderItem::Ring},
    {"ignore:", HeaderItem::Ignore}, {"consider:", HeaderItem::Consider}, {"define:", HeaderItem::Define},
    {"start each:", HeaderItem::StartEach}, {"start:", HeaderItem::Start}, {"end each:", HeaderItem::EndEach}, {"end:", HeaderItem::End},
    {"extern start each:", HeaderItem::ExternStartEach}, {"extern each start:", HeaderItem::ExternStartEach},
    {"extern start:", HeaderItem::ExternStart}, {"axiom:", HeaderItem::Axiom},
};

class HeaderParser : protected LineParser {
 public:
  using LineParser::LineParser;

 protected:
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
    // Carriage returns too: of several at the end of a line only the last belongs to the line end.
    while (stop > begin && (isBlank(text_[stop - 1]) || text_[stop - 1] == '\r')) --stop;
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

  bool ended_ = false;      ///< that the text is no whole L-system was said
  bool classicEnd_ = true;  ///< false in RTIL files, which the end of the text closes
};

}  // namespace axil::simeco::classic
