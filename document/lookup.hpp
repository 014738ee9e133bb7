#pragma once
/// \file
/// Finding things in a project by their ids, and how stems hang together. Nothing is cached: each call looks through the lists.

#include "document/project.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::document {

/// Places in Project::views, nodes, stems; the first where a damaged file has several.
[[nodiscard]] std::optional<std::size_t> viewNamed(const Project& project, std::string_view name);
[[nodiscard]] std::optional<std::size_t> nodeWithId(const Project& project, skeleton3d::NodeId id);
[[nodiscard]] std::optional<std::size_t> stemWithId(const Project& project, skeleton3d::StemId id);

/// Where the node is clicked in the view; null where it is not, or there is no such node. Points into `project`.
[[nodiscard]] const PhotoPoint* clickOf(const Project& project, skeleton3d::NodeId node, const std::string& view);

/// One above the largest, 1 for none; an invalid id where the numbers are used up.
[[nodiscard]] skeleton3d::NodeId nextNodeId(const Project& project);
[[nodiscard]] skeleton3d::StemId nextStemId(const Project& project);

/// The stem that has `node` beyond its first place; a node of a tree has at most one.
[[nodiscard]] std::optional<std::size_t> stemThrough(const Project& project, skeleton3d::NodeId node);
/// The stems that begin with `node`, in the order of the project.
[[nodiscard]] std::vector<std::size_t> stemsFrom(const Project& project, skeleton3d::NodeId node);

}  // namespace axil::document
