#include "skeleton3d/snap.hpp"
#include "skeleton3d/snap_tip.hpp"
#include "skeleton3d/stem_colour.hpp"
#include "skeleton3d/stem_path.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace axil::skeleton3d {
namespace {

constexpr double kStep_px = 2;

/// One stem as it is clicked in one photo.
struct SeenStem {
  std::vector<NodeId> nodes;
  std::vector<glm::dvec2> clicks;
  std::vector<bool> own;  ///< a stem's first node belongs to its parent, so its line is not this stem's to find
  bool endsIn = false;    ///< its last node is seen, and nothing goes on from there
  bool beginsIn = false;  ///< its first node is seen, and belongs to nothing else: the collar
  detail::StemLine line;
  detail::Expected expected;
};

using Expectations = std::map<NodeId, ExpectedRidge>;

/// Widths at the places of a line, between those expected at its nodes; the first node is the parent's and so not asked.
detail::Expected expectedAlong(const SeenStem& stem, const Expectations& expected) {
  std::vector<std::pair<double, double>> known;  // length, width
  for (std::size_t i = 0; i < stem.nodes.size(); ++i)
    if (const auto found = expected.find(stem.nodes[i]); stem.own[i] && found != expected.end() && found->second.width_px > 0)
      known.push_back({stem.line.length_px[stem.line.placeOf[i]], found->second.width_px});
  detail::Expected result;
  if (known.empty()) return result;
  for (const double length : stem.line.length_px) {
    std::size_t i = 0;
    while (i + 1 < known.size() && known[i + 1].first < length) ++i;
    const std::size_t j = std::min(i + 1, known.size() - 1);
    const double span = known[j].first - known[i].first, f = span > 0 ? std::clamp((length - known[i].first) / span, 0.0, 1.0) : 0;
    result.width_px.push_back(known[i].second * (1 - f) + known[j].second * f);
  }
  return result;
}

std::vector<SeenStem> seenStems(const std::string& view, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems, double click_px,
                                const Expectations& expected) {
  std::map<NodeId, glm::dvec2> clicks;
  for (const ClickedNode& node : nodes)
    if (const auto found = node.clicks.find(view); found != node.clicks.end()) clicks[node.id] = found->second.px;
  std::map<NodeId, int> owners;
  for (const ClickedStem& stem : stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) ++owners[stem.nodes[i]];
  std::map<NodeId, int> begins;
  for (const ClickedStem& stem : stems)
    if (!stem.nodes.empty()) ++begins[stem.nodes.front()];
  std::vector<SeenStem> seen;
  for (const ClickedStem& stem : stems) {
    SeenStem s;
    std::vector<glm::dvec2> course;
    for (std::size_t i = 0; i < stem.nodes.size(); ++i) {
      const auto found = clicks.find(stem.nodes[i]);
      if (found == clicks.end()) continue;
      s.nodes.push_back(stem.nodes[i]);
      s.clicks.push_back(found->second);
      s.own.push_back(i > 0 || !owners.contains(stem.nodes[i]));
      const auto better = expected.find(stem.nodes[i]);
      course.push_back(better == expected.end() ? found->second : better->second.at);
    }
    s.endsIn = !s.nodes.empty() && s.nodes.back() == stem.nodes.back() && !begins.contains(stem.nodes.back()) && owners[stem.nodes.back()] == 1;
    s.beginsIn = !s.nodes.empty() && s.nodes.front() == stem.nodes.front() && begins.at(stem.nodes.front()) == 1 && !owners.contains(stem.nodes.front());
    s.line = detail::stemLine(course, expected.empty() ? click_px : 0.4 * click_px, kStep_px);
    if (s.line.at.empty()) continue;
    s.expected = expectedAlong(s, expected);
    seen.push_back(std::move(s));
  }
  return seen;
}

/// How far beyond its last node a stem is seen to end, and how much that varies, in widths. A blunt tip, cut or rounded, is seen
/// by anything up to half its width further; at the collar the ground ends the stem, and seen from a little above its near rim is lower.
struct StemEnd {
  double beyond = 0, scatter = 0;
};
constexpr StemEnd kTip{0.25, 0.12}, kCollar{0.06, 0.1};

/// Where the stem is seen to end near its last click, or near its first: how far from `reading.at`, and in which direction.
struct SeenEnd {
  double beyond_px = 0;
  glm::dvec2 out{1, 0};
};

std::optional<SeenEnd> seenEnd(const Photo& photo, const SeenStem& stem, std::size_t i, const SnapOptions& options, const RidgeReading& reading) {
  const glm::dvec2 along{std::cos(reading.along.radians()), std::sin(reading.along.radians())};
  const glm::dvec2 course = stem.clicks[i] - stem.clicks[i > 0 ? i - 1 : 1], out = glm::dot(course, along) < 0 ? -along : along;
  const auto beyond = detail::tipBeyond(photo, reading, out, std::min(3 * options.click_px, 0.5 * glm::length(course)));
  return beyond ? std::optional(SeenEnd{*beyond, out}) : std::nullopt;
}

/// The places of the stem's line that are well inside it, where it ends as seen near its last click or its first.
detail::PlaceRange insideOf(const SeenStem& stem, std::size_t i, const SeenEnd& end, const RidgeReading& reading) {
  constexpr double kRounded = 0.5;  // of the width
  const glm::dvec2 at = reading.at.px + (end.beyond_px - kRounded * reading.width_px) * end.out;
  detail::PlaceRange range{0, stem.line.at.size() - 1};
  const auto outside = [&](std::size_t place) { return glm::dot(stem.line.at[place] - at, end.out) > 0; };
  if (i > 0)
    while (range.last > 0 && outside(range.last)) --range.last;
  else
    while (range.first < range.last && outside(range.first)) ++range.first;
  return range;
}

/// What is read at node `i`. At an end of the stem it is read once more without what lies beyond, where there are no edges.
std::optional<RidgeReading> readAt(const Photo& photo, const SeenStem& stem, const std::vector<detail::EdgePair>& edges, std::size_t i, const SnapOptions& options,
                                   const detail::PathOptions& path) {
  const bool tip = stem.endsIn && i + 1 == stem.nodes.size(), collar = stem.beginsIn && i == 0;
  auto reading = detail::readingAt(stem.line, edges, stem.line.placeOf[i], stem.clicks[i], path, {0, edges.size() - 1});
  if (!reading || !(tip || collar)) return reading;
  const auto end = seenEnd(photo, stem, i, options, *reading);
  if (!end) return reading;
  const glm::dvec2 endsAt = reading->at.px + end->beyond_px * end->out;
  if (const auto inside = detail::readingAt(stem.line, edges, stem.line.placeOf[i], stem.clicks[i], path, insideOf(stem, i, *end, *reading))) reading = inside;
  const StemEnd usual = tip ? kTip : kCollar;
  reading->tip = PhotoPoint{endsAt - usual.beyond * reading->width_px * end->out};
  reading->sigmaTip_px = std::hypot(1, usual.scatter * reading->width_px);
  return reading;
}

}  // namespace

std::map<NodeId, RidgeReading> readRidges(const Photo& photo, const std::string& view, std::span<const ClickedNode> nodes, std::span<const ClickedStem> stems,
                                          const SnapOptions& options, const Expectations& expected) {
  std::map<NodeId, RidgeReading> readings;
  if (photo.width < 3 || photo.height < 3) return readings;
  const std::vector<SeenStem> seen = seenStems(view, nodes, stems, options.click_px, expected);
  const detail::PathOptions path{.reach_px = options.reach_px, .maxWidth_px = widestStem_px(photo, options), .click_px = options.click_px};
  std::vector<std::vector<detail::EdgePair>> edges;
  for (const SeenStem& stem : seen) edges.push_back(detail::likeliestEdges(photo, {}, stem.line, stem.clicks, path, stem.expected));
  const StemLikelihood likelihood = detail::likelihoodOf(photo, edges);
  for (std::size_t s = 0; s < seen.size(); ++s) {
    if (!likelihood.empty()) edges[s] = detail::likeliestEdges(photo, likelihood, seen[s].line, seen[s].clicks, path, seen[s].expected);
    for (std::size_t i = 0; i < seen[s].nodes.size(); ++i) {
      if (!seen[s].own[i] || readings.contains(seen[s].nodes[i])) continue;
      if (const auto reading = readAt(photo, seen[s], edges[s], i, options, path)) readings[seen[s].nodes[i]] = *reading;
    }
  }
  return readings;
}

}  // namespace axil::skeleton3d
