#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/solve.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kShortest_px = 1;

/// A known length with the clicks of its ends, [0] from, [1] to.
struct SeenRod {
  double length = 0;
  std::array<ClickedNode, 2> ends = {ClickedNode{NodeId(0), {}, std::nullopt}, ClickedNode{NodeId(1), {}, std::nullopt}};
  std::array<std::map<std::string, double>, 2> sigma_px = {};  ///< by view, where it is not that of all clicks
};

struct SeenLength {
  std::string view;
  KnownLength scale;
  std::array<std::optional<double>, 2> sigma_px;
};

SeenLength turnedRound(SeenLength seen) {
  std::swap(seen.scale.from, seen.scale.to);
  std::swap(seen.sigma_px[0], seen.sigma_px[1]);
  return seen;
}

SeenRod rodOf(const std::vector<SeenLength>& seen, unsigned turned) {
  SeenRod rod{seen.front().scale.length};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const SeenLength one = (turned >> i & 1u) != 0 ? turnedRound(seen[i]) : seen[i];
    rod.ends[0].clicks[one.view] = one.scale.from;
    rod.ends[1].clicks[one.view] = one.scale.to;
    for (std::size_t e = 0; e < 2; ++e)
      if (one.sigma_px[e]) rod.sigma_px[e][one.view] = *one.sigma_px[e];
  }
  return rod;
}

double squaresOf(const SeenRod& rod, const std::vector<View>& views) {
  const auto placed = solveNodes(views, rod.ends, {.maxReprojection_px = std::numeric_limits<double>::max()});
  if (!placed) return std::numeric_limits<double>::infinity();
  double squares = 0;
  for (const Node& end : *placed)
    for (const auto& [view, off_px] : end.reprojection_px) squares += off_px * off_px;
  return squares;
}

/// Which end is which is up to the person who clicks, in every photo anew: the way in which the rays meet best.
SeenRod bestTurned(const std::vector<SeenLength>& seen, const std::vector<View>& views) {
  SeenRod best = rodOf(seen, 0);
  double least = squaresOf(best, views);
  constexpr std::size_t kMostTurned = 6;  // views; beyond that as clicked
  if (seen.size() > kMostTurned) return best;
  for (unsigned turned = 2; turned < 1u << seen.size(); turned += 2) {  // the first view says which end is `from`
    const SeenRod other = rodOf(seen, turned);
    if (const double squares = squaresOf(other, views); squares < least) {
      least = squares;
      best = other;
    }
  }
  return best;
}

/// One click that contradicts the others is left out, where there are others enough.
ClickedNode withoutWrongClick(ClickedNode end, const std::vector<View>& views, double click_px) {
  if (end.clicks.size() < 3) return end;
  const auto suspects = suspectsAmong({end}, views, click_px, {});
  const auto worst = std::max_element(suspects.begin(), suspects.end(), [](const SuspectClick& a, const SuspectClick& b) { return a.chance < b.chance; });
  if (worst != suspects.end()) end.clicks.erase(worst->view);
  return end;
}

std::vector<SeenRod> rodsOf(const std::vector<SeenLength>& seen, const std::vector<View>& views, double click_px) {
  std::vector<SeenRod> rods;
  if (seen.size() > 1) {
    SeenRod together = bestTurned(seen, views);
    for (ClickedNode& end : together.ends) end = withoutWrongClick(std::move(end), views, click_px);
    constexpr double kMeets = 8;  // standard deviations a click: else they are different objects of the same length
    const double clicks = static_cast<double>(together.ends[0].clicks.size() + together.ends[1].clicks.size());
    if (squaresOf(together, views) <= clicks * std::pow(kMeets * std::max(click_px, 1.0), 2)) return {together};
  }
  for (const SeenLength& one : seen) rods.push_back(rodOf({one}, 0));
  return rods;
}

/// The place of a clicked end: where its rays meet, or, seen in one view, at the origin's depth.
std::optional<glm::dvec3> placeOf(const ClickedNode& end, const std::vector<View>& views, const Bundle& bundle) {
  if (end.clicks.size() > 1) {
    const auto placed = solveNodes(views, std::span(&end, 1), {.maxReprojection_px = std::numeric_limits<double>::max()});
    return placed ? std::optional(placed->front().position.at) : std::nullopt;
  }
  const auto& [name, click] = *end.clicks.begin();
  const auto camera = std::find_if(bundle.cameras.begin(), bundle.cameras.end(), [&, &wanted = name](const BundleCamera& c) { return c.view.name == wanted; });
  const Camera& projection = views[static_cast<std::size_t>(camera - bundle.cameras.begin())].camera;
  const glm::dvec2 straight = undistorted(projection, click);
  const double depth = projection.model == CameraModel::Perspective ? projection.translation.z : 1.0;
  return toPlant(projection, {{straight.x * depth, straight.y * depth, projection.translation.z}}).at;
}

void addRod(const SeenRod& rod, const std::vector<View>& views, Bundle& bundle) {
  std::array<std::optional<glm::dvec3>, 2> at;
  for (std::size_t e = 0; e < 2; ++e) at[e] = placeOf(rod.ends[e], views, bundle);
  if (!at[0] || !at[1] || !(glm::length(*at[0] - *at[1]) > 0)) return;
  BundleRod added{rod.length, bundle.points.size(), bundle.points.size() + 1};
  for (std::size_t e = 0; e < 2; ++e) {
    BundlePoint point{NodeId(-1 - static_cast<int>(bundle.points.size())), {}, {at[e]->x, at[e]->y, at[e]->z}, rod.ends[e].clicks.size() < 2};
    for (std::size_t v = 0; v < views.size(); ++v)
      if (const auto click = rod.ends[e].clicks.find(views[v].name); click != rod.ends[e].clicks.end()) {
        const auto sigma = rod.sigma_px[e].find(views[v].name);
        point.clicks.push_back({v, click->second.px, sigma == rod.sigma_px[e].end() ? std::nullopt : std::optional(sigma->second)});
      }
    bundle.points.push_back(std::move(point));
  }
  bundle.rods.push_back(added);
}

/// Lengths by how long they are: what several views call equally long may be one object.
std::map<double, std::vector<SeenLength>> lengthsOf(const Bundle& bundle) {
  std::map<double, std::vector<SeenLength>> lengths;
  for (const BundleCamera& camera : bundle.cameras) {
    const auto& scale = camera.hints.scale;
    if (camera.known || !scale || glm::length(scale->to.px - scale->from.px) < kShortest_px) continue;
    lengths[scale->length].push_back({camera.view.name, *scale, camera.hints.scaleSigma_px});
  }
  return lengths;
}

}  // namespace

Result<Bundle> withKnownLengths(Bundle bundle, double click_px) {
  if (bundle.scaleIsKnown) return bundle;
  const std::vector<View> views = viewsOf(bundle);
  for (const auto& [length, seen] : lengthsOf(bundle))
    for (const SeenRod& rod : rodsOf(seen, views, click_px)) addRod(rod, views, bundle);
  if (bundle.rods.empty())
    return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: the two ends of the known length are clicked in one place; click both its ends");
  return bundle;
}

std::vector<double> rodWeights(const Bundle& bundle, const Uncertainty& shape) {
  std::vector<double> weights;
  double sum = 0;
  for (const BundleRod& rod : bundle.rods) {
    const auto length = lengthBetween(shape, bundle.points[rod.from].id, bundle.points[rod.to].id);
    const double share = length ? length->sigma / length->value : 1.0;
    weights.push_back(1 / std::max(share * share, 1e-12));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double trueScale(const Bundle& bundle, const Uncertainty& shape) {
  const std::vector<double> weights = rodWeights(bundle, shape);
  double logarithm = 0;
  for (std::size_t r = 0; r < bundle.rods.size(); ++r) {
    const auto &a = bundle.points[bundle.rods[r].from].at, &b = bundle.points[bundle.rods[r].to].at;
    logarithm += weights[r] * std::log(bundle.rods[r].length / std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return std::exp(logarithm);
}

}  // namespace axil::skeleton3d::detail
