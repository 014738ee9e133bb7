#include "skeleton3d/snap_place.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/placed_clicks.hpp"
#include "skeleton3d/ridge_scatter.hpp"
#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/statistics.hpp"
#include "skeleton3d/width.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d {
namespace {

/// One click with what was read about it.
struct Sight {
  const View* view = nullptr;
  glm::dvec2 click{0, 0};
  double click_px = 1;  ///< its standard deviation; endless where it tells nothing
  const RidgeReading* ridge = nullptr;
};

/// A residual in sigmas: (project(X) - at) . row.
struct Constraint {
  const View* view = nullptr;
  glm::dvec2 at{0, 0};
  glm::dvec2 row{0, 0};  ///< a direction over its sigma, 1/px
};

glm::dvec2 directionOf(Angle along) { return {std::cos(along.radians()), std::sin(along.radians())}; }

/// The constraints of one click: its own in both directions, and across its stem the ridge's where it is believed.
constexpr double kLeastConfidence = 0.2;  // of a reading whose width counts
constexpr double kTipMissed = 5;     // what it costs not to believe an end that a photo shows, in squared sigmas; all of a node are believed or none

void addConstraints(const Sight& sight, bool believed, bool tips, double cameras_px, std::vector<Constraint>& constraints) {
  constraints.push_back({sight.view, sight.click, {1 / sight.click_px, 0}});
  constraints.push_back({sight.view, sight.click, {0, 1 / sight.click_px}});
  if (!believed) return;
  const glm::dvec2 along = directionOf(sight.ridge->along);
  constraints.push_back({sight.view, sight.ridge->at.px, glm::dvec2{-along.y, along.x} / std::hypot(sight.ridge->sigmaAcross_px, cameras_px)});
  if (tips && sight.ridge->tip) constraints.push_back({sight.view, sight.ridge->tip->px, along / std::hypot(sight.ridge->sigmaTip_px, cameras_px)});
}

/// Pixels a unit of space, two rows; by differences, a thousandth of a pixel wide.
std::array<glm::dvec3, 2> slopesOf(const Camera& camera, PlantPoint point) {
  const Ray ray = rayThrough(camera, project(camera, point));
  const double depth = camera.model == CameraModel::Orthographic ? 1 / camera.scale_px_per_unit : glm::length(point.at - ray.origin.at) / camera.focal_px->x;
  const double h = 0.01 * depth;
  std::array<glm::dvec3, 2> rows{glm::dvec3(0.0), glm::dvec3(0.0)};
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 move(0.0);
    move[i] = h;
    const glm::dvec2 d = (project(camera, {point.at + move}).px - project(camera, {point.at - move}).px) / (2 * h);
    rows[0][i] = d.x;
    rows[1][i] = d.y;
  }
  return rows;
}

struct Placed {
  PlantPoint at;
  glm::dmat3 normal{0.0};
  double squares = 0;
};

double squaresAt(const std::vector<Constraint>& constraints, PlantPoint at) {
  double sum = 0;
  for (const Constraint& c : constraints) sum += std::pow(glm::dot(project(c.view->camera, at).px - c.at, c.row), 2);
  return sum;
}

/// Least squares by Gauss and Newton; starts so near that it needs few steps.
Placed placed(const std::vector<Constraint>& constraints, PlantPoint start) {
  Placed result{start, {}, squaresAt(constraints, start)};
  for (int round = 0; round < 6; ++round) {
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const Constraint& c : constraints) {
      const auto slopes = slopesOf(c.view->camera, result.at);
      const glm::dvec3 row = c.row.x * slopes[0] + c.row.y * slopes[1];
      normal += glm::outerProduct(row, row);
      right -= row * glm::dot(project(c.view->camera, result.at).px - c.at, c.row);
    }
    result.normal = normal;
    const PlantPoint next{result.at.at + glm::inverse(normal) * right};
    const bool visible = std::all_of(constraints.begin(), constraints.end(), [&](const Constraint& c) { return isInFront(c.view->camera, next); });
    if (!visible || !std::isfinite(next.at.x + next.at.y + next.at.z)) break;
    const double squares = squaresAt(constraints, next);
    if (!(squares < result.squares)) break;
    const bool done = result.squares - squares < 1e-9;
    result.at = next;
    result.squares = squares;
    if (done) break;
  }
  return result;
}

/// Minus twice the log of how much less likely it is that the ridge is some other line within the clicks' scatter.
double costOfDisbelief(const RidgeReading& ridge) {
  const double p = std::clamp(ridge.confidence, 0.05, 0.97);
  return 2 * std::log(20 / (2.5 * ridge.sigmaAcross_px)) + 2 * std::log(p / (1 - p));
}

struct Believed {
  Placed placed;
  unsigned which = 0;
  bool tips = false;  ///< whether the ends that photos show were believed
  double cost = 0;
};

/// Every choice of ridges to believe; the likeliest wins. At most kMaxViews are tried in all ways.
Believed mostLikely(const std::vector<Sight>& sights, PlantPoint start, double cameras_px) {
  std::vector<std::size_t> withRidge;
  for (std::size_t i = 0; i < sights.size(); ++i)
    if (sights[i].ridge != nullptr && withRidge.size() < 6) withRidge.push_back(i);
  Believed best;
  const bool anyTip = std::any_of(sights.begin(), sights.end(), [](const Sight& sight) { return sight.ridge != nullptr && sight.ridge->tip; });
  const unsigned all = (1U << withRidge.size()) - 1;
  for (unsigned choice = 0; choice <= (anyTip ? 2 * all + 1 : all); ++choice) {
    const bool tips = choice <= all && anyTip;
    std::vector<Constraint> constraints;
    std::vector<bool> believed(sights.size(), false);
    double cost = 0;
    for (std::size_t k = 0; k < withRidge.size(); ++k) {
      const RidgeReading& ridge = *sights[withRidge[k]].ridge;
      believed[withRidge[k]] = (choice >> k & 1U) != 0;
      if (!believed[withRidge[k]]) cost += costOfDisbelief(ridge);
      if (ridge.tip && !(tips && believed[withRidge[k]])) cost += kTipMissed;
    }
    for (std::size_t i = 0; i < sights.size(); ++i) addConstraints(sights[i], believed[i], tips, cameras_px, constraints);
    const Placed here = placed(constraints, start);
    cost += here.squares;
    if (choice > 0 && !(cost < best.cost)) continue;
    best = {here, 0, tips, cost};
    for (std::size_t i = 0; i < sights.size(); ++i)
      if (believed[i]) best.which |= 1U << i;
  }
  return best;
}

void addRadius(SnappedNode& node, const std::vector<Sight>& sights, unsigned which) {
  std::vector<MeasuredRadius> readings;
  for (std::size_t i = 0; i < sights.size(); ++i)
    if ((which >> i & 1U) != 0 && sights[i].ridge->confidence >= kLeastConfidence) readings.push_back(radiusFrom(*sights[i].view, *sights[i].ridge, node.at));
  if (const auto radius = combinedRadius(readings)) node.radius = radius->radius, node.sigmaRadius = radius->sigma;
}

/// `fixing`: the node as it was placed by clicks alone. What the program clicked beyond them is a place to read, no more.
std::vector<Sight> sightsOf(std::span<const View> views, const ClickedNode& node, const Node& fixing, const RidgeReadings& readings, double click_px) {
  std::vector<Sight> sights;
  for (const auto& [name, click] : node.clicks) {
    const double sigma_px = fixing.reprojection_px.contains(name) ? detail::scatterOf(node, name, click_px) : std::numeric_limits<double>::infinity();
    Sight sight{detail::findView(views, name), click.px, sigma_px, nullptr};
    if (const auto view = readings.find(name); view != readings.end())
      if (const auto found = view->second.find(node.id); found != view->second.end()) sight.ridge = &found->second;
    sights.push_back(sight);
  }
  return sights;
}

/// What one reading says of its stem's radius, where it was believed.
std::optional<MeasuredRadius> believedRadius(const View& view, const SnappedNode& node, const RidgeReadings& readings) {
  const auto inView = readings.find(view.name);
  if (inView == readings.end() || std::find(node.snappedIn.begin(), node.snappedIn.end(), view.name) == node.snappedIn.end()) return std::nullopt;
  const RidgeReading& ridge = inView->second.at(node.id);
  if (ridge.confidence < kLeastConfidence) return std::nullopt;
  const double radius = radiusFrom(view, ridge, node.at).radius;
  return MeasuredRadius{radius, radius * std::hypot(ridge.sigmaWidth_px / ridge.width_px, 0.06)};
}

/// The readings of one stem's nodes, one each, with relative sigmas: by absolute ones a narrow mistake would outweigh all else.
/// What is far wider than `widest` is something behind it: a branch is no thicker than its parent where it leaves it.
struct AlongStem {
  std::vector<MeasuredRadius> radii;
  std::vector<NodeId> whose;
};

/// How much of its length a stem about node `i` of `places` shows in a view: 1 from its side, 0 from its end.
double lengthSeen(const View& view, std::span<const SnappedNode* const> places, std::size_t i) {
  const glm::dvec3 run = places[std::min(i + 1, places.size() - 1)]->at.at - places[i > 0 ? i - 1 : 0]->at.at;
  const Ray ray = rayThrough(view.camera, project(view.camera, places[i]->at));
  return glm::length(run) > 0 ? glm::length(glm::cross(glm::normalize(run), ray.direction.unit())) : 1;
}

/// The views that show most of the stem's length at node `i`; from its end it has no edges along it, but whatever it hides has.
std::vector<const View*> viewsFromTheSide(std::span<const View> views, std::span<const SnappedNode* const> places, std::size_t i) {
  constexpr double kShare = 0.5;  // of the most that a view shows
  double most = 0;
  for (const View& view : views) most = std::max(most, lengthSeen(view, places, i));
  std::vector<const View*> good;
  for (const View& view : views)
    if (lengthSeen(view, places, i) >= kShare * most) good.push_back(&view);
  return good;
}

AlongStem alongStem(std::span<const View> views, std::span<const SnappedNode* const> places, std::size_t firstOwn, const RidgeReadings& readings, double widest) {
  constexpr double kLeeway = 1.25;
  AlongStem along;
  for (std::size_t i = firstOwn; i < places.size(); ++i) {
    std::vector<MeasuredRadius> here;
    for (const View* view : viewsFromTheSide(views, places, i))
      if (const auto radius = believedRadius(*view, *places[i], readings); radius && radius->radius < kLeeway * widest) here.push_back(*radius);
    if (const auto radius = combinedRadius(here)) along.radii.push_back({radius->radius, radius->sigma / radius->radius}), along.whose.push_back(places[i]->id);
  }
  return along;
}

/// A radius for every node that has readings, from all readings of its stem as a taper; parents first, as far as stems come in that order.
std::map<NodeId, double> taperedRadiiOf(std::span<const View> views, std::span<const SnappedNode> placed, std::span<const ClickedStem> stems, const RidgeReadings& readings) {
  std::map<NodeId, const SnappedNode*> byId;
  for (const SnappedNode& node : placed) byId[node.id] = &node;
  std::map<NodeId, double> radii;
  for (std::size_t s = 0; s < stems.size(); ++s) {
    std::vector<const SnappedNode*> places;
    for (const NodeId id : stems[s].nodes)
      if (const auto node = byId.find(id); node != byId.end()) places.push_back(node->second);
    if (places.empty()) continue;
    const bool branches = s > 0 && places.front()->id == stems[s].nodes.front();
    const auto parent = branches ? radii.find(places.front()->id) : radii.end();
    const double widest = parent == radii.end() ? std::numeric_limits<double>::max() : parent->second;
    const AlongStem along = alongStem(views, places, branches ? 1 : 0, readings, widest);
    const std::vector<double> tapered = taperedRadii(along.radii);
    for (std::size_t i = 0; i < tapered.size(); ++i) radii[along.whose[i]] = tapered[i];
  }
  return radii;
}

}  // namespace

ExpectedRidges expectedRidges(std::span<const View> views, std::span<const SnappedNode> placed, std::span<const ClickedStem> stems, const RidgeReadings& readings) {
  const std::map<NodeId, double> radii = taperedRadiiOf(views, placed, stems, readings);
  ExpectedRidges expected;
  for (const View& view : views)
    for (const SnappedNode& node : placed) {
      const auto slopes = slopesOf(view.camera, node.at);
      const auto radius = radii.find(node.id);
      const double pixels = std::max(glm::length(slopes[0]), glm::length(slopes[1]));
      expected[view.name][node.id] = {project(view.camera, node.at).px, radius == radii.end() ? 0 : 2 * radius->second * pixels};
    }
  return expected;
}

RidgeReadings readAllRidges(const Photos& photos, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems, const SnapOptions& options, const ExpectedRidges& expected) {
  RidgeReadings readings;
  for (const auto& [view, photo] : photos) {
    const auto known = expected.find(view);
    readings[view] = readRidges(photo, view, nodes, stems, options, known == expected.end() ? std::map<NodeId, ExpectedRidge>{} : known->second);
  }
  return readings;
}

RidgeReadings believedReadings(const RidgeReadings& readings, std::span<const SnappedNode> placed) {
  RidgeReadings believed;
  for (const SnappedNode& node : placed)
    for (const std::string& view : node.snappedIn) believed[view].emplace(node.id, readings.at(view).at(node.id));
  return believed;
}

RidgeReadings withTrueScatter(RidgeReadings readings, std::span<const View> views, std::span<const SnappedNode> placed) {
  std::vector<double> shares;
  for (const SnappedNode& node : placed) {
    double squares = 0;
    for (const std::string& name : node.snappedIn) {
      const RidgeReading& ridge = readings.at(name).at(node.id);
      const glm::dvec2 along = directionOf(ridge.along), off = project(detail::findView(views, name)->camera, node.at).px - ridge.at.px;
      squares += std::pow(glm::dot(off, glm::dvec2{-along.y, along.x}) / ridge.sigmaAcross_px, 2);
    }
    const int freedom = static_cast<int>(node.snappedIn.size()) - 2;  // two lines always meet nearly
    if (freedom > 0) shares.push_back(squares / detail::chiSquaredMedian(freedom));
  }
  constexpr std::size_t kFewest = 5;
  if (shares.size() < kFewest) return readings;
  const double factor = std::sqrt(std::max(detail::medianOf(std::move(shares)), 1.0));
  for (auto& [view, nodes] : readings)
    for (auto& [id, ridge] : nodes) ridge.sigmaAcross_px *= factor;
  return readings;
}

Result<std::vector<SnappedNode>> placeSnapped(std::span<const View> views, std::span<const ClickedNode> nodes, const RidgeReadings& readings, double click_px,
                                              double cameras_px) {
  const auto solved = detail::solveAll(views, nodes, {.click_px = click_px}, "plant units");
  if (!solved) return solved.failure();
  std::vector<SnappedNode> result;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!solved->nodes[i]) continue;
    const std::vector<Sight> sights = sightsOf(views, nodes[i], *solved->nodes[i], readings, click_px);
    const Believed best = mostLikely(sights, solved->nodes[i]->position, cameras_px);
    SnappedNode node{nodes[i].id, best.placed.at, glm::inverse(best.placed.normal), {}};
    for (std::size_t k = 0; k < sights.size(); ++k)
      if ((best.which >> k & 1U) != 0) node.snappedIn.push_back(sights[k].view->name);
    node.tipSeen = best.tips;
    addRadius(node, sights, best.which);
    result.push_back(std::move(node));
  }
  return result;
}

Result<Snapping> snapNodes(std::span<const View> views, const Photos& photos, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems,
                           const SnapOptions& options) {
  Snapping snapping;
  snapping.readings = readAllRidges(photos, nodes, stems, options);
  auto placed = placeSnapped(views, nodes, snapping.readings, options.click_px);
  if (!placed) return placed.failure();
  const ExpectedRidges expected = expectedRidges(views, *placed, stems, snapping.readings);
  snapping.readings = detail::withWidthScatter(readAllRidges(photos, nodes, stems, options, expected), expected);
  placed = placeSnapped(views, nodes, snapping.readings, options.click_px);
  if (!placed) return placed.failure();
  snapping.readings = withTrueScatter(std::move(snapping.readings), views, *placed);
  placed = placeSnapped(views, nodes, snapping.readings, options.click_px);
  if (!placed) return placed.failure();
  snapping.nodes = *std::move(placed);
  return snapping;
}

Skeleton withSnapped(Skeleton skeleton, std::span<const View> views, std::span<const ClickedNode> clicks, std::span<const SnappedNode> snapped) {
  for (Node& node : skeleton.nodes) {
    const auto place = std::find_if(snapped.begin(), snapped.end(), [&](const SnappedNode& s) { return s.id == node.id; });
    const auto click = std::find_if(clicks.begin(), clicks.end(), [&](const ClickedNode& c) { return c.id == node.id; });
    if (place == snapped.end() || click == clicks.end()) continue;
    node.position = place->at;
    node.sigma = {std::sqrt(place->covariance[0][0]), std::sqrt(place->covariance[1][1]), std::sqrt(place->covariance[2][2])};
    if (!node.radius) node.radius = place->radius;
    for (auto& [name, off] : node.reprojection_px)
      if (const View* view = detail::findView(views, name)) off = glm::length(project(view->camera, place->at).px - click->clicks.at(name).px);
  }
  return skeleton;
}

}  // namespace axil::skeleton3d
