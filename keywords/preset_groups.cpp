#include "keywords/preset_groups.hpp"

#include "base/text.hpp"
#include "keywords/presets.hpp"
#include "keywords/vocabulary.hpp"
#include "keywords/words.hpp"

#include <algorithm>
#include <initializer_list>

namespace axil::keywords {

namespace {

/// Which statements a preset is taken from: of the whole organ or of that piece of it.
struct Wanted {
  std::string_view organ;
  std::string_view property;
  std::string_view part = "";
  std::string_view unit = "";
};

constexpr std::string_view anyPart = "*";
using Choices = std::initializer_list<Wanted>;  // the first that the text answers

bool isDoubtful(const Trait& trait) { return isOneOf(trait.qualifier, {"rarely", "sometimes"}); }

// The whole organ ("blade" is the leaf itself) or that piece of it; staminate and basal ones only where nothing else is said.
const Trait* firstOf(const Traits& traits, const Wanted& wanted) {
  const Trait* special = nullptr;
  for (const Trait& trait : traits) {
    const std::string_view part = trait.part == "blade" || trait.part == "surface" ? std::string_view{} : std::string_view(trait.part);
    const bool same = trait.organ == wanted.organ && trait.property == wanted.property && (part == wanted.part || wanted.part == anyPart) && (wanted.unit.empty() || trait.unit == wanted.unit);
    if (!same || isDoubtful(trait)) continue;
    if (trait.which.empty()) return &trait;
    if (special == nullptr) special = &trait;
  }
  return special;
}

std::optional<double> metresPer(const std::string& unit) {
  for (const Concept& entry : categoryOf("unit").concepts)
    if (entry.name == unit) return parseNumber(entry.columns.at("metres"));
  return std::nullopt;
}

PresetRange rangeOf(const Trait& trait, double factor) {
  const double high = trait.high.value_or(0);
  const double low = trait.low.value_or(0);
  return {trait.minimum.value_or(low) * factor, low * factor, high * factor, trait.maximum.value_or(high) * factor};
}

class Setter {
 public:
  Setter(Presets& presets, const Traits& traits) : presets_(presets), traits_(traits) {}

  void word(std::string& member, const char* name, Choices choices) {
    for (const Wanted& wanted : choices) {
      const Trait* trait = firstOf(traits_, wanted);
      if (trait == nullptr || trait->value.empty()) continue;
      member = trait->value;
      return remember(presets_, name, *trait);
    }
  }

  void number(std::optional<PresetRange>& member, const char* name, Choices choices) {
    for (const Wanted& wanted : choices) {
      const Trait* trait = firstOf(traits_, wanted);
      if (trait == nullptr || !trait->high) continue;
      member = rangeOf(*trait, trait->unit == "pairs" ? 2 : 1);
      return remember(presets_, name, *trait);
    }
  }

  void size(std::optional<PresetRange>& member, const char* name, Choices choices) {
    for (const Wanted& wanted : choices) {
      const Trait* trait = firstOf(traits_, wanted);
      const std::optional<double> metres = trait == nullptr || !trait->high ? std::nullopt : metresPer(trait->unit);
      if (!metres) continue;
      member = rangeOf(*trait, *metres);
      return remember(presets_, name, *trait);
    }
  }

  // The first statement among `values` of a category, by the column that says what draws it.
  void drawn(std::string& member, const char* name, std::string_view organ, std::string_view property, std::string_view defaultOrgan, const std::string& column) {
    for (const Trait& trait : traits_) {
      if (trait.property != property || isDoubtful(trait) || (!organ.empty() && trait.organ != organ)) continue;
      for (const Category& category : vocabulary()) {
        if (category.property != property || category.defaultOrgan != defaultOrgan) continue;
        for (const Concept& entry : category.concepts)
          if (entry.name == trait.value && entry.columns.contains(column)) {
            member = entry.columns.at(column);
            remember(presets_, name, trait);
            return;
          }
      }
    }
  }

  void oneOf(std::string& member, const char* name, std::string_view property, Words values) {
    for (const Trait& trait : traits_)
      if (trait.property == property && !isDoubtful(trait) && isOneOf(trait.value, values)) {
        member = trait.value;
        remember(presets_, name, trait);
        return;
      }
  }

 private:
  Presets& presets_;
  const Traits& traits_;
};

void setLeaf(Setter& set, LeafPreset& leaf) {
  set.word(leaf.type, "leaf.type", {{"leaf", "type"}, {"leaf", "type", anyPart}});
  // Of a compound leaf the leaflets have the tip, the foot and the edge.
  set.word(leaf.apex, "leaf.apex", {{"leaf", "apex"}, {"leaflet", "apex"}, {"leaf", "apex", anyPart}});
  set.word(leaf.base, "leaf.base", {{"leaf", "base"}, {"leaflet", "base"}, {"leaf", "base", anyPart}});
  set.word(leaf.margin, "leaf.margin", {{"leaf", "margin"}, {"leaflet", "margin"}, {"leaf", "margin", anyPart}});
  set.word(leaf.venation, "leaf.venation", {{"leaf", "venation"}, {"leaflet", "venation"}, {"vein", "venation"}});
  set.word(leaf.attachment, "leaf.attachment", {{"leaf", "attachment"}});
  set.word(leaf.colour, "leaf.colour", {{"leaf", "colour"}, {"leaflet", "colour"}});
  set.size(leaf.length_m, "leaf.length_m", {{"leaf", "length"}});
  set.size(leaf.width_m, "leaf.width_m", {{"leaf", "width"}});
  set.size(leaf.petiole_m, "leaf.petiole_m", {{"petiole", "length"}});
  set.number(leaf.angle_deg, "leaf.angle_deg", {{"leaf", "angle"}});
  set.number(leaf.leaflets, "leaf.leaflets", {{"leaflet", "count"}});
  set.word(leaf.leafletShape, "leaf.leafletShape", {{"leaflet", "shape"}});
  set.size(leaf.leafletLength_m, "leaf.leafletLength_m", {{"leaflet", "length"}});
  set.size(leaf.leafletWidth_m, "leaf.leafletWidth_m", {{"leaflet", "width"}});
  set.number(leaf.lobes, "leaf.lobes", {{"leaf", "count", "lobe"}});
  // 5-8 pairs and one at the end.
  if (leaf.type == "odd-pinnate" && leaf.leaflets && static_cast<long>(leaf.leaflets->low) % 2 == 0)
    for (double* number : {&leaf.leaflets->minimum, &leaf.leaflets->low, &leaf.leaflets->high, &leaf.leaflets->maximum}) *number += 1;
}

void setPlant(Setter& set, PlantPreset& plant) {
  set.word(plant.lifeForm, "plant.lifeForm", {{"plant", "life form"}});
  set.oneOf(plant.duration, "plant.duration", "duration", {"annual", "biennial", "perennial", "evergreen", "deciduous"});
  set.word(plant.habit, "plant.habit", {{"plant", "habit"}, {"stem", "habit"}});
  set.oneOf(plant.branching, "plant.branching", "habit", {"monopodial", "sympodial", "dichotomous", "tufted"});
  set.size(plant.height_m, "plant.height_m", {{"plant", "height"}, {"stem", "height"}});
  set.number(plant.branchAngle_deg, "plant.branchAngle_deg", {{"branch", "angle"}});
  set.word(plant.stemSection, "plant.stemSection", {{"stem", "section"}, {"branch", "section"}});
}

void setFlower(Setter& set, FlowerPreset& flower) {
  set.drawn(flower.form, "flower.form", "", "form", "flower", "shape");
  set.oneOf(flower.symmetry, "flower.symmetry", "form", {"actinomorphic", "zygomorphic"});
  set.number(flower.merosity, "flower.merosity", {{"flower", "merosity"}, {"corolla", "merosity"}});
  set.number(flower.petals, "flower.petals", {{"petal", "count"}, {"tepal", "count"}, {"corolla", "count", "lobe"}});
  set.number(flower.sepals, "flower.sepals", {{"sepal", "count"}, {"calyx", "count", "lobe"}});
  set.number(flower.stamens, "flower.stamens", {{"stamen", "count"}});
  set.word(flower.petalShape, "flower.petalShape", {{"petal", "shape"}, {"corolla", "shape", "lobe"}, {"corolla", "shape", anyPart}});
  set.word(flower.colour, "flower.colour", {{"petal", "colour"}, {"corolla", "colour"}, {"flower", "colour"}, {"tepal", "colour"}});
  set.size(flower.petalLength_m, "flower.petalLength_m", {{"petal", "length"}});
  set.size(flower.tubeLength_m, "flower.tubeLength_m", {{"corolla", "length", "tube"}});
  set.size(flower.diameter_m, "flower.diameter_m", {{"flower", "diameter"}, {"corolla", "diameter", anyPart}});
  set.word(flower.inflorescence, "flower.inflorescence", {{"inflorescence", "type"}});
  set.word(flower.position, "flower.position", {{"inflorescence", "position"}, {"flower", "position"}});
  set.size(flower.inflorescenceLength_m, "flower.inflorescenceLength_m", {{"inflorescence", "length"}});
  set.number(flower.flowersPerInflorescence, "flower.flowersPerInflorescence", {{"flower", "count"}});
}

void setFruit(Setter& set, FruitPreset& fruit) {
  set.word(fruit.type, "fruit.type", {{"fruit", "type"}});
  set.drawn(fruit.form, "fruit.form", "fruit", "type", "fruit", "shape");
  set.word(fruit.shape, "fruit.shape", {{"fruit", "shape"}});
  set.word(fruit.colour, "fruit.colour", {{"fruit", "colour"}});
  set.size(fruit.length_m, "fruit.length_m", {{"fruit", "length"}});
  set.size(fruit.diameter_m, "fruit.diameter_m", {{"fruit", "diameter"}});
}

}  // namespace

void remember(Presets& presets, const std::string& name, const Trait& trait) {
  presets.evidence[name] = trait.text;
  presets.places[name] = {trait.start, trait.end};
}

void setGroups(Presets& presets, const Traits& traits) {
  Setter set(presets, traits);
  setLeaf(set, presets.leaf);
  setPlant(set, presets.plant);
  setFlower(set, presets.flower);
  setFruit(set, presets.fruit);
}

}  // namespace axil::keywords
