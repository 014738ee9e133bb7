#pragma once
/// \file
/// Private to the room: numbers as botanists write them. "(12-)23-34(-40) x 4.5-5.6 cm": the usual range, in brackets the
/// rare extremes, length times width, the unit once at the end; in Chinese 五至八, 十二, (4)6-12(15). Numbers without a unit are
/// counts or nothing; units are never guessed.

#include "keywords/lexicon.hpp"
#include "keywords/tokens.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axil::keywords {

struct NumberRange {
  std::optional<double> minimum;
  double low = 0;
  double high = 0;
  std::optional<double> maximum;
  std::size_t end = 0;  ///< the token after it
  bool open = false;    ///< "1-several", 十餘: at least `low`
};

/// A single number that begins at token `first`, in digits, English words or Chinese numerals (十二, 一點五).
struct SingleNumber {
  double value = 0;
  std::size_t end = 0;
};
[[nodiscard]] std::optional<SingleNumber> numberAt(const std::vector<Token>& tokens, std::size_t first);

/// The range that begins at token `first`.
[[nodiscard]] std::optional<NumberRange> rangeAt(const std::vector<Token>& tokens, std::size_t first);

/// A size with its unit; `dimension` is empty where no word says what is measured.
struct Size {
  NumberRange range;
  std::string unit;
  std::string dimension;
  std::string qualifier;  ///< "up to", "about"
  std::size_t first = 0;  ///< tokens that say it: [first, end)
  std::size_t end = 0;
};

/// The sizes that begin with the number at token `at`: one, or more for "length x width" and 長寬各3公分. Empty when no unit
/// follows.
[[nodiscard]] std::vector<Size> sizesAt(const std::vector<Token>& tokens, const std::vector<Found>& found, std::size_t at);

/// "up to", "about" or nothing, from the words before token `number`; `first` is where they begin.
struct Lead {
  std::vector<std::string> dimensions;  ///< 長寬: both
  std::string qualifier;
  std::size_t first = 0;
};
[[nodiscard]] Lead leadBefore(const std::vector<Token>& tokens, const std::vector<Found>& found, std::size_t number);

}  // namespace axil::keywords
