#include "skeleton3d/estimate.hpp"

#include "base/text.hpp"
#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/estimate_notes.hpp"
#include "skeleton3d/placed_clicks.hpp"
#include "skeleton3d/solve_all.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace axil::skeleton3d {
namespace {

using detail::Bundle;

constexpr double kLoss = 4;         // standard deviations, beyond which a click counts less and less
constexpr double kMostSuspect = 0.2;  // of the nodes, where the views would fit if they were read otherwise: no few wrong clicks, but wrong views
constexpr double kGentle_px = 30;  // the same for a first guess, which may be off by many pixels

double clickOr(const EstimateOptions& options, double found_px) { return options.click_px.value_or(found_px); }

Result<void> checkOptions(const EstimateOptions& options) {
  if (options.click_px && !(std::isfinite(*options.click_px) && *options.click_px > 0))
    return fail(ErrorCode::BadInput, "the standard deviation of a click must be above zero pixels");
  return {};
}

Result<void> checkInput(std::span<const View> views, std::span<const ClickedNode> nodes) {
  if (const auto good = detail::checkViews(views, detail::UnknownCameras::Allowed); !good) return good;
  std::vector<detail::Trouble> troubles;
  for (const ClickedNode& node : nodes)
    for (detail::Trouble& trouble : detail::clickTroubles(views, node)) troubles.push_back(std::move(trouble));
  if (!troubles.empty()) return detail::failWith(troubles, "the cameras cannot be estimated");
  return {};
}

/// Two rounds: first gently, then with the clicks' own scatter.
Result<Bundle> adjustedRobustly(const Bundle& guess, const EstimateOptions& options) {
  const double first_px = clickOr(options, 1);
  auto bundle = detail::adjustBundle(guess, {first_px, kGentle_px / first_px, options});
  if (!bundle) return bundle;
  return detail::adjustBundle(*std::move(bundle), {clickOr(options, detail::robustScatterOf(*bundle).click_px), kLoss, options});
}

Failure misread(const std::string& better) { return fail(ErrorCode::NoAnswer, "the views do not fit together: " + better); }

double suspectNodes(const std::vector<SuspectClick>& suspects) {
  std::set<NodeId> nodes;
  for (const SuspectClick& suspect : suspects) nodes.insert(suspect.node);
  return static_cast<double>(nodes.size());
}

/// Everything but the last round: cameras and nodes that fit, wrong clicks among them.
Result<Bundle> fitted(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                      const EstimateOptions& options) {
  const auto gathered = detail::gatherBundle(views, hints, nodes, options);
  if (!gathered) return gathered.failure();
  auto guess = detail::guessBundle(*gathered);
  auto bundle = guess ? adjustedRobustly(*guess, options) : std::move(guess);
  if (bundle) {
    const auto fits = detail::checkFit(*bundle);
    if (fits) return bundle;
    bundle = fits.failure();
  }
  const std::string better = detail::betterReading(*gathered, options, std::nullopt);
  if (better.empty()) return bundle;
  return misread(better);
}

/// The wrong clicks, and the bundle without them.
struct Sifted {
  std::vector<SuspectClick> suspects;
  Bundle kept;
  double click_px = 1;
};

Sifted siftedWith(const Bundle& all, const Bundle& fitted, const EstimateOptions& options) {
  const double click_px = clickOr(options, detail::robustScatterOf(fitted).click_px);
  Sifted sifted{detail::suspectsOf(all, detail::viewsOf(fitted), click_px, options.stems, options.evidence.get()), all, click_px};
  sifted.kept.cameras = fitted.cameras;
  sifted.kept = detail::withoutSuspectsIn(std::move(sifted.kept), sifted.suspects);
  return sifted;
}

/// Wrong clicks have pulled a little at the cameras that first judge them: once more, in the cameras that the others give.
Result<Sifted> siftedOf(const Bundle& bundle, const EstimateOptions& options) {
  Sifted first = siftedWith(bundle, bundle, options);
  if (first.suspects.empty()) return first;
  const auto better = detail::adjustBundle(first.kept, {first.click_px, kLoss, options});
  if (!better) return better.failure();
  return siftedWith(bundle, *better, options);
}

CameraReport reportOf(const Bundle& bundle, std::size_t index, const std::vector<detail::Miss>& all, const detail::BundleSpread& spread) {
  const detail::BundleCamera& camera = bundle.cameras[index];
  const Camera found = detail::cameraOf(camera);
  CameraReport report;
  report.view = camera.view.name;
  report.focal_px = found.focal_px ? found.focal_px->x : 0.0;
  const double inverse = camera.values[detail::kFocalInverse];
  report.focalSigma_px = inverse > 0 ? report.focal_px * spread.cameraSigma[index][detail::kFocalInverse] / inverse : 0.0;
  const glm::dvec3 turn{camera.values[detail::kTurnX], camera.values[detail::kTurnY], camera.values[detail::kTurnZ]};
  report.turned = Angle::fromRadians(glm::length(turn));
  for (int k = 0; k < 3; ++k) report.turnedAbout[static_cast<std::size_t>(k)] = Angle::fromRadians(turn[k]);
  std::vector<detail::Miss> own;
  std::copy_if(all.begin(), all.end(), std::back_inserter(own), [&](const detail::Miss& m) { return m.view == index && m.point < bundle.nodes; });
  for (const detail::Miss& miss : own) report.rms_px += glm::dot(miss.off_px, miss.off_px) / static_cast<double>(own.size());
  report.rms_px = std::sqrt(report.rms_px);
  report.typical_px = detail::typicalMiss(own);
  report.clicks = own.size();
  report.weak = detail::weaknessesOf(camera, report);
  return report;
}

View scaled(View view, double ratio) {
  view.camera.translation *= ratio;
  view.camera.scale_px_per_unit /= ratio;
  return view;
}

std::vector<View> inOrderOf(std::span<const View> order, const std::vector<View>& views) {
  std::vector<View> sorted;
  for (const View& view : order) sorted.push_back(*detail::findView(views, view.name));
  return sorted;
}

/// Once more with the centre lines that the photos show: clicks alone have brought cameras and nodes to within a pixel or so.
Result<Bundle> byCentreLines(const Bundle& byClicks, double click_px, const EstimateOptions& options) {
  if (options.centreLines.empty()) return byClicks;
  return detail::adjustBundle(detail::withCentreLines(byClicks, options.centreLines), {click_px, kLoss, options});
}

struct Finished {
  Bundle bundle;
  detail::Scatter scatter;  ///< of the clicks
};

Result<Finished> finishedWith(const Sifted& sifted, const EstimateOptions& options) {
  const auto withRods = detail::withKnownLengths(sifted.kept, sifted.click_px);
  if (!withRods) return withRods.failure();
  const auto byClicks = detail::adjustBundle(*withRods, {sifted.click_px, kLoss, options});
  if (!byClicks) return byClicks.failure();
  const detail::Scatter scatter = detail::scatterOf(*byClicks);
  auto done = byCentreLines(*byClicks, clickOr(options, scatter.click_px), options);
  if (!done) return done.failure();
  return Finished{*std::move(done), scatter};
}

bool sameClicks(const std::vector<SuspectClick>& a, const std::vector<SuspectClick>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SuspectClick& x, const SuspectClick& y) { return x.node == y.node && x.view == y.view; });
}

/// Cameras that are all known: nothing to estimate, but the clicks can be judged.
Result<EstimatedCameras> judged(std::span<const View> views, std::span<const ClickedNode> nodes, const EstimateOptions& options) {
  EstimatedCameras known{{views.begin(), views.end()}, {}, {}, {}, {}};
  std::vector<ClickedNode> shared = detail::byHand(nodes);
  std::erase_if(shared, [](const ClickedNode& node) { return node.clicks.size() < 2; });
  const double click_px = clickOr(options, detail::robustScatterOf(views, shared).click_px);
  known.suspects = detail::suspectsAmong(shared, known.views, click_px, options.stems, options.evidence.get());
  constexpr double kFarOff_px = 6;  // no one clicks so badly
  if (click_px > kFarOff_px || suspectNodes(known.suspects) > kMostSuspect * static_cast<double>(shared.size()))
    if (const std::string better = detail::betterReading(views, shared); !better.empty()) return misread(better);
  auto uncertainty = uncertaintyOf(views, withoutSuspects(nodes, known.suspects), options.click_px);
  if (!uncertainty) return uncertainty.failure();
  known.uncertainty = *std::move(uncertainty);
  return known;
}

/// Nodes that had no part in finding the cameras: those that too few trusted clicks fix, as sure as they are in these cameras.
void addOtherNodes(std::span<const ClickedNode> nodes, EstimatedCameras& estimated) {
  Uncertainty& uncertainty = estimated.uncertainty;
  std::set<NodeId> there;
  for (const NodeSpread& node : uncertainty.nodes) there.insert(node.id);
  std::vector<ClickedNode> others = withoutSuspects(nodes, estimated.suspects);
  std::erase_if(others, [&](const ClickedNode& node) { return node.clicks.size() < 2 || there.contains(node.id); });
  auto spread = uncertaintyOf(estimated.views, others, uncertainty.click_px);
  if (others.empty() || !spread) return;
  for (NodeSpread& node : spread->nodes) {
    if (!uncertainty.nodes.empty()) node.shared.assign(uncertainty.nodes.front().shared.size(), glm::dvec3(0.0));
    uncertainty.nodes.push_back(std::move(node));
  }
  std::stable_sort(uncertainty.nodes.begin(), uncertainty.nodes.end(), [](const NodeSpread& a, const NodeSpread& b) { return a.id < b.id; });
}

EstimatedCameras resultOf(std::span<const View> order, const Bundle& bundle, const detail::Scatter& scatter, std::vector<SuspectClick> suspects, const EstimateOptions& options) {
  const double click_px = clickOr(options, scatter.click_px);
  const detail::BundleSpread spread = detail::spreadOf(bundle, {click_px, std::nullopt, options});
  EstimatedCameras estimated;
  estimated.suspects = std::move(suspects);
  estimated.uncertainty = detail::gauged(bundle, spread.shape);
  estimated.uncertainty.click_px = click_px;
  estimated.uncertainty.clickWasFound = !options.click_px;
  estimated.uncertainty.freedom = scatter.freedom;
  const std::vector<detail::Miss> misses = detail::missesOf(bundle);
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v)
    if (!bundle.cameras[v].known) estimated.reports.push_back(reportOf(bundle, v, misses, spread));
  std::vector<View> views = detail::viewsOf(bundle);
  const double ratio = bundle.scaleIsKnown ? 1.0 : detail::trueScale(bundle, spread.shape);
  for (std::size_t v = 0; v < views.size(); ++v)
    if (!bundle.cameras[v].known) views[v] = scaled(std::move(views[v]), ratio);
  estimated.views = inOrderOf(order, views);
  estimated.notes = detail::notesOn(bundle, misses, estimated);
  return estimated;
}

}  // namespace

Result<EstimatedCameras> estimateCameras(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                                         const EstimateOptions& options) {
  if (const auto good = checkOptions(options); !good) return good.failure();
  if (const auto good = checkInput(views, nodes); !good) return good.failure();
  if (std::none_of(views.begin(), views.end(), [](const View& v) { return v.camera.model == CameraModel::Unknown; })) return judged(views, nodes, options);

  const auto bundle = fitted(views, hints, detail::byHand(nodes), options);
  if (!bundle) return bundle.failure();
  auto sifted = siftedOf(*bundle, options);
  if (!sifted) return sifted.failure();
  auto done = finishedWith(*sifted, options);
  if (!done) return done.failure();
  if (Sifted again = siftedWith(*bundle, done->bundle, options); !sameClicks(again.suspects, sifted->suspects)) {  // the best cameras judge last
    sifted = std::move(again);
    done = finishedWith(*sifted, options);
    if (!done) return done.failure();
  }
  EstimatedCameras estimated = resultOf(views, done->bundle, done->scatter, std::move(sifted->suspects), options);
  addOtherNodes(nodes, estimated);
  for (std::string& note : detail::borderNotes(*bundle)) estimated.notes.push_back(std::move(note));
  std::string doubt = detail::doubtOn(*bundle, options);
  if (!doubt.empty() && suspectNodes(estimated.suspects) > kMostSuspect * static_cast<double>(bundle->nodes)) return misread(doubt);
  if (!doubt.empty()) estimated.notes.push_back(std::move(doubt));
  return estimated;
}

std::vector<ClickedNode> withoutSuspects(std::span<const ClickedNode> nodes, std::span<const SuspectClick> suspects) {
  constexpr double kLikely = 0.5;
  std::map<NodeId, std::vector<const SuspectClick*>> byNode;
  for (const SuspectClick& suspect : suspects) byNode[suspect.node].push_back(&suspect);
  std::vector<ClickedNode> kept(nodes.begin(), nodes.end());
  for (ClickedNode& node : kept) {
    const auto found = byNode.find(node.id);
    if (found == byNode.end()) continue;
    std::vector<const SuspectClick*>& own = found->second;
    std::stable_sort(own.begin(), own.end(), [](const SuspectClick* a, const SuspectClick* b) { return a->chance > b->chance; });
    for (const SuspectClick* suspect : own) {
      if (suspect != own.front() && suspect->chance < kLikely) break;
      if (suspect->rather)
        node.clicks[suspect->view] = *suspect->rather, node.placed[suspect->view] = suspect->ratherSigma_px;
      else
        node.clicks.erase(suspect->view);
    }
  }
  return kept;
}

}  // namespace axil::skeleton3d
