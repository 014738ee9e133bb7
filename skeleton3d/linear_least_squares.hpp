#pragma once
/// \file
/// Private to skeleton3d: dense linear least squares by singular value decomposition, through CGAL's bridge to Eigen. The
/// .cpp is the only file that sees either of them for this purpose.

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace axil::skeleton3d::detail {

/// One equation a . x = b in three unknowns.
struct LinearRow {
  glm::dvec3 a{0, 0, 0};
  double b = 0;
};

/// The x of least |A x - b|; of the shortest x where several do equally well. Not finite where a row is not.
[[nodiscard]] glm::dvec3 solveThree(std::span<const LinearRow> rows);

/// The same for any number of unknowns: `a` row by row, `b.size()` rows.
[[nodiscard]] std::vector<double> solveLeastSquares(std::span<const double> a, std::span<const double> b);

}  // namespace axil::skeleton3d::detail
