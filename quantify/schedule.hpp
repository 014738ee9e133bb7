#pragma once
/// \file
/// When each part of a plant was made, in *stages*: the time in which the leading axis makes one segment. A moment of a plant does not say when it
/// was; this reads it off how long branches are for their place, and says which axes still grow.
///
/// The plant is `now` stages old: its longest path has now + 1 segments. A branch whose bearer was made at stage b has had now - b stages. An
/// order is *steady* where a good part of its axes reach, with what stands on them, exactly as many segments as stages since they began, `delay` stages after
/// their bearer: axes that have all their segments still grow, those that fall short have ended (or forked). Where no such rule shows, as on most real
/// plants, or where axes that rest by chance explain the numbers better, the order grows at a *rate*: the likeliest chance of a segment a stage (binomial; axes that
/// have none yet are not seen), for `lasting` stages if older branches are no longer than that. Steady orders, too, stop where nearly all older axes have one number of segments.
/// Rates of orders above the leader's are the measured apical control. Source: de Reffye's crown analysis in the wording of Barthelemy and Caraglio 2007.

#include "quantify/phyllotaxis.hpp"
#include "quantify/structure.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axil::quantify {

struct OrderSchedule {
  int order = 0;
  bool steady = true;
  int delay = 0;                  ///< stages between a bearer and the earliest start of what branches off it, beyond the usual one; -1: branches come together with their bearer
  double rate = 1;                ///< segments a stage while it grows
  std::optional<double> lasting;  ///< stages after which it has stopped; none: no end seen
  std::size_t axes = 0;           ///< that it was judged by
};

struct PlantSchedule {
  double now = 0;                 ///< stage of the newest segment; the first is 0. Plants in which everything has ended may be older (five plants and more tell, by how often axes end and how many plants are of an age)
  std::vector<double> birth;      ///< stage of each segment
  std::vector<bool> grows;        ///< of each axis
};

struct Schedule {
  std::vector<OrderSchedule> orders;   ///< from order 0
  std::vector<PlantSchedule> plants;
  bool branchesAtOnce = false;         ///< a branch's first segment comes together with the one it stands on

  /// Of orders above the highest seen, the highest's.
  [[nodiscard]] const OrderSchedule& of(int order) const;
};

/// Branches come together with their bearers where the tips of three first axes and more bear some, all of a single segment, though first axes go on past others.
[[nodiscard]] Schedule scheduleOf(std::span<const MeasuredPlant> plants);

}  // namespace axil::quantify
