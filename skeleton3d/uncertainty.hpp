#pragma once
/// \file
/// How sure a measured plant is: the joint covariance of all its nodes, and what follows from it for a length or an angle.
///
/// Where cameras are known the nodes are independent, and each has the covariance of its own clicks. Where cameras were
/// estimated, their errors move all nodes together; then the covariance of nodes i and j is own(i) [i = j] + U_i M U_j^T,
/// which is exact for a bundle adjustment and small: U_i has some thirty columns. Unit: the project's, squared.
///
/// Gauge: the plant's origin is where it was clicked and its size what the known length says, both with the scatter of
/// their clicks. Nothing measures how the plant as a whole is turned about its origin, only the view names say it; so the
/// covariance is of the shape, after the best turn about the origin (`Uncertainty::turned` says how sure that turn is).
/// Lengths and angles do not depend on it. Everything is to first order, as is usual for click noise of some pixels.
/// Source: beyond L-Grammar Generator 2005.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace axil::skeleton3d {

struct NodeSpread {
  NodeId id;
  PlantPoint at;
  glm::dmat3 own{0.0};             ///< of its own clicks
  std::vector<glm::dvec3> shared;  ///< the columns of U; empty where cameras are known

  friend bool operator==(const NodeSpread&, const NodeSpread&) = default;
};

struct Uncertainty {
  double click_px = 1;           ///< standard deviation of a click in each direction, as it was given or found
  bool clickWasFound = false;    ///< from the clicks' distances to where their nodes project to
  int freedom = 0;               ///< how many numbers it was found from, less those that were fitted
  double scaleShare = 0;         ///< standard deviation of the plant's size as a share of it; 0 where cameras are known
  std::array<Angle, 3> turned{}; ///< of the whole plant about X, Y and Z; 0 where cameras are known
  std::vector<NodeSpread> nodes; ///< by id
  std::vector<double> middle;    ///< M, row by row

  friend bool operator==(const Uncertainty&, const Uncertainty&) = default;
};

/// The spread of nodes in cameras that are known. Nodes that cannot be placed are left out. Without `click_px` the scatter
/// of the clicks is found from the clicks themselves, as soon as some nodes have more clicks than they need.
[[nodiscard]] Result<Uncertainty> uncertaintyOf(std::span<const View> views, std::span<const ClickedNode> nodes, std::optional<double> click_px = std::nullopt);

/// Covariance of node `a` with node `b`; of one node where both are the same. Nothing for a node that is not there.
[[nodiscard]] std::optional<glm::dmat3> covariance(const Uncertainty& uncertainty, NodeId a, NodeId b);

/// Standard deviation of each coordinate.
[[nodiscard]] std::optional<glm::dvec3> sigmaOf(const Uncertainty& uncertainty, NodeId node);

/// A number with its standard deviation; 68 % of such numbers are within one, 95 % within 1.96 of the truth.
struct WithSigma {
  double value = 0;
  double sigma = 0;
};

/// The distance between two nodes. Nothing where one is not there or both are in one place.
[[nodiscard]] std::optional<WithSigma> lengthBetween(const Uncertainty& uncertainty, NodeId a, NodeId b);

/// The angle in radians, 0 to pi, between the directions from `a` to `b` and from `c` to `d`; nodes may be the same.
/// Nothing where a direction has no length. Near 0 and pi the truth is not normal and sigma only a bound.
[[nodiscard]] std::optional<WithSigma> angleBetweenSegments(const Uncertainty& uncertainty, NodeId a, NodeId b, NodeId c, NodeId d);

/// `skeleton` with the `sigma` of its nodes taken from `uncertainty`.
[[nodiscard]] Skeleton withUncertainty(Skeleton skeleton, const Uncertainty& uncertainty);

}  // namespace axil::skeleton3d
