#pragma once
/// \file
/// Private to the room: the vocabulary as a lookup from tokens to the longest phrase that begins there.

#include "keywords/tokens.hpp"
#include "keywords/vocabulary.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace axil::keywords {

/// One meaning of a phrase. Category and concept are those of `vocabulary()`, which lives as long as the program.
struct Meaning {
  const Category* category = nullptr;
  const Concept* entry = nullptr;
  bool everyday = false;
};

struct Phrase {
  std::vector<std::string> words;
  std::vector<Meaning> meanings;  ///< of different categories
};

/// A phrase found in a text: tokens [first, end). `phrase` is null where none begins.
struct Found {
  const Phrase* phrase = nullptr;
  std::size_t first = 0;
  std::size_t end = 0;

  explicit operator bool() const { return phrase != nullptr; }
  /// The phrase's meaning in the category of that property; null when it has none.
  [[nodiscard]] const Meaning* as(std::string_view property) const;
  [[nodiscard]] const Concept* conceptAs(std::string_view property) const;
};

/// Whether a phrase begins with that word, itself or behind "sub" ("suborbicular").
[[nodiscard]] bool isKnownWord(std::string_view word);

/// For every token the longest phrase that begins at it. Hyphens between the words of a phrase may stand or be left out,
/// and "sub" may stand before a Latin word.
[[nodiscard]] std::vector<Found> findPhrases(const std::vector<Token>& tokens);

}  // namespace axil::keywords
