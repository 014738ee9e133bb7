#include "keywords/report.hpp"

#include "base/text.hpp"
#include "keywords/vocabulary.hpp"
#include "keywords/words.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

// The Plant Ontology's or PATO's name of a concept; empty where there is none ("ovate-lanceolate" is two).
std::string idOf(std::string_view property, const std::string& name) {
  using Ids = std::map<std::pair<std::string, std::string>, std::string, std::less<>>;
  static const Ids ids = [] {
    Ids all;
    for (const Category& category : vocabulary())
      for (const Concept& entry : category.concepts)
        if (const auto id = entry.columns.find("id"); id != entry.columns.end()) all.emplace(std::pair(category.property, entry.name), id->second);
    return all;
  }();
  const auto found = name.empty() ? ids.end() : ids.find(std::pair(std::string(property), name));
  return found == ids.end() ? std::string() : found->second;
}

Json traitJson(const Trait& trait) {
  Json json;
  json["organ"] = trait.organ;
  json["property"] = trait.property;
  put(json, "organ_id", idOf("organ", trait.organ));
  put(json, "value", trait.value);
  put(json, "id", idOf(trait.property, trait.value));
  put(json, "minimum", trait.minimum);
  put(json, "low", trait.low);
  put(json, "high", trait.high);
  put(json, "maximum", trait.maximum);
  put(json, "unit", trait.unit);
  put(json, "qualifier", trait.qualifier);
  put(json, "part", trait.part);
  put(json, "which", trait.which);
  json["text"] = trait.text;
  json["start"] = trait.start;
  json["end"] = trait.end;
  return json;
}

// Degrees as they were meant: 137.50776405, not the last bits of a conversion.
double degreesOf(Angle angle) { return roundedTo(angle.degrees(), 8); }

// Every member of the four groups by its name, as evidence names them; one list for JSON and for people.
template <class Word, class Range>
void visitGroups(const Presets& p, const Word& word, const Range& range) {
  word("leaf.type", p.leaf.type);
  word("leaf.apex", p.leaf.apex);
  word("leaf.base", p.leaf.base);
  word("leaf.margin", p.leaf.margin);
  word("leaf.venation", p.leaf.venation);
  word("leaf.attachment", p.leaf.attachment);
  word("leaf.colour", p.leaf.colour);
  range("leaf.length_m", p.leaf.length_m);
  range("leaf.width_m", p.leaf.width_m);
  range("leaf.petiole_m", p.leaf.petiole_m);
  range("leaf.angle_deg", p.leaf.angle_deg);
  range("leaf.leaflets", p.leaf.leaflets);
  word("leaf.leafletShape", p.leaf.leafletShape);
  range("leaf.leafletLength_m", p.leaf.leafletLength_m);
  range("leaf.leafletWidth_m", p.leaf.leafletWidth_m);
  range("leaf.lobes", p.leaf.lobes);
  word("plant.lifeForm", p.plant.lifeForm);
  word("plant.duration", p.plant.duration);
  word("plant.habit", p.plant.habit);
  word("plant.branching", p.plant.branching);
  range("plant.height_m", p.plant.height_m);
  range("plant.branchAngle_deg", p.plant.branchAngle_deg);
  word("plant.stemSection", p.plant.stemSection);
  word("flower.form", p.flower.form);
  word("flower.symmetry", p.flower.symmetry);
  range("flower.merosity", p.flower.merosity);
  range("flower.petals", p.flower.petals);
  range("flower.sepals", p.flower.sepals);
  range("flower.stamens", p.flower.stamens);
  word("flower.petalShape", p.flower.petalShape);
  word("flower.colour", p.flower.colour);
  range("flower.petalLength_m", p.flower.petalLength_m);
  range("flower.tubeLength_m", p.flower.tubeLength_m);
  range("flower.diameter_m", p.flower.diameter_m);
  word("flower.inflorescence", p.flower.inflorescence);
  word("flower.position", p.flower.position);
  range("flower.inflorescenceLength_m", p.flower.inflorescenceLength_m);
  range("flower.flowersPerInflorescence", p.flower.flowersPerInflorescence);
  word("fruit.type", p.fruit.type);
  word("fruit.form", p.fruit.form);
  word("fruit.shape", p.fruit.shape);
  word("fruit.colour", p.fruit.colour);
  range("fruit.length_m", p.fruit.length_m);
  range("fruit.diameter_m", p.fruit.diameter_m);
}

Json presetRangeJson(const PresetRange& range) {
  const auto number = [](double value) { return numberJson(roundedTo(value, 9)); };
  return {{"minimum", number(range.minimum)}, {"low", number(range.low)}, {"high", number(range.high)}, {"maximum", number(range.maximum)}};
}

Json presetsJson(const Presets& presets) {
  Json json = Json::object();
  if (presets.arrangement) {
    json["arrangement"] = {{"name", presets.arrangement->name},
                           {"leavesPerNode", presets.arrangement->leavesPerNode},
                           {"divergence_deg", numberJson(degreesOf(presets.arrangement->divergence))},
                           {"clustered", presets.arrangement->clustered}};
    for (const Angle turn : presets.arrangement->cycle) json["arrangement"]["cycle_deg"].push_back(numberJson(degreesOf(turn)));
  }
  put(json, "leafShape", presets.leafShape);
  if (presets.leafLength_m) json["leafLength_m"] = roundedTo(*presets.leafLength_m, 9);
  if (presets.leafWidth_m) json["leafWidth_m"] = roundedTo(*presets.leafWidth_m, 9);
  const auto member = [&](const std::string& name) -> Json& { return json[name.substr(0, name.find('.'))][name.substr(name.find('.') + 1)]; };
  visitGroups(
      presets, [&](const char* name, const std::string& value) { if (!value.empty()) member(name) = value; },
      [&](const char* name, const std::optional<PresetRange>& range) { if (range) member(name) = presetRangeJson(*range); });
  json["evidence"] = presets.evidence;
  json["places"] = Json::object();
  for (const auto& [name, place] : presets.places) json["places"][name] = {place.start, place.end};
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
  std::string organ = trait.which.empty() ? trait.organ : trait.which + " " + trait.organ;
  if (!trait.part.empty() && trait.part != "blade") organ += " " + trait.part;
  return padded(organ, 16) + padded(trait.property, 13) + padded(what, 26) + "\"" + quoted + "\" at " + std::to_string(trait.start) + "-" +
         std::to_string(trait.end) + "\n";
}

std::string presetLines(const Presets& presets) {
  const auto line = [&](const char* name, const std::string& value) {
    const auto evidence = presets.evidence.find(name);
    return "  " + padded(name, 32) + padded(value, 40) + (evidence == presets.evidence.end() ? "" : "from \"" + evidence->second + "\"") + "\n";
  };
  std::string text;
  if (presets.arrangement)
    text += line("arrangement", presets.arrangement->name + ", " + std::to_string(presets.arrangement->leavesPerNode) + " per node, " +
                                    shortest(degreesOf(presets.arrangement->divergence)) + " degrees");
  if (!presets.leafShape.empty()) text += line("leafShape", presets.leafShape);
  if (presets.leafLength_m) text += line("leafLength_m", shortest(roundedTo(*presets.leafLength_m, 9)));
  if (presets.leafWidth_m) text += line("leafWidth_m", shortest(roundedTo(*presets.leafWidth_m, 9)));
  const auto rounded = [](double value) { return shortest(roundedTo(value, 9)); };
  visitGroups(
      presets, [&](const char* name, const std::string& value) { if (!value.empty()) text += line(name, value); },
      [&](const char* name, const std::optional<PresetRange>& r) {
        if (!r) return;
        const std::string usual = r->low == r->high ? rounded(r->low) : rounded(r->low) + " to " + rounded(r->high);
        const bool widens = r->minimum != r->low || r->maximum != r->high;
        text += line(name, usual + (widens ? ", at most " + rounded(r->minimum) + " to " + rounded(r->maximum) : ""));
      });
  return text;
}

// `json` as it stands as a member of an object, two blanks in.
std::string indented(const Json& json, std::size_t blanks) {
  std::string text = json.dump(2);
  const std::string margin = "\n" + std::string(blanks, ' ');
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  for (const char c : text) {
    if (c == '\n') out += margin;
    else out += c;
  }
  return out;
}

// A list member of the whole, one entry after another: all of a long text's traits as one tree would need several times their room.
template <class Entries, class ToJson>
void putList(std::string& out, const char* name, const Entries& entries, ToJson toJson) {
  constexpr std::size_t usualBytes = 200;  // an entry; growing by doubling would need twice the room
  out.reserve(out.size() + entries.size() * usualBytes);
  out += std::string("  \"") + name + "\": [";
  bool first = true;
  for (const auto& entry : entries) {
    out += first ? "\n    " : ",\n    ";
    out += indented(toJson(entry), 4);
    first = false;
  }
  out += first ? "]" : "\n  ]";
}

Json unknownJson(const UnknownTerm& term) { return {{"organ", term.organ}, {"text", term.text}, {"start", term.start}, {"end", term.end}}; }

std::string unknownLine(const UnknownTerm& term) {
  return "  " + padded(term.organ, 16) + "\"" + term.text + "\" at " + std::to_string(term.start) + "-" + std::to_string(term.end) + "\n";
}

Json contradictionJson(const Contradiction& c, const Traits& traits) {
  const auto place = [&](std::size_t i) { return Json{traits[i].start, traits[i].end}; };
  return {{"what", c.what}, {"first", place(c.first)}, {"second", place(c.second)}};
}

}  // namespace

std::string traitsJson(const Traits& traits, const Presets& presets) {
  std::string out = "{\n";
  putList(out, "traits", traits, traitJson);
  return out + ",\n  \"presets\": " + indented(presetsJson(presets), 2) + "\n}\n";
}

std::string readingJson(const Reading& reading, const Presets& presets) {
  std::string out = "{\n";
  putList(out, "traits", reading.traits, traitJson);
  out += ",\n  \"presets\": " + indented(presetsJson(presets), 2) + ",\n";
  putList(out, "unknown", reading.unknown, unknownJson);
  out += ",\n";
  putList(out, "contradictions", reading.contradictions, [&](const Contradiction& c) { return contradictionJson(c, reading.traits); });
  return out + "\n}\n";
}

std::string PieceReport::begin() const { return form_ == Form::Json ? "{\n  \"traits\": [" : ""; }

std::string PieceReport::piece(const Reading& reading) {
  const auto add = [](std::string& list, const std::string& entry) { list += (list.empty() ? "\n    " : ",\n    ") + entry; };
  std::string out;
  for (const Trait& trait : reading.traits) {
    if (form_ == Form::Json) out += (anyTrait_ ? ",\n    " : "\n    ") + indented(traitJson(trait), 4);
    else out += traitLine(trait);
    anyTrait_ = true;
  }
  for (const UnknownTerm& term : reading.unknown) {
    if (form_ == Form::Json) add(unknown_, indented(unknownJson(term), 4));
    else unknown_ += unknownLine(term);
  }
  for (const Contradiction& c : reading.contradictions) {
    if (form_ == Form::Json) add(contradictions_, indented(contradictionJson(c, reading.traits), 4));
    else contradictions_ += "  " + c.what + "\n";
  }
  return out;
}

std::string PieceReport::end() const {
  if (form_ == Form::Json) {
    const auto list = [](const char* name, const std::string& entries) { return std::string("  \"") + name + "\": [" + entries + (entries.empty() ? "]" : "\n  ]"); };
    return std::string(anyTrait_ ? "\n  ]" : "]") + ",\n  \"presets\": {},\n" + list("unknown", unknown_) + ",\n" + list("contradictions", contradictions_) + "\n}\n";
  }
  std::string text = anyTrait_ ? "" : "No traits found.\n";
  if (!unknown_.empty()) text += "Seen but not understood:\n" + unknown_;
  if (!contradictions_.empty()) text += "The text contradicts itself (both are kept):\n" + contradictions_;
  return text;
}

std::string vocabularyText() {
  const auto words = [](const std::vector<Term>& terms) {
    std::string list;
    for (const Term& term : terms) list += (list.empty() ? "" : ", ") + term.words;
    return list.empty() ? std::string("-") : list;
  };
  std::string text = "property\tabout\tname\tid\tenglish\ttraditional\tsimplified\tdefinition\n";
  for (const Category& category : vocabulary()) {
    if (isOneOf(category.property, {"stop", "foreign"})) continue;  // words that say what a text is not
    for (const Concept& entry : category.concepts) {
      const auto id = entry.columns.find("id");
      text += category.property + "\t" + (category.defaultOrgan.empty() ? "-" : category.defaultOrgan) + "\t" + entry.name + "\t" + (id == entry.columns.end() ? "-" : id->second) + "\t" +
              words(entry.english) + "\t" + words(entry.traditional) + "\t" + words(entry.simplified) + "\t" + entry.definition + "\n";
    }
  }
  return text;
}

std::string traitsText(const Traits& traits, const Presets& presets) {
  if (traits.empty()) return "No traits found.\n";
  std::string text;
  for (const Trait& trait : traits) text += traitLine(trait);
  const std::string lines = presetLines(presets);
  return lines.empty() ? text : text + "These set:\n" + lines;
}

std::string readingText(const Reading& reading, const Presets& presets) {
  std::string text = traitsText(reading.traits, presets);
  if (!reading.unknown.empty()) text += "Seen but not understood:\n";
  for (const UnknownTerm& term : reading.unknown) text += unknownLine(term);
  if (!reading.contradictions.empty()) text += "The text contradicts itself (both are kept):\n";
  for (const Contradiction& c : reading.contradictions) text += "  " + c.what + "\n";
  return text;
}

}  // namespace axil::keywords
