#pragma once
/// \file
/// Private to the room: a description cut into tokens that know their place. A token is a Latin word, one Chinese character, a
/// number, or one sign. Characters are folded as Unicode's NFKC_Casefold does (lower case, full-width forms and ligatures to plain
/// letters), every kind of dash to '-', every multiplication sign to '*'; soft hyphens inside a word are left out. The places
/// are those of the text as it stands.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axil::keywords {

enum class TokenKind { Word, Han, Number, Sign };

struct Token {
  TokenKind kind = TokenKind::Sign;
  std::string_view text;  ///< folded; lives as long as its TokenList
  double number = 0;
  std::uint32_t begin = 0;  ///< bytes in the text
  std::uint32_t end = 0;
  std::size_t start = 0;  ///< characters in the text
  std::size_t stop = 0;
  bool spaceBefore = false;
  bool lineBreakBefore = false;
  /// Of a Chinese character, once markWords was called: Unicode's word breaks put it inside a word of several characters (花費).
  bool insideWord = false;
};

/// Tokens and the folded letters that they view. Not copied, since copies would view the original's letters.
struct TokenList {
  std::string letters;
  std::vector<Token> tokens;
  bool anyHan = false;

  TokenList() = default;
  TokenList(const TokenList&) = delete;
  TokenList& operator=(const TokenList&) = delete;
  TokenList(TokenList&&) = delete;
  TokenList& operator=(TokenList&&) = delete;
};

/// Cuts `text`, which is well-formed UTF-8 and begins at byte `firstByte`, character `firstCharacter` of the description.
void tokenize(std::string_view text, std::uint32_t firstByte, std::size_t firstCharacter, TokenList& into);

/// Finds the words that Chinese characters stand in, by Unicode's word breaks and ICU's dictionary. `text` and `firstByte` as for
/// tokenize. Slow beside the rest, so only for text that does not read like a description throughout.
void markWords(std::string_view text, std::uint32_t firstByte, TokenList& list);

/// The folded words of a vocabulary term, in order.
[[nodiscard]] std::vector<std::string> wordsOf(std::string_view term);

}  // namespace axil::keywords
