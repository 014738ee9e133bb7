#pragma once
/// \file
/// Whether a rule set will likely grow beyond every limit. Internal to checking, for both languages.
///
/// Only rules that certainly fire are counted: of a symbol (a letter with its number of arguments and, in SimEco, its literal
/// number) the first rule for it, when that has neither condition nor context. So what is counted is at most what is derived.

#include "simeco/grammar.hpp"
#include "simeco/report.hpp"

namespace axil::simeco {

/// Warns when the derivation of `rules` passes the engine's limit of modules, or when nobody says how many steps to do and a rule
/// makes its own predecessor again for ever.
void warnAboutRunaway(const Grammar& grammar, const RuleSet& rules, Report& report);

}  // namespace axil::simeco
