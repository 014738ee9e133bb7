#pragma once
/// \file
/// What becomes of an apex at a node, as a function of the node's rank on its axis: it goes on, with so many branches, forks, or ends.
///
/// Four shapes are tried, and the one with the least Bayesian information criterion is taken: *alike* at every rank; *first ranks* that differ, each for itself, from
/// all that follow (modules of a fixed number of segments end so); *periodic*, every k-th node alike; and *rising*, where the odds of a branch grow or fall by
/// the same factor from rank to rank (acrotonic and basitonic axes). Sources: Schwarz 1978 (the criterion); Barthelemy and Caraglio 2007 (the habits).

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace axil::quantify {

/// What became of an axis at a segment's tip.
struct Fate {
  bool goesOn = false;
  int branches = 0;
  double share = 0;
  std::size_t count = 0;
  friend bool operator<(const Fate& a, const Fate& b) { return std::pair(!a.goesOn, a.branches) < std::pair(!b.goesOn, b.branches); }
};

/// One node whose fate is decided.
struct NodeFate {
  int rank = 0;
  bool goesOn = false;
  int branches = 0;
};

struct FateTable {
  enum class Shape { Alike, FirstRanks, Periodic, Rising } shape = Shape::Alike;
  std::vector<Fate> fates;                   ///< that were seen, with their shares of all nodes; what goes on first
  std::vector<std::vector<double>> byRank;   ///< [row][fate]: shares, sum 1; a single row where ranks are alike
  std::vector<double> seen;                  ///< nodes behind each row; of Rising: all

  /// The row of a node of `rank`: rows repeat where periodic, else the last one goes on.
  [[nodiscard]] std::size_t rowOf(int rank) const;
  [[nodiscard]] const std::vector<double>& at(int rank) const { return byRank[rowOf(rank)]; }
  /// How likely a node of `rank` branches.
  [[nodiscard]] double branchingAt(int rank) const;
};

/// Of no nodes: an apex goes on.
[[nodiscard]] FateTable fateTableOf(std::span<const NodeFate> nodes);

}  // namespace axil::quantify
