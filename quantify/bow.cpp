#include "quantify/bow.hpp"

#include <algorithm>
#include <cmath>

namespace axil::quantify {

const char* nameOf(Bow::Shape shape) {
  switch (shape) {
    case Bow::Shape::Mitscherlich: return "Mitscherlich's law";
    case Bow::Shape::Logistic: return "the logistic law";
    case Bow::Shape::Gompertz: return "Gompertz' law";
  }
  return "";
}

double Bow::at(double place) const {
  constexpr double kFurthest = 50;
  const double e = std::exp(std::min(-pace * (place - middle), kFurthest));
  switch (shape) {
    case Shape::Mitscherlich: return std::log(std::max(kLeast, 1 + sign * e));
    case Shape::Logistic: return -std::log1p(e);
    case Shape::Gompertz: return sign * e;
  }
  return 0;
}

}  // namespace axil::quantify
