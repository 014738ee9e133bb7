#include "ui/epipolar.hpp"

namespace axil::ui {

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

}  // namespace axil::ui
