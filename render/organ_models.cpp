#include "render/organ_models.hpp"

#include "organs/flower.hpp"
#include "organs/fruit.hpp"
#include "organs/leaf.hpp"

#include <algorithm>

namespace axil::render {
namespace {

using organs::Detail;
using simeco::OrganKind;

constexpr const char* defaultLeaf = "ovate";
constexpr const char* defaultFlower = "five-petalled";
constexpr const char* defaultFruit = "berry";

/// Old grammars call a model "DefaultLeaf.i" when they mean none in particular.
bool namesNone(const std::string& stem) { return stem.empty() || stem.starts_with("default"); }

/// A kind's mesh by its name: `named` gives a shape or nothing, `make` its parts.
template <class Named, class Make>
ModelMesh modelNamed(const char* kind, const std::string& stem, const char* usual, const Named& named, const Make& make) {
  const auto shape = named(stem);
  const std::string name = shape ? stem : usual;
  ModelMesh model{.parts = make(shape ? *shape : *named(usual)), .name = std::string(kind) + " " + name, .note = {}};
  if (!shape && !namesNone(stem)) model.note = std::string("the ") + kind + " model \"" + stem + "\" is not a known shape; drawn as " + usual;
  return model;
}

}  // namespace

std::string modelStem(const std::string& model) {
  const std::size_t folder = model.find_last_of("/\\");
  std::string stem = folder == std::string::npos ? model : model.substr(folder + 1);
  if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
  std::transform(stem.begin(), stem.end(), stem.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return stem;
}

bool isModelled(OrganKind kind) { return kind == OrganKind::Leaf || kind == OrganKind::Flower || kind == OrganKind::Fruit; }

ModelMesh modelFor(OrganKind kind, const std::string& model, Detail detail) {
  const std::string stem = modelStem(model);
  switch (kind) {
    case OrganKind::Flower:
      return modelNamed("flower", stem, defaultFlower, organs::flowerShapeNamed, [&](const auto& shape) { return organs::flowerParts(shape, detail); });
    case OrganKind::Fruit:
      return modelNamed("fruit", stem, defaultFruit, organs::fruitShapeNamed, [&](const auto& shape) { return organs::fruitParts(shape, detail); });
    case OrganKind::Leaf:
    case OrganKind::Apex:
    case OrganKind::Stem:
    case OrganKind::Root: break;
  }
  return modelNamed("leaf", stem, defaultLeaf, organs::leafShapeNamed, [&](const auto& shape) { return organs::leafParts(shape, std::nullopt, detail); });
}

ShapeSize leafShapeSize(const std::string& model) {
  const std::string stem = modelStem(model);
  const auto shape = organs::leafShapeNamed(stem);
  return {shape.value_or(*organs::leafShapeNamed(defaultLeaf)).widthToLength, shape ? stem : std::string()};
}

}  // namespace axil::render
