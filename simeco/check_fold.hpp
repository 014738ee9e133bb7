#pragma once
/// \file
/// What an expression is worth before anything is derived. Private to the checks.

#include "simeco/grammar.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace axil::simeco {

[[nodiscard]] const Number* numberIn(const Grammar& grammar, ExprId id);
[[nodiscard]] const Name* nameIn(const Grammar& grammar, ExprId id);

/// The value of an expression whose only name is `parameter`, when that has `value`; nothing where more is needed than that.
[[nodiscard]] std::optional<double> foldedWith(const Grammar& grammar, ExprId id, std::string_view parameter, double value);

/// A condition that does nothing with one name but compare it with numbers: between two neighbouring `limits` it holds everywhere or
/// nowhere. Without a name it always has the same value.
struct Comparing {
  std::string_view name;
  std::vector<double> limits;
};
[[nodiscard]] std::optional<Comparing> comparingIn(const Grammar& grammar, ExprId condition);

}  // namespace axil::simeco
