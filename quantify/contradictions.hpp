#pragma once
/// \file
/// Text against photo: what a description says of leaves and branches, compared with what was measured. A contradiction shows both
/// pieces of evidence, the words and the numbers; neither is changed. Angles in degrees, lengths in the text's unit.
///
/// Only clear cases count: at least three measured nodes or leaves, statements without "rarely" or "sometimes", and none of the
/// alternatives that the text gives ("opposite or alternate") fits. A divergence contradicts when it is off by more than 15 degrees and
/// three standard errors; an angle when it lies more than 10 degrees outside the text's range; a length when the measured mean
/// lies more than 15 % outside it. Sources: L-Grammar Generator 2005, sections 3.1 and 3.2.3.

#include "keywords/types.hpp"
#include "quantify/types.hpp"

#include <string>
#include <vector>

namespace axil::quantify {

struct PhotoContradiction {
  std::string words;     ///< as they stand in the text: "opposite"
  std::size_t start = 0;  ///< where, in characters of the description
  std::size_t end = 0;
  std::string measured;  ///< "measured nodes carry one leaf, divergence 139 +- 6 degrees"

  /// `text: "opposite"; measured nodes carry one leaf, ...`
  [[nodiscard]] std::string line() const { return "text: \"" + words + "\"; " + measured; }
  friend bool operator==(const PhotoContradiction&, const PhotoContradiction&) = default;
};

[[nodiscard]] std::vector<PhotoContradiction> contradictionsWith(const keywords::Traits& said, const Measurements& measurements);

}  // namespace axil::quantify
