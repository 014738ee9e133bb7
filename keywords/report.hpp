#pragma once
/// \file
/// Traits and presets for a program (the JSON of `axil keywords --json`) and for a person.

#include "keywords/types.hpp"

#include <string>

namespace axil::keywords {

/// `{"traits": [...], "presets": {...}}`, indented, with a newline at its end. A trait has organ, property, value or low, high and
/// unit (and minimum, maximum, qualifier where the text gives them), text, start, end (characters). Presets have only what the text
/// sets, and `evidence`, the words that set each.
[[nodiscard]] std::string traitsJson(const Traits& traits, const Presets& presets);
/// The same with `"unknown": [...]` (organ, text, start, end) and `"contradictions": [...]` (what, and the places of both traits).
[[nodiscard]] std::string readingJson(const Reading& reading, const Presets& presets);
/// One line a trait: organ, property, value, and the quoted words with their place; then the presets.
[[nodiscard]] std::string traitsText(const Traits& traits, const Presets& presets);
/// The same, then what was seen but not understood, and what contradicts itself.
[[nodiscard]] std::string readingText(const Reading& reading, const Presets& presets);

}  // namespace axil::keywords
