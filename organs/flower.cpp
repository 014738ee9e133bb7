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
constexpr std::array<ShapeColumn<FlowerShape>, 17> columns{{
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

Part sepalsOf(const FlowerShape& shape, Detail detail) {
  Part part{"sepal", {0.13f, 0.30f, 0.06f}, {}};
  const Mesh sepal = bladeMesh("lanceolate", 0.35, 0.3, detail);
  const Angle lean = Angle::fromDegrees(shape.tube > 0.3 ? 14 : std::min(shape.spread_deg + 8, 95.0));
  for (int i = 0; i < shape.sepals; ++i)
    append(part.mesh, transformed(sepal, matrixOf({.radius = shape.tubeRadius,
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
  if (shape.tube > 0.02) parts.push_back(tubeOf(shape, detail));
  parts.push_back(petalsOf(shape, detail));
  if (shape.centreRadius > 0) parts.push_back(centreOf(shape, detail));
  if (fine && shape.stamens > 0) parts.push_back(stamensOf(shape));
  return parts;
}

}  // namespace axil::organs
