#include "skeleton3d/estimate_notes.hpp"

#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/statistics.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kMostTurned_deg = 45;
constexpr double kMostTypicalMiss = 0.01;    // of the photo's longer side
constexpr double kMostMissOfPlant = 0.04;    // of how far its clicks reach in the photo

double longerSide(const BundleCamera& camera) { return std::max(camera.view.size_px.x, camera.view.size_px.y); }

std::vector<double> offsOf(const std::vector<Miss>& misses, std::size_t view, std::size_t nodes) {
  std::vector<double> offs;
  for (const Miss& miss : misses)
    if (miss.view == view && miss.point < nodes) offs.push_back(glm::length(miss.off_px));
  return offs;
}

double reachOf(const Bundle& bundle, std::size_t view) {
  std::optional<glm::dvec2> low, high;
  for (std::size_t p = 0; p < bundle.nodes; ++p)
    for (const BundleClick& click : bundle.points[p].clicks) {
      if (click.view != view) continue;
      low = low ? glm::min(*low, click.px) : click.px;
      high = high ? glm::max(*high, click.px) : click.px;
    }
  return low ? glm::length(*high - *low) : 0.0;
}

double turnedOf(const BundleCamera& camera) {
  return Angle::fromRadians(glm::length(glm::dvec3{camera.values[kTurnX], camera.values[kTurnY], camera.values[kTurnZ]})).degrees();
}

std::string px(double value) { return fixed(value, value < 10 ? 1 : 0) + " px"; }
std::string percent(double share) { return fixed(100 * share, share < 0.1 ? 1 : 0) + " %"; }

}  // namespace

Result<void> checkFit(const Bundle& bundle) {
  const std::vector<Miss> misses = missesOf(bundle);
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    const BundleCamera& camera = bundle.cameras[v];
    if (camera.known) continue;
    const double typical_px = medianOf(offsOf(misses, v, bundle.nodes));
    if (typical_px > kMostTypicalMiss * longerSide(camera) || typical_px > std::max(kMostMissOfPlant * reachOf(bundle, v), 3.0))
      return doNotFit(": the clicks of view '" + camera.view.name + "' are typically " + px(typical_px) + " off");
    if (const double turned = turnedOf(camera); turned > kMostTurned_deg)
      return doNotFit(": view '" + camera.view.name + "' would have to be turned by " + fixed(turned, 0) + " degrees from what its name says");
  }
  return {};
}

std::vector<std::string> weaknessesOf(const BundleCamera& camera, const CameraReport& report) {
  std::vector<std::string> weak;
  constexpr double kWeakFocal = 0.05;
  if (report.focal_px > 0 && report.focalSigma_px > kWeakFocal * report.focal_px)
    weak.push_back("its focal length is known only to +-" + percent(report.focalSigma_px / report.focal_px) +
                   (camera.source == FocalSource::Guessed ? "; use a photo with EXIF data, or calibrate the lens" : "; calibrate the lens"));
  if (report.focal_px == 0) weak.push_back("it cannot be told from a view from very far; its focal length is open");
  constexpr std::size_t kFewClicks = 8;
  if (report.clicks < kFewClicks) weak.push_back("it has only " + std::to_string(report.clicks) + " clicks that other views share; ten or more are better");
  return weak;
}

namespace {

std::vector<std::string> originNotes(const Bundle& bundle, double click_px) {
  std::vector<std::string> notes;
  const std::vector<View> views = viewsOf(bundle);
  const auto clicked = std::count_if(bundle.cameras.begin(), bundle.cameras.end(), [](const BundleCamera& c) { return c.known || c.hints.origin_px.has_value(); });
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto& origin = bundle.cameras[v].hints.origin_px;
    if (bundle.cameras[v].known || !origin || clicked < 2) continue;
    const double off_px = glm::length(project(views[v].camera, {}).px - origin->px);
    if (off_px > 5 * std::max(click_px, 1.0))
      notes.push_back("the origin clicked in view '" + views[v].name + "' is " + px(off_px) + " from where the other views put it; click the collar again");
  }
  return notes;
}

std::vector<std::string> lengthNotes(const Bundle& bundle, const EstimatedCameras& estimated) {
  std::vector<std::string> notes;
  if (bundle.scaleIsKnown) return notes;
  constexpr double kWeakScale = 0.01;
  if (const double share = estimated.uncertainty.scaleShare; share > kWeakScale)
    notes.push_back("the plant's size is known only to +-" + percent(share) + "; click the ends of the known length exactly, in every view, or take a longer one");
  std::vector<double> ratios;
  for (const BundleRod& rod : bundle.rods) {
    const auto &a = bundle.points[rod.from].at, &b = bundle.points[rod.to].at;
    ratios.push_back(rod.length / std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  constexpr double kContradiction = 0.05;
  if (*most > (1 + kContradiction) * *least)
    notes.push_back("the known lengths contradict one another by " + percent(*most / *least - 1) + "; check their ends and what they measure");
  if (bundle.points[bundle.rods.front().from].atOriginsDepth)
    notes.push_back("the known length is seen in one view only and taken to lie beside the plant's origin, parallel to the picture; click it in another view too");
  return notes;
}

std::vector<std::string> nodeNotes(const Uncertainty& uncertainty) {
  std::vector<double> sigmas;
  for (const NodeSpread& node : uncertainty.nodes) {
    const glm::dvec3 sigma = sigmaOf(uncertainty, node.id).value_or(glm::dvec3{0, 0, 0});
    sigmas.push_back(std::max({sigma.x, sigma.y, sigma.z}));
  }
  constexpr double kMuch = 5;
  const double limit = kMuch * medianOf(sigmas);
  std::string weak;
  std::size_t count = 0;
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    if (!(sigmas[i] > limit)) continue;
    if (++count <= 10) weak += (weak.empty() ? "" : ", ") + std::to_string(uncertainty.nodes[i].id.value);
  }
  if (count == 0) return {};
  return {(count == 1 ? "node " : "nodes ") + weak + (count > 10 ? " and others are" : count == 1 ? " is" : " are") +
          " known five times less well than most: their views look from nearly the same side; click them in another"};
}

std::vector<std::string> uprightNotes(const Bundle& bundle, const Uncertainty& uncertainty) {
  if (bundle.scaleIsKnown || std::all_of(uncertainty.turned.begin(), uncertainty.turned.end(), [](Angle a) { return a.radians() == 0; })) return {};
  return {"how the plant as a whole is turned is only as good as the views' names: +-" + fixed(uncertainty.turned[0].degrees(), 1) + ", " + fixed(uncertainty.turned[1].degrees(), 1) + " and " +
          fixed(uncertainty.turned[2].degrees(), 1) + " degrees about X, Y and Z"};
}

/// Two views that show every node in the same place: from one side, so that nothing says how deep a node is. (A plant that is flat
/// and stands just so looks alike from two sides; of three views the third one tells.)
std::vector<std::string> sameSideNotes(const Bundle& bundle, double click_px) {
  if (bundle.cameras.size() != 2) return {};
  std::vector<double> across[2];
  for (std::size_t p = 0; p < bundle.nodes; ++p)
    if (const auto& clicks = bundle.points[p].clicks; clicks.size() == 2)
      for (const BundleClick& click : clicks) across[click.view].push_back(click.px.x);
  const double count = static_cast<double>(across[0].size());
  if (count < 6 || across[1].size() != across[0].size()) return {};
  double mean[2] = {0, 0}, xx = 0, xy = 0, yy = 0;
  for (int v = 0; v < 2; ++v)
    for (const double x : across[v]) mean[v] += x / count;
  for (std::size_t i = 0; i < across[0].size(); ++i) {
    const double x = across[0][i] - mean[0], y = across[1][i] - mean[1];
    xx += x * x, xy += x * y, yy += y * y;
  }
  if (!(xx > 0 && xy > 0)) return {};
  const double left_px = std::sqrt(std::max(yy - xy * xy / xx, 0.0) / count), spread_px = std::sqrt(yy / count);
  constexpr double kAlike = 0.03;  // of how far the nodes spread
  if (left_px > std::max(2.5 * click_px, kAlike * spread_px) || spread_px < 10 * click_px) return {};
  return {"views '" + bundle.cameras[0].view.name + "' and '" + bundle.cameras[1].view.name +
          "' show every node in the same place: if both were taken from one side, no depth here is true; take a photo from another side"};
}

}  // namespace

/// Several clicks at the very edge of a photo: the plant goes on beyond it.
std::vector<std::string> borderNotes(const Bundle& bundle) {
  std::vector<std::string> notes;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    const BundleCamera& camera = bundle.cameras[v];
    const glm::dvec2 size(camera.view.size_px);
    const double margin = 0.002 * longerSide(camera);
    std::size_t atEdge = 0;
    for (std::size_t p = 0; p < bundle.nodes; ++p)
      for (const BundleClick& click : bundle.points[p].clicks)
        atEdge += click.view == v && (click.px.x < margin || click.px.y < margin || click.px.x > size.x - margin || click.px.y > size.y - margin) ? 1 : 0;
    if (!camera.known && atEdge > 0)
      notes.push_back("view '" + camera.view.name + "' cuts the plant off: " + std::to_string(atEdge) + (atEdge == 1 ? " click lies" : " clicks lie") +
                      " on its border, where a part that goes on is no node; leave them out there or step back");
  }
  return notes;
}

std::vector<std::string> notesOn(const Bundle& bundle, const std::vector<Miss>& misses, const EstimatedCameras& estimated) {
  std::vector<std::string> notes;
  const auto add = [&](std::vector<std::string> more) { notes.insert(notes.end(), more.begin(), more.end()); };
  add(originNotes(bundle, estimated.uncertainty.click_px));
  add(lengthNotes(bundle, estimated));
  add(nodeNotes(estimated.uncertainty));
  add(sameSideNotes(bundle, estimated.uncertainty.click_px));
  add(uprightNotes(bundle, estimated.uncertainty));
  constexpr double kRough_px = 6;
  if (const double typical_px = typicalMiss(misses); typical_px > kRough_px)
    notes.push_back("clicks are typically " + px(typical_px) + " from where their nodes project to; the plant may have moved between the photos");
  return notes;
}

}  // namespace axil::skeleton3d::detail
