#pragma once
/// \file
/// Random leafless plants of known shape and their masks in three photos: a trunk with branches, and branches on these, bent,
/// drooping or rising, tapered; seen by perspective cameras as phone photos of the rendered plants are.

#include "base/rng.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/draft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::test {

struct TreeBranch {
  int parent = -1;
  std::vector<glm::dvec3> points;
  std::vector<double> radius;
};

struct RandomTree {
  std::vector<TreeBranch> branches;
  std::vector<skeleton3d::View> views;
  std::map<std::string, skeleton3d::Mask> masks;
};

struct RandomTreeOptions {
  int laterals = 14;        ///< on the trunk
  int sublaterals = 0;      ///< on each of these, on average
  double spread = 0.35;     ///< length of a lateral, of the height
  double droop = 0;         ///< how much laterals bend down (below 0: up)
  double wobble = 0.25;     ///< rad, of a piece's direction
  double thickness = 0.012; ///< radius of the trunk's foot, of the height
};

namespace tree_detail {

inline glm::dvec3 anyPerpendicular(Rng& rng, glm::dvec3 to) {
  for (;;) {
    const double x = rng.normal(), y = rng.normal(), z = rng.normal();
    const glm::dvec3 v = glm::dvec3{x, y, z} - glm::dot(glm::dvec3{x, y, z}, to) * to;
    if (glm::length(v) > 0.2) return glm::normalize(v);
  }
}

inline TreeBranch grown(Rng& rng, int parent, glm::dvec3 from, glm::dvec3 along, double length, double foot, const RandomTreeOptions& options) {
  constexpr int kPieces = 12;
  TreeBranch branch{parent, {from}, {foot}};
  glm::dvec3 turn = anyPerpendicular(rng, along);
  for (int k = 1; k <= kPieces; ++k) {
    if (k % 4 == 0) turn = anyPerpendicular(rng, along);
    along = glm::normalize(along + options.wobble * 0.35 * turn + (parent < 0 ? 0.0 : -options.droop / kPieces) * glm::dvec3{0, 1, 0});
    branch.points.push_back(branch.points.back() + length / kPieces * along);
    branch.radius.push_back(foot * (1 - 0.75 * k / kPieces));
  }
  return branch;
}

/// A branch on `parent`, at a share of its length.
inline TreeBranch branchOn(Rng& rng, const std::vector<TreeBranch>& branches, int parent, double share, double azimuth, double length, const RandomTreeOptions& options) {
  const TreeBranch& on = branches[static_cast<std::size_t>(parent)];
  const double place = share * static_cast<double>(on.points.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), on.points.size() - 2);
  const double f = place - static_cast<double>(i);
  const glm::dvec3 along = glm::normalize(on.points[i + 1] - on.points[i]);
  const glm::dvec3 side = std::abs(along.y) > 0.8 ? glm::normalize(glm::cross(along, glm::dvec3{1, 0, 0})) : glm::normalize(glm::cross(along, glm::dvec3{0, 1, 0}));
  const glm::dvec3 out = std::cos(azimuth) * side + std::sin(azimuth) * glm::cross(along, side);
  const double angle = rng.uniform(0.7, 1.25), radius = on.radius[i] * (1 - f) + on.radius[i + 1] * f;
  return grown(rng, parent, glm::mix(on.points[i], on.points[i + 1], f), std::cos(angle) * along + std::sin(angle) * out, length, std::max(0.55 * radius, 0.0014), options);
}

inline void drawDisc(skeleton3d::Mask& mask, glm::dvec2 px, double radius) {
  for (int y = std::max(0, static_cast<int>(px.y - radius - 1)); y <= std::min(mask.height - 1, static_cast<int>(px.y + radius + 1)); ++y)
    for (int x = std::max(0, static_cast<int>(px.x - radius - 1)); x <= std::min(mask.width - 1, static_cast<int>(px.x + radius + 1)); ++x)
      if (std::hypot(x + 0.5 - px.x, y + 0.5 - px.y) <= radius) mask.plant[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x)] = 1;
}

inline void drawBranch(skeleton3d::Mask& mask, const skeleton3d::Camera& camera, const TreeBranch& branch) {
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i)
    for (int k = 0; k <= 60; ++k) {
      const double f = k / 60.0;
      const PlantPoint at{glm::mix(branch.points[i], branch.points[i + 1], f)};
      const double r = (branch.radius[i] * (1 - f) + branch.radius[i + 1] * f) * camera.focal_px->x / skeleton3d::toView(camera, at).at.z;
      drawDisc(mask, skeleton3d::project(camera, at).px, std::max(r, 0.8));
    }
}

}  // namespace tree_detail

/// About 1 high.
inline RandomTree randomTree(std::uint64_t seed, const RandomTreeOptions& options = {}) {
  using namespace tree_detail;
  Rng rng(seed);
  RandomTree tree;
  tree.branches.push_back(grown(rng, -1, {0, 0, 0}, {0, 1, 0}, 1, options.thickness, {.wobble = 0.3 * options.wobble}));
  double azimuth = rng.uniform(0, 6.28);
  for (int k = 0; k < options.laterals; ++k) {
    const double share = 0.15 + 0.8 * (k + rng.uniform(0.0, 0.7)) / options.laterals, length = options.spread * (1.1 - 0.6 * share) * rng.uniform(0.7, 1.2);
    azimuth += 2.4 + rng.uniform(-0.4, 0.4);
    tree.branches.push_back(branchOn(rng, tree.branches, 0, share, azimuth, length, options));
    const int parent = static_cast<int>(tree.branches.size()) - 1;
    const int subs = options.sublaterals == 0 ? 0 : static_cast<int>(rng.uniform(0.5, 1.5) * options.sublaterals + 0.5);
    for (int j = 0; j < subs; ++j) {
      const double where = 0.25 + 0.6 * (j + rng.uniform()) / subs, sub = 0.45 * length * (1.2 - where) * rng.uniform(0.7, 1.3), turn = rng.uniform(0, 6.28);
      tree.branches.push_back(branchOn(rng, tree.branches, parent, where, turn, sub, options));
    }
  }
  glm::dvec3 low(1e9), high(-1e9);
  for (const TreeBranch& b : tree.branches)
    for (const glm::dvec3& p : b.points) low = glm::min(low, p), high = glm::max(high, p);
  const double size = glm::length(high - low);
  for (const char* name : {"front", "right", "top"}) {
    skeleton3d::View view{name, *skeleton3d::nominalCamera(name, {.target = {0.5 * (low + high)}, .distance = 1.75 * size, .focal_px = 2222.2, .size_px = {1200, 1600}}), {1200, 1600}};
    skeleton3d::Mask mask{1200, 1600, std::vector<std::uint8_t>(std::size_t{1200} * 1600, 0)};
    for (const TreeBranch& b : tree.branches) drawBranch(mask, view.camera, b);
    tree.masks[name] = std::move(mask);
    tree.views.push_back(view);
  }
  return tree;
}

}  // namespace axil::test
