#pragma once
/// \file
/// Private to skeleton3d: where a stem's neighbouring nodes let one expect a node, to tell which of its clicks are wrong where
/// the views alone cannot, and where on the ray of one good click it is.
///
/// A node between two others is expected near the smooth curve through its neighbours, one at an end of its stem near where
/// the stem would go on. How near is learned from the plant's own nodes; tails are heavy, since plants do bend. Project's unit.

#include "skeleton3d/types.hpp"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

/// A node within one stem: the nodes with a place before and after it, the nearest first, at most two each.
struct Neighbours {
  std::vector<NodeId> before, after;
};

struct StemCourse {
  std::map<NodeId, glm::dvec3> places;
  std::map<NodeId, std::vector<Neighbours>> around;  ///< by stem; the stem that passes through a node comes first
  double bend = 0.1;   ///< typical distance of a node from its neighbours' curve, as a share of their distance
  double step = 0;     ///< typical length of a segment; 0: no stem has two places
  double noise = 0;    ///< how exactly places are known
  double reach = 1;    ///< size of the whole plant
};

/// Nodes without a place are passed over: their neighbours follow one another.
[[nodiscard]] StemCourse stemCourseOf(std::span<const ClickedStem> stems, std::map<NodeId, glm::dvec3> places, double noise);

/// The logarithm of the density, per cubed unit, with which `node` is expected at `at`.
[[nodiscard]] double expectationAt(const StemCourse& course, NodeId node, const glm::dvec3& at);

/// Where its neighbours put `node`, and how far about that it may be; nothing for a node without neighbours.
struct ExpectedPlace {
  glm::dvec3 at{0, 0, 0};
  double reach = 0;
};
[[nodiscard]] std::optional<ExpectedPlace> expectedPlace(const StemCourse& course, NodeId node);

/// There the node would be far off its stems: more than `times` what is usual.
[[nodiscard]] bool leapsAt(const StemCourse& course, NodeId node, const glm::dvec3& at, double times);

/// Which way its stem runs at `node` if that is at `at`; zero where nothing says so.
[[nodiscard]] glm::dvec3 directionAt(const StemCourse& course, NodeId node, const glm::dvec3& at);

}  // namespace axil::skeleton3d::detail
