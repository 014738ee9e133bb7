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
  std::string part = {};       ///< the piece or place of the organ that is meant: "lobe", "tube", "blade", "upper surface"; may be empty
  std::string which = {};      ///< which of the organ's kinds is meant: "basal", "upper", "staminate"; may be empty

  friend bool operator==(const Trait&, const Trait&) = default;
};

using Traits = std::vector<Trait>;

/// Words in the place of a statement that the vocabulary does not have ("leaves velutinose"): seen, but not understood.
struct UnknownTerm {
  std::string organ;  ///< what the words are about
  std::string text;
  SourceSpan span;
  std::size_t start = 0;
  std::size_t end = 0;

  friend bool operator==(const UnknownTerm&, const UnknownTerm&) = default;
};

/// Two statements of one text that cannot both hold. Both stay in the traits; `first` and `second` are their places there.
struct Contradiction {
  std::size_t first = 0;
  std::size_t second = 0;
  std::string what;  ///< "leaf arrangement: \"opposite\" against \"alternate\""

  friend bool operator==(const Contradiction&, const Contradiction&) = default;
};

/// All that a description says.
struct Reading {
  Traits traits;
  std::vector<UnknownTerm> unknown;
  std::vector<Contradiction> contradictions;

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// What a leaf arrangement means for geometry.
/// leavesPerNode leaves stand at each node, evenly around the stem; each node is turned by `divergence` against the one below.
struct ArrangementPreset {
  std::string name;       ///< "decussate"
  int leavesPerNode = 1;  ///< 1 alternate, 2 opposite, k whorled or fascicled
  Angle divergence;       ///< from one node to the next
  bool clustered = false; ///< fascicled, rosette: all nodes stand at one place of the stem (a rosette at its base)
  std::vector<Angle> cycle = {};  ///< where the turns differ from node to node: all of them in their order, repeated; else empty

  friend bool operator==(const ArrangementPreset&, const ArrangementPreset&) = default;
};

/// A number with its range, as the text gives it: typical values lie from low to high, exceptions from minimum to maximum.
/// Where the text has no exceptions, minimum is low and maximum is high; "up to 5" has low 0.
struct PresetRange {
  double minimum = 0;
  double low = 0;
  double high = 0;
  double maximum = 0;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }

  friend bool operator==(const PresetRange&, const PresetRange&) = default;
};

/// How a leaf is built; names are the vocabulary's.
struct LeafPreset {
  std::string type;  ///< "simple", "odd-pinnate"
  std::string apex, base, margin, venation, attachment;
  std::optional<PresetRange> length_m, width_m;  ///< of the blade; of a compound leaf as a whole
  std::optional<PresetRange> petiole_m;
  std::optional<PresetRange> angle_deg;          ///< between leaf and stem
  std::optional<PresetRange> leaflets;           ///< how many; pairs are counted twice (and the end leaflet of an odd-pinnate leaf)
  std::string leafletShape;
  std::optional<PresetRange> leafletLength_m, leafletWidth_m;
  std::optional<PresetRange> lobes;
  std::string colour;

  friend bool operator==(const LeafPreset&, const LeafPreset&) = default;
};

struct PlantPreset {
  std::string lifeForm, duration, habit;
  std::string branching;  ///< "monopodial", "sympodial", "dichotomous", "tufted"
  std::optional<PresetRange> height_m;
  std::optional<PresetRange> branchAngle_deg;
  std::string stemSection;

  friend bool operator==(const PlantPreset&, const PlantPreset&) = default;
};

struct FlowerPreset {
  std::string form;                       ///< a row of organs/data/flower_shapes.tsv; empty: not said
  std::string symmetry;                   ///< "actinomorphic", "zygomorphic"
  std::optional<PresetRange> merosity, petals, sepals, stamens;
  std::string petalShape, colour;
  std::optional<PresetRange> petalLength_m, tubeLength_m, diameter_m;
  std::string inflorescence, position;
  std::optional<PresetRange> inflorescenceLength_m, flowersPerInflorescence;

  friend bool operator==(const FlowerPreset&, const FlowerPreset&) = default;
};

struct FruitPreset {
  std::string type;
  std::string form;  ///< a row of organs/data/fruit_shapes.tsv
  std::string shape, colour;
  std::optional<PresetRange> length_m, diameter_m;

  friend bool operator==(const FruitPreset&, const FruitPreset&) = default;
};

/// The words that set a preset: the text, and where it stands (characters).
struct PresetEvidence {
  std::size_t start = 0;
  std::size_t end = 0;
  friend bool operator==(const PresetEvidence&, const PresetEvidence&) = default;
};

/// The defaults that a description sets for the measuring and drawing rooms. A member is empty where the text says nothing.
struct Presets {
  std::optional<ArrangementPreset> arrangement;
  std::string leafShape;                ///< a name that organs::leafShape knows; empty: not said
  std::string leafModel;                ///< the same with apex, base, margin, leaflets: a name that organs::leafModelNamed knows; empty: not said
  std::optional<double> leafLength_m;   ///< middle of the range in the text
  std::optional<double> leafWidth_m;
  LeafPreset leaf;
  PlantPreset plant;
  FlowerPreset flower;
  FruitPreset fruit;
  std::map<std::string, std::string> evidence;      ///< preset name -> the words that set it; "leaf.apex" for members of groups
  std::map<std::string, PresetEvidence> places;     ///< preset name -> where those words stand

  friend bool operator==(const Presets&, const Presets&) = default;
};

}  // namespace axil::keywords
