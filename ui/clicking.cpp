#include "ui/clicking.hpp"

#include "document/lookup.hpp"

#include <algorithm>
#include <limits>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;
using document::StemId;
using document::Step;

const skeleton3d::ClickedStem& stemAt(const Project& project, std::size_t place) { return project.stems[place].stem; }

bool hasClick(const Project& project, NodeId id, const std::string& view) { return document::clickOf(project, id, view) != nullptr; }

/// The stem that a new node beyond `node` would lengthen: one that ends at it, or one just begun there.
std::optional<StemId> growingStem(const Project& project, NodeId node) {
  if (const auto through = document::stemThrough(project, node); through && stemAt(project, *through).nodes.back() == node)
    return stemAt(project, *through).id;
  for (const std::size_t begun : document::stemsFrom(project, node))
    if (stemAt(project, begun).nodes.size() == 1) return stemAt(project, begun).id;
  return std::nullopt;
}

/// The next node up the stem that has no click in the view; else the node itself.
NodeId nextWithout(const Project& project, NodeId node, const std::string& view) {
  const auto stem = stemOf(project, node);
  const auto place = stem ? document::stemWithId(project, *stem) : std::nullopt;
  if (!place) return node;
  const auto& nodes = stemAt(project, *place).nodes;
  const auto from = std::find(nodes.begin(), nodes.end(), node);
  const auto next = std::find_if(from, nodes.end(), [&](NodeId id) { return id != node && !hasClick(project, id, view); });
  return next == nodes.end() ? node : *next;
}

ClickMeaning place(const Project& project, NodeId node, const PhotoClick& click) {
  return {ClickKind::Place, Step{document::AddClick{node, click.view, click.at}}, {.node = nextWithout(project, node, click.view), .others = {}}, node, stemOf(project, node)};
}

/// A new node at each place of `way`; the stem through `node`, or a new one, goes on through them all.
ClickMeaning grow(const Project& project, NodeId node, const std::string& view, std::span<const PhotoPoint> way) {
  const std::optional<StemId> growing = growingStem(project, node);
  const StemId stem = growing.value_or(document::nextStemId(project));
  const bool isBranch = !growing && (document::stemThrough(project, node) || !document::stemsFrom(project, node).empty());
  Step step;
  step.reserve(2 * way.size() + 1);
  NodeId added = document::nextNodeId(project);
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) ++added.value;
    step.emplace_back(document::AddNode{added, view, way[i]});
    if (isBranch && i == 0) step.emplace_back(document::StartBranch{stem, node});
    if (!growing && !isBranch && i == 0) step.emplace_back(document::AddStem{stem, {node, added}});
    else step.emplace_back(document::AppendNode{stem, added});
  }
  return {isBranch ? ClickKind::Branch : ClickKind::Extend, std::move(step), {.node = added, .others = {}}, node, stem};
}

ClickMeaning beginStem(const Project& project, const PhotoClick& click) {
  const NodeId node = document::nextNodeId(project);
  const StemId stem = document::nextStemId(project);
  return {ClickKind::Begin, Step{document::AddNode{node, click.view, click.at}, document::AddStem{stem, {node}}}, {.node = node, .others = {}}, node, stem};
}

}  // namespace

bool Selection::has(NodeId id) const { return node == id || std::find(others.begin(), others.end(), id) != others.end(); }

std::vector<NodeId> Selection::all() const {
  std::vector<NodeId> nodes = others;
  if (node) nodes.insert(nodes.begin(), *node);
  return nodes;
}

void Selection::add(NodeId id) {
  if (has(id)) return;
  if (node) others.push_back(id);
  else node = id;
}

void Selection::remove(NodeId id) {
  std::erase(others, id);
  if (node != id) return;
  node = others.empty() ? std::nullopt : std::optional(others.front());
  if (!others.empty()) others.erase(others.begin());
}

std::optional<StemId> stemOf(const Project& project, NodeId node) {
  if (const auto through = document::stemThrough(project, node)) return stemAt(project, *through).id;
  const auto begun = document::stemsFrom(project, node);
  return begun.empty() ? std::nullopt : std::optional(stemAt(project, begun.front()).id);
}

std::optional<NodeId> nodeAt(const Project& project, const PhotoClick& click) {
  std::optional<NodeId> nearest;
  double best = click.reach_px;
  for (const auto& entry : project.nodes) {
    const auto at = entry.node.clicks.find(click.view);
    if (at == entry.node.clicks.end()) continue;
    const double distance = glm::distance(at->second.px, click.at.px);
    if (distance > best) continue;
    best = distance;
    nearest = entry.node.id;
  }
  return nearest;
}

ClickMeaning meaningOf(const Project& project, const Selection& selection, const PhotoClick& click) {
  return meaningAlong(project, selection, click, std::span(&click.at, 1));
}

ClickMeaning meaningAlong(const Project& project, const Selection& selection, const PhotoClick& click, std::span<const PhotoPoint> way) {
  if (!document::viewNamed(project, click.view)) return {};
  if (click.picking == Picking::PickNodes)
    if (const auto node = nodeAt(project, click)) return {ClickKind::Select, {}, {.node = node, .others = {}}, node, stemOf(project, *node)};
  const bool selected = selection.node && document::nodeWithId(project, *selection.node);
  if (selected && !hasClick(project, *selection.node, click.view)) return place(project, *selection.node, click);
  if (selected) return grow(project, *selection.node, click.view, way);
  if (project.stems.empty()) return beginStem(project, click);
  return {};
}

}  // namespace axil::ui
