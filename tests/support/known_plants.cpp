#include "support/known_plants.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace axil::test {

namespace {

using skeleton3d::Node;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::Stem;
using skeleton3d::StemId;

const Node& nodeOf(const Skeleton& skeleton, NodeId id) {
  return *std::find_if(skeleton.nodes.begin(), skeleton.nodes.end(), [id](const Node& n) { return n.id == id; });
}

std::int32_t nextNode(const Skeleton& skeleton) {
  std::int32_t next = 1;
  for (const Node& node : skeleton.nodes) next = std::max(next, node.id.value + 1);
  return next;
}

/// Extends stems one node at a time; remembers in which direction each stem goes.
class TreeGrower {
 public:
  TreeGrower(Rng& rng, const RandomTreeOptions& options) : rng_(rng), options_(options) {
    tree_.root = NodeId{1};
    tree_.nodes.push_back(makeNode({0.01, 0.02, -0.03}));
    begin(std::nullopt, tree_.root, randomDirection(rng));
  }

  Skeleton grown() {
    for (int i = 0; i < options_.collarBranches; ++i) begin(tree_.stems.front().id, tree_.root, randomDirection(rng_));
    while (static_cast<int>(tree_.nodes.size()) <= options_.segments) {
      const std::size_t stem = rng_.below(tree_.stems.size());
      if (rng_.uniform() < options_.branching) branch(stem);
      else extend(stem);
    }
    for (int l = 0; l < options_.leaves; ++l) addLeaf();
    return std::move(tree_);
  }

 private:
  Node makeNode(glm::dvec3 at) {
    Node node;
    node.id = NodeId{next_++};
    node.position.at = at;
    if (options_.radii) node.radius = rng_.uniform(0.001, 0.004);
    return node;
  }
  void begin(std::optional<StemId> parent, NodeId from, PlantDirection direction) {
    tree_.stems.push_back({StemId{static_cast<std::int32_t>(tree_.stems.size()) + 1}, parent, {from}});
    heading_.push_back(direction);
    extend(tree_.stems.size() - 1);
  }
  void extend(std::size_t stem) {
    const glm::dvec3 random = randomDirection(rng_).unit();
    heading_[stem] = PlantDirection::along(heading_[stem].unit() * (1 - options_.wander) + random * (options_.wander + 1e-9));
    const double length = rng_.uniform(options_.segmentLength / 10, options_.segmentLength);
    tree_.nodes.push_back(makeNode(nodeOf(tree_, tree_.stems[stem].nodes.back()).position.at + heading_[stem].unit() * length));
    tree_.stems[stem].nodes.push_back(tree_.nodes.back().id);
  }
  void branch(std::size_t stem) {
    const NodeId from = tree_.stems[stem].nodes[1 + rng_.below(tree_.stems[stem].nodes.size() - 1)];
    begin(tree_.stems[stem].id, from, randomDirection(rng_));
  }
  void addLeaf() {
    const Stem& stem = tree_.stems[rng_.below(tree_.stems.size())];
    skeleton3d::Leaf leaf;
    leaf.stem = stem.id;
    leaf.direction = randomDirection(rng_);
    leaf.normal = perpendicularTo(leaf.direction, randomDirection(rng_));
    const double stalk = rng_.uniform() < 0.5 ? 0 : 0.02;
    leaf.position.at = nodeOf(tree_, stem.nodes[rng_.below(stem.nodes.size())]).position.at + leaf.direction.unit() * stalk;
    leaf.length = 0.01 * static_cast<double>(1 + rng_.below(4));
    leaf.width = leaf.length / 2;
    leaf.shape = "ovate";
    tree_.leaves.push_back(leaf);
  }

  Rng& rng_;
  RandomTreeOptions options_;
  Skeleton tree_;
  std::vector<PlantDirection> heading_;
  std::int32_t next_ = 1;
};

template <class T>
void shuffle(std::vector<T>& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[rng.below(i)]);
}

}  // namespace

PlantDirection randomDirection(Rng& rng) { return PlantDirection::along({rng.normal(), rng.normal(), rng.normal()}); }

Skeleton randomTree(Rng& rng, const RandomTreeOptions& options) { return TreeGrower(rng, options).grown(); }

Skeleton chainThrough(std::span<const glm::dvec3> points) {
  Skeleton skeleton;
  skeleton.root = NodeId{1};
  skeleton.nodes.push_back({NodeId{1}, {points.front()}, std::nullopt, {0, 0, 0}, {}});
  addStem(skeleton, StemId{}, NodeId{1}, points.subspan(1));
  return skeleton;
}

void addStem(Skeleton& skeleton, StemId parent, NodeId from, std::span<const glm::dvec3> points) {
  Stem stem{StemId{1}, parent.valid() ? std::optional(parent) : std::nullopt, {from}};
  for (const Stem& other : skeleton.stems) stem.id.value = std::max(stem.id.value, other.id.value + 1);
  for (const glm::dvec3& at : points) {
    const NodeId id{nextNode(skeleton)};
    skeleton.nodes.push_back({id, {at}, std::nullopt, {0, 0, 0}, {}});
    stem.nodes.push_back(id);
  }
  skeleton.stems.push_back(stem);
}

Skeleton turnedAboutY(const Skeleton& skeleton, Angle angle) {
  const double c = std::cos(angle.radians());
  const double s = std::sin(angle.radians());
  const auto turn = [c, s](const glm::dvec3& v) { return glm::dvec3{c * v.x + s * v.z, v.y, c * v.z - s * v.x}; };
  Skeleton result = skeleton;
  for (Node& node : result.nodes) node.position.at = turn(node.position.at);
  for (skeleton3d::Leaf& leaf : result.leaves) {
    leaf.position.at = turn(leaf.position.at);
    leaf.direction = PlantDirection::along(turn(leaf.direction.unit()));
    leaf.normal = PlantDirection::along(turn(leaf.normal.unit()));
  }
  return result;
}

Skeleton shuffled(const Skeleton& skeleton, Rng& rng) {
  Skeleton result = skeleton;
  shuffle(result.nodes, rng);
  std::vector<Stem> waiting = skeleton.stems;
  shuffle(waiting, rng);
  result.stems.clear();
  std::map<StemId, bool> placed;
  while (!waiting.empty()) {
    const auto ready = std::find_if(waiting.begin(), waiting.end(), [&](const Stem& s) { return !s.parent || placed.contains(*s.parent); });
    placed[ready->id] = true;
    result.stems.push_back(*ready);
    waiting.erase(ready);
  }
  return result;
}

double heightOf(const Skeleton& skeleton) {
  double low = skeleton.nodes.front().position.at.y;
  double high = low;
  for (const Node& node : skeleton.nodes) {
    low = std::min(low, node.position.at.y);
    high = std::max(high, node.position.at.y);
  }
  return high - low;
}

}  // namespace axil::test
