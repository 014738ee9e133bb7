#pragma once
/// \file
/// Daylight: how much of the sun, of the sky and of the light that the ground throws back reaches each vertex, with the
/// plant itself in the way. A soft box of light: a sun with a wide disc, an overcast sky, a bright ground.
///
/// The plant is seen from many directions, spread evenly over the sphere; each view is a small depth picture, and a point
/// is reached by the light of a direction when nothing lies before it there. So shadows are soft and leaves darken each
/// other, without a ray traced. Same mesh, same numbers, however many threads work.
/// Source: the ambient occlusion of Zhukov et al. 1998, with depth pictures for rays.

#include "render/flat_mesh.hpp"

namespace axil::render {

/// Towards the sun, in the plant's frame: from the upper left before the plant.
[[nodiscard]] glm::vec3 sunDirection();

/// Light on a point with a normal. `front` is the side that the normal points to; each value is a share of what an
/// unshaded surface that faces the source fully would get.
struct PointLight {
  float sun = 1;             ///< how much of the sun's disc is seen (without the cosine)
  float skyFront = 1;
  float skyBack = 0;
  float groundFront = 0;
  float groundBack = 1;
};

/// A square of ground around the collar, seen from above: `shade` is the share of the open ground's light, row by row
/// from the corner `low` (x, z), each cell `cell` wide.
struct GroundShade {
  glm::dvec2 low{0, 0};
  double cell = 0;           ///< 0: nothing casts a shadow
  int size = 0;              ///< cells a side
  std::vector<float> shade;

  /// Between the cells' centres, bilinear; 1 outside.
  [[nodiscard]] double at(double x, double z) const;
};

struct Daylight {
  std::vector<PointLight> vertices;  ///< one a vertex of the mesh
  GroundShade ground;
};

enum class GroundLight { Shaded, None };

struct DaylightOptions {
  double groundHeight = 0;
  GroundLight ground = GroundLight::Shaded;
};

[[nodiscard]] Daylight daylightOn(const FlatMesh& mesh, const DaylightOptions& options);

}  // namespace axil::render
