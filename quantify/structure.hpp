#pragma once
/// \file
/// The architecture of a measured plant: which segments make one *axis*, and what order, rank and end each has.
///
/// An axis goes on along the stem that was clicked (or grown) as one; where a stem ends, an only child goes on (unless it leans like
/// the plant's branches and not like its bends), and of several the straightest, unless the plant forks there: where stems end in children that lean alike (the median of least over
/// second angle is above a half; above a third where even the least leans clearly unlike the stems' bends) none goes on, each child begins an axis of the next order, and the axis is
/// a sympodial module. Plants of a kind are judged together.
/// *Order* is 0 for the axis of the root segment and one more at each insertion. *Rank* counts segments from the axis' base, from 0;
/// `fromTip` counts them from its tip, from 0. A *node* is a segment's tip that carries a leaf, an axis or a fork; an
/// *internode* is the run of segments up to a node. A *growth unit* is one period of an axis' branching pattern (branching.hpp).
/// Sources: L-Grammar Generator 2005, section 3.3; Prusinkiewicz and Lindenmayer 1990, chapter 1.

#include "quantify/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace axil::quantify {

struct AxisTag;
using AxisId = Id<AxisTag>;  ///< index into PlantStructure::axes

struct Axis {
  std::vector<SegmentId> segments;      ///< base to tip, never empty
  std::optional<SegmentId> bearer;      ///< at whose tip it is inserted; none: at the collar
  std::optional<AxisId> parent;         ///< of the bearer
  int order = 0;
  bool forks = false;                   ///< its last node bears two axes or more and nothing goes on
  std::vector<AxisId> laterals;         ///< in the order of their bearers along this axis

  [[nodiscard]] SegmentId base() const { return segments.front(); }
  [[nodiscard]] SegmentId tip() const { return segments.back(); }
};

/// Where a segment stands, and what its tip carries.
struct SegmentPlace {
  AxisId axis;
  int order = 0;
  int rank = 0;
  int fromTip = 0;
  int branches = 0;        ///< axes inserted at its tip
  bool goesOn = false;     ///< the axis has a further segment
  bool isNode = false;     ///< a leaf, an axis or a fork stands at its tip
  double twist = 0;        ///< azimuth, around this segment, at which a child with rotu 0 would stand
  double azimuth = 0;      ///< of this segment around its bearer or predecessor, radians, see azimuthOf
};

enum class Branching { None, Monopodial, Sympodial };

struct PlantStructure {
  std::vector<Axis> axes;             ///< a parent before its laterals; the first has order 0
  std::vector<SegmentPlace> places;   ///< of Measurements::segments
  int orders = 0;                     ///< how many there are
  Branching branching = Branching::None;
  double straightness = 1;            ///< 1 - median of (angle of what goes on) / (angle of its sister), at branched nodes; a fork: 0
  std::vector<std::vector<double>> leafAzimuths;  ///< of each segment's leaves; NaN where a leaf runs along its stem

  [[nodiscard]] const Axis& at(AxisId id) const { return axes[static_cast<std::size_t>(id.value)]; }
  [[nodiscard]] const SegmentPlace& at(SegmentId id) const { return places[static_cast<std::size_t>(id.value)]; }
};

/// Where stems end in several children: the straightest goes on, or none does.
enum class StemEnds { GoOn, Fork };
/// What the stems' ends of all plants together tell; GoOn where none ends so.
[[nodiscard]] StemEnds stemEndsOf(std::span<const Measurements> plants);

/// The structure of `measurements`, which must have a segment; stem ends by what this plant alone tells where they are not given. Azimuths are angles around an axis from a side that follows the axis' bends
/// without twisting, counted as rotu is; between two nodes of one axis they differ by the divergence, whatever wrote the plant. They are NaN
/// for what leaves within half a degree of straight on or straight back.
[[nodiscard]] PlantStructure plantStructure(const Measurements& measurements, StemEnds ends);
[[nodiscard]] PlantStructure plantStructure(const Measurements& measurements);
/// Of plants of one kind, judged together.
[[nodiscard]] std::vector<PlantStructure> plantStructures(std::span<const Measurements> plants);

/// Lengths of an axis' internodes from base to tip: segments up to and with the one whose tip is a node; what follows the last node counts as one.
[[nodiscard]] std::vector<double> internodesOf(const Measurements& measurements, const PlantStructure& structure, const Axis& axis);

}  // namespace axil::quantify
