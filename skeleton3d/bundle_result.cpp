#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/statistics.hpp"

#include <ceres/rotation.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kFlatFocalInverse = 1e-3;  // of the first guess: beyond a thousand times its distance a camera counts as orthographic

/// How many numbers the clicks give beyond those that are fitted to them; the turn and size of the whole are not.
int freedomOf(const Bundle& bundle) {
  int freedom = 0, origins = 0;
  for (const BundlePoint& point : bundle.points) freedom += 2 * static_cast<int>(point.clicks.size()) - 3 + (point.atOriginsDepth ? 1 : 0);
  for (const BundleCamera& camera : bundle.cameras) {
    if (camera.known) continue;
    constexpr double kLoose = 0.1;  // a focal length trusted less than this is found from the clicks
    freedom -= camera.focalShare > kLoose ? 7 : 6;
    if (camera.hints.origin_px) origins += 2;
  }
  return freedom + (bundle.scaleIsKnown ? origins : std::max(origins, 3) + 4);
}

}  // namespace

Camera cameraOf(const BundleCamera& unknown) {
  if (unknown.known) return unknown.view.camera;
  const auto& v = unknown.values;
  Camera camera = unknown.view.camera;
  const double scale = std::exp(v[kLogScale]);
  double columns[9];
  ceres::AngleAxisToRotationMatrix(v.data(), columns);  // column by column, as GLM
  glm::dmat3 turn;
  for (int c = 0; c < 3; ++c) turn[c] = {columns[3 * c], columns[3 * c + 1], columns[3 * c + 2]};
  camera.rotation = turn * unknown.nominal;
  camera.translation = {v[kOriginX] / scale, v[kOriginY] / scale, 0};
  if (v[kFocalInverse] < kFlatFocalInverse) {
    camera.model = CameraModel::Orthographic;
    camera.focal_px.reset();
    camera.distortion = {0, 0, 0, 0, 0};
    camera.scale_px_per_unit = scale;
    return camera;
  }
  const double focal_px = unknown.focal_px / v[kFocalInverse];
  camera.model = CameraModel::Perspective;
  camera.focal_px = glm::dvec2{focal_px, unknown.aspect * focal_px};
  camera.distortion[0] += v[kBend];
  camera.translation.z = focal_px / scale;
  return camera;
}

std::vector<View> viewsOf(const Bundle& bundle) {
  std::vector<View> views;
  for (const BundleCamera& camera : bundle.cameras) views.push_back({camera.view.name, cameraOf(camera), camera.view.size_px});
  return views;
}

std::vector<Miss> missesOf(const Bundle& bundle) {
  const std::vector<View> views = viewsOf(bundle);
  std::vector<Miss> misses;
  for (std::size_t p = 0; p < bundle.points.size(); ++p)
    for (const BundleClick& click : bundle.points[p].clicks) {
      const auto& at = bundle.points[p].at;
      misses.push_back({p, click.view, click.px - project(views[click.view].camera, {{at[0], at[1], at[2]}}).px});
    }
  return misses;
}

double typicalMiss(const std::vector<Miss>& misses) {
  std::vector<double> off;
  for (const Miss& miss : misses) off.push_back(glm::length(miss.off_px));
  return medianOf(std::move(off));
}

Scatter scatterOf(const Bundle& bundle) {
  double squares = 0;
  for (const Miss& miss : missesOf(bundle)) squares += glm::dot(miss.off_px, miss.off_px);
  const std::vector<View> views = viewsOf(bundle);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto& origin = bundle.cameras[v].hints.origin_px;
    if (bundle.cameras[v].known || !origin) continue;
    const glm::dvec2 off = origin->px - project(views[v].camera, {}).px;
    squares += glm::dot(off, off);
  }
  return scatterFrom(squares, freedomOf(bundle));
}

Scatter robustScatterOf(std::span<const View> views, std::span<const ClickedNode> nodes) {
  std::vector<double> variances;
  int freedom = 0;
  const auto solved = solveAll(views, nodes, {}, "plant units");
  if (!solved) return scatterFrom(0, 0);
  for (const auto& node : solved->nodes) {
    if (!node) continue;
    const int own = 2 * static_cast<int>(node->reprojection_px.size()) - 3;
    double squares = 0;
    for (const auto& [view, off_px] : node->reprojection_px) squares += off_px * off_px;
    variances.push_back(squares / chiSquaredMedian(own));
    freedom += own;
  }
  return scatterFrom(medianOf(std::move(variances)) * freedom, freedom);
}

Scatter robustScatterOf(const Bundle& bundle) {
  std::vector<double> squares(bundle.points.size(), 0.0);
  for (const Miss& miss : missesOf(bundle)) squares[miss.point] += glm::dot(miss.off_px, miss.off_px);
  std::vector<double> variances;
  double own = 0;
  for (std::size_t p = 0; p < bundle.nodes; ++p) {
    const int freedom = 2 * static_cast<int>(bundle.points[p].clicks.size()) - 3;
    variances.push_back(squares[p] / chiSquaredMedian(freedom));
    own += freedom;
  }
  const int freedom = freedomOf(bundle);
  const double share = std::clamp(freedom / std::max(own, 1.0), 0.1, 1.0);  // what fitting the cameras has taken up
  return scatterFrom(medianOf(std::move(variances)) / share * std::max(freedom, 0), freedom);
}

}  // namespace axil::skeleton3d::detail
