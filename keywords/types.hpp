#pragma once
/// \file
/// The nouns of the keyword room: what a description says about a plant, each fact with the words it was read from.
/// Source: L-Grammar Generator 2005, section 3.1.

#include "base/angle.hpp"
#include "base/source.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axil::keywords {

/// One fact: "leaf arrangement is opposite", "leaf length is 3 to 8 cm". `value` is the concept's English name; a measured
/// fact has `low`, `high` and, where the text gives one, `unit` instead. `span` are the bytes of `text` in the description;
/// `start` and `end` are the same place counted in characters (code points), as the JSON of FORMATS.md gives it.
struct Trait {
  std::string organ;     ///< "leaf", "flower", "plant"
  std::string property;  ///< "arrangement", "shape", "length"
  std::string value;
  std::optional<double> low;
  std::optional<double> high;
  std::string unit;
  std::string text;  ///< the words, exactly as they stand
  SourceSpan span;
  std::size_t start = 0;
  std::size_t end = 0;
  std::optional<double> minimum = {};  ///< the outer numbers of "(12-)23-34(-40)", where the text gives them
  std::optional<double> maximum = {};
  std::string qualifier = {};  ///< "rarely", "usually", "narrowly", "up to": how far the statement holds; may be empty

  friend bool operator==(const Trait&, const Trait&) = default;
};

using Traits = std::vector<Trait>;

/// What a leaf arrangement means for geometry.
/// leavesPerNode leaves stand at each node, evenly around the stem; each node is turned by `divergence` against the one below.
struct ArrangementPreset {
  std::string name;       ///< "decussate"
  int leavesPerNode = 1;  ///< 1 alternate, 2 opposite, k whorled or fascicled
  Angle divergence;       ///< from one node to the next
  bool clustered = false; ///< fascicled, rosette: all nodes stand at one place of the stem (a rosette at its base)

  friend bool operator==(const ArrangementPreset&, const ArrangementPreset&) = default;
};

/// The defaults that a description sets for the measuring and drawing rooms. A member is empty where the text says nothing.
struct Presets {
  std::optional<ArrangementPreset> arrangement;
  std::string leafShape;                ///< a name that organs::leafShape knows; empty: not said
  std::optional<double> leafLength_m;   ///< middle of the range in the text
  std::optional<double> leafWidth_m;
  std::map<std::string, std::string> evidence;  ///< preset name -> the words that set it

  friend bool operator==(const Presets&, const Presets&) = default;
};

}  // namespace axil::keywords
