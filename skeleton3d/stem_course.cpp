#include "skeleton3d/stem_course.hpp"

#include "skeleton3d/bundle.hpp"
#include "skeleton3d/polyline.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kOnward = 0.8;  // of a step: how far from where its stem would go on an end may be

/// The smooth curve from `before` to `after` that goes on as the stem does on both sides, as a few straight pieces.
std::vector<glm::dvec3> curveBetween(const StemCourse& course, const Neighbours& own) {
  constexpr int kPieces = 8;
  const glm::dvec3 p1 = course.places.at(own.before[0]), p2 = course.places.at(own.after[0]);
  const double chord = glm::length(p2 - p1);
  const auto tangent = [&](const std::vector<NodeId>& beyond, const glm::dvec3& end, double sign) {
    if (beyond.size() < 2) return p2 - p1;
    const glm::dvec3 on = sign * (end - course.places.at(beyond[1])), across = p2 - p1;
    const double a = glm::length(on), b = glm::length(across);
    return a > 0 && b > 0 ? chord * 0.5 * (on / a + across / b) : across;  // the middle of both, not longer than the chord
  };
  const glm::dvec3 m1 = tangent(own.before, p1, 1), m2 = tangent(own.after, p2, -1);
  std::vector<glm::dvec3> curve;
  for (int k = 0; k <= kPieces; ++k) {
    const double f = static_cast<double>(k) / kPieces, f2 = f * f, f3 = f2 * f;
    curve.push_back((2 * f3 - 3 * f2 + 1) * p1 + (f3 - 2 * f2 + f) * m1 + (3 * f2 - 2 * f3) * p2 + (f3 - f2) * m2);
  }
  return curve;
}

double distanceFrom(const std::vector<glm::dvec3>& curve, const glm::dvec3& at) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) least = std::min(least, distanceToPiece(at, curve[i], curve[i + 1]));
  return least;
}

bool isInner(const Neighbours& own) { return !own.before.empty() && !own.after.empty(); }

/// The last segment before an end, or the plant's usual one where that is longer: a trunk's are longer than its twigs'.
double stepBefore(const StemCourse& course, const std::vector<NodeId>& inwards) {
  if (inwards.size() < 2) return course.step;
  return std::max(course.step, glm::length(course.places.at(inwards[0]) - course.places.at(inwards[1])));
}

/// An end is expected a step further along, as far as its stem says which way it runs.
glm::dvec3 onwardFrom(const StemCourse& course, const std::vector<NodeId>& inwards) {
  const glm::dvec3 last = course.places.at(inwards[0]);
  if (inwards.size() < 2) return last;
  const glm::dvec3 run = last - course.places.at(inwards[1]);
  const double length = glm::length(run);
  return length > 0 ? last + stepBefore(course, inwards) / length * run : last;
}

const std::vector<NodeId>& inwardsOf(const Neighbours& end) { return end.before.empty() ? end.after : end.before; }

double scaleBetween(const StemCourse& course, const Neighbours& own) {
  return std::hypot(course.bend * glm::length(course.places.at(own.after[0]) - course.places.at(own.before[0])), course.noise);
}

double scaleOnward(const StemCourse& course, const Neighbours& end) { return std::hypot(kOnward * stepBefore(course, inwardsOf(end)), course.noise); }

/// Squared distance from what one stem lets expect, in its own scale.
double oddness(const StemCourse& course, const Neighbours& own, const glm::dvec3& at) {
  const double off = isInner(own) ? distanceFrom(curveBetween(course, own), at) / scaleBetween(course, own)
                                  : glm::length(at - onwardFrom(course, inwardsOf(own))) / scaleOnward(course, own);
  return off * off;
}

/// What makes the density of one stem's expectation one in all space: across a curve and along it, or about a place.
double normaliser(const StemCourse& course, const Neighbours& own) {
  if (!isInner(own)) return -std::log(kPi * kPi * std::pow(scaleOnward(course, own), 3));
  const double scale = scaleBetween(course, own), length = glm::length(course.places.at(own.after[0]) - course.places.at(own.before[0]));
  return -std::log(kPi * scale * scale * (length + 2 * scale));
}

Neighbours neighboursIn(const std::vector<NodeId>& placed, std::size_t i) {
  Neighbours own;
  for (std::size_t k = 1; k <= 2; ++k) {
    if (i >= k) own.before.push_back(placed[i - k]);
    if (i + k < placed.size()) own.after.push_back(placed[i + k]);
  }
  return own;
}

/// The nodes of a stem that have a place, and the one asked about, each once.
std::vector<NodeId> placedOf(const ClickedStem& stem, const StemCourse& course, NodeId asked) {
  std::vector<NodeId> placed;
  for (const NodeId id : stem.nodes)
    if ((id == asked || course.places.contains(id)) && std::find(placed.begin(), placed.end(), id) == placed.end()) placed.push_back(id);
  return placed;
}

void findNeighbours(const ClickedStem& stem, StemCourse& course) {
  for (const NodeId id : stem.nodes) {
    const std::vector<NodeId> placed = placedOf(stem, course, id);
    Neighbours own = neighboursIn(placed, static_cast<std::size_t>(std::find(placed.begin(), placed.end(), id) - placed.begin()));
    if (own.before.empty() && own.after.empty()) continue;
    auto& all = course.around[id];
    all.insert(isInner(own) ? all.begin() : all.end(), std::move(own));
  }
}

void learn(StemCourse& course) {
  std::vector<double> bends, steps;
  for (const auto& [id, place] : course.places) {
    const auto around = course.around.find(id);
    if (around == course.around.end()) continue;
    const Neighbours& own = around->second.front();
    if (!own.before.empty()) steps.push_back(glm::length(place - course.places.at(own.before[0])));
    if (!isInner(own)) continue;
    const double length = glm::length(course.places.at(own.after[0]) - course.places.at(own.before[0]));
    if (length > 0) bends.push_back(distanceFrom(curveBetween(course, own), place) / length);
  }
  constexpr double kLeastBend = 0.01, kFewest = 5;
  course.step = medianOf(steps);
  if (static_cast<double>(bends.size()) >= kFewest) course.bend = std::max(medianOf(std::move(bends)), kLeastBend);
}

double extentOf(const std::map<NodeId, glm::dvec3>& places) {
  if (places.empty()) return 1;
  glm::dvec3 low = places.begin()->second, high = low;
  for (const auto& [id, at] : places) low = glm::min(low, at), high = glm::max(high, at);
  return std::max(glm::length(high - low), 1e-12);
}

}  // namespace

StemCourse stemCourseOf(std::span<const ClickedStem> stems, std::map<NodeId, glm::dvec3> places, double noise) {
  StemCourse course;
  course.places = std::move(places);
  course.noise = noise;
  course.reach = extentOf(course.places);
  for (const ClickedStem& stem : stems) findNeighbours(stem, course);
  learn(course);
  if (!(course.step > 0)) course.around.clear();
  return course;
}

double expectationAt(const StemCourse& course, NodeId node, const glm::dvec3& at) {
  const auto around = course.around.find(node);
  if (around == course.around.end()) return -3 * std::log(course.reach);
  double sum = normaliser(course, around->second.front()) - 2 * std::log1p(oddness(course, around->second.front(), at));
  for (std::size_t i = 1; i < around->second.size(); ++i) sum -= std::log1p(oddness(course, around->second[i], at));
  return sum;
}

bool leapsAt(const StemCourse& course, NodeId node, const glm::dvec3& at, double times) {
  const auto around = course.around.find(node);
  return around != course.around.end() && oddness(course, around->second.front(), at) > times * times;
}

std::optional<ExpectedPlace> expectedPlace(const StemCourse& course, NodeId node) {
  const auto around = course.around.find(node);
  if (around == course.around.end()) return std::nullopt;
  const Neighbours& own = around->second.front();
  if (!isInner(own)) return ExpectedPlace{onwardFrom(course, inwardsOf(own)), 4 * scaleOnward(course, own)};
  const glm::dvec3 a = course.places.at(own.before[0]), b = course.places.at(own.after[0]);
  return ExpectedPlace{0.5 * (a + b), 0.6 * glm::length(b - a) + 4 * scaleBetween(course, own)};
}

glm::dvec3 directionAt(const StemCourse& course, NodeId node, const glm::dvec3& at) {
  const auto around = course.around.find(node);
  if (around == course.around.end()) return {0, 0, 0};
  const Neighbours& own = around->second.front();
  const glm::dvec3 run = isInner(own) ? course.places.at(own.after[0]) - course.places.at(own.before[0])
                                      : at - course.places.at(own.before.empty() ? own.after[0] : own.before[0]);
  const double length = glm::length(run);
  return length > 0 ? run / length : glm::dvec3{0, 0, 0};
}

}  // namespace axil::skeleton3d::detail
