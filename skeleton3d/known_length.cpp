#include "skeleton3d/known_length.hpp"

#include "skeleton3d/known_length_bands.hpp"
#include "skeleton3d/statistics.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace axil::skeleton3d {
namespace {

using detail::colourAt;

constexpr double kShortest_px = 40;
constexpr double kShortestBanded_px = 60;  // a rod seen from above shows no bands of equal length
constexpr double kStep_px = 0.25;
constexpr double kFaint = 6;  // grey levels: below it noise

/// Where a rod ends: `out` points away from it, `side` across.
struct End {
  glm::dvec2 click;
  glm::dvec2 out;
  glm::dvec2 side;
  double reach = 0;   ///< px about the click in which the end is looked for
  double length = 0;  ///< px of the whole

  [[nodiscard]] glm::dvec2 at(double along, double across) const { return click + along * out + across * side; }
};

struct Sampled {
  double first = 0;
  std::vector<double> values;  ///< kStep_px apart

  [[nodiscard]] double place(std::size_t i) const { return first + kStep_px * static_cast<double>(i); }
};

Sampled sampled(double reach, const std::function<double(double)>& value) {
  Sampled samples{-reach, {}};
  const auto count = static_cast<std::size_t>(2 * reach / kStep_px) + 1;
  for (std::size_t i = 0; i < count; ++i) samples.values.push_back(value(samples.place(i)));
  return samples;
}

std::vector<std::size_t> peaksOf(const Sampled& samples) {
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < samples.values.size(); ++i)
    if (samples.values[i] > samples.values[i - 1] && samples.values[i] >= samples.values[i + 1]) peaks.push_back(i);
  return peaks;
}

/// The rod's middle line and half its width near an end, across.
struct Across {
  double middle = 0;
  double half = 1;
};

/// How strongly the colour changes across the rod, as a mean over its last part inside the end.
Sampled edgesAcross(const Photo& photo, const End& end) {
  const double inner = end.reach + 1, depth = std::max(12.0, 0.2 * end.length);
  return sampled(1.6 * end.reach, [&](double across) {
    double sum = 0, count = 0;
    for (double along = inner; along <= inner + depth; along += 1, ++count) sum += glm::length(colourAt(photo, end.at(-along, across + 0.75)) - colourAt(photo, end.at(-along, across - 0.75)));
    return sum / std::max(count, 1.0);
  });
}

/// The pair of edges whose weaker one is strongest, about a middle within reach of the click.
std::optional<Across> acrossOf(const Photo& photo, const End& end) {
  const Sampled edges = edgesAcross(photo, end);
  const auto peaks = peaksOf(edges);
  constexpr double kThinnest_px = 2;
  std::optional<Across> best;
  double strength = std::max(kFaint, 1.5 * detail::medianOf(edges.values));
  for (std::size_t i = 0; i < peaks.size(); ++i)
    for (std::size_t j = i + 1; j < peaks.size(); ++j) {
      const Across pair{(edges.place(peaks[i]) + edges.place(peaks[j])) / 2, (edges.place(peaks[j]) - edges.place(peaks[i])) / 2};
      const double weaker = std::min(edges.values[peaks[i]], edges.values[peaks[j]]);
      if (2 * pair.half < kThinnest_px || std::abs(pair.middle) > end.reach || weaker <= strength) continue;
      strength = weaker;
      best = pair;
    }
  return best;
}

/// How the colour changes at `along`, as a mean over lines nearer to the edges than to the middle: a round rod seen a little
/// from above ends in a rim, whose sides are level with its middle while its front is nearer to the camera.
double changeAt(const Photo& photo, const End& end, double along, double middle, double half) {
  glm::dvec3 change{0, 0, 0};
  constexpr std::array kLines = {-0.85, -0.65, 0.65, 0.85};
  for (const double line : kLines)
    change += (colourAt(photo, end.at(along + 0.75, middle + line * half)) - colourAt(photo, end.at(along - 0.75, middle + line * half))) / static_cast<double>(kLines.size());
  return glm::length(change);
}

/// Between samples, by the parabola through a peak and its neighbours.
double finePlace(const Sampled& samples, std::size_t peak) {
  const double before = samples.values[peak - 1], here = samples.values[peak], after = samples.values[peak + 1];
  const double bend = before - 2 * here + after;
  return samples.place(peak) + (bend < 0 ? kStep_px * 0.5 * (before - after) / bend : 0.0);
}

std::optional<double> alongOf(const Photo& photo, const End& end, const Across& rod) {
  const double beside = rod.half + 2.5;
  const Sampled ends = sampled(end.reach, [&](double along) {
    const double sides = std::max(changeAt(photo, end, along, rod.middle - beside, 1), changeAt(photo, end, along, rod.middle + beside, 1));
    const double share = along / end.reach;
    return std::max(changeAt(photo, end, along, rod.middle, rod.half) - 0.7 * sides, 0.0) * (1 - 0.4 * share * share);
  });
  auto peaks = peaksOf(ends);
  if (peaks.empty()) return std::nullopt;
  std::stable_sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return ends.values[a] > ends.values[b]; });
  constexpr double kClearly = 1.6, kSamePlace_px = 2;
  const auto rival = std::find_if(peaks.begin(), peaks.end(), [&](std::size_t p) { return std::abs(ends.place(p) - ends.place(peaks.front())) > kSamePlace_px; });
  const double best = ends.values[peaks.front()];
  if (best < kFaint || (rival != peaks.end() && best < kClearly * ends.values[*rival])) return std::nullopt;
  return finePlace(ends, peaks.front());
}

double reachOf(double length_px) { return std::clamp(0.06 * length_px, 4.0, 12.0); }

End endAt(glm::dvec2 click, glm::dvec2 other) {
  End end;
  end.click = click;
  end.length = glm::length(click - other);
  end.out = (click - other) / end.length;
  end.side = {-end.out.y, end.out.x};
  end.reach = reachOf(end.length);
  return end;
}

std::optional<PhotoPoint> endNear(const Photo& photo, glm::dvec2 click, glm::dvec2 other) {
  const End end = endAt(click, other);
  const auto across = acrossOf(photo, end);
  const auto along = across ? alongOf(photo, end, *across) : std::nullopt;
  if (!along) return std::nullopt;
  return PhotoPoint{end.at(*along, across->middle)};
}

bool within(const Photo& photo, glm::dvec2 px) { return px.x >= 0 && px.y >= 0 && px.x <= photo.width && px.y <= photo.height; }

/// `end`, known along the rod, moved to between the rod's two edges.
glm::dvec2 betweenEdges(const Photo& photo, glm::dvec2 end, glm::dvec2 other) {
  constexpr double kNear_px = 4;
  const End place = endAt(end, other);
  const auto across = acrossOf(photo, place);
  return across && std::abs(across->middle) < kNear_px ? place.at(0, across->middle) : end;
}

SnappedLength measuredByBands(const Photo& photo, const KnownLength& clicked, detail::BandedEnds bands, std::optional<double> focal_px) {
  SnappedLength snapped{clicked, true, true, {bands.sigma_px, bands.sigma_px}};
  const glm::dvec2 from = betweenEdges(photo, bands.from, bands.to), to = betweenEdges(photo, bands.to, bands.from);
  bands.from = from;
  bands.to = to;
  constexpr double kFront = 0.9;  // of the radius, for lines over the middle of the rod
  const double nearer = focal_px ? kFront * bands.half_px / *focal_px : 0.0;
  const glm::dvec2 shrink = 0.5 * nearer * (bands.to - bands.from);
  snapped.scale.from = {bands.from + shrink};
  snapped.scale.to = {bands.to - shrink};
  return snapped;
}

}  // namespace

SnappedLength snapKnownLength(const Photo& photo, const KnownLength& clicked, std::optional<double> focal_px) {
  SnappedLength snapped{clicked};
  const double length_px = glm::length(clicked.to.px - clicked.from.px);
  if (photo.width < 2 || photo.height < 2 || !within(photo, clicked.from.px) || !within(photo, clicked.to.px) || length_px < kShortest_px) return snapped;
  if (const auto bands = length_px < kShortestBanded_px ? std::nullopt : detail::bandedEnds(photo, clicked.from.px, clicked.to.px, reachOf(length_px))) return measuredByBands(photo, clicked, *bands, focal_px);
  const auto from = endNear(photo, clicked.from.px, clicked.to.px), to = endNear(photo, clicked.to.px, clicked.from.px);
  snapped.fromMoved = from.has_value();
  snapped.toMoved = to.has_value();
  constexpr double kEnd_px = 1;  // with the rim of a rod that is seen from above
  if (from) snapped.scale.from = *from, snapped.sigma_px[0] = kEnd_px;
  if (to) snapped.scale.to = *to, snapped.sigma_px[1] = kEnd_px;
  return snapped;
}

}  // namespace axil::skeleton3d
