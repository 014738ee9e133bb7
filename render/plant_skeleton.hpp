#pragma once
/// \file
/// A grown plant as a skeleton: what measuring would have found on it, for skeleton.json and for going round the loop.
///
/// Stems are the grammar's own axes (a bracketed child begins a new stem); bodies shorter than 1e-7 of the plant are no
/// stems, and nodes nearer than that are one. Node and stem ids run from 1, in the order of the organs. A node's radius is
/// that of the organ that ends there. Flowers and fruits have no place in a skeleton.

#include "base/result.hpp"
#include "simeco/plant.hpp"
#include "skeleton3d/types.hpp"

namespace axil::render {

/// Fails with NoAnswer where no stem has grown yet, or where the plants are several that share no root.
[[nodiscard]] Result<skeleton3d::Skeleton> skeletonOf(const simeco::Plant& plant);

}  // namespace axil::render
