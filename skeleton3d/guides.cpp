#include "skeleton3d/guides.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::skeleton3d {
namespace {

constexpr int kPieces = 64;        // of a curve: with any lens that checkCamera passes far below a pixel from it
constexpr double kWidest = 4;      // standard deviations beyond which a candidate is none
constexpr double kNoneRight = 0.05;  // weight of none of them being right, against one that fits perfectly

struct Stretch {
  double from = 0;
  double to = 0;
};

/// Where the ray is inside the ball, as distances along it, in front of the camera.
std::optional<Stretch> insideOf(const Ray& ray, const Reach& reach) {
  const glm::dvec3 to = reach.centre.at - ray.origin.at;
  const double along = glm::dot(to, ray.direction.unit());
  const double rest = reach.radius * reach.radius - (glm::dot(to, to) - along * along);
  if (!(rest > 0)) return std::nullopt;
  return Stretch{along - std::sqrt(rest), along + std::sqrt(rest)};
}

PlantPoint pointAt(const Ray& ray, double depth) { return {ray.origin.at + depth * ray.direction.unit()}; }

/// How far the curve moves sideways at `depth` when the click moves by one pixel in each direction: the two combined.
double acrossPerPixel(const View& clicked, PhotoPoint click, const View& other, double depth, glm::dvec2 along) {
  const glm::dvec2 side{-along.y, along.x};
  const glm::dvec2 here = project(other.camera, pointAt(rayThrough(clicked.camera, click), depth)).px;
  double squares = 0;
  for (const glm::dvec2 step : {glm::dvec2{1, 0}, glm::dvec2{0, 1}}) {
    const PlantPoint moved = pointAt(rayThrough(clicked.camera, {click.px + step}), depth);
    if (!isInFront(other.camera, moved)) continue;
    squares += std::pow(glm::dot(project(other.camera, moved).px - here, side), 2);
  }
  return std::sqrt(squares);
}

bool inside(const View& view, glm::dvec2 px) {
  return view.size_px.x <= 0 || (px.x >= 0 && px.y >= 0 && px.x <= view.size_px.x && px.y <= view.size_px.y);
}

std::vector<GuidePoint> curveOf(const View& clicked, PhotoPoint click, const View& other, const Stretch& stretch) {
  const Ray ray = rayThrough(clicked.camera, click);
  std::vector<GuidePoint> curve;
  for (int i = 0; i <= kPieces; ++i) {
    const double depth = stretch.from + (stretch.to - stretch.from) * i / kPieces;
    const PlantPoint point = pointAt(ray, depth);
    if (!isInFront(clicked.camera, point) || !isInFront(other.camera, point)) continue;
    const PhotoPoint at = project(other.camera, point);
    if (inside(other, at.px)) curve.push_back({at, depth, 0});
  }
  return curve;
}

glm::dvec2 directionAt(const std::vector<GuidePoint>& curve, std::size_t i) {
  const glm::dvec2 along = curve[std::min(i + 1, curve.size() - 1)].at.px - curve[i == 0 ? 0 : i - 1].at.px;
  const double length = glm::length(along);
  return length > 0 ? along / length : glm::dvec2{1, 0};
}

struct Nearest {
  double off_px = std::numeric_limits<double>::infinity();
  double sigma_px = 1;
};

Nearest nearestOn(const Guide& guide, PhotoPoint at) {
  Nearest nearest;
  for (std::size_t i = 0; i + 1 < guide.curve.size() || i == 0; ++i) {
    const GuidePoint &a = guide.curve[i], &b = guide.curve[std::min(i + 1, guide.curve.size() - 1)];
    const glm::dvec2 along = b.at.px - a.at.px;
    const double t = glm::dot(along, along) > 0 ? std::clamp(glm::dot(at.px - a.at.px, along) / glm::dot(along, along), 0.0, 1.0) : 0.0;
    if (const double off = glm::length(at.px - a.at.px - t * along); off < nearest.off_px) nearest = {off, a.sigma_px + t * (b.sigma_px - a.sigma_px)};
  }
  return nearest;
}

/// Pixels of the other view per unit at a place of the plant.
double pixelsPerUnit(const Camera& camera, PlantPoint place) {
  return camera.model == CameraModel::Perspective ? camera.focal_px->x / toView(camera, place).at.z : camera.scale_px_per_unit;
}

double square(double value) { return value * value; }

/// Half the sum of squared deviations from what is expected, each measured by how much it usually scatters.
double misfitOf(const GuideCandidate& candidate, const View& other, PlantPoint place, const GuideExpectation& expected) {
  constexpr double kWidthScatter = 0.25, kLengthScatter = 0.7;  // of logarithms: stems taper, internodes differ
  constexpr double kBend_rad = 0.5, kPictureTurn_rad = 0.6;
  double misfit = 0;
  if (expected.width && candidate.width_px && *expected.width > 0 && *candidate.width_px > 0)
    misfit += square(std::log(*candidate.width_px / (*expected.width * pixelsPerUnit(other.camera, place))) / kWidthScatter) / 2;
  if (!expected.before) return misfit;
  const glm::dvec3 step = place.at - expected.before->at;
  const double length = glm::length(step);
  if (!(length > 0)) return misfit;
  if (expected.length && *expected.length > 0) misfit += square(std::log(length / *expected.length) / kLengthScatter) / 2;
  if (expected.direction) misfit += square(angleBetween(*expected.direction, PlantDirection::along(step)).radians() / kBend_rad) / 2;
  if (candidate.along && isInFront(other.camera, *expected.before)) {
    const glm::dvec2 seen = candidate.at.px - project(other.camera, *expected.before).px;
    if (glm::length(seen) > 1) {
      double turn = std::remainder(std::atan2(seen.y, seen.x) - candidate.along->radians(), std::numbers::pi);  // a line has no sense
      misfit += square(turn / kPictureTurn_rad) / 2;
    }
  }
  return misfit;
}

bool isFinite(PhotoPoint p) { return std::isfinite(p.px.x) && std::isfinite(p.px.y); }

}  // namespace

Reach reachOf(std::span<const PlantPoint> placed, double otherwise) {
  if (placed.size() < 2) return {placed.empty() ? PlantPoint{} : placed.front(), otherwise};
  glm::dvec3 low = placed.front().at, high = low;
  for (const PlantPoint& point : placed) {
    low = glm::min(low, point.at);
    high = glm::max(high, point.at);
  }
  constexpr double kLarger = 4.0 / 3;
  return {{0.5 * (low + high)}, std::max(kLarger * 0.5 * glm::length(high - low), 1e-9)};
}

Result<Guide> guideBetween(const View& clicked, PhotoPoint click, const View& other, const Reach& reach, double click_px, double camera_px) {
  for (const View* view : {&clicked, &other}) {
    if (const auto good = checkCamera(view->camera, view->name); !good) return good.failure();
    if (view->camera.model == CameraModel::Unknown) return fail(ErrorCode::BadInput, "the camera of view '" + view->name + "' is unknown; estimate it before guides are drawn");
  }
  if (!isFinite(click) || !(click_px > 0) || !(camera_px >= 0) || !(reach.radius > 0)) return fail(ErrorCode::BadInput, "a guide needs a click, its scatter and a reach that are numbers above zero");
  const auto stretch = insideOf(rayThrough(clicked.camera, click), reach);
  if (!stretch) return fail(ErrorCode::NoAnswer, "the click in view '" + clicked.name + "' points past the plant; no guide can be drawn in view '" + other.name + "'");
  Guide guide{curveOf(clicked, click, other, *stretch)};
  for (std::size_t i = 0; i < guide.curve.size(); ++i)
    guide.curve[i].sigma_px = std::hypot(click_px * acrossPerPixel(clicked, click, other, guide.curve[i].depth, directionAt(guide.curve, i)), camera_px);
  return guide;
}

std::vector<RankedCandidate> rankCandidates(const View& clicked, PhotoPoint click, const View& other, const Guide& guide, std::span<const GuideCandidate> candidates,
                                            const GuideExpectation& expected) {
  std::vector<RankedCandidate> ranked;
  double sum = kNoneRight;
  for (std::size_t i = 0; i < candidates.size() && !guide.curve.empty(); ++i) {
    if (!isFinite(candidates[i].at)) continue;
    const Nearest nearest = nearestOn(guide, candidates[i].at);
    if (!(nearest.off_px <= kWidest * nearest.sigma_px)) continue;
    const ClickedNode both{NodeId(0), {{clicked.name, click}, {other.name, candidates[i].at}}, std::nullopt};
    const View views[] = {clicked, other};
    const auto node = solveNodes(views, std::span(&both, 1), {.maxReprojection_px = std::numeric_limits<double>::max()});
    if (!node) continue;
    const PlantPoint place = node->front().position;
    const double misfit = square(nearest.off_px / nearest.sigma_px) / 2 + misfitOf(candidates[i], other, place, expected);
    ranked.push_back({i, std::clamp(candidates[i].strength, 0.0, 1.0) * std::exp(-misfit), nearest.off_px, place});
    sum += ranked.back().probability;
  }
  for (RankedCandidate& one : ranked) one.probability /= sum;
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedCandidate& a, const RankedCandidate& b) { return a.probability > b.probability; });
  return ranked;
}

}  // namespace axil::skeleton3d
