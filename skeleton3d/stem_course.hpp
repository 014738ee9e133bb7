#pragma once
/// \file
/// Private to skeleton3d: how evenly stems run through a place, to tell which of two clicks is the wrong one where the views
/// alone cannot: a click that is off along one axis of space contradicts another view, but not which of the two is right.
///
/// Measure: at every inner node of a stem the detour over it, (|ab| + |bc|) / |ac| - 1, whose root grows evenly with how far
/// the node leaps aside. Usual is the median over all stems; a leap counts with a heavy tail, since plants do bend.

#include "skeleton3d/types.hpp"

#include <array>
#include <map>
#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

struct StemCourse {
  std::map<NodeId, glm::dvec3> places;
  std::map<NodeId, std::vector<std::array<NodeId, 3>>> around;  ///< the runs of three nodes that a node is part of
  double usual = 0;                                             ///< median root of a detour; 0: no run of three
};

/// Nodes without a place are passed over: their neighbours follow one another.
[[nodiscard]] StemCourse stemCourseOf(std::span<const ClickedStem> stems, std::map<NodeId, glm::dvec3> places);

/// The logarithm of how likely `node` stands at `at`, up to a constant; 0 for a node of no stem.
[[nodiscard]] double likelihoodAt(const StemCourse& course, NodeId node, const glm::dvec3& at);

/// There the node would be far off its stems, by how nodes usually follow one another.
[[nodiscard]] bool leapsAt(const StemCourse& course, NodeId node, const glm::dvec3& at);

}  // namespace axil::skeleton3d::detail
