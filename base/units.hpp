#pragma once
/// \file
/// Units of length, by the word that a project or a description has for them.

#include <optional>
#include <string_view>

namespace axil {

/// Metres in a unit of length: m, dm, cm, mm, in or ft; nothing for any other word.
[[nodiscard]] std::optional<double> metresPer(std::string_view unit);

}  // namespace axil
