#include "base/units.hpp"

#include <utility>

namespace axil {

std::optional<double> metresPer(std::string_view unit) {
  static constexpr std::pair<std::string_view, double> kUnits[] = {{"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  for (const auto& [name, metres] : kUnits)
    if (name == unit) return metres;
  return std::nullopt;
}

}  // namespace axil
