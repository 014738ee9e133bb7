#include "skeleton3d/estimate_notes.hpp"

#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve_all.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

namespace axil::skeleton3d::detail {
namespace {

/// The views taken for something else than their names say.
struct Reading {
  std::string words;
  std::function<void(Bundle&)> apply;
};

glm::dmat3 rolled(double quarterTurns) {
  glm::dmat3 roll(1.0);
  for (int i = 0; i < static_cast<int>(quarterTurns); ++i) roll = glm::dmat3{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}} * roll;  // picture turned clockwise by 90 degrees
  return roll;
}

std::string quoted(const BundleCamera& camera) { return "'" + camera.view.name + "'"; }

void mirror(Bundle& bundle, std::size_t view) {
  const auto flip = [&](double& x) { x = bundle.cameras[view].view.size_px.x - x; };
  for (BundlePoint& point : bundle.points)
    for (BundleClick& click : point.clicks)
      if (click.view == view) flip(click.px.x);
  UnknownCameraHints& hints = bundle.cameras[view].hints;
  if (hints.origin_px) flip(hints.origin_px->px.x);
  if (hints.scale) {
    flip(hints.scale->from.px.x);
    flip(hints.scale->to.px.x);
  }
}

std::vector<Reading> exchanges(const Bundle& bundle) {
  std::vector<Reading> readings;
  for (std::size_t a = 0; a < bundle.cameras.size(); ++a)
    for (std::size_t b = a + 1; b < bundle.cameras.size(); ++b) {
      if (bundle.cameras[a].known || bundle.cameras[b].known) continue;
      readings.push_back({"views " + quoted(bundle.cameras[a]) + " and " + quoted(bundle.cameras[b]) + " are exchanged",
                          [=](Bundle& to) { std::swap(to.cameras[a].nominal, to.cameras[b].nominal); }});
    }
  return readings;
}

std::vector<Reading> turns(const Bundle& bundle) {
  std::vector<Reading> readings;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    if (bundle.cameras[v].known) continue;
    readings.push_back({"the photo of view " + quoted(bundle.cameras[v]) + " is mirrored", [=](Bundle& to) { mirror(to, v); }});
    for (int quarters = 1; quarters < 4; ++quarters)
      readings.push_back({"the photo of view " + quoted(bundle.cameras[v]) + " is turned by " + std::to_string(90 * quarters) + " degrees",
                          [=](Bundle& to) { to.cameras[v].nominal = rolled(quarters) * to.cameras[v].nominal; }});
  }
  return readings;
}

std::vector<Reading> otherSides(const Bundle& bundle) {
  std::vector<Reading> readings;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    if (bundle.cameras[v].known) continue;
    for (const char* side : {"front", "right", "top", "back", "left"}) {
      if (bundle.cameras[v].view.name == side) continue;
      for (int quarters = 0; quarters < 4; ++quarters) {
        const std::string turn = quarters == 0 ? "" : " and turned by " + std::to_string(90 * quarters) + " degrees";
        readings.push_back({"the photo of view " + quoted(bundle.cameras[v]) + " is taken from the side called '" + side + "'" + turn,
                            [=](Bundle& to) { to.cameras[v].nominal = rolled(quarters) * *nominalRotation(side); }});
      }
    }
  }
  return readings;
}

/// How far off the clicks typically are when the views are read so; nothing where they do not fit at all.
std::optional<double> typicalAs(Bundle bundle, const EstimateOptions& options) {
  auto guess = guessBundle(std::move(bundle));
  if (!guess) return std::nullopt;
  double reach_px = 0;
  for (const BundleCamera& camera : guess->cameras) reach_px = std::max(reach_px, glm::length(glm::dvec2(camera.view.size_px)));
  constexpr double kHopeless = 0.05;  // of the picture, before the cameras are even adjusted
  if (typicalMiss(missesOf(*guess)) > kHopeless * reach_px) return std::nullopt;
  const double click_px = options.click_px.value_or(1);
  const auto gentle = adjustBundle(*std::move(guess), {click_px, 30 / click_px, options, 20});
  if (!gentle || !checkFit(*gentle)) return std::nullopt;
  constexpr double kTurnedLittle_rad = 0.44;  // 25 degrees: a reading that needs more explains nothing
  for (const BundleCamera& camera : gentle->cameras)
    if (!camera.known && glm::length(glm::dvec3{camera.values[kTurnX], camera.values[kTurnY], camera.values[kTurnZ]}) > kTurnedLittle_rad) return std::nullopt;
  return typicalMiss(missesOf(*gentle));
}

/// Some dozens of nodes tell as much as hundreds, and every reading is an adjustment of its own.
Bundle thinned(Bundle bundle) {
  constexpr std::size_t kEnough = 40;
  if (bundle.points.size() <= kEnough) return bundle;
  std::vector<BundlePoint> kept;
  for (std::size_t i = 0; i < kEnough; ++i) kept.push_back(bundle.points[i * bundle.points.size() / kEnough]);
  bundle.points = std::move(kept);
  bundle.nodes = bundle.points.size();
  return bundle;
}

/// How far off the clicks typically are in known cameras; nothing where no node has a place.
std::optional<double> typicalIn(std::span<const View> views, std::span<const ClickedNode> nodes) {
  const auto solved = solveAll(views, nodes, {.maxReprojection_px = std::numeric_limits<double>::max()}, "plant units");
  if (!solved) return std::nullopt;
  std::vector<double> offs;
  for (const auto& node : solved->nodes)
    if (node)
      for (const auto& [view, off_px] : node->reprojection_px) offs.push_back(off_px);
  return 2 * offs.size() > nodes.size() ? std::optional(medianOf(std::move(offs))) : std::nullopt;
}

struct KnownReading {
  std::string words;
  std::vector<ClickedNode> nodes;
};

std::vector<ClickedNode> exchanged(std::span<const ClickedNode> nodes, const std::string& a, const std::string& b) {
  std::vector<ClickedNode> others(nodes.begin(), nodes.end());
  for (ClickedNode& node : others) {
    auto one = node.clicks.extract(a), other = node.clicks.extract(b);
    if (one) one.key() = b, node.clicks.insert(std::move(one));
    if (other) other.key() = a, node.clicks.insert(std::move(other));
  }
  return others;
}

/// With each click of `view` at `factor` times its place plus `shift`.
std::vector<ClickedNode> moved(std::span<const ClickedNode> nodes, const std::string& view, glm::dvec2 factor, glm::dvec2 shift) {
  std::vector<ClickedNode> others(nodes.begin(), nodes.end());
  for (ClickedNode& node : others)
    if (const auto click = node.clicks.find(view); click != node.clicks.end()) click->second.px = factor * click->second.px + shift;
  return others;
}

std::vector<KnownReading> knownReadings(std::span<const View> views, std::span<const ClickedNode> nodes) {
  std::vector<KnownReading> readings;
  for (std::size_t a = 0; a < views.size(); ++a)
    for (std::size_t b = a + 1; b < views.size(); ++b)
      readings.push_back({"views '" + views[a].name + "' and '" + views[b].name + "' are exchanged", exchanged(nodes, views[a].name, views[b].name)});
  for (const View& view : views) {
    const glm::dvec2 size(view.size_px);
    if (!(size.x > 0 && size.y > 0)) continue;
    readings.push_back({"the photo of view '" + view.name + "' is mirrored", moved(nodes, view.name, {-1, 1}, {size.x, 0})});
    readings.push_back({"the photo of view '" + view.name + "' is turned by 180 degrees", moved(nodes, view.name, {-1, -1}, size)});
  }
  return readings;
}

}  // namespace

std::string betterReading(std::span<const View> views, std::span<const ClickedNode> nodes) {
  const auto typical_px = typicalIn(views, nodes);
  if (!typical_px) return {};
  constexpr double kClearly = 0.3;
  std::string best;
  double least = kClearly * *typical_px;
  for (const KnownReading& reading : knownReadings(views, nodes))
    if (const auto other = typicalIn(views, reading.nodes); other && *other < least) {
      least = *other;
      best = "it seems that " + reading.words + " (the clicks are then typically " + fixed(*other, 1) + " px off instead of " + fixed(*typical_px, 1) +
             "); correct the views, or click the same points in each";
    }
  return best;
}

std::string betterReading(const Bundle& gathered, const EstimateOptions& options, std::optional<double> typical_px) {
  const Bundle few = thinned(gathered);
  std::vector<Reading> readings = exchanges(few);
  for (auto&& more : {turns(few), otherSides(few)}) readings.insert(readings.end(), more.begin(), more.end());
  struct Tried {
    const Reading* reading;
    double typical_px;
  };
  std::vector<Tried> tried;
  for (const Reading& reading : readings) {
    Bundle other = few;
    reading.apply(other);
    if (const auto typical = typicalAs(std::move(other), options)) tried.push_back({&reading, *typical});
  }
  if (tried.empty()) return {};
  const auto best = std::min_element(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.typical_px < b.typical_px; });
  constexpr double kClearly = 0.6;
  if (typical_px && best->typical_px > kClearly * *typical_px) return {};
  const auto simplest = std::find_if(tried.begin(), tried.end(), [&](const Tried& t) { return t.typical_px <= 1.5 * best->typical_px + 0.1; });
  return "it seems that " + simplest->reading->words + " (the clicks are then typically " + fixed(simplest->typical_px, 1) + " px off" +
         (typical_px ? " instead of " + fixed(*typical_px, 1) : "") + "); correct the views, or click the same points in each";
}

std::string doubtOn(const Bundle& fitted, const EstimateOptions& options) {
  if (std::none_of(fitted.cameras.begin(), fitted.cameras.end(), [](const BundleCamera& c) { return !c.known; })) return {};
  const double typical_px = typicalMiss(missesOf(fitted));
  double longest = 0, furthest = 0;
  for (const BundleCamera& camera : fitted.cameras) {
    longest = std::max(longest, static_cast<double>(std::max(camera.view.size_px.x, camera.view.size_px.y)));
    if (!camera.known) furthest = std::max(furthest, glm::length(glm::dvec3{camera.values[kTurnX], camera.values[kTurnY], camera.values[kTurnZ]}));
  }
  constexpr double kFarOff = 0.003, kFarTurned_rad = 0.26;
  if (fitted.cameras.size() > 2 && typical_px < kFarOff * longest && furthest < kFarTurned_rad) return {};
  return betterReading(fitted, options, typical_px);
}

}  // namespace axil::skeleton3d::detail
