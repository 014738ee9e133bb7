#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"
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
constexpr double kTwoAlone = 2.5;           // times the limit, in pixels: two clicks that nothing can replace lose a node its place
constexpr double kWorthNaming = 0.05;       // of being the wrong one

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

std::optional<Fit> fitted(const ClickedNode& node, const std::vector<View>& views, double click_px) { return fittedAll(std::span(&node, 1), views, click_px).front(); }

int freedomOf(const ClickedNode& node) { return 2 * static_cast<int>(node.clicks.size()) - 3; }
bool fits(const ClickedNode& node, const Fit& fit) { return fit.squares <= chiSquaredLimit(freedomOf(node)); }

double offFrom(const Fit& fit, const PhotoPoint& click, const std::string& view, const std::vector<View>& views) {
  return glm::length(project(findView(views, view)->camera, fit.at).px - click.px);
}

/// A click together with how well, without it, the others agree and the node continues its stems.
struct Accused {
  std::string view;
  double off_px = 0;
  double likelihood = 0;  ///< its logarithm
  bool leaps = false;     ///< without it the node is far from where its stems go on
};

std::vector<Accused> accusedOf(const ClickedNode& node, const std::vector<View>& views, double click_px, const StemCourse& course) {
  std::vector<Accused> accused;
  if (node.clicks.size() < 3) return accused;
  for (const auto& [view, click] : node.clicks) {
    ClickedNode others = node;
    others.clicks.erase(view);
    const auto fit = fitted(others, views, click_px);
    if (fit && fits(others, *fit)) accused.push_back({view, offFrom(*fit, click, view, views), likelihoodAt(course, node.id, fit->at.at) - fit->squares / 2, leapsAt(course, node.id, fit->at.at)});
  }
  return accused;
}

/// Of clicks that could each be the wrong one, how likely each is: by how well everything agrees without it.
std::vector<SuspectClick> weighed(NodeId node, const std::vector<Accused>& accused) {
  double most = std::numeric_limits<double>::lowest(), sum = 0;
  for (const Accused& one : accused) most = std::max(most, one.likelihood);
  for (const Accused& one : accused) sum += std::exp(one.likelihood - most);
  std::vector<SuspectClick> suspects;
  for (const Accused& one : accused)
    if (const double chance = std::exp(one.likelihood - most) / sum; chance >= kWorthNaming) suspects.push_back({node, one.view, one.off_px, chance});
  return suspects;
}

/// No single click explains it: all are suspect, the further off the more.
std::vector<SuspectClick> allOf(const ClickedNode& node, const Fit& fit, const std::vector<View>& views) {
  std::vector<SuspectClick> suspects;
  double sum = 0;
  for (const auto& [view, click] : node.clicks) {
    suspects.push_back({node.id, view, offFrom(fit, click, view, views), 0});
    sum += suspects.back().off_px;
  }
  for (SuspectClick& suspect : suspects) suspect.chance = sum > 0 ? suspect.off_px / sum : 0;
  return suspects;
}

std::vector<SuspectClick> suspectsWhere(const ClickedNode& node, const std::optional<Fit>& fit, const std::vector<View>& views, double click_px, const StemCourse& course) {
  if (!fit || fits(node, *fit) || (node.clicks.size() == 2 && fit->squares <= kTwoAlone * kTwoAlone * chiSquaredLimit(1))) return {};
  const auto accused = accusedOf(node, views, click_px, course);
  const bool twoWrong = std::all_of(accused.begin(), accused.end(), [](const Accused& one) { return one.leaps; });  // that agree by chance
  return twoWrong ? allOf(node, *fit, views) : weighed(node.id, accused);
}

std::map<NodeId, glm::dvec3> placesOf(const std::vector<ClickedNode>& nodes, const std::vector<std::optional<Fit>>& fits) {
  std::map<NodeId, glm::dvec3> places;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (fits[i]) places.emplace(nodes[i].id, fits[i]->at.at);
  return places;
}

}  // namespace

std::vector<SuspectClick> suspectsIn(const ClickedNode& node, const std::vector<View>& views, double click_px) {
  const double scatter_px = std::max(click_px, kLeastClick_px);
  return suspectsWhere(node, fitted(node, views, scatter_px), views, scatter_px, {});
}

std::vector<SuspectClick> suspectsOf(const Bundle& bundle, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems) {
  std::vector<ClickedNode> nodes;
  for (std::size_t p = 0; p < bundle.nodes; ++p) nodes.push_back(clickedAgain(bundle.points[p], views));
  return suspectsAmong(nodes, views, click_px, stems);
}

std::vector<SuspectClick> suspectsAmong(const std::vector<ClickedNode>& nodes, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems) {
  const double scatter_px = std::max(click_px, kLeastClick_px);
  const auto fits = fittedAll(nodes, views, scatter_px);
  const StemCourse course = stemCourseOf(stems, placesOf(nodes, fits));
  std::vector<SuspectClick> suspects;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto own = suspectsWhere(nodes[i], fits[i], views, scatter_px, course);
    suspects.insert(suspects.end(), own.begin(), own.end());
  }
  return suspects;
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
    std::erase_if(bundle.points[p].clicks, [&](const BundleClick& click) { return !anyTrusted || !kept[p].clicks.contains(views[click.view].name); });
  }
  std::erase_if(bundle.points, [](const BundlePoint& point) { return point.clicks.size() < 2; });
  bundle.nodes = bundle.points.size();
  return bundle;
}

}  // namespace axil::skeleton3d::detail
