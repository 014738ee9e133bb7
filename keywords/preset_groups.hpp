#pragma once
/// \file
/// Private to the room: the presets of leaf, plant, flower and fruit beyond arrangement, outline and size.

#include "keywords/types.hpp"

namespace axil::keywords {

/// Sets the groups of `presets` and their evidence from `traits`.
void setGroups(Presets& presets, const Traits& traits);

/// Remembers that `name` was read from `trait`.
void remember(Presets& presets, const std::string& name, const Trait& trait);

}  // namespace axil::keywords
