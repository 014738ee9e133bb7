#pragma once
/// \file
/// How a child leaves its parent in SimEco: the one rule that measuring (quantify), growing (simeco) and writing (emit) share.
///
/// Every stem has a direction d and an r-axis r, a unit vector perpendicular to d. A child starts as a copy of d, is turned
/// about r by rotr, then about d by rotu: c = R(d, rotu) R(r, rotr) d. Its own r-axis: a *main* child's is R(d, rotu) r; a
/// *branch*'s is d made perpendicular to c, or R(d, rotu) r where c and d are parallel. Measuring is the exact inverse.
/// Source: L-Grammar Generator 2005, section 3.3.4; docs/decisions/turning.md says where and why we differ from it.

#include "base/frames.hpp"

namespace axil {

/// A stem's frame. `adaxial` is the side a leaf shows to its parent's tip: the parent's direction made perpendicular to d.
/// In rest (parallel to the parent) it is the parent's own, turned along by rotu, so a blade can be rolled by rotr(0) rotu(x).
struct StemFrame {
  PlantDirection direction = PlantDirection::up();
  PlantDirection rAxis = PlantDirection::along({1, 0, 0});
  PlantDirection adaxial = PlantDirection::along({0, 0, 1});
};

/// Which r-axis a branch gets. Exact is ours; Literal is the thesis' own words (the parent's direction as it is, not made
/// perpendicular), kept for old files: then rotr is not the angle between parent and child.
enum class TurningRule { Exact, Literal };

enum class ChildKind { Main, Branch };

/// The frame of a plant's first stem: its r-axis is +X made perpendicular to `direction` (+Z where that runs along X).
[[nodiscard]] StemFrame firstFrame(PlantDirection direction);

struct Turn {
  Angle rotr;
  Angle rotu;
  friend bool operator==(const Turn&, const Turn&) = default;
};

/// The frame of a child turned by `turn`.
[[nodiscard]] StemFrame childFrame(const StemFrame& parent, Turn turn, ChildKind kind, TurningRule rule = TurningRule::Exact);

/// The turn that brings `parent` to a child along `child`. rotr in [0, pi]; rotu is 0 where the two are parallel.
/// Exact for TurningRule::Exact; for Literal it is what the thesis measures, which childFrame need not give back.
[[nodiscard]] Turn measuredTurn(const StemFrame& parent, PlantDirection child);

}  // namespace axil
