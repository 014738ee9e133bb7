#pragma once
/// \file
/// Bow: how lengths rise to a level, fall to one, or leave one, along an axis or with the age of a plant. Three laws of growth, each times a level that is no
/// matter of the bow, with e = exp(-pace * (place - middle)): *Mitscherlich* 1 + sign * e (each place makes up the same share of what is missing), *logistic* 1 / (1 + e), *Gompertz*
/// exp(sign * e). A logistic bow of negative pace leaves its level and falls by a factor that settles. Places are ranks or stages; values are of logarithms, so that levels add. Where a Mitscherlich rise would begin below nothing it is held at a hundredth of its level.
/// Sources: Mitscherlich 1909, Verhulst 1838, Gompertz 1825, as growth courses in Thornley and Johnson, Plant and Crop Modelling (1990), chapter 3.

namespace axil::quantify {

struct Bow {
  static constexpr double kLeast = 0.01;   ///< of its level
  enum class Shape { Mitscherlich, Logistic, Gompertz } shape = Shape::Logistic;
  double sign = 1;     ///< of e; -1 rises, 1 falls; logistic: 1
  double pace = 1;     ///< positive: a level is reached; negative: it is left
  double middle = 0;   ///< the place where e is 1
  /// The logarithm at that place.
  [[nodiscard]] double at(double place) const;
};
[[nodiscard]] const char* nameOf(Bow::Shape shape);

}  // namespace axil::quantify
