// Veins, hairs and spots: lines and small polygons in the plane of the outline.
#include "base/rng.hpp"
#include "organs/flat_shapes.hpp"
#include "organs/leaf_posture.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::organs {

namespace {

using Line = std::vector<glm::dvec2>;
using Half = std::vector<Ruling>;
constexpr std::size_t fineRulings = 150;
constexpr double nearMargin = 0.93;  // veins end shortly before the margin

/// Both halves of a blade as rulings, and lines across them.
class Blade {
 public:
  explicit Blade(const LeafShape& shape) : shape_(shape), right_(rulingsOf(shape, fineRulings)), left_(leftOf(right_, shape)) {}

  [[nodiscard]] const LeafShape& shape() const { return shape_; }
  [[nodiscard]] const Half& right() const { return right_; }

  /// Adds the line on both halves; `line` makes it from one of them.
  template <class Make>
  void both(std::vector<LeafVein>& veins, double thickness, Make make) const {
    add(veins, make(right_), 1, thickness);
    add(veins, make(left_), -1, thickness);
  }
  void add(std::vector<LeafVein>& veins, const Line& line, double side, double thickness) const {
    if (line.size() < 2) return;
    LeafVein vein{{}, thickness};
    for (const glm::dvec2& p : line) vein.points.emplace_back(bowedX(shape_, side * p.x, p.y), p.y);
    veins.push_back(std::move(vein));
  }

 private:
  const LeafShape& shape_;
  Half right_, left_;
};

/// Along one ruling, a little hollow towards the tip as side veins are.
Line alongRuling(const Ruling& ruling, double to) {
  constexpr int pieces = 5;
  const glm::dvec2 foot{0, ruling.foot};
  const glm::dvec2 run = ruling.margin - foot;
  Line line;
  for (int i = 0; i <= pieces; ++i) {
    const double s = to * i / pieces;
    line.push_back(foot + run * s - glm::dvec2{0, 0.10 * run.x * s * (1 - s)});
  }
  return line;
}

/// From base to tip at a constant share of the width: what runs side by side.
Line alongBlade(const Half& half, double share, double upTo) {
  Line line;
  for (std::size_t i = 0; i < half.size(); i += 3) {
    const glm::dvec2 p = glm::dvec2{0, half[i].foot} * (1 - share) + half[i].margin * share;
    if (p.y > upTo) break;
    if (line.empty() || p.y > line.back().y + 1e-4) line.push_back(p);
  }
  return line;
}

/// Where lobes end: the places of the margin that lie farthest out.
std::vector<std::size_t> lobeTips(const LeafShape& shape, const Half& half) {
  const auto reach = [&](std::size_t i) { return shape.lobes == LeafLobes::Palmate ? glm::length(half[i].margin) : half[i].margin.x; };
  std::vector<std::size_t> tips;
  const std::size_t window = shape.lobes == LeafLobes::Palmate ? 9 : 5;
  for (std::size_t i = 1; i + 2 < half.size(); ++i) {
    bool isTip = true;
    for (std::size_t k = i > window ? i - window : 0; k <= std::min(i + window, half.size() - 1); ++k) isTip = isTip && (reach(k) < reach(i) || k == i);
    if (isTip) tips.push_back(i);
  }
  return tips;
}

/// The rulings at which side veins stand: at lobes, or evenly along the midrib.
std::vector<std::size_t> sidePlaces(const LeafShape& shape, const Half& half, int pairs) {
  if (shape.lobes == LeafLobes::Pinnate) return lobeTips(shape, half);
  std::vector<std::size_t> places;
  for (int k = 0; k < pairs; ++k) {
    const double foot = 0.05 + 0.80 * k / std::max(1, pairs - 1);
    const auto at = std::find_if(half.begin(), half.end(), [&](const Ruling& r) { return r.foot >= foot; });
    if (at != half.end() && (places.empty() || static_cast<std::size_t>(at - half.begin()) > places.back())) places.push_back(static_cast<std::size_t>(at - half.begin()));
  }
  return places;
}

double sideThickness(const LeafShape& shape) { return std::min(0.0075, 0.022 * shape.widthToLength); }

void addPinnate(std::vector<LeafVein>& veins, const Blade& blade) {
  for (const std::size_t i : sidePlaces(blade.shape(), blade.right(), blade.shape().veinPairs))
    blade.both(veins, sideThickness(blade.shape()), [&](const Half& half) { return alongRuling(half[i], nearMargin); });
}

/// Several from the foot: to the tips of the lobes, or fanned evenly over the margin.
void addPalmate(std::vector<LeafVein>& veins, const Blade& blade) {
  const LeafShape& shape = blade.shape();
  std::vector<std::size_t> ends;
  if (shape.lobes == LeafLobes::Palmate) ends = lobeTips(shape, blade.right());
  else
    for (int k = 0; k < std::max(2, shape.veinPairs / 2 + 1); ++k) ends.push_back(blade.right().size() * static_cast<std::size_t>(2 * k + 1) / static_cast<std::size_t>(2 * std::max(2, shape.veinPairs / 2 + 1)));
  for (const std::size_t i : ends)
    blade.both(veins, 1.3 * sideThickness(shape), [&](const Half& half) {
      const glm::dvec2 to = half[i].margin * nearMargin;
      // Fans stay within blades whose margin can be seen from the petiole; others get their veins from the midrib.
      return alongRuling({shape.lobes == LeafLobes::Palmate ? 0.0 : 0.4 * half[i].foot, to}, 1);
    });
}

void addParallel(std::vector<LeafVein>& veins, const Blade& blade) {
  const int pairs = std::max(1, blade.shape().veinPairs);
  for (int k = 1; k <= pairs; ++k)
    blade.both(veins, 0.6 * sideThickness(blade.shape()), [&](const Half& half) { return alongBlade(half, k / (pairs + 0.8), 0.985); });
}

void addArcuate(std::vector<LeafVein>& veins, const Blade& blade) {
  const int pairs = std::max(1, blade.shape().veinPairs);
  for (int k = 1; k <= pairs; ++k)
    blade.both(veins, 1.2 * sideThickness(blade.shape()), [&](const Half& half) { return alongBlade(half, 0.84 * k / (pairs + 0.35), 0.93); });
}

/// Small veins that join one side vein to the next.
void addNet(std::vector<LeafVein>& veins, const Blade& blade) {
  addPinnate(veins, blade);
  const std::vector<std::size_t> places = sidePlaces(blade.shape(), blade.right(), blade.shape().veinPairs);
  for (std::size_t p = 0; p + 1 < places.size(); ++p)
    for (const double share : {0.2, 0.38, 0.56, 0.74, 0.9})
      blade.both(veins, 0.45 * sideThickness(blade.shape()), [&](const Half& half) {
        const Ruling &low = half[places[p]], &high = half[places[p + 1]];
        const double shifted = std::min(nearMargin, share + 0.07);
        return Line{alongRuling(low, share).back(), 0.5 * (alongRuling(low, share).back() + alongRuling(high, shifted).back()) + glm::dvec2{0.01, 0}, alongRuling(high, shifted).back()};
      });
}

/// Forks from the foot on, as in ginkgo.
void addForks(std::vector<LeafVein>& veins, const Blade& blade) {
  const std::size_t n = blade.right().size();
  const int forks = 2 * std::max(2, blade.shape().veinPairs);
  for (int k = 0; k < forks; ++k) {
    const std::size_t at = n / 3 + (n - n / 3 - 1) * static_cast<std::size_t>(2 * k + 1) / static_cast<std::size_t>(2 * forks);
    const std::size_t stem = n / 3 + (n - n / 3 - 1) * static_cast<std::size_t>(2 * (k / 2 * 2) + 2) / static_cast<std::size_t>(2 * forks);
    blade.both(veins, 0.5 * sideThickness(blade.shape()), [&](const Half& half) {
      const glm::dvec2 fork = half[stem].margin * 0.5;
      return Line{{0, 0.01}, fork * 0.5, fork, half[at].margin * nearMargin};
    });
  }
}

LeafVein midribOf(const LeafShape& shape) {
  LeafVein midrib{{}, std::min(0.018, 0.06 * shape.widthToLength)};
  constexpr int pieces = 12;
  for (int i = 0; i <= pieces; ++i) midrib.points.emplace_back(bowedX(shape, 0, 0.985 * i / pieces), 0.985 * i / pieces);
  return midrib;
}

void addSideVeins(std::vector<LeafVein>& veins, const Blade& blade) {
  if (blade.shape().lobes == LeafLobes::Palmate) return addPalmate(veins, blade);
  switch (blade.shape().veins) {
    case LeafVeins::Pinnate: return addPinnate(veins, blade);
    case LeafVeins::Palmate: return addPalmate(veins, blade);
    case LeafVeins::Parallel: return addParallel(veins, blade);
    case LeafVeins::Arcuate: return addArcuate(veins, blade);
    case LeafVeins::Reticulate: return addNet(veins, blade);
    case LeafVeins::Dichotomous: return addForks(veins, blade);
    case LeafVeins::MidribOnly:
    case LeafVeins::None: return;
  }
}

std::vector<glm::dvec2> doubled(const std::vector<glm::vec2>& points) { return {points.begin(), points.end()}; }

/// A line cut where it first leaves the outline, so that no vein runs through a sinus.
LeafVein inside(const LeafVein& vein, const std::vector<glm::dvec2>& outline) {
  LeafVein kept{{vein.points.front()}, vein.thickness};
  for (std::size_t i = 1; i < vein.points.size(); ++i) {
    if (!isInside(outline, glm::dvec2(vein.points[i]))) break;
    kept.points.push_back(vein.points[i]);
  }
  return kept;
}

}  // namespace

std::vector<LeafVein> leafVeins(const LeafShape& shape) {
  if (shape.veins == LeafVeins::None) return {};
  std::vector<LeafVein> all;
  if (shape.veins != LeafVeins::Dichotomous || shape.lobes == LeafLobes::Palmate) all.push_back(midribOf(shape));
  addSideVeins(all, Blade(shape));
  const std::vector<glm::dvec2> outline = doubled(leafOutline(shape));
  std::vector<LeafVein> veins;
  for (const LeafVein& vein : all) {
    LeafVein kept = inside(vein, outline);
    if (kept.points.size() > 1) veins.push_back(std::move(kept));
  }
  return veins;
}

std::vector<std::vector<glm::vec2>> leafHairs(const LeafShape& shape) {
  if (shape.margin != LeafMargin::Ciliate) return {};
  std::vector<std::vector<glm::vec2>> hairs;
  const std::vector<glm::vec2> outline = leafOutline(shape);
  double around = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) around += glm::distance(glm::dvec2(outline[i]), glm::dvec2(outline[(i + 1) % outline.size()]));
  const double apart = around / (2.0 * std::max(1, shape.teeth));
  double next = 0.5 * apart;
  double at = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    const double length = glm::distance(a, b);
    for (; length > 0 && next <= at + length; next += apart) {
      const glm::dvec2 along = (b - a) / length;
      const glm::dvec2 root = a + along * (next - at);
      const glm::dvec2 out = glm::normalize(glm::dvec2{along.y, -along.x} + glm::dvec2{0, 0.35});
      hairs.push_back({glm::vec2(root - out * 0.004), glm::vec2(root + out * shape.toothDepth)});
    }
    at += length;
  }
  return hairs;
}

std::vector<std::vector<glm::vec2>> leafSpots(const LeafShape& shape) {
  if (shape.spots <= 0) return {};
  constexpr int tries = 400, corners = 7;
  const std::vector<glm::dvec2> outline = doubled(leafOutline(shape));
  const double area = 0.6 * shape.widthToLength;
  Rng rng(2005);
  std::vector<std::vector<glm::vec2>> spots;
  double covered = 0;
  for (int i = 0; i < tries && covered < std::min(shape.spots, 0.6) * area; ++i) {
    const glm::dvec2 centre{(rng.uniform() - 0.5) * shape.widthToLength, rng.uniform()};
    const double radius = (0.025 + 0.045 * rng.uniform()) * std::sqrt(shape.widthToLength);
    std::vector<glm::vec2> spot;
    bool fits = std::abs(centre.x) > radius;  // the midrib stays free
    for (int k = 0; k < corners; ++k) {
      const double turn = 2 * std::numbers::pi * k / corners;
      const glm::dvec2 p = centre + radius * (0.75 + 0.4 * rng.uniform()) * glm::dvec2{std::cos(turn), std::sin(turn)};
      fits = fits && isInside(outline, p) && p.x * centre.x > 0;
      spot.emplace_back(p);
    }
    if (!fits) continue;
    covered += std::numbers::pi * radius * radius;
    spots.push_back(std::move(spot));
  }
  return spots;
}

}  // namespace axil::organs
