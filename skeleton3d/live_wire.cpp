#include "skeleton3d/live_wire.hpp"

#include "skeleton3d/live_wire_prepared.hpp"
#include "skeleton3d/polyline.hpp"
#include "skeleton3d/ridge.hpp"
#include "skeleton3d/stem_line.hpp"

#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/segmentation.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace detail {

struct WireMap {
  LiveWire wire;
  cv::segmentation::IntelligentScissorsMB ways;
  glm::ivec2 cell{0, 0};  ///< where they begin
};

}  // namespace detail

namespace {

using detail::PreparedWire;
using detail::StemCell;
using detail::StemLine;
using detail::StemnessMap;

constexpr std::size_t kMostPlaces = 140;  ///< along a way; bounds the time of a step

glm::dvec2 acrossOf(glm::dvec2 along) { return {-along.y, along.x}; }

/// The cell on a stem that a click means: likely and near.
glm::ivec2 meantCell(const StemnessMap& stems, glm::dvec2 click, double reach_px) {
  const glm::ivec2 own = stems.cellOf(click), low = stems.cellOf(click - reach_px), high = stems.cellOf(click + reach_px);
  glm::ivec2 best = own;
  double most = 0.05;
  for (int row = low.y; row <= high.y; ++row)
    for (int column = low.x; column <= high.x; ++column) {
      const StemCell& cell = stems.at(column, row);
      const double away = glm::length(glm::dvec2(cell.at) - click) / (0.5 * reach_px);
      if (const double worth = stems.likeness(cell) * std::exp(-0.5 * away * away); worth > most) most = worth, best = {column, row};
    }
  return best;
}

/// Of a cell; what is faint costs less than nothing at all, what is clear less than what is faint. A clear stem costs something
/// too: from where a branch leaves the middle of its parent no stem is seen for half the parent's width, and going along the
/// parent and over some other branch must be dearer than that.
float costOf(const StemnessMap& stems, const StemCell& cell) {
  constexpr float kClear = 40, kOnStem = 0.2F;  // grey levels; share of what nothing costs
  const float clear = cell.strength * cell.strength / (cell.strength * cell.strength + kClear * kClear);
  return kOnStem + (1 - kOnStem) * (0.6F * (1 - stems.likeness(cell)) + 0.4F * (1 - clear));
}

/// Cells of stems that have been followed already: a little more than the stem, as its edges look like stems too.
cv::Mat takenCells(const StemnessMap& stems, std::span<const TakenSegment> taken) {
  cv::Mat cells(stems.rows, stems.columns, CV_8UC1, cv::Scalar(0));
  for (const auto& [from, to] : taken) {
    const glm::ivec2 a = stems.cellOf(from.px), b = stems.cellOf(to.px);
    const double width_px = 0.5 * (stems.at(a.x, a.y).width_px + stems.at(b.x, b.y).width_px);
    cv::line(cells, {a.x, a.y}, {b.x, b.y}, cv::Scalar(1), std::max(3, static_cast<int>(width_px / stems.cell_px) + 2));
  }
  return cells;
}

cv::segmentation::IntelligentScissorsMB scissorsOf(const StemnessMap& stems, std::span<const TakenSegment> taken) {
  constexpr float kTaken = 0.6F;  // share of what nothing costs
  const cv::Mat isTaken = takenCells(stems, taken);
  cv::Mat edge(stems.rows, stems.columns, CV_8UC1, cv::Scalar(0)), across(stems.rows, stems.columns, CV_32FC2), cost(stems.rows, stems.columns, CV_32FC1);
  for (int row = 0; row < stems.rows; ++row)
    for (int column = 0; column < stems.columns; ++column) {
      const StemCell& cell = stems.at(column, row);
      across.at<cv::Vec2f>(row, column) = {-cell.along.y, cell.along.x};
      const float own = costOf(stems, cell);
      cost.at<float>(row, column) = isTaken.at<std::uint8_t>(row, column) != 0 ? std::max(own, kTaken) : own;
    }
  cv::segmentation::IntelligentScissorsMB scissors;
  scissors.setWeights(0, 0.15F, 0.85F);
  scissors.applyImageFeatures(edge, across, cost);
  return scissors;
}

/// A place of the way as the cells know it.
struct RawPlace {
  glm::dvec2 at{0, 0};
  double width_px = 0;
};

std::vector<RawPlace> rawPlaces(const StemnessMap& stems, const std::vector<cv::Point>& cells) {
  std::vector<RawPlace> places;
  for (const cv::Point& p : cells) {
    const StemCell& cell = stems.at(p.x, p.y);
    const bool onStem = stems.likeness(cell) > 0.3F;
    places.push_back({onStem ? glm::dvec2(cell.at) : (glm::dvec2(p.x, p.y) + 0.5) * double(stems.cell_px), onStem ? cell.width_px : 0.0});
  }
  return places;
}

double medianWidth(const std::vector<RawPlace>& raw, std::size_t about) {
  std::vector<double> widths;
  for (std::size_t i = about < 5 ? 0 : about - 5; i <= std::min(about + 5, raw.size() - 1); ++i)
    if (raw[i].width_px > 0) widths.push_back(raw[i].width_px);
  if (widths.empty()) return 0;
  std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2), widths.end());
  return widths[widths.size() / 2];
}

/// The way with the cells' steps taken out.
struct CoarseWay {
  StemLine line;
  std::vector<double> width_px;
};

CoarseWay coarseWay(const std::vector<RawPlace>& raw, int cell_px) {
  CoarseWay way;
  std::vector<glm::dvec2> places;
  const std::size_t stride = std::max<std::size_t>(1, raw.size() / kMostPlaces);
  for (std::size_t i = 0; i < raw.size(); i += stride) {
    glm::dvec2 sum(0.0);
    double weights = 0;
    const double width = medianWidth(raw, i);
    const std::size_t reach = std::max<std::size_t>(3, static_cast<std::size_t>(0.4 * width / cell_px)), half = std::min({reach, i, raw.size() - 1 - i});
    for (std::size_t j = i - half; j <= i + half; ++j) {
      const double weight = raw[j].width_px > 0 ? 1 : 0.3;
      sum += weight * raw[j].at;
      weights += weight;
    }
    const glm::dvec2 at = sum / weights;
    if (!places.empty() && glm::length(at - places.back()) < std::max(1.0 * cell_px, 0.12 * width)) continue;
    places.push_back(at);
    way.width_px.push_back(width);
  }
  way.line = detail::lineThroughPlaces(std::move(places), {});
  return way;
}

struct Middle {
  double off_px = 0, width_px = 0, strength = 0;
};

/// The stem's two edges beside one place of the coarse way.
Middle middleAt(const Photo& photo, const StemLine& line, std::size_t i, double width, int cell_px) {
  const double reach = cell_px + 1.5 + 0.2 * width;
  const ProfileOptions options{.reach_px = 0.65 * width + reach + 2, .blur_px = std::clamp(0.1 * width, 1.0, 3.0), .along_px = 1};
  const RidgeProfile profile = profileAcross(photo, {}, line.at[i], acrossOf(line.along[i]), options);
  Middle best;
  double most = 0;
  const double step = std::max(kRidgeStep_px, 0.02 * width);  // a wide stem's edges are looked for as finely afterwards
  for (double middle = -reach; middle <= reach; middle += step)
    for (const double scale : {0.7, 0.85, 1.0, 1.2, 1.45}) {
      const double half = 0.5 * scale * width, strength = ridgeStrength(profile, middle - half, middle + half), away = middle / (1.5 * reach);
      if (const double worth = strength * std::exp(-0.5 * away * away); worth > most) most = worth, best = {middle, 2 * half, strength};
    }
  if (!(most > 0)) return {};
  const double sharp = std::min(1.5, 0.3 * best.width_px + 0.5);
  const double left = sharpened(profile, best.off_px - 0.5 * best.width_px, sharp), right = sharpened(profile, best.off_px + 0.5 * best.width_px, sharp);
  return {0.5 * (left + right), right - left, ridgeStrength(profile, left, right)};
}

/// Offsets and widths along the way as a smooth course: a line about each place, what disagrees left out (Tukey's weights).
Middle smoothedAt(const std::vector<Middle>& middles, const StemLine& line, std::size_t i, double reach_px, double usual) {
  double offset = 0, width = middles[i].width_px, confidence = 0, scatter = 1e9;
  for (int round = 0; round < 3; ++round) {
    double s0 = 0, s1 = 0, s2 = 0, y0 = 0, y1 = 0, w0 = 0, rest = 0, seen = 0;
    for (int side : {-1, 1})
      for (std::size_t j = i; j < middles.size() && std::abs(line.length_px[j] - line.length_px[i]) <= reach_px; side < 0 ? --j : ++j) {
        if (side > 0 && j == i) continue;
        const double x = line.length_px[j] - line.length_px[i], near = 1 - std::pow(x / (1.01 * reach_px), 2), s = middles[j].strength;
        const double likely = s * s / (s * s + usual * usual), r = (middles[j].off_px - offset) / scatter;
        const double weight = likely * near * (r * r < 1 ? std::pow(1 - r * r, 2) : 0) + 1e-9;
        s0 += weight, s1 += weight * x, s2 += weight * x * x, y0 += weight * middles[j].off_px, y1 += weight * x * middles[j].off_px;
        w0 += weight * middles[j].width_px;
        rest += weight * std::abs(middles[j].off_px - offset);
        confidence += round == 2 ? near * likely : 0;
        seen += near;
      }
    const double d = s0 * s2 - s1 * s1;
    offset = d > 1e-6 * s0 * s0 * reach_px * reach_px ? (s2 * y0 - s1 * y1) / d : y0 / s0;
    width = w0 / s0;
    scatter = std::max(round == 0 ? 4.0 : 4 * rest / s0, 1.0);
    if (round == 2) confidence /= seen;
  }
  return {offset, width, confidence};
}

std::vector<WireNode> refined(const PreparedWire& wire, const CoarseWay& way) {
  const StemLine& line = way.line;
  std::vector<Middle> middles;
  for (std::size_t i = 0; i < line.at.size(); ++i) middles.push_back(way.width_px[i] > 0 ? middleAt(*wire.photo, line, i, way.width_px[i], wire.stems.cell_px) : Middle{});
  std::vector<WireNode> places;
  for (std::size_t i = 0; i < line.at.size(); ++i) {
    const double reach = std::max({8.0, 2.5 * wire.stems.cell_px, 0.7 * way.width_px[i]});
    const Middle smooth = smoothedAt(middles, line, i, reach, wire.stems.usual);
    const double off = smooth.strength > 0.1 ? smooth.off_px : 0;
    places.push_back({{line.at[i] + off * acrossOf(line.along[i])}, smooth.strength > 0.1 ? smooth.width_px : 0, smooth.strength});
  }
  return places;
}

/// The place where the way should end, from a click near its end: beside the click on the stem's line, or the click itself
/// where there is no stem. `back` turns the way so that its last place is meant.
void endAt(std::vector<WireNode>& places, glm::dvec2 click, double reach_px) {
  const WireNode last = places.back();
  const double window = std::max(12.0, last.width_px);
  std::size_t before = places.size() - 1;
  while (before > 0 && glm::length(places[before].at.px - last.at.px) < window) --before;
  const glm::dvec2 chord = last.at.px - places[before].at.px;
  const glm::dvec2 along = glm::length(chord) > 1e-6 ? glm::normalize(chord) : glm::dvec2{0, 0};
  const glm::dvec2 foot = last.at.px + glm::dot(click - last.at.px, along) * along;
  const bool onStem = last.confidence > 0.3 && glm::length(click - foot) <= reach_px + 0.25 * last.width_px;
  while (places.size() > 1 && glm::dot(places.back().at.px - foot, along) >= 0) places.pop_back();
  places.push_back(onStem ? WireNode{{foot}, last.width_px, last.confidence} : WireNode{{click}, 0, 0});
}

void bothEndsAt(std::vector<WireNode>& places, glm::dvec2 from, glm::dvec2 to, double reach_px) {
  endAt(places, to, reach_px);
  std::reverse(places.begin(), places.end());
  endAt(places, from, reach_px);
  std::reverse(places.begin(), places.end());
}

double typicalConfidence(const std::vector<WireNode>& line) {
  std::vector<double> all;
  for (const WireNode& node : line) all.push_back(node.confidence);
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

WirePath pathOf(std::vector<WireNode> line, double tolerance_px) {
  WirePath path;
  path.line = std::move(line);
  std::vector<glm::dvec2> places;
  for (const WireNode& node : path.line) places.push_back(node.at.px);
  for (const std::size_t i : detail::fewWithin(places, std::max(tolerance_px, 0.0))) path.nodes.push_back(path.line[i]);
  path.confidence = typicalConfidence(path.line);
  return path;
}

bool isInside(const Photo& photo, glm::dvec2 px) { return px.x >= 0 && px.y >= 0 && px.x <= photo.width && px.y <= photo.height; }

}  // namespace

std::vector<WireNode> detail::refinedAlong(const PreparedWire& wire, const std::vector<glm::dvec2>& places, const std::vector<double>& widths_px) {
  return refined(wire, {lineThroughPlaces(places, {}), widths_px});
}

Result<LiveWire> prepareLiveWire(std::shared_ptr<const Photo> photo, const Watch& watch) {
  if (!photo || photo->rgb.size() != std::size_t{3} * static_cast<std::size_t>(photo->width) * static_cast<std::size_t>(photo->height))
    return fail(ErrorCode::BadInput, "a photo without its pixels shows no stem");
  try {
    auto stems = detail::stemnessOf(*photo, watch);
    if (!stems) return stems.failure();
    return LiveWire(std::make_shared<const PreparedWire>(PreparedWire{std::move(photo), *std::move(stems)}));
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "no stems could be looked for in the photo: " + e.err);
  }
}

Result<WireStart> startWire(const LiveWire& wire, PhotoPoint from, std::span<const TakenSegment> taken) {
  const PreparedWire& prepared = wire.prepared();
  if (!isInside(*prepared.photo, from.px)) return fail(ErrorCode::BadInput, "a way along a stem must begin inside the photo");
  try {
    const auto map = std::make_shared<detail::WireMap>(detail::WireMap{wire, scissorsOf(prepared.stems, taken), meantCell(prepared.stems, from.px, WireOptions{}.reach_px)});
    map->ways.buildMap({map->cell.x, map->cell.y});
    return WireStart(from, map);
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "no way along the stem could be found: " + e.err);
  }
}

WirePath wireTo(const WireStart& start, PhotoPoint to, const WireOptions& options) {
  const PreparedWire& wire = start.map().wire.prepared();
  if (!std::isfinite(to.px.x) || !std::isfinite(to.px.y)) to = start.from();
  to.px = glm::clamp(to.px, glm::dvec2(0.0), glm::dvec2(wire.photo->width, wire.photo->height));
  const glm::ivec2 target = meantCell(wire.stems, to.px, options.reach_px);
  std::vector<cv::Point> cells;
  start.map().ways.getContour({target.x, target.y}, cells);
  const std::vector<RawPlace> raw = rawPlaces(wire.stems, cells);
  if (raw.size() < 4) return pathOf({{start.from(), 0, 0}, {to, 0, 0}}, options.tolerance_px);
  std::vector<WireNode> line = refined(wire, coarseWay(raw, wire.stems.cell_px));
  bothEndsAt(line, start.from().px, to.px, options.reach_px);
  return pathOf(std::move(line), options.tolerance_px);
}

Result<WirePath> wireBetween(const LiveWire& wire, PhotoPoint from, PhotoPoint to, const WireOptions& options) {
  const auto start = startWire(wire, from);
  if (!start) return start.failure();
  if (!isInside(*wire.prepared().photo, to.px)) return fail(ErrorCode::BadInput, "a way along a stem must end inside the photo");
  return wireTo(*start, to, options);
}

}  // namespace axil::skeleton3d
