#include "lsystem_compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace axil::test {

namespace {

/// A number in `text` from `at` on, with its end.
struct Numeral {
  double value = 0;
  std::size_t end = 0;
};
std::optional<Numeral> numeralAt(const std::string& text, std::size_t at) {
  const char c = text[at];
  const bool starts = (c >= '0' && c <= '9') || c == '-' || c == 'i' || c == 'n';
  if (!starts) return std::nullopt;
  const std::size_t end = std::min(text.find_first_of(",)", at), text.size());
  char* stopped = nullptr;
  const std::string word = text.substr(at, end - at);
  const double value = std::strtod(word.c_str(), &stopped);
  if (*stopped != '\0') return std::nullopt;
  return Numeral{value, end};
}

bool sameNumber(double a, double b, double tolerance) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  if (std::isinf(a) || std::isinf(b)) return a == b;
  return std::fabs(a - b) <= std::max(tolerance, 1e-5 * std::max(std::fabs(a), std::fabs(b)));
}

}  // namespace

std::string difference(const std::string& ours, const std::string& theirs, double tolerance) {
  std::size_t i = 0, j = 0;
  while (i < ours.size() && j < theirs.size()) {
    const bool number = i > 0 && (ours[i - 1] == '(' || ours[i - 1] == ',');
    const auto a = number ? numeralAt(ours, i) : std::nullopt;
    const auto b = number ? numeralAt(theirs, j) : std::nullopt;
    if (a && b && sameNumber(a->value, b->value, tolerance)) {
      i = a->end;
      j = b->end;
    } else if (ours[i] == theirs[j]) {
      ++i, ++j;
    } else {
      break;
    }
  }
  if (i == ours.size() && j == theirs.size()) return {};
  return "ours ..." + ours.substr(i < 20 ? 0 : i - 20, 60) + "\ntheirs ..." + theirs.substr(j < 20 ? 0 : j - 20, 60);
}

}  // namespace axil::test
