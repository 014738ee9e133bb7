#pragma once
/// \file
/// The initial grammar in other programs' languages. The geometry is SimEco's: the same rounded lengths and turns, each turn
/// (rotr, rotu) written as turtle rotations that do exactly the same.
///
/// A turtle with heading H = d and left L = -r (both programs' turtles) turns like this: roll about H by rotu, pitch about L by
/// -rotr; a branch then rolls by another 90 degrees, for its r-axis is its parent's direction made perpendicular to its own.
/// Each export says in its heading what its language can't carry. Sources: LSYSTEM reference (cpfg), L-Py and MTG documentation.

#include "base/result.hpp"
#include "emit/initial.hpp"
#include "quantify/types.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace axil::emit {

enum class Dialect {
  SimEco,  ///< .simeco
  Cpfg,    ///< .l: classic L-system text
  LPy,     ///< .lpy; the plant's axes (x, y, z) are L-Py's (y, z, x), since plants stand along Z there
  Mtg,     ///< .mtg: a table of the measured architecture, FORM-A
};

/// "simeco", "cpfg", "lpy", "mtg"; none for any other word.
[[nodiscard]] std::optional<Dialect> dialectNamed(std::string_view name);

/// The plant's initial grammar as text of `dialect`. Fails as initialGrammar does; only the exact turning rule can be written in other dialects.
[[nodiscard]] Result<std::string> inDialect(const quantify::Measurements& measurements, Dialect dialect, const EmitOptions& options = {});

}  // namespace axil::emit
