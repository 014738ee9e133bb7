#pragma once
/// \file
/// The layers of the L-system parser, first: lines, keywords, comments, constants. Internal to the front end.

#include "base/text.hpp"
#include "simeco/fold.hpp"
#include "simeco/lsystem_reader.hpp"
#include "simeco/lsystem_scan.hpp"
#include "simeco/report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco::classic {

using preprocess::isBlank;
inline bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

enum class SectionItem { Decomposition, Homomorphism, Interaction, MaximumDepth, Seed, EndLSystem, NextLSystem };
struct SectionRow {
  std::string_view words;
  SectionItem item;
};
inline constexpr SectionRow kSections[] = {
    {"decomposition", SectionItem::Decomposition}, {"homomorphism", SectionItem::Homomorphism}, {"interaction", SectionItem::Interaction},
    {"maximum depth:", SectionItem::MaximumDepth}, {"seed:", SectionItem::Seed}, {"end lsystem", SectionItem::EndLSystem},
    {"lsystem:", SectionItem::NextLSystem},
};

class LineParser : protected LSystemReader {
 public:
  LineParser(const Preprocessed& source, Parsed& parsed) : LSystemReader(source, parsed.grammar, parsed.diagnostics) {}

 protected:
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

  // ---- what a line may be

  /// The keyword that the line here was most likely meant to be, as a hint; else `otherwise`.
  template <class Rows>
  [[nodiscard]] std::string keywordHint(const Rows& rows, std::string otherwise) const {
    std::string words;
    for (std::size_t i = at_; i < limit_ && (isLetter(text_[i]) || isBlank(text_[i])); ++i)
      if (!isBlank(text_[i])) words += lower(text_[i]);
    // What other programs call it.
    static const std::map<std::string_view, std::string_view> kOtherNames{{"omega", "Axiom:"}, {"w", "Axiom:"}, {"start", "Start:"}, {"iterations", "derivation length:"},
                                                                          {"steps", "derivation length:"}, {"end", "endlsystem"}, {"ring", "ring Lsystem"}, {"angle", "angle increment: in a .v file beside this one"}};
    if (const auto other = kOtherNames.find(words); other != kOtherNames.end()) return "write " + std::string(other->second);
    std::string best;
    std::size_t fewest = words.size() / 4 + 1;
    for (const auto& row : rows) {
      std::string known;
      for (const char c : row.words)
        if (c != ' ' && c != ':') known += c;
      if (row.words.ends_with(':') && words.starts_with(known)) return "the colon is missing: write " + asWritten(row.words);
      const std::size_t edits = editDistance(std::string_view(words).substr(0, known.size() + 2), known);
      if (edits < fewest) fewest = edits, best = row.words;
    }
    return best.empty() ? otherwise : "did you mean " + asWritten(best) + "?";
  }
  /// A keyword as people write it; the tables have the loosest form.
  [[nodiscard]] static std::string asWritten(std::string_view words) {
    static const std::map<std::string_view, std::string_view> kUsual{{"lsystem:", "Lsystem:"}, {"axiom:", "Axiom:"}, {"ring lsystem", "ring Lsystem"}, {"start:", "Start:"},
                                                                     {"start each:", "StartEach:"}, {"end:", "End:"}, {"end each:", "EndEach:"}, {"end lsystem", "endlsystem"}};
    const auto usual = kUsual.find(words);
    return std::string(usual == kUsual.end() ? words : usual->second);
  }
  [[nodiscard]] bool atSection() const {
    return std::any_of(std::begin(kSections), std::end(kSections), [&](const SectionRow& row) { return sees(row.words); });
  }
  [[nodiscard]] bool looksLikeProduction() const { return text_.substr(at_, limit_ - at_).find("-->") != std::string_view::npos; }

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

  // ---- constants

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
    const auto value = foldedAlone(grammar_, id);
    if (!value || !std::isfinite(*value)) error(begin, at_, std::string(what) + " must be a constant number");
    return broken_ ? std::nullopt : value;
  }

 private:
  std::size_t comment_ = 0;
};

}  // namespace axil::simeco::classic
