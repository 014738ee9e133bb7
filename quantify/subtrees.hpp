#pragma once
/// \file
/// Repeated subtrees: parts of a plant that are the same part again. A subtree is a segment with all that stands on it.
///
/// *Same shape*: the same branching and leaves, whatever the numbers. *Exact*: the same shape with the same numbers (relative lengths, rotr, azimuth,
/// leaves) within a small tolerance, wherever and however large it stands. *Approximate*: most of the two lies on each other when axes are laid
/// base to base and branches rank to rank; `likeness` is twice what matches over the sizes of both, 0 to 1.
/// Sources: Godin and Ferraro 2010 (self-nestedness and tree reduction); Aho, Hopcroft and Ullman 1974 (isomorphism of trees).

#include "quantify/structure.hpp"

#include <cstddef>
#include <vector>

namespace axil::quantify {

struct SubtreeTolerance {
  double length = 0.02;               ///< relative
  Angle angle = Angle::fromDegrees(2);
};

/// Subtrees that are one, each with its places.
struct SubtreeClass {
  std::vector<SegmentId> members;     ///< in ascending order
  std::size_t segments = 0;           ///< of one of them
  bool scaled = false;                ///< members differ in size
};

struct Repetition {
  std::vector<std::size_t> shapeOf;    ///< class of each segment's subtree by shape alone
  std::size_t shapes = 0;
  std::vector<SubtreeClass> exact;     ///< of two segments and more, repeated, largest first
  double reduction = 0;                ///< 1 - shapes / segments: how much of the plant is repetition
};
[[nodiscard]] Repetition repetitionsOf(const Measurements& measurements, const PlantStructure& structure, const SubtreeTolerance& tolerance = {});

/// How alike the subtrees of two segments are. A matched segment counts fully when its angle and relative length agree within `tolerance`,
/// else half.
[[nodiscard]] double likeness(const Measurements& measurements, const PlantStructure& structure, SegmentId a, SegmentId b, const SubtreeTolerance& tolerance = {});

/// Axes of one order grouped so that each is at least `least` alike to its group's first; groups of two and more, largest first.
[[nodiscard]] std::vector<std::vector<AxisId>> similarAxes(const Measurements& measurements, const PlantStructure& structure, double least = 0.75,
                                                           const SubtreeTolerance& tolerance = {0.25, Angle::fromDegrees(20)});

}  // namespace axil::quantify
