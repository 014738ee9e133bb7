#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/click_readings.hpp"
#include "skeleton3d/solve.hpp"
#include "skeleton3d/solve_all.hpp"
#include "skeleton3d/statistics.hpp"
#include "skeleton3d/stem_course.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kLeastClick_px = 0.3;      // no one clicks better; below it rounding would be suspected
constexpr double kWorthNaming = 0.15;       // of being wrong
constexpr double kSure = 0.6;               // of a reading that may give a node of one right click its place

ClickedNode clickedAgain(const BundlePoint& point, const std::vector<View>& views) {
  ClickedNode node{point.id, {}, std::nullopt};
  for (const BundleClick& click : point.clicks) node.clicks[views[click.view].name] = {click.px};
  return node;
}

struct Fit {
  PlantPoint at;
  double squares = 0;  ///< in standard deviations of a click
};

std::vector<std::optional<Fit>> fittedAll(std::span<const ClickedNode> nodes, const std::vector<View>& views, double click_px) {
  const auto solved = solveAll(views, nodes, {.maxReprojection_px = std::numeric_limits<double>::max()}, "plant units");
  std::vector<std::optional<Fit>> fits(nodes.size());
  if (!solved) return fits;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& node = solved->nodes[i];
    if (!node) continue;
    fits[i] = Fit{node->position, 0};
    for (const auto& [view, off_px] : node->reprojection_px) fits[i]->squares += off_px * off_px / (click_px * click_px);
  }
  return fits;
}

int freedomOf(const ClickedNode& node) { return 2 * static_cast<int>(node.clicks.size()) - 3; }
bool fits(const ClickedNode& node, const Fit& fit) { return fit.squares <= chiSquaredLimit(freedomOf(node)); }

double typicalPixel(std::span<const View> views, const std::map<NodeId, glm::dvec3>& places) {
  std::vector<double> sizes;
  for (const auto& [id, at] : places)
    for (const View& view : views)
      if (isInFront(view.camera, {at}))
        sizes.push_back(view.camera.model == CameraModel::Orthographic ? 1 / view.camera.scale_px_per_unit : toView(view.camera, {at}).at.z / view.camera.focal_px->x);
  return medianOf(std::move(sizes));
}

/// Where a wrong click was rather meant to be, and how sure that is.
void takeRather(const View& view, const ClickReading& reading, SuspectClick& suspect) {
  const glm::dvec2 rather = project(view.camera, {reading.at}).px;
  suspect.rather = PhotoPoint{rather};
  for (const double side : {-1.0, 1.0})
    if (const glm::dvec3 end = reading.at + side * reading.sigmaAlong; isInFront(view.camera, {end}))
      suspect.ratherSigma_px = std::max(suspect.ratherSigma_px, glm::length(project(view.camera, {end}).px - rather));
}

/// The clicks that are wrong in the likely readings of a node, each with its chance.
std::vector<SuspectClick> named(const ClickedNode& node, const std::vector<View>& views, const std::vector<ClickReading>& readings) {
  if (readings.empty()) return {};
  const ClickReading& likeliest = readings.front();
  std::vector<SuspectClick> suspects;
  for (const auto& [view, click] : node.clicks) {
    double chance = 0;
    for (const ClickReading& reading : readings)
      if (!reading.right.contains(view)) chance += reading.weight;
    if (chance < kWorthNaming) continue;
    const glm::dvec2 rather = project(findView(views, view)->camera, {likeliest.at}).px;
    SuspectClick suspect{node.id, view, glm::length(rather - click.px), chance, std::nullopt};
    if (likeliest.weight >= kSure && likeliest.right.size() == 1 && !likeliest.right.contains(view)) takeRather(*findView(views, view), likeliest, suspect);
    suspects.push_back(suspect);
  }
  return suspects;
}

/// A node is looked at more closely where its clicks do not meet, and, with photos that can tell, where its stem leaps.
bool isOdd(const ClickedNode& node, const std::optional<Fit>& fit, const Grounds& grounds) {
  constexpr double kLeap = 3;
  if (node.clicks.size() < 2 || !fit) return false;
  return !fits(node, *fit) || (grounds.evidence != nullptr && leapsAt(grounds.course, node.id, fit->at.at, kLeap));
}

std::map<NodeId, glm::dvec3> placesOf(const std::vector<ClickedNode>& nodes, const std::vector<std::optional<Fit>>& fits) {
  std::map<NodeId, glm::dvec3> places;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (fits[i]) places.emplace(nodes[i].id, fits[i]->at.at);
  return places;
}

/// The clicks of all nodes, judged by where the others are; those move as their own wrong clicks are found.
std::vector<SuspectClick> judgedAll(const std::vector<ClickedNode>& nodes, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems,
                                    const StemEvidence* evidence) {
  constexpr int kRounds = 3;
  const auto fits = fittedAll(nodes, views, click_px);
  auto places = placesOf(nodes, fits);
  std::vector<SuspectClick> suspects;
  for (int round = 0; round < kRounds; ++round) {
    const StemCourse course = stemCourseOf(stems, places, click_px * typicalPixel(views, places));
    const Grounds grounds{views, click_px, course, evidence};
    suspects.clear();
    bool moved = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!isOdd(nodes[i], fits[i], grounds)) continue;
      const auto readings = readingsOf(nodes[i], grounds);
      const auto own = named(nodes[i], views, readings);
      suspects.insert(suspects.end(), own.begin(), own.end());
      if (readings.empty()) continue;
      moved = moved || glm::length(places[nodes[i].id] - readings.front().at) > course.noise;
      places[nodes[i].id] = readings.front().at;
    }
    if (!moved) break;
  }
  return suspects;
}

}  // namespace

std::vector<SuspectClick> suspectsOf(const Bundle& bundle, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems, const StemEvidence* evidence) {
  std::vector<ClickedNode> nodes;
  for (std::size_t p = 0; p < bundle.nodes; ++p) nodes.push_back(clickedAgain(bundle.points[p], views));
  return suspectsAmong(nodes, views, click_px, stems, evidence);
}

std::vector<SuspectClick> suspectsAmong(const std::vector<ClickedNode>& nodes, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems,
                                        const StemEvidence* evidence) {
  return judgedAll(nodes, views, std::max(click_px, kLeastClick_px), stems, evidence);
}

Bundle withoutSuspectsIn(Bundle bundle, const std::vector<SuspectClick>& suspects) {
  AXIL_ASSERT(bundle.rods.empty(), "the ends of known lengths come after the suspects");
  const std::vector<View> views = viewsOf(bundle);
  std::vector<ClickedNode> nodes;
  for (const BundlePoint& point : bundle.points) nodes.push_back(clickedAgain(point, views));
  const std::vector<ClickedNode> kept = withoutSuspects(nodes, suspects);
  for (std::size_t p = 0; p < bundle.points.size(); ++p) {
    const auto named = std::count_if(suspects.begin(), suspects.end(), [&](const SuspectClick& s) { return s.node == bundle.points[p].id; });
    const bool anyTrusted = static_cast<std::size_t>(named) < bundle.points[p].clicks.size();  // else it must not pull at the cameras
    std::erase_if(bundle.points[p].clicks, [&](const BundleClick& click) {
      const auto still = kept[p].clicks.find(views[click.view].name);
      return !anyTrusted || still == kept[p].clicks.end() || still->second.px != click.px;
    });
  }
  std::erase_if(bundle.points, [](const BundlePoint& point) { return point.clicks.size() < 2; });
  bundle.nodes = bundle.points.size();
  return bundle;
}

}  // namespace axil::skeleton3d::detail
