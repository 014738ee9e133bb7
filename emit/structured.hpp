#pragma once
/// \file
/// The structured grammar: the plant in few self-iterating rules that a person can read. Two forms.
///
/// *Statistical*: the family of plants that the measured one, or several, look like samples of (quantify/family.hpp). At most two rules a branching order:
/// `A(order, rank, length, around, side, left)` is an apex that may still make `left` segments, one rule while there are more to come and one for the
/// last; parameters that no order needs are left out. Numbers are drawn as measured, by a normal or even distribution where one fits, else from a table of
/// quantiles. `Depth` bounds the branching orders. Every seed grows one of the family.
///
/// *Exact*: this plant. One rule for an apex, one for axillary buds and one for leaf buds serve all orders; what the rules say about every
/// segment (usual length, bend, insertion, divergence) stands in short arrays by order, and where a segment differs, a table says by how
/// much, in whole steps. Steps are as coarse as the node error allows, and each node is aimed at where it was measured from where the
/// steps before really led, so that rounding never adds up.
///
/// How many steps, and whether lengths get a trend and azimuths a divergence, is chosen by description length: the text's bits, plus for every
/// node the bits that its error costs against the accuracy of measuring. `detail` turns that: above 1 errors cost more, and tables grow finer.
/// Both are SimEco 1.1. Sources: the future work of L-Grammar Generator 2005, chapter 4; Rissanen 1978 (description length).

#include "base/result.hpp"
#include "emit/initial.hpp"
#include "quantify/types.hpp"
#include "simeco/grammar.hpp"

#include <optional>
#include <vector>

namespace axil::emit {

enum class StructuredForm { Statistical, Exact };

struct StructureOptions {
  StructuredForm form = StructuredForm::Statistical;
  std::optional<int> orders = {};  ///< how many branching orders to keep, from 1; none: all that were measured
  double maximumError = 0.015;     ///< exact: how far a node may be from where it was measured, as a share of the height
  double detail = 1;               ///< exact: how much an error weighs against the length of the text
  std::vector<quantify::Measurements> also = {};  ///< statistical: further plants of the species
};

/// Fails as initialGrammar does, and with BadInput for options out of range.
[[nodiscard]] Result<simeco::Grammar> structuredGrammar(const quantify::Measurements& measurements, const EmitOptions& options = {},
                                                        const StructureOptions& structure = {});

}  // namespace axil::emit
