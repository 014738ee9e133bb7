#include "keywords/presets.hpp"

#include "base/result.hpp"
#include "base/table.hpp"
#include "base/text.hpp"
#include "keywords/lexicon.hpp"
#include "keywords/models.hpp"
#include "keywords/preset_groups.hpp"
#include "keywords/vocabulary.hpp"
#include "organs/leaf.hpp"

#include <algorithm>
#include <cmath>

namespace axil::keywords {

namespace {

constexpr int mostLeavesPerNode = 1000;

double numberIn(const Concept& entry, std::string_view column) {
  const auto cell = entry.columns.find(std::string(column));
  AXIL_ASSERT(cell != entry.columns.end(), "a concept of the vocabulary lacks a number");
  const std::optional<double> number = parseNumber(cell->second);
  AXIL_ASSERT(number.has_value(), "a number of the vocabulary is none");
  return *number;
}

std::vector<Angle> cycleFrom(const Concept& entry) {
  std::vector<Angle> cycle;
  const auto cell = entry.columns.find("cycle_deg");
  if (cell == entry.columns.end()) return cycle;
  for (const std::string& turn : splitList(cell->second, ',')) cycle.push_back(Angle::fromDegrees(parseNumber(turn).value_or(0)));
  return cycle;
}

ArrangementPreset presetFrom(const Concept& entry) {
  return {entry.name, static_cast<int>(numberIn(entry, "leavesPerNode")), Angle::fromDegrees(numberIn(entry, "divergence_deg")),
          entry.columns.at("clustered") == "yes", cycleFrom(entry)};
}

const Concept* conceptNamed(std::string_view property, std::string_view name) {
  for (const Concept& entry : categoryOf(property).concepts)
    if (entry.name == name) return &entry;
  return nullptr;
}

bool isDoubtful(const Trait& trait) { return trait.qualifier == "rarely" || trait.qualifier == "sometimes"; }

// Of the leaf itself, not of its lobes.
bool isLeaf(const Trait& trait, std::string_view property) {
  const bool whole = trait.part.empty() || trait.part == "blade" || trait.part == "surface";
  return trait.organ == "leaf" && trait.property == property && whole && !isDoubtful(trait);
}

bool refines(const Trait& precise, const Trait& wide) {
  const Concept* entry = conceptNamed("arrangement", precise.value);
  if (entry == nullptr) return false;
  const auto cell = entry->columns.find("refines");
  return cell != entry->columns.end() && cell->second == wide.value;
}

const Trait* firstOf(const Traits& traits, std::string_view property) {
  const auto found = std::find_if(traits.begin(), traits.end(), [&](const Trait& t) { return isLeaf(t, property); });
  return found == traits.end() ? nullptr : &*found;
}

void setArrangement(Presets& presets, const Traits& traits) {
  const Trait* chosen = firstOf(traits, "arrangement");
  if (chosen == nullptr) return;
  for (const Trait& trait : traits)
    if (isLeaf(trait, "arrangement") && refines(trait, *chosen)) chosen = &trait;
  const Concept* entry = conceptNamed("arrangement", chosen->value);
  AXIL_ASSERT(entry != nullptr, "a trait names an arrangement that the vocabulary does not have");
  presets.arrangement = presetFrom(*entry);
  remember(presets, "arrangement", *chosen);
}

void setLeavesPerNode(Presets& presets, const Traits& traits) {
  if (!presets.arrangement || presets.arrangement->name != "whorled") return;
  for (const Trait& trait : traits)
    if (isLeaf(trait, "count") && trait.unit == "per node" && trait.low && *trait.low >= 1 && *trait.low <= mostLeavesPerNode) {
      presets.arrangement = withLeavesPerNode(*presets.arrangement, static_cast<int>(std::lround(0.5 * (*trait.low + *trait.high))));
      remember(presets, "leavesPerNode", trait);
      return;
    }
}

void setShape(Presets& presets, const Traits& traits) {
  for (const Trait& trait : traits) {
    if (!isLeaf(trait, "shape")) continue;
    const std::string drawn = drawnShapeOf(trait.value);
    if (drawn.empty()) continue;
    presets.leafShape = drawn;
    remember(presets, "leafShape", trait);
    return;
  }
}

std::optional<double> metresOf(const Trait& trait) {
  const Concept* unit = trait.unit.empty() ? nullptr : conceptNamed("unit", trait.unit);
  if (unit == nullptr || !trait.high) return std::nullopt;
  return 0.5 * (trait.low.value_or(*trait.high) + *trait.high) * numberIn(*unit, "metres");
}

void setSize(std::optional<double>& preset, Presets& presets, const char* name, const Traits& traits, std::string_view property) {
  const Trait* size = firstOf(traits, property);
  if (size == nullptr) return;
  preset = metresOf(*size);
  if (preset) remember(presets, name, *size);
}

// "whorled 4", "輪生4": the name, and the number after it.
struct NameAndCount {
  std::string name;
  std::optional<double> count;
};

NameAndCount splitCount(std::string_view text) {
  const std::size_t last = text.find_last_not_of("0123456789");
  if (last == std::string_view::npos || last + 1 == text.size()) return {std::string(text), std::nullopt};
  return {std::string(text.substr(0, last + 1)), parseNumber(text.substr(last + 1))};
}

}  // namespace

std::string drawnShapeOf(std::string_view value) {
  std::string drawn;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find('-', begin), value.size());
    const Concept* entry = conceptNamed("shape", value.substr(begin, end - begin));
    const bool isFlat = entry != nullptr && entry->columns.contains("shape");
    if (isFlat && organs::leafShapeNamed(entry->columns.at("shape"))) drawn = entry->columns.at("shape");
    begin = end + 1;
  }
  return drawn;
}

std::vector<std::string> arrangementNames() {
  std::vector<std::string> names;
  for (const Concept& entry : categoryOf("arrangement").concepts) names.push_back(entry.name);
  return names;
}

Angle turnOfNode(const ArrangementPreset& preset, std::size_t k) {
  if (preset.cycle.empty()) return preset.divergence * static_cast<double>(k);
  Angle round;
  for (const Angle turn : preset.cycle) round += turn;
  Angle sum = round * static_cast<double>(k / preset.cycle.size());
  for (std::size_t i = 0; i < k % preset.cycle.size(); ++i) sum += preset.cycle[i];
  return sum;
}

ArrangementPreset withLeavesPerNode(ArrangementPreset preset, int leavesPerNode) {
  preset.leavesPerNode = std::clamp(leavesPerNode, 1, mostLeavesPerNode);
  if (preset.name == "whorled") preset.divergence = Angle::fromDegrees(180.0 / preset.leavesPerNode);
  return preset;
}

std::optional<ArrangementPreset> arrangementNamed(std::string_view name) {
  if (!isUtf8(name)) return std::nullopt;
  const NameAndCount split = splitCount(name);
  const std::vector<std::string> words = wordsOf(split.name);
  if (const Concept* entry = conceptNamed("arrangement", name)) return presetFrom(*entry);
  for (const Concept& entry : categoryOf("arrangement").concepts)
    for (const std::vector<Term>* terms : {&entry.english, &entry.traditional, &entry.simplified})
      for (const Term& term : *terms) {
        if (wordsOf(term.words) != words) continue;
        const ArrangementPreset preset = presetFrom(entry);
        if (!split.count) return preset;
        if (*split.count < 1 || *split.count > mostLeavesPerNode) return std::nullopt;
        return withLeavesPerNode(preset, static_cast<int>(*split.count));
      }
  return std::nullopt;
}

Presets presetsOf(const Traits& traits) {
  Presets presets;
  setArrangement(presets, traits);
  setLeavesPerNode(presets, traits);
  setShape(presets, traits);
  setSize(presets.leafLength_m, presets, "leafLength_m", traits, "length");
  setSize(presets.leafWidth_m, presets, "leafWidth_m", traits, "width");
  setGroups(presets, traits);
  presets.leafModel = leafModelOf(traits, presets);
  return presets;
}

}  // namespace axil::keywords
