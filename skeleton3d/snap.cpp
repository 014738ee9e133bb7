#include "skeleton3d/snap.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace axil::skeleton3d {
namespace {

/// A pair of edges across one line.
struct Band {
  double left = 0, right = 0;  ///< px from the line's centre
  double strength = 0;
  double score = 0;            ///< strength, less the further it is from the click

  [[nodiscard]] double middle() const { return 0.5 * (left + right); }
  [[nodiscard]] double width() const { return right - left; }
};

glm::dvec2 directionOf(double radians) { return {std::cos(radians), std::sin(radians)}; }
glm::dvec2 acrossOf(glm::dvec2 along) { return {-along.y, along.x}; }

/// A click inside a band is as good as one on its middle: a person aims at the stem, not at a line.
double nearness(double middle, double width, double reach_px) {
  const double off = std::max(std::abs(middle) - 0.25 * width, 0.0) / (0.5 * reach_px);
  return std::exp(-0.5 * off * off);
}

/// Where edges are steepest along a profile, the strongest of them, in order.
std::vector<double> edgesIn(const RidgeProfile& profile) {
  constexpr float kFaintest = 2;  // grey levels
  constexpr std::size_t kMost = 14;
  std::vector<float> heights;
  for (const glm::vec4& slope : profile.slope) heights.push_back(glm::length(glm::vec3(slope)));
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
    if (heights[i] > kFaintest && heights[i] >= heights[i - 1] && heights[i] > heights[i + 1]) peaks.push_back(i);
  std::stable_sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) { return heights[a] > heights[b]; });
  peaks.resize(std::min(peaks.size(), kMost));
  std::sort(peaks.begin(), peaks.end());
  std::vector<double> edges;
  for (const std::size_t i : peaks) edges.push_back(static_cast<double>(i) * kRidgeStep_px - profile.reach_px);
  return edges;
}

Band bestBand(const RidgeProfile& profile, double maxWidth_px, double reach_px) {
  constexpr double kNarrowest_px = 1.5;
  const std::vector<double> edges = edgesIn(profile);
  Band best;
  for (std::size_t l = 0; l < edges.size(); ++l)
    for (std::size_t r = l + 1; r < edges.size() && edges[r] - edges[l] <= maxWidth_px; ++r) {
      const double width = edges[r] - edges[l], middle = 0.5 * (edges[l] + edges[r]);
      if (width < kNarrowest_px || std::abs(middle) > reach_px) continue;
      const double strength = ridgeStrength(profile, edges[l], edges[r]), score = strength * nearness(middle, width, reach_px);
      if (score > best.score) best = {edges[l], edges[r], strength, score};
    }
  return best;
}

Band sharpenedBand(const RidgeProfile& profile, Band band) {
  const double reach = std::min(1.5, 0.3 * band.width() + 0.5);
  band.left = sharpened(profile, band.left, reach);
  band.right = sharpened(profile, band.right, reach);
  band.strength = ridgeStrength(profile, band.left, band.right);
  return band;
}

struct Found {
  glm::dvec2 at{0, 0};
  glm::dvec2 along{1, 0};
  Band band;
};

Found searched(const Photo& photo, glm::dvec2 click, const SnapOptions& options) {
  const double maxWidth = widestStem_px(photo, options), pi = 3.14159265358979323846;
  const ProfileOptions wide{.reach_px = options.reach_px + 0.5 * maxWidth + 3, .blur_px = 1, .along_px = 3, .sampling = Sampling::NearestPixel};
  Found best;
  const int turns = options.along ? 5 : 12;
  for (int k = 0; k < turns; ++k) {
    const glm::dvec2 along = directionOf(options.along ? options.along->radians() + (k - 2) * pi / 18 : k * pi / 12);
    const Band band = bestBand(profileAcross(photo, {}, click, acrossOf(along), wide), maxWidth, options.reach_px);
    if (band.score > best.band.score) best = {click + band.middle() * acrossOf(along), along, band};
  }
  return best;
}

/// The band seen `step` px further along, near where it is here.
std::optional<Band> bandAt(const Photo& photo, const Found& here, double step, Sampling sampling) {
  const double half = 0.5 * here.band.width(), reach = half + 6;
  const RidgeProfile profile = profileAcross(photo, {}, here.at + step * here.along, acrossOf(here.along), {.reach_px = reach, .blur_px = 1, .along_px = 1, .sampling = sampling});
  Band band;
  for (double middle = -3; middle <= 3; middle += kRidgeStep_px)
    for (const double scale : {0.85, 1.0, 1.15})
      if (const double s = ridgeStrength(profile, middle - half * scale, middle + half * scale); s > band.strength) band = {middle - half * scale, middle + half * scale, s, s};
  if (band.strength < 0.4 * here.band.strength) return std::nullopt;
  return sharpenedBand(profile, band);
}

struct Line {
  double offset = 0, slope = 0, scatter = 0;
};

/// y = offset + slope x by least squares.
Line lineThrough(const std::vector<glm::dvec2>& points) {
  glm::dvec2 mean(0.0);
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  double xx = 0, xy = 0, rest = 0;
  for (const auto& p : points) xx += (p.x - mean.x) * (p.x - mean.x), xy += (p.x - mean.x) * (p.y - mean.y);
  Line line;
  line.slope = xx > 0 ? xy / xx : 0;
  line.offset = mean.y - line.slope * mean.x;
  for (const auto& p : points) rest += std::pow(p.y - line.offset - line.slope * p.x, 2);
  line.scatter = std::sqrt(rest / std::max<double>(1, static_cast<double>(points.size()) - 2));
  return line;
}

struct Followed {
  Found found;
  double scatter = 0;
  double widthScatter = 0;
  double share = 0;  ///< of the places looked at along the stem, on its better side, where the band goes on
};

/// Straightens the direction by the band's course to both sides; a tip has only one.
Followed followed(const Photo& photo, Found found) {
  Followed result;
  for (const Sampling sampling : {Sampling::NearestPixel, Sampling::BetweenPixels}) {  // roughly, then well
    std::vector<glm::dvec2> middles, widths;
    int sides[2] = {0, 0};
    for (int k = -4; k <= 4; ++k)
      if (const auto band = bandAt(photo, found, 2.0 * k, sampling)) {
        middles.push_back({2.0 * k, band->middle()});
        widths.push_back({2.0 * k, band->width()});
        if (k != 0) ++sides[k > 0];
      }
    result.found = found;
    result.share = std::max(sides[0], sides[1]) / 4.0;
    if (middles.size() < 4) return result;
    const Line line = lineThrough(middles), width = lineThrough(widths);
    const glm::dvec2 across = acrossOf(found.along);
    found.at += line.offset * across;
    found.along = glm::normalize(found.along + line.slope * across);
    found.band.left = -0.5 * width.offset;
    found.band.right = 0.5 * width.offset;
    result = {found, line.scatter, width.scatter, result.share};
  }
  return result;
}

/// Strength against what the photo has everywhere about: grain and texture.
double confidenceOf(const Photo& photo, const Followed& here) {
  const RidgeProfile profile = profileAcross(photo, {}, here.found.at, acrossOf(here.found.along), {.reach_px = 0.5 * here.found.band.width() + 12, .blur_px = 1, .along_px = 3});
  std::vector<double> slopes;
  for (const glm::vec4& s : profile.slope) slopes.push_back(glm::length(glm::vec3(s)));
  std::nth_element(slopes.begin(), slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2), slopes.end());
  const double strength = ridgeStrength(profile, here.found.band.left, here.found.band.right);
  const double usual = 6 + 1.2 * slopes[slopes.size() / 2];
  return strength * strength / (strength * strength + usual * usual) * std::min(1.0, here.share * 1.34);
}

double wrappedHalfTurn(double radians) {
  const double pi = 3.14159265358979323846;
  const double wrapped = std::fmod(radians, pi);
  return wrapped < 0 ? wrapped + pi : wrapped;
}

}  // namespace

double widestStem_px(const Photo& photo, const SnapOptions& options) { return options.maxWidth_px.value_or(std::max(40.0, 0.05 * std::max(photo.width, photo.height))); }

std::optional<RidgeReading> snapClick(const Photo& photo, PhotoPoint click, const SnapOptions& options) {
  if (photo.width < 3 || photo.height < 3) return std::nullopt;
  const Found found = searched(photo, click.px, options);
  if (!(found.band.strength > 0)) return std::nullopt;
  const Followed here = followed(photo, found);
  const double confidence = confidenceOf(photo, here);
  if (!(confidence >= options.leastConfidence)) return std::nullopt;
  // Across the stem only: the foot of the perpendicular from the click to the centre line.
  const glm::dvec2 along = here.found.along;
  const glm::dvec2 at = here.found.at + glm::dot(click.px - here.found.at, along) * along;
  if (glm::length(at - click.px) > options.reach_px + 0.25 * here.found.band.width()) return std::nullopt;
  const double floor_px = 0.1;  // of pixels whose shape nobody knows
  return RidgeReading{{at}, Angle::fromRadians(wrappedHalfTurn(std::atan2(along.y, along.x))), std::hypot(floor_px, 0.5 * here.scatter), here.found.band.width(),
                      std::hypot(2 * floor_px, 0.5 * here.widthScatter), confidence};
}

}  // namespace axil::skeleton3d
