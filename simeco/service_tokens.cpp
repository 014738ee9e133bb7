#include "simeco/service_tokens.hpp"

#include "simeco/lexer.hpp"
#include "simeco/vocabulary.hpp"

#include <algorithm>
#include <set>

namespace axil::simeco {

namespace {

bool isKeyword(std::string_view word) {
  static const std::set<std::string_view> kWords{"EcoSystem", "Plant", "Stage", "Grow",         "steps",        "seed",        "ring",  "ignore", "consider",
                                                 "array",     "start", "end",   "external",     "startEach",    "endEach",     "depth", "quiet",  "if",
                                                 "else",      "while", "do",    "decomposition", "homomorphism", "interaction"};
  return kWords.contains(word) || organOfKeyword(word).has_value();
}

template <class Row>
bool isIn(std::span<const Row> rows, std::string_view Row::* word, std::string_view text) {
  return std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.*word == text; });
}

/// What a word is, from the token behind it. Keywords of Grow are words that an author may also use as names.
TokenRole roleOfWord(std::string_view word, TokenKind next) {
  const bool called = next == TokenKind::LeftParen;
  if (called && isIn(functionWords(), &FunctionWord::name, word)) return TokenRole::Function;
  if (isIn(letterWords(), &LetterWord::letter, word) && (called || word.size() > 1)) return TokenRole::Module;
  if (isKeyword(word)) return TokenRole::Keyword;
  if (next == TokenKind::Assign) return TokenRole::Attribute;
  return TokenRole::Name;
}

TokenRole roleOfSign(TokenKind kind) {
  switch (kind) {
    case TokenKind::Number: return TokenRole::Number;
    case TokenKind::Text: return TokenRole::Text;
    case TokenKind::LeftBrace: case TokenKind::RightBrace: case TokenKind::LeftParen: case TokenKind::RightParen: case TokenKind::Comma: case TokenKind::Semicolon:
      return TokenRole::Separator;
    case TokenKind::LeftBracket: case TokenKind::RightBracket: return TokenRole::Branch;
    case TokenKind::Arrow: case TokenKind::Colon: case TokenKind::Bar: return TokenRole::Sign;
    default: return TokenRole::Operator;
  }
}

/// Bytes that belong to no token, between two that do.
void addUnknown(std::vector<ServiceToken>& tokens, std::string_view text, std::size_t begin, std::size_t end) {
  while (begin < end && static_cast<unsigned char>(text[begin]) <= ' ') ++begin;
  while (end > begin && static_cast<unsigned char>(text[end - 1]) <= ' ') --end;
  if (begin < end) tokens.push_back({{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)}, TokenRole::Unknown});
}

}  // namespace

std::vector<ServiceToken> simecoTokens(std::string_view text) {
  Report unused;
  Lexer lexer(text, unused);
  std::vector<ServiceToken> tokens;
  tokens.reserve(text.size() / 4);
  std::size_t done = 0;
  const auto add = [&](SourceSpan span, TokenRole role) {
    addUnknown(tokens, text, done, span.begin);
    tokens.push_back({span, role});
    done = span.end;
  };
  for (Token token = lexer.next(), next; token.kind != TokenKind::End; token = next) {
    // A comment that stands behind `token` is only taken once `token` itself is placed.
    std::vector<CommentToken> before = std::exchange(lexer.comments(), {});
    for (const CommentToken& comment : before) add(comment.span, TokenRole::Comment);
    next = lexer.next();
    const std::string_view word = text.substr(token.span.begin, token.span.end - token.span.begin);
    add(token.span, token.kind == TokenKind::Word ? roleOfWord(word, next.kind) : roleOfSign(token.kind));
  }
  for (const CommentToken& comment : lexer.comments()) add(comment.span, TokenRole::Comment);
  addUnknown(tokens, text, done, text.size());
  return tokens;
}

std::vector<ServiceToken> tokensOf(std::string_view text, Language language) {
  return language == Language::LSystem ? lsystemTokens(text) : simecoTokens(text);
}

Language languageOfFile(std::string_view fileName) { return fileName.ends_with(".l") ? Language::LSystem : Language::SimEco; }

}  // namespace axil::simeco
