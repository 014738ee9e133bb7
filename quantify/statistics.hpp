#pragma once
/// \file
/// Statistics over measurements: what is alike in a plant, and how its numbers range. Two ways of grouping: *templates*, the
/// thesis' way (segments whose rules have the same structure), and *orders* (a main stem is order 0, what branches off it 1).
/// Angles around a stem are circular: their range is the shortest arc that holds them all.
/// Source: L-Grammar Generator 2005, section 3.4.2.

#include "quantify/types.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace axil::quantify {

/// Range, mean and standard deviation (with n - 1; 0 for fewer than two) of plain numbers.
struct Spread {
  double low = 0;
  double high = 0;
  double mean = 0;
  double deviation = 0;
  std::size_t count = 0;
};
[[nodiscard]] Spread spreadOf(std::span<const double> values);

/// The shortest arc that holds all angles: `low` in (-pi, pi], `high` from `low` to less than a full turn more. Its mean and
/// deviation are those of the angles counted along that arc.
[[nodiscard]] Spread circularSpreadOf(std::span<const double> radians);

/// What a segment's rule looks like without its numbers.
struct RuleStructure {
  std::size_t branches = 0;  ///< bracketed children that are segments
  bool goesOn = false;       ///< has a main child
  std::size_t leaves = 0;
  friend auto operator<=>(const RuleStructure&, const RuleStructure&) = default;
};
[[nodiscard]] RuleStructure structureOf(const Segment& segment);

/// The numbers at one place of a template: the k-th branch, the main child or the k-th leaf of every member.
struct ChildSpread {
  Spread rotr;
  Spread rotu;
  Spread length;
};
struct LeafSpread {
  Spread rotr;
  Spread rotu;
  Spread roll;
  Spread length;
  Spread width;
  Spread petiole;
};

/// All segments of one structure; only structures with a child segment.
struct RuleTemplate {
  RuleStructure structure;
  std::vector<SegmentId> members;
  std::vector<ChildSpread> children;  ///< as Segment::children: the main child last
  std::vector<LeafSpread> leaves;
};

/// The plant's templates, ordered by their first member.
[[nodiscard]] std::vector<RuleTemplate> templatesOf(const Measurements& measurements);

/// Branching order of every segment: 0 along the main children from the root, one more at each branch.
[[nodiscard]] std::vector<int> ordersOf(const Measurements& measurements);

/// Everything of one branching order. An *axis* is a branch (or the root segment) with its main children to the tip.
struct OrderStatistics {
  int order = 0;
  Spread length;            ///< of a segment
  Spread radius;            ///< of the segments that have one
  Spread segmentsPerAxis;
  Spread bend;              ///< rotr of main children
  Spread bendAround;        ///< rotu of main children
  Spread insertion;         ///< rotr of the branches that leave this order
  Spread divergence;        ///< rotu of those branches
  std::vector<double> branchShares;  ///< [k]: share of the inner nodes (with a main child) that have k branches
  std::vector<double> leafShares;    ///< [k]: share of all segments that have k leaves
  LeafSpread leaf;
};
[[nodiscard]] std::vector<OrderStatistics> orderStatistics(const Measurements& measurements);

}  // namespace axil::quantify
