#pragma once
/// \file
/// Private to render: which mesh a style asks for. A Model such as "ovate.i" names a leaf shape by its stem.

#include "organs/types.hpp"
#include "simeco/plant.hpp"

#include <string>
#include <vector>

namespace axil::render {

struct ModelMesh {
  std::vector<organs::Part> parts;
  std::string name;                ///< "leaf ovate"
  std::string note;                ///< a sentence when the model's name is not known and the kind's default was taken
};

/// "ovate.i" -> "ovate": no folder, no ending, lower case.
[[nodiscard]] std::string modelStem(const std::string& model);

/// Whether this kind is drawn as a model at the organ's frame (leaf, flower, fruit) and not as part of a tube.
[[nodiscard]] bool isModelled(simeco::OrganKind kind);

[[nodiscard]] ModelMesh modelFor(simeco::OrganKind kind, const std::string& model, organs::Detail detail);

/// A leaf model's own proportion, and the shape's name; empty when the model names none.
struct ShapeSize {
  double widthToLength = 0.5;
  std::string name;
};
[[nodiscard]] ShapeSize leafShapeSize(const std::string& model);

}  // namespace axil::render
