#pragma once
/// \file
/// Private to skeleton3d: which of a node's clicks are evidence. What the program placed itself (ClickedNode::placed) is none, as
/// long as the clicks that a person made fix the node.

#include "skeleton3d/types.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

[[nodiscard]] inline ClickedNode byHand(ClickedNode node) {
  for (const auto& [view, sigma_px] : node.placed) node.clicks.erase(view);
  node.placed.clear();
  return node;
}

[[nodiscard]] inline std::vector<ClickedNode> byHand(std::span<const ClickedNode> nodes) {
  std::vector<ClickedNode> own;
  own.reserve(nodes.size());
  for (const ClickedNode& node : nodes) own.push_back(byHand(node));
  return own;
}

[[nodiscard]] inline bool isByHand(const ClickedNode& node, const std::string& view) { return !node.placed.contains(view); }

/// The standard deviation of a click, in pixels.
[[nodiscard]] inline double scatterOf(const ClickedNode& node, const std::string& view, double click_px) {
  const auto placed = node.placed.find(view);
  return placed == node.placed.end() ? click_px : std::max(click_px, placed->second);
}

}  // namespace axil::skeleton3d::detail
