#pragma once
/// \file
/// Small readers of C-like text that the stages of the preprocessor share. Internal.

#include "base/source.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

namespace axil::simeco::preprocess {

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }
inline bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
inline bool isNamePart(char c) { return isNameStart(c) || isDigit(c); }
inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

inline SourceSpan spanOf(std::size_t begin, std::size_t end) {
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(std::max(begin, end))};
}

inline std::size_t skipBlanks(std::string_view text, std::size_t at) {
  while (at < text.size() && isBlank(text[at])) ++at;
  return at;
}

inline std::string_view trimmed(std::string_view text) {
  std::size_t begin = skipBlanks(text, 0);
  std::size_t end = text.size();
  while (end > begin && isBlank(text[end - 1])) --end;
  return text.substr(begin, end - begin);
}

inline std::string_view nameAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  if (end < text.size() && isNameStart(text[end]))
    while (end < text.size() && isNamePart(text[end])) ++end;
  return text.substr(at, end - at);
}

/// End of the quoted text that starts at `at`, or nothing if it is not closed on its line (then it is a letter).
inline std::optional<std::size_t> quotedEnd(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') ++i;
    else if (text[i] == '"') return i + 1;
  }
  return std::nullopt;
}

/// End of the C number that starts at `at`: it swallows letters and signed exponents, so no macro is seen inside.
inline std::size_t numberEnd(std::string_view text, std::size_t at) {
  std::size_t i = at;
  while (i < text.size() && (isNamePart(text[i]) || text[i] == '.')) {
    const bool exponent = text[i] == 'e' || text[i] == 'E';
    ++i;
    if (exponent && i + 1 < text.size() && (text[i] == '+' || text[i] == '-') && isDigit(text[i + 1])) ++i;
  }
  return i;
}

}  // namespace axil::simeco::preprocess
