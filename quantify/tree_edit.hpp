#pragma once
/// \file
/// The constrained edit distance between two unordered trees of segments (compare.hpp). Private to this room. Source: Zhang 1996.

#include "quantify/types.hpp"

#include <cstddef>

namespace axil::quantify {

/// Insertions, deletions and changes of kind (goes on, branches off), each 1. Memory: 8 bytes a pair of segments.
[[nodiscard]] std::size_t treeEditDistance(const Measurements& a, const Measurements& b);

}  // namespace axil::quantify
