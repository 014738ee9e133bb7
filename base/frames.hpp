#pragma once
/// \file
/// The frames a point can be in, each its own type, so that a pixel is never added to a metre.
///
/// - PhotoPoint: pixels of one photo. Origin at the top left corner, x right, y down; the first pixel's centre is (0.5, 0.5).
/// - ViewPoint: one camera's frame in the project's unit. x right, y down, z forward, as in OpenCV: x_cam = R X + t.
/// - PlantPoint: the plant's frame in the project's unit (metres unless the project says otherwise). Right-handed, Y up as
///   in SimEco's Direction, origin at the collar. The front photo looks along -Z, the right one along -X (camera on +X),
///   the top one along -Y with image up = -Z.
/// - PlantDirection: a unit vector of the plant's frame.
///
/// Only named functions move between frames: skeleton3d/camera.hpp has them.

#include "base/angle.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace axil {

struct PhotoPoint {
  glm::dvec2 px{0, 0};
  friend bool operator==(const PhotoPoint&, const PhotoPoint&) = default;
};

struct ViewPoint {
  glm::dvec3 at{0, 0, 0};
  friend bool operator==(const ViewPoint&, const ViewPoint&) = default;
};

struct PlantPoint {
  glm::dvec3 at{0, 0, 0};
  friend bool operator==(const PlantPoint&, const PlantPoint&) = default;
};

/// A unit vector. Made by `along`, which says whether there is a direction at all.
class PlantDirection {
 public:
  [[nodiscard]] static constexpr PlantDirection up() { return PlantDirection(glm::dvec3{0, 1, 0}); }
  /// The direction of `v`; `v` must not be zero (see `hasDirection`).
  [[nodiscard]] static PlantDirection along(const glm::dvec3& v);
  [[nodiscard]] static bool hasDirection(const glm::dvec3& v);

  [[nodiscard]] constexpr const glm::dvec3& unit() const { return unit_; }
  friend bool operator==(const PlantDirection&, const PlantDirection&) = default;

 private:
  explicit constexpr PlantDirection(const glm::dvec3& unit) : unit_(unit) {}
  glm::dvec3 unit_{0, 1, 0};
};

/// The angle between two directions, 0 to 180 degrees, exact near both ends (atan2, not acos).
[[nodiscard]] Angle angleBetween(PlantDirection a, PlantDirection b);
/// The angle by which `from` must turn about `axis` to lie over `to`, both seen along `axis`; -180 to 180 degrees.
[[nodiscard]] Angle signedAngleAbout(PlantDirection axis, PlantDirection from, PlantDirection to);
/// `v` turned about `axis` by `angle`, right-handed (Rodrigues).
[[nodiscard]] PlantDirection turned(PlantDirection v, PlantDirection axis, Angle angle);
/// `v` made perpendicular to `normal`; `v` itself must not be parallel to it (see `areParallel`).
[[nodiscard]] PlantDirection perpendicularTo(PlantDirection normal, PlantDirection v);
/// Parallel or opposite to within 6e-10 degrees, where a perpendicular part is only rounding noise.
[[nodiscard]] bool areParallel(PlantDirection a, PlantDirection b);

}  // namespace axil
