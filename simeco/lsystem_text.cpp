#include "simeco/lsystem_text.hpp"

#include <charconv>

namespace axil::simeco {

namespace {

void appendNumber(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6);
  text.append(digits, end.ptr);
}

}  // namespace

std::string toLSystemText(const ModuleString& string) {
  std::string text;
  for (const ModuleView module : string) {
    text += module.letter;
    for (std::size_t i = 0; i < module.parameters.size(); ++i) {
      text += i == 0 ? '(' : ',';
      appendNumber(text, module.parameters[i]);
    }
    if (!module.parameters.empty()) text += ')';
  }
  return text;
}

}  // namespace axil::simeco
