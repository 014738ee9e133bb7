#include "organs/flat_shapes.hpp"
#include "organs/leaf_posture.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace axil::organs {

namespace {

double archAt(const LeafShape& shape, double y) { return shape.arch * 4 * y * (1 - y) * (0.75 + 0.5 * y); }

// Each half rises from the midrib and turns down again towards the margin.
double heightAt(const LeafShape& shape, double x, double y) {
  const double s = x / (0.5 * shape.widthToLength);
  double height = archAt(shape, y) + shape.fold * x * (1 - 0.55 * s);
  if (shape.margin == LeafMargin::Undulate) height += std::min(0.10, shape.fold) * shape.widthToLength * s * s * std::sin(2 * std::numbers::pi * 4 * y);
  return height;
}

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
  // Whether every triangle has the side up that it should have, and is no sliver: slivers stand on edge once they are lifted.
  bool isClean() const {
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      const glm::dvec2 &a = flat_[triangles_[t]], &b = flat_[triangles_[t + 1]], &c = flat_[triangles_[t + 2]];
      const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
      if (side_ * cross2(a, b, c) < std::max(2e-9, 2e-3 * longest * longest)) return false;
    }
    return true;
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

// Strips from ruling to ruling.
void addStrips(HalfSheet& sheet, const std::vector<Ruling>& rulings, int columns) {
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
}

// The half as a polygon: along the margin to the tip, back down the midrib.
std::vector<glm::dvec2> polygonOf(const LeafShape& shape, const std::vector<Ruling>& rulings) {
  constexpr double apart = 1e-7;
  std::vector<glm::dvec2> polygon;
  const auto add = [&](const glm::dvec2& p) {
    if (polygon.empty() || glm::distance(polygon.back(), p) > apart) polygon.push_back(p);
  };
  const double bottom = shape.shield > 0 ? std::min(rulings.front().margin.y, 0.0) : 0;
  add({0, bottom});
  for (const Ruling& r : rulings) add(r.margin);
  add({0, 1});
  for (int tenth = 9; tenth >= 1; --tenth) add({0, 0.1 * tenth});
  if (shape.shield > 0) add({0, 0});
  return polygon;
}

// For halves whose rulings would cross (deep lobes on a notched base, say).
void addEars(HalfSheet& sheet, const std::vector<glm::dvec2>& polygon) {
  for (const auto& triangle : triangulated(polygon)) {
    const std::uint32_t a = sheet.vertexAt(polygon[triangle[0]]);
    const std::uint32_t b = sheet.vertexAt(polygon[triangle[1]]);
    const std::uint32_t c = sheet.vertexAt(polygon[triangle[2]]);
    sheet.addTriangle(a, b, c);
  }
}

}  // namespace

double bowedX(const LeafShape& shape, double x, double y) { return x + shape.bend * 4 * y * (1 - y); }

glm::dvec3 pointAt(const LeafShape& shape, double side, double x, double y) { return {bowedX(shape, side * x, y), y, heightAt(shape, x, y)}; }

glm::dvec3 normalAt(const LeafShape& shape, double side, double x, double y) {
  constexpr double h = 1e-4;
  const glm::dvec3 dx = pointAt(shape, side, x + h, y) - pointAt(shape, side, x - h, y);
  const glm::dvec3 dy = pointAt(shape, side, x, y + h) - pointAt(shape, side, x, y - h);
  return glm::normalize(side * glm::cross(dx, dy));
}

Mesh halfBlade(const LeafShape& shape, const std::vector<Ruling>& rulings, int columns, double side) {
  HalfSheet strips(shape, side);
  addStrips(strips, rulings, columns);
  if (strips.isClean()) return strips.mesh();
  HalfSheet ears(shape, side);
  addEars(ears, polygonOf(shape, rulings));
  return ears.mesh();
}

}  // namespace axil::organs
