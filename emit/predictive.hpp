#pragma once
/// \file
/// The predictive grammar: the measured plant, and how it goes on from there.
///
/// *Layered*, the default: the initial grammar, which regrows the plant, with an apex `A(n, rank, length, around, side, wait, left)` at every tip that still
/// grows. Apices wait until the last measured organ is complete, all wake in the same step, and then make a stage a step, `stages` of them:
/// no path gets longer than the measured plant's plus `stages` segments. One rule a branching order says what an apex makes, with the frequencies,
/// distributions and trends of that order (quantify/outlook.hpp): growth slows along the rank as measured, stops at the rank and after the time at which
/// measured axes stop, branches are slower than their bearers by the measured rate; leaves take as many stages to grow, and fall after as
/// many, as measured ones. Measured leaves that are still small go on growing to the usual size, old ones fall.
///
/// At the measured time (when the initial grammar is complete) the plant is the measured plant, organ for organ. Before that, only leaves that are
/// still to grow are shorter than the initial grammar has them, since one leaf grows at one rate.
///
/// *Thesis*: one stage, templates with ranges, as L-Grammar Generator 2005, section 3.4.2, builds it. Both are SimEco 1.1, for `random` is not 1.0.

#include "base/result.hpp"
#include "emit/initial.hpp"
#include "quantify/types.hpp"
#include "simeco/grammar.hpp"

#include <vector>

namespace axil::emit {

enum class PredictiveStyle { Layered, Thesis };

inline constexpr int kMostStages = 1000;

struct PredictiveOptions {
  PredictiveStyle style = PredictiveStyle::Layered;
  int stages = 1;                             ///< ahead, 1 to kMostStages; Thesis: 1
  std::vector<quantify::Measurements> also = {};   ///< further plants of the species that statistics are taken from; Layered only
};

/// Fails as initialGrammar does, with BadInput for stages out of range or options that the thesis' style does not have, with what layeredStatistics fails
/// with, and with NoAnswer where no segment of any plant has a child: nothing shows how it goes on.
[[nodiscard]] Result<simeco::Grammar> predictiveGrammar(const quantify::Measurements& measurements, const EmitOptions& options = {},
                                                        const PredictiveOptions& predictive = {});

}  // namespace axil::emit
