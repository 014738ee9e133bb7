#include "skeleton3d/draft_cubes.hpp"

#include "skeleton3d/camera.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

double pixelsPerUnit(const Camera& camera, PlantPoint at) {
  return camera.model == CameraModel::Orthographic ? camera.scale_px_per_unit : camera.focal_px->x / std::max(toView(camera, at).at.z, 1e-9);
}

/// Where `at` is in the rows of the mask, or -1 outside the photo.
std::ptrdiff_t placeIn(const MaskLines& lines, glm::dvec2 px) {
  const int x = static_cast<int>(std::floor(px.x)), y = static_cast<int>(std::floor(px.y));
  if (x < 0 || y < 0 || x >= lines.width || y >= lines.height) return -1;
  return static_cast<std::ptrdiff_t>(y) * lines.width + x;
}

/// Whether a ball may hold something of the plant: in no view its picture is clear of the mask.
bool mayHold(std::span<const SeenMask> masks, PlantPoint at, double radius) {
  for (const SeenMask& mask : masks) {
    if (!isInFront(mask.view->camera, at)) return false;
    const glm::dvec2 px = project(mask.view->camera, at).px;
    const double reach = radius * pixelsPerUnit(mask.view->camera, at);
    const glm::dvec2 inside = glm::clamp(px, glm::dvec2(0.0), glm::dvec2(mask.lines.width - 0.01, mask.lines.height - 0.01));
    if (mask.lines.toPlant[static_cast<std::size_t>(placeIn(mask.lines, inside))] + glm::length(px - inside) > reach) return false;
  }
  return true;
}

/// Half the side of a cube about the origin that holds whatever the masks show near it.
double reachOf(std::span<const SeenMask> masks) {
  double reach = 0;
  for (const SeenMask& mask : masks) {
    const glm::dvec2 origin = project(mask.view->camera, {{0, 0, 0}}).px;
    double far = 0;
    for (const glm::ivec2 p : mask.lines.line) far = std::max(far, glm::length(glm::dvec2(p) - origin));
    reach = std::max(reach, far / pixelsPerUnit(mask.view->camera, {{0, 0, 0}}));
  }
  return 1.3 * reach;
}

void split(std::span<const SeenMask> masks, const Cubes& cubes, glm::ivec3 corner, int size, std::vector<glm::ivec3>& found) {
  if (found.size() > kMostCubes) return;
  const PlantPoint middle{cubes.origin + cubes.side * (glm::dvec3(corner) + 0.5 * size)};
  // The smallest cubes count where their inner ball touches the mask; larger ones where any corner could.
  if (!mayHold(masks, middle, size == 1 ? 0.6 * cubes.side : 0.9 * size * cubes.side)) return;
  if (size == 1) {
    found.push_back(corner);
    return;
  }
  const int half = size / 2;
  for (int k = 0; k < 8; ++k) split(masks, cubes, corner + half * glm::ivec3(k & 1, k >> 1 & 1, k >> 2 & 1), half, found);
}

Cubes carvedWith(std::span<const SeenMask> masks, double reach, int cubesAcross) {
  Cubes cubes;
  int size = 1;
  while (size < 2.6 * cubesAcross) size *= 2;
  cubes.side = reach / 1.3 / cubesAcross;
  cubes.origin = glm::dvec3(-0.5 * size * cubes.side);
  split(masks, cubes, {0, 0, 0}, size, cubes.at);
  return cubes;
}

}  // namespace

Result<Cubes> carvedCubes(std::span<const SeenMask> masks, int cubesAcross, const Watch& watch) {
  constexpr int kFewest = 24;
  const double reach = reachOf(masks);
  if (!(reach > 0) || !std::isfinite(reach)) return fail(ErrorCode::NoAnswer, "the masks are empty; give masks in which the plant is not 0");
  Cubes cubes;
  for (int across = cubesAcross;; across = across * 3 / 4) {
    if (watch.cancelled()) return fail(ErrorCode::Cancelled, "drafting the stems was stopped");
    cubes = carvedWith(masks, reach, across);
    if (cubes.at.size() <= kMostCubes) break;
    if (across < kFewest) return fail(ErrorCode::LimitReached, "the masks leave too much space to find stems in; give masks of more views or of stems without leaves");
  }
  if (cubes.at.empty()) return fail(ErrorCode::NoAnswer, "no place of space is inside all masks; check that masks, views and cameras belong together");
  std::sort(cubes.at.begin(), cubes.at.end(), [](glm::ivec3 a, glm::ivec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; });
  for (std::size_t i = 0; i < cubes.at.size(); ++i) {
    std::vector<CubeInView> seen;
    for (const SeenMask& mask : masks) {
      const auto place = placeIn(mask.lines, project(mask.view->camera, cubes.centre(i)).px);
      const double side = cubes.side * pixelsPerUnit(mask.view->camera, cubes.centre(i));
      if (place < 0) seen.push_back({-1, 1e6F, static_cast<float>(side)});
      else seen.push_back({mask.lines.nearest[static_cast<std::size_t>(place)], mask.lines.toLine[static_cast<std::size_t>(place)], static_cast<float>(side)});
    }
    cubes.seen.push_back(std::move(seen));
  }
  return cubes;
}

}  // namespace axil::skeleton3d::detail
