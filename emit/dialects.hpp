#pragma once
/// \file
/// Grammars in other programs' languages. The geometry is SimEco's: the same lengths and turns, each turn (rotr, rotu) written as turtle
/// rotations that do exactly the same.
///
/// cpfg and L-Py get the grammar itself, rule by rule (emit/turtle_program.hpp); MTG is a table of a plant and has no rules, so it gets the
/// plant that the grammar grows. Each export says in its heading what its language can't carry. Sources: cpfg reference (.l, .v, .a), L-Py
/// documentation, the MTG file format (FORM-A).

#include "base/result.hpp"
#include "simeco/grammar.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axil::emit {

enum class Dialect {
  SimEco,  ///< .simeco
  Cpfg,    ///< .l: classic L-system text, with its view (.v) and animation (.a) files
  LPy,     ///< .lpy; the plant's axes (x, y, z) are L-Py's (y, z, x), since plants stand along Z there
  Mtg,     ///< .mtg: a table of the grown architecture, FORM-A
};

/// "simeco", "cpfg", "lpy", "mtg"; none for any other word.
[[nodiscard]] std::optional<Dialect> dialectNamed(std::string_view name);

struct DialectOptions {
  std::uint64_t seed = 1;  ///< of what is drawn by chance: which plant of a family MTG shows
};

struct DialectText {
  std::string text;
  std::string view;       ///< cpfg: the .v file that belongs beside it; else empty
  std::string animation;  ///< cpfg: the .a file
};

/// `grammar`'s first plant as text of `dialect`. Fails with BadInput for what the language cannot say: a turn that is divided between two
/// rules, questions to the host, tropisms and decomposition; and as growing does (MTG).
[[nodiscard]] Result<DialectText> inDialect(const simeco::Grammar& grammar, Dialect dialect, const DialectOptions& options = {});

}  // namespace axil::emit
