#include "render/plant_skeleton.hpp"

#include "base/text.hpp"
#include "render/axes.hpp"
#include "render/organ_models.hpp"

#include <glm/geometric.hpp>

namespace axil::render {
namespace {

using simeco::Organ;
using simeco::OrganId;
using simeco::OrganKind;
using simeco::Plant;
using skeleton3d::Node;
using skeleton3d::NodeId;
using skeleton3d::Skeleton;
using skeleton3d::Stem;
using skeleton3d::StemId;

StemId stemIdOf(AxisId axis) { return StemId(axis.value + 1); }

class SkeletonMaker {
 public:
  SkeletonMaker(const Plant& plant, const PlantAxes& axes) : plant_(plant), axes_(axes) {}

  /// False when `axis` neither starts at the root nor on another stem.
  [[nodiscard]] bool addStem(AxisId id) {
    const Axis& axis = axes_.axes[static_cast<std::size_t>(id.value)];
    const std::optional<NodeId> start = startOf(axis);
    if (!start) return false;
    Stem stem{.id = stemIdOf(id), .parent = std::nullopt, .nodes = {*start}};
    if (axis.insertion) stem.parent = stemIdOf(axis.insertion->axis);
    else if (!skeleton_.stems.empty()) stem.parent = skeleton_.stems.front().id;
    std::vector<NodeId>& tips = nodesOfSites_.emplace_back(1, *start);
    for (const OrganId at : axis.organs) {
      const Organ& organ = plant_.at(at);
      for (std::size_t i = 1; i + 1 < organ.trail.size(); ++i) stem.nodes.push_back(addNode(organ.trail[i], organ.radius));
      stem.nodes.push_back(addNode(organ.tip(), organ.radius));
      tips.push_back(stem.nodes.back());
    }
    skeleton_.stems.push_back(std::move(stem));
    return true;
  }

  void addLeaf(const Organ& organ) {
    // A leaf without a stem below it belongs to the first one.
    Site site{.axis = AxisId(0), .node = 0};
    if (organ.parent) site = axes_.siteOfTip[static_cast<std::size_t>(organ.parent->value)].value_or(site);
    const LeafSize size = sizeOf(organ);
    skeleton_.leaves.push_back({.stem = stemIdOf(site.axis), .position = organ.base,
                                .direction = organ.direction, .normal = organ.adaxial, .length = organ.length, .width = size.width,
                                .shape = size.shape});
  }

  [[nodiscard]] Skeleton take() { return std::move(skeleton_); }

 private:
  struct LeafSize {
    double width = 0;
    std::string shape;
  };

  [[nodiscard]] LeafSize sizeOf(const Organ& organ) const {
    const ShapeSize shape = leafShapeSize(plant_.styleOf(organ).model);
    return {organ.radius > 0 ? 2 * organ.radius : shape.widthToLength * organ.length, shape.name};
  }

  NodeId addNode(PlantPoint at, std::optional<double> radius) {
    if (radius && *radius <= 0) radius.reset();
    const NodeId id(static_cast<std::int32_t>(skeleton_.nodes.size()) + 1);
    skeleton_.nodes.push_back({.id = id, .position = at, .radius = radius, .sigma = {0, 0, 0}, .reprojection_px = {}});
    return id;
  }

  /// The node a stem begins with: its parent's, or the root, which the first stem makes.
  [[nodiscard]] std::optional<NodeId> startOf(const Axis& axis) {
    if (axis.insertion)
      return nodesOfSites_[static_cast<std::size_t>(axis.insertion->axis.value)][static_cast<std::size_t>(axis.insertion->node)];
    const Organ& first = plant_.at(axis.organs.front());
    if (skeleton_.stems.empty()) return skeleton_.root = addNode(first.base, first.radius);
    const glm::dvec3 root = skeleton_.nodes.front().position.at;
    if (glm::distance(root, first.base.at) > 100 * axes_.negligible) return std::nullopt;
    return skeleton_.root;
  }

  const Plant& plant_;
  const PlantAxes& axes_;
  Skeleton skeleton_;
  std::vector<std::vector<NodeId>> nodesOfSites_;  ///< of each axis, node by node; the corners of bent organs stand between them
};

}  // namespace

Result<Skeleton> skeletonOf(const Plant& plant) {
  const PlantAxes axes = axesOf(plant, Continuation::Brackets);
  if (axes.axes.empty())
    return fail(ErrorCode::NoAnswer, "the plant has no stem of any length at time " + shortest(plant.time) + "; grow it longer");
  SkeletonMaker maker(plant, axes);
  for (std::size_t i = 0; i < axes.axes.size(); ++i)
    if (!maker.addStem(AxisId(static_cast<std::int32_t>(i))))
      return fail(ErrorCode::NoAnswer, "a skeleton has one root, but stem " + std::to_string(i + 1) +
                                           " starts away from it; write one plant of the ecosystem at a time");
  for (const Organ& organ : plant.organs)
    if (organ.kind == OrganKind::Leaf && organ.length > axes.negligible) maker.addLeaf(organ);
  return maker.take();
}

}  // namespace axil::render
