#pragma once
/// \file
/// Fruits: a body turned about the axis (round, ribbed, flattened or beaded), and what marks a kind: the remains of a calyx, the
/// cup of an acorn, a wing, drupelets. Attached at the origin, the axis along +Y, the body from y = 0 to y = 1 (a samara's
/// wing included).

#include "organs/leaf.hpp"
#include "organs/types.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

enum class FruitExtra { None, Calyx, Cup, Wing, Drupelets, Scales };

struct FruitShape {
  std::string name;
  double widthToLength = 1;
  double widest = 0.5;
  LeafEnd base;
  LeafEnd apex;
  double flatness = 0;  ///< 0 round in section to below 1 flat
  int ribs = 0;         ///< ridges along the body
  double ribDepth = 0;
  int seeds = 0;  ///< swellings along the body (pods)
  double bend = 0;  ///< sideways bow
  FruitExtra extra = FruitExtra::None;
  glm::vec3 colour{0.5f, 0.05f, 0.04f};  ///< linear RGB, 0 to 1

  friend bool operator==(const FruitShape&, const FruitShape&) = default;
};

/// All shapes of data/fruit_shapes.tsv, in its order: berry, drupe, pome, legume, capsule, ...
[[nodiscard]] const std::vector<FruitShape>& fruitShapes();
[[nodiscard]] std::optional<FruitShape> fruitShapeNamed(std::string_view name);

/// Parts "flesh", and as the kind has them "calyx", "cup", "wing", "scale".
[[nodiscard]] std::vector<Part> fruitParts(const FruitShape& shape, Detail detail);

}  // namespace axil::organs
