#include "skeleton3d/stem_course.hpp"

#include "skeleton3d/statistics.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

double leapOver(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kMost = 10;
  const double straight = glm::length(c - a), way = glm::length(b - a) + glm::length(c - b);
  if (!(way > straight)) return 0;
  return straight > 0 ? std::min(std::sqrt(way / straight - 1), kMost) : kMost;
}

double leapOf(const StemCourse& course, const std::array<NodeId, 3>& run, NodeId moved, const glm::dvec3& at) {
  const auto place = [&](NodeId id) { return id == moved ? at : course.places.at(id); };
  return leapOver(place(run[0]), place(run[1]), place(run[2]));
}

}  // namespace

StemCourse stemCourseOf(std::span<const ClickedStem> stems, std::map<NodeId, glm::dvec3> places) {
  StemCourse course{std::move(places), {}, 0};
  std::vector<double> leaps;
  for (const ClickedStem& stem : stems) {
    std::vector<NodeId> placed;
    for (const NodeId id : stem.nodes)
      if (course.places.contains(id) && std::find(placed.begin(), placed.end(), id) == placed.end()) placed.push_back(id);
    for (std::size_t i = 2; i < placed.size(); ++i) {
      const std::array<NodeId, 3> run{placed[i - 2], placed[i - 1], placed[i]};
      for (const NodeId id : run) course.around[id].push_back(run);
      leaps.push_back(leapOf(course, run, run[1], course.places.at(run[1])));
    }
  }
  course.usual = medianOf(std::move(leaps));
  return course;
}

double likelihoodAt(const StemCourse& course, NodeId node, const glm::dvec3& at) {
  const auto runs = course.around.find(node);
  if (runs == course.around.end()) return 0;
  constexpr double kLeast = 0.05;  // three degrees of bending: straighter stems prove no more
  const double usual = std::max(course.usual, kLeast);
  double sum = 0;
  for (const auto& run : runs->second) {
    const double leap = leapOf(course, run, node, at) / usual;
    sum -= std::log1p(leap * leap);
  }
  return sum;
}

bool leapsAt(const StemCourse& course, NodeId node, const glm::dvec3& at) {
  const auto runs = course.around.find(node);
  if (runs == course.around.end()) return false;
  constexpr double kFar = 5;  // times the usual leap, as a mean over the runs
  return likelihoodAt(course, node, at) < -static_cast<double>(runs->second.size()) * std::log1p(kFar * kFar);
}

}  // namespace axil::skeleton3d::detail
