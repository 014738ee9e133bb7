#pragma once
/// \file
/// Plan: what an initial grammar says, as rounded numbers, before it is written in a dialect; and the plant those numbers grow.
/// Private to this room.

#include "base/result.hpp"
#include "base/turning.hpp"
#include "emit/initial.hpp"
#include "quantify/types.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace axil::emit {

inline constexpr double kGrowingPointTime = 1e-4;  ///< GrowTime of stage 0, as in the thesis
inline constexpr int kFirstSegmentStage = 2;
inline constexpr int kPetioleStage = 1;

/// How many digits numbers get; -1: all of them.
struct Digits {
  int angle = 6;
  int length = 6;
};
[[nodiscard]] double rounded(double value, int decimals);

struct PlannedLeaf {
  Turn turn;
  Angle roll;
  int petioleStage = -1;      ///< -1: the blade sits on the stem
  int leafStage = 1;
  StemFrame frame;            ///< of the grown blade, rolled
  const quantify::LeafMeasure* measure = nullptr;
};

struct PlannedSegment {
  int stage = 0;
  Turn turn;                  ///< zero for the root segment
  ChildKind kind = ChildKind::Main;
  double length = 0;          ///< of the stage's body
  double radius = 0;
  StemFrame frame;            ///< of the grown segment
  PlantPoint tip;             ///< where its children start
  std::vector<PlannedLeaf> leaves;
  std::vector<std::size_t> children;  ///< the main child last
};

struct LeafStage {
  double length = 0;
  double width = 0;
  std::string shape;
  friend bool operator==(const LeafStage&, const LeafStage&) = default;
};

struct Plan {
  Digits digits;
  double scale = 0;               ///< the size that tolerances refer to: the height, or a tenth of the largest extent if that is more
  PlantPoint position;
  glm::dvec3 direction{0, 1, 0};  ///< as printed, so only nearly a unit vector
  StemFrame frame;                ///< of the plant, before its first segment
  double growingPoint = 0;        ///< length of the body of stage 0
  bool radiusMeasured = false;
  std::vector<PlannedSegment> segments;     ///< as Measurements::segments
  std::vector<std::size_t> collarBranches;  ///< segments that leave the root beside the first
  std::vector<PlannedLeaf> rootLeaves;
  std::vector<double> petioles;             ///< lengths; the first is stage 1, the others follow the last segment's
  std::vector<LeafStage> leafStages;        ///< stage 1, 2, ...

  [[nodiscard]] int petioleStageOf(std::size_t petiole) const {
    return petiole == 0 ? kPetioleStage : kFirstSegmentStage + static_cast<int>(segments.size() + petiole) - 1;
  }
  [[nodiscard]] int firstFreeStage() const {
    return kFirstSegmentStage + static_cast<int>(segments.size() + (petioles.empty() ? 0 : petioles.size() - 1));
  }
};

/// Plans the grammar. The plan points into `measurements`, which must outlive it.
[[nodiscard]] Result<Plan> planOf(const quantify::Measurements& measurements, const EmitOptions& options);

/// A radius for every segment: measured where there is one, else by the pipe model that initial.hpp describes.
[[nodiscard]] std::vector<double> radiiOf(const quantify::Measurements& measurements, double plantSize);

}  // namespace axil::emit
