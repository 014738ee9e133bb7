#pragma once
/// \file
/// What an exact structured grammar says, as numbers: the usual values by order, the steps by which each segment and leaf differs, and how far
/// the plant that they grow is from the measured one. Private to this room.
///
/// Rows are segments, axis by axis, axes level by level, so that the axes that leave one node follow each other and so do those of the next.

#include "emit/initial.hpp"
#include "quantify/structure.hpp"
#include "quantify/types.hpp"

#include <string>
#include <vector>

namespace axil::emit {

/// The shape of the tree, in rows and renumbered axes.
struct ExactLayout {
  std::vector<std::size_t> segmentOf;    ///< row -> segment
  std::vector<int> start;                ///< axis -> first row; one more entry: the number of rows
  std::vector<int> side;                 ///< row -> first axis that leaves its tip; one more entry
  std::vector<int> leaves;               ///< row -> first leaf at its tip; one more entry
  std::vector<int> orderOf;              ///< axis -> branching order
  std::vector<int> bearer;               ///< axis -> row at whose tip it is inserted; -1: the collar
  std::vector<const quantify::LeafMeasure*> leafOf;  ///< leaf -> measured leaf
  int collarAxes = 0;                    ///< axes beside the first that leave the collar; they follow it
  int collarLeaves = 0;                  ///< leaves of the collar, the first ones
  int orders = 1;
};
[[nodiscard]] ExactLayout exactLayout(const quantify::Measurements& m, const quantify::PlantStructure& structure);

/// How fine, and with which rules.
struct ExactChoice {
  double error = 0.01;       ///< what steps aim for, of the height
  bool trend = false;        ///< lengths change from rank to rank
  bool divergence = true;    ///< azimuths go on from node to node
};

/// Usual values of one order. Angles in radians.
struct OrderUsual {
  double length = 0, shrink = 1, bend = 0, insertion = 0, divergence = 0, azimuth = 0, apart = 0;
  double leafAngle = 0, leafDivergence = 0, leafAzimuth = 0, leafApart = 0;
  std::size_t segments = 0, axes = 0, leaves = 0, branches = 0;
};

struct ExactPlan {
  double lengthStep = 0, angleStep = 0, leanStep = 0;
  double radius = 0, taper = 1;          ///< radius of a row: radius * taper^thin[row]
  bool radiusMeasured = false;
  std::vector<OrderUsual> usual;
  std::vector<int> length, bend, around, thin;  ///< by row; for an axis' first row bend and around are its insertion
  // Leaves: steps of leafStep from the usual; a blade is leafLength * leafTaper^small long, a stalk petiole + lengthStep * stalked.
  std::vector<int> leafBend, leafAround, leafRoll, small, stalked, shape;
  double leafStep = 0, leafLength = 0, leafTaper = 0.85, leafWidth = 0, petiole = 0;  ///< leafWidth over length; 0: unknown
  std::vector<std::string> shapes;
  double height = 0;
  double worst = 0, mean = 0;            ///< distance of nodes, of the height
  glm::dvec3 direction{0, 1, 0}, position{0, 0, 0};
  std::vector<double> radii;             ///< by order, where no radius was measured
};
[[nodiscard]] ExactPlan exactPlan(const quantify::Measurements& m, const quantify::PlantStructure& structure, const ExactLayout& layout, const ExactChoice& choice);

}  // namespace axil::emit
