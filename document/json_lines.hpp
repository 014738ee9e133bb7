#pragma once
/// \file
/// Private to document: JSON with one line a member of a list, so that files stay readable and their differences small.

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axil::document {

/// `object` with two-space indentation, each element of a list on a line of its own, deeper values unbroken.
[[nodiscard]] std::string jsonLines(const nlohmann::ordered_json& object);

}  // namespace axil::document
