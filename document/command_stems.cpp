#include "document/command_parts.hpp"

#include <algorithm>
#include <map>

namespace axil::document {

namespace {

using Nodes = std::vector<NodeId>;

const Nodes& nodesOf(const Project& project, std::size_t stem) { return project.stems[stem].stem.nodes; }
StemId idOf(const Project& project, std::size_t stem) { return project.stems[stem].stem.id; }

/// Which stem has a node beyond its first place.
std::map<NodeId, std::size_t> insides(const Project& project) {
  std::map<NodeId, std::size_t> inside;
  for (std::size_t i = 0; i < project.stems.size(); ++i)
    for (std::size_t n = 1; n < nodesOf(project, i).size(); ++n) inside.emplace(nodesOf(project, i)[n], i);
  return inside;
}

Result<void> checkInside(const Project& project, std::size_t stem, const std::map<NodeId, std::size_t>& insideOthers) {
  const Nodes& nodes = nodesOf(project, stem);
  std::set<NodeId> seen;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!seen.insert(nodes[n]).second)
      return fail(ErrorCode::BadInput, nameOf(nodes[n]) + " would be twice in " + nameOf(idOf(project, stem)) + "; a stem never comes back to itself");
    const auto other = n > 0 ? insideOthers.find(nodes[n]) : insideOthers.end();
    if (other != insideOthers.end())
      return fail(ErrorCode::BadInput, nameOf(nodes[n]) + " belongs to " + nameOf(idOf(project, other->second)) + " already; begin a branch there, or take another node");
  }
  return {};
}

// From stem to parent until there is none; a circle would come back to where it began.
Result<void> checkNoCircle(const Project& project, std::size_t stem, const std::map<NodeId, std::size_t>& inside) {
  std::size_t at = stem;
  for (std::size_t steps = 0; steps <= project.stems.size() && !nodesOf(project, at).empty(); ++steps) {
    const auto parent = inside.find(nodesOf(project, at).front());
    if (parent == inside.end()) return {};
    at = parent->second;
    if (at == stem)
      return fail(ErrorCode::BadInput, nameOf(idOf(project, stem)) + " would grow out of itself; what begins at its nodes cannot also carry it");
  }
  return {};
}

/// Whether `stem` can stand in a tree together with the others.
Result<void> checkStem(const Project& project, std::size_t stem) {
  std::map<NodeId, std::size_t> inside = insides(project);
  std::map<NodeId, std::size_t> others = inside;
  std::erase_if(others, [&](const auto& entry) { return entry.second == stem; });
  // A node that an earlier stem has too is listed for that one; where a later one has it, look there.
  for (std::size_t i = stem + 1; i < project.stems.size(); ++i)
    for (std::size_t n = 1; n < nodesOf(project, i).size(); ++n) others.emplace(nodesOf(project, i)[n], i);
  if (auto checked = checkInside(project, stem, others); !checked) return checked;
  return checkNoCircle(project, stem, inside);
}

/// The project with other nodes in one stem, if that can be.
Result<Project> withNodes(Project project, std::size_t at, Nodes nodes) {
  ProjectStem stem = project.stems[at];
  stem.stem.nodes = std::move(nodes);
  project.stems.set(at, std::move(stem));
  if (auto checked = checkStem(project, at); !checked) return checked.failure();
  return project;
}

Result<Project> withNewStem(Project project, StemId id, Nodes nodes) {
  if (auto checked = checkNewStem(project, id); !checked) return checked.failure();
  ProjectStem stem;
  stem.stem.id = id;
  stem.stem.nodes = std::move(nodes);
  project.stems.push_back(std::move(stem));
  if (auto checked = checkStem(project, project.stems.size() - 1); !checked) return checked.failure();
  return project;
}

bool isOnOther(const Project& project, std::size_t stem, NodeId node) {
  for (std::size_t i = 0; i < project.stems.size(); ++i)
    if (i != stem && std::find(nodesOf(project, i).begin(), nodesOf(project, i).end(), node) != nodesOf(project, i).end()) return true;
  return false;
}

Result<std::size_t> placeIn(const Project& project, std::size_t stem, NodeId node) {
  const Nodes& nodes = nodesOf(project, stem);
  const auto at = std::find(nodes.begin(), nodes.end(), node);
  if (at == nodes.end()) return fail(ErrorCode::NotFound, nameOf(idOf(project, stem)) + " has no " + nameOf(node));
  return static_cast<std::size_t>(at - nodes.begin());
}

// ---- leaves that go with their nodes ---------------------------------------------------------------------------------

/// `leaves` at those of their nodes that are to stay; a count that said how many nodes there were says so still.
template <class Stays>
quantify::LeafArrangement atThose(quantify::LeafArrangement leaves, Stays stays) {
  const bool counted = leaves.nodes && static_cast<std::size_t>(*leaves.nodes) == leaves.at.size();
  std::erase_if(leaves.at, [&](NodeId node) { return !stays(node); });
  if (counted) leaves.nodes = static_cast<int>(leaves.at.size());
  return leaves;
}

/// Leaves at nodes of `nodes` leave `from` for `to`; an arrangement with nodes on both is divided.
void moveLeaves(Project& project, StemId from, StemId to, const std::set<NodeId>& nodes) {
  const std::size_t count = project.leaves.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ProjectLeaves& leaves = project.leaves[i];
    if (leaves.arrangement.stem != from) continue;
    ProjectLeaves go = leaves, stay = leaves;
    go.arrangement = atThose(leaves.arrangement, [&](NodeId node) { return nodes.contains(node); });
    go.arrangement.stem = to;
    if (go.arrangement.at.empty()) continue;
    stay.arrangement = atThose(leaves.arrangement, [&](NodeId node) { return !nodes.contains(node); });
    project.leaves.set(i, stay.arrangement.at.empty() ? go : stay);
    if (!stay.arrangement.at.empty()) project.leaves.push_back(go);
  }
}

void renameLeafStem(Project& project, StemId from, StemId to) {
  for (std::size_t i = 0; i < project.leaves.size(); ++i) {
    if (project.leaves[i].arrangement.stem != from) continue;
    ProjectLeaves leaves = project.leaves[i];
    leaves.arrangement.stem = to;
    project.leaves.set(i, std::move(leaves));
  }
}

// ---- what hangs on a stem --------------------------------------------------------------------------------------------

/// The stem and all that hang on it, by their places.
std::set<std::size_t> withAllOn(const Project& project, std::size_t stem) {
  std::multimap<NodeId, std::size_t> from;
  for (std::size_t i = 0; i < project.stems.size(); ++i)
    if (!nodesOf(project, i).empty()) from.emplace(nodesOf(project, i).front(), i);
  std::set<std::size_t> all{stem};
  std::vector<std::size_t> todo{stem};
  while (!todo.empty()) {
    const Nodes& nodes = nodesOf(project, todo.back());
    todo.pop_back();
    for (std::size_t n = 1; n < nodes.size(); ++n)
      for (auto [child, end] = from.equal_range(nodes[n]); child != end; ++child)
        if (all.insert(child->second).second) todo.push_back(child->second);
  }
  return all;
}

}  // namespace

Result<std::size_t> placeOfStem(const Project& project, StemId id) {
  if (const auto at = stemWithId(project, id)) return *at;
  return fail(ErrorCode::NotFound, "there is no " + nameOf(id));
}

Result<void> checkNewStem(const Project& project, StemId id) {
  if (!id.valid()) return fail(ErrorCode::BadInput, "a stem's id must be 0 or above");
  if (stemWithId(project, id)) return fail(ErrorCode::BadInput, "there is a " + nameOf(id) + " already; the next free id is " + std::to_string(nextStemId(project).value));
  if (project.stems.size() >= kMaximumStems) return fail(ErrorCode::LimitReached, "a project has at most " + std::to_string(kMaximumStems) + " stems");
  return {};
}

void eraseStems(Project& project, const std::set<StemId>& stems) {
  if (stems.empty()) return;
  project.stems.eraseIf([&](const ProjectStem& stem) { return stems.contains(stem.stem.id); });
  project.leaves.eraseIf([&](const ProjectLeaves& leaves) { return stems.contains(leaves.arrangement.stem); });
}

void forgetLeafNodes(Project& project, const std::set<NodeId>& nodes, std::optional<StemId> stem) {
  for (std::size_t i = project.leaves.size(); i-- > 0;) {
    const ProjectLeaves& leaves = project.leaves[i];
    if (stem && leaves.arrangement.stem != *stem) continue;
    ProjectLeaves rest = leaves;
    rest.arrangement = atThose(leaves.arrangement, [&](NodeId node) { return !nodes.contains(node); });
    if (rest.arrangement.at.size() == leaves.arrangement.at.size()) continue;
    if (rest.arrangement.at.empty()) project.leaves.erase(i);
    else project.leaves.set(i, std::move(rest));
  }
}

Result<Project> after(Project project, const AddStem& command) {
  if (command.nodes.empty()) return fail(ErrorCode::BadInput, "a stem needs a node to begin with");
  for (const NodeId node : command.nodes)
    if (const auto at = placeOfNode(project, node); !at) return at.failure();
  return withNewStem(std::move(project), command.stem, command.nodes);
}

Result<Project> after(Project project, const StartBranch& command) {
  if (const auto at = placeOfNode(project, command.at); !at) return at.failure();
  if (!isOnOther(project, project.stems.size(), command.at))
    return fail(ErrorCode::BadInput, nameOf(command.at) + " is on no stem, so nothing can branch there; add a stem instead");
  return withNewStem(std::move(project), command.stem, {command.at});
}

Result<Project> after(Project project, const AppendNode& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  if (const auto at = placeOfNode(project, command.node); !at) return at.failure();
  Nodes nodes = nodesOf(project, *stem);
  nodes.push_back(command.node);
  return withNodes(std::move(project), *stem, std::move(nodes));
}

Result<Project> after(Project project, const InsertNode& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  if (const auto at = placeOfNode(project, command.node); !at) return at.failure();
  const auto before = placeIn(project, *stem, command.before);
  if (!before) return before.failure();
  Nodes nodes = nodesOf(project, *stem);
  nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(*before), command.node);
  return withNodes(std::move(project), *stem, std::move(nodes));
}

Result<Project> after(Project project, const RemoveFromStem& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  const auto at = placeIn(project, *stem, command.node);
  if (!at) return at.failure();
  if (const auto from = stemsFrom(project, command.node); *at > 0 && !from.empty())
    return fail(ErrorCode::BadInput, nameOf(idOf(project, from.front())) + " begins at " + nameOf(command.node) + "; remove that stem or attach it elsewhere first");
  Nodes nodes = nodesOf(project, *stem);
  nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(*at));
  forgetLeafNodes(project, {command.node}, command.stem);
  if (nodes.empty() || (nodes.size() == 1 && *at > 0 && isOnOther(project, *stem, nodes.front()))) {
    eraseStems(project, {command.stem});
    return project;
  }
  return withNodes(std::move(project), *stem, std::move(nodes));
}

Result<Project> after(Project project, const AttachStem& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  if (const auto at = placeOfNode(project, command.at); !at) return at.failure();
  Nodes nodes = nodesOf(project, *stem);
  const bool branch = !nodes.empty() && isOnOther(project, *stem, nodes.front());
  if (branch) {
    forgetLeafNodes(project, {nodes.front()}, command.stem);
    nodes.front() = command.at;
  } else {
    nodes.insert(nodes.begin(), command.at);
  }
  return withNodes(std::move(project), *stem, std::move(nodes));
}

Result<Project> after(Project project, const SplitStem& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  const auto at = placeIn(project, *stem, command.at);
  if (!at) return at.failure();
  const Nodes nodes = nodesOf(project, *stem);
  if (*at == 0 || *at + 1 == nodes.size())
    return fail(ErrorCode::BadInput, nameOf(command.at) + " is an end of " + nameOf(command.stem) + "; split it at a node in between");
  const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(*at);
  auto lower = withNodes(std::move(project), *stem, Nodes(nodes.begin(), middle + 1));
  if (!lower) return lower;
  moveLeaves(*lower, command.stem, command.upper, std::set<NodeId>(middle + 1, nodes.end()));
  return withNewStem(std::move(*lower), command.upper, Nodes(middle, nodes.end()));
}

Result<Project> after(Project project, const JoinStems& command) {
  const auto lower = placeOfStem(project, command.lower);
  if (!lower) return lower.failure();
  const auto upper = placeOfStem(project, command.upper);
  if (!upper) return upper.failure();
  if (*lower == *upper) return fail(ErrorCode::BadInput, "a stem cannot be joined to itself");
  Nodes nodes = nodesOf(project, *lower);
  const Nodes& above = nodesOf(project, *upper);
  const bool meets = !nodes.empty() && !above.empty() && nodes.back() == above.front();
  if (const auto carrier = above.empty() ? std::nullopt : stemThrough(project, above.front()); !meets && carrier)
    return fail(ErrorCode::BadInput, nameOf(command.upper) + " begins at " + nameOf(above.front()) + " of " + nameOf(idOf(project, *carrier)) + ", not at the tip of " +
                                         nameOf(command.lower) + "; attach it there first");
  nodes.insert(nodes.end(), above.begin() + (meets ? 1 : 0), above.end());
  renameLeafStem(project, command.upper, command.lower);
  project.stems.erase(*upper);
  return withNodes(std::move(project), *lower - (*upper < *lower ? 1 : 0), std::move(nodes));
}

Result<Project> after(Project project, const ReverseStem& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  Nodes nodes = nodesOf(project, *stem);
  if (nodes.size() < 2) return fail(ErrorCode::BadInput, nameOf(command.stem) + " has a single node; there is nothing to turn round");
  if (const auto parent = stemThrough(project, nodes.front()))
    return fail(ErrorCode::BadInput, nameOf(command.stem) + " grows out of " + nameOf(idOf(project, *parent)) + " at " + nameOf(nodes.front()) +
                                         " and cannot run towards it; take that node from it first");
  std::reverse(nodes.begin(), nodes.end());
  return withNodes(std::move(project), *stem, std::move(nodes));
}

Result<Project> after(Project project, const RemoveStem& command) {
  const auto stem = placeOfStem(project, command.stem);
  if (!stem) return stem.failure();
  const std::set<std::size_t> doomed = withAllOn(project, *stem);
  std::set<NodeId> gone, kept;
  std::set<StemId> ids;
  for (std::size_t i = 0; i < project.stems.size(); ++i) {
    const bool goes = doomed.contains(i);
    (goes ? gone : kept).insert(nodesOf(project, i).begin(), nodesOf(project, i).end());
    if (goes) ids.insert(idOf(project, i));
  }
  eraseStems(project, ids);
  project.nodes.eraseIf([&](const ProjectNode& node) { return gone.contains(node.node.id) && !kept.contains(node.node.id); });
  return project;
}

}  // namespace axil::document
