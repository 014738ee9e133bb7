#pragma once
/// \file
/// LSystemView: what the turtle starts with, read from the `.v` file beside a `.l` file: lines `keyword: value`. Settings that only
/// concern the reference program's own window (light, projection, colour maps) are passed over.
/// Frame: the plant's, Y up; angles in degrees in the file.

#include "base/angle.hpp"
#include "base/result.hpp"
#include "base/source.hpp"
#include "simeco/grammar.hpp"
#include "simeco/response_curve.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// `tropism: T: x y z A: angle I: intensity E: elasticity S: step`: before each step the turtle turns towards `direction`.
struct Tropism {
  glm::dvec3 direction{0, 1, 0};  ///< a unit vector
  Angle angle;                    ///< the heading is drawn to where it makes this angle with `direction`
  double intensity = 1;           ///< -1 to 1
  double elasticity = 0;          ///< how far it turns; @Ts, @Ti and @Td change it along the plant
  double step = 0;                ///< what @Ti and @Td add and subtract without a second parameter
  bool torque = false;            ///< `torque:`: turns the turtle about its heading only
};

/// The older `tropism direction: x,y,z` with `initial elasticity: e`: bends after each step.
struct OldTropism {
  glm::dvec3 direction{0, -1, 0};
  double elasticity = 0;
};

/// How thick a line is: so many pixels, or so much of the plant's unit.
enum class LineStyle { Pixel, Polygon, Cylinder };

/// `surface: l leaf ovate 0.5`: what `~l` draws, an organ of the project's own by kind and shape.
struct ViewSurface {
  OrganKind kind = OrganKind::Leaf;
  std::string model;
  double scale = 1;
};

struct LSystemView {
  Angle angleIncrement = Angle::fromDegrees(45);
  double lineWidth = 1;
  double widthIncrement = 0;
  double scale = 1;            ///< of steps and of !(w), not of `lineWidth`
  double scaleMultiplier = 1;
  int colour = 128;
  int colourIncrement = 1;
  LineStyle lineStyle = LineStyle::Pixel;
  bool taperedLines = true;
  bool pastCut = true;         ///< whether what stands behind % is drawn
  std::vector<Tropism> tropisms;
  std::optional<OldTropism> oldTropism;
  std::map<int, glm::dvec4> colours;      ///< `color: 3 255 250 240`: sRGB 0 to 1 of some indices; the others are on the colour circle
  std::map<char, ViewSurface> surfaces;   ///< by letter
  std::vector<ResponseCurve> functions;   ///< `func(n, x)` asks the n-th, counted from 1; one without points could not be read
};

struct ParsedView {
  LSystemView view;
  std::vector<Diagnostic> diagnostics;
};
/// Function files that it names are looked for in `folder`; without one they cannot be read.
[[nodiscard]] ParsedView parseLSystemView(std::string_view text, const std::filesystem::path& folder = {});

/// The view file at `path`. Fails when it cannot be read, and with BadInput and the printed diagnostics when it has errors.
[[nodiscard]] Result<LSystemView> readLSystemView(const std::filesystem::path& path);

/// The view of the L-system file at `path`: the `.v` file of the same name beside it, else the defaults.
[[nodiscard]] Result<LSystemView> viewBeside(const std::filesystem::path& lsystemFile);

}  // namespace axil::simeco
