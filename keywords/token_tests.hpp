#pragma once
/// \file
/// Private to the room: what stands at a place of a list of tokens. Behind its end nothing does.

#include "keywords/tokens.hpp"
#include "keywords/words.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace axil::keywords {

using Tokens = std::vector<Token>;

[[nodiscard]] inline bool is(const Tokens& tokens, std::size_t i, std::string_view text) { return i < tokens.size() && tokens[i].text == text; }
[[nodiscard]] inline bool isAny(const Tokens& tokens, std::size_t i, Words words) { return i < tokens.size() && isOneOf(tokens[i].text, words); }
[[nodiscard]] inline bool isOpen(const Tokens& tokens, std::size_t i) { return isAny(tokens, i, {"(", "["}); }
[[nodiscard]] inline bool isClose(const Tokens& tokens, std::size_t i) { return isAny(tokens, i, {")", "]"}); }
[[nodiscard]] inline bool isTo(const Tokens& tokens, std::size_t i) { return isAny(tokens, i, {"-", "to", "至", "到", "或", "or", "and"}); }
/// "(-40)", "-(40)", "(40)", "(or 6)", "（或5）": the largest exception behind a range that ends at `high`. `at` moves behind it.
[[nodiscard]] std::optional<double> takeMaximum(const Tokens& tokens, std::size_t& at, double high);

}  // namespace axil::keywords
