#pragma once
/// \file
/// Leaves: a shape is a few numbers (a row of data/leaf_shapes.tsv, changed by rows of the tables of apexes, bases, margins and
/// venations); from it come the flat outline a botanist draws and the curved blade that is rendered. Frame and units as in
/// types.hpp: the base of the blade at the origin, its midrib's tip at (0, 1, 0), its adaxial side towards +Z. Basal lobes
/// reach below y = 0 and apical ones above y = 1; the petiole's stub hangs below the origin, so that it ends inside whatever
/// the leaf is attached to.
///
/// Every combination of shape, apex, base and margin gives an outline that does not cross itself: teeth and lobes that would are
/// made shallower until they do not.

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

enum class BaseLobes { None, Round, Pointed, Ears, Auricles };  ///< cordate; sagittate; hastate; auriculate
enum class LeafLobes { None, Pinnate, Palmate };
enum class LeafMargin { Entire, Serrate, DoublySerrate, Dentate, Crenate, Undulate, Sinuate, Spinose, Ciliate };
enum class LeafVeins { Pinnate, Palmate, Parallel, Arcuate, Reticulate, Dichotomous, MidribOnly, None };

/// The outline and posture of a blade. Every length is in units of the blade's length.
struct LeafShape {
  std::string name;
  double widthToLength = 0.5;  ///< greatest width, above 0, at most 3
  double widest = 0.5;         ///< where along the midrib, between 0 and 1
  LeafEnd base;
  LeafEnd apex;
  double tailLength = 0;  ///< a narrow tip upon the apex (caudate, cuspidate, mucronate): its length, below 0.5
  double tailWidth = 0;   ///< and its width at its foot, as a share of the blade's
  BaseLobes baseLobes = BaseLobes::None;
  double baseLobeDepth = 0;  ///< how far the lobes reach below the petiole; for Ears their share of the half width
  double apexNotch = 0;      ///< how far the apex is cut in below its two lobes (emarginate, obcordate)
  double shield = 0;         ///< how far the blade reaches below its petiole all round (peltate)
  LeafLobes lobes = LeafLobes::None;
  int lobeCount = 0;      ///< Pinnate: lobes a side below the terminal one; Palmate: all of them, odd
  double lobeDepth = 0;   ///< 0 no cut to 1 cut to the midrib
  double lobedUpTo = 1;   ///< Pinnate: where along the midrib the lobes end and the terminal one begins
  double lobeLean = 0.45; ///< Pinnate: how far the lobes point forward; below 0 they point back (runcinate)
  double lobeTip = 1.25;  ///< how lobes end: 0.6 round, 1.25 pointed
  LeafMargin margin = LeafMargin::Entire;
  int teeth = 0;          ///< a side; hairs a side of a ciliate margin
  double toothDepth = 0;
  LeafVeins veins = LeafVeins::Pinnate;
  int veinPairs = 7;
  double bend = 0;     ///< sideways bow of the midrib (falcate)
  double oblique = 0;  ///< share by which the left half is narrower
  double arch = 0.06;  ///< height of the midrib's bow above its chord
  double fold = 0.25;  ///< slope of each half from the midrib up
  double spots = 0;    ///< the share of the blade that is covered with spots, 0 to 0.6
  glm::vec3 spotColour{0.75f, 0.30f, 0.42f};  ///< linear RGB

  friend bool operator==(const LeafShape&, const LeafShape&) = default;
};

/// All shapes of data/leaf_shapes.tsv, in its order.
[[nodiscard]] const std::vector<LeafShape>& leafShapes();
/// The shape of that name ("ovate"), lower case; empty when there is none.
[[nodiscard]] std::optional<LeafShape> leafShapeNamed(std::string_view name);
/// The shape with another greatest width (in blade lengths); lobes and teeth stretch along.
[[nodiscard]] LeafShape withWidth(LeafShape shape, double widthToLength);

/// What of a shape a description can change on its own.
enum class LeafFeature { Apex, Base, Margin, Veins };
/// The names of data/leaf_apexes.tsv, leaf_bases.tsv, leaf_margins.tsv and leaf_veins.tsv, in their order.
[[nodiscard]] std::vector<std::string> leafFeatureNames(LeafFeature feature);
/// The shape with that apex ("acuminate"), base, margin or venation; nothing for a name that the feature's table does not have.
/// A lobed margin leaves the lobes of a shape that has some.
[[nodiscard]] std::optional<LeafShape> withFeature(const LeafShape& shape, LeafFeature feature, std::string_view name);

/// The flat outline: a simple closed polygon, counter-clockwise, the first point (the base, (0, 0)) not repeated, the apex at
/// (0, 1). For a peltate blade the base lies inside, and the polygon begins at the lowest point.
[[nodiscard]] std::vector<glm::vec2> leafOutline(const LeafShape& shape);

/// Veins as lines in the plane of the outline, from where they begin outwards; the midrib first.
struct LeafVein {
  std::vector<glm::vec2> points;
  double thickness = 0;  ///< at its beginning, in blade lengths; it tapers to a third
};
[[nodiscard]] std::vector<LeafVein> leafVeins(const LeafShape& shape);
/// The hairs of a ciliate margin, each from the margin outwards; empty for others.
[[nodiscard]] std::vector<std::vector<glm::vec2>> leafHairs(const LeafShape& shape);
/// The spots of a spotted blade, as small polygons inside the outline.
[[nodiscard]] std::vector<std::vector<glm::vec2>> leafSpots(const LeafShape& shape);

/// The leaf in space: "blade" (one sheet, folded along the midrib, arched); "midrib", "vein", "spot" and "hair" at Close, spots
/// at Medium too; and except at Detail::Far "petiole". `widthToLength` replaces the shape's own. Triangles of a blade with its
/// veins: 100 to 300 at Close (up to 1100 where it is toothed, cut, netted or spotted), 25 to 64 at Medium (up to 250 where
/// spotted), 4 to 12 at Far.
[[nodiscard]] std::vector<Part> leafParts(const LeafShape& shape, std::optional<double> widthToLength, Detail detail);

}  // namespace axil::organs
