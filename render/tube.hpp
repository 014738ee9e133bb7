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

struct TubeChord {
  glm::dvec3 direction{0, 1, 0};
  double length = 0;
};

/// Centre lines one after the other, in memory that is kept between them.
class CentreLines {
 public:
  /// Follows `path`; its runs are there until the next call.
  void trace(const TubePath& path, const TubeDetail& detail);
  [[nodiscard]] std::size_t runs() const { return firsts_.size(); }
  [[nodiscard]] std::span<const TubeRing> run(std::size_t index) const;

 private:
  std::vector<TubeChord> chords_;
  std::vector<double> shares_;
  std::vector<TubeRing> rings_;
  std::vector<std::size_t> firsts_;   ///< first ring of each run
};

/// Tubes as rings, before they are triangles: how large their mesh will be is known before it is made, so that many of these can be
/// written side by side into one mesh.
class TubeRings {
 public:
  void add(const TubePath& path, const TubeDetail& detail);
  [[nodiscard]] std::size_t vertexCount() const { return vertices_; }
  [[nodiscard]] std::size_t triangleCount() const { return triangles_; }
  /// Writes the triangles into `mesh`, whose arrays have room for them, from vertex and triangle number so and so on.
  void sweepInto(StemMesh& mesh, std::size_t firstVertex, std::size_t firstTriangle) const;

 private:
  struct Run {
    std::size_t firstRing = 0;
    std::size_t rings = 0;
    std::uint32_t sides = 8;
  };
  std::vector<TubeRing> rings_;
  std::vector<TriangleSource> sources_;  ///< one a ring
  std::vector<Run> runs_;
  CentreLines lines_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace axil::render
