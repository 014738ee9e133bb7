#pragma once
/// \file
/// Statistics in layers: what was measured, as functions of branching order and of rank along the axis.
///
/// Each quantity has an estimate for the whole plant, one an order, and one for each rank of an order; and a trend along the rank. Three things
/// keep an estimate honest:
/// - *Robust*: within a plant the centre is Huber's M-estimate (tuning 1.345; least absolute spread from the median), so a slipped click moves it little.
/// - *Each plant once*: plants are combined as a random-effects mean. Where they differ by more than their samples explain, each counts alike,
///   however large it is; where they do not, each counts as its samples do, for then they are samples of one thing.
/// - *Pooled*: a layer with few samples is drawn towards its parent layer (a rank to its order's trend, an order to the whole), by as much as
///   its own standard error compares with how much sister layers differ (empirical Bayes). `pooled` says how much came from the parent.
///
/// Lengths are in the first plant's unit; angles in radians; trends of sizes are of their logarithms, so a slope is a ratio per rank.
/// Sources: Huber 1964; DerSimonian and Laird 1986; Efron and Morris 1972, 1975; the layers are future work of L-Grammar Generator 2005, chapter 4.

#include "base/result.hpp"
#include "quantify/branching.hpp"
#include "quantify/fates.hpp"
#include "quantify/phyllotaxis.hpp"
#include "quantify/schedule.hpp"
#include "quantify/structure.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace axil::quantify {

/// A number measured: what it is, how sure, from how much.
struct Estimate {
  double value = 0;        ///< after pooling
  double own = 0;          ///< the layer's alone
  double error = 0;        ///< standard error of `own`
  double deviation = 0;    ///< standard deviation of single samples within a plant
  double between = 0;      ///< standard deviation of plants, beyond what their samples explain
  double low = 0;          ///< 5 % of the samples lie below
  double high = 0;         ///< and 5 % above; both the extremes for fewer than 20
  double pooled = 0;       ///< share taken from the parent layer, 0 to 1
  std::size_t samples = 0;
  std::size_t plants = 0;
};

/// One measured number and where it stands.
struct Sample {
  std::size_t plant = 0;
  int order = 0;
  int rank = 0;
  double value = 0;
};

/// Along the rank of an axis: y(rank) = start + slope * rank, of logarithms for sizes. Axes differ in where they start; the slope is
/// that of all axes together (medians resist outliers where enough axes are long).
struct Trend {
  bool logarithmic = false;
  double start = 0;         ///< at rank 0, of an average axis
  double slope = 0;
  double slopeError = 0;
  double residual = 0;      ///< standard deviation around it
  double axisDeviation = 0; ///< standard deviation of axes
  int lastRank = 0;         ///< highest rank seen
  std::size_t samples = 0;

  /// At `rank`; beyond what was seen the trend goes on, in sizes by no more than a tenfold against the last rank seen.
  [[nodiscard]] double at(double rank) const;
  /// Of sizes: the factor from one rank to the next; of others the difference.
  [[nodiscard]] double step() const;
  /// Whether it is more than chance (two standard errors).
  [[nodiscard]] bool clear() const { return std::size_t{2} < samples && (slope > 2 * slopeError || slope < -2 * slopeError); }
};

enum class Quantity {
  Length,        ///< of a segment
  Internode,     ///< from node to node
  Radius,
  Bend,          ///< rotr from a segment to what goes on
  Insertion,     ///< rotr of what branches off; the order is the bearer's
  LengthRatio,   ///< a segment over the one below on its axis
  LateralRatio,  ///< a branch's first segment over its bearer; the order is the bearer's
  RadiusRatio,
  Branching,     ///< share of nodes (that an axis goes on from, and old enough) that branch
  Forking,       ///< share of axes that no longer grow that end in a fork
  Ending,        ///< share of segments (whose fate is decided) at which an axis ends without a fork
  AxisSegments,  ///< of an axis
  LeafLength,
  LeafWidth,
  LeafAngle,     ///< rotr of a leaf
  Petiole,
  LeavesPerNode, ///< of segments that have any
};
inline constexpr std::size_t kQuantities = 17;
struct QuantityName {
  Quantity quantity;
  const char* name;   ///< "lateral_ratio"
  const char* words;
  enum class Kind { Size, Angle, Ratio, Share, Count } kind;
};
[[nodiscard]] std::span<const QuantityName> quantityNames();

struct RankLayer {
  int rank = 0;
  Estimate estimate;
};
struct OrderLayer {
  int order = 0;
  Estimate estimate;
  Trend trend;
  std::vector<RankLayer> ranks;
};
struct QuantityLayers {
  Estimate all;
  std::vector<OrderLayer> orders;  ///< ascending; only those that have samples
  [[nodiscard]] const OrderLayer* order(int number) const;
  /// The estimate of that order, of the highest below it, else of the whole.
  [[nodiscard]] const Estimate& nearest(int number) const;
};

/// How often a node of an order bears k branches, of nodes that an axis goes on from and that are old enough.
struct BranchShares {
  int order = 0;
  std::vector<double> shares;
  std::size_t nodes = 0;
};

/// Shares of fates of an order, of segments whose fate is decided: what still grows, and nodes too young to branch, are left out.
struct Fates {
  int order = 0;
  std::vector<Fate> fates;
  std::size_t segments = 0;
};

/// One of the axes that leave a node together, where they differ (arms.hpp).
struct ArmLayer {
  Estimate insertion;      ///< rotr, radians
  Estimate lateralRatio;   ///< its first segment over its bearer
};
/// Of sympodial plants those of all orders together.
struct ArmLayers {
  std::optional<int> order;   ///< of the bearer; none: all orders
  std::vector<ArmLayer> arms;
};

struct LayeredStatistics {
  std::string unit;
  std::size_t plants = 0;
  StemEnds stemEnds = StemEnds::GoOn;           ///< of the plants together
  std::vector<QuantityLayers> layers;           ///< by Quantity
  std::vector<Sample> samples[kQuantities];     ///< what they stand on
  std::vector<BranchShares> branches;
  std::vector<Fates> fates;                     ///< by order
  std::vector<ArmLayers> arms;                  ///< where arms differ; the layers above describe them as one
  Schedule schedule;
  std::vector<BranchingPattern> patterns;       ///< by order
  std::vector<Phyllotaxis> leaves;              ///< by order; then of all orders together, last
  std::vector<Phyllotaxis> branchesAround;
  std::vector<Branching> branching;             ///< of each plant
  double straightness = 1;                      ///< median of the plants'
  std::vector<std::string> warnings;            ///< a sentence each

  [[nodiscard]] const QuantityLayers& of(Quantity quantity) const { return layers[static_cast<std::size_t>(quantity)]; }
};

/// Statistics of one plant or of many of a kind. Lengths of plants in other units are converted (m, dm, cm, mm, with a warning); a unit
/// that says nothing about metres cannot be, and fails with BadInput. Plants whose shapes disagree (angles, ratios, arrangement, branching) are
/// named in a warning: they may be different species. Fails with NoAnswer for no plant at all.
[[nodiscard]] Result<LayeredStatistics> layeredStatistics(std::span<const Measurements> plants);

/// `plants` in the unit of the first, as layeredStatistics takes them.
[[nodiscard]] Result<std::vector<Measurements>> inOneUnit(std::span<const Measurements> plants, std::vector<std::string>& warnings);

}  // namespace axil::quantify
