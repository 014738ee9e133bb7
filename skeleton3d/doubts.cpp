#include "skeleton3d/doubts.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace axil::skeleton3d {
namespace {

constexpr double kLeastOff_px = 5, kOffOfTypical = 4;
constexpr double kTimesTypical = 6;
constexpr std::size_t kFewestSegments = 5;

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<DoubtfulClick> clicksOf(const Skeleton& skeleton) {
  std::vector<double> all;
  for (const Node& node : skeleton.nodes)
    for (const auto& [view, off_px] : node.reprojection_px) all.push_back(off_px);
  const double most = std::max(kLeastOff_px, kOffOfTypical * medianOf(std::move(all)));
  std::vector<DoubtfulClick> doubtful;
  for (const Node& node : skeleton.nodes)
    for (const auto& [view, off_px] : node.reprojection_px)
      if (off_px > most) doubtful.push_back({node.id, view, off_px});
  return doubtful;
}

std::vector<DoubtfulSegment> segmentsOf(const Skeleton& skeleton) {
  std::map<NodeId, glm::dvec3> places;
  for (const Node& node : skeleton.nodes) places[node.id] = node.position.at;
  std::vector<DoubtfulSegment> segments;  // all of them first; `times` is the length
  std::vector<double> lengths;
  for (const Stem& stem : skeleton.stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const auto from = places.find(stem.nodes[i - 1]), to = places.find(stem.nodes[i]);
      if (from == places.end() || to == places.end()) continue;
      lengths.push_back(glm::distance(from->second, to->second));
      segments.push_back({stem.id, from->first, to->first, lengths.back()});
    }
  const double typical = medianOf(lengths);
  if (segments.size() < kFewestSegments || typical <= 0) return {};
  for (DoubtfulSegment& segment : segments) segment.times /= typical;
  std::erase_if(segments, [](const DoubtfulSegment& segment) { return segment.times <= kTimesTypical; });
  return segments;
}

}  // namespace

Doubts doubtsOf(const Skeleton& skeleton) { return {clicksOf(skeleton), segmentsOf(skeleton)}; }

}  // namespace axil::skeleton3d
