#include "quantify/skeleton_index.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace axil::quantify {

namespace {

using skeleton3d::Leaf;
using skeleton3d::Node;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::Stem;
using skeleton3d::StemId;

// Two nodes nearer than this share of the plant's size are one place: what lies between them is rounding, not a direction.
constexpr double kSamePlace = 1e-9;

using Lines = std::vector<std::string>;

std::string nodeName(NodeId id) { return "node " + std::to_string(id.value); }
std::string stemName(StemId id) { return "stem " + std::to_string(id.value); }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<void> none(ErrorCode code, std::string message, Lines details) {
  if (details.empty()) return {};
  if (details.size() == 1) message = details.front();
  return fail(Error{code, std::move(message), std::move(details)});
}

Lines wrongNumbers(const Skeleton& skeleton) {
  Lines wrong;
  for (const Node& node : skeleton.nodes) {
    if (!finite(node.position.at)) wrong.push_back(nodeName(node.id) + ": its position is not a number");
    if (node.radius && !(*node.radius > 0 && std::isfinite(*node.radius)))
      wrong.push_back(nodeName(node.id) + ": its radius is " + shortest(*node.radius) + "; give a number above 0 or none");
  }
  for (std::size_t l = 0; l < skeleton.leaves.size(); ++l) {
    const Leaf& leaf = skeleton.leaves[l];
    const std::string name = "leaf " + std::to_string(l + 1);
    if (!finite(leaf.position.at)) wrong.push_back(name + ": its position is not a number");
    if (!(leaf.length > 0 && std::isfinite(leaf.length))) wrong.push_back(name + ": its length is " + shortest(leaf.length) + "; give a number above 0");
    if (!(leaf.width >= 0 && std::isfinite(leaf.width))) wrong.push_back(name + ": its width is " + shortest(leaf.width) + "; give a number from 0");
    if (std::abs(glm::dot(leaf.direction.unit(), leaf.normal.unit())) > 1e-6) wrong.push_back(name + ": its normal is not perpendicular to its direction");
  }
  return wrong;
}

double extentOf(const Skeleton& skeleton) {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  for (const Node& node : skeleton.nodes) {
    low = glm::dvec3{std::min(low.x, node.position.at.x), std::min(low.y, node.position.at.y), std::min(low.z, node.position.at.z)};
    high = glm::dvec3{std::max(high.x, node.position.at.x), std::max(high.y, node.position.at.y), std::max(high.z, node.position.at.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

Lines coincidingNodes(const Skeleton& skeleton, const SkeletonIndex& index) {
  Lines wrong;
  for (const Stem& stem : skeleton.stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const double length = glm::distance(index.node(stem.nodes[i - 1]).position.at, index.node(stem.nodes[i]).position.at);
      if (length > kSamePlace * index.extent()) continue;
      wrong.push_back(stemName(stem.id) + ": nodes " + std::to_string(stem.nodes[i - 1].value) + " and " + std::to_string(stem.nodes[i].value) +
                      " stand in one place; remove one of them");
    }
  return wrong;
}

/// A tree enters every node once and never comes back to its root.
Lines nodesEnteredTwice(const Skeleton& skeleton, const SkeletonIndex& index) {
  Lines wrong;
  std::vector<const Stem*> entered(index.nodeCount(), nullptr);
  for (const Stem& stem : skeleton.stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const NodeId id = stem.nodes[i];
      const Stem*& by = entered[index.place(id)];
      if (id == skeleton.root)
        wrong.push_back(stemName(stem.id) + " comes back to the root, " + nodeName(id) + ": the plant is not a tree");
      else if (by != nullptr)
        wrong.push_back(nodeName(id) + " is reached by " + stemName(by->id) + " and by " + stemName(stem.id) + ": the plant is not a tree");
      by = &stem;
    }
  return wrong;
}

}  // namespace

const Stem* SkeletonIndex::stem(StemId id) const {
  const auto found = stems_.find(id);
  return found == stems_.end() ? nullptr : &skeleton_->stems[found->second];
}

Result<SkeletonIndex> SkeletonIndex::of(const Skeleton& skeleton) {
  if (skeleton.nodes.empty() || skeleton.stems.empty()) return fail(ErrorCode::NoAnswer, "the skeleton has no stem; click at least the base and the tip of one");
  SkeletonIndex index(skeleton);
  Lines ids;
  for (std::size_t n = 0; n < skeleton.nodes.size(); ++n)
    if (!index.nodes_.emplace(skeleton.nodes[n].id, n).second) ids.push_back(nodeName(skeleton.nodes[n].id) + " is there twice; give each node its own id");
  for (std::size_t s = 0; s < skeleton.stems.size(); ++s)
    if (!index.stems_.emplace(skeleton.stems[s].id, s).second) ids.push_back(stemName(skeleton.stems[s].id) + " is there twice; give each stem its own id");

  if (!index.nodes_.contains(skeleton.root)) ids.push_back("the root, " + nodeName(skeleton.root) + ", is not among the nodes");
  std::vector<std::size_t> first;
  for (std::size_t s = 0; s < skeleton.stems.size(); ++s) {
    const Stem& stem = skeleton.stems[s];
    if (stem.nodes.size() < 2) ids.push_back(stemName(stem.id) + " has " + std::to_string(stem.nodes.size()) + " node; a stem needs at least two");
    for (const NodeId id : stem.nodes)
      if (!index.nodes_.contains(id)) ids.push_back(stemName(stem.id) + " names " + nodeName(id) + ", which does not exist");
    if (stem.parent && !index.stems_.contains(*stem.parent)) ids.push_back(stemName(stem.id) + " has parent " + stemName(*stem.parent) + ", which does not exist");
    if (!stem.parent) first.push_back(s);
  }
  for (std::size_t l = 0; l < skeleton.leaves.size(); ++l)
    if (index.stem(skeleton.leaves[l].stem) == nullptr)
      ids.push_back("leaf " + std::to_string(l + 1) + " stands on " + stemName(skeleton.leaves[l].stem) + ", which does not exist");
  if (first.size() != 1) ids.push_back("the skeleton has " + std::to_string(first.size()) + " stems without a parent; it needs exactly one, which begins at the root");
  if (const auto ok = none(ErrorCode::BadInput, "the skeleton's ids do not fit together", std::move(ids)); !ok) return ok.failure();

  index.firstStem_ = first.front();
  const Stem& trunk = skeleton.stems[index.firstStem_];
  if (trunk.nodes.front() != skeleton.root)
    return fail(ErrorCode::BadInput, stemName(trunk.id) + " has no parent, so it must begin with the root, " + nodeName(skeleton.root) + ", not with " + nodeName(trunk.nodes.front()));
  if (const auto ok = none(ErrorCode::BadInput, "the skeleton holds values that cannot be measured", wrongNumbers(skeleton)); !ok) return ok.failure();
  index.extent_ = extentOf(skeleton);
  if (const auto ok = none(ErrorCode::BadInput, "the skeleton is not a tree", nodesEnteredTwice(skeleton, index)); !ok) return ok.failure();
  if (const auto ok = none(ErrorCode::NoAnswer, "some segments have no length", coincidingNodes(skeleton, index)); !ok) return ok.failure();
  return index;
}

}  // namespace axil::quantify
