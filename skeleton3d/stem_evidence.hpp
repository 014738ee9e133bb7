#pragma once
/// \file
/// Private to skeleton3d: what the photos say of whether a stem is seen at a place. A node that is where it is said to be lies
/// on a stem in every photo; one that wrong clicks have moved lies beside it in some.
///
/// How clearly stems stand out is learned from the plant's own trusted nodes, view by view: how often a ridge like theirs is
/// found on a stem, and how often some way beside it. In a blurred or uniform photo both are alike, and it says nothing.
/// Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/snap_place.hpp"
#include "skeleton3d/stemness.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

struct SeenStems {
  StemnessMap stems;
  std::vector<float> worth;   ///< of each cell, 0 to 1: how much it looks like a stem, by its edges and, where they tell, by its colour
  double reach_px = 8;        ///< how far beside a place its stem may be seen
  std::vector<double> ratio;  ///< logarithm of how much likelier each likeness (0 to 1, in even bins) is on a stem than beside it
};

struct StemEvidence {
  std::map<std::string, SeenStems> views;
};

/// `places`: of nodes that can be trusted. Photos in which too little is seen are left out.
[[nodiscard]] StemEvidence learnedEvidence(const Photos& photos, std::span<const View> views, const std::map<NodeId, glm::dvec3>& places, std::span<const ClickedStem> stems,
                                           double click_px);

/// The logarithm of how much likelier what the photos show is with a node of a stem along `run` at `at` than without; 0 where nothing says so.
[[nodiscard]] double evidenceAt(const StemEvidence& evidence, std::span<const View> views, const glm::dvec3& at, const glm::dvec3& run);

}  // namespace axil::skeleton3d::detail
