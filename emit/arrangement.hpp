#pragma once
/// \file
/// A stem with its leaves and nothing else, to show what an arrangement's numbers mean.

#include "base/result.hpp"
#include "keywords/types.hpp"
#include "simeco/grammar.hpp"

namespace axil::emit {

/// Eight nodes (a cluster: its leaves at one place), the leaves of each as the arrangement says.
[[nodiscard]] Result<simeco::Grammar> arrangementGrammar(const keywords::ArrangementPreset& arrangement);

}  // namespace axil::emit
