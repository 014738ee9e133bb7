#pragma once
/// \file
/// The layers of the SimEco parser, third: modules, rules and all that stands in Grow. Internal to the front end.

#include <array>

#include "simeco/simeco_expressions.hpp"

namespace axil::simeco::syntax {

class RuleParser : protected ExpressionParser {
 protected:
  explicit RuleParser(std::string_view text) : ExpressionParser(text) {}

  enum class Role { Axiom, Predecessor, Successor };
  struct Hoisted {
    ExprId condition;
    ConditionPlace place;
  };
  struct LineStart {
    Token token;
    std::size_t modules;
    std::uint32_t previousEnd;
    std::optional<Hoisted> hoisted;
  };

  // ---- rules ----

  void growBody(RuleSet& rules) {
    while (!blockEnds(Level::Grow)) growItem(rules);
    closeBlock(rules.comments);
  }
  void growItem(RuleSet& rules) {
    if (is(TokenKind::Word)) {
      const TokenKind next = peek().kind;
      if (next == TokenKind::Assign) return assignment(rules);
      if (next == TokenKind::LeftBrace) return growBlock(rules);
      if ((isWord("ignore") || isWord("consider")) && next != TokenKind::LeftParen) return filter(rules);
      if (isWord("ring") && next == TokenKind::Semicolon) return ring(rules);
      if ((isWord("array") || isWord("external")) && next == TokenKind::Word) return isWord("array") ? array(rules) : externals(rules);
    }
    productionItem(rules.productions);
  }
  /// `w = A(0);`, `steps = 10;`, `seed = 3;`
  void assignment(RuleSet& rules) {
    if (isWord("seed") || isWord("steps")) {
      const bool isSeed = isWord("seed");
      advance();
      advance();
      if (isSeed)
        rules.seed = wholeNumber<std::uint64_t>("a seed", "0 to 18446744073709551615");
      else
        rules.derivationLength = expression();
      return endItem(isSeed ? "seed" : "number of steps");
    }
    Comments comments = leading();
    if (!rules.label.empty()) slip(token_.span, "there is a second axiom", "a Grow block has one axiom; remove this line or join the two");
    const bool first = rules.label.empty();
    std::string label(textOf(token_));
    advance();
    advance();
    std::vector<Module> axiom = modules(Role::Axiom);
    splitRule(axiom);
    endItem("axiom");
    trailing(comments);
    if (!first) return;
    rules.label = std::move(label);
    rules.axiom = std::move(axiom);
    rules.axiomComments = std::move(comments);
  }
  void filter(RuleSet& rules) {
    rules.filter.comments = leading();
    rules.filter.mode = isWord("ignore") ? ContextFilter::Mode::Ignore : ContextFilter::Mode::Consider;
    rules.filter.letters.clear();
    advance();
    while (is(TokenKind::Word) || is(TokenKind::LeftBracket) || is(TokenKind::RightBracket) || is(TokenKind::Question) ||
           is(TokenKind::Percent)) {
      if (token_.startsLine && is(TokenKind::Word) && (peek().kind == TokenKind::LeftParen || peek().kind == TokenKind::Assign)) break;
      rules.filter.letters.push_back(letter());
    }
    endItem("list of letters");
    trailing(rules.filter.comments);
  }
  void ring(RuleSet& rules) {
    rules.ring = true;
    advance();
    endItem("word ring");
  }
  void externals(RuleSet& rules) {
    do {
      advance();
      if (!is(TokenKind::Word)) {
        error(gap(), "a name is expected, but here " + seen());
        break;
      }
      rules.externals.emplace_back(textOf(token_));
      advance();
    } while (is(TokenKind::Comma));
    endItem("list of names");
  }
  /// `array a[2][2] = {1, 2, 3, 4};`
  void array(RuleSet& rules) {
    advance();
    ArrayDeclaration declared;
    declared.name = textOf(token_);
    advance();
    while (take(TokenKind::LeftBracket)) {
      declared.sizes.push_back(wholeNumber<int>("the size of an array", "1 or more").value_or(1));
      expect(TokenKind::RightBracket, "after the size");
    }
    if (take(TokenKind::Assign) && expect(TokenKind::LeftBrace, "before the first value") && !is(TokenKind::RightBrace)) {
      do declared.initial.push_back(expression());
      while (!panic_ && take(TokenKind::Comma));
    }
    if (is(TokenKind::RightBrace) && !declared.initial.empty()) advance();
    endItem("array");
    rules.arrays.push_back(std::move(declared));
  }
  void growBlock(RuleSet& rules) {
    const std::string_view word = textOf(token_);
    if (word == "start") return namedBlock(rules.start);
    if (word == "startEach") return namedBlock(rules.startEach);
    if (word == "endEach") return namedBlock(rules.endEach);
    if (word == "end") return namedBlock(rules.end);
    if (word == "decomposition") return subRules(rules.decomposition, rules);
    if (word == "homomorphism") return subRules(rules.homomorphism, rules);
    if (word == "interaction") return interaction(rules);
    constexpr std::string_view known[] = {"start", "startEach", "endEach", "end", "decomposition", "homomorphism", "interaction"};
    error(token_.span, "unknown block '" + std::string(word) + "' in Grow", didYouMean(word, known));
    skipItem();
  }
  void namedBlock(Block& into) {
    advance();
    into = block();
    if (panic_) skipItem();
  }
  void interaction(RuleSet& rules) {
    Comments comments;
    const SourceSpan header = token_.span;
    advance();
    openBlock(Level::SubRules, header, comments);
    while (!blockEnds(Level::SubRules)) productionItem(rules.interaction);
    closeBlock(comments);
    keep(std::move(comments), rules.interaction, rules);
  }
  void subRules(std::optional<SubRules>& into, RuleSet& rules) {
    SubRules made;
    Comments comments;
    const SourceSpan header = token_.span;
    advance();
    openBlock(Level::SubRules, header, comments);
    while (!blockEnds(Level::SubRules)) subRulesItem(made);
    closeBlock(comments);
    keep(std::move(comments), made.productions, rules);
    into = std::move(made);
  }
  void subRulesItem(SubRules& rules) {
    const TokenKind next = is(TokenKind::Word) ? peek().kind : TokenKind::End;
    if (isWord("quiet") && next == TokenKind::Semicolon) {
      rules.warnAtMaximumDepth = false;
      advance();
      advance();
    } else if ((isWord("depth") || isWord("seed")) && next == TokenKind::Assign) {
      const bool isSeed = isWord("seed");
      advance();
      advance();
      if (isSeed)
        rules.seed = wholeNumber<std::uint64_t>("a seed", "0 to 18446744073709551615");
      else
        rules.maximumDepth = wholeNumber<int>("the depth", "0 or more").value_or(1);
      endItem(isSeed ? "seed" : "depth");
    } else {
      productionItem(rules.productions);
    }
  }
  /// These blocks have no comments of their own: their rules take them.
  static void keep(Comments comments, std::vector<Production>& productions, RuleSet& rules) {
    std::vector<std::string> above = std::move(comments.before);
    if (!comments.opening.empty()) above.push_back(std::move(comments.opening));
    std::vector<std::string>& below = comments.inside;
    if (!comments.trailing.empty()) below.push_back(std::move(comments.trailing));
    std::vector<std::string>& first = productions.empty() ? rules.comments.inside : productions.front().comments.before;
    first.insert(productions.empty() ? first.end() : first.begin(), above.begin(), above.end());
    std::vector<std::string>& last = productions.empty() ? rules.comments.inside : productions.back().comments.before;
    last.insert(last.end(), below.begin(), below.end());
  }

  void productionItem(std::vector<Production>& productions) {
    Production production;
    production.comments = leading();
    production.where.begin = token_.span.begin;
    if (!isLetterStart()) {
      error(token_.span, "a rule such as A(0) -> S(1) ; is expected, but here " + seen());
      return skipItem();
    }
    hoisted_.reset();
    sides(production);
    if (is(TokenKind::Colon)) conditions(production);
    if (expect(TokenKind::Arrow, "between a rule's two sides", {}, arrowHint())) successors(production);
    placeCondition(production);
    if (production.successors.empty()) production.successors.emplace_back();
    endItem("rule");
    production.where.end = std::max(production.where.begin, previousEnd_);
    trailing(production.comments);
    if (!production.predecessor.empty()) productions.push_back(std::move(production));
  }
  void sides(Production& production) {
    production.predecessor = modules(Role::Predecessor);
    if (is(TokenKind::Less)) {
      advance();
      production.left = std::move(production.predecessor);
      production.predecessor = modules(Role::Predecessor);
    }
    if (production.predecessor.empty()) error(gap(), "the rule says nothing to rewrite", "write it between '<' and '>', or before '->'");
    if (take(TokenKind::Greater)) {
      production.right = modules(Role::Predecessor);
      if (production.right.empty()) error(gap(), "the right context after '>' is missing");
    }
  }
  /// What is often written instead of an arrow, or of a comparison in front of it.
  [[nodiscard]] std::string_view arrowHint() {
    if (is(TokenKind::Minus)) return "the arrow is ->";
    if (isWord("and")) return "write && for and";
    if (isWord("or")) return "write || for or";
    if (is(TokenKind::Assign)) return peek().kind == TokenKind::Greater ? "the arrow is ->" : "to compare, write ==";
    return {};
  }
  /// `: {before} condition {after}`
  void conditions(Production& production) {
    const Token colon = token_;
    advance();
    const bool blockFirst = is(TokenKind::LeftBrace);
    if (blockFirst) production.before = block();
    const bool conditionHere = !is(TokenKind::Arrow) && !is(TokenKind::LeftBrace);
    if (conditionHere) production.condition = expression();
    if (is(TokenKind::LeftBrace)) production.after = block();
    if (!blockFirst && !conditionHere) error(colon.span, "the condition after ':' is missing", "write it, or remove the ':'");
  }
  void placeCondition(Production& production) {
    if (!hoisted_) return;
    if (production.condition)
      return slip(grammar_.at(hoisted_->condition).where, "the rule has a second condition", "join the two with && after the ':'");
    production.condition = hoisted_->condition;
    production.conditionPlace = hoisted_->place;
  }
  void successors(Production& production) {
    do {
      Successor successor;
      if (is(TokenKind::Number) || is(TokenKind::LeftParen)) successor.weight = weight();
      successor.modules = modules(Role::Successor);
      production.successors.push_back(std::move(successor));
    } while (!panic_ && take(TokenKind::Bar));
    splitRule(production.successors.back().modules);
  }
  ExprId weight() {
    const ExprId value = is(TokenKind::Number) ? primary() : parenthesised();
    expect(TokenKind::Colon, "after a successor's weight", {}, "A(i) -> 0.7: S(1) | 0.3: L(1) ;");
    return value;
  }
  /// A rule or axiom ran on into the next rule because its ; is missing: give back the line that is the next rule.
  void splitRule(std::vector<Module>& modules) {
    if (panic_ || (!is(TokenKind::Arrow) && !is(TokenKind::Less) && !is(TokenKind::Greater) && !is(TokenKind::Colon))) return;
    if (!lineStart_)
      return error(token_.span, "'" + std::string(textOf(token_)) + "' stands in a rule for the second time",
                   "is a ';' missing before it?");
    const LineStart start = *lineStart_;
    modules.resize(start.modules);
    rewind(start.token);
    previousEnd_ = start.previousEnd;
    hoisted_ = start.hoisted;
  }

  // ---- modules ----

  [[nodiscard]] bool isLetterStart() const {
    return is(TokenKind::Word) || is(TokenKind::LeftBracket) || is(TokenKind::RightBracket) || is(TokenKind::Question) ||
           is(TokenKind::Percent);
  }
  std::vector<Module> modules(Role role) {
    std::vector<Module> list;
    int brackets = 0;
    lineStart_.reset();
    while (!panic_ && isLetterStart()) {
      if (token_.startsLine && is(TokenKind::Word)) {
        if (role != Role::Predecessor && (peek().kind == TokenKind::Assign || atBlock())) break;
        lineStart_ = LineStart{token_, list.size(), previousEnd_, hoisted_};
      }
      brackets += is(TokenKind::LeftBracket) ? 1 : is(TokenKind::RightBracket) ? -1 : 0;
      if (brackets > kMostBrackets)
        error(token_.span, "branches are nested deeper than " + std::to_string(kMostBrackets), "split the rule");
      list.push_back(module(role));
    }
    return list;
  }
  /// One letter, as it is written in a rule.
  std::string letter() {
    // A bracket may have been written in its wide form.
    std::string name(is(TokenKind::LeftBracket) ? "[" : is(TokenKind::RightBracket) ? "]" : textOf(token_));
    const bool query = is(TokenKind::Question);
    advance();
    if (query && is(TokenKind::Word)) {
      name += textOf(token_);
      advance();
    }
    return name;
  }
  Module module(Role role) {
    Module module;
    const std::uint32_t begin = token_.span.begin;
    const bool bracket = is(TokenKind::LeftBracket) || is(TokenKind::RightBracket);
    module.letter = letter();
    if (!bracket && take(TokenKind::LeftParen)) arguments(module, role);
    module.where = spanFrom(begin);
    return module;
  }
  void arguments(Module& module, Role role) {
    if (take(TokenKind::RightParen)) return;
    do {
      lastParenthesised_ = ExprId();
      const ExprId value = expression();
      if (panic_) return;
      if (isTruth(value) && value != lastParenthesised_)
        hoist(value, role);
      else
        module.arguments.push_back(value);
    } while (take(TokenKind::Comma));
    if (take(TokenKind::RightParen)) return;
    const bool goesOn =
        isLetterStart() || is(TokenKind::Semicolon) || is(TokenKind::Arrow) || is(TokenKind::End) || is(TokenKind::RightBrace);
    if (goesOn)
      missing(TokenKind::RightParen, "after the arguments of", module.letter);
    else
      expect(TokenKind::RightParen, "after the arguments of", module.letter);
  }
  /// A comparison that is an argument is the rule's condition; one in parentheses is a value.
  void hoist(ExprId condition, Role role) {
    const SourceSpan where = grammar_.at(condition).where;
    if (role == Role::Axiom)
      return slip(where, "an axiom has no condition", "put it into a rule; a comparison that is a value stands in parentheses");
    if (hoisted_) return slip(where, "the rule has a second condition", "join the two with && after a ':' (SimEco 1.1)");
    hoisted_ = Hoisted{condition, role == Role::Successor ? ConditionPlace::InSuccessor : ConditionPlace::InPredecessor};
    if (!is(TokenKind::RightParen)) slip(where, "a condition stands last in its module", "move it behind the arguments");
  }
  [[nodiscard]] bool isTruth(ExprId id) const { return id.valid() && isCondition(grammar_, id); }

  std::optional<Hoisted> hoisted_;
  std::optional<LineStart> lineStart_;
};

}  // namespace axil::simeco::syntax
