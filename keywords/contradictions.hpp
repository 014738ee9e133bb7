#pragma once
/// \file
/// Private to the room: statements of one text that cannot both hold. Alternatives ("opposite or alternate"), exceptions
/// ("rarely"), refinements ("opposite, decussate") and statements about different kinds of one organ ("basal", "upper") are none.

#include "keywords/paragraph.hpp"

namespace axil::keywords {

/// Pairs among `traits`, and traits that a denial denies. `text` is the description.
[[nodiscard]] std::vector<Contradiction> contradictionsIn(const Traits& traits, const std::vector<Denial>& denials, std::string_view text);

}  // namespace axil::keywords
