#pragma once
/// \file
/// Text and numbers, without a locale: what is printed reads back as the same number on every machine.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace axil {

/// The shortest text that reads back as exactly `value` ("0.1", "1e+300", "nan", "inf"); -0 is "-0".
[[nodiscard]] std::string shortest(double value);
/// `value` with exactly `decimals` digits after the point ("0.193752"); a result of -0.000 is printed without the minus.
[[nodiscard]] std::string fixed(double value, int decimals);
/// `value` rounded to what `fixed` prints, so that text and number agree.
[[nodiscard]] double roundedTo(double value, int decimals);
/// The number that is the whole of `text`, or nothing. No blanks, no locale; "nan" and "inf" are not numbers here.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

/// Bytes of the UTF-8 character that starts with `first`; 1 for a byte that starts none.
[[nodiscard]] std::size_t utf8Length(char first);
/// Code points in `text`; a byte that belongs to none counts as one.
[[nodiscard]] std::size_t countCharacters(std::string_view text);
/// Whether `text` is well-formed UTF-8 (no overlong forms, no surrogates).
[[nodiscard]] bool isUtf8(std::string_view text);

/// `text` as UTF-8: a byte-order mark is dropped, UTF-16 with a mark and Big5 are recognised and converted.
/// Nothing when it is none of these (binary data).
struct DecodedText {
  std::string utf8;
  std::string encoding;  ///< "UTF-8", "UTF-16", "Big5"
};
[[nodiscard]] std::optional<DecodedText> decodeText(std::string_view bytes);

/// Single-character edits (insert, delete, replace, swap of neighbours) from `a` to `b`; for "did you mean".
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

}  // namespace axil
