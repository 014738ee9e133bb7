#pragma once
/// \file
/// Random grammars that use every node, statement, block and comment of the language, for properties over printed seeds.

#include "base/rng.hpp"
#include "simeco/grammar.hpp"

namespace axil::test {

/// A SimEco 1.1 grammar that prints and reads back; it need not make sense.
[[nodiscard]] simeco::Grammar randomGrammar(Rng rng);

}  // namespace axil::test
