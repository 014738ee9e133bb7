#include "skeleton3d/linear_least_squares.hpp"

#include "base/result.hpp"

#include <CGAL/Eigen_svd.h>

namespace axil::skeleton3d::detail {

glm::dvec3 solveThree(std::span<const LinearRow> rows) {
  CGAL::Eigen_svd::Matrix a(rows.size(), 3);
  CGAL::Eigen_svd::Vector b(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (int k = 0; k < 3; ++k) a.set(i, static_cast<std::size_t>(k), rows[i].a[k]);
    b.set(i, rows[i].b);
  }
  CGAL::Eigen_svd::solve(a, b);
  return {b[0], b[1], b[2]};
}

std::vector<double> solveLeastSquares(std::span<const double> a, std::span<const double> b) {
  AXIL_ASSERT(!b.empty() && a.size() % b.size() == 0, "a is not a whole number of rows");
  const std::size_t unknowns = a.size() / b.size();
  CGAL::Eigen_svd::Matrix matrix(b.size(), unknowns);
  CGAL::Eigen_svd::Vector vector(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t k = 0; k < unknowns; ++k) matrix.set(i, k, a[i * unknowns + k]);
    vector.set(i, b[i]);
  }
  CGAL::Eigen_svd::solve(matrix, vector);
  std::vector<double> x(unknowns);
  for (std::size_t k = 0; k < unknowns; ++k) x[k] = vector[static_cast<Eigen::Index>(k)];
  return x;
}

}  // namespace axil::skeleton3d::detail
