#include "skeleton3d/snap.hpp"
#include "skeleton3d/snap_tip.hpp"
#include "skeleton3d/stem_colour.hpp"
#include "skeleton3d/stem_path.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
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
  std::set<NodeId> begins;
  for (const ClickedStem& stem : stems)
    if (!stem.nodes.empty()) begins.insert(stem.nodes.front());
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
    s.line = detail::stemLine(course, expected.empty() ? click_px : 0.4 * click_px, kStep_px);
    if (s.line.at.empty()) continue;
    s.expected = expectedAlong(s, expected);
    seen.push_back(std::move(s));
  }
  return seen;
}

/// The end of the stem near its last click.
void addTip(const Photo& photo, const SeenStem& stem, const SnapOptions& options, RidgeReading& reading) {
  const glm::dvec2 along{std::cos(reading.along.radians()), std::sin(reading.along.radians())};
  const glm::dvec2 course = stem.clicks.back() - stem.clicks[stem.clicks.size() - 2], out = glm::dot(course, along) < 0 ? -along : along;
  const double reach_px = std::min(3 * options.click_px, 0.5 * glm::length(course));
  if (const auto beyond = detail::tipBeyond(photo, reading, out, reach_px)) reading.tip = PhotoPoint{reading.at.px + *beyond * out}, reading.sigmaTip_px = std::hypot(1, 0.2 * reading.width_px);
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
      const auto reading = detail::readingAt(seen[s].line, edges[s], seen[s].line.placeOf[i], seen[s].clicks[i], path);
      if (!reading) continue;
      readings[seen[s].nodes[i]] = *reading;
      if (seen[s].endsIn && i + 1 == seen[s].nodes.size()) addTip(photo, seen[s], options, readings[seen[s].nodes[i]]);
    }
  }
  return readings;
}

}  // namespace axil::skeleton3d
