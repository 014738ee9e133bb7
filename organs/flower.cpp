#include "organs/flower.hpp"

#include "base/angle.hpp"
#include "organs/data.hpp"
#include "organs/leaf.hpp"
#include "organs/mesh_tools.hpp"
#include "organs/shape_table.hpp"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace axil::organs {

namespace {

constexpr double pi = std::numbers::pi;
constexpr Angle goldenAngle = Angle::fromDegrees(137.50776405003785);

using Cell = const ShapeCell&;
constexpr std::array<ShapeColumn<FlowerShape>, 19> columns{{
    {"petals", [](FlowerShape& s, Cell c) { s.petals = c.whole(); }},
    {"whorls", [](FlowerShape& s, Cell c) { s.whorls = c.whole(); }},
    {"petalShape", [](FlowerShape& s, Cell c) { s.petalShape = c.text; }},
    {"petalWidthToLength", [](FlowerShape& s, Cell c) { s.petalWidthToLength = c.number(); }},
    {"spread_deg", [](FlowerShape& s, Cell c) { s.spread_deg = c.number(); }},
    {"cup", [](FlowerShape& s, Cell c) { s.cup = c.number(); }},
    {"tube", [](FlowerShape& s, Cell c) { s.tube = c.number(); }},
    {"tubeRadius", [](FlowerShape& s, Cell c) { s.tubeRadius = c.number(); }},
    {"mouthRadius", [](FlowerShape& s, Cell c) { s.mouthRadius = c.number(); }},
    {"bilateral", [](FlowerShape& s, Cell c) { s.bilateral = c.number(); }},
    {"sepals", [](FlowerShape& s, Cell c) { s.sepals = c.whole(); }},
    {"sepalLength", [](FlowerShape& s, Cell c) { s.sepalLength = c.number(); }},
    {"centreRadius", [](FlowerShape& s, Cell c) { s.centreRadius = c.number(); }},
    {"stamens", [](FlowerShape& s, Cell c) { s.stamens = c.whole(); }},
    {"stamenLength", [](FlowerShape& s, Cell c) { s.stamenLength = c.number(); }},
    {"petalColour", [](FlowerShape& s, Cell c) { s.petalColour = c.colour(); }},
    {"fused", [](FlowerShape& s, Cell c) { s.fused = c.number(); }},
    {"banner", [](FlowerShape& s, Cell c) { s.banner = c.number(); }},
    {"centreColour", [](FlowerShape& s, Cell c) { s.centreColour = c.colour(); }},
}};

// A blade that stands at `radius` from the axis, at `height`, turned to `azimuth` and leaning outward by `lean`; its upper
// side looks to the axis.
struct Placement {
  double radius = 0;
  double height = 0;
  double length = 1;
  Angle azimuth;
  Angle lean;
};

glm::dmat4 matrixOf(const Placement& p) {
  const glm::dvec3 out{std::sin(p.azimuth.radians()), 0, std::cos(p.azimuth.radians())};
  const glm::dvec3 up{0, 1, 0};
  const glm::dvec3 along = up * std::cos(p.lean.radians()) + out * std::sin(p.lean.radians());
  const glm::dvec3 upperSide = up * std::sin(p.lean.radians()) - out * std::cos(p.lean.radians());
  const glm::dvec3 side = glm::cross(along, upperSide);
  const glm::dvec3 foot = out * p.radius + up * p.height;
  return {glm::dvec4(side * p.length, 0), glm::dvec4(along * p.length, 0), glm::dvec4(upperSide * p.length, 0), glm::dvec4(foot, 1)};
}

Mesh bladeMesh(const std::string& shapeName, double widthToLength, double cup, Detail detail) {
  std::optional<LeafShape> shape = leafShapeNamed(shapeName);
  AXIL_ASSERT(shape.has_value(), "flower_shapes.tsv names a petal that leaf_shapes.tsv does not have");
  shape->arch = -0.25 * cup;
  shape->fold = 0.12 * std::abs(cup);
  // A petal is drawn one level lighter than a leaf: a flower has several.
  const Detail lighter = detail == Detail::Close ? Detail::Medium : Detail::Far;
  return leafParts(*shape, widthToLength, lighter).front().mesh;
}

Angle leanOf(const FlowerShape& shape, int whorl, Angle azimuth) {
  const double open = 1 - 0.72 * whorl / std::max(1, shape.whorls);
  return Angle::fromDegrees(shape.spread_deg * open * (1 + 0.35 * shape.bilateral * std::cos(azimuth.radians())));
}

Part petalsOf(const FlowerShape& shape, Detail detail) {
  Part part{"petal", shape.petalColour, {}};
  const Mesh petal = bladeMesh(shape.petalShape, shape.petalWidthToLength, shape.cup, detail);
  const int whorls = detail == Detail::Far ? std::min(shape.whorls, 2) : shape.whorls;
  for (int whorl = 0; whorl < whorls; ++whorl)
    for (int i = 0; i < shape.petals; ++i) {
      const Angle azimuth = Angle::fromRadians(2 * pi * (i + 0.5 * (whorl % 2)) / shape.petals) + whorl * 0.13 * goldenAngle;
      const double inner = 1 - 0.45 * whorl / std::max(1, shape.whorls);
      const double lower = 1 + 0.3 * shape.bilateral * std::cos(azimuth.radians());
      const double radius = std::max(shape.mouthRadius, 0.8 * shape.centreRadius) * (1 - 0.6 * whorl / std::max(1, shape.whorls));
      append(part.mesh, transformed(petal, matrixOf({.radius = radius,
                                                     .height = shape.tube + 0.004 * whorl,
                                                     .length = (1 - shape.tube) * inner * lower / (1 + 0.3 * shape.bilateral),
                                                     .azimuth = azimuth,
                                                     .lean = leanOf(shape, whorl, azimuth)})));
    }
  return part;
}

/// A pea's flower: what differs between its petals. Azimuth 180 degrees is up.
struct PeaPetal {
  double azimuth_deg, lean_deg, length, widthToLength, cup;
};
constexpr std::array<PeaPetal, 5> peaPetals{{{180, 68, 1.0, 1.15, -0.5}, {62, 40, 0.86, 0.52, 0.7}, {-62, 40, 0.86, 0.52, 0.7}, {16, 46, 0.74, 0.42, 1.1}, {-16, 46, 0.74, 0.42, 1.1}}};

Part peaPetalsOf(const FlowerShape& shape, Detail detail) {
  Part part{"petal", shape.petalColour, {}};
  for (const PeaPetal& petal : peaPetals)
    append(part.mesh, transformed(bladeMesh(shape.petalShape, petal.widthToLength, petal.cup, detail),
                                  matrixOf({.radius = shape.mouthRadius, .height = shape.tube, .length = (1 - shape.tube) * petal.length,
                                            .azimuth = Angle::fromDegrees(petal.azimuth_deg), .lean = Angle::fromDegrees(petal.lean_deg)})));
  return part;
}

// ---- corollas of one piece

/// How far a lobe reaches at `x` across it, -1 to 1: pointed, rounded, or blunt as the petals' shape is.
double lobeReach(const FlowerShape& shape, double x) {
  const double a = std::abs(x);
  if (shape.petalShape == "deltoid") return 1 - std::pow(a, 1.2);
  if (shape.petalShape == "obcordate") return 1 - std::pow(a, 4) - 0.14 * std::max(0.0, 1 - a / 0.35);
  return 1 - a * a;
}

/// The tube's radius at `t` of its length: a funnel opens late, a bell early, an urn is widest below its mouth.
double tubeRadiusAt(const FlowerShape& shape, double t) {
  if (shape.mouthRadius < shape.tubeRadius) return std::max(shape.mouthRadius, shape.tubeRadius * std::pow(std::sin(pi * (0.12 + 0.8 * t)), 0.8));
  const double opening = shape.tubeRadius < 0.2 * shape.mouthRadius ? 2.2 : 0.6;
  return shape.tubeRadius + (shape.mouthRadius - shape.tubeRadius) * std::pow(t, opening);
}

/// A profile of the corolla: up the tube, then out along a lobe that reaches `reach` far; `v` from 0 to 1 up the tube, to 2 to the rim.
glm::dvec2 corollaProfile(const FlowerShape& shape, double v, double reach) {
  if (v <= 1) return {tubeRadiusAt(shape, v), shape.tube * v};
  glm::dvec2 at{tubeRadiusAt(shape, 1), shape.tube};
  constexpr int steps = 8;
  const double piece = (v - 1) * reach / steps;
  for (int i = 0; i < steps; ++i) {
    const double lean = Angle::fromDegrees(shape.spread_deg).radians() * (0.35 + 0.65 * (v - 1) * (i + 0.5) / steps);
    at += piece * glm::dvec2{std::sin(lean), std::cos(lean)};
  }
  return at;
}

/// Tube, throat and lobes as one thin surface that is closed at its foot. Its upper side is the inside.
Part corollaOf(const FlowerShape& shape, Detail detail) {
  const int perLobe = detail == Detail::Close ? 10 : detail == Detail::Medium ? 6 : 4;
  const int rows = detail == Detail::Close ? 10 : detail == Detail::Medium ? 8 : 4;
  const int sides = perLobe * shape.petals;
  const auto pointAt = [&](double around, double v) {
    const double x = std::remainder(around * shape.petals / (2 * pi), 1.0) * 2;
    const double reach = (1 - shape.tube) * (shape.fused + (1 - shape.fused) * std::max(0.0, lobeReach(shape, x)));
    const glm::dvec2 p = corollaProfile(shape, v, reach);
    return glm::dvec3{p.x * std::sin(around), p.y, p.x * std::cos(around)};
  };
  Part part{"petal", shape.petalColour, {}};
  Mesh& mesh = part.mesh;
  for (int row = 0; row <= rows; ++row)
    for (int side = 0; side <= sides; ++side) {
      constexpr double h = 1e-4;
      const double around = 2 * pi * (side % sides) / sides, v = 2.0 * row / rows;
      const glm::dvec3 round = pointAt(around + h, v) - pointAt(around - h, v), up = pointAt(around, std::min(v + h, 2.0)) - pointAt(around, std::max(v - h, 0.0));
      mesh.positions.emplace_back(pointAt(around, v));
      mesh.normals.emplace_back(glm::normalize(glm::cross(up, round)));
      mesh.uvs.emplace_back(static_cast<double>(side) / sides, v / 2);
    }
  mesh.positions.emplace_back(0, 0, 0);
  mesh.normals.emplace_back(0, 1, 0);
  mesh.uvs.emplace_back(0.5, 0);
  const auto at = [&](int row, int side) { return static_cast<std::uint32_t>(row * (sides + 1) + side); };
  const auto foot = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int side = 0; side < sides; ++side) {
    mesh.triangles.insert(mesh.triangles.end(), {foot, at(0, side), at(0, side + 1)});
    for (int row = 0; row < rows; ++row)
      mesh.triangles.insert(mesh.triangles.end(), {at(row, side), at(row + 1, side + 1), at(row, side + 1), at(row, side), at(row + 1, side), at(row + 1, side + 1)});
  }
  return part;
}

Part sepalsOf(const FlowerShape& shape, Detail detail) {
  Part part{"sepal", {0.13f, 0.30f, 0.06f}, {}};
  const Mesh sepal = bladeMesh("lanceolate", 0.35, 0.3, detail);
  const bool wide = shape.fused > 0 && std::max(shape.tubeRadius, shape.mouthRadius) > 0.2;  // they lie under a bell or an urn
  const Angle lean = Angle::fromDegrees(wide ? 72 : shape.tube > 0.3 ? 14 : std::min(shape.spread_deg + 8, 95.0));
  for (int i = 0; i < shape.sepals; ++i)
    append(part.mesh, transformed(sepal, matrixOf({.radius = shape.fused > 0 ? tubeRadiusAt(shape, 0) : shape.tubeRadius,
                                                   .height = 0,
                                                   .length = shape.sepalLength,
                                                   .azimuth = Angle::fromRadians(2 * pi * (i + 0.5) / shape.sepals),
                                                   .lean = lean})));
  return part;
}

Part tubeOf(const FlowerShape& shape, Detail detail) {
  const int sides = detail == Detail::Close ? 12 : detail == Detail::Medium ? 8 : 4;
  const std::vector<glm::dvec2> profile{{shape.tubeRadius, 0},
                                        {0.5 * (shape.tubeRadius + 0.55 * shape.mouthRadius), 0.5 * shape.tube},
                                        {0.9 * shape.mouthRadius, 0.9 * shape.tube},
                                        {1.02 * shape.mouthRadius, shape.tube + 0.004}};
  return {"tube", shape.petalColour * 0.85f, revolved(profile, sides)};
}

// A dome over the mouth: the disc of a head, or the eye of a flower.
Part centreOf(const FlowerShape& shape, Detail detail) {
  const int sides = detail == Detail::Close ? 14 : detail == Detail::Medium ? 8 : 5;
  const double r = shape.centreRadius;
  const std::vector<glm::dvec2> profile{{r, shape.tube}, {0.72 * r, shape.tube + 0.35 * r}, {0, shape.tube + 0.5 * r}};
  return {"centre", shape.centreColour, revolved(profile, sides)};
}

Part stamensOf(const FlowerShape& shape) {
  Part part{"stamen", shape.centreColour, {}};
  for (int i = 0; i < shape.stamens; ++i) {
    const double turn = (i * goldenAngle).radians();
    const double lean = 0.25 + 0.35 * std::sqrt((i + 0.5) / shape.stamens);
    const glm::dvec3 out{std::sin(turn), 0, std::cos(turn)};
    const glm::dvec3 foot = out * (0.3 * shape.mouthRadius) + glm::dvec3{0, shape.tube, 0};
    const glm::dvec3 tip = foot + shape.stamenLength * (out * std::sin(lean) + glm::dvec3{0, std::cos(lean), 0});
    const std::vector<glm::dvec3> path{foot, tip, tip + (tip - foot) * 0.12};
    const std::vector<double> radii{0.006, 0.006, 0.022};
    append(part.mesh, tube(path, radii, 3));
  }
  return part;
}

}  // namespace

const std::vector<FlowerShape>& flowerShapes() {
  static const std::vector<FlowerShape> shapes = ShapeTable<FlowerShape>(data::flower_shapes, "flower_shapes.tsv", columns).shapes();
  return shapes;
}

std::optional<FlowerShape> flowerShapeNamed(std::string_view name) { return namedIn(flowerShapes(), name); }

std::vector<Part> flowerParts(const FlowerShape& shape, Detail detail) {
  std::vector<Part> parts;
  const bool fine = detail != Detail::Far;
  if (fine && shape.sepals > 0) parts.push_back(sepalsOf(shape, detail));
  if (shape.fused > 0) {
    parts.push_back(corollaOf(shape, detail));
  } else {
    if (shape.tube > 0.02) parts.push_back(tubeOf(shape, detail));
    parts.push_back(shape.banner > 0 ? peaPetalsOf(shape, detail) : petalsOf(shape, detail));
  }
  if (shape.centreRadius > 0) parts.push_back(centreOf(shape, detail));
  if (fine && shape.stamens > 0) parts.push_back(stamensOf(shape));
  return parts;
}

}  // namespace axil::organs
