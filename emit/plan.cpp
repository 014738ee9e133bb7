#include "emit/plan.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace axil::emit {

namespace {

using quantify::LeafMeasure;
using quantify::Measurements;
using quantify::Segment;
using quantify::SegmentKind;

constexpr int kMostDecimals = 12;       // of angles
constexpr int kMostLengthDecimals = 16;
constexpr double kBaseRadius = 0.012;    // of the plant's size
constexpr double kThinnest = 0.15;       // of the radius at the base

Result<void> checkOptions(const EmitOptions& options) {
  if (options.decimals < -1 || options.decimals > kMostDecimals)
    return fail(ErrorCode::BadInput, std::to_string(options.decimals) + " decimals are not possible; give 0 to " + std::to_string(kMostDecimals) + ", or -1 for all");
  if (!(std::isfinite(options.deriveTime) && options.deriveTime > 0))
    return fail(ErrorCode::BadInput, "the time of a derivation step is " + shortest(options.deriveTime) + "; it must be above 0");
  for (const std::string* text : {&options.name, &options.stemModel, &options.stemTexture, &options.leafTexture})
    if (text->find_first_of("\"\\\n\r") != std::string::npos)
      return fail(ErrorCode::BadInput, "the name '" + *text + "' holds a quote, a backslash or a line break, which a grammar's text cannot hold; choose another");
  return {};
}

/// Where each segment ends, as measured.
std::vector<glm::dvec3> measuredTips(const Measurements& m) {
  std::vector<glm::dvec3> tips;
  for (const Segment& s : m.segments) {
    const glm::dvec3 from = s.parent ? tips[static_cast<std::size_t>(s.parent->value)] : m.origin.at;
    tips.push_back(from + s.direction.unit() * s.length);
  }
  return tips;
}

struct Sizes {
  double extent = 0;
  double height = 0;
  double shortest = 0;
};

Sizes sizesOf(const Measurements& m, const std::vector<glm::dvec3>& tips) {
  glm::dvec3 low = m.origin.at;
  glm::dvec3 high = low;
  for (const glm::dvec3& tip : tips)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], tip[k]);
      high[k] = std::max(high[k], tip[k]);
    }
  Sizes sizes{std::max({high.x - low.x, high.y - low.y, high.z - low.z}), high.y - low.y, std::numeric_limits<double>::infinity()};
  for (const Segment& s : m.segments) sizes.shortest = std::min(sizes.shortest, s.length);
  return sizes;
}

/// Lengths are to keep 2e-6 of the plant's size and a thousandth of the shortest segment where angles keep 1e-6.
Digits digitsFor(int decimals, double scale, double shortest) {
  if (decimals < 0) return {-1, -1};
  const int forScale = static_cast<int>(std::ceil(-std::log10(scale * 2)));
  const int forShortest = static_cast<int>(std::ceil(-std::log10(shortest))) - 3;
  return {decimals, std::min(kMostLengthDecimals, decimals + std::max({0, forScale, forShortest}))};
}

/// The body of the growing point is to be seen nowhere: the thesis' 1e-8, or less for a small plant.
double growingPointFor(double scale, double shortest) {
  const double most = std::min(5e-8 * scale, 1e-2 * shortest);
  return std::min(1e-8, std::pow(10.0, std::floor(std::log10(most))));
}

/// Writes numbers and walks along the plant that they grow.
class Planner {
 public:
  Planner(const Measurements& m, const EmitOptions& options) : m_(m), rule_(options.turning), truth_(measuredTips(m)) {
    const Sizes sizes = sizesOf(m, truth_);
    plan_.scale = std::max(sizes.height, 0.1 * sizes.extent);
    plan_.digits = digitsFor(options.decimals, plan_.scale, sizes.shortest);
    plan_.growingPoint = growingPointFor(plan_.scale, sizes.shortest);
    steering_ = options.decimals < 0 ? 0 : 2 * std::pow(10.0, -options.decimals);
    lengthPlay_ = options.decimals < 0 ? 0 : std::pow(10.0, -plan_.digits.length);
    radii_ = radiiOf(m, plan_.scale);
    plan_.radiusMeasured = std::any_of(m.segments.begin(), m.segments.end(), [](const Segment& s) { return s.radius.has_value(); });
  }

  Plan planned() {
    setPlant();
    for (std::size_t s = 0; s < m_.segments.size(); ++s) addSegment(s);
    for (const LeafMeasure& leaf : m_.rootLeaves) plan_.rootLeaves.push_back(plannedLeaf(leaf, plan_.frame));
    for (std::size_t s = 0; s < m_.segments.size(); ++s)
      for (const LeafMeasure& leaf : m_.segments[s].leaves) plan_.segments[s].leaves.push_back(plannedLeaf(leaf, ground_[s]));
    return std::move(plan_);
  }

 private:
  [[nodiscard]] double roundedAngle(double radians) const { return rounded(radians, plan_.digits.angle); }
  [[nodiscard]] double roundedLength(double length) const { return rounded(length, plan_.digits.length); }
  [[nodiscard]] Turn roundedTurn(Turn turn) const {
    return {Angle::fromRadians(roundedAngle(turn.rotr.radians())), Angle::fromRadians(roundedAngle(turn.rotu.radians()))};
  }

  void setPlant() {
    const glm::dvec3& at = m_.origin.at;
    const glm::dvec3& d = m_.segments.front().direction.unit();
    plan_.position.at = {roundedLength(at.x), roundedLength(at.y), roundedLength(at.z)};
    plan_.direction = {roundedAngle(d.x), roundedAngle(d.y), roundedAngle(d.z)};
    plan_.frame = firstFrame(PlantDirection::along(plan_.direction));
  }

  /// The measured direction, leaning towards where the node really is by no more than rounding made necessary.
  [[nodiscard]] PlantDirection steered(PlantDirection measured, const glm::dvec3& towards) const {
    if (steering_ <= 0 || !PlantDirection::hasDirection(towards)) return measured;
    const PlantDirection aim = PlantDirection::along(towards);
    const double off = angleBetween(measured, aim).radians();
    if (off <= steering_) return aim;
    return PlantDirection::along(measured.unit() + (aim.unit() - measured.unit()) * (steering_ / off));
  }

  [[nodiscard]] Turn turnFor(std::size_t s, const StemFrame& from, const glm::dvec3& base) const {
    const Segment& segment = m_.segments[s];
    if (rule_ == TurningRule::Literal) return roundedTurn({segment.rotr, segment.rotu});
    return roundedTurn(measuredTurn(from, steered(segment.direction, truth_[s] - base)));
  }

  /// The measured length, up to one unit of its last digit nearer to where the node really is.
  [[nodiscard]] double lengthFor(std::size_t s, const glm::dvec3& base, PlantDirection grown, double stub) const {
    const double measured = m_.segments[s].length;
    const double needed = glm::dot(truth_[s] - base, grown.unit());
    return roundedLength(std::clamp(needed, measured - lengthPlay_, measured + lengthPlay_) - stub);
  }

  void addSegment(std::size_t s) {
    const Segment& segment = m_.segments[s];
    PlannedSegment planned;
    planned.stage = kFirstSegmentStage + static_cast<int>(s);
    planned.kind = segment.kind == SegmentKind::Branch ? ChildKind::Branch : ChildKind::Main;
    planned.radius = radii_[s];
    for (const quantify::SegmentId child : segment.children) planned.children.push_back(static_cast<std::size_t>(child.value));

    const bool first = s == 0;
    const StemFrame& from = segment.parent ? ground_[static_cast<std::size_t>(segment.parent->value)] : plan_.frame;
    const glm::dvec3 base = segment.parent ? plan_.segments[static_cast<std::size_t>(segment.parent->value)].tip.at : plan_.position.at;
    if (!first) planned.turn = turnFor(s, from, base);
    if (!first && !segment.parent) plan_.collarBranches.push_back(s);
    planned.frame = first ? from : childFrame(from, planned.turn, planned.kind, rule_);

    const double stub = segment.children.empty() && segment.leaves.empty() ? 0 : plan_.growingPoint;
    planned.length = lengthFor(s, base, planned.frame.direction, stub);
    planned.tip.at = base + planned.frame.direction.unit() * (planned.length + stub);
    ground_.push_back(childFrame(planned.frame, {}, ChildKind::Main, rule_));
    plan_.segments.push_back(std::move(planned));
  }

  [[nodiscard]] PlannedLeaf plannedLeaf(const LeafMeasure& leaf, const StemFrame& from) {
    PlannedLeaf planned;
    planned.measure = &leaf;
    planned.turn = roundedTurn(rule_ == TurningRule::Literal ? Turn{leaf.rotr, leaf.rotu} : measuredTurn(from, leaf.direction));
    const StemFrame blade = childFrame(from, planned.turn, ChildKind::Branch, rule_);
    planned.roll = Angle::fromRadians(roundedAngle(signedAngleAbout(blade.direction, blade.adaxial, leaf.normal).radians()));
    planned.frame = childFrame(blade, {Angle{}, planned.roll}, ChildKind::Main, rule_);
    planned.petioleStage = leaf.petiole > 0 ? plan_.petioleStageOf(placeIn(plan_.petioles, roundedLength(leaf.petiole))) : -1;
    planned.leafStage = 1 + static_cast<int>(placeIn(plan_.leafStages, LeafStage{roundedLength(leaf.length), roundedLength(leaf.width), leaf.shape}));
    return planned;
  }

  template <class T>
  static std::size_t placeIn(std::vector<T>& values, const T& value) {
    const auto found = std::find(values.begin(), values.end(), value);
    if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
    values.push_back(value);
    return values.size() - 1;
  }

  const Measurements& m_;
  TurningRule rule_;
  std::vector<glm::dvec3> truth_;
  double steering_ = 0;
  double lengthPlay_ = 0;
  std::vector<double> radii_;
  std::vector<StemFrame> ground_;  ///< of each segment's growing point, which its children turn against
  Plan plan_;
};

}  // namespace

double rounded(double value, int decimals) { return decimals < 0 ? value : roundedTo(value, decimals); }

std::vector<double> radiiOf(const Measurements& measurements, double plantSize) {
  const std::vector<Segment>& segments = measurements.segments;
  std::vector<double> carried(segments.size(), 0);
  for (std::size_t s = segments.size(); s-- > 0;) {
    carried[s] += segments[s].length;
    if (segments[s].parent) carried[static_cast<std::size_t>(segments[s].parent->value)] += carried[s];
  }
  const double most = *std::max_element(carried.begin(), carried.end());
  std::vector<double> shape;
  std::vector<double> factors;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    shape.push_back(std::max(kThinnest, std::sqrt(carried[s] / most)));
    if (segments[s].radius) factors.push_back(*segments[s].radius / shape[s]);
  }
  std::sort(factors.begin(), factors.end());
  const double factor = factors.empty() ? kBaseRadius * plantSize : factors[factors.size() / 2];
  std::vector<double> radii;
  for (std::size_t s = 0; s < segments.size(); ++s) radii.push_back(segments[s].radius.value_or(factor * shape[s]));
  return radii;
}

Result<Plan> planOf(const Measurements& measurements, const EmitOptions& options) {
  if (const auto ok = checkOptions(options); !ok) return ok.failure();
  if (measurements.segments.empty()) return fail(ErrorCode::NoAnswer, "there is no segment to write a grammar for; measure a skeleton with at least one stem");
  return Planner(measurements, options).planned();
}

}  // namespace axil::emit
