#include "quantify/compare.hpp"

#include "base/text.hpp"
#include "quantify/phyllotaxis.hpp"
#include "quantify/plant_nodes.hpp"
#include "quantify/structure.hpp"
#include "quantify/tree_edit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace axil::quantify {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// ---- nodes -----------------------------------------------------------------------------------------------------------

/// For each node of A the node of B that is the same, or -1.
std::vector<int> matchesOf(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, double tolerance) {
  // Along one axis sorted, so that only neighbours are looked at.
  std::vector<std::size_t> order(b.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return std::pair(b[x].y, x) < std::pair(b[y].y, y); });
  struct Pair {
    double distance;
    std::size_t a, b;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto first = std::lower_bound(order.begin(), order.end(), a[i].y - tolerance, [&](std::size_t n, double y) { return b[n].y < y; });
    for (auto it = first; it != order.end() && b[*it].y <= a[i].y + tolerance; ++it)
      if (const double d = glm::distance(a[i], b[*it]); d <= tolerance) pairs.push_back({d, i, *it});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return std::tuple(x.distance, x.a, x.b) < std::tuple(y.distance, y.a, y.b); });
  std::vector<int> matches(a.size(), -1);
  std::vector<bool> taken(b.size(), false);
  for (const Pair& pair : pairs) {
    if (matches[pair.a] >= 0 || taken[pair.b]) continue;
    matches[pair.a] = static_cast<int>(pair.b);
    taken[pair.b] = true;
  }
  return matches;
}

void add(Deviation& deviation, double value) {
  deviation.mean += (value - deviation.mean) / static_cast<double>(++deviation.samples);
  deviation.worst = std::max(deviation.worst, value);
}

void compareNodes(const Measurements& a, const Measurements& b, double tolerance, PlantComparison& result) {
  const auto nodesA = nodesOf(a);
  const auto nodesB = nodesOf(b);
  const std::vector<int> matches = matchesOf(nodesA, nodesB, tolerance);
  result.nodesA = nodesA.size();
  result.nodesB = nodesB.size();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    ++result.matched;
    add(result.place, glm::distance(nodesA[i], nodesB[at(matches[i])]));
  }
  result.recall = static_cast<double>(result.matched) / static_cast<double>(result.nodesA);
  result.precision = static_cast<double>(result.matched) / static_cast<double>(result.nodesB);
  for (std::size_t s = 0; s < a.segments.size(); ++s) {
    const Segment& own = a.segments[s];
    const int tip = matches[s + 1];
    const int base = matches[own.parent ? at(own.parent->value) + 1 : 0];
    if (tip <= 0 || base < 0) continue;
    const Segment& other = b.segments[at(tip) - 1];
    if ((other.parent ? other.parent->value + 1 : 0) != base) continue;
    add(result.length, std::abs(own.length - other.length));
    add(result.angle, angleBetween(own.direction, other.direction).radians());
  }
}

// ---- divergence ------------------------------------------------------------------------------------------------------

std::optional<double> divergenceOf(const Measurements& m, OrgansAround organs) {
  const PlantStructure structure = plantStructure(m);
  const MeasuredPlant plant{&m, &structure};
  const Phyllotaxis p = phyllotaxisOf(std::span(&plant, 1), organs);
  if (p.samples == 0) return std::nullopt;
  return p.divergence.radians();
}
std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return std::nullopt;
  return std::abs(*a - *b);
}

// ---- silhouettes -----------------------------------------------------------------------------------------------------

struct Flat {
  double x = 0, y = 0;
};
Flat seenFrom(SilhouetteView view, const glm::dvec3& p) {
  if (view == SilhouetteView::Front) return {p.x, p.y};
  if (view == SilhouetteView::Right) return {-p.z, p.y};
  return {p.x, -p.z};
}

class Silhouette {
 public:
  Silhouette(SilhouetteView view, const Box& box, double thinnest, int cells) : view_(view), thinnest_(thinnest) {
    const Flat a = seenFrom(view, box.low);
    const Flat b = seenFrom(view, box.high);
    low_ = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const double width = std::abs(a.x - b.x);
    const double height = std::abs(a.y - b.y);
    cell_ = std::max({width, height, thinnest}) / cells;
    columns_ = static_cast<int>(std::ceil(width / cell_)) + 1;
    rows_ = static_cast<int>(std::ceil(height / cell_)) + 1;
    covered_.assign(at(columns_) * at(rows_), false);
  }
  void draw(const Measurements& m, const std::vector<glm::dvec3>& nodes) {
    for (std::size_t s = 0; s < m.segments.size(); ++s) {
      const Segment& own = m.segments[s];
      const glm::dvec3& base = nodes[own.parent ? at(own.parent->value) + 1 : 0];
      capsule(base, nodes[s + 1], std::max(thinnest_, own.radius.value_or(0)));
      for (const LeafMeasure& leaf : own.leaves) blade(nodes[s + 1], leaf);
    }
    for (const LeafMeasure& leaf : m.rootLeaves) blade(nodes[0], leaf);
  }
  [[nodiscard]] const std::vector<bool>& covered() const { return covered_; }

 private:
  void blade(const glm::dvec3& node, const LeafMeasure& leaf) {
    const glm::dvec3 base = node + leaf.direction.unit() * leaf.petiole;
    capsule(node, base, thinnest_);
    // A row of strokes across the blade, as wide as a diamond is there.
    const double width = leaf.width > 0 ? leaf.width : leaf.length / 2;
    const glm::dvec3 across = glm::normalize(glm::cross(leaf.direction.unit(), leaf.normal.unit())) * (width / 2);
    const int strokes = std::max(2, static_cast<int>(leaf.length / cell_) + 1);
    for (int i = 0; i <= strokes; ++i) {
      const double t = static_cast<double>(i) / strokes;
      const glm::dvec3 middle = base + leaf.direction.unit() * (leaf.length * t);
      const double share = 1 - std::abs(2 * t - 1);
      capsule(middle - across * share, middle + across * share, cell_ / 2);
    }
  }
  /// Cells whose centres are within `radius` of the line.
  void capsule(const glm::dvec3& from, const glm::dvec3& to, double radius) {
    const Flat a = inCells(from);
    const Flat b = inCells(to);
    const double r = std::max(0.71, radius / cell_);  // a line leaves no gap
    const int left = std::max(0, static_cast<int>(std::floor(std::min(a.x, b.x) - r)));
    const int right = std::min(columns_ - 1, static_cast<int>(std::ceil(std::max(a.x, b.x) + r)));
    const int bottom = std::max(0, static_cast<int>(std::floor(std::min(a.y, b.y) - r)));
    const int top = std::min(rows_ - 1, static_cast<int>(std::ceil(std::max(a.y, b.y) + r)));
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    for (int y = bottom; y <= top; ++y)
      for (int x = left; x <= right; ++x) {
        const double t = square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0) : 0;
        if (std::hypot(x - a.x - t * dx, y - a.y - t * dy) <= r) covered_[at(y) * at(columns_) + at(x)] = true;
      }
  }
  [[nodiscard]] Flat inCells(const glm::dvec3& p) const {
    const Flat seen = seenFrom(view_, p);
    return {(seen.x - low_.x) / cell_, (seen.y - low_.y) / cell_};
  }

  SilhouetteView view_;
  double thinnest_;
  Flat low_;
  double cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> covered_;
};

double overlap(const Measurements& a, const Measurements& b, SilhouetteView view, double height, int cells) {
  const auto nodesA = nodesOf(a);
  const auto nodesB = nodesOf(b);
  Box box = boxOf(nodesA);
  const Box other = boxOf(nodesB);
  box = {glm::min(box.low, other.low), glm::max(box.high, other.high)};
  Silhouette first(view, box, 0.005 * height, cells);
  Silhouette second(view, box, 0.005 * height, cells);
  first.draw(a, nodesA);
  second.draw(b, nodesB);
  std::size_t both = 0;
  std::size_t either = 0;
  for (std::size_t i = 0; i < first.covered().size(); ++i) {
    both += first.covered()[i] && second.covered()[i];
    either += first.covered()[i] || second.covered()[i];
  }
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

}  // namespace

Result<PlantComparison> comparePlants(const Measurements& a, const Measurements& b, const CompareOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance <= 1) || options.silhouette_cells < 16 || options.silhouette_cells > 4096)
    return fail(ErrorCode::BadInput, "a tolerance of " + shortest(options.tolerance) + " or " + std::to_string(options.silhouette_cells) +
                                         " silhouette cells is not possible; give a tolerance above 0 up to 1 and 16 to 4096 cells");
  if (a.segments.empty() || b.segments.empty()) return fail(ErrorCode::NoAnswer, "a plant without a segment cannot be compared; measure one stem at least");
  if (a.unit != b.unit) return fail(ErrorCode::BadInput, "the plants' lengths are in " + a.unit + " and in " + b.unit + "; bring both to one unit");
  PlantComparison result;
  result.height = heightOf(nodesOf(a));
  compareNodes(a, b, options.tolerance * result.height, result);
  result.branchDivergence = difference(divergenceOf(a, OrgansAround::Branches), divergenceOf(b, OrgansAround::Branches));
  result.leafDivergence = difference(divergenceOf(a, OrgansAround::Leaves), divergenceOf(b, OrgansAround::Leaves));
  if (a.segments.size() * b.segments.size() <= options.mostPairs) result.treeEdit = treeEditDistance(a, b);
  for (const SilhouetteView view : options.views) result.silhouettes.push_back(overlap(a, b, view, result.height, options.silhouette_cells));
  return result;
}

}  // namespace axil::quantify
