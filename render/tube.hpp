#pragma once
/// \file
/// Tubes: one stem as a smooth closed surface along its nodes.
///
/// The centre line passes through every node exactly. Between two nodes it is a cubic whose inner control points lie a
/// third of the segment away along the tangents, so it never strays further than that from the chord; the tangent at a
/// node is the bisector of the two directions, which is what a centripetal Catmull-Rom spline has there. Rings are placed
/// where it bends, carried along without twist, and closed by round caps. Where a stem bends sharper than a tube can
/// follow (over `sharpestBend`, or within its own radius) two tubes meet in a ball, without a gap.
/// Sources: Lee 1989 and Yuksel et al. 2011 (centripetal parametrisation), Wang et al. 2008 (frames by double reflection).

#include "render/types.hpp"

#include <span>
#include <vector>

namespace axil::render {

struct TubeNode {
  glm::dvec3 at{0};
  double radius = 0;                 ///< must be above 0
  glm::vec3 colour{0.5f};
};

/// A collar where a branch leaves its parent: the tube is a little wider until it is out of a parent of this radius.
struct TubeCollar {
  double parentRadius = 0;           ///< 0: no parent, no collar
};

struct TubePath {
  std::vector<TubeNode> nodes;           ///< at least two, no two neighbours in one place
  std::vector<TriangleSource> segments;  ///< one fewer than nodes: whose triangles these are
  TubeCollar collar;
  Angle sharpestBend = Angle::fromDegrees(100);  ///< a sharper one is a joint: two tubes meet in a ball
};

/// How finely a tube is made. `turnPerRing` is how far the centre line may turn from ring to ring.
struct TubeDetail {
  int sides = 12;                    ///< at least 3
  Angle turnPerRing = Angle::fromDegrees(9);
  int capRings = 3;                  ///< rings of a round end, its rim included; at least 1; with 1 collars are left out
};

/// One ring of a tube: where its centre line is, where it goes, how thick it is there.
struct TubeRing {
  glm::dvec3 at{0};
  glm::dvec3 tangent{0, 1, 0};
  double radius = 0;
  double tilt = 0;                   ///< sin of it is the normal's part along the tangent; radians
  glm::vec3 colour{0.5f};
  std::int32_t segment = 0;          ///< the segment that ends here (0 for the first ring too)
};

/// The centre line of `path`, cut where a ball joint is needed: each run is swept and capped by itself.
[[nodiscard]] std::vector<std::vector<TubeRing>> centreLine(const TubePath& path, const TubeDetail& detail);

/// Collects tubes into one mesh.
class TubeBuilder {
 public:
  void add(const TubePath& path, const TubeDetail& detail);
  [[nodiscard]] std::size_t triangleCount() const { return mesh_.triangles.size() / 3; }
  [[nodiscard]] StemMesh take() { return std::move(mesh_); }

 private:
  void sweep(std::span<const TubeRing> rings, std::span<const TriangleSource> segments);
  void addRing(const TubeRing& ring, const glm::dvec3& normal);
  std::uint32_t addPole(const glm::dvec3& at, const glm::dvec3& normal, const glm::vec3& colour);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const TriangleSource& source);
  StemMesh mesh_;
  std::vector<glm::dvec2> circle_;   ///< cos and sin of the sides, kept from tube to tube
};

}  // namespace axil::render
