#pragma once
/// \file
/// Private to skeleton3d: the arithmetic of projection, written once for doubles and for Ceres' dual numbers.

#include <array>

namespace axil::skeleton3d::detail {

/// The lens model of OpenCV: radial k1, k2, k3 and tangential p1, p2 on (x/z, y/z).
template <class T>
std::array<T, 2> distort(const std::array<double, 5>& d, const T& x, const T& y) {
  const T r2 = x * x + y * y;
  const T radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  return {x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x), y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y};
}

/// d(distorted)/d(x, y), row by row; symmetric, since both tangential terms share their mixed derivative.
inline std::array<double, 4> distortJacobian(const std::array<double, 5>& d, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double slope = 2.0 * (d[0] + r2 * (2.0 * d[1] + r2 * 3.0 * d[4]));  // d(radial)/d(r2), doubled: dr2/dx = 2x
  const double mixed = slope * x * y + 2.0 * d[2] * x + 2.0 * d[3] * y;
  return {radial + slope * x * x + 2.0 * d[2] * y + 6.0 * d[3] * x, mixed, mixed, radial + slope * y * y + 6.0 * d[2] * y + 2.0 * d[3] * x};
}

}  // namespace axil::skeleton3d::detail
