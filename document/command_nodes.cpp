#include "base/text.hpp"
#include "document/command_parts.hpp"

#include <algorithm>
#include <map>

namespace axil::document {

namespace {

template <class Change>
Result<Project> withNode(Project project, NodeId id, Change change) {
  const auto at = placeOfNode(project, id);
  if (!at) return at.failure();
  ProjectNode node = project.nodes[*at];
  if (Result<void> changed = change(node.node); !changed) return changed.failure();
  project.nodes.set(*at, std::move(node));
  return project;
}

Result<void> checkClick(const Project& project, const std::string& view, PhotoPoint at) {
  const auto place = placeOfView(project, view);
  if (!place) return place.failure();
  return checkPoint(project.views[*place].view, at);
}

Failure noClick(NodeId node, const std::string& view) {
  return fail(ErrorCode::NotFound, nameOf(node) + " has no click in " + inQuotes(view) + "; add one");
}

// ---- removing nodes --------------------------------------------------------------------------------------------------

/// How many stems use each node.
std::map<NodeId, int> usesOf(const Project& project) {
  std::map<NodeId, int> uses;
  for (const ProjectStem& stem : project.stems)
    for (const NodeId node : stem.stem.nodes) ++uses[node];
  return uses;
}

std::vector<NodeId> without(const std::vector<NodeId>& nodes, const std::set<NodeId>& gone) {
  std::vector<NodeId> rest;
  for (const NodeId node : nodes)
    if (!gone.contains(node)) rest.push_back(node);
  return rest;
}

/// Takes nodes out of every stem. A stem that is left with nothing but a node of another stem goes as well.
Result<void> closeStemsOver(Project& project, const std::set<NodeId>& gone) {
  const std::map<NodeId, int> uses = usesOf(project);
  std::set<StemId> empty;
  for (std::size_t i = 0; i < project.stems.size(); ++i) {
    const auto& nodes = project.stems[i].stem.nodes;
    const std::vector<NodeId> rest = without(nodes, gone);
    if (rest.size() == nodes.size()) continue;
    const NodeId first = nodes.front();
    const bool shared = uses.at(first) > 1;
    if (shared && gone.contains(first) && !rest.empty())
      return fail(ErrorCode::BadInput, nameOf(project.stems[i].stem.id) + " begins at " + nameOf(first) + "; remove that stem or attach it elsewhere first");
    if (rest.empty() || (shared && rest.size() == 1 && rest.front() == first)) {
      empty.insert(project.stems[i].stem.id);
      continue;
    }
    ProjectStem stem = project.stems[i];
    stem.stem.nodes = rest;
    project.stems.set(i, std::move(stem));
  }
  eraseStems(project, empty);
  return {};
}

}  // namespace

Result<std::size_t> placeOfNode(const Project& project, NodeId id) {
  if (const auto at = nodeWithId(project, id)) return *at;
  return fail(ErrorCode::NotFound, "there is no " + nameOf(id));
}

Result<void> checkNewNode(const Project& project, NodeId id) {
  if (!id.valid()) return fail(ErrorCode::BadInput, "a node's id must be 0 or above");
  if (nodeWithId(project, id)) return fail(ErrorCode::BadInput, "there is a " + nameOf(id) + " already; the next free id is " + std::to_string(nextNodeId(project).value));
  if (project.nodes.size() >= kMaximumNodes) return fail(ErrorCode::LimitReached, "a project has at most " + std::to_string(kMaximumNodes) + " nodes");
  return {};
}

Result<Project> after(Project project, const AddNode& command) {
  if (auto checked = checkNewNode(project, command.node); !checked) return checked.failure();
  if (auto checked = checkClick(project, command.view, command.at); !checked) return checked.failure();
  ProjectNode node;
  node.node.id = command.node;
  node.node.clicks[command.view] = command.at;
  project.nodes.push_back(std::move(node));
  return project;
}

Result<Project> after(Project project, const RemoveNodes& command) {
  if (command.nodes.empty()) return fail(ErrorCode::BadInput, "no node is named; select the nodes to remove");
  for (const NodeId node : command.nodes)
    if (const auto at = placeOfNode(project, node); !at) return at.failure();
  const std::set<NodeId> gone(command.nodes.begin(), command.nodes.end());
  if (auto closed = closeStemsOver(project, gone); !closed) return closed.failure();
  forgetLeafNodes(project, gone, std::nullopt);
  project.nodes.eraseIf([&](const ProjectNode& node) { return gone.contains(node.node.id); });
  return project;
}

Result<Project> after(Project project, const AddClick& command) {
  if (auto checked = checkClick(project, command.view, command.at); !checked) return checked.failure();
  return withNode(std::move(project), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    if (node.clicks.contains(command.view))
      return fail(ErrorCode::BadInput, nameOf(node.id) + " has a click in " + inQuotes(command.view) + " already; move that one");
    node.clicks[command.view] = command.at;
    return {};
  });
}

Result<Project> after(Project project, const PlaceClick& command) {
  if (auto checked = checkNumber("how far off the click may be", command.within_px, 0, kMaximumPixel); !checked) return checked.failure();
  auto placed = after(std::move(project), AddClick{command.node, command.view, command.at});
  if (!placed) return placed;
  return withNode(*std::move(placed), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    node.placed[command.view] = command.within_px;
    return {};
  });
}

Result<Project> after(Project project, const MoveClick& command) {
  if (auto checked = checkClick(project, command.view, command.at); !checked) return checked.failure();
  return withNode(std::move(project), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    const auto click = node.clicks.find(command.view);
    if (click == node.clicks.end()) return noClick(node.id, command.view);
    click->second = command.at;
    node.placed.erase(command.view);
    return {};
  });
}

Result<Project> after(Project project, const RemoveClick& command) {
  return withNode(std::move(project), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    if (node.clicks.erase(command.view) == 0) return noClick(node.id, command.view);
    node.placed.erase(command.view);
    return {};
  });
}

Result<Project> after(Project project, const SetRadius& command) {
  if (auto checked = checkNumber("the radius", command.radius, 0, 1e6); !checked) return checked.failure();
  return withNode(std::move(project), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    node.radius = command.radius;
    return {};
  });
}

Result<Project> after(Project project, const ClearRadius& command) {
  return withNode(std::move(project), command.node, [&](skeleton3d::ClickedNode& node) -> Result<void> {
    node.radius.reset();
    return {};
  });
}

}  // namespace axil::document
