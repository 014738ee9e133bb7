#pragma once
/// \file
/// A family: the process that the measured plants look like samples of, by branching order, as few numbers as tell them apart.
///
/// An axis makes segment after segment. How many it may make (`left` before it starts) is either what *stages* leave it, as long as its bearer still may less a
/// delay, each node ending it with some chance; or a number of its *own*, drawn from those measured, or from a line along its bearer (how much that had left, or the
/// rank it stands at) with the misses around it. The choice between lines is by the Bayesian information criterion; stages where schedule.hpp finds steady growth.
/// Nodes branch, fork and end with shares, by rank where ranks differ by more than chance (fates.hpp). Lengths follow a level that falls or grows along the axis, or the segment below.
/// A *distribution* is a number, normal, even, or else a table of measured quantiles: the simplest that the samples do not contradict (Kolmogorov's distance
/// with Lilliefors' 10 % bound). Arms of a fork that differ by more than chance are told apart (arms.hpp), each with its own lean and length.
///
/// Samples of all plants count alike here: the family is what a randomly met axis or node is like. Orders of few axes share the rules of the order below.
/// Sources: Schwarz 1978 (BIC); Lilliefors 1967; the statistical structured form is future work of L-Grammar Generator 2005, chapter 4.

#include "base/result.hpp"
#include "quantify/distribution.hpp"
#include "quantify/outlook.hpp"

#include <map>
#include <span>
#include <vector>

namespace axil::quantify {

struct EndFate {
  int arms = 0;                 ///< axes that an axis ends in
  double share = 0;
};

/// One of the axes that leave a node together (arms.hpp).
struct FamilyArm {
  Distribution insertion;
  Distribution start;           ///< its first length (or level) over what the order that it begins starts from
};

enum class Extent { Stages, Own };
enum class Along { Nothing, Left, Rank };

/// Rules of the orders from `order` up to `lastOrder`.
struct FamilyOrder {
  int order = 0;
  int lastOrder = 0;
  std::size_t axes = 0, segments = 0, nodes = 0, insertions = 0;

  Extent extent = Extent::Own;
  int delay = 0;                    ///< Stages: after the bearer's node, beyond the usual one
  std::optional<int> most;          ///< Stages: segments that no axis goes beyond
  Along along = Along::Nothing;     ///< Own: left = slope * (left of the bearer after this node, or the node's rank) + `own`
  double slope = 0;
  Distribution own;

  FateTable fates;                  ///< of nodes with more to come; of Own only of those that the axis goes on from
  std::vector<EndFate> ends;        ///< Own: what an axis ends in, shares sum to 1

  bool followsBelow = false;        ///< length: the segment below times `factor`; else a level, times `step` a rank, times `factor`
  double step = 1;
  Distribution factor;
  bool startsFromBearer = false;    ///< the first length (level): the bearer's length (level) times `start`; else `usual` times `start`
  double usual = 0;
  Distribution start;

  Distribution bend;
  bool bendsToOneSide = false;      ///< rotu of bends is normal around `side`; else any
  double side = 0, sideDeviation = 0;
  Distribution insertion;                             ///< of what this order bears
  std::map<int, std::vector<FamilyArm>> arms;         ///< of what this order bears, by the number of axes at the node, where they differ

  double radius = 0, radiusStep = 1;  ///< 0: none measured
  double leafShare = 0;               ///< of segments
  Distribution leafLength;
  OrderOutlook outlook;               ///< arrangement and the rest of its leaves
};

struct Family {
  std::vector<FamilyOrder> orders;
  Distribution stages;                ///< `left` of the first axis
  double firstLength = 0;             ///< of the first axis: its level, or its first segment's length
  int collarAxes = 0;                 ///< beside the first, on average
  std::size_t plants = 0;
  int deepest = 0;                    ///< orders measured
  LayeredStatistics statistics;
};

/// Fails as layeredStatistics does.
[[nodiscard]] Result<Family> familyOf(std::span<const Measurements> plants);

}  // namespace axil::quantify
