#include "organs/leaf.hpp"

#include "organs/flat_shapes.hpp"
#include "organs/leaf_posture.hpp"
#include "organs/mesh_tools.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axil::organs {

namespace {

const glm::vec3 bladeColour{0.15f, 0.33f, 0.06f};
const glm::vec3 veinColour{0.26f, 0.43f, 0.13f};

struct Fineness {
  std::size_t rulings;
  int columns;
};

bool isCut(const LeafShape& shape) { return shape.lobes != LeafLobes::None; }
bool isToothed(const LeafShape& shape) { return shape.teeth > 0 && shape.margin != LeafMargin::Ciliate; }

Fineness closeFineness(const LeafShape& shape) {
  std::size_t rulings = 20;
  if (shape.lobes == LeafLobes::Pinnate) rulings += static_cast<std::size_t>(6 * std::max(0, shape.lobeCount));
  if (shape.lobes == LeafLobes::Palmate) rulings += static_cast<std::size_t>(5 * std::max(0, shape.lobeCount));
  if (isToothed(shape)) rulings += static_cast<std::size_t>((shape.margin == LeafMargin::DoublySerrate ? 6 : 3) * shape.teeth);
  rulings = std::min<std::size_t>(rulings, 84);
  return {rulings, rulings > 50 ? 1 : rulings > 20 ? 2 : 3};
}

Fineness finenessOf(const LeafShape& shape, Detail detail) {
  switch (detail) {
    case Detail::Close: return closeFineness(shape);
    case Detail::Medium: return isCut(shape) ? Fineness{15, 1} : Fineness{11, 1};
    case Detail::Far: return shape.lobes == LeafLobes::Palmate ? Fineness{6, 1} : Fineness{4, 1};
  }
  return {4, 1};
}

// What is too small to be seen at a level of detail is left out; a cut blade keeps about its area.
LeafShape simplified(LeafShape shape, Detail detail) {
  if (detail == Detail::Close) return shape;
  shape.teeth = 0;
  if (detail == Detail::Far) {
    shape.tailLength = 0;
    shape.apexNotch = 0;
    if (shape.baseLobes == BaseLobes::Auricles) shape.baseLobes = BaseLobes::None;
  }
  if (detail == Detail::Far && shape.lobes == LeafLobes::Pinnate) {
    shape.lobes = LeafLobes::None;
    shape.widthToLength *= 1 - 0.4 * shape.lobeDepth;
  }
  return shape;
}

Part sheetOf(const LeafShape& shape, Detail detail) {
  const LeafShape simple = simplified(shape, detail);
  const Fineness fineness = finenessOf(simple, detail);
  const std::vector<Ruling> right = rulingsOf(simple, fineness.rulings);
  Part blade{"blade", bladeColour, halfBlade(simple, right, fineness.columns, 1)};
  append(blade.mesh, halfBlade(simple, leftOf(right, simple), fineness.columns, -1));
  return blade;
}

// Whether every triangle, seen from above, faces up as its normals do.
bool facesUp(const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t i = mesh.triangles[t], j = mesh.triangles[t + 1], k = mesh.triangles[t + 2];
    const glm::dvec3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const glm::dvec3 shaded = glm::dvec3(mesh.normals[i]) + glm::dvec3(mesh.normals[j]) + glm::dvec3(mesh.normals[k]);
    if (normal.z <= 0 || glm::dot(normal, shaded) <= 0 || glm::length(normal) < 1e-9) return false;
  }
  return true;
}

// A blade of few long triangles can't take any bow: it is laid flatter until no triangle stands on edge.
LeafShape flatEnough(LeafShape shape, Detail detail) {
  for (int attempt = 0; attempt < 4 && !facesUp(sheetOf(shape, detail).mesh); ++attempt) {
    const double relief = attempt < 3 ? 0.4 : 0;
    shape.arch *= relief;
    shape.fold *= relief;
    shape.bend *= relief;
  }
  return shape;
}

// A point of the flat leaf lifted onto the blade, `above` its upper side.
glm::dvec3 lifted(const LeafShape& shape, const glm::dvec2& flat, double above) {
  const double x = flat.x - bowedX(shape, 0, flat.y);
  const double side = x < 0 ? -1 : 1;
  return pointAt(shape, side, std::abs(x), flat.y) + glm::dvec3{0, 0, above};
}
glm::dvec3 normalOn(const LeafShape& shape, const glm::dvec2& flat) {
  const double x = flat.x - bowedX(shape, 0, flat.y);
  return normalAt(shape, x < 0 ? -1 : 1, std::max(std::abs(x), 1e-3), flat.y);
}

// Adds a flat polygon that lies just above the blade. Corners in either order; the upper side is up.
void addPatch(Mesh& mesh, const LeafShape& shape, std::vector<glm::dvec2> corners, double above) {
  if (cross2(corners[0], corners[1], corners[2]) < 0) std::reverse(corners.begin(), corners.end());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec2& c : corners) {
    mesh.positions.emplace_back(lifted(shape, c, above));
    mesh.normals.emplace_back(normalOn(shape, c));
    mesh.uvs.emplace_back(std::clamp(0.5 + c.x / std::max(shape.widthToLength, 1e-3), 0.0, 1.0), std::clamp(c.y, 0.0, 1.0));
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) mesh.triangles.insert(mesh.triangles.end(), {first, first + i, first + i + 1});
}

// A line of `thickness` as a ribbon that tapers to a third.
void addRibbon(Mesh& mesh, const LeafShape& shape, const std::vector<glm::vec2>& line, double thickness, double above) {
  const auto widthAt = [&](std::size_t i) { return thickness * (1 - 0.67 * static_cast<double>(i) / static_cast<double>(line.size() - 1)); };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 a = line[i], b = line[i + 1];
    if (glm::distance(a, b) < 1e-5) continue;
    const glm::dvec2 along = glm::normalize(b - a);
    const glm::dvec2 across{-along.y, along.x};
    addPatch(mesh, shape, {a - across * (0.5 * widthAt(i)), b - across * (0.5 * widthAt(i + 1)), b + across * (0.5 * widthAt(i + 1)), a + across * (0.5 * widthAt(i))}, above);
  }
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

// The side veins; the finest of a net are left to pictures of the outline.
void addVeins(std::vector<Part>& parts, const LeafShape& shape) {
  Part part{"vein", veinColour, {}};
  const std::vector<LeafVein> veins = leafVeins(shape);
  for (std::size_t i = shape.veins == LeafVeins::Dichotomous ? 0 : 1; i < veins.size() && i < 40; ++i) {
    std::vector<glm::vec2> coarse;
    const std::vector<glm::vec2>& line = veins[i].points;
    const std::size_t step = std::max<std::size_t>(1, line.size() / 5);
    for (std::size_t k = 0; k + 1 < line.size(); k += step) coarse.push_back(line[k]);
    coarse.push_back(line.back());
    addRibbon(part.mesh, shape, coarse, veins[i].thickness, 0.0035);
  }
  if (!part.mesh.triangles.empty()) parts.push_back(std::move(part));
}

void addSpots(std::vector<Part>& parts, const LeafShape& shape) {
  Part part{"spot", shape.spotColour, {}};
  for (const std::vector<glm::vec2>& spot : leafSpots(shape)) addPatch(part.mesh, shape, {spot.begin(), spot.end()}, 0.005);
  if (!part.mesh.triangles.empty()) parts.push_back(std::move(part));
}

void addHairs(std::vector<Part>& parts, const LeafShape& shape) {
  Part part{"hair", {0.45f, 0.50f, 0.30f}, {}};
  for (const std::vector<glm::vec2>& hair : leafHairs(shape)) addRibbon(part.mesh, shape, hair, 0.006, 0);
  if (!part.mesh.triangles.empty()) parts.push_back(std::move(part));
}

// Only a stub: how long a petiole is belongs to the plant, not to the blade. Needles and grass-like blades have none.
Part petioleOf(const LeafShape& shape, Detail detail) {
  const double thick = std::min(0.014, 0.09 * shape.widthToLength);
  const std::array<glm::dvec3, 2> path{glm::dvec3{0, -0.07, -0.25 * 0.07}, glm::dvec3{0, 0.02, 0}};
  const std::array<double, 2> radii{1.2 * thick, 0.9 * thick};
  return {"petiole", {0.26f, 0.38f, 0.11f}, tube(path, radii, detail == Detail::Close ? 6 : 3)};
}

}  // namespace

std::vector<glm::vec2> leafOutline(const LeafShape& shape) {
  constexpr std::size_t fine = 240;
  const std::vector<Ruling> right = rulingsOf(shape, fine);
  const std::vector<Ruling> left = leftOf(right, shape);
  std::vector<glm::vec2> outline;
  const auto add = [&](double x, double y) {
    const glm::vec2 point(bowedX(shape, x, y), y);
    if (outline.empty() || glm::distance(point, outline.back()) > 1e-6f) outline.push_back(point);
  };
  add(0, shape.shield > 0 ? std::min(0.0, right.front().margin.y) : 0);
  for (const Ruling& r : right) add(r.margin.x, r.margin.y);
  add(0, 1);
  for (auto r = left.rbegin(); r != left.rend(); ++r) add(-r->margin.x, r->margin.y);
  if (glm::distance(outline.front(), outline.back()) < 1e-6f) outline.pop_back();
  return outline;
}

std::vector<Part> leafParts(const LeafShape& shape, std::optional<double> widthToLength, Detail detail) {
  const LeafShape wanted = flatEnough(widthToLength ? withWidth(shape, *widthToLength) : shape, detail);
  std::vector<Part> parts{sheetOf(wanted, detail)};
  if (detail == Detail::Close) {
    parts.push_back(midribOf(wanted));
    addVeins(parts, wanted);
    addHairs(parts, wanted);
  }
  if (detail != Detail::Far) {
    addSpots(parts, wanted);
    parts.push_back(petioleOf(wanted, detail));
  }
  return parts;
}

}  // namespace axil::organs
