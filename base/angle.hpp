#pragma once
/// \file
/// Angle: a plane angle that knows its unit. SimEco text and GLM speak radians, cpfg and L-Py text, VTK cameras and
/// OpenCV's 2D rotations speak degrees; a bare double would be wrong somewhere.

#include <compare>
#include <numbers>

namespace axil {

class Angle {
 public:
  constexpr Angle() = default;
  [[nodiscard]] static constexpr Angle fromRadians(double radians) { return Angle(radians); }
  [[nodiscard]] static constexpr Angle fromDegrees(double degrees) { return Angle(degrees * (std::numbers::pi / 180.0)); }

  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }

  friend constexpr auto operator<=>(Angle, Angle) = default;
  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator-(Angle a) { return Angle(-a.radians_); }
  friend constexpr Angle operator*(Angle a, double factor) { return Angle(a.radians_ * factor); }
  friend constexpr Angle operator*(double factor, Angle a) { return Angle(a.radians_ * factor); }
  friend constexpr Angle operator/(Angle a, double divisor) { return Angle(a.radians_ / divisor); }
  constexpr Angle& operator+=(Angle other) {
    radians_ += other.radians_;
    return *this;
  }

 private:
  explicit constexpr Angle(double radians) : radians_(radians) {}
  double radians_ = 0;
};

inline namespace literals {
constexpr Angle operator""_deg(long double degrees) { return Angle::fromDegrees(static_cast<double>(degrees)); }
constexpr Angle operator""_deg(unsigned long long degrees) { return Angle::fromDegrees(static_cast<double>(degrees)); }
constexpr Angle operator""_rad(long double radians) { return Angle::fromRadians(static_cast<double>(radians)); }
}  // namespace literals

}  // namespace axil
