#include "ui/trait_words.hpp"

#include "base/text.hpp"
#include "keywords/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace axil::ui {
namespace {

using keywords::Category;
using keywords::Concept;

/// Tables that are no properties of an organ.
constexpr std::array<std::string_view, 6> kNoProperties = {"organ", "which", "unit", "dimension", "stop", "foreign"};

bool isProperty(const Category& category) { return std::find(kNoProperties.begin(), kNoProperties.end(), category.property) == kNoProperties.end(); }

/// The table that a fact of this kind takes its values from: kinds of leaves, inflorescences and fruits are three tables of one name.
const Category* tableOf(std::string_view organ, std::string_view property) {
  const Category* any = nullptr;
  for (const Category& category : keywords::vocabulary()) {
    if (category.property != property || !isProperty(category)) continue;
    if (category.defaultOrgan == organ) return &category;
    if (any == nullptr) any = &category;
  }
  return any;
}

std::string wordOf(const Concept& known, Language language) {
  const auto& terms = language == Language::TraditionalChinese ? known.traditional : known.simplified;
  return language == Language::English || terms.empty() ? known.name : terms.front().words;
}

std::string wordIn(const Category* table, const std::string& name, Language language) {
  if (table == nullptr) return name;
  const auto found = std::find_if(table->concepts.begin(), table->concepts.end(), [&](const Concept& c) { return c.name == name; });
  return found == table->concepts.end() ? name : wordOf(*found, language);
}

std::vector<FactKind> allKinds() {
  std::vector<FactKind> kinds;
  for (const Category& category : keywords::vocabulary())
    if (isProperty(category)) kinds.push_back({category.defaultOrgan, category.property});
  for (const auto& [organ, property] : {std::pair{"leaf", "length"}, {"leaf", "width"}, {"petiole", "length"}, {"plant", "height"}, {"internode", "length"},
                                        {"flower", "diameter"}, {"fruit", "length"}})
    kinds.push_back({organ, property, true});
  return kinds;
}

}  // namespace

const std::vector<FactKind>& factKinds() {
  static const std::vector<FactKind> kinds = allKinds();
  return kinds;
}

std::vector<std::string> valuesOf(std::string_view organ, std::string_view property) {
  std::vector<std::string> names;
  if (const Category* table = tableOf(organ, property))
    for (const Concept& known : table->concepts) names.push_back(known.name);
  return names;
}

std::string valueWord(std::string_view organ, std::string_view property, const std::string& value, Language language) {
  return wordIn(tableOf(organ, property), value, language);
}

std::string valueWord(const keywords::Trait& trait, Language language) {
  if (!trait.low) return valueWord(trait.organ, trait.property, trait.value, language);
  const auto number = [](double v) { return shortest(roundedTo(v, 4)); };
  const std::string unit = trait.unit.empty() ? "" : " " + trait.unit;
  return number(*trait.low) + (trait.high && trait.high != trait.low ? " – " + number(*trait.high) : "") + unit;
}

std::string organWord(const std::string& organ, Language language) { return wordIn(&keywords::categoryOf("organ"), organ, language); }

}  // namespace axil::ui
