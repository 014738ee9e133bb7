#include "skeleton3d/tree.hpp"

#include "skeleton3d/solve_all.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <unordered_map>

namespace axil::skeleton3d {
namespace {

using detail::Trouble;

std::string name(NodeId id) { return "node " + std::to_string(id.value); }
std::string name(StemId id) { return "stem " + std::to_string(id.value); }
Trouble wrong(std::string text) { return {ErrorCode::BadInput, std::move(text)}; }

/// Where things are in what was clicked. The spans are the caller's and outlive it.
struct Clicked {
  std::span<const ClickedNode> nodes;
  std::span<const ClickedStem> stems;
  std::unordered_map<NodeId, std::size_t> nodeAt;    ///< id -> index; the first of equal ids
  std::unordered_map<NodeId, std::size_t> passedBy;  ///< node -> the stem in which it is not the first node
};

void checkStem(const Clicked& clicked, const ClickedStem& stem, std::vector<Trouble>& troubles) {
  if (!stem.id.valid()) troubles.push_back(wrong(name(stem.id) + " has a negative id; ids start at 0"));
  if (stem.nodes.size() < 2) troubles.push_back(wrong(name(stem.id) + " has fewer than two nodes; a stem runs from where it leaves its parent to its tip"));
  std::set<NodeId> seen;
  for (const NodeId id : stem.nodes) {
    if (!clicked.nodeAt.contains(id)) troubles.push_back(wrong(name(stem.id) + " lists " + name(id) + ", which does not exist"));
    if (!seen.insert(id).second) troubles.push_back(wrong(name(stem.id) + " lists " + name(id) + " twice; a stem cannot run in a circle"));
  }
}

/// Fills `passedBy`; a node that two stems pass through closes a circle or joins two plants.
void findPassages(Clicked& clicked, std::vector<Trouble>& troubles) {
  for (std::size_t s = 0; s < clicked.stems.size(); ++s) {
    const std::vector<NodeId>& chain = clicked.stems[s].nodes;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const auto [at, isNew] = clicked.passedBy.try_emplace(chain[k], s);
      if (!isNew && at->second != s)
        troubles.push_back(wrong(name(chain[k]) + " belongs to both " + name(clicked.stems[at->second].id) + " and " + name(clicked.stems[s].id) +
                                 "; of two stems that meet one must begin there"));
    }
  }
}

Clicked indexed(std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems, std::vector<Trouble>& troubles) {
  Clicked clicked{nodes, stems, {}, {}};
  for (std::size_t i = 0; i < nodes.size(); ++i) clicked.nodeAt.try_emplace(nodes[i].id, i);
  std::set<StemId> seen;
  for (const ClickedStem& stem : stems) {
    if (!seen.insert(stem.id).second) troubles.push_back(wrong(name(stem.id) + " is listed twice; give every stem its own id"));
    checkStem(clicked, stem, troubles);
  }
  findPassages(clicked, troubles);
  return clicked;
}

/// For each stem the stem it leaves, by index; none for those that begin where no other stem passes.
using Parents = std::vector<std::optional<std::size_t>>;

Parents parentsOf(const Clicked& clicked) {
  Parents parents(clicked.stems.size());
  std::unordered_map<NodeId, std::size_t> firstWithRoot;
  for (std::size_t s = 0; s < clicked.stems.size(); ++s) {
    if (clicked.stems[s].nodes.empty()) continue;
    const NodeId base = clicked.stems[s].nodes.front();
    if (const auto passed = clicked.passedBy.find(base); passed != clicked.passedBy.end()) {
      if (passed->second != s) parents[s] = passed->second;
    } else if (const auto [first, isNew] = firstWithRoot.try_emplace(base, s); !isNew) {
      parents[s] = first->second;
    }
  }
  return parents;
}

/// Stems with every parent before its children, otherwise in the file's order; stems in or behind a circle are left out.
std::vector<std::size_t> parentsFirst(const Parents& parents) {
  std::vector<std::vector<std::size_t>> children(parents.size());
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
  for (std::size_t s = 0; s < parents.size(); ++s) {
    if (parents[s])
      children[*parents[s]].push_back(s);
    else
      ready.push(s);
  }
  std::vector<std::size_t> order;
  for (; !ready.empty();) {
    const std::size_t s = ready.top();
    ready.pop();
    order.push_back(s);
    for (const std::size_t child : children[s]) ready.push(child);
  }
  return order;
}

std::string listOf(std::span<const ClickedStem> stems, const std::vector<std::size_t>& which) {
  std::string text = which.size() == 1 ? "stem " : "stems ";
  for (std::size_t i = 0; i < which.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(stems[which[i]].id.value);
  return text;
}

void checkCircles(const Clicked& clicked, const std::vector<std::size_t>& order, std::vector<Trouble>& troubles) {
  std::vector<char> placed(clicked.stems.size(), 0);
  for (const std::size_t s : order) placed[s] = 1;
  std::vector<std::size_t> left;
  for (std::size_t s = 0; s < clicked.stems.size(); ++s)
    if (placed[s] == 0) left.push_back(s);
  if (left.empty()) return;
  troubles.push_back(wrong("the stems run in a circle: " + listOf(clicked.stems, left) + (left.size() == 1 ? " hangs" : " hang") +
                           " on one another and lead back to no root; turn one around"));
}

void checkOneRoot(const Clicked& clicked, const Parents& parents, const std::vector<std::size_t>& order, std::vector<Trouble>& troubles) {
  const auto first = std::find_if(order.begin(), order.end(), [&](std::size_t s) { return !parents[s] && clicked.stems[s].nodes.size() > 1; });
  if (first == order.end()) return;
  const ClickedStem& main = clicked.stems[*first];
  for (const std::size_t s : order) {
    const ClickedStem& stem = clicked.stems[s];
    if (parents[s] || s == *first || stem.nodes.empty()) continue;
    troubles.push_back(wrong(name(stem.id) + " is not connected: it begins at " + name(stem.nodes.front()) + ", which no other stem has, so that the plant would have two roots, " +
                             name(main.nodes.front()) + " and " + name(stem.nodes.front()) + "; begin it with a node of its parent"));
  }
}

void checkLooseNodes(const Clicked& clicked, std::vector<Trouble>& troubles) {
  std::set<NodeId> used;
  for (const ClickedStem& stem : clicked.stems) used.insert(stem.nodes.begin(), stem.nodes.end());
  for (const ClickedNode& node : clicked.nodes)
    if (!used.contains(node.id)) troubles.push_back(wrong(name(node.id) + " belongs to no stem; add it to one or remove it"));
}

double extentOf(const std::vector<std::optional<Node>>& nodes) {
  std::optional<glm::dvec3> low, high;
  for (const auto& node : nodes) {
    if (!node) continue;
    low = low ? glm::min(*low, node->position.at) : node->position.at;
    high = high ? glm::max(*high, node->position.at) : node->position.at;
  }
  return low ? glm::length(*high - *low) : 0.0;
}

void checkLengths(const Clicked& clicked, const std::vector<std::optional<Node>>& nodes, std::vector<Trouble>& troubles) {
  const double shortest = 1e-6 * extentOf(nodes);
  const auto placeOf = [&](NodeId id) -> const Node* {
    const auto at = clicked.nodeAt.find(id);
    return at == clicked.nodeAt.end() || !nodes[at->second] ? nullptr : &*nodes[at->second];
  };
  for (const ClickedStem& stem : clicked.stems)
    for (std::size_t k = 1; k < stem.nodes.size(); ++k) {
      const Node* from = placeOf(stem.nodes[k - 1]);
      const Node* to = placeOf(stem.nodes[k]);
      if (from == nullptr || to == nullptr || from->id == to->id || glm::length(to->position.at - from->position.at) > shortest) continue;
      troubles.push_back({ErrorCode::NoAnswer, name(stem.id) + " has a segment of no length: " + name(from->id) + " and " + name(to->id) + " are at the same place; remove one"});
    }
}

/// Radii along one stem by arc length; `s` from the stem's base. A stem's first node is its parent's and keeps what it has.
void fillRadii(const std::vector<NodeId>& chain, const std::unordered_map<NodeId, std::size_t>& nodeAt, std::size_t firstOwn, std::vector<Node>& nodes) {
  struct Known {
    double s;
    double radius;
  };
  std::vector<Known> known;
  std::vector<double> s(chain.size(), 0.0);
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Node& node = nodes[nodeAt.at(chain[k])];
    if (k > 0) s[k] = s[k - 1] + glm::length(node.position.at - nodes[nodeAt.at(chain[k - 1])].position.at);
    if (k >= firstOwn && node.radius) known.push_back({s[k], *node.radius});
  }
  if (known.empty()) return;
  for (std::size_t k = firstOwn; k < chain.size(); ++k) {
    Node& node = nodes[nodeAt.at(chain[k])];
    if (node.radius) continue;
    const auto after = std::find_if(known.begin(), known.end(), [&](const Known& at) { return at.s > s[k]; });
    if (after == known.begin() || after == known.end()) {
      node.radius = (after == known.end() ? known.back() : known.front()).radius;
      continue;
    }
    const Known& before = *(after - 1);
    node.radius = before.radius + (after->radius - before.radius) * (s[k] - before.s) / (after->s - before.s);
  }
}

Skeleton assembled(const Clicked& clicked, const Parents& parents, const std::vector<std::size_t>& order, std::vector<std::optional<Node>> solved, std::string unit) {
  Skeleton skeleton;
  skeleton.unit = std::move(unit);
  skeleton.nodes.reserve(solved.size());
  for (std::optional<Node>& node : solved) skeleton.nodes.push_back(std::move(*node));
  for (const std::size_t s : order) {
    const ClickedStem& stem = clicked.stems[s];
    skeleton.stems.push_back({stem.id, parents[s] ? std::optional(clicked.stems[*parents[s]].id) : std::nullopt, stem.nodes});
    fillRadii(stem.nodes, clicked.nodeAt, parents[s] ? 1 : 0, skeleton.nodes);
  }
  skeleton.root = skeleton.stems.front().nodes.front();
  return skeleton;
}

/// What can be placed of what was clicked, and what waits for another view.
struct Complete {
  std::vector<ClickedNode> nodes;
  std::vector<ClickedStem> stems;
  std::vector<IncompleteNode> incomplete;
  std::vector<StemId> waiting;
};

std::vector<std::string> viewsOf(const ClickedNode& node) {
  std::vector<std::string> views;
  for (const auto& [view, click] : node.clicks) views.push_back(view);
  return views;
}

/// Drops stems that begin at a node which waits, or are too short without such nodes, until no more do; the nodes that only
/// they have then wait as well.
void holdBack(const std::set<NodeId>& open, Complete& complete) {
  std::set<NodeId> unplaced = open;
  for (bool again = true; again;) {
    again = false;
    for (auto stem = complete.stems.begin(); stem != complete.stems.end();) {
      const bool cutOff = !stem->nodes.empty() && unplaced.contains(stem->nodes.front());
      const auto placed = std::count_if(stem->nodes.begin(), stem->nodes.end(), [&](NodeId id) { return !unplaced.contains(id); });
      if (!cutOff && (placed >= 2 || placed == static_cast<std::ptrdiff_t>(stem->nodes.size()))) {
        ++stem;
        continue;
      }
      for (std::size_t k = 1; k < stem->nodes.size(); ++k) unplaced.insert(stem->nodes[k]);
      complete.waiting.push_back(stem->id);
      stem = complete.stems.erase(stem);
      again = true;
    }
  }
  for (ClickedStem& stem : complete.stems) std::erase_if(stem.nodes, [&](NodeId id) { return unplaced.contains(id); });
  std::erase_if(complete.nodes, [&](const ClickedNode& node) { return unplaced.contains(node.id); });
}

Complete completeOf(std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems) {
  Complete complete{{nodes.begin(), nodes.end()}, {stems.begin(), stems.end()}, {}, {}};
  std::set<NodeId> open;
  for (const ClickedNode& node : nodes)
    if (node.clicks.size() < 2 && open.insert(node.id).second) complete.incomplete.push_back({node.id, viewsOf(node)});
  if (!open.empty()) holdBack(open, complete);
  return complete;
}

/// A root without a place leaves nothing to join the plant to.
std::optional<Trouble> rootTrouble(std::span<const ClickedStem> stems, const Complete& complete) {
  if (complete.incomplete.empty() || !complete.stems.empty() || stems.empty()) return std::nullopt;
  const IncompleteNode& first = complete.incomplete.front();
  return Trouble{ErrorCode::NoAnswer, name(first.id) + (first.views.empty() ? " is clicked in no view" : " is clicked in one view only (" + first.views.front() + ")") +
                                          " and no stem can be placed without it; click it in another view too"};
}

}  // namespace

Result<Skeleton> buildSkeleton(std::span<const View> views, std::span<const ClickedNode> allNodes, std::span<const ClickedStem> allStems, const SolveOptions& options,
                               std::string unit) {
  Complete complete = completeOf(allNodes, allStems);
  if (const auto trouble = rootTrouble(allStems, complete)) return detail::failWith({*trouble}, "the clicks do not make a plant");
  const std::span<const ClickedNode> nodes = complete.nodes;
  const std::span<const ClickedStem> stems = complete.stems;
  auto solved = detail::solveAll(views, nodes, options, unit);
  if (!solved) return solved.failure();
  std::vector<Trouble> troubles = std::move(solved->troubles);
  for (const ClickedNode& node : allNodes)
    if (node.clicks.size() < 2)
      for (Trouble& trouble : detail::clickTroubles(views, node)) troubles.push_back(std::move(trouble));
  if (stems.empty()) troubles.push_back(wrong("there is no stem; join the nodes to stems"));
  const Clicked clicked = indexed(nodes, stems, troubles);
  const Parents parents = parentsOf(clicked);
  const std::vector<std::size_t> order = parentsFirst(parents);
  checkCircles(clicked, order, troubles);
  checkOneRoot(clicked, parents, order, troubles);
  if (!stems.empty()) checkLooseNodes(clicked, troubles);
  checkLengths(clicked, solved->nodes, troubles);
  if (!troubles.empty()) return detail::failWith(troubles, "the clicks do not make a plant");
  Skeleton skeleton = assembled(clicked, parents, order, std::move(solved->nodes), std::move(unit));
  skeleton.incomplete = std::move(complete.incomplete);
  skeleton.waiting = std::move(complete.waiting);
  return skeleton;
}

}  // namespace axil::skeleton3d
