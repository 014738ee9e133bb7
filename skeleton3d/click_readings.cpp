#include "skeleton3d/click_readings.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve_all.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWrong = 0.05;   // of the clicks, before anything is known of them
constexpr double kAway = 0.05;    // of the photo's longer side: about so far a wrong click is off

/// The logarithm of the probability that a click is wrong and where it is, per squared pixel.
double logWrong(const View& view) {
  const double away = kAway * std::max({view.size_px.x, view.size_px.y, 800});
  return std::log(kWrong / (kPi * away * away));
}

bool isEnd(const StemCourse& course, NodeId node) {
  const auto around = course.around.find(node);
  return around == course.around.end() || around->second.front().before.empty() || around->second.front().after.empty();
}

/// Where a stem ends, in the ground or at a tip, little of it is seen about the place, and any place further in is seen better.
double seenAt(const Grounds& grounds, NodeId node, const glm::dvec3& at) {
  constexpr double kAtEnds = 0.3;
  if (grounds.evidence == nullptr) return 0;
  return (isEnd(grounds.course, node) ? kAtEnds : 1) * evidenceAt(*grounds.evidence, grounds.views, at, directionAt(grounds.course, node, at));
}

/// Clicks of two views or more that are all right.
std::optional<ClickReading> byCrossing(const ClickedNode& right, const Grounds& grounds) {
  const auto solved = solveAll(grounds.views, std::span(&right, 1), {.maxReprojection_px = std::numeric_limits<double>::max()}, "plant units");
  if (!solved || !solved->nodes.front()) return std::nullopt;
  const Node& node = *solved->nodes.front();
  const double variance = grounds.click_px * grounds.click_px, clicks = static_cast<double>(right.clicks.size());
  double squares = 0;
  for (const auto& [view, off_px] : node.reprojection_px) squares += off_px * off_px / variance;
  const double room = glm::determinant(covarianceOfPlace(grounds.views, right, node.position, grounds.click_px)) * std::pow(2 * kPi, 3);
  if (!(room > 0) || !std::isfinite(room)) return std::nullopt;
  ClickReading reading{{}, node.position.at, 0};
  reading.weight = -0.5 * squares + clicks * std::log((1 - kWrong) / (2 * kPi * variance)) + 0.5 * std::log(room) + expectationAt(grounds.course, right.id, reading.at) +
                   seenAt(grounds, right.id, reading.at);
  return reading;
}

/// Space per squared pixel at some depth along a ray.
double areaOfPixel(const Camera& camera, const glm::dvec3& at) {
  if (camera.model == CameraModel::Orthographic) return 1 / (camera.scale_px_per_unit * camera.scale_px_per_unit);
  const double depth = toView(camera, {at}).at.z;
  return depth * depth / (camera.focal_px->x * camera.focal_px->y);
}

/// One right click: the node is on its ray, about where its stem lets one expect it.
std::optional<ClickReading> alongRay(NodeId node, const View& view, PhotoPoint click, const Grounds& grounds) {
  constexpr int kHalf = 60;
  const auto expected = expectedPlace(grounds.course, node);
  if (!expected) return std::nullopt;
  const Ray ray = rayThrough(view.camera, click);
  const double middle = glm::dot(expected->at - ray.origin.at, ray.direction.unit()), step = expected->reach / kHalf;
  const auto placeAt = [&](int k) { return ray.origin.at + (middle + k * step) * ray.direction.unit(); };
  std::map<int, double> weights;  // logarithms
  for (int k = -kHalf; k <= kHalf; ++k)
    if (const glm::dvec3 at = placeAt(k); isInFront(view.camera, {at}))
      weights[k] = expectationAt(grounds.course, node, at) + seenAt(grounds, node, at) + std::log(step * areaOfPixel(view.camera, at));
  if (weights.empty()) return std::nullopt;
  const auto most = std::max_element(weights.begin(), weights.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  double sum = 0, squares = 0;
  for (const auto& [k, weight] : weights) {
    const double share = std::exp(weight - most->second);
    sum += share;
    squares += share * (k - most->first) * (k - most->first);
  }
  ClickReading best{{}, placeAt(most->first), most->second + std::log(sum) + std::log(1 - kWrong)};
  best.sigmaAlong = std::sqrt(squares / sum + 1.0 / 12) * step * ray.direction.unit();
  return best;
}

std::optional<ClickReading> readAs(const ClickedNode& right, const Grounds& grounds) {
  if (right.clicks.size() > 1) return byCrossing(right, grounds);
  const auto& [name, click] = *right.clicks.begin();
  return alongRay(right.id, *findView(grounds.views, name), click, grounds);
}

void normalise(std::vector<ClickReading>& readings) {
  std::stable_sort(readings.begin(), readings.end(), [](const ClickReading& a, const ClickReading& b) { return a.weight > b.weight; });
  if (readings.empty()) return;
  const double most = readings.front().weight;
  double sum = 0;
  for (ClickReading& reading : readings) sum += reading.weight = std::exp(reading.weight - most);
  for (ClickReading& reading : readings) reading.weight /= sum;
}

}  // namespace

std::vector<ClickReading> readingsOf(const ClickedNode& node, const Grounds& grounds) {
  constexpr unsigned kMostViews = 6;  // beyond which not all ways are tried
  const std::vector<std::pair<std::string, PhotoPoint>> clicks(node.clicks.begin(), node.clicks.end());
  const auto count = std::min(static_cast<unsigned>(clicks.size()), kMostViews);
  std::vector<ClickReading> readings;
  for (unsigned choice = 1; choice < 1U << count; ++choice) {
    ClickedNode right{node.id, {}, std::nullopt};
    double wrong = 0;
    for (unsigned i = 0; i < clicks.size(); ++i) {
      if (i >= count || (choice >> i & 1U) != 0)
        right.clicks.insert(clicks[i]);
      else
        wrong += logWrong(*findView(grounds.views, clicks[i].first));
    }
    auto reading = readAs(right, grounds);
    if (!reading) continue;
    reading->weight += wrong;
    for (const auto& [view, click] : right.clicks) reading->right.insert(view);
    readings.push_back(std::move(*reading));
  }
  normalise(readings);
  return readings;
}

}  // namespace axil::skeleton3d::detail
