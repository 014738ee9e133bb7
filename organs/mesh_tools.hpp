#pragma once
/// \file
/// Private to the room: meshes made of simpler ones. All triangles counter-clockwise seen from outside, normals of unit length.

#include "organs/types.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace axil::organs {

/// Both meshes as one.
void append(Mesh& mesh, const Mesh& more);
/// `mesh` moved, turned and scaled; normals follow (inverse transpose). `matrix` must not mirror.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const glm::dmat4& matrix);
/// `profile` (radius, height), from the bottom up, turned about the Y axis; radius 0 closes an end in one point.
[[nodiscard]] Mesh revolved(std::span<const glm::dvec2> profile, int sides);
/// A round tube along `path` with `radii` at its points; open at both ends.
[[nodiscard]] Mesh tube(std::span<const glm::dvec3> path, std::span<const double> radii, int sides);

}  // namespace axil::organs
