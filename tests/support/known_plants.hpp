#pragma once
/// \file
/// Builders of plants whose truth is known, as skeletons. Random ones are drawn from a seed and are the same on every machine.

#include "base/rng.hpp"
#include "skeleton3d/types.hpp"

#include <span>
#include <vector>

namespace axil::test {

struct RandomTreeOptions {
  int segments = 30;
  double segmentLength = 0.08;   ///< lengths are drawn between a tenth of this and this
  double wander = 0.6;           ///< 0: every stem goes on straight; 1: every direction is as likely as any other
  double branching = 0.4;        ///< share of nodes at which a new stem begins instead of the current one going on
  int leaves = 6;
  int collarBranches = 0;        ///< further stems that begin at the root
  bool radii = true;
};

/// A tree of `segments` segments in stems of random length, with leaves (some on stalks, some at the tip) when asked for.
[[nodiscard]] skeleton3d::Skeleton randomTree(Rng& rng, const RandomTreeOptions& options = {});

/// One stem through `points`, node ids 1, 2, ...
[[nodiscard]] skeleton3d::Skeleton chainThrough(std::span<const glm::dvec3> points);

/// Adds a stem that leaves node `from` and runs through `points`; node and stem ids go on from the largest.
void addStem(skeleton3d::Skeleton& skeleton, skeleton3d::StemId parent, skeleton3d::NodeId from, std::span<const glm::dvec3> points);

/// The same plant turned about +Y; leaves turn with it.
[[nodiscard]] skeleton3d::Skeleton turnedAboutY(const skeleton3d::Skeleton& skeleton, Angle angle);

/// The same plant with its nodes and stems listed in another order (a parent still before its children).
[[nodiscard]] skeleton3d::Skeleton shuffled(const skeleton3d::Skeleton& skeleton, Rng& rng);

/// Highest minus lowest node.
[[nodiscard]] double heightOf(const skeleton3d::Skeleton& skeleton);

/// A direction, every one as likely as any other.
[[nodiscard]] PlantDirection randomDirection(Rng& rng);

}  // namespace axil::test
