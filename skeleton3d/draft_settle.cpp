#include "skeleton3d/draft_settle.hpp"

#include "skeleton3d/camera.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

constexpr int kRounds = 25;
constexpr double kStiff = 0.5;     // how much a point clings to its neighbours' middle, against one view's line
constexpr double kUsual = 0.7;       // cubes off a line, beyond which it counts less and less,
constexpr double kFurthest = 5;    // and beyond which it is another's

struct Pull {
  glm::dmat3 normal{0.0};
  glm::dvec3 right{0.0};
};

/// What one view's nearest middle line asks of a point: nothing along the line.
void addPull(const SeenMask& mask, const glm::dvec3& at, double cubeSide, Pull& pull) {
  const Camera& camera = mask.view->camera;
  if (!isInFront(camera, {at})) return;
  const glm::dvec2 px = project(camera, {at}).px;
  if (!(px.x >= 0 && px.y >= 0 && px.x < mask.lines.width && px.y < mask.lines.height)) return;
  const std::size_t pixel = static_cast<std::size_t>(px.y) * static_cast<std::size_t>(mask.lines.width) + static_cast<std::size_t>(px.x);
  const glm::dvec2 off = glm::dvec2(mask.lines.line[static_cast<std::size_t>(mask.lines.nearest[pixel])]) + 0.5 - px;
  const double length = glm::length(off);
  const double h = 0.01 * cubeSide;
  glm::dmat3x2 slopes(0.0);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 move(0.0);
    move[i] = h;
    slopes[i] = (project(camera, {at + move}).px - project(camera, {at - move}).px) / (2 * h);
  }
  const double cube_px = cubeSide * std::max({glm::length(slopes[0]), glm::length(slopes[1]), glm::length(slopes[2])});
  if (length < 1e-3 || length > kFurthest * cube_px) return;
  const double share = length / (kUsual * cube_px), weight = 1 / (cube_px * cube_px * (1 + share * share));
  const glm::dvec3 row = glm::transpose(slopes) * (off / length);
  pull.normal += weight * glm::outerProduct(row, row);
  pull.right += weight * length * row;
}

glm::dvec3 movedBy(const Pull& pull, const glm::dvec3& wanted, double stiff) {
  return glm::inverse(pull.normal + glm::dmat3(stiff)) * (pull.right + stiff * wanted);
}

}  // namespace

std::vector<glm::dvec3> settledOnLines(std::span<const SeenMask> masks, std::vector<glm::dvec3> points, double cubeSide) {
  const double stiff = kStiff / (cubeSide * cubeSide);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<glm::dvec3> next = points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      Pull pull;
      for (const SeenMask& mask : masks) addPull(mask, points[i], cubeSide, pull);
      const glm::dvec3 wanted = i + 1 < points.size() ? 0.5 * (points[i - 1] + points[i + 1]) - points[i] : glm::dvec3(0.0);
      next[i] += movedBy(pull, wanted, stiff);
    }
    points = std::move(next);
  }
  return points;
}

}  // namespace axil::skeleton3d::detail
