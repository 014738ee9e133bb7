#include "simeco/environment.hpp"

#include "base/overloaded.hpp"
#include "base/text.hpp"

#include <cmath>

namespace axil::simeco {

namespace {

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Failure bad(const std::string& what) { return fail(ErrorCode::BadInput, what); }

Result<void> checkNumbers(const Environment& e) {
  const struct {
    const char* name;
    const std::optional<double>& value;
  } numbers[] = {{"soil pH", e.soilPH}, {"rain rate", e.rainRate}, {"day light", e.dayLight}, {"temperature", e.temperature}};
  for (const auto& number : numbers)
    if (number.value && !std::isfinite(*number.value)) return bad("the environment's " + std::string(number.name) + " must be a finite number");
  return {};
}

Result<void> checkVectors(const Environment& e) {
  const struct {
    const char* name;
    const std::optional<glm::dvec3>& value;
    bool mayBeZero;
  } vectors[] = {{"light", e.light, false}, {"gravity", e.gravity, true}, {"wind", e.wind, true}};
  for (const auto& vector : vectors) {
    if (!vector.value) continue;
    if (!isFinite(*vector.value)) return bad("the environment's " + std::string(vector.name) + " must be three finite numbers");
    if (!vector.mayBeZero && !PlantDirection::hasDirection(*vector.value))
      return bad("the environment's " + std::string(vector.name) + " has no direction; give a vector that points to where it comes from");
  }
  return {};
}

Result<void> checkShape(const SphereObstacle& sphere) {
  if (isFinite(sphere.centre.at) && std::isfinite(sphere.radius) && sphere.radius > 0) return {};
  return bad("a sphere among the obstacles needs a finite centre and a radius above 0, not " + shortest(sphere.radius));
}

Result<void> checkShape(const BoxObstacle& box) {
  const bool solid = box.low.at.x < box.high.at.x && box.low.at.y < box.high.at.y && box.low.at.z < box.high.at.z;
  if (isFinite(box.low.at) && isFinite(box.high.at) && solid) return {};
  return bad("a box among the obstacles needs two finite corners, the first below the second along each axis");
}

Result<void> checkShape(const MeshObstacle& mesh) {
  for (const PlantPoint& point : mesh.points)
    if (!isFinite(point.at)) return bad("a mesh among the obstacles has a point that is not finite");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= mesh.points.size())
        return bad("a mesh among the obstacles names point " + std::to_string(corner) + " but has only " + std::to_string(mesh.points.size()));
  return {};
}

std::size_t trianglesOf(const Obstacle& obstacle) {
  const auto* mesh = std::get_if<MeshObstacle>(&obstacle);
  return mesh == nullptr ? 12 : mesh->triangles.size();
}

}  // namespace

Result<void> checkEnvironment(const Environment& environment) {
  if (auto numbers = checkNumbers(environment); !numbers) return numbers;
  if (auto vectors = checkVectors(environment); !vectors) return vectors;
  std::size_t triangles = 0;
  for (const Obstacle& obstacle : environment.obstacles) {
    if (auto shape = std::visit([](const auto& s) { return checkShape(s); }, obstacle); !shape) return shape;
    triangles += trianglesOf(obstacle);
  }
  if (triangles <= kMostObstacleTriangles) return {};
  return fail(ErrorCode::LimitReached, "the obstacles have " + std::to_string(triangles) + " triangles, more than the limit of " +
                                           std::to_string(kMostObstacleTriangles) + "; give a coarser mesh");
}

Result<void> checkChanges(const std::vector<EnvironmentChange>& changes) {
  double last = 0;
  for (const EnvironmentChange& change : changes) {
    if (!std::isfinite(change.time) || change.time < last)
      return bad("changes of the environment need finite times of at least 0 in ascending order, not " + shortest(change.time) + " after " + shortest(last));
    last = change.time;
    if (auto checked = checkEnvironment(change.environment); !checked) return checked;
  }
  return {};
}

}  // namespace axil::simeco
