#pragma once
/// \file
/// Private to app: checks of option values whose messages a person can use. CLI11's own print the limits of a double and the
/// numbers behind words.

#include "base/text.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <map>
#include <string>

namespace axil::app {

/// Turns a word into the value that `words` has for it.
template <class T>
CLI::Validator oneOf(const std::map<std::string, T>& words) {
  const auto choose = [words](std::string& text) -> std::string {
    if (const auto at = words.find(text); at != words.end()) {
      text = std::to_string(static_cast<int>(at->second));
      return {};
    }
    std::string known;
    for (const auto& word : words) known += (known.empty() ? "" : ", ") + word.first;
    return "'" + text + "' is none of " + known;
  };
  return CLI::Validator(choose, "", "oneOf");
}

/// A number at least 0, or above 0.
inline CLI::Validator notNegative() {
  return CLI::Validator([](std::string& text) {
    const auto number = parseNumber(text);
    return number && *number >= 0 && std::isfinite(*number) ? std::string() : "takes a number that is not negative, not '" + text + "'";
  }, "", "notNegative");
}
inline CLI::Validator aboveZero() {
  return CLI::Validator([](std::string& text) {
    const auto number = parseNumber(text);
    return number && *number > 0 && std::isfinite(*number) ? std::string() : "takes a number above 0, not '" + text + "'";
  }, "", "aboveZero");
}

}  // namespace axil::app
