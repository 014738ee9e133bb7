#include "ui/epipolar.hpp"

#include <cmath>

namespace axil::ui {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::vector<PhotoPoint> epipolarLine(const skeleton3d::Camera& from, PhotoPoint at, const skeleton3d::Camera& to, PlantPoint middle, double reach) {
  constexpr int kSamples = 48;
  std::vector<PhotoPoint> line;
  if (from.model == skeleton3d::CameraModel::Unknown || to.model == skeleton3d::CameraModel::Unknown) return line;
  const skeleton3d::Ray ray = skeleton3d::rayThrough(from, at);
  const glm::dvec3 along = ray.direction.unit();
  const double nearest = glm::dot(middle.at - ray.origin.at, along);
  for (int i = 0; i <= kSamples; ++i) {
    const PlantPoint point{ray.origin.at + along * (nearest + reach * (2.0 * i / kSamples - 1))};
    if (skeleton3d::isInFront(from, point) && skeleton3d::isInFront(to, point)) line.push_back(skeleton3d::project(to, point));
  }
  return line;
}

std::optional<PhotoPoint> crossing(std::span<const PhotoPoint> line, PhotoPoint a, PhotoPoint b) {
  constexpr double kLeastSine = 0.17;  // 10 degrees
  const glm::dvec2 way = b.px - a.px;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::dvec2 piece = line[i].px - line[i - 1].px, to = line[i - 1].px - a.px;
    const double across = cross(way, piece);
    if (std::abs(across) <= kLeastSine * glm::length(way) * glm::length(piece)) continue;
    const double onWay = cross(to, piece) / across, onPiece = cross(to, way) / across;
    if (onWay >= 0 && onWay <= 1 && onPiece >= 0 && onPiece <= 1) return PhotoPoint{a.px + onWay * way};
  }
  return std::nullopt;
}

}  // namespace axil::ui
