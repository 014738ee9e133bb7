#include "simeco/module_string.hpp"

#include "base/large_array.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <new>

namespace axil::simeco {

void* grownBlock(void* block, std::size_t used, std::size_t bytes) {
  constexpr std::size_t worthLargePages = std::size_t{4} << 20;
  if (bytes < worthLargePages) {
    void* const grown = std::realloc(block, bytes);
    if (grown == nullptr) throw std::bad_alloc();
    return grown;
  }
  void* const grown = largeBlock(bytes);
  if (used > 0) std::memcpy(grown, block, used);
  std::free(block);
  return grown;
}

const std::vector<Symbol>& ModuleString::symbols() const {
  static const std::vector<Symbol> none;
  return symbols_ ? *symbols_ : none;
}

bool operator==(const ModuleString& a, const ModuleString& b) {
  if (a.size() != b.size() || a.parameters_.size() != b.parameters_.size()) return false;
  const auto sameModule = [](const ModuleView& x, const ModuleView& y) {
    return x.letter == y.letter && x.parameters.size() == y.parameters.size() &&
           (x.parameters.empty() || std::memcmp(x.parameters.data(), y.parameters.data(), x.parameters.size_bytes()) == 0);
  };
  return std::equal(a.begin(), a.end(), b.begin(), sameModule);
}

std::map<std::string, std::size_t> letterCounts(const ModuleString& string) {
  std::array<std::size_t, 256> counts{};
  for (const SymbolCode code : string.codes()) ++counts[code];
  std::map<std::string, std::size_t> letters;
  for (std::size_t code = 0; code < string.symbols().size(); ++code)
    if (counts[code] > 0) letters[string.symbols()[code].letter] += counts[code];
  return letters;
}

std::string toText(const ModuleString& string) {
  std::string text;
  text.reserve(string.size() + 8 * string.parameters().size());
  for (const ModuleView module : string) {
    text += module.letter;
    for (std::size_t i = 0; i < module.parameters.size(); ++i) {
      text += i == 0 ? '(' : ',';
      text += shortest(module.parameters[i]);
    }
    if (!module.parameters.empty()) text += ')';
  }
  return text;
}

}  // namespace axil::simeco
