#pragma once
/// \file
/// Flowers: a tube (or none), one or more whorls of petals at its mouth, sepals under it, a centre, stamens. Attached at the
/// origin, the axis along +Y. The unit is the flower's length from its attachment along the axis and one petal: tube and petal
/// together are 1 long, so a flat flower is about 2 wide.

#include "organs/types.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

struct FlowerShape {
  std::string name;
  int petals = 5;                       ///< in one whorl
  int whorls = 1;                       ///< inner ones smaller and more upright (double flowers)
  std::string petalShape = "obovate";   ///< a name of leaf_shapes.tsv
  double petalWidthToLength = 0.6;
  double spread_deg = 80;               ///< of the outer petals from the axis: 0 upright, 90 flat, above 90 reflexed
  double cup = 0.2;                     ///< how much petals arch: above 0 they curve back to the axis, below 0 away from it
  double tube = 0.05;                   ///< length of the tube, 0 to below 1
  double tubeRadius = 0.03;             ///< at its foot
  double mouthRadius = 0.05;
  double bilateral = 0;                 ///< 0 radial symmetry; to 1: upper petals small and upright, lower ones long and spread
  double fused = 0;                     ///< share of the petals' length grown together: above 0 tube and petals are one corolla with lobes
  double banner = 0;                    ///< above 0: a pea's five petals: a large upright banner, two wings, a keel of two
  int sepals = 5;
  double sepalLength = 0.3;
  double centreRadius = 0;              ///< of a domed disc (composite heads)
  int stamens = 0;
  double stamenLength = 0.3;
  glm::vec3 petalColour{0.8f, 0.8f, 0.8f};  ///< linear RGB, 0 to 1
  glm::vec3 centreColour{0.7f, 0.5f, 0.05f};

  friend bool operator==(const FlowerShape&, const FlowerShape&) = default;
};

/// All shapes of data/flower_shapes.tsv, in its order.
[[nodiscard]] const std::vector<FlowerShape>& flowerShapes();
[[nodiscard]] std::optional<FlowerShape> flowerShapeNamed(std::string_view name);

/// Parts "sepal", "tube", "petal", "centre", "stamen", as the shape has them; sepals and stamens are left out at Detail::Far.
[[nodiscard]] std::vector<Part> flowerParts(const FlowerShape& shape, Detail detail);

}  // namespace axil::organs
