#include "organs/model.hpp"

#include "base/table.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace axil::organs {

namespace {

constexpr const char* usualLeaf = "ovate";
constexpr const char* usualFlower = "five-petalled";
constexpr const char* usualFruit = "berry";

/// Without a folder and an ending of letters, in lower case: "Leaves/Ovate.i" is "ovate".
std::string plainName(std::string_view name) {
  if (const std::size_t folder = name.find_last_of("/\\"); folder != std::string_view::npos) name.remove_prefix(folder + 1);
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos && dot > 0 && name.find_first_of(", ", dot) == std::string_view::npos) name = name.substr(0, dot);
  std::string plain(name);
  std::transform(plain.begin(), plain.end(), plain.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return plain;
}

/// Old grammars call a model "DefaultLeaf.i" when they mean none in particular.
bool namesNone(const std::string& name) { return name.empty() || name.starts_with("default"); }

struct Item {
  std::string_view key;
  std::string_view value;
};

Item itemOf(const std::string& words) {
  const std::string_view all(words);
  const std::size_t blank = all.find(' ');
  if (blank == std::string_view::npos) return {all, {}};
  return {all.substr(0, blank), all.substr(blank + 1)};
}

std::optional<double> percentIn(std::string_view value, double most) {
  const std::optional<double> number = parseNumber(value);
  if (!number || !(*number > 0 && *number <= most)) return std::nullopt;
  return *number / 100;
}

std::optional<int> countIn(std::string_view value, int most) {
  const std::optional<double> number = parseNumber(value);
  if (!number || !(*number >= 0 && *number <= most)) return std::nullopt;
  return static_cast<int>(std::lround(*number));
}

/// "8a1030": sRGB in hexadecimal digits, as linear light.
std::optional<glm::vec3> colourIn(std::string_view value) {
  if (value.size() != 6) return std::nullopt;
  glm::vec3 colour{0};
  for (int i = 0; i < 3; ++i) {
    int byte = 0;
    for (const char c : value.substr(static_cast<std::size_t>(2 * i), 2)) {
      const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
      if (digit < 0) return std::nullopt;
      byte = 16 * byte + digit;
    }
    const double s = byte / 255.0;
    colour[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return colour;
}

template <class T, class Value>
bool set(T& member, const std::optional<Value>& value) {
  if (value) member = static_cast<T>(*value);
  return value.has_value();
}

std::optional<LeafFeature> featureNamed(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, LeafFeature>, 4> words{{{"apex", LeafFeature::Apex}, {"base", LeafFeature::Base}, {"margin", LeafFeature::Margin}, {"veins", LeafFeature::Veins}}};
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == key; });
  return found == words.end() ? std::nullopt : std::optional(found->second);
}

bool setSpots(LeafShape& shape, std::string_view value) {
  const std::size_t blank = value.find(' ');
  if (!set(shape.spots, percentIn(value.substr(0, blank), 60))) return false;
  return blank == std::string_view::npos || set(shape.spotColour, colourIn(value.substr(blank + 1)));
}

CompoundLeaf& compoundOf(LeafModel& model) {
  if (!model.compound) model.compound = CompoundLeaf{};
  return *model.compound;
}

bool changeLeaf(LeafModel& model, const Item& item) {
  if (const auto feature = featureNamed(item.key)) return set(model.shape, withFeature(model.shape, *feature, item.value));
  if (item.key == "width") return set(model.shape.widthToLength, percentIn(item.value, 300));
  if (item.key == "spots") return setSpots(model.shape, item.value);
  if (item.key == "type") return item.value == "simple" || (leafTypeNamed(item.value) && set(compoundOf(model).type, leafTypeNamed(item.value)));
  if (item.key == "leaflets") return countIn(item.value, 81) && set(compoundOf(model).leaflets, countIn(item.value, 81));
  if (item.key == "pinnae") return countIn(item.value, 40) && set(compoundOf(model).pinnae, countIn(item.value, 40));
  if (item.key == "leaflet") return percentIn(item.value, 100) && set(compoundOf(model).leafletLength, percentIn(item.value, 100));
  if (item.key == "petiole") return percentIn(item.value, 60) && set(compoundOf(model).petiole, percentIn(item.value, 60));
  return false;
}

bool changeFlower(FlowerModel& model, const Item& item) {
  FlowerShape& shape = model.shape;
  if (item.key == "petals") return countIn(item.value, 40) && *countIn(item.value, 40) > 0 && set(shape.petals, countIn(item.value, 40));
  if (item.key == "petal" && item.value.starts_with("width ")) return set(shape.petalWidthToLength, percentIn(item.value.substr(6), 300));
  if (item.key == "petal") {
    if (!leafShapeNamed(item.value)) return false;
    shape.petalShape = item.value;
    return true;
  }
  if (item.key == "double") return countIn(item.value, 12) && *countIn(item.value, 12) > 0 && set(shape.whorls, countIn(item.value, 12));
  if (item.key == "eye") {
    shape.centreRadius = std::max(shape.centreRadius, 0.06);
    return set(shape.centreColour, colourIn(item.value));
  }
  if (item.key == "tube") return set(shape.tube, percentIn(item.value, 95));
  if (item.key == "spread") return set(shape.spread_deg, countIn(item.value, 150));
  if (item.key == "stamens") return set(shape.stamens, countIn(item.value, 60));
  if (item.key == "sepals") return set(shape.sepals, countIn(item.value, 40));
  if (item.key == "bilateral") return set(shape.bilateral, percentIn(item.value, 100));
  return false;
}

bool changeFruit(FruitModel& model, const Item& item) { return item.key == "width" && set(model.shape.widthToLength, percentIn(item.value, 300)); }

/// The shape that the first item names, changed by the others.
template <class Model, class Named>
Model modelNamed(std::string_view name, const char* usual, const Named& named, bool (*change)(Model&, const Item&)) {
  const std::string plain = plainName(name);
  std::vector<std::string> items = splitList(plain, ',');
  Model model;
  const std::string first = items.empty() ? "" : items.front();
  const auto shape = named(first);
  model.shape = shape ? *shape : *named(usual);
  if (!shape && !namesNone(first)) model.unknown.push_back(first);
  for (std::size_t i = 1; i < items.size(); ++i)
    if (!change(model, itemOf(items[i]))) model.unknown.push_back(items[i]);
  return model;
}

}  // namespace

LeafModel leafModelNamed(std::string_view name) {
  LeafModel model = modelNamed<LeafModel>(name, usualLeaf, leafShapeNamed, changeLeaf);
  if (model.compound) model.compound->leaflet = model.shape;
  return model;
}

FlowerModel flowerModelNamed(std::string_view name) { return modelNamed<FlowerModel>(name, usualFlower, flowerShapeNamed, changeFlower); }
FruitModel fruitModelNamed(std::string_view name) { return modelNamed<FruitModel>(name, usualFruit, fruitShapeNamed, changeFruit); }

std::vector<Part> leafModelParts(const LeafModel& model, Detail detail) {
  return model.compound ? compoundParts(*model.compound, detail) : leafParts(model.shape, std::nullopt, detail);
}

}  // namespace axil::organs
