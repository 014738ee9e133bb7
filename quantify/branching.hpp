#pragma once
/// \file
/// Where along an axis branches stand, and what repeats.
///
/// The pattern is judged by how often nodes of the lower, middle and upper third of an axis branch, and by whether every k-th does. The youngest
/// nodes of an axis, which have had no time to branch, are left out: *delay* is how many nodes from the tip branches begin. Where branches stand
/// evenly, their sizes tell: clearly largest at the top is acrotonic; at the base basitonic, where they also grew faster for their age. Source: Barthelemy and Caraglio 2007 (terms).

#include "quantify/phyllotaxis.hpp"
#include "quantify/schedule.hpp"
#include "quantify/structure.hpp"

#include <array>
#include <span>
#include <vector>

namespace axil::quantify {

enum class BranchingHabit { None, Even, EveryKth, Acrotonic, Mesotonic, Basitonic };
[[nodiscard]] const char* nameOf(BranchingHabit habit);

struct BranchingPattern {
  int order = 0;                             ///< of the axes that bear the branches
  BranchingHabit habit = BranchingHabit::None;
  int period = 1;                            ///< every period-th node branches, ...
  int phase = 0;                             ///< ... those of this rank modulo the period
  int delay = 0;                             ///< nodes between an axis' tip and its youngest branches
  std::array<double, 3> shares{0, 0, 0};     ///< of the nodes of the lower, middle, upper third that branch
  std::array<double, 3> sizes{0, 0, 0};      ///< mean segments that a branch carries there
  std::size_t nodes = 0;                     ///< that were judged
  std::size_t branched = 0;
  double growthUnit = 0;                     ///< segments a growth unit has: the period, or a whole axis
};

/// Of the axes of `order`, of all plants together, whose schedule it is.
[[nodiscard]] BranchingPattern branchingPatternOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order);

/// Nodes between tip and youngest branches, of the axes of `order`; 0 where branches come with the next segment. Where branches grow steadily their own lengths tell when they
/// began: nodes at the top that have none then never will.
[[nodiscard]] int branchingDelayOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order);

}  // namespace axil::quantify
