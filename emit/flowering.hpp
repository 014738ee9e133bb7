#pragma once
/// \file
/// What a description says of flowers and fruits, as a plan to grow them by; and the door by which they reach a measured plant, whose photos
/// and clicks say nothing of them. Lengths in metres.

#include "base/result.hpp"
#include "emit/inflorescence.hpp"
#include "keywords/types.hpp"
#include "quantify/types.hpp"
#include "simeco/grammar.hpp"

#include <string>
#include <vector>

namespace axil::emit {

/// Where inflorescences stand and what they are.
struct Flowering {
  bool axillary = false;
  bool terminal = true;
  InflorescencePlan plan;
  std::vector<std::string> notes;  ///< in words, each with those of the text that it stands on
};

/// The plant that the flowers are for: what the text leaves open is as usual on one of its size.
struct FloweringScale {
  double leaf_m = 0.06;
  double height_m = 0.4;
  double metresPerUnit = 1;  ///< of the grammar's lengths
};
[[nodiscard]] FloweringScale floweringScaleOf(const quantify::Measurements& measurements, double metresPerUnit);

/// Nothing where the text says nothing of flowers.
[[nodiscard]] std::optional<Flowering> floweringOf(const keywords::Traits& traits, const keywords::Presets& presets, const FloweringScale& scale);

/// `grammar`, predictive or structured, with inflorescences at the ends of the axes it makes, in the axils of the leaves it makes, or both, as the
/// text says; what was measured stays as it is. The grammar unchanged where the text says nothing of flowers, or where no axis grows on.
/// Never fails but by a fault of ours in the inflorescence's text.
[[nodiscard]] Result<simeco::Grammar> withFlowers(simeco::Grammar grammar, const keywords::Traits& traits, const FloweringScale& scale);

}  // namespace axil::emit
