#pragma once
/// \file
/// Comparing plants: how near one skeleton is to another, and how alike two sets of plants are.
///
/// *Nodes* are matched one to one, nearest pairs first, within a tolerance; precision is the matched share of B's nodes, recall of A's. Errors of
/// length and angle are over segments whose both ends are matched. The *tree-edit distance* is the constrained one between unordered trees of
/// segments: the fewest insertions, deletions and changes of kind (goes on, branches off), each costing 1, such that separate subtrees stay
/// separate; it takes time in O(|A| |B| d log d) for nodes of degree d, and is left out above a stated number of pairs. *Silhouettes* are drawn
/// orthographically on one grid; IoU is the share of covered cells that both cover. Lengths in A's unit; the plants are compared where they stand.
/// Sets are compared by distribution: the Kolmogorov-Smirnov distance and the first Wasserstein distance. Segments of one plant are not independent samples, so p is
/// found by exchanging whole plants between the sets, 999 times at most, seeded; and one p says whether any of the quantities differs (the least p against the least p of exchanged sets).
/// Sources: Zhang 1996 (constrained edit distance between unordered trees); Kuhn 1955 (assignment); Smirnov 1948; Westfall and Young 1993 (resampling, several tests).

#include "base/result.hpp"
#include "quantify/types.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::quantify {

enum class SilhouetteView { Front, Right, Top };

struct CompareOptions {
  double tolerance = 0.02;     ///< of A's height, within which nodes are the same
  int silhouette_cells = 256;  ///< along the longer side of both plants together, 16 to 4096
  std::vector<SilhouetteView> views = {SilhouetteView::Front, SilhouetteView::Right, SilhouetteView::Top};
  std::size_t mostPairs = 9'000'000;  ///< of segments, for the tree-edit distance
};

struct Deviation {
  double mean = 0;             ///< of the absolute differences
  double worst = 0;
  std::size_t samples = 0;
};

struct PlantComparison {
  double height = 0;           ///< of A
  std::size_t nodesA = 0, nodesB = 0, matched = 0;
  double precision = 0, recall = 0;
  Deviation place;             ///< of matched nodes, in A's unit
  Deviation length;            ///< of segments, in A's unit
  Deviation angle;             ///< between the segments' directions, radians
  std::optional<double> branchDivergence, leafDivergence;  ///< |divergence of B - of A|, radians; none where either shows none
  std::optional<std::size_t> treeEdit;  ///< none above mostPairs
  std::vector<double> silhouettes;      ///< IoU, as CompareOptions::views
};

/// Fails with BadInput for options out of range, and where the plants' units differ.
[[nodiscard]] Result<PlantComparison> comparePlants(const Measurements& a, const Measurements& b, const CompareOptions& options = {});

/// Distance between the distributions of one quantity in two sets of plants.
struct DistributionDistance {
  std::string quantity;        ///< "length", "bend", "insertion", "branches", "axis_segments", "plant_segments", "leaves", "leaf_length"
  std::size_t samplesA = 0, samplesB = 0;
  double meanA = 0, meanB = 0;
  double ks = 0;               ///< largest distance of the two empirical distribution functions
  double p = 1;                ///< that sets of one kind of plant differ as much: of the exchanges, else as below
  double pIndependent = 1;     ///< by Kolmogorov's distribution, as if all samples were independent: too small where a plant's samples are alike
  double wasserstein = 0;      ///< in the quantity's unit
};

struct SetComparison {
  std::vector<DistributionDistance> distances;
  double p = 1;                ///< that no quantity differs
  std::size_t exchanges = 0;   ///< that p stands on; 0: too few plants to exchange, p is of independent samples, times the number of tests
};

/// Lengths as shares of the mean height of set A. Fails with BadInput where a set is empty, and where units differ.
[[nodiscard]] Result<SetComparison> compareSets(std::span<const Measurements> a, std::span<const Measurements> b);

/// The distance alone, and p of independent samples.
[[nodiscard]] DistributionDistance distanceOf(std::string quantity, std::vector<double> a, std::vector<double> b);

}  // namespace axil::quantify
