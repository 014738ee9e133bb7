// SimEco text to Grammar, by recursive descent. After an error the parser goes on at the next place where an item can start,
// so that one mistake gives one message and the mistakes behind it are found as well.
#include "base/text.hpp"
#include "simeco/language.hpp"
#include "simeco/lexer.hpp"
#include "simeco/report.hpp"
#include "simeco/vocabulary.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace axil::simeco {

namespace {

enum class Level { Ecosystem, Plant, Organ, Stage, Grow, SubRules };

/// A block whose } has not come yet.
struct OpenBlock {
  Level level;
  SourceSpan header;  ///< `Stage 3`, for messages
};

struct OperatorRow {
  TokenKind token;
  BinaryOp op;
  int binding;
};
// Comparisons are parsed apart, since they chain; ^ apart, since it binds to the right.
constexpr int kOrBinding = 1, kAndBinding = 2, kComparisonBinding = 3, kSumBinding = 4, kProductBinding = 5;
constexpr OperatorRow kOperators[] = {
    {TokenKind::OrOr, BinaryOp::Or, kOrBinding},          {TokenKind::AndAnd, BinaryOp::And, kAndBinding},
    {TokenKind::Plus, BinaryOp::Add, kSumBinding},        {TokenKind::Minus, BinaryOp::Subtract, kSumBinding},
    {TokenKind::Star, BinaryOp::Multiply, kProductBinding}, {TokenKind::Slash, BinaryOp::Divide, kProductBinding},
    {TokenKind::Percent, BinaryOp::Remainder, kProductBinding},
};
constexpr std::pair<TokenKind, BinaryOp> kComparisons[] = {
    {TokenKind::Less, BinaryOp::Less},       {TokenKind::LessEqual, BinaryOp::LessEqual}, {TokenKind::Greater, BinaryOp::Greater},
    {TokenKind::GreaterEqual, BinaryOp::GreaterEqual}, {TokenKind::Equal, BinaryOp::Equal}, {TokenKind::NotEqual, BinaryOp::NotEqual},
};

const OperatorRow* operatorOf(TokenKind kind) {
  for (const OperatorRow& row : kOperators)
    if (row.token == kind) return &row;
  return nullptr;
}

std::optional<BinaryOp> comparisonOf(TokenKind kind) {
  for (const auto& [token, op] : kComparisons)
    if (token == kind) return op;
  return std::nullopt;
}

std::string_view signOf(TokenKind kind) {
  switch (kind) {
    case TokenKind::LeftBrace: return "{";
    case TokenKind::RightBrace: return "}";
    case TokenKind::LeftParen: return "(";
    case TokenKind::RightParen: return ")";
    case TokenKind::RightBracket: return "]";
    case TokenKind::Comma: return ",";
    case TokenKind::Semicolon: return ";";
    case TokenKind::Assign: return "=";
    case TokenKind::Colon: return ":";
    case TokenKind::Arrow: return "->";
    default: return "?";
  }
}

/// The words of `text` between its quotes; a doubled quote is one.
std::string unquoted(std::string_view text) {
  if (text.starts_with("“") || text.starts_with("”")) text.remove_prefix(std::string_view("“").size());
  else text.remove_prefix(1);
  if (text.ends_with("“") || text.ends_with("”")) text.remove_suffix(std::string_view("“").size());
  else if (text.ends_with('"')) text.remove_suffix(1);
  std::string words;
  words.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    words += text[i];
    if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
  }
  while (words.ends_with('\r')) words.pop_back();
  return words;
}

/// The number as it will be printed again: its decimals are kept where that gives back the value.
Number literal(std::string_view text, double value) {
  std::size_t decimals = 0;
  bool afterPoint = false;
  bool plain = !(value == 0 && std::signbit(value));
  for (const char c : text) {
    if (afterPoint) ++decimals;
    if (c == '.') afterPoint = true;
    if (c == 'e' || c == 'E') plain = false;
  }
  constexpr std::size_t kMostKept = 17;
  return {value, plain && decimals <= kMostKept ? static_cast<int>(decimals) : -1};
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text), lexer_(text, report_) {
    grammar_.expressions.reserve(text.size() / 20);
    depths_.reserve(text.size() / 20);
    advance();
  }

  Parsed run() {
    file();
    return {std::move(grammar_), report_.take()};
  }

 private:
  // ---- tokens ----

  void advance() {
    previousEnd_ = token_.span.end;
    if (peeked_) {
      token_ = *peeked_;
      peeked_.reset();
    } else {
      token_ = lexer_.next();
    }
  }
  const Token& peek() {
    if (!peeked_) peeked_ = lexer_.next();
    return *peeked_;
  }
  void rewind(const Token& token) {
    peeked_.reset();
    lexer_.rewind(token);
    token_ = lexer_.next();
  }
  [[nodiscard]] bool is(TokenKind kind) const { return token_.kind == kind; }
  [[nodiscard]] bool isWord(std::string_view word) const { return is(TokenKind::Word) && textOf(token_) == word; }
  [[nodiscard]] std::string_view textOf(const Token& token) const { return textOf(token.span); }
  [[nodiscard]] std::string_view textOf(SourceSpan span) const { return text_.substr(span.begin, span.end - span.begin); }
  [[nodiscard]] SourceSpan spanFrom(std::uint32_t begin) const { return {begin, std::max(begin, previousEnd_)}; }
  bool take(TokenKind kind) {
    if (!is(kind)) return false;
    advance();
    return true;
  }

  // ---- trouble ----

  /// The first error of an item is told, what follows from it is not.
  void error(SourceSpan span, std::string message, std::string hint = {}) {
    if (panic_) return;
    panic_ = true;
    report_.error(span, std::move(message), std::move(hint));
  }
  /// An error that does not spoil what comes after it.
  void slip(SourceSpan span, std::string message, std::string hint = {}) {
    if (!panic_) report_.error(span, std::move(message), std::move(hint));
  }
  [[nodiscard]] std::string seen() const {
    if (is(TokenKind::End)) return "the file ends";
    constexpr std::size_t kLongest = 24;
    const std::string_view text = textOf(token_);
    if (countCharacters(text) <= kLongest) return "'" + std::string(text) + "' stands";
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < kLongest; ++i) bytes += utf8Length(text[bytes]);
    return "'" + std::string(text.substr(0, bytes)) + "…' stands";
  }
  /// Where something is missing: at the token, or right behind the last one when the line ended there.
  [[nodiscard]] SourceSpan gap() const {
    return token_.startsLine || is(TokenKind::End) ? SourceSpan{previousEnd_ > 0 ? previousEnd_ - 1 : 0, previousEnd_} : token_.span;
  }
  /// "after the arguments of" "rotr": the words are only put together when they are needed.
  static std::string placeWords(std::string_view where, std::string_view subject) {
    return std::string(where) + (subject.empty() ? "" : " '" + std::string(subject) + "'");
  }
  void missing(TokenKind kind, std::string_view where, std::string_view subject) {
    slip(gap(), "missing '" + std::string(signOf(kind)) + "' " + placeWords(where, subject));
  }
  bool expect(TokenKind kind, std::string_view where, std::string_view subject = {}) {
    if (take(kind)) return true;
    error(gap(), "'" + std::string(signOf(kind)) + "' is expected " + placeWords(where, subject) + ", but here " + seen());
    return false;
  }
  void endItem(const char* what) {
    if (panic_) return skipItem();
    if (take(TokenKind::Semicolon)) return;
    if (token_.startsLine || is(TokenKind::RightBrace) || is(TokenKind::End)) {
      slip({previousEnd_ > 0 ? previousEnd_ - 1 : 0, previousEnd_}, std::string("missing ';' after the ") + what, "end it with ';'");
      return;
    }
    error(token_.span, std::string("';' is expected after the ") + what + ", but here " + seen());
    skipItem();
  }
  /// To where the next item can start.
  void skipItem() {
    panic_ = false;
    std::size_t depth = 0;
    for (bool first = true; !is(TokenKind::End); first = false) {
      if (depth == 0 && !first && startsItem()) return;
      if (is(TokenKind::LeftBrace)) ++depth;
      if (is(TokenKind::RightBrace)) {
        if (depth == 0) return;
        if (--depth == 0) return advance();
      }
      if (is(TokenKind::Semicolon) && depth == 0) return advance();
      advance();
    }
  }
  [[nodiscard]] bool startsItem() {
    if (!token_.startsLine || !is(TokenKind::Word)) return false;
    if (peek().kind == TokenKind::Assign || peek().kind == TokenKind::LeftBrace) return true;
    const std::size_t lineEnd = text_.find('\n', token_.span.begin);
    constexpr std::size_t kLongestLook = 4096;
    const std::string_view line = text_.substr(token_.span.begin, std::min(lineEnd - token_.span.begin, kLongestLook));
    return line.find("->") != std::string_view::npos || atBlock();
  }
  /// Whether a block with a keyword starts here.
  [[nodiscard]] bool atBlock() {
    if (!is(TokenKind::Word)) return false;
    const TokenKind next = peek().kind;
    if (next != TokenKind::LeftBrace && next != TokenKind::Text && next != TokenKind::Number) return false;
    const std::string_view word = textOf(token_);
    if (word == "Plant") return next != TokenKind::Number;
    if (word == "Stage") return next == TokenKind::Number;
    return (word == "Grow" || organOfKeyword(word)) && next == TokenKind::LeftBrace;
  }

  // ---- comments ----

  [[nodiscard]] std::string commentText(const CommentToken& comment) const {
    std::string text(textOf(comment.span));
    std::erase(text, '\r');
    if (text.starts_with("//"))
      while (text.ends_with(' ') || text.ends_with('\t')) text.pop_back();
    else if (!text.ends_with("*/") || text.size() < 4)
      text += "*/";  // never closed; reported
    return text;
  }
  /// Comments in front of byte `end`, as lines; a blank line above one, or above what follows, is an empty line.
  void takeLines(std::vector<std::string>& lines, std::uint32_t end) {
    std::vector<CommentToken>& pending = lexer_.comments();
    std::size_t taken = 0;
    for (; taken < pending.size() && pending[taken].span.begin < end; ++taken) {
      if (pending[taken].blankBefore && !firstInBlock_) lines.emplace_back();
      firstInBlock_ = false;
      lines.push_back(commentText(pending[taken]));
    }
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(taken));
  }
  /// Comments that go on with the line of the token before.
  void takeRestOfLine(std::string& line) {
    std::vector<CommentToken>& pending = lexer_.comments();
    std::size_t taken = 0;
    while (taken < pending.size() && !pending[taken].startsLine && pending[taken].span.begin < token_.span.begin) {
      if (!line.empty()) line += ' ';
      line += commentText(pending[taken++]);
    }
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(taken));
  }
  [[nodiscard]] Comments leading() {
    Comments comments;
    if (!lexer_.comments().empty()) takeLines(comments.before, token_.span.begin);
    if (token_.blankBefore && !firstInBlock_) comments.before.emplace_back();
    firstInBlock_ = false;
    return comments;
  }
  /// Comments inside the item move above it; those behind it on its line stay.
  void trailing(Comments& comments) {
    if (lexer_.comments().empty()) return;
    takeLines(comments.before, previousEnd_);
    takeRestOfLine(comments.trailing);
  }

  // ---- blocks ----

  void openBlock(Level level, SourceSpan header, Comments& comments) {
    if (panic_) recoverHeader();
    if (!is(TokenKind::LeftBrace)) missing(TokenKind::LeftBrace, "after", textOf(header));
    open_.push_back({level, header});
    if (is(TokenKind::LeftBrace)) advance();
    if (!lexer_.comments().empty()) {
      takeLines(comments.before, previousEnd_);
      takeRestOfLine(comments.opening);
    }
    firstInBlock_ = true;
  }
  /// A broken header: its block starts at the next { of the same line or of the line below.
  void recoverHeader() {
    panic_ = false;
    while (!is(TokenKind::LeftBrace) && !is(TokenKind::RightBrace) && !is(TokenKind::Semicolon) && !is(TokenKind::End) && !token_.startsLine) advance();
  }
  void closeBlock(Comments& comments) {
    const OpenBlock block = open_.back();
    open_.pop_back();
    if (!lexer_.comments().empty()) takeLines(comments.inside, token_.span.begin);
    firstInBlock_ = false;
    if (take(TokenKind::RightBrace)) {
      if (!lexer_.comments().empty()) takeRestOfLine(comments.trailing);
      return;
    }
    if (!is(TokenKind::End)) {
      slip(token_.span, "missing '}': '" + std::string(textOf(block.header)) + "' is still open where " + seen(), "close it with '}' above");
    } else if (!endReported_) {
      endReported_ = true;
      const std::size_t count = open_.size() + 1;
      report_.error(gap(), "the file ends inside '" + std::string(textOf(block.header)) + "'; " + std::to_string(count) +
                               (count == 1 ? " '}' is missing" : " '}' are missing"),
                    "close every block that is open, or look for a '}' that was lost above");
    }
  }
  /// Whether a block of `level` is over: at its }, at the end, or because something starts that cannot be inside it.
  [[nodiscard]] bool blockEnds(Level level) {
    if (is(TokenKind::RightBrace) || is(TokenKind::End)) return true;
    if (!is(TokenKind::Word) || level == Level::Ecosystem || !atBlock()) return false;
    const std::string_view word = textOf(token_);
    if (word == "Plant") return true;
    if (level == Level::Plant) return false;
    if (word == "Stage") return level == Level::Stage;
    return true;
  }

  // ---- file ----

  void file() {
    grammar_.comments = leading();
    // Comments above `EcoSystem` head the file.
    const std::uint32_t begin = token_.span.begin;
    if (!header()) return;
    openBlock(Level::Ecosystem, spanFrom(begin), grammar_.comments);
    ecosystemBody();
    while (!is(TokenKind::End)) {
      if (atBlock()) {
        oneBraceTooMany();
        open_.push_back({Level::Ecosystem, {begin, begin}});
        ecosystemBody();
        continue;
      }
      slip(token_.span, "after the last '}' of the ecosystem " + seen(), is(TokenKind::RightBrace) ? "remove it, or look for a '{' that was lost above" : "a file holds one EcoSystem");
      while (!is(TokenKind::End) && !atBlock()) advance();
    }
    takeLines(grammar_.closing, static_cast<std::uint32_t>(text_.size()));
  }

  bool header() {
    constexpr std::string_view kEcosystem[] = {"EcoSystem"};
    if (!isWord("EcoSystem")) {
      const std::string_view meant = is(TokenKind::Word) ? nearest(textOf(token_), kEcosystem) : std::string_view{};
      if (meant.empty()) {
        report_.error(token_.span, is(TokenKind::End) ? "the file says nothing" : "a SimEco file starts with EcoSystem, but here " + seen(),
                      "begin with: EcoSystem 1.0 \"name\" {");
        return false;
      }
      slip(token_.span, "unknown word '" + std::string(textOf(token_)) + "'", "did you mean 'EcoSystem'?");
    }
    advance();
    version();
    grammar_.name = nameOf("ecosystem");
    return true;
  }
  void version() {
    if (!is(TokenKind::Number)) return slip(gap(), "the version is missing after EcoSystem", "write EcoSystem 1.0");
    const std::string_view said = textOf(token_);
    if (std::find(std::begin(kVersions), std::end(kVersions), said) == std::end(kVersions))
      slip(token_.span, "version " + std::string(said) + " is not known", "this program reads 1.0 and 1.1");
    else
      grammar_.version = said;
    advance();
  }
  std::string nameOf(const char* what) {
    const bool bare = is(TokenKind::Word) && !token_.startsLine;
    if (!bare && !is(TokenKind::Text)) {
      slip(gap(), std::string("the ") + what + "'s name is missing", "write it in quotes: \"name\"");
      return {};
    }
    std::string name = bare ? std::string(textOf(token_)) : unquoted(textOf(token_));
    if (bare) slip(token_.span, std::string("the ") + what + "'s name must stand in quotes", "write \"" + name + "\"");
    advance();
    return name;
  }
  void oneBraceTooMany() { slip(token_.span, "'" + std::string(textOf(token_)) + "' stands outside the block it belongs to", "there is one '}' too many above"); }

  void ecosystemBody() {
    while (!blockEnds(Level::Ecosystem)) {
      if (isBlockWord("Plant", TokenKind::Text)) {
        plant();
      } else if (atBlock() || isModuleStart()) {
        reenterPlant();
      } else {
        attribute(grammar_.attributes, Level::Ecosystem);
      }
    }
    closeBlock(grammar_.comments);
  }
  /// What belongs into a plant stands behind its }: go on in the last plant.
  void reenterPlant() {
    if (grammar_.plants.empty()) {
      slip(token_.span, "'" + std::string(textOf(token_)) + "' stands outside a Plant", "put it into Plant \"name\" { ... }");
      grammar_.plants.emplace_back();
    } else {
      oneBraceTooMany();
    }
    open_.push_back({Level::Plant, grammar_.plants.back().where});
    plantBody(grammar_.plants.back());
  }
  /// `keyword` followed by `next`, as it is or nearly.
  bool isBlockWord(std::string_view keyword, TokenKind next) {
    if (!is(TokenKind::Word)) return false;
    const std::string_view word = textOf(token_);
    if (word == keyword) return peek().kind == next || peek().kind == TokenKind::LeftBrace || (word == "Grow" && losesBrace());
    const std::string_view known[] = {keyword};
    if (peek().kind != next || nearest(word, known).empty()) return false;
    slip(token_.span, "unknown word '" + std::string(word) + "'", didYouMean(word, known));
    return true;
  }
  /// A keyword alone on its line: its { is missing.
  [[nodiscard]] bool losesBrace() { return token_.startsLine && peek().startsLine && peek().kind == TokenKind::Word; }
  [[nodiscard]] bool isModuleStart() { return is(TokenKind::LeftBracket) || (is(TokenKind::Word) && peek().kind == TokenKind::LeftParen); }

  void plant() {
    PlantGrammar plant;
    plant.comments = leading();
    const std::uint32_t begin = token_.span.begin;
    advance();
    plant.name = nameOf("plant");
    plant.where = spanFrom(begin);
    openBlock(Level::Plant, plant.where, plant.comments);
    hasGrow_ = false;
    plantBody(plant);
    grammar_.plants.push_back(std::move(plant));
  }
  void plantBody(PlantGrammar& plant) {
    while (!blockEnds(Level::Plant)) {
      if (const auto kind = organHere()) {
        organ(plant, *kind);
      } else if (isBlockWord("Grow", TokenKind::LeftBrace)) {
        grow(plant);
      } else if (isBlockWord("Stage", TokenKind::Number)) {
        reenterOrgan(plant);
      } else if (isModuleStart()) {
        reenterGrow(plant);
      } else {
        attribute(plant.attributes, Level::Plant);
      }
    }
    plant.where.end = std::max(plant.where.end, previousEnd_);
    closeBlock(plant.comments);
  }
  void reenterOrgan(PlantGrammar& plant) {
    if (plant.organs.empty()) {
      slip(token_.span, "a Stage stands outside an organ", "put it into Stem { ... }, Leaf { ... } or another organ");
      plant.organs.push_back({OrganKind::Stem, {}, {}, {}, token_.span});
      return stage(plant.organs.back());
    }
    oneBraceTooMany();
    open_.push_back({Level::Organ, plant.organs.back().where});
    organBody(plant.organs.back());
  }
  void reenterGrow(PlantGrammar& plant) {
    if (!hasGrow_) slip(token_.span, "a rule stands outside Grow", "put it into Grow { ... }");
    else oneBraceTooMany();
    hasGrow_ = true;
    open_.push_back({Level::Grow, token_.span});
    growBody(plant.rules);
  }

  /// The organ whose block starts here; a keyword that is nearly one counts, and is reported.
  std::optional<OrganKind> organHere() {
    if (!is(TokenKind::Word)) return std::nullopt;
    const std::string_view word = textOf(token_);
    const auto kind = organOfKeyword(word);
    if (kind && losesBrace()) return kind;
    if (peek().kind != TokenKind::LeftBrace) return std::nullopt;
    if (kind) return kind;
    constexpr std::string_view known[] = {"Apex", "Stem", "Leaf", "Root", "Fruit", "Flower", "Grow"};
    const std::string_view meant = nearest(word, known);
    if (meant.empty() || meant == "Grow") return std::nullopt;
    slip(token_.span, "unknown organ '" + std::string(word) + "'", "did you mean '" + std::string(meant) + "'?");
    return organOfKeyword(meant);
  }
  void organ(PlantGrammar& plant, OrganKind kind) {
    OrganBlock block;
    block.kind = kind;
    block.comments = leading();
    block.where = token_.span;
    advance();
    openBlock(Level::Organ, block.where, block.comments);
    organBody(block);
    plant.organs.push_back(std::move(block));
  }
  void organBody(OrganBlock& block) {
    while (!blockEnds(Level::Organ)) {
      if (isBlockWord("Stage", TokenKind::Number))
        stage(block);
      else
        attribute(block.attributes, Level::Organ);
    }
    closeBlock(block.comments);
  }
  void stage(OrganBlock& block) {
    Stage stage;
    stage.comments = leading();
    const std::uint32_t begin = token_.span.begin;
    advance();
    const std::optional<int> number = stageNumber();
    stage.where = spanFrom(begin);
    openBlock(Level::Stage, stage.where, stage.comments);
    while (!blockEnds(Level::Stage)) attribute(stage.attributes, Level::Stage);
    closeBlock(stage.comments);
    if (!number) return;
    stage.number = *number;
    block.stages.push_back(std::move(stage));
  }
  std::optional<int> stageNumber() {
    if (is(TokenKind::Number)) return wholeNumber<int>("a stage's number", "0 to 2147483647");
    slip(gap(), "a Stage needs its number", "write Stage 1 { ... }");
    return std::nullopt;
  }
  template <class T>
  std::optional<T> wholeNumber(const char* what, const char* range) {
    T value{};
    const std::string_view said = textOf(token_);
    const auto [end, code] = std::from_chars(said.data(), said.data() + said.size(), value);
    const bool good = is(TokenKind::Number) && code == std::errc{} && end == said.data() + said.size();
    if (!good) error(is(TokenKind::End) ? gap() : token_.span, std::string(what) + " must be a whole number, " + range + ", but here " + seen());
    if (is(TokenKind::Number)) advance();
    return good ? std::optional<T>(value) : std::nullopt;
  }

  void attribute(std::vector<Attribute>& attributes, Level level) {
    Attribute attribute;
    attribute.comments = leading();
    const std::uint32_t begin = token_.span.begin;
    if (!is(TokenKind::Word) || peek().kind == TokenKind::LeftBrace || peek().kind == TokenKind::Text) {
      unknownItem(level);
      return;
    }
    attribute.name = textOf(token_);
    advance();
    if (expect(TokenKind::Assign, "after", attribute.name)) attribute.value = expression();
    const bool said = attribute.value.valid() && !panic_;
    endItem("value");
    attribute.where = spanFrom(begin);
    trailing(attribute.comments);
    if (said) attributes.push_back(std::move(attribute));
  }
  void unknownItem(Level level) {
    constexpr std::string_view inStage = "an attribute such as GrowRate = 0.1;";
    constexpr std::string_view inOrgan = "Stage n { ... } or an attribute";
    constexpr std::string_view inPlant = "an attribute, Apex, Stem, Leaf, Root, Fruit, Flower or Grow";
    constexpr std::string_view inEcosystem = "an attribute or Plant \"name\" { ... }";
    const std::string_view wanted = level == Level::Stage ? inStage : level == Level::Organ ? inOrgan : level == Level::Plant ? inPlant : inEcosystem;
    error(token_.span, std::string(wanted) + " is expected, but here " + seen());
    skipItem();
  }

  // ---- rules ----

  void grow(PlantGrammar& plant) {
    RuleSet further;
    RuleSet& rules = hasGrow_ ? further : plant.rules;
    rules.comments = leading();
    const SourceSpan header = token_.span;
    advance();
    openBlock(Level::Grow, header, rules.comments);
    growBody(rules);
    if (hasGrow_) plant.subRules.push_back(std::move(further));
    hasGrow_ = true;
  }
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
      if (isSeed) rules.seed = wholeNumber<std::uint64_t>("a seed", "0 to 18446744073709551615");
      else rules.derivationLength = expression();
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
    while (is(TokenKind::Word) || is(TokenKind::LeftBracket) || is(TokenKind::RightBracket) || is(TokenKind::Question) || is(TokenKind::Percent)) {
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
      if (isSeed) rules.seed = wholeNumber<std::uint64_t>("a seed", "0 to 18446744073709551615");
      else rules.maximumDepth = wholeNumber<int>("the depth", "0 or more").value_or(1);
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
    if (expect(TokenKind::Arrow, "between a rule's two sides")) successors(production);
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
    if (production.condition) return slip(grammar_.at(hoisted_->condition).where, "the rule has a second condition", "join the two with && after the ':'");
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
    expect(TokenKind::Colon, "after a successor's weight");
    return value;
  }
  /// A rule or axiom ran on into the next rule because its ; is missing: give back the line that is the next rule.
  void splitRule(std::vector<Module>& modules) {
    if (panic_ || (!is(TokenKind::Arrow) && !is(TokenKind::Less) && !is(TokenKind::Greater) && !is(TokenKind::Colon))) return;
    if (!lineStart_) return error(token_.span, "'" + std::string(textOf(token_)) + "' stands in a rule for the second time", "is a ';' missing before it?");
    const LineStart start = *lineStart_;
    modules.resize(start.modules);
    rewind(start.token);
    previousEnd_ = start.previousEnd;
    hoisted_ = start.hoisted;
  }

  // ---- modules ----

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

  [[nodiscard]] bool isLetterStart() const {
    return is(TokenKind::Word) || is(TokenKind::LeftBracket) || is(TokenKind::RightBracket) || is(TokenKind::Question) || is(TokenKind::Percent);
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
      if (brackets > kMostBrackets) error(token_.span, "branches are nested deeper than " + std::to_string(kMostBrackets), "split the rule");
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
      if (isTruth(value) && value != lastParenthesised_) hoist(value, role);
      else module.arguments.push_back(value);
    } while (take(TokenKind::Comma));
    if (take(TokenKind::RightParen)) return;
    const bool goesOn = isLetterStart() || is(TokenKind::Semicolon) || is(TokenKind::Arrow) || is(TokenKind::End) || is(TokenKind::RightBrace);
    if (goesOn) missing(TokenKind::RightParen, "after the arguments of", module.letter);
    else expect(TokenKind::RightParen, "after the arguments of", module.letter);
  }
  /// A comparison that is an argument is the rule's condition; one in parentheses is a value.
  void hoist(ExprId condition, Role role) {
    const SourceSpan where = grammar_.at(condition).where;
    if (role == Role::Axiom) return slip(where, "an axiom has no condition", "put it into a rule; a comparison that is a value stands in parentheses");
    if (hoisted_) return slip(where, "the rule has a second condition", "join the two with && after a ':' (SimEco 1.1)");
    hoisted_ = Hoisted{condition, role == Role::Successor ? ConditionPlace::InSuccessor : ConditionPlace::InPredecessor};
    if (!is(TokenKind::RightParen)) slip(where, "a condition stands last in its module", "move it behind the arguments");
  }
  [[nodiscard]] bool isTruth(ExprId id) const { return id.valid() && isCondition(grammar_, id); }

  // ---- statements ----

  Block block() {
    Block statements;
    if (!expect(TokenKind::LeftBrace, "before the statements")) return statements;
    if (++nesting_ > kMostDepth) error(token_.span, "statements are nested deeper than " + std::to_string(kMostDepth));
    while (!is(TokenKind::RightBrace) && !is(TokenKind::End) && !is(TokenKind::Arrow)) {
      if (!panic_) statements.push_back(statement());
      if (panic_) skipStatement();
    }
    --nesting_;
    if (!panic_) expect(TokenKind::RightBrace, "after the statements");
    return statements;
  }
  void skipStatement() {
    panic_ = false;
    std::size_t depth = 0;
    for (; !is(TokenKind::End) && !is(TokenKind::Arrow); advance()) {
      if (is(TokenKind::LeftBrace)) ++depth;
      if (is(TokenKind::RightBrace) && depth-- == 0) return;
      if (is(TokenKind::Semicolon) && depth == 0) return advance();
    }
  }
  Statement statement() {
    Statement made;
    const std::uint32_t begin = token_.span.begin;
    if (isWord("if")) made.node = ifStatement();
    else if (isWord("while")) made.node = whileStatement();
    else if (isWord("do")) made.node = doStatement();
    else made.node = simpleStatement();
    made.where = spanFrom(begin);
    return made;
  }
  ExprId parenthesised() {
    if (!expect(TokenKind::LeftParen, "before the expression")) return zero();
    const ExprId value = expression();
    expect(TokenKind::RightParen, "after the expression");
    return value;
  }
  If ifStatement() {
    If made;
    advance();
    made.condition = parenthesised();
    made.yes = block();
    if (!panic_ && isWord("else")) {
      advance();
      made.no = block();
    }
    return made;
  }
  While whileStatement() {
    While made;
    advance();
    made.condition = parenthesised();
    if (!panic_) made.body = block();
    return made;
  }
  While doStatement() {
    While made;
    made.testFirst = false;
    advance();
    made.body = block();
    if (!panic_ && !isWord("while")) error(gap(), "'while' is expected after do { ... }, but here " + seen());
    if (panic_) return made;
    advance();
    made.condition = parenthesised();
    expect(TokenKind::Semicolon, "after do { ... } while (...)");
    return made;
  }
  std::variant<Assign, AssignElement, Evaluate, If, While> simpleStatement() {
    const ExprId value = expression();
    if (!panic_ && is(TokenKind::Assign)) {
      const ExprNode target = grammar_.at(value).node;
      const SourceSpan where = grammar_.at(value).where;
      advance();
      const ExprId assigned = expression();
      expect(TokenKind::Semicolon, "after the statement");
      if (const auto* name = std::get_if<Name>(&target)) return Assign{name->name, assigned};
      if (const auto* element = std::get_if<Element>(&target)) return AssignElement{element->array, element->indices, assigned};
      error(where, "only a name or an array's element can be given a value");
      return Evaluate{assigned};
    }
    expect(TokenKind::Semicolon, "after the statement");
    return Evaluate{value};
  }

  // ---- expressions ----

  ExprId zero() { return add(Number{}, token_.span, 1); }
  ExprId add(ExprNode node, SourceSpan where, int depth) {
    if (depth > kMostDepth) error(where, "the expression is nested deeper than " + std::to_string(kMostDepth), "split it with attributes or variables");
    depths_.push_back(static_cast<std::uint16_t>(std::min(depth, kMostDepth)));
    return grammar_.add(std::move(node), where);
  }
  [[nodiscard]] int depthOf(ExprId id) const { return depths_[static_cast<std::size_t>(id.value)]; }
  [[nodiscard]] int depthOver(const std::vector<ExprId>& children) const {
    int depth = 0;
    for (const ExprId child : children) depth = std::max(depth, depthOf(child));
    return depth + 1;
  }
  /// Parentheses do not make a node, so nesting is counted apart: text must not drive the machine's stack.
  bool enter() {
    if (++nesting_ <= kMostDepth) return true;
    error(token_.span, "the expression is nested deeper than " + std::to_string(kMostDepth), "split it with attributes or variables");
    return false;
  }

  ExprId expression() {
    const std::uint32_t begin = token_.span.begin;
    if (!enter()) {
      --nesting_;
      return zero();
    }
    const ExprId condition = binary(kOrBinding);
    ExprId result = condition;
    if (!panic_ && take(TokenKind::Question)) {
      const ExprId yes = expression();
      expect(TokenKind::Colon, "between the two values of ?:");
      const ExprId no = panic_ ? zero() : expression();
      result = add(Conditional{condition, yes, no}, spanFrom(begin), 1 + std::max({depthOf(condition), depthOf(yes), depthOf(no)}));
    }
    --nesting_;
    return result;
  }
  ExprId binary(int binding) {
    if (binding == kComparisonBinding) return comparison();
    if (binding > kProductBinding) return unary();
    const std::uint32_t begin = token_.span.begin;
    ExprId left = binary(binding + 1);
    for (;;) {
      const OperatorRow* row = operatorOf(token_.kind);
      if (panic_ || !row || row->binding != binding) return left;
      advance();
      const ExprId right = binary(binding + 1);
      left = add(Binary{row->op, left, right}, spanFrom(begin), 1 + std::max(depthOf(left), depthOf(right)));
    }
  }
  ExprId comparison() {
    const std::uint32_t begin = token_.span.begin;
    const ExprId first = binary(kSumBinding);
    auto op = comparisonOf(token_.kind);
    if (panic_ || !op) return first;
    advance();
    const ExprId second = binary(kSumBinding);
    const auto more = comparisonOf(token_.kind);
    if (panic_ || !more) return add(Binary{*op, first, second}, spanFrom(begin), 1 + std::max(depthOf(first), depthOf(second)));
    Chain chain{{first, second}, {*op}};
    while (!panic_ && (op = comparisonOf(token_.kind))) {
      advance();
      chain.comparisons.push_back(*op);
      chain.operands.push_back(binary(kSumBinding));
    }
    const int depth = depthOver(chain.operands);
    return add(std::move(chain), spanFrom(begin), depth);
  }
  ExprId unary() {
    const std::uint32_t begin = token_.span.begin;
    if (!is(TokenKind::Minus) && !is(TokenKind::Not)) return power(primary(), begin);
    const UnaryOp op = is(TokenKind::Minus) ? UnaryOp::Minus : UnaryOp::Not;
    if (op == UnaryOp::Minus && peek().kind == TokenKind::Number) return negativeNumber();
    advance();
    const bool shallow = enter();
    const ExprId operand = shallow ? unary() : zero();
    --nesting_;
    return add(Unary{op, operand}, spanFrom(begin), 1 + depthOf(operand));
  }
  /// -1.5 is one literal; in -2^2 the minus belongs to the power.
  ExprId negativeNumber() {
    const std::uint32_t begin = token_.span.begin;
    advance();
    const ExprId number = primary();
    if (is(TokenKind::Caret)) {
      const ExprId raised = power(number, begin + 1);
      return add(Unary{UnaryOp::Minus, raised}, spanFrom(begin), 1 + depthOf(raised));
    }
    Expr& made = grammar_.expressions.back();
    Number& value = std::get<Number>(made.node);
    value = literal(textOf(made.where), -value.value);
    made.where = spanFrom(begin);
    return number;
  }
  ExprId power(ExprId base, std::uint32_t begin) {
    if (panic_ || !take(TokenKind::Caret)) return base;
    const bool shallow = enter();
    const ExprId exponent = shallow ? unary() : zero();
    --nesting_;
    return add(Binary{BinaryOp::Power, base, exponent}, spanFrom(begin), 1 + std::max(depthOf(base), depthOf(exponent)));
  }
  ExprId primary() {
    const SourceSpan where = token_.span;
    if (is(TokenKind::Number)) return number();
    if (is(TokenKind::Word)) return nameOrCall();
    if (is(TokenKind::Text)) {
      advance();
      return add(Text{unquoted(textOf(where))}, where, 1);
    }
    if (take(TokenKind::LeftParen)) {
      const ExprId inner = expression();
      expect(TokenKind::RightParen, "after the expression");
      return lastParenthesised_ = inner;
    }
    error(gap(), "a value is expected, but here " + seen());
    return zero();
  }
  ExprId number() {
    const SourceSpan where = token_.span;
    const std::string_view said = textOf(token_);
    const auto value = parseNumber(said);
    if (!value) slip(where, "the number " + std::string(said.substr(0, 40)) + " is too large or too small to be held", "numbers reach from 1e-307 to 1e308");
    advance();
    if (value && is(TokenKind::Word) && token_.span.begin == previousEnd_)
      error({where.begin, token_.span.end}, "'" + std::string(said) + std::string(textOf(token_)) + "' is neither a number nor a name", "write '*' between them to multiply");
    return add(literal(said, value.value_or(0)), where, 1);
  }
  ExprId nameOrCall() {
    const std::uint32_t begin = token_.span.begin;
    std::string name(textOf(token_));
    advance();
    if (take(TokenKind::LeftParen)) return call(std::move(name), begin);
    if (!is(TokenKind::LeftBracket)) return add(Name{std::move(name)}, spanFrom(begin), 1);
    Element element{std::move(name), {}};
    while (!panic_ && take(TokenKind::LeftBracket)) {
      element.indices.push_back(expression());
      expect(TokenKind::RightBracket, "after the index");
    }
    const int depth = depthOver(element.indices);
    return add(std::move(element), spanFrom(begin), depth);
  }
  ExprId call(std::string function, std::uint32_t begin) {
    Call call{std::move(function), {}};
    if (!take(TokenKind::RightParen)) {
      do call.arguments.push_back(expression());
      while (!panic_ && take(TokenKind::Comma));
      expect(TokenKind::RightParen, "after the arguments of", call.function);
    }
    const int depth = depthOver(call.arguments);
    return add(std::move(call), spanFrom(begin), depth);
  }

  std::string_view text_;
  Report report_;
  Lexer lexer_;
  Grammar grammar_;
  Token token_;
  std::optional<Token> peeked_;
  std::uint32_t previousEnd_ = 0;
  std::vector<std::uint16_t> depths_;  ///< of each expression's tree, beside the arena
  std::vector<OpenBlock> open_;
  int nesting_ = 0;
  bool panic_ = false;         ///< an item is broken: say nothing more until it ends
  bool endReported_ = false;
  bool firstInBlock_ = true;   ///< so that a block does not start with a blank line
  bool hasGrow_ = false;
  ExprId lastParenthesised_;
  std::optional<Hoisted> hoisted_;
  std::optional<LineStart> lineStart_;
};

Parsed refused(std::string message, std::string hint, SourceSpan span = {}) {
  Parsed parsed;
  parsed.diagnostics.push_back({Severity::Error, span, std::move(message), std::move(hint)});
  return parsed;
}

std::uint32_t firstBadByte(std::string_view text) {
  std::size_t good = 0;
  while (good < text.size() && isUtf8(text.substr(good, utf8Length(text[good])))) good += utf8Length(text[good]);
  return static_cast<std::uint32_t>(good);
}

}  // namespace

Parsed parseSimeco(std::string_view text) {
  if (text.size() > kMostBytes) return refused("the text is larger than 100 MB", "split the ecosystem into several files");
  if (!isUtf8(text)) {
    const std::uint32_t at = firstBadByte(text);
    return refused("the text is not UTF-8 from here on", "save the file as UTF-8", {at, at + 1});
  }
  return Parser(text).run();
}

}  // namespace axil::simeco
