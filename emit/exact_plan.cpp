#include "emit/exact_plan.hpp"

#include "base/text.hpp"
#include "base/turning.hpp"
#include "emit/plan.hpp"
#include "quantify/circular.hpp"
#include "quantify/phyllotaxis.hpp"
#include "quantify/statistics.hpp"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace axil::emit {

namespace {

using quantify::AxisId;
using quantify::Measurements;
using quantify::PlantStructure;
using quantify::SegmentId;

constexpr double kPi = std::numbers::pi;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// A step of one or two digits, not above `value`.
double neatStep(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {8.0, 5.0, 4.0, 3.0, 2.0, 1.5, 1.0})
    if (digit * power <= value) return roundedTo(digit * power, 2 - static_cast<int>(std::floor(std::log10(power))));
  return power;
}

/// To three significant digits, as usual values are written.
double neat(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const int digits = 2 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  return roundedTo(value, std::clamp(digits, 0, 15));
}

struct Geometry {
  std::vector<glm::dvec3> tips;
  double height = 0;
};
Geometry geometryOf(const Measurements& m) {
  Geometry g;
  glm::dvec3 low = m.origin.at;
  glm::dvec3 high = low;
  for (const auto& s : m.segments) {
    g.tips.push_back((s.parent ? g.tips[at(s.parent->value)] : m.origin.at) + s.direction.unit() * s.length);
    low = glm::min(low, g.tips.back());
    high = glm::max(high, g.tips.back());
  }
  const glm::dvec3 size = high - low;
  g.height = std::max(size.y, 0.1 * std::max({size.x, size.y, size.z}));
  return g;
}

class ExactPlanner {
 public:
  ExactPlanner(const Measurements& m, const PlantStructure& structure, const ExactLayout& layout, const ExactChoice& choice)
      : m_(m), structure_(structure), layout_(layout), choice_(choice), geometry_(geometryOf(m)) {}

  ExactPlan planned() {
    plan_.height = geometry_.height;
    plan_.usual.resize(at(layout_.orders));
    setSteps();
    setUsual();
    setRadii();
    setDirection();
    grow();
    growLeaves();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] const quantify::Segment& segment(int row) const { return m_.segments[layout_.segmentOf[at(row)]]; }
  [[nodiscard]] std::size_t rows() const { return layout_.segmentOf.size(); }
  [[nodiscard]] int axes() const { return static_cast<int>(layout_.orderOf.size()); }

  void setSteps() {
    std::vector<double> lengths;
    for (const auto& s : m_.segments) lengths.push_back(s.length);
    std::sort(lengths.begin(), lengths.end());
    const double allowed = choice_.error * geometry_.height;
    const double longest = lengths[lengths.size() * 9 / 10];
    plan_.lengthStep = neatStep(std::min(allowed, longest));
    plan_.angleStep = neatStep(std::min(0.5, 1.2 * allowed / longest));
    // What goes on straight is turned about itself; its side matters by the sine of its bend.
    plan_.leanStep = neatStep(std::min(0.8, 3 * plan_.angleStep));
    setLeafSteps();
  }

  /// A blade's tip may be off by as much as a node.
  void setLeafSteps() {
    std::vector<double> lengths, ratios, stalks;
    for (const quantify::LeafMeasure* leaf : layout_.leafOf) {
      lengths.push_back(leaf->length);
      stalks.push_back(leaf->petiole);
      if (leaf->width > 0) ratios.push_back(leaf->width / leaf->length);
    }
    if (lengths.empty()) return;
    plan_.leafLength = neat(*std::max_element(lengths.begin(), lengths.end()));
    plan_.leafWidth = neat(medianOf(ratios));
    plan_.petiole = neat(medianOf(stalks));
    const double allowed = std::max(choice_.error, 0.005) * geometry_.height;
    plan_.leafStep = neatStep(std::clamp(1.2 * allowed / medianOf(lengths), 0.02, 0.2));
  }

  void setUsual() {
    std::vector<std::vector<double>> lengths(plan_.usual.size()), bends(plan_.usual.size()), insertions(plan_.usual.size()), leafAngles(plan_.usual.size());
    std::vector<std::vector<std::array<double, 2>>> logs(plan_.usual.size());
    for (int a = 0; a < axes(); ++a) {
      const int order = layout_.orderOf[at(a)];
      ++plan_.usual[at(order)].axes;
      if (layout_.bearer[at(a)] >= 0 || a > 0) {
        const int from = a == 0 ? 0 : std::max(0, order - 1);
        insertions[at(from)].push_back(segment(layout_.start[at(a)]).rotr.radians());
        ++plan_.usual[at(from)].branches;
      }
      for (int row = layout_.start[at(a)]; row < layout_.start[at(a) + 1]; ++row) {
        lengths[at(order)].push_back(segment(row).length);
        logs[at(order)].push_back({static_cast<double>(row - layout_.start[at(a)]), std::log(segment(row).length)});
        if (row > layout_.start[at(a)]) bends[at(order)].push_back(angleBetween(segment(row - 1).direction, segment(row).direction).radians());
        for (const quantify::LeafMeasure& leaf : segment(row).leaves) leafAngles[at(order)].push_back(leaf.rotr.radians());
      }
    }
    for (int order = 0; order < layout_.orders; ++order) {
      OrderUsual& usual = plan_.usual[at(order)];
      usual.segments = lengths[at(order)].size();
      usual.leaves = leafAngles[at(order)].size();
      usual.length = neat(medianOf(lengths[at(order)]));
      usual.bend = neat(medianOf(bends[at(order)]));
      usual.insertion = neat(medianOf(insertions[at(order)]));
      usual.leafAngle = neat(medianOf(leafAngles[at(order)]));
      if (choice_.trend) setTrend(usual, logs[at(order)]);
      setArrangement(order, usual);
    }
  }

  static void setTrend(OrderUsual& usual, const std::vector<std::array<double, 2>>& logs) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [x, y] : logs) n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    const double spread = n * sxx - sx * sx;
    if (n < 4 || spread <= 0) return;
    const double slope = (n * sxy - sx * sy) / spread;
    usual.shrink = neat(std::exp(std::clamp(slope, -0.5, 0.5)));
    usual.length = neat(std::exp((sy - slope * sx) / n));
  }

  /// Divergence and first azimuth of what stands around the axes of an order, where it is regular.
  void setArrangement(int order, OrderUsual& usual) {
    const quantify::MeasuredPlant plant{&m_, &structure_};
    for (const auto organs : {quantify::OrgansAround::Branches, quantify::OrgansAround::Leaves}) {
      const quantify::Phyllotaxis p = quantify::phyllotaxisOf(std::span(&plant, 1), organs, order);
      const bool leaves = organs == quantify::OrgansAround::Leaves;
      double& apart = leaves ? usual.leafApart : usual.apart;
      if (p.perNode > 1) apart = neat(2 * kPi / p.perNode);
      if (!choice_.divergence || p.samples < 3 || p.chance > 0.05 || p.perNode < 1) continue;
      double& divergence = leaves ? usual.leafDivergence : usual.divergence;
      const double size = neat(p.divergence.radians() / p.perNode);  // from organ to organ
      divergence = windingOf(order, leaves, size) * size;
    }
  }

  /// Whether azimuths of an order rise or fall by `step` from rank to rank: which of the two keeps each axis' organs together.
  [[nodiscard]] double windingOf(int order, bool leaves, double step) const {
    double together[2] = {0, 0};
    for (int a = 0; a < axes(); ++a) {
      if (layout_.orderOf[at(a)] != order) continue;
      for (const int way : {0, 1}) {
        glm::dvec2 sum{0, 0};
        for (int row = layout_.start[at(a)]; row < layout_.start[at(a) + 1]; ++row)
          for (const double azimuth : leaves ? structure_.leafAzimuths[layout_.segmentOf[at(row)]] : branchAzimuths(row)) {
            const double phase = azimuth - (way == 0 ? step : -step) * (leaves ? leavesBelow(row) : branchesBelow(row));
            if (!std::isnan(phase)) sum += glm::dvec2{std::cos(phase), std::sin(phase)};
          }
        together[way] += glm::length(sum);
      }
    }
    return together[0] >= together[1] ? 1 : -1;
  }
  [[nodiscard]] std::vector<double> branchAzimuths(int row) const {
    std::vector<double> azimuths;
    for (int a = layout_.side[at(row)]; a < layout_.side[at(row) + 1]; ++a)
      azimuths.push_back(structure_.places[layout_.segmentOf[at(layout_.start[at(a)])]].azimuth);
    return azimuths;
  }

  void setRadii() {
    const std::vector<double> radii = radiiOf(m_, geometry_.height);
    plan_.radiusMeasured = std::any_of(m_.segments.begin(), m_.segments.end(), [](const quantify::Segment& s) { return s.radius.has_value(); });
    plan_.radius = neat(*std::max_element(radii.begin(), radii.end()));
    plan_.taper = 0.8;
    for (std::size_t row = 0; row < rows(); ++row)
      plan_.thin.push_back(std::max(0, static_cast<int>(std::lround(std::log(radii[layout_.segmentOf[row]] / plan_.radius) / std::log(plan_.taper)))));
    std::vector<std::vector<double>> byOrder(plan_.usual.size());
    for (int a = 0; a < axes(); ++a)
      for (int row = layout_.start[at(a)]; row < layout_.start[at(a) + 1]; ++row) byOrder[at(layout_.orderOf[at(a)])].push_back(radii[layout_.segmentOf[at(row)]]);
    for (const std::vector<double>& order : byOrder) plan_.radii.push_back(neat(medianOf(order)));
  }

  /// Towards where the first segment really goes, with two digits more than a step is fine.
  void setDirection() {
    const glm::dvec3& d = m_.segments.front().direction.unit();
    plan_.direction = {roundedTo(d.x, 3), roundedTo(d.y, 3), roundedTo(d.z, 3)};
    const int digits = std::clamp(3 - static_cast<int>(std::floor(std::log10(geometry_.height))), 0, 15);
    const glm::dvec3& o = m_.origin.at;
    plan_.position = {roundedTo(o.x, digits), roundedTo(o.y, digits), roundedTo(o.z, digits)};
  }

  [[nodiscard]] double usualLength(const OrderUsual& usual, int rank) const { return usual.length * std::pow(usual.shrink, rank); }

  static int stepsFor(double value, double step) { return static_cast<int>(std::lround(value / step)); }
  static int turnSteps(double angle, double step) { return stepsFor(std::remainder(angle, 2 * kPi), step); }

  void grow() {
    const std::size_t n = rows();
    frames_.resize(n);
    tips_.resize(n);
    twist_.assign(n, 0);
    for (std::vector<int>* table : {&plan_.length, &plan_.bend, &plan_.around}) table->assign(n, 0);
    setPhases();
    const StemFrame base = firstFrame(PlantDirection::along(plan_.direction));
    double sum = 0;
    for (int a = 0; a < axes(); ++a) {
      for (int row = layout_.start[at(a)]; row < layout_.start[at(a) + 1]; ++row) {
        growRow(a, row, base);
        const double off = glm::distance(tips_[at(row)], geometry_.tips[layout_.segmentOf[at(row)]]) / geometry_.height;
        plan_.worst = std::max(plan_.worst, off);
        sum += off;
      }
    }
    plan_.mean = sum / static_cast<double>(n);
  }

  /// The azimuth at which an order's axes begin to be arranged: what fits their first steps best.
  void setPhases() {
    std::vector<std::vector<double>> branches(plan_.usual.size()), leaves(plan_.usual.size());
    for (int a = 0; a < axes(); ++a) {
      const int order = layout_.orderOf[at(a)];
      const int bearer = layout_.bearer[at(a)];
      if (bearer >= 0) {
        const int bearerOrder = std::max(0, order - 1);
        const OrderUsual& usual = plan_.usual[at(bearerOrder)];
        const double azimuth = structure_.places[layout_.segmentOf[at(layout_.start[at(a)])]].azimuth;
        if (!std::isnan(azimuth)) branches[at(bearerOrder)].push_back(azimuth - usual.divergence * branchesBelow(bearer) - usual.apart * (a - layout_.side[at(bearer)]));
      }
      for (int row = layout_.start[at(a)]; row < layout_.start[at(a) + 1]; ++row) {
        const OrderUsual& usual = plan_.usual[at(order)];
        const auto& azimuths = structure_.leafAzimuths[layout_.segmentOf[at(row)]];
        for (std::size_t l = 0; l < azimuths.size(); ++l)
          if (!std::isnan(azimuths[l])) leaves[at(order)].push_back(azimuths[l] - usual.leafDivergence * leavesBelow(row) - usual.leafApart * static_cast<double>(l));
      }
    }
    for (std::size_t order = 0; order < plan_.usual.size(); ++order) {
      const auto phase = [](const std::vector<double>& values) {
        const quantify::CircularMean mean = quantify::circularMeanOf(values);
        return mean.concentration > 0.5 ? neat(mean.mean) : 0.0;
      };
      plan_.usual[order].azimuth = phase(branches[order]);
      plan_.usual[order].leafAzimuth = phase(leaves[order]);
    }
  }
  [[nodiscard]] int axisOf(int row) const {
    return static_cast<int>(std::upper_bound(layout_.start.begin(), layout_.start.end() - 1, row) - layout_.start.begin()) - 1;
  }
  /// Organs that stand on the same axis below the tip of `row`.
  [[nodiscard]] int branchesBelow(int row) const { return layout_.side[at(row)] - layout_.side[at(layout_.start[at(axisOf(row))])]; }
  [[nodiscard]] int leavesBelow(int row) const { return layout_.leaves[at(row)] - layout_.leaves[at(layout_.start[at(axisOf(row))])]; }

  void growRow(int axis, int row, const StemFrame& base) {
    const int order = layout_.orderOf[at(axis)];
    const OrderUsual& usual = plan_.usual[at(order)];
    const int rank = row - layout_.start[at(axis)];
    const glm::dvec3& goal = geometry_.tips[layout_.segmentOf[at(row)]];
    const int bearer = layout_.bearer[at(axis)];
    const int before = rank > 0 ? row - 1 : bearer;
    const glm::dvec3 from = before >= 0 ? tips_[at(before)] : plan_.position;
    if (row == 0) {
      frames_[0] = base;
    } else {
      const StemFrame& under = before >= 0 ? frames_[at(before)] : base;
      const double twist = before >= 0 ? twist_[at(before)] : 0;
      const Turn needed = measuredTurn(under, PlantDirection::hasDirection(goal - from) ? PlantDirection::along(goal - from) : segment(row).direction);
      if (rank > 0) {
        const double bend = std::max(-stepsFor(usual.bend, plan_.angleStep), stepsFor(needed.rotr.radians() - usual.bend, plan_.angleStep));
        plan_.bend[at(row)] = static_cast<int>(bend);
        const double rotr = std::max(0.0, usual.bend + plan_.angleStep * bend);
        plan_.around[at(row)] = turnSteps(needed.rotu.radians() + twist, plan_.leanStep);
        twist_[at(row)] = plan_.leanStep * plan_.around[at(row)];
        frames_[at(row)] = childFrame(under, {Angle::fromRadians(rotr), Angle::fromRadians(twist_[at(row)] - twist)}, ChildKind::Main);
      } else {
        const OrderUsual& at_ = plan_.usual[at(bearer >= 0 ? layout_.orderOf[at(axisOf(bearer))] : 0)];
        const int place = bearer >= 0 ? axis - layout_.side[at(bearer)] : axis - 1;
        const double azimuth = bearer >= 0 ? at_.azimuth + at_.divergence * branchesBelow(bearer) + at_.apart * place : at_.apart * place;
        plan_.bend[at(row)] = stepsFor(needed.rotr.radians() - at_.insertion, plan_.angleStep);
        const double rotr = std::max(0.0, at_.insertion + plan_.angleStep * plan_.bend[at(row)]);
        plan_.around[at(row)] = turnSteps(needed.rotu.radians() + twist - azimuth, plan_.angleStep);
        const double rotu = azimuth + plan_.angleStep * plan_.around[at(row)] - twist;
        frames_[at(row)] = childFrame(under, {Angle::fromRadians(rotr), Angle::fromRadians(rotu)}, ChildKind::Branch);
      }
    }
    const double along = glm::dot(goal - from, frames_[at(row)].direction.unit());
    const double model = usualLength(usual, rank);
    int steps = stepsFor(along - model, plan_.lengthStep);
    while (model + plan_.lengthStep * steps <= 0.1 * plan_.lengthStep) ++steps;
    plan_.length[at(row)] = steps;
    tips_[at(row)] = from + frames_[at(row)].direction.unit() * (model + plan_.lengthStep * steps);
  }

  void growLeaves() {
    std::size_t leaf = 0;
    const StemFrame base = firstFrame(PlantDirection::along(plan_.direction));
    for (int l = 0; l < layout_.collarLeaves; ++l) addLeaf(*layout_.leafOf[leaf++], base, 0, plan_.usual.front(), 0, l);
    for (std::size_t row = 0; row < rows(); ++row) {
      const int axis = axisOf(static_cast<int>(row));
      for (int l = layout_.leaves[row]; l < layout_.leaves[row + 1]; ++l)
        addLeaf(*layout_.leafOf[at(l)], frames_[row], twist_[row], plan_.usual[at(layout_.orderOf[at(axis)])], leavesBelow(static_cast<int>(row)), l - layout_.leaves[row]);
    }
  }
  void addLeaf(const quantify::LeafMeasure& leaf, const StemFrame& under, double twist, const OrderUsual& usual, int below, int place) {
    const Turn needed = measuredTurn(under, leaf.direction);
    const double azimuth = usual.leafAzimuth + usual.leafDivergence * below + usual.leafApart * place;
    plan_.leafBend.push_back(stepsFor(needed.rotr.radians() - usual.leafAngle, plan_.leafStep));
    plan_.leafAround.push_back(turnSteps(needed.rotu.radians() + twist - azimuth, plan_.leafStep));
    plan_.leafRoll.push_back(turnSteps(leaf.roll.radians(), plan_.leafStep));
    plan_.small.push_back(stepsFor(std::log(leaf.length / plan_.leafLength), std::log(plan_.leafTaper)));
    plan_.stalked.push_back(stepsFor(leaf.petiole - plan_.petiole, plan_.lengthStep));
    const auto found = std::find(plan_.shapes.begin(), plan_.shapes.end(), leaf.shape);
    plan_.shape.push_back(static_cast<int>(found - plan_.shapes.begin()));
    if (found == plan_.shapes.end()) plan_.shapes.push_back(leaf.shape);
  }

  const Measurements& m_;
  const PlantStructure& structure_;
  const ExactLayout& layout_;
  ExactChoice choice_;
  Geometry geometry_;
  ExactPlan plan_;
  std::vector<StemFrame> frames_;
  std::vector<glm::dvec3> tips_;
  std::vector<double> twist_;
};

}  // namespace

ExactLayout exactLayout(const Measurements& m, const PlantStructure& structure) {
  ExactLayout layout;
  std::vector<AxisId> queue;
  for (std::size_t a = 0; a < structure.axes.size(); ++a)
    if (!structure.axes[a].bearer) queue.emplace_back(static_cast<int>(a));
  layout.collarAxes = static_cast<int>(queue.size()) - 1;
  for (std::size_t a = 0; a < queue.size(); ++a) layout.bearer.push_back(-1);
  for (const quantify::LeafMeasure& leaf : m.rootLeaves) layout.leafOf.push_back(&leaf);
  layout.collarLeaves = static_cast<int>(layout.leafOf.size());
  for (std::size_t a = 0; a < queue.size(); ++a) {
    const quantify::Axis& axis = structure.at(queue[a]);
    // A branch of the collar is of the first order that branches have, whatever the axes beside it are.
    layout.orderOf.push_back(axis.bearer ? layout.orderOf[at(static_cast<int>(std::upper_bound(layout.start.begin(), layout.start.end(), layout.bearer[a]) - layout.start.begin()) - 1)] + 1
                                         : (a == 0 ? 0 : 1));
    layout.orders = std::max(layout.orders, layout.orderOf.back() + 1);
    layout.start.push_back(static_cast<int>(layout.segmentOf.size()));
    for (const SegmentId id : axis.segments) {
      const int row = static_cast<int>(layout.segmentOf.size());
      layout.segmentOf.push_back(at(id.value));
      layout.side.push_back(static_cast<int>(queue.size()));
      for (const AxisId lateral : axis.laterals) {
        if (structure.at(lateral).bearer != id) continue;
        queue.push_back(lateral);
        layout.bearer.push_back(row);
      }
      layout.leaves.push_back(static_cast<int>(layout.leafOf.size()));
      for (const quantify::LeafMeasure& leaf : m.at(id).leaves) layout.leafOf.push_back(&leaf);
    }
  }
  layout.start.push_back(static_cast<int>(layout.segmentOf.size()));
  layout.side.push_back(static_cast<int>(queue.size()));
  layout.leaves.push_back(static_cast<int>(layout.leafOf.size()));
  return layout;
}

ExactPlan exactPlan(const Measurements& m, const PlantStructure& structure, const ExactLayout& layout, const ExactChoice& choice) {
  return ExactPlanner(m, structure, layout, choice).planned();
}

}  // namespace axil::emit
