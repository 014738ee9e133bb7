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

/// The node right above on the stem, where it is clicked in other photos alone: there the stem is being clicked anew.
std::optional<NodeId> goesOnWithout(const Project& project, NodeId node, const std::string& view) {
  const auto stem = stemOf(project, node);
  if (!stem) return std::nullopt;
  const auto& nodes = stemAt(project, *document::stemWithId(project, *stem)).nodes;
  const auto here = std::find(nodes.begin(), nodes.end(), node);
  if (here == nodes.end() || here + 1 == nodes.end() || hasClick(project, *(here + 1), view)) return std::nullopt;
  return *(here + 1);
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

/// Whether the selected node waits for a branch, or is the tip of a stem in the making, clicked in one photo alone: then a click on a stem's
/// line is what goes on there, since any stem may stand before another.
bool waits(const Project& project, NodeId selected) {
  constexpr std::size_t kPlaced = 2;
  return !growingStem(project, selected) || project.nodes[*document::nodeWithId(project, selected)].node.clicks.size() < kPlaced;
}

std::optional<ClickMeaning> insert(const Project& project, std::optional<NodeId> selected, const PhotoClick& click) {
  const auto place = lineAt(project, click);
  if (!place || (selected && waits(project, *selected))) return std::nullopt;
  return ClickMeaning{ClickKind::Insert, insertAt(project, *place, click), {.node = document::nextNodeId(project), .others = {}}, place->above, place->stem};
}

/// How far from the origin a first stem is still taken to begin at it, of the photo's longer side.
constexpr double kCollar = 0.01;

/// The plant's base: a click on the origin that was set in this photo stands for those in the others too.
ClickMeaning beginStem(const Project& project, const PhotoClick& click) {
  const NodeId node = document::nextNodeId(project);
  const StemId stem = document::nextStemId(project);
  Step step{document::AddNode{node, click.view, click.at}, document::AddStem{stem, {node}}};
  const document::ProjectView& clicked = project.views[*document::viewNamed(project, click.view)];
  const double near = project.stems.empty() ? kCollar * std::max(clicked.view.size_px.x, clicked.view.size_px.y) : 0;
  if (clicked.origin_px && glm::distance(clicked.origin_px->px, click.at.px) <= std::max(near, click.reach_px))
    for (const document::ProjectView& view : project.views)
      if (view.view.name != click.view && view.origin_px) step.emplace_back(document::AddClick{node, view.view.name, *view.origin_px});
  return {ClickKind::Begin, std::move(step), {.node = node, .others = {}}, node, stem};
}

}  // namespace

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double share = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * along);
}

std::vector<skeleton3d::TakenSegment> segmentsIn(const Project& project, const std::string& view) {
  std::vector<skeleton3d::TakenSegment> segments;
  for (const document::ProjectStem& entry : project.stems)
    for (std::size_t i = 1; i < entry.stem.nodes.size(); ++i) {
      const PhotoPoint *a = document::clickOf(project, entry.stem.nodes[i - 1], view), *b = document::clickOf(project, entry.stem.nodes[i], view);
      if (a != nullptr && b != nullptr) segments.emplace_back(*a, *b);
    }
  return segments;
}

double bowOf(double length_px, double photo_px) {
  constexpr double kOfLength = 0.04, kOfPhoto = 0.016;
  return std::min(kOfLength * length_px, kOfPhoto * photo_px);
}

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

namespace {

enum class Bow { None, Allowed };

/// The nearest segment within reach, which a bow of the stem lengthens.
std::optional<PlaceOnStem> placeWithin(const Project& project, const PhotoClick& click, Bow bow) {
  std::optional<PlaceOnStem> nearest;
  for (const auto& entry : project.stems)
    for (std::size_t i = 1; i < entry.stem.nodes.size(); ++i) {
      const PhotoPoint* a = document::clickOf(project, entry.stem.nodes[i - 1], click.view);
      const PhotoPoint* b = document::clickOf(project, entry.stem.nodes[i], click.view);
      if (a == nullptr || b == nullptr) continue;
      const double distance = distanceToSegment(click.at.px, a->px, b->px);
      const double bow_px = bow == Bow::None ? 0 : bowOf(glm::distance(a->px, b->px), click.photo_px);
      if (distance > click.reach_px + bow_px || (nearest && distance >= nearest->distance_px)) continue;
      nearest = PlaceOnStem{entry.stem.id, entry.stem.nodes[i - 1], entry.stem.nodes[i], distance};
    }
  return nearest;
}

}  // namespace

std::optional<PlaceOnStem> placeOnStem(const Project& project, const PhotoClick& click) { return placeWithin(project, click, Bow::None); }

Step insertAt(const Project& project, const PlaceOnStem& place, const PhotoClick& click) {
  const NodeId node = document::nextNodeId(project);
  return {document::AddNode{node, click.view, click.at}, document::InsertNode{place.stem, node, place.above}};
}

std::optional<PlaceOnStem> lineAt(const Project& project, PhotoClick click) {
  click.reach_px = std::max(click.reach_px, click.stem_px) / 2;
  return placeWithin(project, click, click.stem_px > 0 ? Bow::Allowed : Bow::None);
}

ClickMeaning meaningOf(const Project& project, const Selection& selection, const PhotoClick& click) {
  return meaningAlong(project, selection, click, std::span(&click.at, 1));
}

ClickMeaning meaningAlong(const Project& project, const Selection& selection, const PhotoClick& click, std::span<const PhotoPoint> way) {
  if (!document::viewNamed(project, click.view)) return {};
  const bool selected = selection.node && document::nodeWithId(project, *selection.node);
  const PhotoPoint* own = selected ? document::clickOf(project, *selection.node, click.view) : nullptr;
  const bool onItself = own != nullptr && glm::distance(own->px, click.at.px) <= click.reach_px / 9;  // a pixel of the screen or so
  const auto node = click.picking == Picking::PickNodes ? nodeAt(project, click) : onItself ? selection.node : std::nullopt;
  if (node) return {ClickKind::Select, {}, {.node = node, .others = {}}, node, stemOf(project, *node)};
  if (selected && !hasClick(project, *selection.node, click.view)) return place(project, *selection.node, click);
  if (click.picking == Picking::PickNodes)
    if (auto inserted = insert(project, selected ? selection.node : std::nullopt, click)) return std::move(*inserted);
  if (const auto next = selected ? goesOnWithout(project, *selection.node, click.view) : std::nullopt) return place(project, *next, click);
  if (selected) return grow(project, *selection.node, click.view, way);
  if (project.stems.empty()) return beginStem(project, click);
  return {};
}

}  // namespace axil::ui
