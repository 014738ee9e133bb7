#pragma once
/// \file
/// Models by their names: what the Model of a SimEco stage says an organ looks like. A name is a list of words, divided by commas.
/// The first is a shape ("ovate", "salverform", "legume"), the others change it:
///
///   leaf    "ovate, apex acuminate, base cordate, margin serrate, veins three-veined, width 45, spots 30 pink"
///           "oblong, apex obtuse, type even-pinnate, leaflets 16, leaflet 20, petiole 12": lengths in percent of the whole leaf
///   flower  "salverform, petals 5, petal obovate, petal width 60, double 3, eye 8a1030, tube 45, stamens 10, bilateral 60"
///   fruit   "legume, width 12"
///
/// An item that is not understood leaves the shape as it is and is named in `unknown`; a first word that is no shape does too, and
/// the kind's usual shape stands for it. Names may end in an old file ending (".i").

#include "organs/compound.hpp"
#include "organs/flower.hpp"
#include "organs/fruit.hpp"
#include "organs/leaf.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

struct LeafModel {
  LeafShape shape;                      ///< the blade, or the leaflet of a compound leaf
  std::optional<CompoundLeaf> compound;
  std::vector<std::string> unknown;     ///< items that were not understood
};
struct FlowerModel {
  FlowerShape shape;
  std::vector<std::string> unknown;
};
struct FruitModel {
  FruitShape shape;
  std::vector<std::string> unknown;
};

[[nodiscard]] LeafModel leafModelNamed(std::string_view name);
[[nodiscard]] FlowerModel flowerModelNamed(std::string_view name);
[[nodiscard]] FruitModel fruitModelNamed(std::string_view name);

/// leafParts or compoundParts, as the model is.
[[nodiscard]] std::vector<Part> leafModelParts(const LeafModel& model, Detail detail);

}  // namespace axil::organs
