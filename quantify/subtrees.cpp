#include "quantify/subtrees.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace axil::quantify {

namespace {

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }

/// Subtree sizes in segments.
std::vector<std::size_t> sizesOf(const Measurements& m) {
  std::vector<std::size_t> sizes(m.segments.size(), 1);
  for (std::size_t s = m.segments.size(); s-- > 0;)
    if (const auto parent = m.segments[s].parent) sizes[placeOf(*parent)] += sizes[s];
  return sizes;
}

/// The child that goes on with the segment's axis first, then branches by class.
std::vector<SegmentId> familyOf(const Measurements& m, const PlantStructure& structure, SegmentId id, const std::vector<std::size_t>& shapeOf) {
  std::vector<SegmentId> children = m.at(id).children;
  const AxisId own = structure.at(id).axis;
  const auto key = [&](SegmentId c) { return std::tuple(structure.at(c).axis != own, shapeOf[placeOf(c)], m.at(c).rotr.radians(), c); };
  std::sort(children.begin(), children.end(), [&](SegmentId a, SegmentId b) { return key(a) < key(b); });
  return children;
}

/// Classes by shape, leaves upwards: a segment's class is its children's classes.
void setShapes(const Measurements& m, const PlantStructure& structure, Repetition& out) {
  out.shapeOf.assign(m.segments.size(), 0);
  std::map<std::vector<std::size_t>, std::size_t> known;
  for (std::size_t s = m.segments.size(); s-- > 0;) {
    const SegmentId id{static_cast<std::int32_t>(s)};
    std::vector<std::size_t> key{m.segments[s].leaves.size(), structure.at(id).goesOn ? 1u : 0u};
    for (const SegmentId child : familyOf(m, structure, id, out.shapeOf)) key.push_back(out.shapeOf[placeOf(child)]);
    out.shapeOf[s] = known.emplace(std::move(key), known.size()).first->second;
  }
  out.shapes = known.size();
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

class Comparer {
 public:
  Comparer(const Measurements& m, const PlantStructure& structure, const SubtreeTolerance& tolerance) : m_(m), structure_(structure), tolerance_(tolerance) {}

  /// Whether two subtrees of one shape have the same numbers. Lengths count over that of the subtree's own first segment.
  [[nodiscard]] bool same(SegmentId a, SegmentId b, const std::vector<std::size_t>& shapeOf) const {
    const double scale = m_.at(a).length / m_.at(b).length;
    std::vector<std::pair<SegmentId, SegmentId>> open{{a, b}};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      if (shapeOf[placeOf(x)] != shapeOf[placeOf(y)] || !sameLength(m_.at(x).length, m_.at(y).length * scale)) return false;
      const auto left = familyOf(m_, structure_, x, shapeOf);
      const auto right = familyOf(m_, structure_, y, shapeOf);
      for (std::size_t c = 0; c < left.size(); ++c) {
        if (apart(m_.at(left[c]).rotr.radians(), m_.at(right[c]).rotr.radians()) > tolerance_.angle.radians()) return false;
        // How a subtree stands around its own first segment is free, so only what stands further up is held to its side.
        if (x != a && !sameSide(left[c], right[c], x, y)) return false;
        open.emplace_back(left[c], right[c]);
      }
    }
    return true;
  }

  /// Segments that match, counted.
  [[nodiscard]] double matched(SegmentId a, SegmentId b, double scale) const {
    double sum = 0;
    for (SegmentId x = a, y = b;;) {
      sum += sameLength(m_.at(x).length, m_.at(y).length * scale) && (x == a || sameBend(x, y)) ? 1 : 0.5;
      sum += matchedBranches(x, y, scale);
      if (!structure_.at(x).goesOn || !structure_.at(y).goesOn) return sum;
      x = nextOf(x);
      y = nextOf(y);
    }
  }

 private:
  [[nodiscard]] bool sameLength(double a, double b) const { return std::abs(a - b) <= tolerance_.length * std::max(a, b); }
  [[nodiscard]] bool sameBend(SegmentId a, SegmentId b) const { return apart(m_.at(a).rotr.radians(), m_.at(b).rotr.radians()) <= tolerance_.angle.radians(); }
  /// The azimuths of two children against their parents' own; without a side there is nothing to compare.
  [[nodiscard]] bool sameSide(SegmentId a, SegmentId b, SegmentId x, SegmentId y) const {
    const double left = structure_.at(a).azimuth - structure_.at(x).azimuth;
    const double right = structure_.at(b).azimuth - structure_.at(y).azimuth;
    return std::isnan(left) || std::isnan(right) || structure_.at(a).axis != structure_.at(x).axis || apart(left, right) <= 2 * tolerance_.angle.radians();
  }
  [[nodiscard]] SegmentId nextOf(SegmentId id) const {
    const Axis& axis = structure_.at(structure_.at(id).axis);
    return axis.segments[static_cast<std::size_t>(structure_.at(id).rank) + 1];
  }
  [[nodiscard]] std::vector<SegmentId> branchesOf(SegmentId id) const {
    std::vector<SegmentId> branches;
    for (const SegmentId child : m_.at(id).children)
      if (structure_.at(child).axis != structure_.at(id).axis) branches.push_back(child);
    return branches;
  }
  [[nodiscard]] double matchedBranches(SegmentId x, SegmentId y, double scale) const {
    const auto left = branchesOf(x);
    const auto right = branchesOf(y);
    double sum = 0;
    for (std::size_t c = 0; c < std::min(left.size(), right.size()); ++c) sum += matched(left[c], right[c], scale);
    return sum;
  }

  const Measurements& m_;
  const PlantStructure& structure_;
  SubtreeTolerance tolerance_;
};

}  // namespace

Repetition repetitionsOf(const Measurements& measurements, const PlantStructure& structure, const SubtreeTolerance& tolerance) {
  Repetition out;
  setShapes(measurements, structure, out);
  out.reduction = 1 - static_cast<double>(out.shapes) / static_cast<double>(measurements.segments.size());
  const std::vector<std::size_t> sizes = sizesOf(measurements);
  std::map<std::size_t, std::vector<SubtreeClass>> byShape;
  const Comparer compare(measurements, structure, tolerance);
  for (std::size_t s = 0; s < measurements.segments.size(); ++s) {
    if (sizes[s] < 2) continue;
    const SegmentId id{static_cast<std::int32_t>(s)};
    auto& classes = byShape[out.shapeOf[s]];
    const auto fits = [&](const SubtreeClass& c) { return compare.same(c.members.front(), id, out.shapeOf); };
    // A shape with very many different bearers is small and says little: comparing with the first dozens is enough.
    constexpr std::size_t kMostClasses = 32;
    const auto found = std::find_if(classes.begin(), classes.end(), fits);
    if (found == classes.end()) {
      if (classes.size() < kMostClasses) classes.push_back({{id}, sizes[s], false});
      continue;
    }
    const double first = measurements.at(found->members.front()).length;
    found->scaled = found->scaled || std::abs(measurements.at(id).length - first) > tolerance.length * first;
    found->members.push_back(id);
  }
  for (auto& [shape, classes] : byShape)
    for (SubtreeClass& c : classes)
      if (c.members.size() > 1) out.exact.push_back(std::move(c));
  std::sort(out.exact.begin(), out.exact.end(), [](const SubtreeClass& a, const SubtreeClass& b) {
    return std::pair(b.segments, a.members.front()) < std::pair(a.segments, b.members.front());
  });
  return out;
}

double likeness(const Measurements& measurements, const PlantStructure& structure, SegmentId a, SegmentId b, const SubtreeTolerance& tolerance) {
  const std::vector<std::size_t> sizes = sizesOf(measurements);
  const double scale = measurements.at(a).length / measurements.at(b).length;
  const double both = static_cast<double>(sizes[placeOf(a)] + sizes[placeOf(b)]);
  return 2 * Comparer(measurements, structure, tolerance).matched(a, b, scale) / both;
}

std::vector<std::vector<AxisId>> similarAxes(const Measurements& measurements, const PlantStructure& structure, double least, const SubtreeTolerance& tolerance) {
  const std::vector<std::size_t> sizes = sizesOf(measurements);
  const Comparer compare(measurements, structure, tolerance);
  std::vector<std::vector<AxisId>> groups;
  constexpr std::size_t kMostGroups = 200;
  for (std::size_t a = 0; a < structure.axes.size(); ++a) {
    const AxisId id{static_cast<std::int32_t>(a)};
    const Axis& axis = structure.at(id);
    const auto alike = [&](const std::vector<AxisId>& group) {
      const Axis& first = structure.at(group.front());
      const double small = static_cast<double>(std::min(sizes[placeOf(first.base())], sizes[placeOf(axis.base())]));
      const double both = static_cast<double>(sizes[placeOf(first.base())] + sizes[placeOf(axis.base())]);
      if (first.order != axis.order || 2 * small / both < least) return false;
      const double scale = measurements.at(first.base()).length / measurements.at(axis.base()).length;
      return 2 * compare.matched(first.base(), axis.base(), scale) / both >= least;
    };
    const auto found = std::find_if(groups.begin(), groups.end(), alike);
    if (found != groups.end()) found->push_back(id);
    else if (groups.size() < kMostGroups) groups.push_back({id});
  }
  std::erase_if(groups, [](const auto& g) { return g.size() < 2; });
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return groups;
}

}  // namespace axil::quantify
