#pragma once
/// \file
/// Outlook: what a measured plant's next stages will be like, by branching order, and what each of its own tips will do next.
///
/// From layered statistics come, for each order: how fast its axes grow and when they stop (schedule), what becomes of a tip (goes on, branches, forks,
/// ends) and at which ranks (fates), how leaves and branches stand, how large leaves get, how many stages they take and after how many they are gone.
/// The length of a next segment is foretold by the rule that foretold the measured ones best, each from the segments below it: the order's
/// trend along the rank, the axis' own level on that trend, or the segment below times the usual ratio; its misses make the interval.
/// A trend may bend (lengths that swell and then dwindle along an axis, or with the age of the plant; that rise to a level, fall to one or leave one, bow.hpp) where that is more than chance: by the Bayesian
/// information criterion, with the levels of axes free, an order that shows no law of its own taking that of all orders together; where the youngest segments
/// have clearly left it, the segment below is taken on by the ratio that is usual among them. Rules that are no better than chance are not told apart: fewer than three misses take
/// the segment below. Source of the idea: L-Grammar Generator
/// 2005, section 3.4.2 and chapter 4; choice by hindsight as in Hyndman and Athanasopoulos, Forecasting (2021), section 5.10.

#include "base/result.hpp"
#include "quantify/bow.hpp"
#include "quantify/layers.hpp"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace axil::quantify {

enum class LengthRule { Trend, Axis, Last };
[[nodiscard]] const char* nameOf(LengthRule rule);

/// What lengths follow: the place on their axis, or the age of the whole plant when they were made, whatever axis they are on.
enum class LengthsAlong { Rank, Stage };

/// How lengths of an order's next segments are foretold. Misses are of logarithms.
struct LengthOutlook {
  LengthRule rule = LengthRule::Trend;
  LengthsAlong along = LengthsAlong::Rank;
  double step = 1;          ///< factor from rank (stage) 0 to the next
  double curve = 1;         ///< by which that factor changes from rank to rank, where lengths are seen to swell or to dwindle so
  std::optional<Bow> bow;   ///< that lengths follow instead of those steps
  double miss = 0;          ///< standard deviation of log(true / foretold)
  std::size_t samples = 0;  ///< segments it was judged by
  /// The logarithm at a rank (or stage), against its order's level.
  [[nodiscard]] double at(double place) const;
};

/// What the first segment of a new axis follows: what is usual for its order, its order's course by the stage in which it begins, its bearer's length, or the level that its bearer's axis keeps to there.
enum class StartRule { Usual, Stage, Bearer, Level };

/// One of the axes that leave a node together, where they differ (arms.hpp).
struct ArmOutlook {
  Estimate insertion;
  double ratio = 1;                 ///< of its first segment to the bearer's length (or level)
};

struct OrderOutlook {
  int order = 0;
  OrderSchedule schedule;
  FateTable fates;                  ///< of nodes below `most`
  std::optional<int> most;          ///< segments at which axes of this order end, if they do
  int delay = 0;                    ///< stages after its node that a branch begins, beyond the usual one
  LengthOutlook length;
  double usualLength = 0;           ///< of an axis' first segment; where starts follow the stage, over the course's value there
  StartRule start = StartRule::Usual;
  double bearerRatio = 1;           ///< of axes of this order: the first segment's length over its bearer's (or the bearer's level)
  double startMiss = 0;             ///< standard deviation of log(true / foretold) of first segments
  std::size_t starts = 0;           ///< axes it was judged by
  std::map<int, std::vector<ArmOutlook>> arms;  ///< of what this order bears, by the number of axes at the node
  Estimate bend;
  Estimate insertion;               ///< of axes of this order
  double radius = 0;                ///< of young segments; 0: none measured
  double divergence = 0;            ///< radians, from node to node, as wound on the plant
  double divergenceDeviation = 0;
  double firstAzimuth = 0;          ///< of an axis' first node; meaningful where `startsAlike`
  bool startsAlike = false;
  int perNode = 0;                  ///< leaves
  double leafShare = 0;             ///< of new nodes that have them
  bool leafAtOwnTip = true;         ///< a leaf comes with the segment it tips; else with the next one
  double leafAngle = 0, leafAngleDeviation = 0;
  double leafLength = 0, leafWidth = 0, petiole = 0;
  double leafDeviation = 0;         ///< of the logarithm of a grown leaf's length
  double leafStages = 1;            ///< stages until it is grown
  std::optional<double> leafSpan;   ///< nodes from the tip on which leaves stand, where older ones are bare, for whatever reason
  std::optional<double> leafLasts;  ///< stages after which a leaf has fallen: the span, where stems of several lengths tell that age is the reason
  double branchBesideLeaf = 0;      ///< azimuth of a branch against the leaf of its node
  std::size_t segments = 0;         ///< measured

  /// Foretold median of a new axis' first segment, made in `stage` on a segment of length `bearer` where its axis' level is `level`.
  [[nodiscard]] double firstLength(double bearer, double level, double stage) const;
};

/// What one measured axis will do next.
struct TipOutlook {
  AxisId axis;
  SegmentId tip;
  int order = 0;
  int nextRank = 0;
  double length = 0;      ///< foretold median of its next segment
  double low = 0;         ///< 90 % of true ones lie between
  double high = 0;
  double miss = 0;        ///< of the logarithm, with the axis' own uncertainty
  double azimuth = 0;     ///< rotu at which the next node's organs would stand
};

/// A measured node that may yet branch.
struct BudOutlook {
  SegmentId at;
  int order = 0;          ///< of what would grow from it
  int waits = 0;          ///< stages
  double share = 0;       ///< how likely
  double length = 0;
  double rotu = 0;
};

struct Outlook {
  std::vector<OrderOutlook> orders;   ///< of sympodial plants, whose axes are of one kind, one more than was measured: what comes above
  std::size_t plant = 0;          ///< whose tips follow
  std::vector<TipOutlook> tips;   ///< of that plant, ascending
  std::vector<double> levels;     ///< of each of its segments: the length that its axis keeps to there, without the segment's own chance
  std::vector<BudOutlook> buds;
  LayeredStatistics statistics;
  [[nodiscard]] double now() const { return statistics.schedule.plants[plant].now; }   ///< that plant's newest stage
  [[nodiscard]] const OrderOutlook& of(int order) const;  ///< of orders above the highest, the highest's
};

/// The outlook of the first plant, by what all of them show. Fails as layeredStatistics does, and with NoAnswer where no segment of any plant has a
/// child: nothing shows how it goes on.
[[nodiscard]] Result<Outlook> outlookOf(std::span<const Measurements> plants);
/// Of plants of a single segment too, which show what they have.
[[nodiscard]] Result<Outlook> anyOutlookOf(std::span<const Measurements> plants);

}  // namespace axil::quantify
