#pragma once
/// \file
/// Cameras: how a point of the plant becomes a pixel, and which line of the plant's space a pixel stands for.
///
/// Plant frame (project's unit) -> view frame by x_cam = R X + t (x right, y down, z forward) -> pixels, either
/// orthographic, u = s x + cx, or perspective, u = fx x/z + cx after the lens distortion k1, k2, p1, p2, k3 of OpenCV's
/// model. A camera whose model is Unknown can do neither; asking it is a bug of the caller (see estimate.hpp).
/// Source of the three nominal directions: docs/files.md; L-Grammar Generator 2005, section 3.2.1.

#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <optional>
#include <string_view>

namespace axil::skeleton3d {

/// A half line of the plant's space, from the camera (or, orthographic, from its image plane) away from the camera.
struct Ray {
  PlantPoint origin;
  PlantDirection direction = PlantDirection::up();
};

[[nodiscard]] ViewPoint toView(const Camera& camera, PlantPoint point);
[[nodiscard]] PlantPoint toPlant(const Camera& camera, ViewPoint point);

/// The pixel of `point`. For a perspective camera it means something only where `isInFront`.
[[nodiscard]] PhotoPoint project(const Camera& camera, PlantPoint point);

/// Whether a perspective camera can see `point` at all; an orthographic one always can.
[[nodiscard]] bool isInFront(const Camera& camera, PlantPoint point);

/// The line of points that project to `pixel`; the lens distortion is undone by Newton's method. Where no point projects
/// to `pixel` (beyond the fold of a strong distortion; `checkCamera` refuses such a photo) it is the nearest line found.
[[nodiscard]] Ray rayThrough(const Camera& camera, PhotoPoint pixel);

/// Where `pixel` is after the lens distortion is undone, as (x/z, y/z); for an orthographic camera (x, y) in the unit.
[[nodiscard]] glm::dvec2 undistorted(const Camera& camera, PhotoPoint pixel);

/// The line of what `undistorted` gives; rayThrough is both in one.
[[nodiscard]] Ray rayOf(const Camera& camera, glm::dvec2 undistortedPoint);

/// What is wrong with the camera of the view called `viewName`, if anything: a number that is not finite, a focal length
/// or scale that is not above zero, a rotation that is none (columns unit and perpendicular to within 1e-3, determinant +1).
/// Where `sizePx` is known, also a lens distortion that folds back inside the photo. Unknown cameras pass if their hints are sane.
[[nodiscard]] Result<void> checkCamera(const Camera& camera, std::string_view viewName, glm::ivec2 sizePx = {0, 0});

/// A camera's rotation from where it looks and what is up in its picture; `imageUp` is made perpendicular to `forward`.
[[nodiscard]] glm::dmat3 rotationLookingAlong(PlantDirection forward, PlantDirection imageUp);

/// The rotation of a camera that is held exactly as its view's name says: front, right, top, and also back and left.
/// Nothing for any other name.
[[nodiscard]] std::optional<glm::dmat3> nominalRotation(std::string_view viewName);

/// How a photo of a known plant is framed: `target` is in the middle of the picture.
struct Framing {
  CameraModel model = CameraModel::Perspective;
  PlantPoint target = {};
  double distance = 1;            ///< from the camera to `target`, project's unit
  double focal_px = 1;            ///< perspective
  double scale_px_per_unit = 1;   ///< orthographic
  glm::ivec2 size_px{1200, 1600};
};

/// A camera with the given rotation and framing, without distortion.
[[nodiscard]] Camera cameraAt(const glm::dmat3& rotation, const Framing& framing);

/// The camera of the view called `viewName`, held exactly. Fails with NotFound for a name without a nominal direction.
[[nodiscard]] Result<Camera> nominalCamera(std::string_view viewName, const Framing& framing);

}  // namespace axil::skeleton3d
