#pragma once
/// \file
/// Traits and presets for a program (the JSON of `axil keywords --json`) and for a person.

#include "keywords/types.hpp"

#include <string>

namespace axil::keywords {

/// `{"traits": [...], "presets": {...}}`, indented, with a newline at its end. A trait has organ, property, value or low, high and
/// unit (and minimum, maximum, qualifier where the text gives them; organ_id and id, the names that the Plant Ontology or PATO give to
/// organ and value, where they do), text, start, end (characters). Presets have only what the text
/// sets, and `evidence`, the words that set each.
[[nodiscard]] std::string traitsJson(const Traits& traits, const Presets& presets);
/// The same with `"unknown": [...]` (organ, text, start, end) and `"contradictions": [...]` (what, and the places of both traits).
[[nodiscard]] std::string readingJson(const Reading& reading, const Presets& presets);
/// One line a trait: organ, property, value, and the quoted words with their place; then the presets.
[[nodiscard]] std::string traitsText(const Traits& traits, const Presets& presets);
/// The same, then what was seen but not understood, and what contradicts itself.
[[nodiscard]] std::string readingText(const Reading& reading, const Presets& presets);
/// The report of a text that is read in pieces, in the form of readingJson or readingText but without presets, since a text of that
/// length is about many plants. Print what `begin`, `piece` for each and `end` give, in that order.
class PieceReport {
 public:
  enum class Form { Json, Text };
  explicit PieceReport(Form form) : form_(form) {}
  [[nodiscard]] std::string begin() const;
  [[nodiscard]] std::string piece(const Reading& reading);
  [[nodiscard]] std::string end() const;

 private:
  Form form_;
  bool anyTrait_ = false;
  std::string unknown_;  // as they will be printed
  std::string contradictions_;
};
/// The whole vocabulary, one concept a line, columns separated by tabs: which property it is a value of and what it is about, its
/// name as traits give it, its id, the words that say it in English, 繁體 and 简体, its definition. A head line comes first.
[[nodiscard]] std::string vocabularyText();

}  // namespace axil::keywords
