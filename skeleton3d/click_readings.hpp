#pragma once
/// \file
/// Private to skeleton3d: which of a node's clicks are right. Every way to read them is weighed, all right, all but one, only
/// one, by how well the right ones meet, by how far the wrong ones would be off, by where the node's stems let one expect it,
/// and, where photos are at hand, by whether each of them shows a stem there. With one right click the node is somewhere on its ray.
///
/// Weights are the probabilities of the readings (Bayes), with flat expectations of what nothing is known of.
/// Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/stem_course.hpp"
#include "skeleton3d/stem_evidence.hpp"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

/// What the readings of a node are weighed by.
struct Grounds {
  std::span<const View> views;
  double click_px = 1;
  const StemCourse& course;
  const StemEvidence* evidence = nullptr;  ///< none: the photos are not at hand
};

struct ClickReading {
  std::set<std::string> right;  ///< views whose clicks are meant for the node
  glm::dvec3 at{0, 0, 0};
  double weight = 0;            ///< of all readings together 1
  glm::dvec3 sigmaAlong{0, 0, 0};  ///< with one right click: how far along its ray the node may be from `at`
};

/// The likeliest first. Empty for a node that no reading gives a place.
[[nodiscard]] std::vector<ClickReading> readingsOf(const ClickedNode& node, const Grounds& grounds);

}  // namespace axil::skeleton3d::detail
