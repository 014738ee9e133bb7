#pragma once
/// \file
/// The structured grammar: a plant *like* the measured one in few rules that a person can read. Two rules a branching order,
/// `A(order, n)` being an apex that still makes n segments; numbers are drawn with the mean and standard deviation measured on
/// that order. It describes a family of plants, of which every seed grows one; it does not regrow the measured plant. The text is SimEco 1.1.
/// Source: the future work of L-Grammar Generator 2005, chapter 4.

#include "base/result.hpp"
#include "emit/initial.hpp"
#include "quantify/types.hpp"
#include "simeco/grammar.hpp"

#include <optional>

namespace axil::emit {

struct StructureOptions {
  std::optional<int> orders;  ///< how many branching orders to keep, from 1; none: all that were measured
};

/// Fails as initialGrammar does, and with BadInput for orders below 1.
[[nodiscard]] Result<simeco::Grammar> structuredGrammar(const quantify::Measurements& measurements, const EmitOptions& options = {},
                                                        const StructureOptions& structure = {});

}  // namespace axil::emit
