#include "skeleton3d/photographed.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/placed_clicks.hpp"
#include "skeleton3d/ridge_scatter.hpp"
#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/stem_evidence.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::skeleton3d {
namespace {

/// What stays the same from round to round.
struct Task {
  std::span<const View> views;
  const std::map<std::string, UnknownCameraHints>& hints;
  const Photos& photos;
  std::span<const ClickedNode> nodes;  ///< as a person clicked them
  EstimateOptions options;
};

SnapOptions snapOptionsFor(const EstimatedCameras& cameras) {
  constexpr double kSurest_px = 1, kLoosest_px = 6;  // of clicks, as far as looking for a line beside them goes
  SnapOptions options;
  options.click_px = std::clamp(cameras.uncertainty.click_px, kSurest_px, kLoosest_px);
  return options;
}

Result<void> place(Photographed& found, std::span<const ClickedNode> kept, double cameras_px) {
  auto placed = placeSnapped(found.cameras.views, kept, found.snapping.readings, found.cameras.uncertainty.click_px, cameras_px);
  if (!placed) return placed.failure();
  found.snapping.nodes = *std::move(placed);
  return {};
}

/// The cameras again, by the centre lines that were believed; how clicks scatter is what the clicks alone said.
Result<void> estimateAgain(const Task& task, std::span<const SnappedNode> between, Photographed& found) {
  const Uncertainty clicks = found.cameras.uncertainty;
  EstimateOptions options = task.options;
  options.click_px = clicks.click_px;
  found.snapping.readings = withTrueScatter(std::move(found.snapping.readings), found.cameras.views, found.snapping.nodes);
  options.centreLines = believedReadings(found.snapping.readings, found.snapping.nodes);
  for (auto& [view, lines] : believedReadings(found.snapping.readings, between)) options.centreLines[view].insert(lines.begin(), lines.end());
  auto better = estimateCameras(task.views, task.hints, task.nodes, options);
  if (!better) return better.failure();
  found.cameras = *std::move(better);
  found.cameras.uncertainty.clickWasFound = clicks.clickWasFound;
  found.cameras.uncertainty.freedom = clicks.freedom;
  return {};
}

/// The clicks as they are, and between them places along the stems that nobody clicked.
struct Course {
  std::vector<ClickedNode> nodes;    ///< the first `clicked` are those that were clicked
  std::vector<ClickedStem> stems;
  ExpectedRidges expected;
  std::size_t clicked = 0;

  [[nodiscard]] std::span<const ClickedNode> between() const { return std::span(nodes).subspan(clicked); }
};

/// Between two nodes of a stem, `f` of the way, on the curve that its neighbours make smooth (Catmull and Rom).
glm::dvec3 onCurve(const std::vector<glm::dvec3>& places, std::size_t i, double f) {
  const glm::dvec3 b = places[i], c = places[i + 1], a = i > 0 ? places[i - 1] : 2.0 * b - c, d = i + 2 < places.size() ? places[i + 2] : 2.0 * c - b;
  const double ab = glm::length(b - a), bc = glm::length(c - b), cd = glm::length(d - c);
  const glm::dvec3 m1 = (c - a) / (ab + bc) * bc, m2 = (d - b) / (bc + cd) * bc;
  const double f2 = f * f, f3 = f2 * f;
  return (2 * f3 - 3 * f2 + 1) * b + (f3 - 2 * f2 + f) * m1 + (3 * f2 - 2 * f3) * c + (f3 - f2) * m2;
}

/// As wide as between its neighbours, `f` of the way from one to the other; 0 where neither is known.
double widthBetween(double a, double b, double f) { return a > 0 && b > 0 ? (1 - f) * a + f * b : std::max(a, b); }

/// Adds a place where every photo would show it; it is wide as the stem is about there.
void addBetween(const std::vector<View>& views, const ExpectedRidges& known, const std::array<NodeId, 2>& ends, double f, const glm::dvec3& at, NodeId id, Course& course) {
  ClickedNode node{id, {}, std::nullopt};
  for (const View& view : views) {
    if (!isInFront(view.camera, {at})) continue;
    const PhotoPoint px = project(view.camera, {at});
    if (!(px.px.x > 0 && px.px.y > 0 && px.px.x < view.size_px.x && px.px.y < view.size_px.y)) continue;
    const auto& own = known.at(view.name);
    node.clicks[view.name] = px;
    course.expected[view.name][id] = {px.px, widthBetween(own.at(ends[0]).width_px, own.at(ends[1]).width_px, f)};
  }
  course.nodes.push_back(std::move(node));
}

/// How many places a segment has room for whose readings do not share pixels.
int roomFor(const std::vector<View>& views, const ExpectedRidges& known, const std::array<NodeId, 2>& ends) {
  constexpr double kApart_px = 25, kWidths = 2;
  constexpr int kMost = 8;
  double room = 0;
  for (const View& view : views) {
    const ExpectedRidge &a = known.at(view.name).at(ends[0]), &b = known.at(view.name).at(ends[1]);
    room = std::max(room, glm::length(b.at - a.at) / (kApart_px + kWidths * std::max(a.width_px, b.width_px)));
  }
  return std::min(static_cast<int>(room), kMost);
}

/// A stem with places between its nodes.
ClickedStem filled(const ClickedStem& stem, const std::map<NodeId, glm::dvec3>& placed, const std::vector<View>& views, const ExpectedRidges& known, int& next, Course& course) {
  ClickedStem fuller{stem.id, {}};
  std::vector<glm::dvec3> places;
  for (const NodeId id : stem.nodes)
    if (const auto at = placed.find(id); at != placed.end() && (places.empty() || glm::length(at->second - places.back()) > 0)) fuller.nodes.push_back(id), places.push_back(at->second);
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < fuller.nodes.size(); ++i) {
    nodes.push_back(fuller.nodes[i]);
    if (i + 1 == fuller.nodes.size()) break;
    const std::array<NodeId, 2> ends{fuller.nodes[i], fuller.nodes[i + 1]};
    const int count = roomFor(views, known, ends);
    for (int k = 1; k <= count; ++k) {
      nodes.push_back(NodeId(next));
      const double f = static_cast<double>(k) / (count + 1);
      addBetween(views, known, ends, f, onCurve(places, i, f), NodeId(next++), course);
    }
  }
  fuller.nodes = std::move(nodes);
  return fuller;
}

Course courseOf(const Task& task, std::vector<ClickedNode> kept, const Photographed& found, const ExpectedRidges& expected) {
  Course course{std::move(kept), task.options.stems, expected, 0};
  course.clicked = course.nodes.size();
  if (expected.empty()) return course;
  std::map<NodeId, glm::dvec3> placed;
  for (const SnappedNode& node : found.snapping.nodes) placed.emplace(node.id, node.at.at);
  int next = 0;
  for (const ClickedNode& node : task.nodes) next = std::max(next, node.id.value + 1);
  for (ClickedStem& stem : course.stems) stem = filled(stem, placed, found.cameras.views, expected, next, course);
  return course;
}

/// Reads the photos, then places nodes and estimates cameras by what was read, at the clicks and, once it is known where to look, between them.
Result<void> round(const Task& task, const ExpectedRidges& expected, double cameras_px, Photographed& found) {
  const Course course = courseOf(task, withoutSuspects(task.nodes, found.cameras.suspects), found, expected);
  const std::span<const ClickedNode> clicked = std::span(course.nodes).first(course.clicked);
  found.snapping.readings = detail::withWidthScatter(readAllRidges(task.photos, course.nodes, course.stems, snapOptionsFor(found.cameras), course.expected), course.expected);
  if (auto done = place(found, clicked, cameras_px); !done) return done;
  const auto between = placeSnapped(found.cameras.views, course.between(), found.snapping.readings, found.cameras.uncertainty.click_px, cameras_px);
  if (!between) return between.failure();
  if (auto done = estimateAgain(task, *between, found); !done) return done;
  return place(found, withoutSuspects(task.nodes, found.cameras.suspects), 0);
}

/// Nodes once more with what the program clicked itself, now that the cameras are found without it.
Result<void> withPlacedClicks(const Task& task, std::span<const ClickedNode> nodes, const ExpectedRidges& expected, Photographed& found) {
  if (std::all_of(nodes.begin(), nodes.end(), [](const ClickedNode& node) { return node.placed.empty(); })) return {};
  const std::vector<ClickedNode> all = withoutSuspects(nodes, found.cameras.suspects);
  found.snapping.readings = detail::withWidthScatter(readAllRidges(task.photos, all, task.options.stems, snapOptionsFor(found.cameras), expected), expected);
  return place(found, all, 0);
}

void takeSpread(const Uncertainty& uncertainty, std::vector<SnappedNode>& nodes) {
  for (SnappedNode& node : nodes)
    if (const auto spread = covariance(uncertainty, node.id, node.id)) node.covariance = *spread;
}

void giveSpread(const std::vector<SnappedNode>& nodes, Uncertainty& uncertainty) {
  for (const SnappedNode& node : nodes)
    for (NodeSpread& spread : uncertainty.nodes)
      if (spread.id == node.id) spread.at = node.at, spread.own = node.covariance;
}

/// What the photos say of where stems are, learned from the nodes without suspect clicks.
std::shared_ptr<const detail::StemEvidence> evidenceFor(const Task& task, const EstimatedCameras& cameras) {
  std::vector<ClickedNode> trusted;
  for (const ClickedNode& node : task.nodes)
    if (node.clicks.size() > 1 && std::none_of(cameras.suspects.begin(), cameras.suspects.end(), [&](const SuspectClick& s) { return s.node == node.id; })) trusted.push_back(node);
  std::map<NodeId, glm::dvec3> places;
  const auto solved = detail::solveAll(cameras.views, trusted, {.click_px = cameras.uncertainty.click_px}, "plant units");
  if (!solved) return nullptr;
  for (const auto& node : solved->nodes)
    if (node) places.emplace(node->id, node->position.at);
  return std::make_shared<const detail::StemEvidence>(detail::learnedEvidence(task.photos, cameras.views, places, task.options.stems, cameras.uncertainty.click_px));
}

Result<Photographed> inKnownCameras(const Task& task, std::span<const ClickedNode> nodes, EstimatedCameras cameras) {
  auto snapping = snapNodes(cameras.views, task.photos, withoutSuspects(nodes, cameras.suspects), task.options.stems, snapOptionsFor(cameras));
  if (!snapping) return snapping.failure();
  giveSpread(snapping->nodes, cameras.uncertainty);
  return Photographed{std::move(cameras), *std::move(snapping)};
}

}  // namespace

Result<Photographed> measurePhotographed(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, const Photos& photos,
                                         std::span<const ClickedNode> nodes, const EstimateOptions& options) {
  const std::vector<ClickedNode> own = detail::byHand(nodes);
  Task task{views, hints, photos, own, options};
  auto byClicks = estimateCameras(views, hints, nodes, options);
  if (!byClicks) return byClicks.failure();
  task.options.evidence = evidenceFor(task, *byClicks);
  byClicks = estimateCameras(views, hints, nodes, task.options);
  if (!byClicks) return byClicks.failure();
  if (byClicks->reports.empty()) return inKnownCameras(task, nodes, *std::move(byClicks));

  Photographed found{*std::move(byClicks), {}};
  const double cameras_px = 0.5 * found.cameras.uncertainty.click_px;  // as clicks alone find them
  if (auto done = round(task, {}, cameras_px, found); !done) return done.failure();
  const ExpectedRidges expected = expectedRidges(found.cameras.views, found.snapping.nodes, options.stems, found.snapping.readings);
  constexpr double kByLines_px = 0.1;
  if (auto done = round(task, expected, kByLines_px, found); !done) return done.failure();
  takeSpread(found.cameras.uncertainty, found.snapping.nodes);
  if (auto done = withPlacedClicks(task, nodes, expected, found); !done) return done.failure();
  return found;
}

}  // namespace axil::skeleton3d
