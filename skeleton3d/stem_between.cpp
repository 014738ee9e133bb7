#include "skeleton3d/stem_between.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/live_wire_prepared.hpp"
#include "skeleton3d/polyline.hpp"
#include "skeleton3d/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d {
namespace {

using detail::StemCell;
using detail::StemnessMap;

constexpr std::size_t kMostSteps = 140;   ///< places of the way that are matched
constexpr int kMostDepths = 500;
constexpr double kStep_px = 2;            ///< of the other view, from one depth to the next
constexpr double kSteepest = 5;           ///< depth against breadth, of a stem in the first view's frame
constexpr double kFar = 1e6;              ///< a cost that is never chosen

/// The depths that are tried, the same for all places of the way: along the first camera's axis, project's unit.
struct Depths {
  double from = 0, step = 0;
  int count = 0;

  [[nodiscard]] double at(int j) const { return from + step * j; }
};

/// The place of a ray at a depth along the camera's axis.
PlantPoint atDepth(const Camera& camera, PhotoPoint px, double depth) {
  const Ray ray = rayThrough(camera, px);
  const double start = toView(camera, ray.origin).at.z, slope = toView(camera, {ray.origin.at + ray.direction.unit()}).at.z - start;
  return {ray.origin.at + (depth - start) / slope * ray.direction.unit()};
}

double pixelsPerUnit(const Camera& camera, PlantPoint at) {
  return camera.model == CameraModel::Orthographic ? camera.scale_px_per_unit : camera.focal_px->x / std::max(toView(camera, at).at.z, 1e-9);
}

Depths depthsFor(const View& first, const View& other, const Reach& reach) {
  const double middle = toView(first.camera, reach.centre).at.z;
  double nearest = middle - reach.radius;
  const double furthest = middle + reach.radius;
  if (first.camera.model == CameraModel::Perspective) nearest = std::max(nearest, 0.05 * furthest);
  const int count = static_cast<int>((furthest - nearest) * pixelsPerUnit(other.camera, reach.centre) / kStep_px) + 2;
  Depths depths{nearest, 0, std::clamp(count, 16, kMostDepths)};
  depths.step = (furthest - nearest) / (depths.count - 1);
  return depths;
}

/// A place of the way at one depth, as the other photo sees it.
struct State {
  glm::dvec2 px{0, 0};
  glm::dvec2 along{0, 0};  ///< of the stem there; 0: none
  float worth = 0;         ///< 0 to 1: that the stem is there
  bool seen = false;
};

/// The likeliest stem near `px`, within the band.
State stateAt(const StemnessMap& stems, glm::dvec2 px, double band_px, double width_px) {
  constexpr float kClear = 40;  // grey levels, as for the way in the first photo
  State state{px, {0, 0}, 0, true};
  const glm::ivec2 low = stems.cellOf(px - 2.0 * band_px), high = stems.cellOf(px + 2.0 * band_px);
  for (int row = low.y; row <= high.y; ++row)
    for (int column = low.x; column <= high.x; ++column) {
      const StemCell& cell = stems.at(column, row);
      if (!(cell.strength > 0)) continue;
      const double off = glm::length(glm::dvec2(cell.at) - px) / band_px, odd = width_px > 0 ? std::log(cell.width_px / width_px) / 0.6 : 0;
      const float clear = cell.strength * cell.strength / (cell.strength * cell.strength + kClear * kClear);
      const double worth = (0.6F * stems.likeness(cell) + 0.4F * clear) * std::exp(-0.5 * off * off) / (1 + 0.5 * odd * odd);
      if (worth > state.worth) state.worth = static_cast<float>(worth), state.along = cell.along;
    }
  return state;
}

/// The way in the first view, thinned out.
std::vector<WireNode> stepsOf(const WirePath& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.line.size(); ++i) length += glm::length(path.line[i].at.px - path.line[i - 1].at.px);
  const double least = std::max(4.0, length / kMostSteps);
  std::vector<WireNode> steps;
  for (const WireNode& node : path.line)
    if (steps.empty() || glm::length(node.at.px - steps.back().at.px) >= least) steps.push_back(node);
  if (!path.line.empty() && steps.size() > 1 && steps.back() != path.line.back()) steps.back() = path.line.back();
  return steps;
}

struct Lattice {
  Depths depths;
  std::vector<WireNode> steps;
  std::vector<std::vector<State>> states;   ///< of each step, by depth
  std::vector<double> breadth;              ///< from the step before, project's unit
};

double largestWidth(const std::vector<WireNode>& steps, std::size_t i) {
  return steps[i].confidence > 0.3 ? steps[i].width_px : 0;
}

Lattice latticeOf(const View& first, const WirePath& path, const View& other, const StemnessMap& stems, const Reach& reach, const BetweenOptions& options) {
  Lattice lattice{depthsFor(first, other, reach), stepsOf(path), {}, {}};
  const double band = std::max(1.5 * options.click_px, 0.7 * stems.cell_px);
  for (std::size_t i = 0; i < lattice.steps.size(); ++i) {
    std::vector<State> states;
    const PhotoPoint px = lattice.steps[i].at;
    // A ray is straight and so is its picture but for the lens: the two ends give the ray, each depth is projected.
    const PlantPoint a = atDepth(first.camera, px, lattice.depths.from), b = atDepth(first.camera, px, lattice.depths.at(lattice.depths.count - 1));
    for (int j = 0; j < lattice.depths.count; ++j) {
      const PlantPoint at{glm::mix(a.at, b.at, static_cast<double>(j) / (lattice.depths.count - 1))};
      if (!isInFront(other.camera, at)) {
        states.emplace_back();
        continue;
      }
      const glm::dvec2 there = project(other.camera, at).px;
      const bool inside = there.x >= 0 && there.y >= 0 && there.x <= stems.columns * stems.cell_px && there.y <= stems.rows * stems.cell_px;
      const double width = largestWidth(lattice.steps, i) / pixelsPerUnit(first.camera, at) * pixelsPerUnit(other.camera, at);
      states.push_back(inside ? stateAt(stems, there, band, width) : State{});
    }
    lattice.states.push_back(std::move(states));
    const double middle = lattice.depths.at(lattice.depths.count / 2);
    lattice.breadth.push_back(i == 0 ? 0 : glm::length(atDepth(first.camera, px, middle).at - atDepth(first.camera, lattice.steps[i - 1].at, middle).at));
  }
  return lattice;
}

/// What a step from one state to the next costs. As long as it is in space, dearer where no stem is, where it runs across the
/// stem's own direction, and the steeper it goes into depth.
double costBetween(const State& a, const State& b, double breadth, double leap) {
  const glm::dvec2 step = b.px - a.px;
  const double length = glm::length(step), steep = leap / breadth;
  const auto astray = [&](const State& s) {
    const double sine = length > 0.5 ? (step.x * s.along.y - step.y * s.along.x) / length : 0;
    return 0.5 * s.worth * sine * sine * std::min(length / 4, 1.0);
  };
  const double bad = 1 - 0.5 * (a.worth + b.worth) + astray(a) + astray(b);
  return (0.2 + bad) * std::sqrt(1 + steep * steep) + 0.02 * steep * steep;
}

/// One depth a step.
struct Course {
  std::vector<int> depth;
  double cost = 0;
};

Course cheapestCourse(const Lattice& lattice, const std::vector<std::vector<float>>& extra) {
  const std::size_t steps = lattice.states.size();
  const int count = lattice.depths.count;
  std::vector<std::vector<double>> cost(steps, std::vector<double>(static_cast<std::size_t>(count), kFar));
  std::vector<std::vector<int>> before(steps, std::vector<int>(static_cast<std::size_t>(count), -1));
  for (int j = 0; j < count; ++j) cost[0][static_cast<std::size_t>(j)] = lattice.states[0][static_cast<std::size_t>(j)].seen ? extra[0][static_cast<std::size_t>(j)] : kFar;
  for (std::size_t i = 1; i < steps; ++i) {
    const int leap = std::max(2, static_cast<int>(std::ceil(kSteepest * lattice.breadth[i] / lattice.depths.step)));
    for (int j = 0; j < count; ++j) {
      const auto here = static_cast<std::size_t>(j);
      if (!lattice.states[i][here].seen) continue;
      for (int k = std::max(0, j - leap); k <= std::min(count - 1, j + leap); ++k) {
        const auto there = static_cast<std::size_t>(k);
        if (cost[i - 1][there] >= cost[i][here]) continue;
        const double sum = cost[i - 1][there] + costBetween(lattice.states[i - 1][there], lattice.states[i][here], std::max(lattice.breadth[i], 1e-12), (j - k) * lattice.depths.step);
        if (sum < cost[i][here]) cost[i][here] = sum, before[i][here] = k;
      }
      cost[i][here] += extra[i][here];
    }
  }
  Course course;
  const auto last = std::min_element(cost.back().begin(), cost.back().end());
  course.cost = *last;
  if (course.cost >= kFar) return course;
  course.depth.assign(steps, 0);
  course.depth.back() = static_cast<int>(last - cost.back().begin());
  for (std::size_t i = steps - 1; i > 0; --i) course.depth[i - 1] = before[i][static_cast<std::size_t>(course.depth[i])];
  return course;
}

using Extra = std::vector<std::vector<float>>;

/// A known end: the states of its step cost the more the further they are from it.
void addEnd(Extra& extra, const Lattice& lattice, std::size_t step, glm::dvec2 px, double scatter_px) {
  for (std::size_t j = 0; j < extra[step].size(); ++j) {
    const double off = glm::length(lattice.states[step][j].px - px) / scatter_px;
    extra[step][j] += static_cast<float>(std::min(0.5 * off * off, 1e4));
  }
}

Extra knownEnds(const Lattice& lattice, const View& other, const BetweenOptions& options) {
  Extra extra(lattice.states.size(), std::vector<float>(static_cast<std::size_t>(lattice.depths.count), 0.0F));
  const double scatter = std::max(3 * options.click_px, 4.0);
  if (options.base && isInFront(other.camera, *options.base)) addEnd(extra, lattice, 0, project(other.camera, *options.base).px, scatter);
  if (options.startInOther) addEnd(extra, lattice, 0, options.startInOther->px, scatter);
  if (options.endInOther) addEnd(extra, lattice, lattice.states.size() - 1, options.endInOther->px, scatter);
  return extra;
}

/// How much dearer the best course is that runs elsewhere, for each step.
double leadOver(const Lattice& lattice, Extra extra, const Course& best) {
  constexpr double kElsewhere_px = 12;
  for (std::size_t i = lattice.states.size() / 3; i < lattice.states.size(); ++i)
    for (std::size_t j = 0; j < extra[i].size(); ++j)
      if (glm::length(lattice.states[i][j].px - lattice.states[i][static_cast<std::size_t>(best.depth[i])].px) < kElsewhere_px) extra[i][j] += 3;
  const Course rival = cheapestCourse(lattice, extra);
  return (rival.cost - best.cost) / static_cast<double>(lattice.states.size());
}

/// A line with the length up to each of its places.
struct Measured {
  std::vector<WireNode> line;
  std::vector<double> upTo;

  [[nodiscard]] glm::dvec2 at(double length) const {
    const std::size_t after = std::clamp<std::size_t>(static_cast<std::size_t>(std::upper_bound(upTo.begin(), upTo.end(), length) - upTo.begin()), 1, upTo.size() - 1);
    const double span = upTo[after] - upTo[after - 1], share = span > 0 ? (length - upTo[after - 1]) / span : 0;
    return glm::mix(line[after - 1].at.px, line[after].at.px, share);
  }
};

/// The stem's centre line in the other photo along the places that were matched, whose steps of depth are taken out.
Measured centreLine(const LiveWire& photo, const std::vector<glm::dvec2>& seen, const std::vector<double>& widths) {
  std::vector<glm::dvec2> places;
  std::vector<double> widthThere;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::size_t half = std::min({std::size_t{3}, i, seen.size() - 1 - i});
    glm::dvec2 sum(0.0);
    for (std::size_t k = i - half; k <= i + half; ++k) sum += seen[k] / static_cast<double>(2 * half + 1);
    if (!places.empty() && glm::length(sum - places.back()) < 3 && i + 1 < seen.size()) continue;
    places.push_back(sum);
    widthThere.push_back(widths[i]);
  }
  Measured measured{detail::refinedAlong(photo.prepared(), places, widthThere), {0}};
  for (std::size_t i = 1; i < measured.line.size(); ++i) measured.upTo.push_back(measured.upTo.back() + glm::length(measured.line[i].at.px - measured.line[i - 1].at.px));
  return measured;
}

/// Where on the line the picture of a ray meets it, and how well that is determined.
struct Crossing {
  double length = 0;
  double weight = 0;
};

Crossing crossingOf(const Measured& measured, glm::dvec2 px, glm::dvec2 rayAlong) {
  const std::vector<WireNode>& line = measured.line;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (glm::length(line[i].at.px - px) < glm::length(line[nearest].at.px - px)) nearest = i;
  const std::size_t a = nearest < 2 ? 0 : nearest - 2, b = std::min(nearest + 2, line.size() - 1);
  const glm::dvec2 chord = line[b].at.px - line[a].at.px;
  if (!(glm::length(chord) > 1e-6)) return {measured.upTo[nearest], 1e-3};
  const glm::dvec2 along = glm::normalize(chord), across{-rayAlong.y, rayAlong.x};
  const double toFoot = glm::dot(px - line[nearest].at.px, along), crossing = glm::dot(along, across);
  const glm::dvec2 foot = line[nearest].at.px + toFoot * along;
  const double slide = std::abs(crossing) < 0.15 ? 0 : std::clamp(glm::dot(px - foot, across) / crossing, -8.0, 8.0);
  return {measured.upTo[nearest] + toFoot + slide, crossing * crossing + 1e-3};
}

/// The crossings as a steady course along the line: a straight fit about each, those well determined counting most.
std::vector<double> steady(const std::vector<Crossing>& crossings) {
  constexpr std::ptrdiff_t kReach = 5;
  std::vector<double> result;
  const auto count = static_cast<std::ptrdiff_t>(crossings.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double s0 = 0, s1 = 0, s2 = 0, y0 = 0, y1 = 0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - kReach); k <= std::min(count - 1, i + kReach); ++k) {
      const Crossing& c = crossings[static_cast<std::size_t>(k)];
      const auto x = static_cast<double>(k - i);
      const double weight = c.weight * (1 - x * x / ((kReach + 1) * (kReach + 1)));
      s0 += weight, s1 += weight * x, s2 += weight * x * x, y0 += weight * c.length, y1 += weight * x * c.length;
    }
    const double d = s0 * s2 - s1 * s1;
    result.push_back(d > 1e-9 * s0 * s0 ? (s2 * y0 - s1 * y1) / d : y0 / s0);
  }
  return result;
}

PlantPoint placeOf(const View& first, PhotoPoint a, const View& other, PhotoPoint b, PlantPoint otherwise) {
  const ClickedNode both{NodeId(0), {{"a", a}, {"b", b}}, std::nullopt};
  const View views[] = {{"a", first.camera, {0, 0}}, {"b", other.camera, {0, 0}}};
  const auto node = solveNodes(views, std::span(&both, 1), {.maxReprojection_px = std::numeric_limits<double>::max()});
  return node ? node->front().position : otherwise;
}

std::vector<StemPlace> placesOf(const View& first, const View& other, const LiveWire& photo, const Lattice& lattice, const Course& course) {
  std::vector<glm::dvec2> seen;
  std::vector<double> widths;
  std::vector<PlantPoint> coarse;
  for (std::size_t i = 0; i < course.depth.size(); ++i) {
    coarse.push_back(atDepth(first.camera, lattice.steps[i].at, lattice.depths.at(course.depth[i])));
    seen.push_back(lattice.states[i][static_cast<std::size_t>(course.depth[i])].px);
    widths.push_back(largestWidth(lattice.steps, i) / pixelsPerUnit(first.camera, coarse.back()) * pixelsPerUnit(other.camera, coarse.back()));
  }
  const Measured measured = centreLine(photo, seen, widths);
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto depth = static_cast<std::size_t>(course.depth[i]);
    const std::vector<State>& states = lattice.states[i];
    const glm::dvec2 ray = states[std::min(depth + 1, states.size() - 1)].px - states[depth == 0 ? 0 : depth - 1].px;
    crossings.push_back(crossingOf(measured, seen[i], glm::length(ray) > 0 ? glm::normalize(ray) : glm::dvec2{1, 0}));
  }
  const std::vector<double> lengths = steady(crossings);
  std::vector<StemPlace> places;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const PhotoPoint there{measured.at(lengths[i])};
    const State& state = lattice.states[i][static_cast<std::size_t>(course.depth[i])];
    places.push_back({lattice.steps[i].at, there, placeOf(first, lattice.steps[i].at, other, there, coarse[i]), lattice.steps[i].width_px, static_cast<double>(state.worth)});
  }
  return places;
}

double typicalConfidence(const std::vector<StemPlace>& places) {
  std::vector<double> all;
  for (const StemPlace& place : places) all.push_back(place.confidence);
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

Result<void> checked(const View& first, const WirePath& path, const View& other, const Reach& reach) {
  for (const View* view : {&first, &other}) {
    if (const auto good = checkCamera(view->camera, view->name); !good) return good.failure();
    if (view->camera.model == CameraModel::Unknown) return fail(ErrorCode::BadInput, "the camera of view '" + view->name + "' is unknown; estimate it before stems are traced between views");
  }
  if (path.line.size() < 2 || !(reach.radius > 0)) return fail(ErrorCode::BadInput, "a stem to be found in view '" + other.name + "' needs a way of some length and a reach above zero");
  return {};
}

}  // namespace

Result<StemBetween> tracedInOtherView(const View& first, const WirePath& path, const View& other, const LiveWire& otherPhoto, const Reach& reach, const BetweenOptions& options) {
  if (const auto good = checked(first, path, other, reach); !good) return good.failure();
  const Lattice lattice = latticeOf(first, path, other, otherPhoto.prepared().stems, reach, options);
  if (lattice.steps.size() < 2) return fail(ErrorCode::BadInput, "the way is too short to be found again in view '" + other.name + "'");
  const Extra ends = knownEnds(lattice, other, options);
  const Course course = cheapestCourse(lattice, ends);
  if (course.depth.empty()) return fail(ErrorCode::NoAnswer, "the stem of view '" + first.name + "' is outside what view '" + other.name + "' shows");
  StemBetween stem;
  stem.line = placesOf(first, other, otherPhoto, lattice, course);
  std::vector<glm::dvec4> both;
  for (const StemPlace& place : stem.line) both.push_back({place.inFirst.px, place.inOther.px});
  for (const std::size_t i : detail::fewWithin(both, options.tolerance_px)) stem.nodes.push_back(stem.line[i]);
  stem.confidence = typicalConfidence(stem.line) * (1 - std::exp(-std::max(leadOver(lattice, ends, course), 0.0) / 0.08));
  return stem;
}

}  // namespace axil::skeleton3d
