#pragma once
/// \file
/// Private to the room: the little words of descriptions that are grammar, not vocabulary: they negate, weaken, join or fill.

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace axil::keywords {

using Words = std::initializer_list<std::string_view>;
/// Most words differ in length, first or last byte already; Chinese characters in the last.
inline bool isOneOf(std::string_view text, Words words) {
  return !text.empty() && std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    return word.size() == text.size() && word.back() == text.back() && word.front() == text.front() && word == text;
  });
}

[[nodiscard]] bool negates(std::string_view word);
/// "rarely", "usually", "narrowly": the qualifier that the word is, or nothing.
[[nodiscard]] std::string_view qualifierOf(std::string_view word);
/// Words after which an adjective is about something else: "opposite the window".
[[nodiscard]] bool leadsElsewhere(std::string_view next);
/// Words that stand in every kind of text and say nothing about what it is about.
[[nodiscard]] bool isFiller(std::string_view word);

}  // namespace axil::keywords
