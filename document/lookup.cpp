#include "document/lookup.hpp"

#include <algorithm>
#include <limits>

namespace axil::document {

using skeleton3d::NodeId;
using skeleton3d::StemId;

namespace {

template <class List, class Is>
std::optional<std::size_t> firstWhere(const List& list, Is is) {
  std::size_t i = 0;
  for (const auto& element : list) {
    if (is(element)) return i;
    ++i;
  }
  return std::nullopt;
}

template <class AnId, class List, class IdOf>
AnId oneAbove(const List& list, IdOf idOf) {
  std::int32_t largest = 0;
  for (const auto& element : list) largest = std::max(largest, idOf(element).value);
  return largest == std::numeric_limits<std::int32_t>::max() ? AnId() : AnId(largest + 1);
}

}  // namespace

std::optional<std::size_t> viewNamed(const Project& project, std::string_view name) {
  return firstWhere(project.views, [&](const ProjectView& view) { return view.view.name == name; });
}

std::optional<std::size_t> nodeWithId(const Project& project, NodeId id) {
  return firstWhere(project.nodes, [&](const ProjectNode& node) { return node.node.id == id; });
}

std::optional<std::size_t> stemWithId(const Project& project, StemId id) {
  return firstWhere(project.stems, [&](const ProjectStem& stem) { return stem.stem.id == id; });
}

const PhotoPoint* clickOf(const Project& project, NodeId node, const std::string& view) {
  const auto place = nodeWithId(project, node);
  if (!place) return nullptr;
  const auto& clicks = project.nodes[*place].node.clicks;
  const auto click = clicks.find(view);
  return click == clicks.end() ? nullptr : &click->second;
}

NodeId nextNodeId(const Project& project) {
  return oneAbove<NodeId>(project.nodes, [](const ProjectNode& node) { return node.node.id; });
}

StemId nextStemId(const Project& project) {
  return oneAbove<StemId>(project.stems, [](const ProjectStem& stem) { return stem.stem.id; });
}

std::optional<std::size_t> stemThrough(const Project& project, NodeId node) {
  return firstWhere(project.stems, [&](const ProjectStem& stem) {
    const auto& nodes = stem.stem.nodes;
    return nodes.size() > 1 && std::find(nodes.begin() + 1, nodes.end(), node) != nodes.end();
  });
}

std::vector<std::size_t> stemsFrom(const Project& project, NodeId node) {
  std::vector<std::size_t> stems;
  for (std::size_t i = 0; i < project.stems.size(); ++i)
    if (!project.stems[i].stem.nodes.empty() && project.stems[i].stem.nodes.front() == node) stems.push_back(i);
  return stems;
}

}  // namespace axil::document
