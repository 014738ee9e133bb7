#include "keywords/report.hpp"

#include "base/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace axil::keywords {

namespace {

using Json = nlohmann::ordered_json;

// Whole numbers print as such: 3, not 3.0.
Json numberJson(double number) {
  if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<long long>(number);
  return number;
}

void put(Json& json, const char* key, const std::optional<double>& number) {
  if (number) json[key] = numberJson(*number);
}

void put(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json traitJson(const Trait& trait) {
  Json json;
  json["organ"] = trait.organ;
  json["property"] = trait.property;
  put(json, "value", trait.value);
  put(json, "minimum", trait.minimum);
  put(json, "low", trait.low);
  put(json, "high", trait.high);
  put(json, "maximum", trait.maximum);
  put(json, "unit", trait.unit);
  put(json, "qualifier", trait.qualifier);
  json["text"] = trait.text;
  json["start"] = trait.start;
  json["end"] = trait.end;
  return json;
}

// Degrees as they were meant: 137.50776405, not the last bits of a conversion.
double degreesOf(Angle angle) { return roundedTo(angle.degrees(), 8); }

Json presetsJson(const Presets& presets) {
  Json json = Json::object();
  if (presets.arrangement)
    json["arrangement"] = {{"name", presets.arrangement->name},
                           {"leavesPerNode", presets.arrangement->leavesPerNode},
                           {"divergence_deg", numberJson(degreesOf(presets.arrangement->divergence))},
                           {"clustered", presets.arrangement->clustered}};
  put(json, "leafShape", presets.leafShape);
  if (presets.leafLength_m) json["leafLength_m"] = roundedTo(*presets.leafLength_m, 9);
  if (presets.leafWidth_m) json["leafWidth_m"] = roundedTo(*presets.leafWidth_m, 9);
  json["evidence"] = presets.evidence;
  return json;
}

std::string rangeText(const Trait& trait) {
  std::string text;
  if (trait.minimum) text += "(" + shortest(*trait.minimum) + "-)";
  if (trait.low) text += shortest(*trait.low);
  if (trait.high && trait.low != trait.high) text += (trait.low ? "-" : "up to ") + shortest(*trait.high);
  if (trait.maximum) text += "(-" + shortest(*trait.maximum) + ")";
  return trait.unit.empty() ? text : text + " " + trait.unit;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string traitLine(const Trait& trait) {
  std::string what = trait.value.empty() ? rangeText(trait) : trait.value;
  if (!trait.qualifier.empty() && trait.qualifier != "up to") what = trait.qualifier + " " + what;
  std::string quoted = trait.text;
  std::replace(quoted.begin(), quoted.end(), '\n', ' ');
  return padded(trait.organ, 14) + padded(trait.property, 13) + padded(what, 26) + "\"" + quoted + "\" at " + std::to_string(trait.start) + "-" +
         std::to_string(trait.end) + "\n";
}

std::string presetLines(const Presets& presets) {
  const auto line = [&](const char* name, const std::string& value) {
    const auto evidence = presets.evidence.find(name);
    return "  " + padded(name, 15) + padded(value, 44) + (evidence == presets.evidence.end() ? "" : "from \"" + evidence->second + "\"") + "\n";
  };
  std::string text;
  if (presets.arrangement)
    text += line("arrangement", presets.arrangement->name + ", " + std::to_string(presets.arrangement->leavesPerNode) + " per node, " +
                                    shortest(degreesOf(presets.arrangement->divergence)) + " degrees");
  if (!presets.leafShape.empty()) text += line("leafShape", presets.leafShape);
  if (presets.leafLength_m) text += line("leafLength_m", shortest(roundedTo(*presets.leafLength_m, 9)));
  if (presets.leafWidth_m) text += line("leafWidth_m", shortest(roundedTo(*presets.leafWidth_m, 9)));
  return text;
}

}  // namespace

std::string traitsJson(const Traits& traits, const Presets& presets) {
  Json json;
  json["traits"] = Json::array();
  for (const Trait& trait : traits) json["traits"].push_back(traitJson(trait));
  json["presets"] = presetsJson(presets);
  return json.dump(2) + "\n";
}

std::string traitsText(const Traits& traits, const Presets& presets) {
  if (traits.empty()) return "No traits found.\n";
  std::string text;
  for (const Trait& trait : traits) text += traitLine(trait);
  const std::string lines = presetLines(presets);
  return lines.empty() ? text : text + "These set:\n" + lines;
}

}  // namespace axil::keywords
