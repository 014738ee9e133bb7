#pragma once
/// \file
/// Rules that rewrite what no rule makes. Private to this room.

#include "simeco/simeco.hpp"

namespace axil::emit {

/// Rules of apices from number `firstApex` on that nothing makes, and stages of stems and leaves that nothing makes, would only be warned of: drops them.
void dropUnmade(simeco::Grammar& grammar, int firstApex);

}  // namespace axil::emit
