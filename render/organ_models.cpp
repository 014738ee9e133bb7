#include "render/organ_models.hpp"

#include "organs/model.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace axil::render {
namespace {

using organs::Detail;
using simeco::OrganKind;

/// Old grammars call a model "DefaultLeaf.i" when they mean none in particular.
bool namesNone(const std::string& stem) { return stem.empty() || stem.starts_with("default"); }

/// What a name was read as, and a sentence for what of it was not understood.
template <class Model>
ModelMesh read(const char* kind, const std::string& stem, const Model& model, std::vector<organs::Part> parts) {
  ModelMesh mesh{.parts = std::move(parts), .name = std::string(kind) + " " + (namesNone(stem) ? model.shape.name : stem), .note = {}};
  if (model.unknown.empty()) return mesh;
  mesh.name = std::string(kind) + " " + model.shape.name;
  std::string words;
  for (const std::string& word : model.unknown) words += (words.empty() ? "\"" : "\", \"") + word;
  mesh.note = std::string("the ") + kind + " model \"" + stem + "\" is not a known shape; drawn as " + model.shape.name;
  if (model.unknown.front() != stem) mesh.note = std::string("the ") + kind + " model \"" + stem + "\" has words that are not known: " + words + "\"; drawn as " + model.shape.name + " without them";
  return mesh;
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
  if (kind == OrganKind::Flower) {
    const organs::FlowerModel flower = organs::flowerModelNamed(stem);
    return read("flower", stem, flower, organs::flowerParts(flower.shape, detail));
  }
  if (kind == OrganKind::Fruit) {
    const organs::FruitModel fruit = organs::fruitModelNamed(stem);
    return read("fruit", stem, fruit, organs::fruitParts(fruit.shape, detail));
  }
  const organs::LeafModel leaf = organs::leafModelNamed(stem);
  return read("leaf", stem, leaf, organs::leafModelParts(leaf, detail));
}

ShapeSize leafShapeSize(const std::string& model) {
  const organs::LeafModel leaf = organs::leafModelNamed(modelStem(model));
  const bool known = leaf.unknown.empty() && !namesNone(modelStem(model));
  return {leaf.shape.widthToLength, known ? modelStem(model) : std::string()};
}

}  // namespace axil::render
