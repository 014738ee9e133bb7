#include "organs/leaf_rulings.hpp"

#include "organs/flat_shapes.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace axil::organs {

namespace {

using Half = std::vector<Ruling>;
constexpr double pi = std::numbers::pi;
constexpr int samplesAnEnd = 320;  // dense enough that the chosen rulings meet the tips of lobes and teeth
constexpr double veinSlope = 0.6;  // rise of a side vein over its run, where nothing else fixes it

// A narrow tip stands upon the body like a nail; the two flow into each other.
double tailedWidth(const LeafShape& shape, double y) {
  const double bodyEnd = 1 - shape.tailLength;
  const double body = y < bodyEnd ? endWidth(shape.apex, (bodyEnd - y) / (bodyEnd - shape.widest * bodyEnd)) : 0;
  const double tail = shape.tailWidth * std::pow(std::min(1.0, (1 - y) / (1.3 * shape.tailLength)), 0.8);
  return std::cbrt(body * body * body + tail * tail * tail);
}

// Width of the unlobed half, about 0 to 1.
double plainWidth(const LeafShape& shape, double y) {
  const double widest = shape.widest * (1 - shape.tailLength);
  if (y < widest) return endWidth(shape.base, y / widest);
  return shape.tailLength > 0 ? tailedWidth(shape, y) : endWidth(shape.apex, (1 - y) / (1 - shape.widest));
}

// Ears stand out sideways at the base and fall off quickly; the body keeps what is left of the width.
double earedWidth(const LeafShape& shape, double y) {
  constexpr double earHeight = 0.34;
  const double ear = y < earHeight ? std::pow(1 - y / earHeight, 1.25) : 0;
  return std::max((1 - shape.baseLobeDepth) * plainWidth(shape, y), ear);
}

// Two small round ears beside the petiole, below a body that narrows towards it.
constexpr double auricleWidth = 0.42;
constexpr double auricleHeight = 0.15;
double auricledWidth(const LeafShape& shape, double y) {
  const double ear = y < auricleHeight ? auricleWidth * std::sqrt(std::sin(pi * y / auricleHeight)) : 0;
  return std::max(plainWidth(shape, y), ear);
}

// 1 on a lobe, 1 - depth in a sinus; sinuses narrower than lobes, the more so the rounder the lobes end. The terminal lobe begins
// with a sinus and then swells.
double lobeFactor(const LeafShape& shape, double y) {
  if (shape.lobes != LeafLobes::Pinnate) return 1;
  const double period = shape.lobedUpTo / shape.lobeCount;
  if (y > shape.lobedUpTo + 0.5 * period) return 1;
  const double sinus = 0.5 + 0.5 * std::cos(2 * pi * y / period);
  const double atBase = y < 0.5 * period ? 0.6 : 1;  // the lowest lobes run down the midrib
  return 1 - shape.lobeDepth * atBase * std::pow(sinus, 2.75 / shape.lobeTip);
}

double widthAt(const LeafShape& shape, double y) {
  const double width = shape.baseLobes == BaseLobes::Ears       ? earedWidth(shape, y)
                       : shape.baseLobes == BaseLobes::Auricles ? auricledWidth(shape, y)
                                                                : plainWidth(shape, y);
  return width * lobeFactor(shape, y);
}

// Heights from 0 to 1, dense towards both ends, at the widest place and where a tail begins: where a margin turns fastest.
std::vector<double> sampleHeights(const LeafShape& shape) {
  const double bodyEnd = 1 - shape.tailLength;
  const double widest = shape.widest * bodyEnd;
  std::vector<double> heights;
  for (int i = 0; i <= samplesAnEnd; ++i) heights.push_back(widest * (1 - std::cos(0.5 * pi * i / samplesAnEnd)));
  for (int i = 1; i <= samplesAnEnd; ++i) heights.push_back(widest + (bodyEnd - widest) * std::sin(0.5 * pi * i / samplesAnEnd));
  if (shape.tailLength > 0)
    for (int i = 1; i <= samplesAnEnd / 4; ++i) heights.push_back(bodyEnd + shape.tailLength * std::sin(2 * pi * i / samplesAnEnd));
  heights.back() = 1;
  return heights;
}

void scaleToWidth(Half& half, double halfWidth) {
  double widest = 0;
  for (const Ruling& r : half) widest = std::max(widest, r.margin.x);
  for (Ruling& r : half) r.margin.x *= halfWidth / widest;
}

// Basal lobes and an apical notch: each vertical line is carried down (up) by less the farther from the end, so points keep their
// order along it and the margin can't come to cross itself.
double pulledHeight(const LeafShape& shape, double x, double y) {
  const double s = std::clamp(x / (0.5 * shape.widthToLength), 0.0, 1.0);
  const auto fade = [](double h) { return h < 0.6 ? (1 - h / 0.6) * (1 - h / 0.6) : 0; };
  double height = y;
  switch (shape.baseLobes) {
    case BaseLobes::None:
    case BaseLobes::Ears: break;
    case BaseLobes::Round: height -= shape.baseLobeDepth * std::sin(pi * s) * fade(y); break;
    case BaseLobes::Pointed: height -= shape.baseLobeDepth * s * fade(y); break;
    case BaseLobes::Auricles: height -= shape.baseLobeDepth * (s < auricleWidth ? std::sin(pi * s / auricleWidth) : 0) * fade(y); break;
  }
  if (shape.apexNotch > 0) height += shape.apexNotch * std::sin(pi * std::pow(s, 0.8)) * fade(1 - y);
  return height;
}

void setFeet(Half& half, double slope) {
  double last = 0;
  for (Ruling& r : half) r.foot = last = std::max(last, std::clamp(r.margin.y - slope * r.margin.x, 0.0, 1.0));
  half.back().foot = 1;
}

// Drawn upright as the width over the midrib, then carried to its place: lobes lean, the ends are pulled.
Half pinnate(const LeafShape& shape) {
  Half half;
  for (const double y : sampleHeights(shape)) half.push_back({y, {widthAt(shape, y), y}});
  scaleToWidth(half, 0.5 * shape.widthToLength);
  const double lean = shape.lobes == LeafLobes::Pinnate ? shape.lobeLean : 0;
  for (Ruling& r : half) {
    const double y = r.margin.y;
    r.margin.y = pulledHeight(shape, r.margin.x, y) + lean * r.margin.x * (1 - y);
    r.margin.y = -shape.shield + (1 + shape.shield) * r.margin.y;
  }
  if (shape.lobes == LeafLobes::None || shape.shield > 0) setFeet(half, veinSlope);
  return half;
}

int lobesASide(const LeafShape& shape) { return std::max(1, (shape.lobeCount - 1) / 2); }

// Radius of a palmate blade at `theta` from the apex. Lobes stand evenly from the apex to `reach` on each side, the outer
// ones shorter; behind the last lobe the margin runs in to the petiole.
double palmateRadius(const LeafShape& shape, double theta, double reach) {
  const int side = lobesASide(shape);
  const double spacing = reach / side;
  const double at = theta / spacing;
  const double nearest = std::min(std::round(at), static_cast<double>(side));
  const double u = std::min(1.0, 2 * std::abs(at - nearest));
  const auto length = [&](double lobe) { return 1 - 0.5 * std::pow(lobe / side, 1.6); };
  const double between = at > side ? side : (std::floor(at) + 0.5);
  const double sinus = (1 - shape.lobeDepth) * length(between);
  return sinus + (length(nearest) - sinus) * std::pow(1 - u, shape.lobeTip);
}

Half palmate(const LeafShape& shape) {
  Half half;
  const int side = lobesASide(shape);
  const double reach = pi * 0.80 * side / (side + 0.5);
  const double begin = reach + 0.5 * reach / side;
  for (int i = 0; i <= 2 * samplesAnEnd; ++i) {
    const double theta = begin * (1 - i / (2.0 * samplesAnEnd));
    const double radius = palmateRadius(shape, theta, reach);
    half.push_back({0, {radius * std::sin(theta), radius * std::cos(theta)}});
  }
  half.back().margin = {0, 1};
  scaleToWidth(half, 0.5 * shape.widthToLength);
  return half;
}

Half wholeMargin(const LeafShape& shape) { return shape.lobes == LeafLobes::Palmate ? palmate(shape) : pinnate(shape); }

double serrateTooth(double phase) { return phase < 0.75 ? phase / 0.75 : (1 - phase) / 0.25; }

// How far a tooth stands out at `phase` of its period, 0 to 1. A serrate tooth rises slowly and falls off at its front.
double toothAt(LeafMargin margin, double phase) {
  switch (margin) {
    case LeafMargin::Entire:
    case LeafMargin::Ciliate: return 0;
    case LeafMargin::Serrate: return serrateTooth(phase);
    case LeafMargin::DoublySerrate: return 0.72 * serrateTooth(phase) + 0.28 * serrateTooth(std::fmod(3 * phase, 1.0));
    case LeafMargin::Dentate: return 1 - std::abs(2 * phase - 1);
    case LeafMargin::Crenate: return std::pow(std::sin(pi * phase), 0.6);
    case LeafMargin::Undulate:
    case LeafMargin::Sinuate: return 0.5 - 0.5 * std::cos(2 * pi * phase);
    case LeafMargin::Spinose: return std::pow(1 - std::abs(2 * phase - 1), 2.6);
  }
  return 0;
}

std::vector<double> lengthsAlong(const Half& half) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < half.size(); ++i) lengths.push_back(lengths.back() + glm::distance(half[i - 1].margin, half[i].margin));
  return lengths;
}

// Teeth start a little above the base and end before the tip, so that both stay where they are. They stand out along the
// rulings, as side veins run into them.
Half toothed(const Half& smooth, const LeafShape& shape) {
  if (shape.teeth == 0 || shape.toothDepth <= 0) return smooth;
  const std::vector<double> lengths = lengthsAlong(smooth);
  const double from = 0.10 * lengths.back();
  const double to = 0.96 * lengths.back();
  Half half = smooth;
  for (std::size_t i = 0; i < half.size(); ++i) {
    if (lengths[i] <= from || lengths[i] >= to) continue;
    const double at = (lengths[i] - from) / (to - from);
    const glm::dvec2 vein = smooth[i].margin - glm::dvec2{0, smooth[i].foot};
    if (glm::length(vein) < 1e-9) continue;
    const double depth = std::min(shape.toothDepth * (1.2 - 0.5 * at), 0.4 * glm::length(vein));
    half[i].margin += glm::normalize(vein) * (depth * toothAt(shape.margin, std::fmod(at * shape.teeth, 1.0)));
  }
  return half;
}

struct Farthest {
  std::size_t index = 0;
  double score = 0;
};

// The sample between `a` and `b` that lies farthest from their chord; long chords count too, so that rulings stay even.
Farthest farthestBetween(const Half& half, std::size_t a, std::size_t b) {
  const glm::dvec2 p = half[a].margin;
  const glm::dvec2 chord = half[b].margin - p;
  const double length = std::max(glm::length(chord), 1e-12);
  Farthest farthest{(a + b) / 2, -1};
  for (std::size_t i = a + 1; i < b; ++i) {
    const glm::dvec2 d = half[i].margin - p;
    const double off = std::abs(chord.x * d.y - chord.y * d.x) / length;
    if (off > farthest.score) farthest = {i, off};
  }
  if (farthest.score < 0.01 * length) farthest.index = (a + b) / 2;
  farthest.score += 0.04 * length;
  return farthest;
}

// Greedy: the place that misses the margin most gets the next ruling.
std::vector<std::size_t> chooseRulings(const Half& half, std::size_t count) {
  std::vector<std::size_t> chosen{0, half.size() - 1};
  std::vector<Farthest> gaps{farthestBetween(half, 0, half.size() - 1)};
  while (chosen.size() < count) {
    const auto worst = std::max_element(gaps.begin(), gaps.end(), [](const Farthest& a, const Farthest& b) { return a.score < b.score; });
    if (worst->score <= 0) break;
    const std::size_t gap = static_cast<std::size_t>(worst - gaps.begin());
    const std::size_t at = worst->index;
    const std::size_t before = chosen[gap];
    const std::size_t after = chosen[gap + 1];
    chosen.insert(chosen.begin() + static_cast<std::ptrdiff_t>(gap) + 1, at);
    const auto score = [&](std::size_t a, std::size_t b) { return b - a < 2 ? Farthest{a, 0} : farthestBetween(half, a, b); };
    gaps[gap] = score(before, at);
    gaps.insert(gaps.begin() + static_cast<std::ptrdiff_t>(gap) + 1, score(at, after));
  }
  return chosen;
}

// A half that ends in a point ends in a ruling of no length; where its neighbour starts from the same foot, that neighbour is
// already the edge of the half, and a strip between the two would have no area.
Half withoutEmptyEnds(Half half) {
  const auto isEmpty = [](const Ruling& r) { return glm::distance(r.margin, {0, r.foot}) < 1e-9; };
  if (isEmpty(half.front()) && half[1].foot - half.front().foot < 1e-9) half.erase(half.begin());
  if (isEmpty(half.back()) && half.back().foot - half[half.size() - 2].foot < 1e-9) half.pop_back();
  return half;
}

bool isClean(const Half& half) {
  std::vector<glm::dvec2> margin;
  for (const Ruling& r : half) margin.push_back(r.margin);
  return isSimpleLine(margin) && std::all_of(margin.begin(), margin.end(), [](const glm::dvec2& p) { return p.x >= 0; });
}

Half chosenRulings(const LeafShape& shape, std::size_t count) {
  const Half half = toothed(wholeMargin(shape), shape);
  Half rulings;
  for (const std::size_t i : chooseRulings(half, std::max<std::size_t>(count, 4))) rulings.push_back(half[i]);
  return withoutEmptyEnds(std::move(rulings));
}

}  // namespace

double endWidth(const LeafEnd& end, double u) {
  const double inner = 1 - std::pow(1 - std::clamp(u, 0.0, 1.0), end.shoulder);
  return end.end <= 0 ? 1 : std::pow(inner, end.end);
}

std::vector<Ruling> leftOf(std::vector<Ruling> right, const LeafShape& shape) {
  for (Ruling& r : right) {
    r.margin.x *= 1 - shape.oblique;
    // The narrower half also begins higher, as an oblique base does.
    if (r.foot < 0.5 && r.margin.x > 0) r.margin.y += 0.35 * shape.oblique * r.margin.x * (1 - 2 * r.foot);
  }
  return right;
}

std::vector<Ruling> rulingsOf(const LeafShape& shape, std::size_t count) {
  LeafShape tamer = shape;
  for (int attempt = 0; attempt < 6; ++attempt) {
    Half rulings = chosenRulings(tamer, count);
    if (isClean(rulings) && isClean(leftOf(rulings, tamer))) return rulings;
    tamer.toothDepth *= 0.5;
    if (attempt > 1) tamer.lobeDepth *= 0.7;
  }
  tamer.teeth = 0;
  tamer.lobes = LeafLobes::None;
  return chosenRulings(tamer, count);
}

}  // namespace axil::organs
