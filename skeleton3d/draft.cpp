#include "skeleton3d/draft.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/draft_cubes.hpp"
#include "skeleton3d/draft_settle.hpp"
#include "skeleton3d/polyline.hpp"
#include "skeleton3d/solve_all.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace axil::skeleton3d {
namespace {

using detail::CubeInView;
using detail::Cubes;
using detail::SeenMask;

constexpr double kPrice = 0.5;         ///< what a cube of way costs, in cubes of newly explained middle lines; a stem seen by three views earns 2 or more
constexpr double kStartsWithin = 0.06; ///< of the plant's size, from the origin

Failure stopped() { return fail(ErrorCode::Cancelled, "drafting the stems was stopped"); }

/// The cheapest way from the collar to every cube it reaches.
struct Ways {
  std::vector<std::size_t> order;          ///< nearest first
  std::vector<std::ptrdiff_t> before;      ///< -1 at the collar and where no way leads
};

/// The further off the middle lines, the dearer; most where a view shows a stem alone. Where stems hide one another a view's middle line is
/// that of all of them together and says little of each, so the view that fits least counts least.
double costOf(const std::vector<CubeInView>& seen) {
  constexpr double kFurthest = 2, kLeast = 0.3, kPriceOff = 3;  // cubes; against the other views; of a cube off
  double sum = 0, most = 0;
  for (const CubeInView& v : seen) {
    const double off = std::min<double>(v.off_px / v.cube_px, kFurthest);
    sum += off * off;
    most = std::max(most, off * off);
  }
  return 1 + kPriceOff * (sum - (1 - kLeast) * most) / (static_cast<double>(seen.size()) - (1 - kLeast));
}

bool comesBefore(glm::ivec3 a, glm::ivec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

/// A cube and what is around it; gaps of one cube are stepped over at a price. Cubes are sorted, so those of one column lie side by side.
template <class Visit>
void forNeighbours(const Cubes& cubes, std::size_t i, const Visit& visit) {
  const glm::ivec3 here = cubes.at[i];
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y) {
      auto next = std::lower_bound(cubes.at.begin(), cubes.at.end(), here + glm::ivec3(x, y, -2), comesBefore);
      for (; next != cubes.at.end() && next->x == here.x + x && next->y == here.y + y && next->z <= here.z + 2; ++next) {
        const int z = next->z - here.z;
        const bool far = std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2;
        if (x != 0 || y != 0 || z != 0) visit(static_cast<std::size_t>(next - cubes.at.begin()), std::sqrt(double(x * x + y * y + z * z)) * (far ? 3 : 1));
      }
    }
}

Result<Ways> waysFrom(const Cubes& cubes, std::size_t start, const Watch& watch) {
  Ways ways{{}, std::vector<std::ptrdiff_t>(cubes.at.size(), -1)};
  std::vector<double> cost(cubes.at.size(), std::numeric_limits<double>::infinity()), here(cubes.at.size());
  for (std::size_t i = 0; i < here.size(); ++i) here[i] = costOf(cubes.seen[i]);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<bool> done(cubes.at.size(), false);
  cost[start] = 0;
  queue.push({0, start});
  while (!queue.empty()) {
    const double spent = queue.top().first;
    const std::size_t i = queue.top().second;
    queue.pop();
    if (done[i]) continue;
    done[i] = true;
    ways.order.push_back(i);
    if (ways.order.size() % 4096 == 0) {
      if (watch.cancelled()) return stopped();
      watch.report("ways along the stems", 0.5 + 0.2 * static_cast<double>(ways.order.size()) / static_cast<double>(cubes.at.size()));
    }
    forNeighbours(cubes, i, [&](std::size_t j, double length) {
      const double next = spent + length * 0.5 * (here[i] + here[j]);
      if (next < cost[j]) cost[j] = next, ways.before[j] = static_cast<std::ptrdiff_t>(i), queue.push({next, j});
    });
  }
  return ways;
}

std::optional<std::size_t> collarCube(const Cubes& cubes, int cubesAcross) {
  std::optional<std::size_t> best;
  double least = kStartsWithin * cubesAcross * cubes.side;
  for (std::size_t i = 0; i < cubes.at.size(); ++i)
    if (const double away = glm::length(cubes.centre(i).at) + 0.3 * cubes.side * costOf(cubes.seen[i]); away < least) least = away, best = i;
  return best;
}

/// Which pixels of the middle lines are explained, by view.
class Explained {
 public:
  explicit Explained(std::span<const SeenMask> masks) : masks_(masks) {
    for (const SeenMask& mask : masks) done_.emplace_back(mask.lines.line.size(), false);
  }

  /// How much of the middle lines the step between two cubes newly explains, in cubes, and in how many views.
  [[nodiscard]] double gain(const Cubes& cubes, std::size_t from, std::size_t to) const {
    double sum = 0;
    for (std::size_t v = 0; v < masks_.size(); ++v) {
      const CubeInView &a = cubes.seen[from][v], &b = cubes.seen[to][v];
      if (a.pixel < 0 || b.pixel < 0 || b.off_px > 1.5F * b.cube_px + 1 || done_[v][static_cast<std::size_t>(b.pixel)]) continue;
      const glm::dvec2 step = glm::dvec2(masks_[v].lines.line[static_cast<std::size_t>(b.pixel)]) - glm::dvec2(masks_[v].lines.line[static_cast<std::size_t>(a.pixel)]);
      sum += std::min(glm::length(step) / b.cube_px, 3.5);
    }
    return sum;
  }

  void mark(const Cubes& cubes, std::size_t cube) {
    for (std::size_t v = 0; v < masks_.size(); ++v) {
      const CubeInView& seen = cubes.seen[cube][v];
      const detail::MaskLines& lines = masks_[v].lines;
      if (seen.pixel < 0) continue;
      const glm::ivec2 middle = lines.line[static_cast<std::size_t>(seen.pixel)];
      const int reach = static_cast<int>(std::ceil(std::max(2.0F * seen.cube_px, 3.0F)));
      for (int y = std::max(middle.y - reach, 0); y <= std::min(middle.y + reach, lines.height - 1); ++y)
        for (int x = std::max(middle.x - reach, 0); x <= std::min(middle.x + reach, lines.width - 1); ++x) {
          const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(lines.width) + static_cast<std::size_t>(x);
          if (lines.toLine[i] < 0.5F) done_[v][static_cast<std::size_t>(lines.nearest[i])] = true;
        }
    }
  }

 private:
  std::span<const SeenMask> masks_;
  std::vector<std::vector<bool>> done_;
};

struct Chosen {
  std::vector<std::size_t> cubes;  ///< from the parent's cube to the tip
  std::optional<std::size_t> parent;
  double gain = 0;
};

/// The way that explains most, beginning at what is already chosen.
Chosen bestWay(const Cubes& cubes, const Ways& ways, const Explained& explained, const std::vector<std::ptrdiff_t>& owner) {
  std::vector<double> worth(cubes.at.size(), 0);
  std::size_t tip = ways.order.front();
  for (const std::size_t i : ways.order) {
    if (owner[i] >= 0 || ways.before[i] < 0) continue;
    const auto from = static_cast<std::size_t>(ways.before[i]);
    const double length = glm::length(glm::dvec3(cubes.at[i] - cubes.at[from]));
    worth[i] = worth[from] + explained.gain(cubes, from, i) - kPrice * length;
    if (worth[i] > worth[tip]) tip = i;
  }
  Chosen way;
  way.gain = worth[tip];
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(tip); i >= 0; i = ways.before[static_cast<std::size_t>(i)]) {
    way.cubes.push_back(static_cast<std::size_t>(i));
    if (owner[static_cast<std::size_t>(i)] < 0) continue;
    way.parent = static_cast<std::size_t>(owner[static_cast<std::size_t>(i)]);
    break;
  }
  std::reverse(way.cubes.begin(), way.cubes.end());
  return way;
}

std::vector<glm::dvec3> smoothed(const Cubes& cubes, const std::vector<std::size_t>& way) {
  std::vector<glm::dvec3> points;
  for (const std::size_t i : way) points.push_back(cubes.centre(i).at);
  for (int round = 0; round < 6; ++round) {
    std::vector<glm::dvec3> next = points;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) next[i] = 0.25 * (points[i - 1] + 2.0 * points[i] + points[i + 1]);
    points = std::move(next);
  }
  return points;
}

/// Half the stem's width where it is seen narrowest: elsewhere something else may lie behind.
double radiusAt(std::span<const SeenMask> masks, PlantPoint at) {
  double least = std::numeric_limits<double>::infinity();
  for (const SeenMask& mask : masks) {
    const glm::dvec2 px = glm::clamp(project(mask.view->camera, at).px, glm::dvec2(0.0), glm::dvec2(mask.lines.width - 1, mask.lines.height - 1));
    const std::size_t i = static_cast<std::size_t>(px.y) * static_cast<std::size_t>(mask.lines.width) + static_cast<std::size_t>(px.x);
    const glm::ivec2 p = mask.lines.line[static_cast<std::size_t>(mask.lines.nearest[i])];
    const double half = mask.lines.inside[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(mask.lines.width) + static_cast<std::size_t>(p.x)];
    const Camera& camera = mask.view->camera;
    least = std::min(least, half / (camera.model == CameraModel::Orthographic ? camera.scale_px_per_unit : camera.focal_px->x / std::max(toView(camera, at).at.z, 1e-9)));
  }
  return least;
}

DraftStem stemOf(std::span<const SeenMask> masks, const Cubes& cubes, const Chosen& way) {
  DraftStem stem;
  stem.parent = way.parent;
  const std::vector<glm::dvec3> points = detail::settledOnLines(masks, smoothed(cubes, way.cubes), cubes.side);
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::length(points[i] - points[i - 1]) / cubes.side;
  for (const std::size_t i : detail::fewWithin(points, 0.6 * cubes.side)) stem.points.push_back({points[i]}), stem.radius.push_back(radiusAt(masks, {points[i]}));
  stem.sureness = std::clamp(way.gain / (length * (2.2 - kPrice)), 0.0, 1.0);
  return stem;
}

/// Without the stems that bear none and are far less sure than the others: in a sparse plant a stem that explains little is none, in a
/// dense one, where stems hide each other, even true ones explain little.
std::vector<DraftStem> withoutUnsure(const std::vector<DraftStem>& stems) {
  constexpr double kLeastShare = 0.3;  // of the usual sureness
  std::vector<double> sure;
  for (const DraftStem& stem : stems) sure.push_back(stem.sureness);
  std::nth_element(sure.begin(), sure.begin() + static_cast<std::ptrdiff_t>(sure.size() / 2), sure.end());
  const double least = kLeastShare * sure[sure.size() / 2];
  std::vector<bool> bears(stems.size(), false), stays(stems.size(), true);
  for (std::size_t i = stems.size(); i-- > 0;) {
    stays[i] = !stems[i].parent || bears[i] || stems[i].sureness >= least;
    if (stays[i] && stems[i].parent) bears[*stems[i].parent] = true;
  }
  std::vector<DraftStem> kept;
  std::vector<std::size_t> number(stems.size(), 0);
  for (std::size_t i = 0; i < stems.size(); ++i) {
    if (!stays[i]) continue;
    number[i] = kept.size();
    kept.push_back(stems[i]);
    if (kept.back().parent) kept.back().parent = number[*kept.back().parent];
  }
  return kept;
}

Result<std::vector<SeenMask>> seenMasks(std::span<const View> views, const std::map<std::string, Mask>& masks) {
  std::vector<SeenMask> seen;
  for (const View& view : views) {
    const auto mask = masks.find(view.name);
    if (mask == masks.end()) continue;
    if (view.size_px != glm::ivec2{0, 0} && view.size_px != glm::ivec2{mask->second.width, mask->second.height})
      return fail(ErrorCode::BadInput, "the mask of view '" + view.name + "' has " + std::to_string(mask->second.width) + " x " + std::to_string(mask->second.height) + " px, its photo " +
                                           std::to_string(view.size_px.x) + " x " + std::to_string(view.size_px.y));
    seen.push_back({&view, detail::linesOf(mask->second)});
    if (seen.back().lines.line.empty()) return fail(ErrorCode::NoAnswer, "the mask of view '" + view.name + "' shows no plant; pixels of 128 and more are the plant's");
  }
  if (seen.size() < 2) return fail(ErrorCode::BadInput, "a draft needs masks of two views at least, better three");
  return seen;
}

}  // namespace

Result<std::vector<DraftStem>> draftStems(std::span<const View> views, const std::map<std::string, Mask>& masks, const DraftOptions& options) {
  if (auto checked = detail::checkViews(views, detail::UnknownCameras::Refused); !checked) return checked.failure();
  options.watch.report("middle lines of the masks", 0.1);
  const auto seen = seenMasks(views, masks);
  if (!seen) return seen.failure();
  if (options.watch.cancelled()) return stopped();
  options.watch.report("carving", 0.3);
  const auto cubes = detail::carvedCubes(*seen, options.cubesAcross, options.watch);
  if (!cubes) return cubes.failure();
  const auto collar = collarCube(*cubes, options.cubesAcross);
  if (!collar) return fail(ErrorCode::NoAnswer, "nothing of the plant is near the origin, where its collar should be; check masks and cameras");
  options.watch.report("ways along the stems", 0.5);
  const auto ways = waysFrom(*cubes, *collar, options.watch);
  if (!ways) return ways.failure();
  Explained explained(*seen);
  std::vector<std::ptrdiff_t> owner(cubes->at.size(), -1);
  std::vector<DraftStem> stems;
  while (static_cast<int>(stems.size()) < options.maxStems) {
    if (options.watch.cancelled()) return stopped();
    options.watch.report("choosing stems", 0.7 + 0.3 * static_cast<double>(stems.size()) / options.maxStems);
    const Chosen way = bestWay(*cubes, *ways, explained, owner);
    if (way.cubes.size() < 3 || way.gain < options.leastLength * options.cubesAcross) break;
    for (const std::size_t i : way.cubes) {
      if (owner[i] < 0) owner[i] = static_cast<std::ptrdiff_t>(stems.size());
      explained.mark(*cubes, i);
    }
    stems.push_back(stemOf(*seen, *cubes, way));
  }
  if (stems.empty()) return fail(ErrorCode::NoAnswer, "no stem was found in the masks from the collar on");
  return withoutUnsure(stems);
}

}  // namespace axil::skeleton3d
