#include "keywords/models.hpp"

#include "base/table.hpp"
#include "base/text.hpp"
#include "keywords/presets.hpp"
#include "keywords/vocabulary.hpp"
#include "organs/model.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace axil::keywords {

namespace {

using organs::LeafFeature;

bool isHeld(const Trait& trait) { return trait.qualifier != "rarely" && trait.qualifier != "sometimes"; }

const Concept* entryOf(std::string_view property, std::string_view name) {
  for (const Category& category : vocabulary())
    if (category.property == property)
      for (const Concept& entry : category.concepts)
        if (entry.name == name) return &entry;
  return nullptr;
}

double srgbOf(double linear) { return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

/// "dark green", 深綠: darker; "pale pink", 淡紅: nearer to white.
glm::dvec3 shaded(const glm::dvec3& colour, const Trait& trait) {
  const auto says = [&](std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return trait.text.find(w) != std::string::npos || trait.qualifier.find(w) != std::string::npos; });
  };
  if (says({"dark", "Dark", "deep", "Deep", "深", "暗"})) return colour * 0.78;
  if (says({"pale", "Pale", "light", "Light", "淡", "淺", "浅"})) return colour + (glm::dvec3(0.96) - colour) * 0.4;
  return colour;
}

std::string hexOf(const glm::dvec3& srgb) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  for (int i = 0; i < 3; ++i) {
    const int byte = static_cast<int>(std::lround(255 * std::clamp(srgb[i], 0.0, 1.0)));
    hex += digits[static_cast<std::size_t>(byte / 16)];
    hex += digits[static_cast<std::size_t>(byte % 16)];
  }
  return hex;
}

std::string percent(double share) { return std::to_string(std::max(1L, std::lround(100 * share))); }

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) { return std::find(words.begin(), words.end(), word) != words.end(); }

/// A value as the feature's table spells it: itself, or of a range or compound ("serrate-dentate") the first half that can be drawn.
std::string featureWord(LeafFeature feature, const std::string& value) {
  const std::vector<std::string> known = organs::leafFeatureNames(feature);
  const auto isKnown = [&](const std::string& word) { return std::find(known.begin(), known.end(), word) != known.end(); };
  if (isKnown(value)) return value;
  for (std::size_t begin = 0; begin < value.size();) {
    const std::size_t end = std::min(value.find('-', begin), value.size());
    if (isKnown(value.substr(begin, end - begin))) return value.substr(begin, end - begin);
    begin = end + 1;
  }
  return {};
}

/// Of two apexes ("rounded, mucronate") the one that adds a point counts.
std::string apexOf(const Traits& traits, const Presets& presets) {
  for (const Trait& trait : traits)
    if (trait.property == "apex" && isOneOf(trait.organ, {"leaf", "leaflet"}) && isHeld(trait) && isOneOf(trait.value, {"mucronate", "apiculate"})) return trait.value;
  return featureWord(LeafFeature::Apex, presets.leaf.apex);
}

std::optional<double> ratioOf(const std::optional<PresetRange>& length, const std::optional<PresetRange>& width) {
  if (!length || !width || length->middle() <= 0 || width->middle() <= 0) return std::nullopt;
  return std::clamp(width->middle() / length->middle(), 0.01, 3.0);
}

/// Whether the blade's colours are a green and spots upon it: "dark green, spotted with pink".
bool isSpot(const Traits& traits, const Trait& trait) {
  if (trait.organ != "leaf" || trait.property != "colour" || !isOneOf(trait.value, {"pink", "white", "yellow", "cream", "red"})) return false;
  return std::any_of(traits.begin(), traits.end(), [&](const Trait& t) { return t.organ == "leaf" && t.property == "colour" && t.value == "green" && t.start < trait.start; });
}

class ModelText {
 public:
  explicit ModelText(std::string shape) : text_(std::move(shape)) {}
  void add(std::string_view key, const std::string& value) {
    if (!value.empty()) text_ += ", " + std::string(key) + " " + value;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void addLeaflets(ModelText& model, const LeafPreset& leaf) {
  model.add("type", leaf.type);
  if (leaf.leaflets && leaf.leaflets->middle() >= 1 && leaf.leaflets->middle() <= 81) model.add("leaflets", std::to_string(std::lround(leaf.leaflets->middle())));
  if (const auto share = ratioOf(leaf.length_m, leaf.leafletLength_m); share && *share < 1) model.add("leaflet", percent(*share));
}

/// A flower's form: by its word, else by how many parts it has.
std::string flowerShapeOf(const FlowerPreset& flower, std::optional<int> petals) {
  if (organs::flowerShapeNamed(flower.form)) return flower.form;
  switch (petals.value_or(0)) {
    case 0: return {};
    case 3: return "three-petalled";
    case 4: return "four-petalled";
    case 6: return "six-petalled";
    default: return "five-petalled";
  }
}

std::optional<int> petalsOf(const FlowerPreset& flower) {
  for (const std::optional<PresetRange>& count : {flower.petals, flower.merosity})
    if (count && count->high >= 2 && count->high <= 40) return static_cast<int>(std::lround(count->high));
  return std::nullopt;
}

/// The share of the tube in the flower's length, where tube and width of the flower are given.
std::optional<double> tubeOf(const FlowerPreset& flower) {
  if (!flower.tubeLength_m || !flower.diameter_m || flower.tubeLength_m->middle() <= 0) return std::nullopt;
  const double tube = flower.tubeLength_m->middle();
  return std::clamp(tube / (tube + 0.5 * flower.diameter_m->middle()), 0.05, 0.9);
}

template <class Keep>
std::vector<glm::dvec3> coloursWhere(const Traits& traits, Keep keep) {
  std::vector<glm::dvec3> colours;
  for (const Trait& trait : traits)
    if (trait.property == "colour" && isHeld(trait) && keep(trait))
      if (const auto colour = colourNamed(trait.value)) colours.push_back(shaded(*colour, trait));
  return colours;
}

}  // namespace

std::optional<glm::dvec3> colourNamed(std::string_view name) {
  const Concept* entry = entryOf("colour", name);
  if (entry == nullptr || !entry->columns.contains("rgb")) return std::nullopt;
  const std::vector<std::string> pieces = splitList(entry->columns.at("rgb"), ' ');
  if (pieces.size() != 3) return std::nullopt;
  glm::dvec3 colour{0};
  for (int i = 0; i < 3; ++i) colour[i] = srgbOf(parseNumber(pieces[static_cast<std::size_t>(i)]).value_or(0));
  return colour;
}

std::vector<glm::dvec3> leafColours(const Traits& traits) {
  return coloursWhere(traits, [&](const Trait& t) { return isOneOf(t.organ, {"leaf", "leaflet"}) && !isSpot(traits, t); });
}
std::vector<glm::dvec3> flowerColours(const Traits& traits) {
  return coloursWhere(traits, [](const Trait& t) { return isOneOf(t.organ, {"flower", "corolla", "petal", "perianth", "tepal", "ray floret", "inflorescence"}); });
}
std::vector<glm::dvec3> fruitColours(const Traits& traits) {
  return coloursWhere(traits, [](const Trait& t) { return t.organ == "fruit"; });
}

std::string leafModelOf(const Traits& traits, const Presets& presets) {
  const LeafPreset& leaf = presets.leaf;
  const bool compound = organs::leafTypeNamed(leaf.type).has_value();
  const std::string leaflet = drawnShapeOf(leaf.leafletShape);
  const std::string shape = compound && !leaflet.empty() ? leaflet : presets.leafShape;
  ModelText model(shape.empty() ? "defaultleaf" : shape);
  model.add("apex", apexOf(traits, presets));
  model.add("base", featureWord(LeafFeature::Base, leaf.base));
  model.add("margin", featureWord(LeafFeature::Margin, leaf.margin));
  model.add("veins", featureWord(LeafFeature::Veins, leaf.venation));
  const auto ratio = compound ? ratioOf(leaf.leafletLength_m, leaf.leafletWidth_m) : ratioOf(leaf.length_m, leaf.width_m);
  if (ratio) model.add("width", percent(*ratio));
  if (compound) addLeaflets(model, leaf);
  for (const Trait& trait : traits)
    if (isSpot(traits, trait)) {
      model.add("spots", "22 " + hexOf(colourNamed(trait.value).value_or(glm::dvec3(0.9))));
      break;
    }
  return model.text() == "defaultleaf" ? std::string() : model.text();
}

std::string flowerModelOf(const Traits& traits, const Presets& presets) {
  const FlowerPreset& flower = presets.flower;
  const std::optional<int> petals = petalsOf(flower);
  const bool isDouble = std::any_of(traits.begin(), traits.end(), [](const Trait& t) { return t.value == "double" && isHeld(t); });
  std::string shape = flowerShapeOf(flower, petals);
  if (isDouble && shape.empty()) shape = "rose";
  const std::string petal = drawnShapeOf(flower.petalShape);
  if (shape.empty() && petal.empty()) return {};
  ModelText model(shape.empty() ? "defaultflower" : shape);
  const auto drawn = organs::flowerShapeNamed(shape);
  if (petals && drawn && drawn->petals != *petals) model.add("petals", std::to_string(*petals));
  if (isDouble && drawn && drawn->whorls == 1) model.add("double", "4");
  model.add("petal", petal);
  if (const auto tube = tubeOf(flower); tube && drawn && drawn->tube > 0.3) model.add("tube", percent(*tube));
  return model.text();
}

std::string fruitModelOf(const Presets& presets) {
  const std::string shape = organs::fruitShapeNamed(presets.fruit.form) ? presets.fruit.form : presets.fruit.type;
  return organs::fruitShapeNamed(shape) ? shape : std::string();
}

}  // namespace axil::keywords
