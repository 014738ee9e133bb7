#pragma once
/// \file
/// Macros: what the use of one stands for, and the whole-number conditions of `#if`. Internal to the preprocessor.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco::preprocess {

struct Macro {
  std::string body;
  bool takesArguments = false;
  std::vector<std::string> parameters;
};

using Macros = std::map<std::string, Macro, std::less<>>;

/// The arguments of a macro use whose `(` stands at `open`, and where the text goes on.
struct MacroArguments {
  std::vector<std::string> values;
  std::size_t end = 0;
};
/// None when the `)` is missing.
[[nodiscard]] std::optional<MacroArguments> argumentsAt(std::string_view text, std::size_t open);

/// A text without places (a macro's body or argument) after its macros are replaced, or why it cannot be.
struct Expanded {
  std::string text;
  std::string problem;
};
/// At most `limit` bytes.
[[nodiscard]] Expanded expanded(const Macros& macros, std::size_t limit, std::string_view text);
/// What the use of macro `name` stands for, with `arguments` as written.
[[nodiscard]] Expanded usedMacro(const Macros& macros, std::size_t limit, const std::string& name, const Macro& macro, const std::vector<std::string>& arguments);

/// The value of an `#if` line; none when it is not a whole-number condition.
[[nodiscard]] std::optional<std::int64_t> conditionValue(std::string_view text);

}  // namespace axil::simeco::preprocess
