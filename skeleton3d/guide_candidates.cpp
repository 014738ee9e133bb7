#include "skeleton3d/guide_candidates.hpp"

#include "skeleton3d/live_wire_prepared.hpp"
#include "skeleton3d/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

using detail::StemCell;
using detail::StemnessMap;

constexpr float kLeastLikeness = 0.3F;

/// The cells under the guide's band, each once, in the order of their numbers.
std::vector<std::size_t> cellsUnder(const Guide& guide, const StemnessMap& stems) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i + 1 < guide.curve.size(); ++i) {
    const GuidePoint &a = guide.curve[i], &b = guide.curve[i + 1];
    const double length = glm::length(b.at.px - a.at.px), half = std::min(std::max(2 * a.sigma_px, 1.0 * stems.cell_px), 40.0);
    const int steps = std::max(1, static_cast<int>(length / stems.cell_px));
    const glm::dvec2 across = length > 0 ? glm::dvec2{-(b.at.px - a.at.px).y, (b.at.px - a.at.px).x} / length : glm::dvec2{0, 1};
    for (int k = 0; k <= steps; ++k)
      for (double off = -half; off <= half; off += stems.cell_px) {
        const glm::ivec2 cell = stems.cellOf(glm::mix(a.at.px, b.at.px, static_cast<double>(k) / steps) + off * across);
        cells.push_back(static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(stems.columns) + static_cast<std::size_t>(cell.x));
      }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// Where the cell's ridge crosses the guide, or the ridge's own place where the two run alongside.
glm::dvec2 crossingOf(const StemCell& cell, const Guide& guide, double furthest_px) {
  const glm::dvec2 at(cell.at), along(cell.along);
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < guide.curve.size(); ++i)
    if (const double off = detail::distanceToPiece(at, guide.curve[i].at.px, guide.curve[i + 1].at.px); off < least) least = off, nearest = i;
  const glm::dvec2 piece = guide.curve[nearest + 1].at.px - guide.curve[nearest].at.px;
  const double length = glm::length(piece);
  if (!(length > 0)) return at;
  const glm::dvec2 across{-piece.y / length, piece.x / length};
  const double crossing = glm::dot(along, across), off = glm::dot(guide.curve[nearest].at.px - at, across);
  if (std::abs(crossing) < 0.2 || std::abs(off / crossing) > furthest_px) return at;
  return at + off / crossing * along;
}

}  // namespace

std::vector<GuideCandidate> candidatesAlong(const Guide& guide, const LiveWire& otherPhoto, std::size_t most) {
  if (guide.curve.size() < 2) return {};
  const StemnessMap& stems = otherPhoto.prepared().stems;
  std::vector<GuideCandidate> all;
  for (const std::size_t i : cellsUnder(guide, stems)) {
    const StemCell& cell = stems.cells[i];
    if (stems.likeness(cell) < kLeastLikeness) continue;
    const double furthest = 3 * stems.cell_px + 0.5 * cell.width_px + 4 * guide.curve.front().sigma_px;
    all.push_back({{crossingOf(cell, guide, furthest)}, cell.width_px, Angle::fromRadians(std::atan2(cell.along.y, cell.along.x)), stems.likeness(cell)});
  }
  std::stable_sort(all.begin(), all.end(), [](const GuideCandidate& a, const GuideCandidate& b) { return a.strength > b.strength; });
  std::vector<GuideCandidate> apart;
  for (const GuideCandidate& candidate : all) {
    const bool same = std::any_of(apart.begin(), apart.end(), [&](const GuideCandidate& c) {
      return glm::length(c.at.px - candidate.at.px) < std::max({0.6 * *c.width_px, 1.5 * stems.cell_px, 3.0});
    });
    if (!same) apart.push_back(candidate);
    if (apart.size() >= most) break;
  }
  return apart;
}

Result<std::vector<ProposedPlace>> proposedPlaces(const View& clicked, PhotoPoint click, const View& other, const LiveWire& otherPhoto, const Reach& reach,
                                                  const GuideExpectation& expected, double click_px, double camera_px) {
  const auto guide = guideBetween(clicked, click, other, reach, click_px, camera_px);
  if (!guide) return guide.failure();
  const std::vector<GuideCandidate> candidates = candidatesAlong(*guide, otherPhoto);
  std::vector<ProposedPlace> places;
  for (const RankedCandidate& rank : rankCandidates(clicked, click, other, *guide, candidates, expected)) places.push_back({candidates[rank.candidate], rank});
  return places;
}

}  // namespace axil::skeleton3d
