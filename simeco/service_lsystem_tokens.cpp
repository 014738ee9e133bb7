#include "simeco/lsystem_reader.hpp"
#include "simeco/service_tokens.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <set>

namespace axil::simeco {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isNamePart(char c) { return isNameStart(c) || isDigit(c); }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// How what follows a keyword on its line is read.
enum class Rest { Code, Letters, Label };
struct KeywordRow {
  std::string_view words;
  Rest rest;
};
constexpr KeywordRow kKeywords[] = {
    {"lsystem:", Rest::Label},      {"seed:", Rest::Code},          {"derivation length:", Rest::Code}, {"ring lsystem", Rest::Code},     {"ignore:", Rest::Letters},
    {"consider:", Rest::Letters},   {"define:", Rest::Code},        {"start each:", Rest::Code},        {"start:", Rest::Code},           {"end each:", Rest::Code},
    {"end:", Rest::Code},           {"extern start each:", Rest::Code}, {"extern each start:", Rest::Code}, {"extern start:", Rest::Code}, {"axiom:", Rest::Letters},
    {"maximum depth:", Rest::Code}, {"decomposition", Rest::Code},  {"homomorphism", Rest::Code},       {"interaction", Rest::Code},      {"end lsystem", Rest::Code},
};

struct KeywordHere {
  const KeywordRow* row = nullptr;
  std::size_t end = 0;
};

KeywordHere keywordAt(std::string_view text, std::size_t at) {
  if (at >= text.size() || !isNameStart(text[at])) return {};
  for (const KeywordRow& row : kKeywords) {
    if (lower(text[at]) != row.words[0]) continue;
    std::size_t i = at;
    bool fits = true;
    for (const char c : row.words) {
      if (c == ' ' || c == ':')
        while (i < text.size() && isBlank(text[i])) ++i;
      if (c == ' ') continue;
      fits = i < text.size() && lower(text[i]) == c;
      if (!fits) break;
      ++i;
    }
    if (fits && (row.words.back() == ':' || i >= text.size() || !isNamePart(text[i]))) return {&row, i};
  }
  return {};
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) { tokens_.reserve(text.size() / 2); }

  std::vector<ServiceToken> run() {
    findMacros();
    while (at_ < text_.size()) lineStart();
    return std::move(tokens_);
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  [[nodiscard]] bool sees(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  [[nodiscard]] bool atEnd() const { return at_ >= text_.size(); }

  void add(std::size_t end, TokenRole role) {
    end = std::min(end, text_.size());
    tokens_.push_back({{static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(end)}, role});
    at_ = end;
  }

  /// Names behind `#define`, wherever they stand: an editor's text may use one above.
  void findMacros() {
    for (std::size_t i = text_.find("#define"); i != std::string_view::npos; i = text_.find("#define", i + 7)) {
      std::size_t name = i + 7;
      while (name < text_.size() && (text_[name] == ' ' || text_[name] == '\t')) ++name;
      std::size_t end = name;
      while (end < text_.size() && isNamePart(text_[end])) ++end;
      if (end > name) macros_.insert(text_.substr(name, end - name));
    }
  }

  /// Blanks, comments and joined lines; stops at a line's end.
  void skip() {
    while (!atEnd()) {
      if (sees("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        add(end == std::string_view::npos ? text_.size() : end + 2, TokenRole::Comment);
      } else if (sees("//")) {
        std::size_t end = std::min(text_.find('\n', at_), text_.size());
        if (end > at_ && text_[end - 1] == '\r') --end;
        add(end, TokenRole::Comment);
      } else if (sees("\\\n")) {
        at_ += 2;
      } else if (sees("\\\r\n")) {
        at_ += 3;
      } else if (isBlank(peek())) {
        ++at_;
      } else {
        return;
      }
    }
  }
  [[nodiscard]] bool atLineEnd() const { return atEnd() || text_[at_] == '\n'; }
  void endLine() {
    if (!atEnd()) ++at_;
  }

  void lineStart() {
    const std::size_t begin = at_;
    const bool continues = peek() == '\t' && at_ > 0;
    skip();
    if (atLineEnd()) return endLine();
    if (peek() == '#' && isDirective(begin)) return directive();
    const KeywordHere keyword = keywordAt(text_, at_);
    if (keyword.row != nullptr && (depth_ == 0 || !insideBlock(*keyword.row)) && !(continues && depth_ == 0)) {
      depth_ = parens_ = 0;
      rest_ = keyword.row->rest;
      rule_ = false;
      add(keyword.end, TokenRole::Keyword);
    } else if (depth_ == 0 && !continues) {
      rest_ = Rest::Letters;
      rule_ = true;
      parens_ = 0;
    }
    if (rest_ == Rest::Label) return label();
    for (skip(); !atLineEnd(); skip()) rest_ == Rest::Code || parens_ > 0 || depth_ > 0 ? code() : letters();
    endLine();
  }
  /// `start` and `end` may also be names in a block; the others close a block that was left open.
  static bool insideBlock(const KeywordRow& row) { return row.words.back() != ':' && row.words != "end lsystem"; }

  void label() {
    rest_ = Rest::Code;
    skip();
    std::size_t end = at_;
    while (end < text_.size() && text_[end] != '\n' && !text_.substr(end).starts_with("//") && !text_.substr(end).starts_with("/*")) ++end;
    const std::size_t next = end;
    while (end > at_ && isBlank(text_[end - 1])) --end;
    if (end > at_) add(end, TokenRole::Text);
    at_ = next;
    skip();
    if (atLineEnd()) endLine();
  }

  // ---- directives

  [[nodiscard]] bool isDirective(std::size_t lineBegin) const {
    if (at_ == lineBegin) return true;
    static const std::set<std::string_view> kNames{"define", "undef", "include", "if", "ifdef", "ifndef", "elif", "else", "endif", "pragma", "error", "warning"};
    return kNames.contains(directiveName());
  }
  [[nodiscard]] std::string_view directiveName() const {
    std::size_t begin = at_ + 1;
    while (begin < text_.size() && (text_[begin] == ' ' || text_[begin] == '\t')) ++begin;
    std::size_t end = begin;
    while (end < text_.size() && isNamePart(text_[end])) ++end;
    return text_.substr(begin, end - begin);
  }
  void directive() {
    const std::string_view name = directiveName();
    const std::size_t end = name.empty() ? at_ + 1 : static_cast<std::size_t>(name.data() - text_.data()) + name.size();
    add(end, TokenRole::Directive);
    const int depth = depth_;
    for (skip(); !atLineEnd(); skip()) code();
    depth_ = depth;
    endLine();
  }

  // ---- strings of letters

  void letters() {
    const char c = peek();
    if (sees("-->") || sees("\u2192")) return add(at_ + 3, TokenRole::Sign);
    if (c == '(') {
      ++parens_;
      return add(at_ + 1, TokenRole::Separator);
    }
    if (c == '[' || c == ']') return add(at_ + 1, TokenRole::Branch);
    if (rule_ && (c == '<' || c == '>')) return add(at_ + 1, TokenRole::Sign);
    if (rule_ && c == ':') {
      rest_ = Rest::Code;
      return add(at_ + 1, TokenRole::Sign);
    }
    if (c == '*') return add(at_ + 1, TokenRole::Operator);
    if (c == ')' || c == ':' || c == '<' || c == '>' || static_cast<unsigned char>(c) >= 0x80 || static_cast<unsigned char>(c) < ' ')
      return add(at_ + utf8Length(c), TokenRole::Unknown);
    if (!isNamePart(c)) return add(at_ + 1, TokenRole::Module);
    std::size_t end = at_;
    while (end < text_.size() && isNamePart(text_[end])) ++end;
    if (macros_.contains(text_.substr(at_, end - at_))) return add(end, TokenRole::Macro);
    while (at_ < end) add(at_ + 1, TokenRole::Module);
  }

  // ---- expressions and statements

  void code() {
    const char c = peek();
    if (rule_ && depth_ == 0 && parens_ == 0 && (sees("-->") || sees("\u2192"))) {
      rest_ = Rest::Letters;
      return add(at_ + 3, TokenRole::Sign);
    }
    if (c == '"') return quoted();
    if (isDigit(c) || (c == '.' && isDigit(peek(1)))) return number();
    if (isNameStart(c)) return name();
    if (c == '(' && parens_ > 0) ++parens_;
    if (c == ')' && parens_ > 0) --parens_;
    if (c == '{') ++depth_;
    if (c == '}' && depth_ > 0) --depth_;
    if (std::string_view("(){}[],;").find(c) != std::string_view::npos) return add(at_ + 1, TokenRole::Separator);
    for (const std::string_view op : {"<=", ">=", "==", "!=", "<>", "&&", "||"})
      if (sees(op)) return add(at_ + 2, TokenRole::Operator);
    if (std::string_view("+-*/%^<>=!&|?:").find(c) != std::string_view::npos) return add(at_ + 1, TokenRole::Operator);
    add(at_ + utf8Length(c), TokenRole::Unknown);
  }
  void quoted() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') end += text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] != '\n' ? 2u : 1u;
    add(end < text_.size() && text_[end] == '"' ? end + 1 : end, TokenRole::Text);
  }
  void number() {
    std::size_t end = at_;
    while (end < text_.size() && (isNamePart(text_[end]) || text_[end] == '.')) {
      const bool exponent = text_[end] == 'e' || text_[end] == 'E';
      ++end;
      if (exponent && end + 1 < text_.size() && (text_[end] == '+' || text_[end] == '-') && isDigit(text_[end + 1])) ++end;
    }
    add(end, TokenRole::Number);
  }
  void name() {
    static const std::set<std::string_view> kWords{"if", "else", "while", "do", "array", "external", "no", "warnings"};
    std::size_t end = at_;
    while (end < text_.size() && isNamePart(text_[end])) ++end;
    const std::string_view word = text_.substr(at_, end - at_);
    std::size_t next = end;
    while (next < text_.size() && isBlank(text_[next])) ++next;
    const bool called = next < text_.size() && text_[next] == '(';
    if (macros_.contains(word)) return add(end, TokenRole::Macro);
    if (depth_ > 0 || word == "no" || word == "warnings" ? kWords.contains(word) : false) return add(end, TokenRole::Keyword);
    add(end, called && lsystemFunction(word) != nullptr ? TokenRole::Function : TokenRole::Name);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<ServiceToken> tokens_;
  std::set<std::string_view> macros_;
  Rest rest_ = Rest::Letters;
  bool rule_ = false;   ///< the line is a rule: < > : mean something
  int depth_ = 0;       ///< open braces
  int parens_ = 0;      ///< open parentheses of a parameter list
};

}  // namespace

std::vector<ServiceToken> lsystemTokens(std::string_view text) { return Scanner(text).run(); }

std::optional<std::size_t> lsystemKeywordEnd(std::string_view text, std::size_t at) {
  const KeywordHere keyword = keywordAt(text, at);
  return keyword.row == nullptr ? std::nullopt : std::optional(keyword.end);
}

}  // namespace axil::simeco
