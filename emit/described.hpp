#pragma once
/// \file
/// A plant from words alone: a typical one of what a description says, as a SimEco 1.1 grammar that grows from a shoot to a plant in
/// flower and, where the text names one, in fruit. Habit, branching, arrangement, leaves, inflorescence and flowers follow the traits; every number stands on the words that
/// say it or on what is usual for the life form, and the grammar's comments tell which. Sizes are drawn from the text's ranges.
/// Unlike the initial grammar it measures nothing: it shows what the words mean.

#include "base/result.hpp"
#include "keywords/types.hpp"
#include "simeco/grammar.hpp"

#include <string>

namespace axil::emit {

struct DescribedOptions {
  std::string name = "plant";
};

/// A grammar and its moments, in its time. Where the text names a fruit, the flowers are over when the plant is fully grown.
struct DescribedPlant {
  simeco::Grammar grammar;
  double inFlower = 0;  ///< all its flowers are open; without flowers: fully grown
};

/// Fails with NoAnswer when nothing in `traits` says what the plant looks like.
[[nodiscard]] Result<DescribedPlant> describedPlant(const keywords::Traits& traits, const DescribedOptions& options = {});
/// Its grammar alone.
[[nodiscard]] Result<simeco::Grammar> describedGrammar(const keywords::Traits& traits, const DescribedOptions& options = {});

}  // namespace axil::emit
