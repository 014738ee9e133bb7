#pragma once
/// \file
/// Private to document: a line cut into words, and words made so that a line cuts into them again.

#include "base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axil::document {

struct Word {
  std::string key;   ///< before an unquoted equals sign; empty: none
  std::string text;  ///< after it, quotes and escapes undone
  friend bool operator==(const Word&, const Word&) = default;

  /// As it would be without a key: `a=b` is a text where no option is expected.
  [[nodiscard]] std::string whole() const { return key.empty() ? text : key + "=" + text; }
};

/// The words between unquoted semicolons, one list a command. Fails with BadInput on an open quote or an unknown escape.
[[nodiscard]] Result<std::vector<std::vector<Word>>> cutLine(std::string_view line);

/// `text` as one word, quoted where it must be.
[[nodiscard]] std::string asWord(std::string_view text);

/// The name in `known` that `given` probably means: "; did you mean NAME?", or nothing.
[[nodiscard]] std::string didYouMean(std::string_view given, const std::vector<std::string>& known);

}  // namespace axil::document
