#pragma once
/// \file
/// Environment: what surrounds the plants of an ecosystem while they grow. A plain value that a host hands to growth; a field
/// that it leaves open is what the grammar's own attributes say, and what nobody says does not act.
///
/// - soilPH, rainRate, dayLight (hours), temperature (degrees Celsius) slow growth through each plant's response curves.
/// - light points to where the light comes from; its length does not matter. Without it light falls straight down.
/// - gravity points down, (0, -1, 0) without it; its length is its strength.
/// - wind blows along its direction; its length is how far, in radians, an organ across it turns while it grows out.
/// - Obstacles are solid: nothing that grows passes through the surface of one. A mesh may be open, as a wall is.
///
/// Frame: the plants', Y up, the grammar's unit. `checkEnvironment` fails with BadInput for numbers that are not finite, sizes that are
/// not above 0, light or gravity without a direction, and meshes that name points they do not have.

#include "base/frames.hpp"
#include "base/result.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace axil::simeco {

struct SphereObstacle {
  PlantPoint centre;
  double radius = 1;
  friend bool operator==(const SphereObstacle&, const SphereObstacle&) = default;
};

/// Edges along the axes.
struct BoxObstacle {
  PlantPoint low, high;
  friend bool operator==(const BoxObstacle&, const BoxObstacle&) = default;
};

struct MeshObstacle {
  std::vector<PlantPoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  friend bool operator==(const MeshObstacle&, const MeshObstacle&) = default;
};

using Obstacle = std::variant<SphereObstacle, BoxObstacle, MeshObstacle>;

struct Environment {
  std::optional<double> soilPH = {};
  std::optional<double> rainRate = {};
  std::optional<double> dayLight = {};
  std::optional<double> temperature = {};
  std::optional<glm::dvec3> light = {};
  std::optional<glm::dvec3> gravity = {};
  std::optional<glm::dvec3> wind = {};
  std::vector<Obstacle> obstacles = {};
  friend bool operator==(const Environment&, const Environment&) = default;
};

/// From `time` on, in the grammar's time, the whole environment is another.
struct EnvironmentChange {
  double time = 0;
  Environment environment = {};
};

/// More triangles than these, all obstacles together, are refused.
inline constexpr std::size_t kMostObstacleTriangles = 2'000'000;

/// The mesh of an .obj text. Fails with BadInput, naming the line, where a point or a corner is no number or a point is not there; with
/// NoAnswer where there is no face.
[[nodiscard]] Result<MeshObstacle> obstacleFromObj(std::string_view text);

[[nodiscard]] Result<void> checkEnvironment(const Environment& environment);
/// The same for each, and that their times are finite, at least 0 and ascending.
[[nodiscard]] Result<void> checkChanges(const std::vector<EnvironmentChange>& changes);

}  // namespace axil::simeco
