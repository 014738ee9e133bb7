#pragma once
/// \file
/// Rules that can never fire: their condition holds for no value, or rules above them take every module that they could take. What is
/// said is certain; rules whose conditions ask for more than one number of one module are never among them. Private to the checks.

#include "simeco/grammar.hpp"

#include <optional>
#include <vector>

namespace axil::simeco {

enum class Unreached { ByItsCondition, ByRulesAbove };
/// Whether rules above a rule take modules away from it: not where one of all that fit is drawn.
enum class Order { FirstThatFits, ByChance };

/// For each rule of the list why it never fires; nothing where it may.
[[nodiscard]] std::vector<std::optional<Unreached>> unreachedRules(const Grammar& grammar, const std::vector<Production>& rules, Order order);

/// Whether the rule rewrites every module that its predecessor names, wherever it stands.
[[nodiscard]] bool firesAlways(const Grammar& grammar, const Production& rule);

}  // namespace axil::simeco
