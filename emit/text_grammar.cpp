#include "emit/text_grammar.hpp"

#include "base/source.hpp"
#include "base/text.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"

#include <algorithm>
#include <cmath>

namespace axil::emit {

namespace {

std::string colourAttribute(const std::optional<glm::dvec3>& colour) {
  if (!colour) return {};
  return "ColorFront = RGBA(" + num(colour->r) + ", " + num(colour->g) + ", " + num(colour->b) + ", 1); ";
}

/// A name in quotes; a quote within is doubled, a line break becomes a blank.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + "\"";
}

std::string block(const char* name, const std::string& stages) { return stages.empty() ? "" : std::string("        ") + name + " {\n" + stages + "        }\n"; }

}  // namespace

std::string num(double value) {
  if (!std::isfinite(value) || value == 0) return "0";
  const int decimals = std::clamp(5 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 9);
  std::string text = fixed(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string turn(double rotr_rad, double rotu_rad) { return "rotr(" + num(rotr_rad) + ")rotu(" + num(rotu_rad) + ")"; }

std::string stemStage(int number, const std::string& arguments, const std::string& length, double radius, double growTime, const std::string& more, const glm::dvec3& colour) {
  const std::string time = num(growTime);
  return "            Stage " + std::to_string(number) + arguments + " { GrowRate = (" + length + ")/" + time + "; GrowTime = " + time + "; BroadenRate = " +
         num(radius / simeco::modelRadius / growTime) + "; " + more + colourAttribute(colour) + "}\n";
}

std::string leafStage(int number, const std::string& model, double length, double growTime, const std::optional<glm::dvec3>& colour, const std::string& more) {
  const std::string time = num(growTime);
  return "            Stage " + std::to_string(number) + " { Model = " + quoted(model + ".i") + "; GrowRate = " + num(length / growTime) + "*random(0.9, 1.1); GrowTime = " + time +
         "; UnfoldTime = " + time + "; " + more + colourAttribute(colour) + "}\n";
}

std::string flowerStage(int number, const std::string& model, double length, double growTime, const std::optional<glm::dvec3>& colour, const std::string& more) {
  const std::string time = num(growTime);
  return "            Stage " + std::to_string(number) + " { Model = " + quoted(model + ".i") + "; GrowRate = " + num(length / growTime) + "; GrowTime = " + time +
         "; UnfoldTime = " + time + "; " + more + colourAttribute(colour) + "}\n";
}

Result<simeco::Grammar> grammarOf(const PlantText& plant) {
  std::string text = plant.heading + "EcoSystem 1.1 " + quoted(plant.name) + " {\n    Plant " + quoted(plant.name) + " {\n        DeriveTime = 1;\n" + plant.attributes;
  text += block("Stem", plant.stems) + block("Leaf", plant.leaves) + block("Fruit", plant.fruits) + block("Flower", plant.flowers);
  text += "        Grow {\n";
  if (plant.steps > 0) text += "            steps = " + std::to_string(plant.steps) + ";\n";
  text += "            w = " + plant.axiom + ";\n" + plant.rules;
  if (!plant.decomposition.empty()) text += "            decomposition {\n                depth = 400;\n" + plant.decomposition + "            }\n";
  text += "        }\n    }\n}\n";
  simeco::Parsed parsed = simeco::parseSimeco(text);
  simeco::addChecked(parsed);
  if (parsed.ok()) return std::move(parsed.grammar);
  Error error{ErrorCode::BadGrammar, "the pattern of a described plant does not read as SimEco; please report it with the description", {}};
  for (const Diagnostic& d : parsed.diagnostics) error.details.push_back(formatDiagnostic(d, text, "described"));
  return fail(std::move(error));
}

}  // namespace axil::emit
