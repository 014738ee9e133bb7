#pragma once
/// \file
/// Leaves: a shape is a few numbers (a row of data/leaf_shapes.tsv); from it come the flat outline a botanist draws and the
/// curved blade that is rendered. Frame and units as in types.hpp: the base of the blade at the origin, its midrib's tip at
/// (0, 1, 0), its adaxial side towards +Z. Basal lobes reach below y = 0 and apical ones above y = 1; the petiole's stub
/// hangs below the origin, so that it ends inside whatever the leaf is attached to.

#include "organs/types.hpp"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

/// How one end of a blade narrows from the widest place (1) to the end (0): width = (1 - (1 - u)^shoulder)^end.
/// shoulder 1: a corner at the widest place; 2: a smooth turn; 4 and more: sides that run parallel for long.
/// end 0: cut straight (truncate); 0.3: blunt; 0.5: round; 1: acute; 1.5 and more: drawn out (acuminate, attenuate).
struct LeafEnd {
  double shoulder = 2;
  double end = 0.5;
  friend bool operator==(const LeafEnd&, const LeafEnd&) = default;
};

enum class BaseLobes { None, Round, Pointed, Ears };  ///< cordate; sagittate; hastate
enum class LeafLobes { None, Pinnate, Palmate, Peltate };
enum class LeafMargin { Entire, Serrate, Dentate, Crenate, Undulate };

/// The outline and posture of a blade. Every length is in units of the blade's length.
struct LeafShape {
  std::string name;
  double widthToLength = 0.5;  ///< greatest width, above 0, at most 3
  double widest = 0.5;         ///< where along the midrib, between 0 and 1
  LeafEnd base;
  LeafEnd apex;
  BaseLobes baseLobes = BaseLobes::None;
  double baseLobeDepth = 0;  ///< how far the lobes reach below the petiole; for Ears their share of the half width
  double apexNotch = 0;      ///< how far the apex is cut in below its two lobes (emarginate, obcordate)
  LeafLobes lobes = LeafLobes::None;
  int lobeCount = 0;     ///< Pinnate: lobes a side below the terminal one; Palmate: all of them
  double lobeDepth = 0;  ///< 0 no cut to 1 cut to the midrib
  double lobedUpTo = 1;  ///< Pinnate: where along the midrib the lobes end and the terminal one begins
  LeafMargin margin = LeafMargin::Entire;
  int teeth = 0;           ///< a side
  double toothDepth = 0;
  double bend = 0;     ///< sideways bow of the midrib (falcate)
  double oblique = 0;  ///< share by which the left half is narrower
  double arch = 0.06;  ///< height of the midrib's bow above its chord
  double fold = 0.25;  ///< slope of each half from the midrib up

  friend bool operator==(const LeafShape&, const LeafShape&) = default;
};

/// All shapes of data/leaf_shapes.tsv, in its order.
[[nodiscard]] const std::vector<LeafShape>& leafShapes();
/// The shape of that name ("ovate"), lower case; empty when there is none.
[[nodiscard]] std::optional<LeafShape> leafShapeNamed(std::string_view name);
/// The shape with another greatest width (in blade lengths); lobes and teeth stretch along.
[[nodiscard]] LeafShape withWidth(LeafShape shape, double widthToLength);

/// The flat outline: a simple closed polygon, counter-clockwise, the first point (the base, (0, 0)) not repeated, the apex at
/// (0, 1). For a peltate blade the base lies inside, and the polygon begins at the lowest point.
[[nodiscard]] std::vector<glm::vec2> leafOutline(const LeafShape& shape);

/// The leaf in space: "blade" (one sheet, folded along the midrib, arched), and except at Detail::Far "midrib" and "petiole".
/// `widthToLength` replaces the shape's own. About 100 to 300 triangles at Close, 30 to 60 at Medium, 4 to 10 at Far.
[[nodiscard]] std::vector<Part> leafParts(const LeafShape& shape, std::optional<double> widthToLength, Detail detail);

}  // namespace axil::organs
