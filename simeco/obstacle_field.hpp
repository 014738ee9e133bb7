#pragma once
/// \file
/// ObstacleField: obstacles made ready for one question: how near does a straight piece of an organ come to them? Spheres count
/// as solid balls (a distance inside is negative), boxes and meshes as their surfaces. Exact: no sampling, no stepping, so
/// nothing thin is missed. Immutable; any number of threads may ask. Internal to growth.
/// Source: Ericson 2005, Real-Time Collision Detection, chapter 5 (nearest points of segments and triangles).

#include "simeco/environment.hpp"

#include <span>

namespace axil::simeco {

class ObstacleField {
 public:
  explicit ObstacleField(std::span<const Obstacle> obstacles);

  struct Nearest {
    double distance = 0;
    glm::dvec3 at{0};  ///< the obstacle's point
  };
  /// The obstacles' nearest point to the segment from `a` to `b` (which may be one point), if it is nearer than `within`.
  [[nodiscard]] std::optional<Nearest> nearest(const glm::dvec3& a, const glm::dvec3& b, double within) const;
  /// Whether a sphere or a box holds `point`. A mesh has no inside.
  [[nodiscard]] bool holds(const glm::dvec3& point) const;

 private:
  struct Triangle {
    glm::dvec3 a, b, c;
  };
  /// A ball that holds the triangles from `first` to `last`; its two halves follow, if it has any.
  struct Group {
    glm::dvec3 centre{0};
    double radius = 0;
    std::uint32_t first = 0, last = 0;
    std::int32_t halves = -1;
  };
  void addBox(const BoxObstacle& box);
  void addMesh(const MeshObstacle& mesh);
  void divide(std::size_t group);
  [[nodiscard]] Group groupOf(std::uint32_t first, std::uint32_t last) const;

  std::vector<SphereObstacle> spheres_;
  std::vector<BoxObstacle> boxes_;
  std::vector<Triangle> triangles_;
  std::vector<Group> groups_;
};

}  // namespace axil::simeco
