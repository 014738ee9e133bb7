#include "skeleton3d/photographed.hpp"

#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/stem_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

/// What stays the same from round to round.
struct Task {
  std::span<const View> views;
  const std::map<std::string, UnknownCameraHints>& hints;
  const Photos& photos;
  std::span<const ClickedNode> nodes;
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
Result<void> estimateAgain(const Task& task, Photographed& found) {
  const Uncertainty clicks = found.cameras.uncertainty;
  EstimateOptions options = task.options;
  options.click_px = clicks.click_px;
  found.snapping.readings = withTrueScatter(std::move(found.snapping.readings), found.cameras.views, found.snapping.nodes);
  options.centreLines = believedReadings(found.snapping.readings, found.snapping.nodes);
  auto better = estimateCameras(task.views, task.hints, task.nodes, options);
  if (!better) return better.failure();
  found.cameras = *std::move(better);
  found.cameras.uncertainty.clickWasFound = clicks.clickWasFound;
  found.cameras.uncertainty.freedom = clicks.freedom;
  return {};
}

/// Reads the photos, then places nodes and estimates cameras by what was read.
Result<void> round(const Task& task, const ExpectedRidges& expected, double cameras_px, Photographed& found) {
  std::vector<ClickedNode> kept = withoutSuspects(task.nodes, found.cameras.suspects);
  found.snapping.readings = readAllRidges(task.photos, kept, task.options.stems, snapOptionsFor(found.cameras), expected);
  if (auto done = place(found, kept, cameras_px); !done) return done;
  if (auto done = estimateAgain(task, found); !done) return done;
  kept = withoutSuspects(task.nodes, found.cameras.suspects);
  return place(found, kept, 0);
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

Result<Photographed> inKnownCameras(const Task& task, EstimatedCameras cameras) {
  const std::vector<ClickedNode> kept = withoutSuspects(task.nodes, cameras.suspects);
  SnapOptions options = snapOptionsFor(cameras);
  auto snapping = snapNodes(cameras.views, task.photos, kept, task.options.stems, options);
  if (!snapping) return snapping.failure();
  giveSpread(snapping->nodes, cameras.uncertainty);
  return Photographed{std::move(cameras), *std::move(snapping)};
}

}  // namespace

Result<Photographed> measurePhotographed(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, const Photos& photos,
                                         std::span<const ClickedNode> nodes, const EstimateOptions& options) {
  Task task{views, hints, photos, nodes, options};
  auto byClicks = estimateCameras(views, hints, nodes, options);
  if (!byClicks) return byClicks.failure();
  task.options.evidence = evidenceFor(task, *byClicks);
  byClicks = estimateCameras(views, hints, nodes, task.options);
  if (!byClicks) return byClicks.failure();
  if (byClicks->reports.empty()) return inKnownCameras(task, *std::move(byClicks));

  Photographed found{*std::move(byClicks), {}};
  const double cameras_px = 0.5 * found.cameras.uncertainty.click_px;  // as clicks alone find them
  if (auto done = round(task, {}, cameras_px, found); !done) return done.failure();
  const ExpectedRidges expected = expectedRidges(found.cameras.views, found.snapping.nodes, options.stems, found.snapping.readings);
  constexpr double kByLines_px = 0.1;
  if (auto done = round(task, expected, kByLines_px, found); !done) return done.failure();
  takeSpread(found.cameras.uncertainty, found.snapping.nodes);
  return found;
}

}  // namespace axil::skeleton3d
