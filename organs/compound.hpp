#pragma once
/// \file
/// Compound leaves: leaflets on a rachis, or from one point, as a small structure of their own. Frame as of a leaf: the petiole
/// begins at the origin, the tip of the whole leaf is at about (0, 1, 0), the adaxial side looks to +Z. One unit is the whole
/// leaf, petiole included.

#include "organs/leaf.hpp"
#include "organs/types.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

enum class LeafType { OddPinnate, EvenPinnate, Bipinnate, Tripinnate, Palmate, Trifoliolate, Biternate, Unifoliolate, Bifoliolate };

/// "odd-pinnate", "bipinnate", ...; "pinnate" and "compound" mean odd-pinnate. Nothing for "simple" and unknown words.
[[nodiscard]] std::optional<LeafType> leafTypeNamed(std::string_view name);
[[nodiscard]] std::vector<std::string> leafTypeNames();

struct CompoundLeaf {
  LeafType type = LeafType::OddPinnate;
  int leaflets = 0;          ///< of the leaf, or of one pinna where it is pinnate more than once; 0: as many as is usual for the type
  int pinnae = 0;            ///< of a leaf that is pinnate more than once; 0: as is usual
  double leafletLength = 0;  ///< as a share of the whole leaf; 0: so that leaflets about touch
  double petiole = 0.14;     ///< the part of the leaf below the first leaflets
  LeafShape leaflet;

  friend bool operator==(const CompoundLeaf&, const CompoundLeaf&) = default;
};

/// How many leaflets the leaf has when it is drawn: what it says, brought to what its type can have (odd-pinnate: an odd number).
[[nodiscard]] int leafletCount(const CompoundLeaf& leaf);

/// Parts "blade" (all leaflets), "rachis", and what leaflets have ("vein" at Close with up to 15 leaflets). A leaflet is drawn one
/// level lighter than a leaf, at Far as two triangles.
[[nodiscard]] std::vector<Part> compoundParts(const CompoundLeaf& leaf, Detail detail);

}  // namespace axil::organs
