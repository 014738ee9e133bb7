#include "document/measurable.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace axil::document {
namespace {

using skeleton3d::ClickedStem;
using skeleton3d::NodeId;
using skeleton3d::StemId;

std::set<NodeId> nodesWithTwoClicks(const Project& project) {
  std::set<NodeId> nodes;
  for (const ProjectNode& node : project.nodes)
    if (node.node.clicks.size() >= 2) nodes.insert(node.node.id);
  return nodes;
}

/// A stem without the nodes that have no place yet; nothing where its beginning has none or fewer than two nodes are left.
std::optional<ProjectStem> placedPart(const ProjectStem& stem, const std::set<NodeId>& placed) {
  ProjectStem part = stem;
  auto& nodes = part.stem.nodes;
  if (nodes.empty() || !placed.contains(nodes.front())) return std::nullopt;
  std::erase_if(nodes, [&](NodeId node) { return !placed.contains(node); });
  return nodes.size() < 2 ? std::nullopt : std::optional(part);
}

/// The stems that can be reached from the root, which is where the first stem that leaves no other begins.
std::vector<ProjectStem> connected(const std::vector<ProjectStem>& stems) {
  std::set<NodeId> beyond;  // nodes that are on a stem beyond its beginning
  for (const ProjectStem& stem : stems) beyond.insert(stem.stem.nodes.begin() + 1, stem.stem.nodes.end());
  const auto first = std::find_if(stems.begin(), stems.end(), [&](const ProjectStem& stem) { return !beyond.contains(stem.stem.nodes.front()); });
  if (first == stems.end()) return {};
  std::set<NodeId> reached = {first->stem.nodes.front()};
  std::set<StemId> kept;
  for (bool grew = true; grew;) {
    grew = false;
    for (const ProjectStem& stem : stems) {
      if (kept.contains(stem.stem.id) || !reached.contains(stem.stem.nodes.front())) continue;
      kept.insert(stem.stem.id);
      reached.insert(stem.stem.nodes.begin(), stem.stem.nodes.end());
      grew = true;
    }
  }
  std::vector<ProjectStem> result;
  std::copy_if(stems.begin(), stems.end(), std::back_inserter(result), [&](const ProjectStem& stem) { return kept.contains(stem.stem.id); });
  return result;
}

void keepLeaves(Project& part, const std::set<NodeId>& nodes) {
  std::set<StemId> stems;
  for (const ProjectStem& stem : part.stems) stems.insert(stem.stem.id);
  part.leaves.eraseIf([&](const ProjectLeaves& leaves) {
    const auto& at = leaves.arrangement.at;
    return !stems.contains(leaves.arrangement.stem) || !std::all_of(at.begin(), at.end(), [&](NodeId node) { return nodes.contains(node); });
  });
}

}  // namespace

std::optional<Project> measurablePart(const Project& project) {
  const std::set<NodeId> placed = nodesWithTwoClicks(project);
  std::vector<ProjectStem> stems;
  for (const ProjectStem& stem : project.stems)
    if (auto part = placedPart(stem, placed)) stems.push_back(std::move(*part));
  stems = connected(stems);
  if (stems.empty()) return std::nullopt;

  Project part = project;
  part.stems = {};
  std::set<NodeId> used;
  for (ProjectStem& stem : stems) {
    used.insert(stem.stem.nodes.begin(), stem.stem.nodes.end());
    part.stems.push_back(std::move(stem));
  }
  part.nodes.eraseIf([&](const ProjectNode& node) { return !used.contains(node.node.id); });
  keepLeaves(part, used);
  return part;
}

}  // namespace axil::document
