#include "quantify/stalks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace axil::quantify {

namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::Stem;
using skeleton3d::StemId;

constexpr double kStraight = 1e-4;   // of the stalk's length and as an angle: stalk and blade are one line, as files round it

/// The leaves of each stem.
std::map<StemId, std::vector<std::size_t>> leavesOf(const Skeleton& skeleton) {
  std::map<StemId, std::vector<std::size_t>> leaves;
  for (std::size_t l = 0; l < skeleton.leaves.size(); ++l) leaves[skeleton.leaves[l].stem].push_back(l);
  return leaves;
}

/// The first node of every stem: what bears something.
std::multiset<NodeId> bearersOf(const Skeleton& skeleton) {
  std::multiset<NodeId> bearers;
  for (const Stem& stem : skeleton.stems)
    if (!stem.nodes.empty()) bearers.insert(stem.nodes.front());
  return bearers;
}

/// Whether the leaf goes straight on from the tip of the segment.
bool goesStraightOn(const glm::dvec3& from, const glm::dvec3& to, const skeleton3d::Leaf& leaf) {
  const double length = glm::distance(from, to);
  if (!(length > 0)) return false;
  return glm::distance(leaf.position.at, to) <= kStraight * length && glm::distance(leaf.direction.unit(), (to - from) / length) <= kStraight;
}

constexpr double kLikeSisters = 0.2;

}  // namespace

Skeleton withoutStalks(Skeleton skeleton) {
  std::map<NodeId, glm::dvec3> at;
  for (const skeleton3d::Node& node : skeleton.nodes) at[node.id] = node.position.at;
  const auto leaves = leavesOf(skeleton);
  const auto bearers = bearersOf(skeleton);
  std::set<StemId> stalks;
  std::set<NodeId> tips;
  std::map<NodeId, double> lengths;   // of the stalks at a node
  for (const Stem& stem : skeleton.stems) {
    const auto own = leaves.find(stem.id);
    if (stem.nodes.size() != 2 || !stem.parent || own == leaves.end() || own->second.size() != 1 || bearers.contains(stem.nodes.back())) continue;
    if (!at.contains(stem.nodes.front()) || !at.contains(stem.nodes.back())) continue;
    skeleton3d::Leaf& leaf = skeleton.leaves[own->second.front()];
    if (!goesStraightOn(at.at(stem.nodes.front()), at.at(stem.nodes.back()), leaf)) continue;
    stalks.insert(stem.id);
    lengths[stem.nodes.front()] = glm::distance(at.at(stem.nodes.front()), at.at(stem.nodes.back()));
    tips.insert(stem.nodes.back());
    leaf.stem = *stem.parent;
    leaf.position = {at.at(stem.nodes.back())};
    leaf.direction = PlantDirection::along(at.at(stem.nodes.back()) - at.at(stem.nodes.front()));
  }
  // The thesis lets one child of every node go on without brackets, so where a stem ends in leaves it goes on as the stalk of one of them, like its sisters.
  for (Stem& stem : skeleton.stems) {
    if (stalks.contains(stem.id) || stem.nodes.size() < 3 || !leaves.contains(stem.id)) continue;
    const NodeId tip = stem.nodes.back(), node = stem.nodes[stem.nodes.size() - 2];
    const auto sister = lengths.find(node);
    if (bearers.contains(tip) || sister == lengths.end() || !at.contains(tip) || std::abs(glm::distance(at.at(node), at.at(tip)) - sister->second) > kLikeSisters * sister->second) continue;
    std::vector<std::size_t> here;
    for (const std::size_t l : leaves.at(stem.id))
      if (skeleton.leaves[l].stem == stem.id && glm::distance(skeleton.leaves[l].position.at, at.at(tip)) <= kStraight * sister->second) here.push_back(l);
    if (here.size() != 1 || !goesStraightOn(at.at(node), at.at(tip), skeleton.leaves[here.front()])) continue;
    skeleton.leaves[here.front()].position = {at.at(tip)};
    skeleton.leaves[here.front()].direction = PlantDirection::along(at.at(tip) - at.at(node));
    stem.nodes.pop_back();
    tips.insert(tip);
  }
  std::erase_if(skeleton.stems, [&](const Stem& stem) { return stalks.contains(stem.id); });
  std::erase_if(skeleton.nodes, [&](const skeleton3d::Node& node) { return tips.contains(node.id); });
  return skeleton;
}

}  // namespace axil::quantify
