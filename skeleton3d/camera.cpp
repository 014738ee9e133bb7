#include "skeleton3d/camera.hpp"

#include "base/text.hpp"
#include "skeleton3d/projection.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace axil::skeleton3d {
namespace {

struct NamedDirection {
  std::string_view view;
  glm::dvec3 forward;
  glm::dvec3 imageUp;
};
constexpr NamedDirection kNominal[] = {
    {"front", {0, 0, -1}, {0, 1, 0}}, {"right", {-1, 0, 0}, {0, 1, 0}}, {"top", {0, -1, 0}, {0, 0, -1}},
    {"back", {0, 0, 1}, {0, 1, 0}},   {"left", {1, 0, 0}, {0, 1, 0}},
};

constexpr double kRotationTolerance = 1e-3;  // rotations are written by hand with four digits

bool isFinite(const glm::dvec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isFinite(const glm::dmat3& m) { return isFinite(m[0]) && isFinite(m[1]) && isFinite(m[2]); }

bool hasDistortion(const Camera& camera) {
  return std::any_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k != 0; });
}

glm::dvec2 focalOf(const Camera& camera) {
  AXIL_ASSERT(camera.model == CameraModel::Perspective && camera.focal_px, "a camera that cannot project was asked to");
  return *camera.focal_px;
}

struct Undistortion {
  glm::dvec2 point;
  bool converged = false;
};

/// The point whose distorted place is `target`, by Newton's method with steps halved until they help.
Undistortion undoDistortion(const std::array<double, 5>& coefficients, glm::dvec2 target) {
  const auto missing = [&](glm::dvec2 p) {
    const auto d = detail::distort(coefficients, p.x, p.y);
    return glm::dvec2{d[0], d[1]} - target;
  };
  glm::dvec2 p = target;
  glm::dvec2 miss = missing(p);
  for (int step = 0; step < 60 && glm::length(miss) > 1e-14; ++step) {
    const auto j = detail::distortJacobian(coefficients, p.x, p.y);
    const double det = j[0] * j[3] - j[1] * j[2];
    if (!(std::abs(det) > 1e-12)) break;
    glm::dvec2 move{(j[3] * miss.x - j[1] * miss.y) / det, (j[0] * miss.y - j[2] * miss.x) / det};
    glm::dvec2 next = p - move;
    for (int halving = 0; halving < 20 && !(glm::length(missing(next)) < glm::length(miss)); ++halving) next = p - (move *= 0.5);
    if (!(glm::length(missing(next)) < glm::length(miss))) break;
    p = next;
    miss = missing(p);
  }
  return {p, glm::length(miss) < 1e-9};
}

/// Whether the lens model maps the ring around `p` without folding: no crossing of det = 0 on the way out to it.
bool unfoldsUpTo(const std::array<double, 5>& coefficients, glm::dvec2 p) {
  for (int i = 1; i <= 32; ++i) {
    const glm::dvec2 q = p * (i / 32.0);
    const auto j = detail::distortJacobian(coefficients, q.x, q.y);
    if (!(j[0] * j[3] - j[1] * j[2] > 0)) return false;
  }
  return true;
}

bool distortionFolds(const Camera& camera, glm::ivec2 sizePx) {
  if (!hasDistortion(camera) || sizePx.x <= 0 || sizePx.y <= 0) return false;
  for (int i = 0; i < 9; ++i) {  // corners, middles of the sides, centre
    const glm::dvec2 px{(i % 3) * sizePx.x / 2.0, (i / 3) * sizePx.y / 2.0};
    const Undistortion u = undoDistortion(camera.distortion, (px - camera.centre_px) / *camera.focal_px);
    if (!u.converged || !unfoldsUpTo(camera.distortion, u.point)) return true;
  }
  return false;
}

Failure wrong(std::string_view viewName, const std::string& what) {
  return fail(ErrorCode::BadInput, "the camera of view '" + std::string(viewName) + "' " + what);
}

Result<void> checkRotation(const glm::dmat3& r, std::string_view viewName) {
  const glm::dmat3 square = glm::transpose(r) * r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(square[i][j] - (i == j ? 1.0 : 0.0)) > kRotationTolerance)
        return wrong(viewName, "has a rotation whose rows are not unit and perpendicular; write the three rows of an orthonormal matrix");
  if (glm::determinant(r) < 0)
    return wrong(viewName, "has a rotation that mirrors (determinant -1); turn the sign of one row (y points down, z forward)");
  return {};
}

Result<void> checkFocal(const Camera& camera, std::string_view viewName) {
  if (!camera.focal_px) return wrong(viewName, "is perspective but has no focal_px");
  if (!isFinite(*camera.focal_px) || camera.focal_px->x <= 0 || camera.focal_px->y <= 0)
    return wrong(viewName, "has a focal length that is not above zero: give focal_px in pixels");
  return {};
}

}  // namespace

ViewPoint toView(const Camera& camera, PlantPoint point) { return {camera.rotation * point.at + camera.translation}; }

PlantPoint toPlant(const Camera& camera, ViewPoint point) { return {glm::transpose(camera.rotation) * (point.at - camera.translation)}; }

PhotoPoint project(const Camera& camera, PlantPoint point) {
  const glm::dvec3 v = toView(camera, point).at;
  if (camera.model == CameraModel::Orthographic) return {camera.scale_px_per_unit * glm::dvec2{v.x, v.y} + camera.centre_px};
  const glm::dvec2 focal = focalOf(camera);
  const auto d = detail::distort(camera.distortion, v.x / v.z, v.y / v.z);
  return {focal * glm::dvec2{d[0], d[1]} + camera.centre_px};
}

bool isInFront(const Camera& camera, PlantPoint point) {
  return camera.model == CameraModel::Orthographic || toView(camera, point).at.z > 0;
}

glm::dvec2 undistorted(const Camera& camera, PhotoPoint pixel) {
  if (camera.model == CameraModel::Orthographic) return (pixel.px - camera.centre_px) / camera.scale_px_per_unit;
  const glm::dvec2 seen = (pixel.px - camera.centre_px) / focalOf(camera);
  return hasDistortion(camera) ? undoDistortion(camera.distortion, seen).point : seen;
}

Ray rayThrough(const Camera& camera, PhotoPoint pixel) { return rayOf(camera, undistorted(camera, pixel)); }

Ray rayOf(const Camera& camera, glm::dvec2 p) {
  const glm::dmat3 back = glm::transpose(camera.rotation);
  if (camera.model == CameraModel::Orthographic)
    return {toPlant(camera, {{p.x, p.y, 0}}), PlantDirection::along(back * glm::dvec3{0, 0, 1})};
  return {toPlant(camera, {{0, 0, 0}}), PlantDirection::along(back * glm::dvec3{p.x, p.y, 1})};
}

glm::dmat3 rotationLookingAlong(PlantDirection forward, PlantDirection imageUp) {
  const glm::dvec3 down = -perpendicularTo(forward, imageUp).unit();
  const glm::dvec3 right = glm::cross(down, forward.unit());
  return glm::transpose(glm::dmat3{right, down, forward.unit()});
}

std::optional<glm::dmat3> nominalRotation(std::string_view viewName) {
  for (const NamedDirection& n : kNominal)
    if (n.view == viewName) return rotationLookingAlong(PlantDirection::along(n.forward), PlantDirection::along(n.imageUp));
  return std::nullopt;
}

Camera cameraAt(const glm::dmat3& rotation, const Framing& framing) {
  Camera camera;
  camera.model = framing.model;
  camera.centre_px = glm::dvec2(framing.size_px) / 2.0;
  if (framing.model == CameraModel::Perspective) camera.focal_px = glm::dvec2{framing.focal_px, framing.focal_px};
  if (framing.model == CameraModel::Orthographic) camera.scale_px_per_unit = framing.scale_px_per_unit;
  camera.rotation = rotation;
  camera.translation = glm::dvec3{0, 0, framing.distance} - rotation * framing.target.at;
  return camera;
}

Result<Camera> nominalCamera(std::string_view viewName, const Framing& framing) {
  const auto rotation = nominalRotation(viewName);
  if (!rotation)
    return fail(ErrorCode::NotFound, "view '" + std::string(viewName) + "' has no nominal direction; the names that have one are front, right, top, back, left");
  return cameraAt(*rotation, framing);
}

Result<void> checkCamera(const Camera& camera, std::string_view viewName, glm::ivec2 sizePx) {
  const bool finite = isFinite(camera.centre_px) && isFinite(camera.translation) && isFinite(camera.rotation) &&
                      std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return std::isfinite(k); });
  if (!finite) return wrong(viewName, "has a number that is not finite");
  if (camera.model == CameraModel::Unknown) return camera.focal_px ? checkFocal(camera, viewName) : Result<void>{};
  if (const auto rotation = checkRotation(camera.rotation, viewName); !rotation) return rotation;
  if (camera.model == CameraModel::Orthographic) {
    if (!(std::isfinite(camera.scale_px_per_unit) && camera.scale_px_per_unit > 0))
      return wrong(viewName, "has a scale that is not above zero: give scale_px_per_unit, the pixels of one unit of length");
    return {};
  }
  if (const auto focal = checkFocal(camera, viewName); !focal) return focal;
  if (distortionFolds(camera, sizePx))
    return wrong(viewName, "has a lens distortion that folds the picture over itself inside the photo; check k1, k2, p1, p2, k3");
  return {};
}

}  // namespace axil::skeleton3d
