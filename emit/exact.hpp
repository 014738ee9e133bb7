#pragma once
/// \file
/// The exact form of the structured grammar (structured.hpp). Private to this room.

#include "base/result.hpp"
#include "emit/structured.hpp"

namespace axil::emit {

[[nodiscard]] Result<simeco::Grammar> exactGrammar(const quantify::Measurements& measurements, const EmitOptions& options, const StructureOptions& structure);

}  // namespace axil::emit
