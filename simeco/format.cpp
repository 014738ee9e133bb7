// Layout of both languages. SimEco is printed from its grammar, which keeps comments. A classic text also has macros, includes and
// line breaks that are not in the grammar: it is laid out token by token, line by line.
#include "simeco/service_tokens.hpp"

#include <algorithm>
#include <utility>

namespace axil::simeco {

namespace {

Failure refused(const Parsed& parsed, std::string_view text) {
  Error error{ErrorCode::BadGrammar, "a text with errors cannot be laid out; mend what is listed", {}};
  for (const Diagnostic& d : parsed.diagnostics)
    if (d.severity == Severity::Error) error.details.push_back(formatWithCaret(d, text, "text"));
  return fail(std::move(error));
}

class Layouter {
 public:
  explicit Layouter(std::string_view text) : text_(text), tokens_(lsystemTokens(text)) {}

  std::string run() {
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      gap();
      if (role() == TokenRole::Directive) directive();
      else token();
    }
    if (!out_.empty()) out_ += '\n';
    return std::move(out_);
  }

 private:
  [[nodiscard]] TokenRole role() const { return tokens_[at_].role; }
  [[nodiscard]] std::string_view words() const { return text_.substr(tokens_[at_].span.begin, tokens_[at_].span.end - tokens_[at_].span.begin); }

  // ---- what stands between two tokens

  void gap() {
    const std::string_view blank = text_.substr(done_, tokens_[at_].span.begin - done_);
    const auto newlines = std::count(blank.begin(), blank.end(), '\n');
    const auto joins = std::count(blank.begin(), blank.end(), '\\');
    if (newlines > joins || out_.empty()) return newLine(blank, newlines - joins);
    if (joins > 0) return joinedLine(blank);
    if (!blank.empty() ? keepsBlank() : wantsBlank()) out_ += role() == TokenRole::Comment ? "  " : " ";
  }
  /// At most one empty line; none in front of the text.
  void newLine(std::string_view blank, std::ptrdiff_t newlines) {
    const std::string_view indent = blank.substr(blank.rfind('\n') == std::string_view::npos ? 0 : blank.rfind('\n') + 1);
    if (!out_.empty()) endLine(newlines > 1 ? "\n\n" : "\n");
    if (role() == TokenRole::Directive) return;
    const bool closes = depth_ > 0 && words() == "}" && role() == TokenRole::Separator;
    if (depth_ > 0) out_.append(2 * static_cast<std::size_t>(depth_ - (closes ? 1 : 0)), ' ');
    else if (indent.starts_with('\t') && !out_.empty()) out_ += '\t';  // goes on with the line before
    else if (words() == "#") out_ += ' ';                              // in front of a line it would be a directive
  }
  void joinedLine(std::string_view blank) {
    const std::size_t slash = blank.find('\\');
    if (slash > 0) out_ += ' ';
    out_ += "\\\n";
    const char last = blank.back();
    if (last == ' ' || last == '\t') out_ += "  ";
  }
  void endLine(std::string_view breaks) {
    if (!out_.empty() && out_.back() == '\\' && lastRole_ == TokenRole::Module) out_ += ' ';  // else it would join the lines
    out_ += breaks;
  }

  [[nodiscard]] TokenRole before() const { return lastRole_; }
  [[nodiscard]] bool wantsBlank() const {
    if (role() == TokenRole::Sign || before() == TokenRole::Sign || before() == TokenRole::Keyword) return true;
    return role() == TokenRole::Comment || before() == TokenRole::Comment;
  }
  [[nodiscard]] bool keepsBlank() const {
    if (wantsBlank()) return true;
    const char next = words().front();
    const bool separator = role() == TokenRole::Separator;
    if (separator && (next == ',' || next == ';' || (next == ')' && !out_.empty()))) return false;
    return !(before() == TokenRole::Separator && out_.ends_with('('));
  }

  // ---- tokens

  void token() {
    if (role() == TokenRole::Keyword) keyword();
    else out_ += role() == TokenRole::Comment ? comment() : std::string(words());
    if (role() == TokenRole::Separator && words() == "{") ++depth_;
    if (role() == TokenRole::Separator && words() == "}") depth_ = std::max(0, depth_ - 1);
    done_ = tokens_[at_].span.end;
    lastRole_ = role();
  }
  /// One blank between the words of a keyword, none before its colon.
  void keyword() {
    bool blank = false;
    for (const char c : words()) {
      const bool isBlank = c == ' ' || c == '\t';
      if (!isBlank && blank && c != ':') out_ += ' ';
      if (!isBlank) out_ += c;
      blank = isBlank;
    }
  }
  [[nodiscard]] std::string comment() const {
    std::string text(words());
    std::erase(text, '\r');
    if (text.starts_with("//"))
      while (text.ends_with(' ') || text.ends_with('\t')) text.pop_back();
    return text;
  }
  /// A directive stays as it is written, up to the end of its line.
  void directive() {
    const std::size_t begin = tokens_[at_].span.begin;
    std::size_t end = tokens_[at_].span.end;
    while (at_ + 1 < tokens_.size() && sameLine(end, tokens_[at_ + 1].span.begin)) end = tokens_[++at_].span.end;
    std::string line(text_.substr(begin, end - begin));
    std::erase(line, '\r');
    out_ += line;
    done_ = end;
    lastRole_ = TokenRole::Directive;
  }
  [[nodiscard]] bool sameLine(std::size_t begin, std::size_t end) const {
    const std::string_view blank = text_.substr(begin, end - begin);
    return std::count(blank.begin(), blank.end(), '\n') <= std::count(blank.begin(), blank.end(), '\\');
  }

  std::string_view text_;
  std::vector<ServiceToken> tokens_;
  std::size_t at_ = 0;
  std::size_t done_ = 0;  ///< bytes of the text that are laid out
  TokenRole lastRole_ = TokenRole::Comment;
  std::string out_;
  int depth_ = 0;         ///< open braces
};

Parsed parsedAs(std::string_view text, Language language, const LSystemOptions& options) {
  return language == Language::LSystem ? parseLSystem(text, options) : parseSimeco(text);
}

}  // namespace

Result<std::string> formatted(std::string_view text, Language language, const LSystemOptions& options) {
  const Parsed parsed = parsedAs(text, language, options);
  if (!parsed.ok()) return refused(parsed, text);
  std::string laidOut = language == Language::LSystem ? Layouter(text).run() : print(parsed.grammar);
  const Parsed again = parsedAs(laidOut, language, options);
  if (!again.ok() || !(again.grammar == parsed.grammar))
    return fail(ErrorCode::NoAnswer, "this text cannot be laid out without changing what it means; it stays as it is");
  return laidOut;
}

}  // namespace axil::simeco
