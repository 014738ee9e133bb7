#include "organs/leaf.hpp"

#include "organs/data.hpp"
#include "organs/leaf_rulings.hpp"
#include "organs/mesh_tools.hpp"
#include "organs/shape_table.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace axil::organs {

namespace {

// ---- the table

constexpr std::array<std::pair<std::string_view, BaseLobes>, 4> baseLobeWords{
    {{"-", BaseLobes::None}, {"round", BaseLobes::Round}, {"pointed", BaseLobes::Pointed}, {"ears", BaseLobes::Ears}}};
constexpr std::array<std::pair<std::string_view, LeafLobes>, 4> lobeWords{
    {{"-", LeafLobes::None}, {"pinnate", LeafLobes::Pinnate}, {"palmate", LeafLobes::Palmate}, {"peltate", LeafLobes::Peltate}}};
constexpr std::array<std::pair<std::string_view, LeafMargin>, 5> marginWords{{{"entire", LeafMargin::Entire},
                                                                             {"serrate", LeafMargin::Serrate},
                                                                             {"dentate", LeafMargin::Dentate},
                                                                             {"crenate", LeafMargin::Crenate},
                                                                             {"undulate", LeafMargin::Undulate}}};

template <class T, std::size_t N>
T wordIn(const std::array<std::pair<std::string_view, T>, N>& words, std::string_view word) {
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == word; });
  AXIL_ASSERT(found != words.end(), "leaf_shapes.tsv has a word that is none of its column's");
  return found->second;
}

LeafShape shapeOf(const Table& table, const Table::Row& row) {
  const ShapeRow cells{table, row};
  LeafShape shape;
  shape.name = cells.text("name");
  shape.widthToLength = cells.number("widthToLength");
  shape.widest = cells.number("widest");
  shape.base = {cells.number("baseShoulder"), cells.number("baseEnd")};
  shape.apex = {cells.number("apexShoulder"), cells.number("apexEnd")};
  shape.baseLobes = wordIn(baseLobeWords, cells.text("baseLobes"));
  shape.baseLobeDepth = cells.number("baseLobeDepth");
  shape.apexNotch = cells.number("apexNotch");
  shape.lobes = wordIn(lobeWords, cells.text("lobes"));
  shape.lobeCount = cells.whole("lobeCount");
  shape.lobeDepth = cells.number("lobeDepth");
  shape.lobedUpTo = cells.number("lobedUpTo");
  shape.margin = wordIn(marginWords, cells.text("margin"));
  shape.teeth = cells.whole("teeth");
  shape.toothDepth = cells.number("toothDepth");
  shape.bend = cells.number("bend");
  shape.oblique = cells.number("oblique");
  shape.arch = cells.number("arch");
  shape.fold = cells.number("fold");
  return shape;
}

// ---- the posture: a height over the flat blade, so that what does not overlap when flat does not overlap in space

double bowedX(const LeafShape& shape, double x, double y) { return x + shape.bend * 4 * y * (1 - y); }

double archAt(const LeafShape& shape, double y) { return shape.arch * 4 * y * (1 - y) * (0.75 + 0.5 * y); }

// Each half rises from the midrib and turns down again towards the margin.
double heightAt(const LeafShape& shape, double x, double y) {
  const double s = x / (0.5 * shape.widthToLength);
  double height = archAt(shape, y) + shape.fold * x * (1 - 0.55 * s);
  if (shape.margin == LeafMargin::Undulate) height += 0.10 * shape.widthToLength * s * s * std::sin(2 * std::numbers::pi * 4 * y);
  return height;
}

glm::dvec3 pointAt(const LeafShape& shape, double side, double x, double y) { return {bowedX(shape, side * x, y), y, heightAt(shape, x, y)}; }

glm::dvec3 normalAt(const LeafShape& shape, double side, double x, double y) {
  constexpr double h = 1e-4;
  const glm::dvec3 dx = pointAt(shape, side, x + h, y) - pointAt(shape, side, x - h, y);
  const glm::dvec3 dy = pointAt(shape, side, x, y + h) - pointAt(shape, side, x, y - h);
  return glm::normalize(side * glm::cross(dx, dy));
}

// ---- one half as a sheet

// Vertices of one half, the same place always the same vertex. Halves do not share vertices: the midrib is a crease.
class HalfSheet {
 public:
  HalfSheet(const LeafShape& shape, double side) : shape_(shape), side_(side) {}

  std::uint32_t vertexAt(const glm::dvec2& flat) {
    const std::pair key{std::llround(flat.x * 1e7), std::llround(flat.y * 1e7)};
    const auto [place, isNew] = byPlace_.try_emplace(key, static_cast<std::uint32_t>(flat_.size()));
    if (isNew) flat_.push_back(flat);
    return place->second;
  }
  // Corners in the order that is counter-clockwise on the right half. Corners that fell together make no triangle.
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || c == a) return;
    if (side_ < 0) std::swap(b, c);
    triangles_.insert(triangles_.end(), {a, b, c});
  }
  double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const glm::dvec2 u = flat_[b] - flat_[a];
    const glm::dvec2 v = flat_[c] - flat_[a];
    return u.x * v.y - u.y * v.x;
  }
  // The diagonal that leaves the larger of the two smaller triangles.
  void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (a == b || b == c || c == d || d == a) {
      addTriangle(a, b, c);
      addTriangle(a, c, d);
    } else if (std::min(area(a, b, c), area(a, c, d)) >= std::min(area(a, b, d), area(b, c, d))) {
      addTriangle(a, b, c);
      addTriangle(a, c, d);
    } else {
      addTriangle(a, b, d);
      addTriangle(b, c, d);
    }
  }
  Mesh mesh() const {
    Mesh mesh;
    for (const glm::dvec2& f : flat_) {
      mesh.positions.emplace_back(pointAt(shape_, side_, f.x, f.y));
      mesh.normals.emplace_back(normalAt(shape_, side_, f.x, f.y));
      mesh.uvs.emplace_back(std::clamp(0.5 + side_ * f.x / shape_.widthToLength, 0.0, 1.0), std::clamp(f.y, 0.0, 1.0));
    }
    mesh.triangles = triangles_;
    return mesh;
  }

 private:
  const LeafShape& shape_;
  double side_;
  std::vector<glm::dvec2> flat_;
  std::vector<std::uint32_t> triangles_;
  std::map<std::pair<long long, long long>, std::uint32_t> byPlace_;
};

Mesh halfMesh(const LeafShape& shape, const std::vector<Ruling>& rulings, int columns, double side) {
  HalfSheet sheet(shape, side);
  const auto at = [&](const Ruling& r, int column) {
    const double s = static_cast<double>(column) / columns;
    return sheet.vertexAt(glm::dvec2{0, r.foot} * (1 - s) + r.margin * s);
  };
  for (std::size_t i = 0; i + 1 < rulings.size(); ++i)
    for (int c = 0; c < columns; ++c) {
      // One after another: vertices are numbered as they are first met, and compilers evaluate arguments in different orders.
      const std::uint32_t inner = at(rulings[i], c);
      const std::uint32_t outer = at(rulings[i], c + 1);
      const std::uint32_t nextOuter = at(rulings[i + 1], c + 1);
      const std::uint32_t nextInner = at(rulings[i + 1], c);
      sheet.addQuad(inner, outer, nextOuter, nextInner);
    }
  return sheet.mesh();
}

// ---- the parts

struct Fineness {
  std::size_t rulings;
  int columns;
};

bool isCut(const LeafShape& shape) { return shape.lobes == LeafLobes::Pinnate || shape.lobes == LeafLobes::Palmate; }
bool isToothed(const LeafShape& shape) { return shape.teeth > 0; }

Fineness finenessOf(const LeafShape& shape, Detail detail) {
  switch (detail) {
    case Detail::Close: return isCut(shape) || isToothed(shape) ? Fineness{32, 2} : Fineness{20, 3};
    case Detail::Medium: return isCut(shape) ? Fineness{15, 1} : Fineness{11, 1};
    case Detail::Far: return shape.lobes == LeafLobes::Palmate ? Fineness{6, 1} : Fineness{4, 1};
  }
  return {4, 1};
}

// What is too small to be seen at a level of detail is left out; a cut blade keeps about its area.
LeafShape simplified(LeafShape shape, Detail detail) {
  if (detail == Detail::Close) return shape;
  shape.teeth = 0;
  if (detail == Detail::Far && shape.lobes == LeafLobes::Pinnate) {
    shape.lobes = LeafLobes::None;
    shape.widthToLength *= 1 - 0.4 * shape.lobeDepth;
  }
  return shape;
}

Part bladeOf(const LeafShape& shape, Detail detail) {
  const LeafShape simple = simplified(shape, detail);
  const Fineness fineness = finenessOf(simple, detail);
  const std::vector<Ruling> right = rulingsOf(simple, fineness.rulings);
  Part blade{"blade", {0.15f, 0.33f, 0.06f}, halfMesh(simple, right, fineness.columns, 1)};
  append(blade.mesh, halfMesh(simple, leftOf(right, simple), fineness.columns, -1));
  return blade;
}

// A thin tapering tube in the crease, seen from both sides.
Part midribOf(const LeafShape& shape) {
  constexpr int segments = 7;
  const double thick = std::min(0.011, 0.06 * shape.widthToLength);
  std::vector<glm::dvec3> path;
  std::vector<double> radii;
  for (int i = 0; i <= segments; ++i) {
    const double y = 0.97 * i / segments;
    path.push_back(pointAt(shape, 1, 0, y));
    radii.push_back(thick * (1 - 0.85 * y));
  }
  return {"midrib", {0.34f, 0.47f, 0.16f}, tube(path, radii, 3)};
}

// Only a stub: how long a petiole is belongs to the plant, not to the blade. Needles and grass-like blades have none.
Part petioleOf(const LeafShape& shape, Detail detail) {
  const double thick = std::min(0.014, 0.09 * shape.widthToLength);
  const std::array<glm::dvec3, 2> path{glm::dvec3{0, -0.07, -0.25 * 0.07}, glm::dvec3{0, 0.02, 0}};
  const std::array<double, 2> radii{1.2 * thick, 0.9 * thick};
  return {"petiole", {0.26f, 0.38f, 0.11f}, tube(path, radii, detail == Detail::Close ? 6 : 3)};
}

}  // namespace

const std::vector<LeafShape>& leafShapes() {
  static const std::vector<LeafShape> shapes = readShapeTable<LeafShape>(data::leaf_shapes, "leaf_shapes.tsv", shapeOf);
  return shapes;
}

std::optional<LeafShape> leafShapeNamed(std::string_view name) {
  return namedIn(leafShapes(), name);
}

LeafShape withWidth(LeafShape shape, double widthToLength) {
  shape.widthToLength = std::clamp(widthToLength, 0.005, 3.0);
  return shape;
}

std::vector<glm::vec2> leafOutline(const LeafShape& shape) {
  constexpr std::size_t fine = 160;
  const std::vector<Ruling> right = rulingsOf(shape, fine);
  const std::vector<Ruling> left = leftOf(right, shape);
  std::vector<glm::vec2> outline;
  const auto add = [&](double x, double y) {
    const glm::vec2 point(bowedX(shape, x, y), y);
    if (outline.empty() || glm::distance(point, outline.back()) > 1e-6f) outline.push_back(point);
  };
  if (shape.lobes != LeafLobes::Peltate) add(0, 0);
  for (const Ruling& r : right) add(r.margin.x, r.margin.y);
  add(0, 1);
  for (auto r = left.rbegin(); r != left.rend(); ++r) add(-r->margin.x, r->margin.y);
  if (glm::distance(outline.front(), outline.back()) < 1e-6f) outline.pop_back();
  return outline;
}

std::vector<Part> leafParts(const LeafShape& shape, std::optional<double> widthToLength, Detail detail) {
  const LeafShape wanted = widthToLength ? withWidth(shape, *widthToLength) : shape;
  std::vector<Part> parts{bladeOf(wanted, detail)};
  if (detail == Detail::Close) parts.push_back(midribOf(wanted));
  if (detail != Detail::Far) parts.push_back(petioleOf(wanted, detail));
  return parts;
}

}  // namespace axil::organs
