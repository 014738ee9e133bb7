#pragma once
/// \file
/// The nouns of quantifying: a skeleton as numbers that a grammar can carry.
///
/// Everything is per *segment*: one straight piece of a stem between two neighbouring nodes, what the thesis calls a stem
/// and SimEco a Stage. Lengths are in the project's unit. The turning rule that `rotr`, `rotu` and `rAxis` obey is
/// base/turning.hpp. Source: L-Grammar Generator 2005, section 3.3.

#include "base/frames.hpp"
#include "base/ids.hpp"
#include "skeleton3d/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axil::quantify {

/// Leaves that a user gives a stem, before they have places. What is left out comes from the description's presets, else
/// from stated defaults (quantify/leaves.hpp).
struct LeafArrangement {
  skeleton3d::StemId stem;
  std::string arrangement;               ///< "decussate"; a name that keywords::arrangementNamed knows
  std::optional<int> nodes;              ///< how many leaf nodes, spread evenly along the stem
  std::vector<skeleton3d::NodeId> at;    ///< or the skeleton nodes that carry leaves
  std::optional<Angle> angle;            ///< between the stem and the blade
  std::optional<Angle> roll;             ///< of the blade about itself
  std::optional<Angle> azimuth;          ///< around the stem, of the first leaf: its rotu at that node
  std::optional<double> length;          ///< of the blade
  std::optional<double> width;
  std::optional<double> petiole;
  std::string shape;

  friend bool operator==(const LeafArrangement&, const LeafArrangement&) = default;
};

struct SegmentTag;
using SegmentId = Id<SegmentTag>;  ///< index into Measurements::segments

/// root: the first segment. main: the child that goes on most nearly straight. branch: every other child.
enum class SegmentKind { Root, Main, Branch };

/// A leaf as it leaves a segment's tip: first turned like a child segment (rotr, rotu, as a branch), then rolled about itself.
struct LeafMeasure {
  Angle rotr;           ///< between the segment's direction and the leaf's
  Angle rotu;           ///< around the segment
  Angle roll;           ///< of the blade about its own direction, away from facing the segment's tip
  PlantDirection direction = PlantDirection::up();                  ///< the same leaf as it stands in the plant's frame
  PlantDirection normal = PlantDirection::along({0, 0, 1});         ///< its adaxial side, perpendicular to `direction`
  double length = 0;    ///< of the blade
  double width = 0;
  double petiole = 0;   ///< length of the stalk; 0: sessile
  std::string shape;    ///< a name that organs::leafShape knows; empty: unknown
  std::size_t skeletonLeaf = 0;  ///< index into Skeleton::leaves
};

struct Segment {
  skeleton3d::StemId stem;
  skeleton3d::NodeId from;
  skeleton3d::NodeId to;
  std::optional<SegmentId> parent;
  std::vector<SegmentId> children;  ///< the main child last, as the thesis prints it; else ascending rotr, ties by id
  int level = 0;                    ///< segments between the root and this one (Dijkstra, each segment counts 1)
  SegmentKind kind = SegmentKind::Root;
  PlantDirection direction = PlantDirection::up();
  double length = 0;
  std::optional<double> radius;      ///< at its upper end, else at its lower one; none: nobody measured it
  Angle rotr;                        ///< how far it bends away from its parent, 0 to 180 degrees
  Angle rotu;                        ///< how far it then turns around its parent
  PlantDirection rAxis = PlantDirection::up();  ///< the axis its children bend away about
  std::vector<LeafMeasure> leaves;   ///< that leave from its tip
};

/// A whole plant as numbers. Segments come parent before child: level by level, then by their stem's id; the first is the
/// root segment. A plant that divides at its collar has further segments of level 0: branches without a parent, measured
/// against the root segment's frame, as are the leaves that stand at the collar.
struct Measurements {
  std::string unit = "m";
  PlantPoint origin;                  ///< where the root node stands
  std::vector<Segment> segments;      ///< never empty
  std::vector<LeafMeasure> rootLeaves;  ///< leaves that leave from the root node

  [[nodiscard]] const Segment& at(SegmentId id) const { return segments[static_cast<std::size_t>(id.value)]; }
};

}  // namespace axil::quantify
