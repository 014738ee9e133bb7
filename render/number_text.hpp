#pragma once
/// \file
/// Private to render: numbers as text for large files. A number with a fixed count of decimals is a whole number with a point in
/// it, and four digits at a time come from a table; that is several times as fast as the shortest text of a float.

#include <cstdint>

namespace axil::render {

/// Room that one number needs, whatever it is.
inline constexpr int longestNumber = 64;

/// Writes `number` at `to`; returns where it ends.
char* writeWhole(char* to, std::uint32_t number);

/// Numbers up to some size with the same decimals each.
class FixedText {
 public:
  /// Enough decimals that numbers up to `largest` keep eight significant digits, which is what a float has.
  [[nodiscard]] static FixedText forNumbersUpTo(double largest);
  explicit FixedText(int decimals);

  /// Writes `value` at `to` (`longestNumber` bytes of room); returns where it ends. Rounds half away from zero; no "-0".
  char* write(char* to, float value) const;

 private:
  int decimals_;
  double scale_;
};

}  // namespace axil::render
