#include "quantify/structure.hpp"

#include "base/turning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kForkRatio = 0.5;       // children whose angles are this alike fork
constexpr double kLeaningRatio = 1.0 / 3;  // and where both lean clearly unlike bends, these
constexpr double kClearlyMore = 10 * std::numbers::pi / 180;
constexpr std::size_t kTellingBends = 5;
constexpr double kNoSide = 0.5 * std::numbers::pi / 180;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }
std::size_t placeOf(AxisId id) { return static_cast<std::size_t>(id.value); }

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The child that is clicked as the same stem.
std::optional<SegmentId> sameStem(const Measurements& m, const Segment& segment) {
  for (const SegmentId child : segment.children)
    if (m.at(child).stem == segment.stem) return child;
  return std::nullopt;
}

/// Children by their angle to the segment, the least first; equal ones by id.
std::vector<SegmentId> byAngle(const Measurements& m, const Segment& segment) {
  std::vector<SegmentId> children = segment.children;
  const auto angle = [&](SegmentId id) { return angleBetween(segment.direction, m.at(id).direction).radians(); };
  std::sort(children.begin(), children.end(), [&](SegmentId a, SegmentId b) { return std::pair(angle(a), a) < std::pair(angle(b), b); });
  return children;
}

/// Least over second angle at a segment's tip; two straight children are as alike as can be.
double likeness(const Measurements& m, const Segment& segment, const std::vector<SegmentId>& sorted) {
  const double least = angleBetween(segment.direction, m.at(sorted[0]).direction).radians();
  const double second = angleBetween(segment.direction, m.at(sorted[1]).direction).radians();
  return second > 0 ? least / second : 1;
}

/// The usual angle of what goes on along a stem, and of what leaves one that goes on.
struct UsualAngles {
  std::optional<double> bend;
  std::optional<double> insertion;
};
UsualAngles usualAngles(const Measurements& m) {
  std::vector<double> bends;
  std::vector<double> insertions;
  for (const Segment& s : m.segments) {
    const auto same = sameStem(m, s);
    if (!same) continue;
    for (const SegmentId child : s.children) (child == *same ? bends : insertions).push_back(angleBetween(s.direction, m.at(child).direction).radians());
  }
  UsualAngles usual;
  if (!bends.empty()) usual.bend = medianOf(std::move(bends));
  if (!insertions.empty()) usual.insertion = medianOf(std::move(insertions));
  return usual;
}

/// Whether a stem's end goes on in its only child: not where that leans like the plant's branches and unlike its bends.
bool onlyChildGoesOn(const Measurements& m, const Segment& segment, const UsualAngles& usual) {
  if (!usual.bend || !usual.insertion || *usual.insertion < *usual.bend + kClearlyMore) return true;
  const double angle = angleBetween(segment.direction, m.at(segment.children.front()).direction).radians();
  return angle < (*usual.bend + *usual.insertion) / 2;
}

/// What goes on from each segment along its axis.
std::vector<std::optional<SegmentId>> continuations(const Measurements& m, StemEnds ends) {
  const UsualAngles usual = usualAngles(m);
  std::vector<std::optional<SegmentId>> next(m.segments.size());
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    const Segment& segment = m.segments[s];
    next[s] = sameStem(m, segment);
    if (next[s] || segment.children.empty()) continue;
    if (segment.children.size() == 1 ? onlyChildGoesOn(m, segment, usual) : ends == StemEnds::GoOn) next[s] = byAngle(m, segment).front();
  }
  return next;
}

/// A side carried along an axis without twist, as a unit vector perpendicular to the segment's direction.
PlantDirection carried(PlantDirection side, PlantDirection from, PlantDirection to) {
  const PlantDirection bent = areParallel(from, to) ? side : turned(side, PlantDirection::along(glm::cross(from.unit(), to.unit())), angleBetween(from, to));
  return perpendicularTo(to, bent);
}

/// The angle of `what` around `stem`, counted from `side` as rotu is from the r-axis.
double azimuthOf(PlantDirection stem, PlantDirection side, PlantDirection what) {
  const double lean = angleBetween(stem, what).radians();
  if (lean < kNoSide || lean > std::numbers::pi - kNoSide) return kNone;
  const PlantDirection start = PlantDirection::along(glm::cross(side.unit(), stem.unit()));
  return signedAngleAbout(stem, start, perpendicularTo(stem, what)).radians();
}

class Builder {
 public:
  Builder(const Measurements& m, StemEnds ends) : m_(m), next_(continuations(m, ends)) { out_.places.resize(m.segments.size()); }

  PlantStructure built() {
    for (std::size_t s = 0; s < m_.segments.size(); ++s)
      if (!continues(s)) addAxis(SegmentId{static_cast<std::int32_t>(s)});
    for (const Axis& axis : out_.axes) out_.orders = std::max(out_.orders, axis.order + 1);
    for (Axis& axis : out_.axes) finish(axis);
    setAzimuths();
    setBranching();
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool continues(std::size_t s) const {
    const auto& parent = m_.segments[s].parent;
    return parent && next_[placeOf(*parent)] == SegmentId{static_cast<std::int32_t>(s)};
  }

  void addAxis(SegmentId base) {
    const AxisId id{static_cast<std::int32_t>(out_.axes.size())};
    Axis axis;
    axis.bearer = m_.at(base).parent;
    if (axis.bearer) axis.parent = out_.at(*axis.bearer).axis;
    if (base.value > 0) axis.order = axis.parent ? out_.at(*axis.parent).order + 1 : 1;
    for (std::optional<SegmentId> s = base; s; s = next_[placeOf(*s)]) {
      SegmentPlace& place = out_.places[placeOf(*s)];
      place.axis = id;
      place.order = axis.order;
      place.rank = static_cast<int>(axis.segments.size());
      axis.segments.push_back(*s);
    }
    out_.axes.push_back(std::move(axis));
    if (const auto& a = out_.axes.back(); a.parent) {
      out_.axes[placeOf(*a.parent)].laterals.push_back(id);
      ++out_.places[placeOf(*a.bearer)].branches;
    }
  }

  void finish(Axis& axis) {
    const int last = static_cast<int>(axis.segments.size()) - 1;
    for (const SegmentId s : axis.segments) {
      SegmentPlace& place = out_.places[placeOf(s)];
      place.fromTip = last - place.rank;
      place.goesOn = place.fromTip > 0;
      place.isNode = place.branches > 0 || !m_.at(s).leaves.empty();
    }
    axis.forks = out_.at(axis.tip()).branches > 1;
    std::stable_sort(axis.laterals.begin(), axis.laterals.end(),
                     [&](AxisId a, AxisId b) { return out_.at(*out_.at(a).bearer).rank < out_.at(*out_.at(b).bearer).rank; });
  }

  void setAzimuths() {
    std::vector<PlantDirection> sides(m_.segments.size(), PlantDirection::up());
    out_.leafAzimuths.resize(m_.segments.size());
    for (const Axis& axis : out_.axes) {
      // Any side will do for an axis' first segment: only differences along the axis count.
      sides[placeOf(axis.base())] = m_.at(axis.base()).rAxis;
      for (std::size_t i = 1; i < axis.segments.size(); ++i)
        sides[placeOf(axis.segments[i])] = carried(sides[placeOf(axis.segments[i - 1])], m_.at(axis.segments[i - 1]).direction, m_.at(axis.segments[i]).direction);
    }
    for (std::size_t s = 0; s < m_.segments.size(); ++s) {
      const Segment& segment = m_.segments[s];
      const PlantDirection start = PlantDirection::along(glm::cross(segment.rAxis.unit(), segment.direction.unit()));
      out_.places[s].twist = azimuthOf(segment.direction, sides[s], start);
      for (const SegmentId child : segment.children) out_.places[placeOf(child)].azimuth = azimuthOf(segment.direction, sides[s], m_.at(child).direction);
      for (const LeafMeasure& leaf : segment.leaves) out_.leafAzimuths[s].push_back(azimuthOf(segment.direction, sides[s], leaf.direction));
    }
  }

  /// Monopodial: at branched nodes something goes on much straighter than its sisters.
  void setBranching() {
    std::vector<double> ratios;
    for (std::size_t s = 0; s < m_.segments.size(); ++s) {
      const SegmentPlace& place = out_.places[s];
      const Segment& segment = m_.segments[s];
      if (place.branches == 0) continue;
      if (!place.goesOn) {
        if (place.branches > 1) ratios.push_back(1);
        continue;
      }
      double sister = 0;
      for (const SegmentId child : segment.children)
        if (child != *next_[s]) sister = std::max(sister, angleBetween(segment.direction, m_.at(child).direction).radians());
      const double own = angleBetween(segment.direction, m_.at(*next_[s]).direction).radians();
      ratios.push_back(sister > 0 ? std::min(1.0, own / sister) : 1);
    }
    if (ratios.empty()) return;
    out_.straightness = 1 - medianOf(std::move(ratios));
    out_.branching = out_.straightness > 1 - kForkRatio ? Branching::Monopodial : Branching::Sympodial;
  }

  const Measurements& m_;
  std::vector<std::optional<SegmentId>> next_;
  PlantStructure out_;
};

}  // namespace

StemEnds stemEndsOf(std::span<const Measurements> plants) {
  std::vector<double> ratios, leans, bends;
  for (const Measurements& m : plants)
    for (const Segment& s : m.segments) {
      if (const auto same = sameStem(m, s)) bends.push_back(angleBetween(s.direction, m.at(*same).direction).radians());
      else if (s.children.size() > 1) {
        const std::vector<SegmentId> sorted = byAngle(m, s);
        ratios.push_back(likeness(m, s, sorted));
        leans.push_back(angleBetween(s.direction, m.at(sorted.front()).direction).radians());
      }
    }
  if (ratios.empty()) return StemEnds::GoOn;
  const double ratio = medianOf(std::move(ratios));
  const bool leaning = bends.size() >= kTellingBends && medianOf(std::move(leans)) > 2 * medianOf(bends) + kClearlyMore;
  return ratio > (leaning ? kLeaningRatio : kForkRatio) ? StemEnds::Fork : StemEnds::GoOn;
}

PlantStructure plantStructure(const Measurements& measurements, StemEnds ends) { return Builder(measurements, ends).built(); }

PlantStructure plantStructure(const Measurements& measurements) { return plantStructure(measurements, stemEndsOf({&measurements, 1})); }

std::vector<PlantStructure> plantStructures(std::span<const Measurements> plants) {
  const StemEnds ends = stemEndsOf(plants);
  std::vector<PlantStructure> structures;
  for (const Measurements& m : plants) structures.push_back(plantStructure(m, ends));
  return structures;
}

std::vector<double> internodesOf(const Measurements& measurements, const PlantStructure& structure, const Axis& axis) {
  std::vector<double> lengths;
  double length = 0;
  for (const SegmentId s : axis.segments) {
    length += measurements.at(s).length;
    if (!structure.at(s).isNode && structure.at(s).goesOn) continue;
    lengths.push_back(length);
    length = 0;
  }
  return lengths;
}

}  // namespace axil::quantify
