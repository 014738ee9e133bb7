#include "skeleton3d/stem_evidence.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/stem_colour.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

constexpr std::size_t kBins = 8;
constexpr double kMostTold = 3;   // of one photo: a stem may be hidden, and another one may be there by chance
constexpr double kStep_px = 12;   // between the places along stems that are learned from

std::size_t cellNumber(const StemnessMap& stems, int column, int row) { return static_cast<std::size_t>(row) * static_cast<std::size_t>(stems.columns) + static_cast<std::size_t>(column); }

/// Squared distance of `px` from the ridge of a cell, its inner half not counted: a person aims at the stem, not at a line.
double besideRidge2(const StemCell& cell, glm::dvec2 px) {
  const glm::dvec2 off = px - glm::dvec2(cell.at), along(cell.along);
  const double across = std::max(std::abs(off.x * along.y - off.y * along.x) - 0.25 * cell.width_px, 0.0), ahead = std::max(std::abs(glm::dot(off, along)) - 0.5 * cell.width_px, 0.0);
  return across * across + ahead * ahead;
}

/// 0 to 1: how much the best ridge near `px` looks like the stem that runs along `along` (zero: any way).
double likenessAt(const SeenStems& seen, glm::dvec2 px, glm::dvec2 along) {
  constexpr double kWidest_px = 30, kFurthest = 2;  // times the reach
  const double reach = kFurthest * seen.reach_px + 0.5 * kWidest_px, length2 = glm::dot(along, along);
  const glm::ivec2 low = seen.stems.cellOf(px - reach), high = seen.stems.cellOf(px + reach);
  double best = 0;
  for (int row = low.y; row <= high.y; ++row)
    for (int column = low.x; column <= high.x; ++column) {
      const std::size_t i = cellNumber(seen.stems, column, row);
      if (seen.worth[i] <= best) continue;
      const StemCell& cell = seen.stems.cells[i];
      const double off2 = besideRidge2(cell, px) / (seen.reach_px * seen.reach_px);
      if (off2 > kFurthest * kFurthest) continue;
      const double ahead = glm::dot(glm::dvec2(cell.along), along), alike = length2 > 0 ? ahead * ahead / length2 : 1;
      best = std::max(best, seen.worth[i] * (0.2 + 0.8 * alike) * std::exp(-0.5 * off2));
    }
  return best;
}

std::size_t binOf(double likeness) { return std::min(static_cast<std::size_t>(likeness * kBins), kBins - 1); }

/// A place on a stem as one photo shows it.
struct OnStem {
  glm::dvec2 px{0, 0}, along{0, 0};
};

std::vector<OnStem> placesOnStems(const Camera& camera, const std::map<NodeId, glm::dvec3>& places, std::span<const ClickedStem> stems) {
  std::vector<OnStem> on;
  for (const ClickedStem& stem : stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const auto a = places.find(stem.nodes[i - 1]), b = places.find(stem.nodes[i]);
      if (a == places.end() || b == places.end() || !isInFront(camera, {a->second}) || !isInFront(camera, {b->second})) continue;
      const glm::dvec2 from = project(camera, {a->second}).px, to = project(camera, {b->second}).px;
      const int steps = std::clamp(static_cast<int>(glm::length(to - from) / kStep_px), 1, 40);
      for (int k = 1; k <= steps; ++k) on.push_back({glm::mix(from, to, static_cast<double>(k) / steps), to - from});
    }
  return on;
}

/// The stems' own colours, from the ridges beside places that are on stems.
StemLikelihood coloursOf(const Photo& photo, const SeenStems& seen, const std::vector<OnStem>& on) {
  std::vector<EdgePair> edges;
  for (const OnStem& place : on) {
    const StemCell* best = nullptr;
    const glm::ivec2 low = seen.stems.cellOf(place.px - seen.reach_px), high = seen.stems.cellOf(place.px + seen.reach_px);
    for (int row = low.y; row <= high.y; ++row)
      for (int column = low.x; column <= high.x; ++column)
        if (const StemCell& cell = seen.stems.at(column, row); cell.strength > 0 && (best == nullptr || cell.strength > best->strength)) best = &cell;
    if (best == nullptr) continue;
    const glm::dvec2 half = 0.5 * static_cast<double>(best->width_px) * glm::dvec2{-best->along.y, best->along.x};
    edges.push_back({glm::dvec2(best->at) - half, glm::dvec2(best->at) + half, best->strength});
  }
  return likelihoodOf(photo, std::span(&edges, 1));
}

std::vector<float> worthOf(const StemnessMap& stems, const StemLikelihood& colour, const Photo& photo) {
  std::vector<float> worth;
  for (const StemCell& cell : stems.cells) {
    const auto x = static_cast<std::size_t>(std::clamp(cell.at.x, 0.0F, static_cast<float>(photo.width - 1))), y = static_cast<std::size_t>(std::clamp(cell.at.y, 0.0F, static_cast<float>(photo.height - 1)));
    const float coloured = colour.empty() ? 1.0F : static_cast<float>(colour[y * static_cast<std::size_t>(photo.width) + x]) / 255.0F;
    worth.push_back(cell.strength > 0 ? stems.likeness(cell) * coloured : 0.0F);
  }
  return worth;
}

/// So many of them, evenly.
std::vector<OnStem> thinned(std::vector<OnStem> places) {
  constexpr std::size_t kMost = 300;
  std::vector<OnStem> kept;
  for (std::size_t i = 0; i < std::min(places.size(), kMost); ++i) kept.push_back(places[i * places.size() / std::min(places.size(), kMost)]);
  return kept;
}

/// Beside the stems as a wrong click is: some way off, to all sides.
std::vector<OnStem> besideStems(const std::vector<OnStem>& on, glm::dvec2 size) {
  constexpr std::array<double, 3> kAway{0.015, 0.03, 0.05};  // of the photo's longer side
  std::vector<OnStem> beside;
  for (std::size_t i = 0; i < on.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      const double turn = 1.5708 * k + 0.7 * static_cast<double>(i), away = kAway[(i + static_cast<std::size_t>(k)) % kAway.size()] * std::max(size.x, size.y);
      const glm::dvec2 px = on[i].px + away * glm::dvec2{std::cos(turn), std::sin(turn)};
      if (px.x >= 0 && px.y >= 0 && px.x < size.x && px.y < size.y) beside.push_back({px, on[i].along});
    }
  return beside;
}

std::vector<double> sharesOf(const SeenStems& seen, const std::vector<OnStem>& places) {
  constexpr double kEach = 1;  // so much of every likeness may be without having been seen
  std::vector<double> shares(kBins, kEach);
  for (const OnStem& place : places) ++shares[binOf(likenessAt(seen, place.px, place.along))];
  for (double& share : shares) share /= static_cast<double>(places.size()) + kEach * kBins;
  return shares;
}

}  // namespace

StemEvidence learnedEvidence(const Photos& photos, std::span<const View> views, const std::map<NodeId, glm::dvec3>& places, std::span<const ClickedStem> stems, double click_px) {
  constexpr std::size_t kFewest = 20;
  StemEvidence evidence;
  for (const View& view : views) {
    const auto photo = photos.find(view.name);
    if (photo == photos.end()) continue;
    const std::vector<OnStem> on = thinned(placesOnStems(view.camera, places, stems));
    if (on.size() < kFewest) continue;
    auto map = stemnessOf(photo->second, {});
    if (!map) continue;
    SeenStems seen{*std::move(map), {}, std::max(2 * click_px, 4.0), {}};
    seen.worth = worthOf(seen.stems, coloursOf(photo->second, seen, on), photo->second);
    const std::vector<double> with = sharesOf(seen, on), without = sharesOf(seen, besideStems(on, {photo->second.width, photo->second.height}));
    for (std::size_t i = 0; i < kBins; ++i) seen.ratio.push_back(std::clamp(std::log(with[i] / without[i]), -kMostTold, kMostTold));
    evidence.views.emplace(view.name, std::move(seen));
  }
  return evidence;
}

double evidenceAt(const StemEvidence& evidence, std::span<const View> views, const glm::dvec3& at, const glm::dvec3& run) {
  constexpr double kShort = 1e-3;
  double sum = 0;
  for (const View& view : views) {
    const auto seen = evidence.views.find(view.name);
    if (seen == evidence.views.end() || !isInFront(view.camera, {at})) continue;
    const glm::dvec2 px = project(view.camera, {at}).px;
    if (!(px.x >= 0 && px.y >= 0 && px.x < view.size_px.x && px.y < view.size_px.y)) {
      sum -= kMostTold;
      continue;
    }
    const glm::dvec3 ahead = at + kShort * run;
    const glm::dvec2 along = isInFront(view.camera, {ahead}) ? project(view.camera, {ahead}).px - px : glm::dvec2{0, 0};
    sum += seen->second.ratio[binOf(likenessAt(seen->second, px, along))];
  }
  return sum;
}

}  // namespace axil::skeleton3d::detail
