#pragma once
/// \file
/// GrowthPath: an organ's tip as a particle. While the organ grows out the tip runs along its heading, and what pulls at it turns the
/// heading; the trail that it leaves is the organ.
///
/// An organ's full growth is cut into equal steps of its age. In each the heading h follows dh/du = F - (F.h) h for the pull F, u
/// being the share of the growth: a pull of 1 turns an organ that stands across it by about 1 radian. The step's solution is exact, so a
/// strong pull turns the heading up to its own direction and never past it. The tip runs along the heading in the middle of the step.
/// A step depends on what was there when it began, never on what comes later; growing on only lengthens the last piece.
///
/// Near an obstacle that it heads for, a tip is pulled aside as well, along the obstacle. A step that would still come nearer to it than the organ's
/// clearance slides along it; where no way is left the organ ends. A step is tested with the greatest length it can have, exactly, along
/// all of it, so no step is long enough to jump through a wall.
/// Internal to growth. Sources: docs/simeco.md, "Growth as a particle"; The Algorithmic Beauty of Plants, section 2.3.4 (tropism).

#include "base/turning.hpp"
#include "simeco/obstacle_field.hpp"

#include <span>
#include <vector>

namespace axil::simeco {

/// One step of an organ's growth.
struct PathStep {
  double length = 0;      ///< that it has by now
  double reach = 0;       ///< that it can have at most
  double share = 1;       ///< of the step that is over: 1, or less for the last one
  glm::dvec3 pull{0};     ///< over the whole growth
  const ObstacleField* obstacles = nullptr;
};

struct PathRules {
  int steps = 8;          ///< of the full growth; a path may have fewer by now
  double clearance = 0;   ///< from obstacles; above 0
  double sight = 0;       ///< how far away an obstacle is felt
};

struct Path {
  std::vector<PlantPoint> trail;  ///< base to tip; empty where it is straight
  StemFrame tip;                  ///< the frame carried along without twist
  double length = 0;
  bool stopped = false;           ///< there was no way on: it is shorter than its steps
};

/// The trail of a stem that starts at `base` in `frame`.
[[nodiscard]] Path followPath(const PlantPoint& base, const StemFrame& frame, std::span<const PathStep> steps, const PathRules& rules);

/// A body that does not bend (a leaf, a flower, a fruit) swings as a whole.
struct Swing {
  StemFrame frame;
  double length = 0;      ///< shorter than asked for where an obstacle leaves no room
};

/// `reach` is the most that the body will ever be long, `length` what it is now.
[[nodiscard]] Swing swingBody(const PlantPoint& base, const StemFrame& frame, std::span<const PathStep> steps, const PathRules& rules, double length, double reach);

}  // namespace axil::simeco
