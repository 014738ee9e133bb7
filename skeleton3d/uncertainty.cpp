#include "skeleton3d/uncertainty.hpp"

#include "skeleton3d/placed_clicks.hpp"
#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/statistics.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

const NodeSpread* find(const Uncertainty& uncertainty, NodeId id) {
  const auto found = std::find_if(uncertainty.nodes.begin(), uncertainty.nodes.end(), [&](const NodeSpread& node) { return node.id == id; });
  return found == uncertainty.nodes.end() ? nullptr : &*found;
}

/// A number that depends on the places of some nodes, as how it moves with each.
struct Slope {
  const NodeSpread* node;
  glm::dvec3 by;
};

double sigmaAlong(const Uncertainty& uncertainty, const std::vector<Slope>& slopes) {
  double variance = 0;
  const std::size_t columns = slopes.front().node->shared.size();
  std::vector<double> shared(columns, 0.0);
  for (const Slope& a : slopes) {
    for (const Slope& b : slopes)
      if (a.node == b.node) variance += glm::dot(a.by, a.node->own * b.by);
    for (std::size_t c = 0; c < columns; ++c) shared[c] += glm::dot(a.by, a.node->shared[c]);
  }
  for (std::size_t r = 0; r < columns; ++r)
    for (std::size_t c = 0; c < columns; ++c) variance += shared[r] * uncertainty.middle[r * columns + c] * shared[c];
  return std::sqrt(std::max(variance, 0.0));
}

std::vector<NodeSpread> spreadsOf(std::span<const View> views, std::span<const ClickedNode> clicked, const std::vector<std::optional<Node>>& nodes, double click_px) {
  std::vector<NodeSpread> spreads;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i]) spreads.push_back({nodes[i]->id, nodes[i]->position, detail::covarianceOfPlace(views, clicked[i], nodes[i]->position, click_px), {}});
  std::stable_sort(spreads.begin(), spreads.end(), [](const NodeSpread& a, const NodeSpread& b) { return a.id < b.id; });
  return spreads;
}

bool isByHand(const ClickedNode& clicked, const Node& node) {
  return std::all_of(node.reprojection_px.begin(), node.reprojection_px.end(), [&](const auto& off) { return detail::isByHand(clicked, off.first); });
}

detail::Scatter scatterOf(std::span<const ClickedNode> clicked, const std::vector<std::optional<Node>>& nodes) {
  double squares = 0;
  int freedom = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i] || !isByHand(clicked[i], *nodes[i])) continue;
    freedom += 2 * static_cast<int>(nodes[i]->reprojection_px.size()) - 3;
    for (const auto& [view, off_px] : nodes[i]->reprojection_px) squares += off_px * off_px;
  }
  return detail::scatterFrom(squares, freedom);
}

}  // namespace

Result<Uncertainty> uncertaintyOf(std::span<const View> views, std::span<const ClickedNode> nodes, std::optional<double> click_px) {
  const auto solved = detail::solveAll(views, nodes, {.click_px = click_px.value_or(1)}, "plant units");
  if (!solved) return solved.failure();
  Uncertainty uncertainty;
  const detail::Scatter scatter = scatterOf(nodes, solved->nodes);
  uncertainty.click_px = click_px.value_or(scatter.click_px);
  uncertainty.clickWasFound = !click_px;
  uncertainty.freedom = scatter.freedom;
  uncertainty.nodes = spreadsOf(views, nodes, solved->nodes, uncertainty.click_px);
  return uncertainty;
}

std::optional<glm::dmat3> covariance(const Uncertainty& uncertainty, NodeId a, NodeId b) {
  const NodeSpread *one = find(uncertainty, a), *other = find(uncertainty, b);
  if (one == nullptr || other == nullptr) return std::nullopt;
  glm::dmat3 sum = one == other ? one->own : glm::dmat3(0.0);
  const std::size_t columns = one->shared.size();
  for (std::size_t r = 0; r < columns; ++r) {
    glm::dvec3 row{0, 0, 0};  // of M U^T
    for (std::size_t c = 0; c < columns; ++c) row += uncertainty.middle[r * columns + c] * other->shared[c];
    sum += glm::outerProduct(one->shared[r], row);
  }
  return sum;
}

std::optional<glm::dvec3> sigmaOf(const Uncertainty& uncertainty, NodeId node) {
  const auto own = covariance(uncertainty, node, node);
  if (!own) return std::nullopt;
  const auto root = [](double variance) { return std::sqrt(std::max(variance, 0.0)); };
  return glm::dvec3{root((*own)[0][0]), root((*own)[1][1]), root((*own)[2][2])};
}

std::optional<WithSigma> lengthBetween(const Uncertainty& uncertainty, NodeId a, NodeId b) {
  const NodeSpread *from = find(uncertainty, a), *to = find(uncertainty, b);
  if (from == nullptr || to == nullptr) return std::nullopt;
  const glm::dvec3 along = to->at.at - from->at.at;
  const double length = glm::length(along);
  if (!(length > 0)) return std::nullopt;
  return WithSigma{length, sigmaAlong(uncertainty, {{to, along / length}, {from, -along / length}})};
}

std::optional<WithSigma> angleBetweenSegments(const Uncertainty& uncertainty, NodeId a, NodeId b, NodeId c, NodeId d) {
  const NodeSpread* ends[4] = {find(uncertainty, a), find(uncertainty, b), find(uncertainty, c), find(uncertainty, d)};
  if (std::any_of(std::begin(ends), std::end(ends), [](const NodeSpread* end) { return end == nullptr; })) return std::nullopt;
  const glm::dvec3 p = ends[1]->at.at - ends[0]->at.at, q = ends[3]->at.at - ends[2]->at.at;
  const double lengthP = glm::length(p), lengthQ = glm::length(q);
  if (!(lengthP > 0) || !(lengthQ > 0)) return std::nullopt;
  const glm::dvec3 u = p / lengthP, v = q / lengthQ;
  const double cosine = glm::dot(u, v), sine = glm::length(glm::cross(u, v));
  WithSigma angle{std::atan2(sine, cosine), 0};
  // Near 0 and pi the angle is the length of a small sideways vector: the larger of its two components' scatter bounds it.
  const glm::dvec3 across = sine > 1e-9 ? glm::normalize(glm::cross(u, v)) : PlantDirection::along(std::abs(u.x) < 0.9 ? glm::cross(u, {1, 0, 0}) : glm::cross(u, {0, 1, 0})).unit();
  const glm::dvec3 byP = glm::cross(u, across) / lengthP, byQ = -glm::cross(v, across) / lengthQ;
  angle.sigma = sigmaAlong(uncertainty, {{ends[1], byP}, {ends[0], -byP}, {ends[3], byQ}, {ends[2], -byQ}});
  return angle;
}

Skeleton withUncertainty(Skeleton skeleton, const Uncertainty& uncertainty) {
  for (Node& node : skeleton.nodes)
    if (const auto sigma = sigmaOf(uncertainty, node.id)) node.sigma = *sigma;
  return skeleton;
}

}  // namespace axil::skeleton3d
