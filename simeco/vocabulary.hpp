#pragma once
/// \file
/// Vocabulary: the words that SimEco knows, as tables. Internal; docs/simeco.md is the same for people.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "simeco/grammar.hpp"

namespace axil::simeco {

/// Which block an attribute belongs into; a bit each.
enum Place : std::uint8_t { InEcosystem = 1, InPlant = 2, InOrgan = 4 };

/// What an attribute's value is.
enum class ValueKind : std::uint8_t {
  Number,       ///< any number
  NotNegative,  ///< a number, 0 or more
  Positive,     ///< a number above 0
  Words,        ///< a quoted text
  Vector,       ///< vector(x, y, z)
  Colour,       ///< RGBA(r, g, b, a)
  Material,     ///< MTRL(...), six numbers
  Body,         ///< sphere(x, y, z, radius) or box(x, y, z, x, y, z); may be given again
};

struct AttributeWord {
  std::string_view name;
  std::uint8_t places;
  ValueKind kind;
  bool since11;              ///< not in SimEco 1.0
  std::string_view warning;  ///< said to whoever uses it; may be empty
};
[[nodiscard]] std::span<const AttributeWord> attributeWords();

struct FunctionWord {
  std::string_view name;
  int fewest;
  int most;  ///< -1: any number
  bool since11;
};
[[nodiscard]] std::span<const FunctionWord> functionWords();

struct LetterWord {
  std::string_view letter;
  int fewest;  ///< arguments
  int most;    ///< in version 1.1; in 1.0 it is `fewest`
  bool since11;
};
[[nodiscard]] std::span<const LetterWord> letterWords();

/// The organ whose block `word` opens ("Stem").
[[nodiscard]] std::optional<OrganKind> organOfKeyword(std::string_view word);

inline constexpr std::string_view kVersions[] = {"1.0", "1.1"};

/// Stated limits of the text, in both languages. A grammar takes some fifty times its text's memory, so that one of this size still fits.
inline constexpr std::size_t kMostBytes = 32'000'000;
inline constexpr int kMostDepth = 200;      ///< of nested expressions, statements
inline constexpr int kMostBrackets = 1000;  ///< of nested branches in one rule

}  // namespace axil::simeco
