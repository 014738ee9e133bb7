#pragma once
/// \file
/// How old plants are that were measured together, in stages. Private to this room.
///
/// A plant's newest segment tells its age, unless everything had ended before: then the plant is older than it looks. Plants of one kind tell the two apart. Each plant is taken
/// either as of the age it shows, its newest tips undecided, or as of a greater one, all its newest tips ended; shares of endings and of ages are the likeliest (expectation and maximisation,
/// Dempster, Laird and Rubin 1977), and the ages are the fewest that explain the plants (Bayes' criterion, Schwarz 1978, extended by what choosing among
/// many costs, Chen and Chen 2008).

#include "quantify/phyllotaxis.hpp"

#include <span>
#include <vector>

namespace axil::quantify {

/// What a plant shows of its age.
struct ShownAge {
  /// Tips and nodes of leading axes, and of all others (of sympodial plants all axes are of one kind: the first).
  struct Kind {
    double newest = 0;  ///< tips that are as far up as the newest segment
    double ended = 0;   ///< tips that are not, and do not fork
    double nodes = 0;   ///< all but the newest tips
  };
  double now = 0;       ///< stage of the newest segment
  Kind kinds[2];
};

/// The stage of each plant now, never less than it shows. Fewer than five plants are each as old as they show, and so are all where their ages do not tell clearly.
[[nodiscard]] std::vector<double> agesOf(std::span<const ShownAge> plants);

}  // namespace axil::quantify
