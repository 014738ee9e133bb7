#pragma once
/// \file
/// The layers of the L-system parser, third: one production. Internal to the front end.

#include "simeco/lsystem_header.hpp"

#include <utility>

namespace axil::simeco::classic {

class RuleParser : protected HeaderParser {
 public:
  using HeaderParser::HeaderParser;

 protected:
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
      ended_ = ended_ || meant.find("endlsystem") != std::string::npos;
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
};

}  // namespace axil::simeco::classic
