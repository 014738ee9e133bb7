// SimEco text to Grammar, by recursive descent: ecosystem, plants, organs, stages. The layers below are in simeco_rules.hpp
// (what stands in Grow), simeco_expressions.hpp and simeco_cursor.hpp (place, errors, comments).
#include <array>

#include "simeco/language.hpp"
#include "simeco/simeco_rules.hpp"

namespace axil::simeco {

namespace {

using namespace syntax;

class Parser : private RuleParser {
 public:
  explicit Parser(std::string_view text) : RuleParser(text) {}

  Parsed run() {
    file();
    return {std::move(grammar_), report_.take()};
  }

 private:
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
      slip(token_.span, "after the last '}' of the ecosystem " + seen(),
           is(TokenKind::RightBrace) ? "remove it, or look for a '{' that was lost above" : "a file holds one EcoSystem");
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
  void oneBraceTooMany() {
    slip(token_.span, "'" + std::string(textOf(token_)) + "' stands outside the block it belongs to", "there is one '}' too many above");
  }

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
    if (!hasGrow_)
      slip(token_.span, "a rule stands outside Grow", "put it into Grow { ... }");
    else
      oneBraceTooMany();
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
    if (take(TokenKind::LeftParen)) stageParameters(stage);
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
  /// Stage 3(length, radius): from behind the parenthesis.
  void stageParameters(Stage& stage) {
    do {
      if (!is(TokenKind::Word)) return slip(gap(), "a name for an argument of the stage is missing", "for example: Stage 1(length, radius) { GrowRate = length; }");
      stage.parameters.emplace_back(textOf(token_));
      advance();
    } while (take(TokenKind::Comma));
    expect(TokenKind::RightParen, "after", "the stage's arguments");
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
    const std::string_view wanted = level == Level::Stage   ? inStage
                                    : level == Level::Organ ? inOrgan
                                    : level == Level::Plant ? inPlant
                                                            : inEcosystem;
    error(token_.span, std::string(wanted) + " is expected, but here " + seen());
    skipItem();
  }
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

  bool hasGrow_ = false;
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
  if (text.size() > kMostBytes) return refused("the text is larger than 32 MB", "split the ecosystem into several files");
  if (!isUtf8(text)) {
    const std::uint32_t at = firstBadByte(text);
    return refused("the text is not UTF-8 from here on", "save the file as UTF-8", {at, at + 1});
  }
  Parsed parsed = Parser(text).run();
  parsed.grammar.source = linesOf(text);
  return parsed;
}

}  // namespace axil::simeco
