#pragma once
/// \file
/// The statistical form of the structured grammar: the family of plants that the measured ones look like samples of (quantify/family.hpp), in at most two
/// rules a branching order. Private to this room; structured.hpp is its door.

#include "emit/structured.hpp"

namespace axil::emit {

[[nodiscard]] Result<simeco::Grammar> statisticalGrammar(const quantify::Measurements& measurements, const EmitOptions& options, const StructureOptions& wanted);

}  // namespace axil::emit
