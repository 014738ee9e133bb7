#include "skeleton3d/stem_path.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kHalfStrength = 40;  ///< an edge pair of so many grey levels is half as good as any can be
constexpr double kReward = 2.0;       ///< of the best edges at one place, against squared sigmas of everything else
constexpr double kWidthRatio = 1.22;  ///< from one width that is tried to the next,
constexpr double kWidthStep_px = 2;   ///< at most so much: an edge is as sharp in a wide stem
constexpr double kTorn = 0.5;         ///< of a pair's strength is lost where another edge as strong runs between: the outer edges of two stems
constexpr double kWidthScatter = 0.15; ///< of an expected width's logarithm
constexpr double kLeastSeen = 0.08;   ///< edges of some three grey levels: less is grain
constexpr double kMostClicks = 2;     ///< times a click's scatter: a line that is known no better says nothing
constexpr double kLeastLength = 0.5;  ///< of a stem that is seen, in widths: shorter it has no edges along it
constexpr int kMaxShift = 2;          ///< states sideways from one place to the next

glm::dvec2 acrossOf(glm::dvec2 along) { return {-along.y, along.x}; }

/// The states of a place: a middle and a width.
struct Grid {
  std::vector<double> middles, widths;
  [[nodiscard]] std::size_t size() const { return middles.size() * widths.size(); }
};

Grid gridOf(const PathOptions& options, const Expected& expected) {
  Grid grid;
  double narrowest = 1.6, widest = std::max(options.maxWidth_px, 2.0);
  if (!expected.width_px.empty()) {
    const auto [low, high] = std::minmax_element(expected.width_px.begin(), expected.width_px.end());
    narrowest = std::max(*low / 1.6, narrowest);
    widest = std::max(1.6 * *high, 1.01 * narrowest);
  }
  const int half = static_cast<int>(options.reach_px / kRidgeStep_px);
  for (int i = -half; i <= half; ++i) grid.middles.push_back(i * kRidgeStep_px);
  for (double width = narrowest; width <= widest; width = std::min(kWidthRatio * width, width + kWidthStep_px)) grid.widths.push_back(width);
  return grid;
}

/// The strongest edge at each sample of a profile, in the units of ridgeStrength.
std::vector<double> edgesOf(const RidgeProfile& profile) {
  std::vector<double> edges;
  for (const glm::vec4& slope : profile.slope) {
    const double colour = glm::length(glm::vec3(slope));
    edges.push_back(profile.hasLikelihood ? 0.5 * std::min(colour, 60.0) + std::abs(slope.w) : colour);
  }
  return edges;
}

/// The strongest edge between both edges of a band about one middle, for bands that grow.
class Inside {
 public:
  Inside(const std::vector<double>& edges, const RidgeProfile& profile, double middle) : edges_(edges), centre_((middle + profile.reach_px) / kRidgeStep_px) {}

  double strongest(double width) {
    const double half = (0.5 * width - kMargin_px) / kRidgeStep_px;
    for (; reach_ <= half; ++reach_)
      for (const double at : {centre_ - reach_, centre_ + reach_}) {
        const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(edges_.size() - 1)));
        strongest_ = std::max(strongest_, edges_[i]);
      }
    return strongest_;
  }

 private:
  static constexpr double kMargin_px = 2.5;  // an edge is so wide
  const std::vector<double>& edges_;
  double centre_ = 0, reach_ = 0, strongest_ = 0;
};

/// Costs of the states at one place, from the photo alone.
std::vector<float> costsOf(const RidgeProfile& profile, const Grid& grid, double expectedWidth_px) {
  std::vector<float> costs;
  const std::vector<double> edges = edgesOf(profile);
  for (const double middle : grid.middles) {
    Inside inside(edges, profile, middle);
    for (const double width : grid.widths) {
      const double left = middle - 0.5 * width, right = middle + 0.5 * width;
      const double whole = expectedWidth_px > 0 ? ridgeStrengthOfKnownWidth(profile, left, right) : ridgeStrength(profile, left, right);
      const double s = whole - kTorn * std::min(inside.strongest(width), whole);
      const double odd = expectedWidth_px > 0 ? std::log(width / expectedWidth_px) / kWidthScatter : 0;
      costs.push_back(static_cast<float>(-kReward * s / (s + kHalfStrength) + std::min(0.25 * odd * odd, 2.0)));
    }
  }
  return costs;
}

/// One step of the recursion: the cheapest way to each state, and from which. Both kinds of steps cost by themselves, so the best of one
/// kind is found first and then the best of the other.
void step(const Grid& grid, const std::vector<float>& before, std::vector<float>& now, std::vector<std::int8_t>& from) {
  const int rows = static_cast<int>(grid.middles.size()), columns = static_cast<int>(grid.widths.size());
  std::vector<float> least(static_cast<std::size_t>(columns));
  std::vector<std::int8_t> shift(static_cast<std::size_t>(columns));
  for (int m = 0; m < rows; ++m) {
    std::fill(least.begin(), least.end(), std::numeric_limits<float>::max());
    for (int dm = std::max(-kMaxShift, -m); dm <= std::min(kMaxShift, rows - 1 - m); ++dm)
      for (int w = 0; w < columns; ++w)
        if (const float cost = before[static_cast<std::size_t>((m + dm) * columns + w)] + 0.12F * static_cast<float>(dm * dm); cost < least[static_cast<std::size_t>(w)])
          least[static_cast<std::size_t>(w)] = cost, shift[static_cast<std::size_t>(w)] = static_cast<std::int8_t>(dm);
    for (int w = 0; w < columns; ++w) {
      float best = std::numeric_limits<float>::max();
      int which = 0;
      for (int dw = std::max(-1, -w); dw <= std::min(1, columns - 1 - w); ++dw)
        if (const float cost = least[static_cast<std::size_t>(w + dw)] + 0.35F * static_cast<float>(dw * dw); cost < best)
          best = cost, which = (shift[static_cast<std::size_t>(w + dw)] + kMaxShift) * 3 + dw + 1;
      const auto i = static_cast<std::size_t>(m * columns + w);
      now[i] += best;
      from[i] = static_cast<std::int8_t>(which);
    }
  }
}

void addClick(const Grid& grid, std::vector<float>& costs, double off, double click_px) {
  for (std::size_t m = 0; m < grid.middles.size(); ++m) {
    const double away = (grid.middles[m] - off) / click_px;
    for (std::size_t w = 0; w < grid.widths.size(); ++w) costs[m * grid.widths.size() + w] += static_cast<float>(std::min(0.5 * away * away, 8.0));
  }
}

std::vector<std::size_t> cheapestStates(const Grid& grid, std::vector<std::vector<float>>& costs) {
  std::vector<std::vector<std::int8_t>> from(costs.size(), std::vector<std::int8_t>(grid.size(), 0));
  for (std::size_t i = 1; i < costs.size(); ++i) step(grid, costs[i - 1], costs[i], from[i]);
  std::vector<std::size_t> states(costs.size());
  states.back() = static_cast<std::size_t>(std::min_element(costs.back().begin(), costs.back().end()) - costs.back().begin());
  const int columns = static_cast<int>(grid.widths.size());
  for (std::size_t i = costs.size() - 1; i > 0; --i) {
    const int which = from[i][states[i]];
    const int m = static_cast<int>(states[i]) / columns + which / 3 - kMaxShift, w = static_cast<int>(states[i]) % columns + which % 3 - 1;
    states[i - 1] = static_cast<std::size_t>(m * columns + w);
  }
  return states;
}

struct Sample {
  double x = 0, at = 0, weight = 1;
};

/// y = c0 + c1 x + c2 x^2 with weights; c2 only where `bent`.
std::array<double, 3> fitted(const std::vector<Sample>& samples, const std::vector<double>& weights, int order) {
  double n[5] = {0, 0, 0, 0, 0}, b[3] = {0, 0, 0};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double power = weights[i];
    for (int k = 0; k < 5; ++k, power *= samples[i].x) {
      n[k] += power;
      if (k < 3) b[k] += power * samples[i].at;
    }
  }
  const double d2 = n[0] * n[2] - n[1] * n[1];
  const double d3 = n[0] * (n[2] * n[4] - n[3] * n[3]) - n[1] * (n[1] * n[4] - n[2] * n[3]) + n[2] * (n[1] * n[3] - n[2] * n[2]);
  if (order >= 2 && d3 > 1e-6 * n[0] * n[2] * n[4]) {
    const double c0 = (b[0] * (n[2] * n[4] - n[3] * n[3]) - n[1] * (b[1] * n[4] - n[3] * b[2]) + n[2] * (b[1] * n[3] - n[2] * b[2])) / d3;
    const double c1 = (n[0] * (b[1] * n[4] - n[3] * b[2]) - b[0] * (n[1] * n[4] - n[3] * n[2]) + n[2] * (n[1] * b[2] - b[1] * n[2])) / d3;
    const double c2 = (n[0] * (n[2] * b[2] - b[1] * n[3]) - n[1] * (n[1] * b[2] - b[1] * n[2]) + b[0] * (n[1] * n[3] - n[2] * n[2])) / d3;
    return {c0, c1, c2};
  }
  if (order >= 1 && d2 > 1e-6 * n[0] * n[2]) return {(b[0] * n[2] - b[1] * n[1]) / d2, (n[0] * b[1] - n[1] * b[0]) / d2, 0};
  return {n[0] > 0 ? b[0] / n[0] : 0, 0, 0};
}

struct EdgeFit {
  double at = 0, slope = 0, scatter = 0;
  double share = 0;    ///< of the weights, that agrees
  double support = 0;  ///< mean weight of what agrees
};

/// An edge at x = 0, from its course; what a crossing stem or a branch bends away is left out (Tukey's weights).
EdgeFit fittedEdge(const std::vector<Sample>& samples, int order) {
  std::vector<double> weights, residuals;
  for (const Sample& s : samples) weights.push_back(s.weight);
  EdgeFit fit;
  for (int round = 0; round < 6; ++round) {
    const auto c = fitted(samples, weights, order);
    residuals.clear();
    for (const Sample& s : samples) residuals.push_back(std::abs(s.at - c[0] - s.x * (c[1] + s.x * c[2])));
    std::vector<double> sorted = residuals;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double scatter = std::max(1.4826 * sorted[sorted.size() / 2], 0.12), limit = 4 * scatter;
    double inside = 0, all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double r = residuals[i] / limit;
      weights[i] = r < 1 ? samples[i].weight * std::pow(1 - r * r, 2) : 0;
      inside += r < 0.75 ? samples[i].weight : 0;
      all += samples[i].weight;
    }
    fit = {c[0], c[1], scatter, inside / all, inside / static_cast<double>(samples.size())};
  }
  return fit;
}

/// Where two edges were fitted.
struct Frame {
  glm::dvec2 origin{0, 0}, along{1, 0}, click{0, 0};
  double click_px = 3;
  double expectedWidth_px = 0;
  int order = 1;
  std::size_t samples = 0;
};

/// Standard deviation of a fitted edge: neighbouring samples share pixels, so fewer of them count.
double sigmaOf(const EdgeFit& edge, const Frame& frame) {
  return edge.scatter / std::sqrt(std::max(1.0, 0.4 * static_cast<double>(frame.samples) * edge.share / (frame.order + 1)));
}

/// How much wider or narrower than expected, beyond what roundness and the expectation leave open: then one of the edges is that
/// of a branch or of something behind, and the middle is off by up to half of it.
double oddWidth_px(double width, double expected) { return expected > 0 ? std::max(std::abs(width - expected) - 0.5 - 0.04 * expected, 0.0) : 0; }

/// The line midway between both edges. Where one edge is hardly seen and the width known, half a width from the other.
std::optional<RidgeReading> joined(const EdgeFit& left, const EdgeFit& right, const Frame& frame) {
  RidgeReading reading;
  double middle = 0.5 * (left.at + right.at), slope = 0.5 * (left.slope + right.slope), width = right.at - left.at;
  const double sigmaLeft = sigmaOf(left, frame), sigmaRight = sigmaOf(right, frame), expected = frame.expectedWidth_px;
  reading.sigmaAcross_px = std::hypot(std::hypot(0.15, 0.5 * oddWidth_px(width, expected)), 0.5 * sigmaLeft, 0.5 * sigmaRight);
  reading.sigmaWidth_px = std::hypot(0.3, sigmaLeft, sigmaRight);
  reading.confidence = std::min(left.support, right.support);
  const bool oneSided = expected > 0 && (std::min(left.support, right.support) < 0.4 * std::max(left.support, right.support) ||
                                         std::abs(std::log(std::max(width, 0.1) / expected)) > 0.35);
  if (oneSided) {
    const bool byLeft = left.support > right.support;
    middle = byLeft ? left.at + 0.5 * expected : right.at - 0.5 * expected;
    slope = byLeft ? left.slope : right.slope;
    reading.sigmaAcross_px = std::hypot(0.3, byLeft ? sigmaLeft : sigmaRight, 0.1 * expected);
    reading.confidence = 0.7 * std::max(left.support, right.support);
    reading.sigmaWidth_px = 0.5 * expected;
    width = expected;
  }
  const glm::dvec2 across = acrossOf(frame.along), direction = glm::normalize(frame.along + slope * across);
  reading.at.px = frame.origin + middle * across;
  reading.at.px += glm::dot(frame.click - reading.at.px, direction) * direction;
  reading.along = Angle::fromRadians(std::atan2(direction.y, direction.x));
  reading.width_px = width / std::sqrt(1 + slope * slope);
  if (reading.confidence < kLeastSeen) return std::nullopt;
  if (!(reading.width_px > 0.5) || reading.sigmaAcross_px > kMostClicks * frame.click_px) return std::nullopt;
  return reading;
}

}  // namespace

std::vector<EdgePair> likeliestEdges(const Photo& photo, const StemLikelihood& likelihood, const StemLine& line, std::span<const glm::dvec2> clicks, const PathOptions& options,
                                     const Expected& expected) {
  if (line.at.empty()) return {};
  const Grid grid = gridOf(options, expected);
  const auto widthAt = [&](std::size_t i) { return expected.width_px.empty() ? 0.0 : expected.width_px[i]; };
  const ProfileOptions wide{.reach_px = options.reach_px + 0.5 * grid.widths.back() + 2, .blur_px = options.blur_px, .along_px = 1};
  std::vector<RidgeProfile> profiles;
  std::vector<std::vector<float>> costs;
  for (std::size_t i = 0; i < line.at.size(); ++i) {
    profiles.push_back(profileAcross(photo, likelihood, line.at[i], acrossOf(line.along[i]), wide));
    costs.push_back(costsOf(profiles.back(), grid, widthAt(i)));
  }
  for (std::size_t c = 0; c < clicks.size(); ++c) {
    const std::size_t i = line.placeOf[c];
    addClick(grid, costs[i], glm::dot(clicks[c] - line.at[i], acrossOf(line.along[i])), options.click_px);
  }
  const std::vector<std::size_t> states = cheapestStates(grid, costs);
  std::vector<EdgePair> edges;
  for (std::size_t i = 0; i < line.at.size(); ++i) {
    const double middle = grid.middles[states[i] / grid.widths.size()], width = grid.widths[states[i] % grid.widths.size()];
    const double reach = std::min(1.5, 0.15 * width + 0.5);
    const double left = sharpened(profiles[i], middle - 0.5 * width, reach), right = sharpened(profiles[i], middle + 0.5 * width, reach);
    const glm::dvec2 across = acrossOf(line.along[i]);
    edges.push_back({line.at[i] + left * across, line.at[i] + right * across, ridgeStrength(profiles[i], left, right), edgeStrength(profiles[i], left, StemSide::Left),
                     edgeStrength(profiles[i], right, StemSide::Right), widthAt(i)});
  }
  return edges;
}

std::optional<RidgeReading> readingAt(const StemLine& line, const std::vector<EdgePair>& edges, std::size_t place, glm::dvec2 click, const PathOptions& options,
                                      PlaceRange within) {
  const auto middleOf = [&](std::size_t i) { return 0.5 * (edges[i].left + edges[i].right); };
  // The place beside the click on the path that was found, not on the line that was searched along.
  std::size_t nearest = std::clamp(place, within.first, within.last);
  for (std::size_t i = within.first; i <= within.last; ++i)
    if (std::abs(line.length_px[i] - line.length_px[place]) < 3 * options.click_px && glm::length(middleOf(i) - click) < glm::length(middleOf(nearest) - click)) nearest = i;
  const double width = glm::length(edges[nearest].right - edges[nearest].left);
  const double reach = std::clamp(1.2 * width, 8.0, 40.0);
  std::size_t a = nearest, b = nearest;
  while (a > within.first && line.length_px[nearest] - line.length_px[a] < reach) --a;
  while (b < within.last && line.length_px[b] - line.length_px[nearest] < reach) ++b;
  const glm::dvec2 chord = middleOf(b) - middleOf(a);
  if (b - a < 3 || glm::length(chord) < std::max(3.0, kLeastLength * width)) return std::nullopt;  // seen from its end
  const glm::dvec2 along = glm::normalize(chord), across = acrossOf(along);
  const glm::dvec2 origin = middleOf(nearest) + glm::dot(click - middleOf(nearest), along) * along;
  std::vector<Sample> lefts, rights;
  const auto weightOf = [](double strength) { return std::max(strength, 0.0) / (std::max(strength, 0.0) + kHalfStrength) + 1e-3; };
  for (std::size_t i = a; i <= b; ++i) {
    const double x = glm::dot(middleOf(i) - origin, along);
    lefts.push_back({x, glm::dot(edges[i].left - origin, across), weightOf(edges[i].leftStrength)});
    rights.push_back({x, glm::dot(edges[i].right - origin, across), weightOf(edges[i].rightStrength)});
  }
  const bool bothSides = nearest - a > 2 && b - nearest > 2;
  const int order = bothSides && b - a >= 6 ? 2 : 1;
  return joined(fittedEdge(lefts, order), fittedEdge(rights, order), {origin, along, click, options.click_px, edges[nearest].expectedWidth_px, order, lefts.size()});
}

}  // namespace axil::skeleton3d::detail
