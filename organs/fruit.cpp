#include "organs/fruit.hpp"

#include "base/angle.hpp"
#include "organs/data.hpp"
#include "organs/leaf_rulings.hpp"
#include "organs/mesh_tools.hpp"
#include "organs/shape_table.hpp"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace axil::organs {

namespace {

constexpr double pi = std::numbers::pi;

constexpr std::array<std::pair<std::string_view, FruitExtra>, 6> extraWords{{{"none", FruitExtra::None},
                                                                             {"calyx", FruitExtra::Calyx},
                                                                             {"cup", FruitExtra::Cup},
                                                                             {"wing", FruitExtra::Wing},
                                                                             {"drupelets", FruitExtra::Drupelets},
                                                                             {"scales", FruitExtra::Scales}}};

using Cell = const ShapeCell&;
constexpr std::array<ShapeColumn<FruitShape>, 13> columns{{
    {"widthToLength", [](FruitShape& s, Cell c) { s.widthToLength = c.number(); }},
    {"widest", [](FruitShape& s, Cell c) { s.widest = c.number(); }},
    {"baseShoulder", [](FruitShape& s, Cell c) { s.base.shoulder = c.number(); }},
    {"baseEnd", [](FruitShape& s, Cell c) { s.base.end = c.number(); }},
    {"apexShoulder", [](FruitShape& s, Cell c) { s.apex.shoulder = c.number(); }},
    {"apexEnd", [](FruitShape& s, Cell c) { s.apex.end = c.number(); }},
    {"flatness", [](FruitShape& s, Cell c) { s.flatness = c.number(); }},
    {"ribs", [](FruitShape& s, Cell c) { s.ribs = c.whole(); }},
    {"ribDepth", [](FruitShape& s, Cell c) { s.ribDepth = c.number(); }},
    {"seeds", [](FruitShape& s, Cell c) { s.seeds = c.whole(); }},
    {"bend", [](FruitShape& s, Cell c) { s.bend = c.number(); }},
    {"extra", [](FruitShape& s, Cell c) { s.extra = c.oneOf(extraWords); }},
    {"colour", [](FruitShape& s, Cell c) { s.colour = c.colour(); }},
}};

double radiusAt(const FruitShape& shape, double y) {
  const double width = y < shape.widest ? endWidth(shape.base, y / shape.widest) : endWidth(shape.apex, (1 - y) / (1 - shape.widest));
  const double bead = shape.seeds == 0 ? 1 : 1 - 0.14 * (0.5 + 0.5 * std::cos(2 * pi * y * shape.seeds));
  return 0.5 * shape.widthToLength * width * bead;
}

// A point of the body; `around` turns about the axis.
glm::dvec3 bodyPoint(const FruitShape& shape, double y, double around) {
  const double rib = shape.ribs == 0 ? 1 : 1 - shape.ribDepth * (0.5 - 0.5 * std::cos(shape.ribs * around));
  const double r = radiusAt(shape, y) * rib;
  return {r * std::sin(around) + shape.bend * 4 * y * (1 - y), y, r * std::cos(around) * (1 - shape.flatness)};
}

glm::dvec3 bodyNormal(const FruitShape& shape, double y, double around) {
  constexpr double h = 1e-4;
  const double low = std::max(y - h, 0.0);
  const double high = std::min(y + h, 1.0);
  const glm::dvec3 up = bodyPoint(shape, high, around) - bodyPoint(shape, low, around);
  const glm::dvec3 round = bodyPoint(shape, y, around + h) - bodyPoint(shape, y, around - h);
  return glm::normalize(glm::cross(round, up));
}

struct Fineness {
  int rings;
  int sides;
};

Fineness finenessOf(const FruitShape& shape, Detail detail) {
  const bool round = shape.ribs == 0 && shape.seeds == 0;
  switch (detail) {
    case Detail::Close: return round ? Fineness{14, 28} : Fineness{std::max(14, 4 * shape.seeds), std::max(20, 6 * shape.ribs)};
    case Detail::Medium: return Fineness{5, 7};
    case Detail::Far: return {3, 3};
  }
  return {3, 3};
}

// Ribs and beads are too small to be seen from afar, and too few rings would show them wrongly.
FruitShape simplified(FruitShape shape, Detail detail) {
  if (detail == Detail::Close) return shape;
  shape.widthToLength *= 1 - 0.5 * shape.ribDepth;
  shape.ribs = 0;
  shape.seeds = 0;
  return shape;
}

Mesh bodyOf(const FruitShape& fruit, Detail detail) {
  const FruitShape shape = simplified(fruit, detail);
  const Fineness f = finenessOf(shape, detail);
  Mesh mesh;
  const auto add = [&](const glm::dvec3& p, const glm::dvec3& n, double u, double v) {
    mesh.positions.emplace_back(p);
    mesh.normals.emplace_back(n);
    mesh.uvs.emplace_back(u, v);
  };
  add(bodyPoint(shape, 0, 0) * glm::dvec3{0, 1, 0}, {0, -1, 0}, 0.5, 0);
  for (int ring = 1; ring < f.rings; ++ring) {
    const double y = 0.5 - 0.5 * std::cos(pi * ring / f.rings);  // rings gather at the ends, where the body is round
    for (int s = 0; s <= f.sides; ++s) {
      const double around = 2 * pi * (s % f.sides) / f.sides;
      add(bodyPoint(shape, y, around), bodyNormal(shape, y, around), static_cast<double>(s) / f.sides, y);
    }
  }
  add({0, 1, 0}, {0, 1, 0}, 0.5, 1);
  const auto at = [&](int ring, int side) { return static_cast<std::uint32_t>(1 + (ring - 1) * (f.sides + 1) + side); };
  const auto top = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int s = 0; s < f.sides; ++s) {
    mesh.triangles.insert(mesh.triangles.end(), {0u, at(1, s + 1), at(1, s)});
    for (int ring = 1; ring + 1 < f.rings; ++ring)
      mesh.triangles.insert(mesh.triangles.end(), {at(ring, s), at(ring, s + 1), at(ring + 1, s + 1), at(ring, s), at(ring + 1, s + 1), at(ring + 1, s)});
    mesh.triangles.insert(mesh.triangles.end(), {at(f.rings - 1, s), at(f.rings - 1, s + 1), top});
  }
  return mesh;
}

glm::dmat4 placed(const glm::dvec3& side, const glm::dvec3& along, const glm::dvec3& face, const glm::dvec3& foot) {
  return {glm::dvec4(side, 0), glm::dvec4(along, 0), glm::dvec4(face, 0), glm::dvec4(foot, 1)};
}

Mesh lightBlade(const char* name, double widthToLength) {
  const std::optional<LeafShape> shape = leafShapeNamed(name);
  AXIL_ASSERT(shape.has_value(), "a fruit uses a blade that leaf_shapes.tsv does not have");
  return leafParts(*shape, widthToLength, Detail::Far).front().mesh;
}

// Five small teeth that stand round the foot of the fruit.
Part calyxOf(const FruitShape& shape) {
  Part part{"calyx", {0.14f, 0.28f, 0.06f}, {}};
  const Mesh tooth = lightBlade("lanceolate", 0.45);
  const double length = 0.35 * std::min(1.0, shape.widthToLength);
  for (int i = 0; i < 5; ++i) {
    const double turn = 2 * pi * i / 5;
    const glm::dvec3 out{std::sin(turn), 0, std::cos(turn)};
    const glm::dvec3 along = glm::normalize(out + glm::dvec3{0, 0.1, 0});
    const glm::dvec3 face = glm::normalize(glm::dvec3{0, 1, 0} - along * along.y);
    append(part.mesh, transformed(tooth, placed(glm::cross(along, face) * length, along * length, face * length, {0, -0.015, 0})));
  }
  return part;
}

Part cupOf(const FruitShape& shape, Detail detail) {
  const double r = 0.55 * shape.widthToLength;
  const std::vector<glm::dvec2> profile{{0, -0.06}, {0.6 * r, -0.03}, {0.98 * r, 0.16}, {1.04 * r, 0.34}, {0.9 * r, 0.36}};
  return {"cup", {0.22f, 0.14f, 0.06f}, revolved(profile, detail == Detail::Close ? 14 : detail == Detail::Medium ? 8 : 4)};
}

// The nut of a samara fills the lower third; its wing goes on to the tip, broadest beyond the middle.
Part wingOf(const FruitShape& shape, Detail detail) {
  std::optional<LeafShape> blade = leafShapeNamed("oblanceolate");
  AXIL_ASSERT(blade.has_value(), "leaf_shapes.tsv has no oblanceolate blade for a samara's wing");
  blade->bend = 0.06;
  blade->fold = 0.05;
  return {"wing", shape.colour * 1.5f, leafParts(*blade, 0.32, detail == Detail::Close ? Detail::Medium : Detail::Far).front().mesh};
}

// Small balls (or scales) laid over the body along a spiral, as in blackberries and cones.
template <class Place>
void alongSpiral(int count, Place place) {
  constexpr double golden = 2.399963229728653;
  for (int i = 0; i < count; ++i) place((i + 0.5) / count, i * golden);
}

Part drupeletsOf(const FruitShape& shape, Detail detail) {
  Part part{"flesh", shape.colour, {}};
  FruitShape ball;
  ball.base = ball.apex = {2, 0.5};
  const Mesh one = bodyOf(ball, detail == Detail::Close ? Detail::Medium : Detail::Far);
  const double size = 0.30 * shape.widthToLength;
  alongSpiral(detail == Detail::Close ? 44 : 24, [&](double share, double turn) {
    const double y = 0.06 + 0.86 * share;
    const glm::dvec3 p = bodyPoint(shape, y, turn);
    append(part.mesh, transformed(one, placed({size, 0, 0}, {0, size, 0}, {0, 0, size}, p * 0.86 + glm::dvec3{0, 0.07 - 0.5 * size, 0})));
  });
  return part;
}

Part scalesOf(const FruitShape& shape, Detail detail) {
  Part part{"scale", shape.colour, {}};
  const Mesh scale = lightBlade("obovate", 0.95);
  const double size = 0.42 * shape.widthToLength;
  alongSpiral(detail == Detail::Close ? 48 : detail == Detail::Medium ? 28 : 12, [&](double share, double turn) {
    const double y = 0.04 + 0.86 * share;
    const glm::dvec3 out{std::sin(turn), 0, std::cos(turn)};
    const glm::dvec3 along = glm::normalize(out * (0.75 - 0.45 * share) + glm::dvec3{0, 0.7, 0});
    const glm::dvec3 face = glm::normalize(-out + along * glm::dot(out, along));
    append(part.mesh, transformed(scale, placed(glm::cross(along, face) * size, along * size, face * size, bodyPoint(shape, y, turn) * glm::dvec3{0.75, 1, 0.75})));
  });
  return part;
}

// The nut of a samara is the body, a third as long as the whole.
Mesh nutOf(const FruitShape& shape, Detail detail) {
  return transformed(bodyOf(shape, detail), placed({0.34, 0, 0}, {0, 0.34, 0}, {0, 0, 0.34}, {0, 0, 0}));
}

}  // namespace

const std::vector<FruitShape>& fruitShapes() {
  static const std::vector<FruitShape> shapes = ShapeTable<FruitShape>(data::fruit_shapes, "fruit_shapes.tsv", columns).shapes();
  return shapes;
}

std::optional<FruitShape> fruitShapeNamed(std::string_view name) { return namedIn(fruitShapes(), name); }

std::vector<Part> fruitParts(const FruitShape& shape, Detail detail) {
  const Part body{"flesh", shape.colour, shape.extra == FruitExtra::Wing ? nutOf(shape, detail) : bodyOf(shape, detail)};
  switch (shape.extra) {
    case FruitExtra::None: return {body};
    case FruitExtra::Calyx: return detail == Detail::Far ? std::vector<Part>{body} : std::vector<Part>{body, calyxOf(shape)};
    case FruitExtra::Cup: return {body, cupOf(shape, detail)};
    case FruitExtra::Wing: return {body, wingOf(shape, detail)};
    case FruitExtra::Drupelets: return detail == Detail::Far ? std::vector<Part>{body} : std::vector<Part>{body, drupeletsOf(shape, detail)};
    case FruitExtra::Scales: return {body, scalesOf(shape, detail)};
  }
  return {body};
}

}  // namespace axil::organs
