#pragma once
/// \file
/// The checked tree: solved nodes and clicked stems as one Skeleton.
///
/// A stem is a chain of nodes from where it leaves its parent to its tip; it begins with a node of its parent, the first
/// stem with the root. So every node is an inner or last node of exactly one stem, except the root, which is one of none,
/// and no node is left over. The order of stems in the file is free: a parent is put before its children, and otherwise
/// the file's order kept. Several stems may begin with the root: the first of them in the file is the first stem, the
/// others are its children.
///
/// A node clicked in fewer than two views is no error: it is listed as `incomplete`, its stem runs on without it, and a stem
/// that begins at it, or has fewer than two placed nodes, waits with all that grows from it. Only the root must have its place.
/// Source: L-Grammar Generator 2005, section 3.2.2 (the structure must be a tree, without circles).

#include "skeleton3d/solve.hpp"

#include <span>
#include <string>

namespace axil::skeleton3d {

/// Solves the nodes and joins them. Fails as `solveNodes` does, and when the stems are no tree; one Error then has a line
/// for every trouble of either kind in its details: unknown or repeated ids, a stem of fewer than two nodes, a node twice in a stem,
/// segments of no length (shorter than a millionth of the plant), circles, a node that two stems pass through, more than
/// one root, parts and nodes that nothing connects. Radii are carried over; a stem where only some nodes (its first, which
/// is its parent's, not counted) have one gets the others by interpolation along its length, the ends by the nearest.
[[nodiscard]] Result<Skeleton> buildSkeleton(std::span<const View> views, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems,
                                             const SolveOptions& options = {}, std::string unit = "m");

}  // namespace axil::skeleton3d
