#include "render/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

namespace axil::render {
namespace {

constexpr int significantDigits = 8;
constexpr int mostDecimals = 24;  // smaller plants than that have no atoms

using FourDigits = std::array<char, 4>;

constexpr std::array<FourDigits, 10'000> fourDigitsOfAll() {
  std::array<FourDigits, 10'000> all{};
  for (std::uint32_t i = 0; i < all.size(); ++i)
    all[i] = {static_cast<char>('0' + i / 1000), static_cast<char>('0' + i / 100 % 10), static_cast<char>('0' + i / 10 % 10), static_cast<char>('0' + i % 10)};
  return all;
}
constexpr std::array<FourDigits, 10'000> fourDigits = fourDigitsOfAll();

/// The eight digits of a number below 10^8, with leading zeros.
void writeEight(char* to, std::uint32_t number) {
  std::memcpy(to, fourDigits[number / 10'000].data(), 4);
  std::memcpy(to + 4, fourDigits[number % 10'000].data(), 4);
}

}  // namespace

char* writeWhole(char* to, std::uint32_t number) {
  if (number >= 100'000'000) return std::to_chars(to, to + longestNumber, number).ptr;
  std::array<char, 8> digits;
  writeEight(digits.data(), number);
  int zeros = 0;
  while (zeros < 7 && digits[static_cast<std::size_t>(zeros)] == '0') ++zeros;
  std::memcpy(to, digits.data() + zeros, static_cast<std::size_t>(8 - zeros));
  return to + 8 - zeros;
}

FixedText FixedText::forNumbersUpTo(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return FixedText(0);
  return FixedText(significantDigits - 1 - static_cast<int>(std::floor(std::log10(largest))));
}

FixedText::FixedText(int decimals) : decimals_(std::clamp(decimals, 0, mostDecimals)), scale_(std::pow(10.0, decimals_)) {}

char* FixedText::write(char* to, float value) const {
  const double scaled = std::abs(static_cast<double>(value)) * scale_ + 0.5;
  if (!(scaled < 1e8)) return std::to_chars(to, to + longestNumber, value).ptr;
  const auto number = static_cast<std::uint32_t>(scaled);
  if (number == 0) {
    *to = '0';
    return to + 1;
  }
  if (value < 0) *to++ = '-';
  std::array<char, 8> digits;
  writeEight(digits.data(), number);
  const int whole = 8 - decimals_;  // of the digits, those before the point; below 1 there are zeros behind it
  int first = 0;
  while (first + 1 < whole && digits[static_cast<std::size_t>(first)] == '0') ++first;
  if (whole <= 0) *to++ = '0';
  for (; first < whole; ++first) *to++ = digits[static_cast<std::size_t>(first)];
  if (decimals_ == 0) return to;
  *to++ = '.';
  for (int zero = whole; zero < 0; ++zero) *to++ = '0';
  const int begin = std::max(whole, 0);
  std::memcpy(to, digits.data() + begin, static_cast<std::size_t>(8 - begin));
  return to + 8 - begin;
}

}  // namespace axil::render
