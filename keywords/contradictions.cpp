#include "keywords/contradictions.hpp"

#include "keywords/presets.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {

constexpr std::size_t mostCompared = 64;  // statements of one kind: beyond that a text is about many plants
constexpr std::size_t mostBetween = 60;   // bytes between two alternatives

bool isExclusive(const Trait& trait) {
  return isOneOf(trait.property, {"arrangement", "duration"}) || (trait.property == "type" && trait.organ == "leaf") || (trait.property == "attachment" && trait.organ == "leaf") ||
         (trait.property == "form" && isOneOf(trait.value, {"actinomorphic", "zygomorphic", "bisexual", "unisexual"}));
}

// Durations speak of three things: years, leaves in winter, parts that stay or fall.
int kindOf(const Trait& trait) {
  if (trait.property == "form") return isOneOf(trait.value, {"actinomorphic", "zygomorphic"}) ? 1 : 2;
  if (trait.property != "duration") return 0;
  if (isOneOf(trait.value, {"annual", "biennial", "perennial"})) return 1;
  return isOneOf(trait.value, {"evergreen", "deciduous"}) ? 2 : 3;
}

bool isDoubtful(const Trait& trait) { return isOneOf(trait.qualifier, {"rarely", "sometimes", "usually"}); }

bool refines(const Trait& a, const Trait& b) {
  for (const Concept& entry : categoryOf("arrangement").concepts) {
    const auto wider = entry.columns.find("refines");
    if (wider == entry.columns.end()) continue;
    if ((entry.name == a.value && wider->second == b.value) || (entry.name == b.value && wider->second == a.value)) return true;
  }
  // "compound, pinnate"; where leaves crowd says nothing about how they turn ("alternate, in a rosette").
  const auto crowds = [](const Trait& t) { return isOneOf(t.value, {"rosette", "fascicled", "imbricate", "spiral", "scattered", "equitant"}); };
  const bool compound = a.property == "type" && a.value != "simple" && b.value != "simple";
  return compound || (a.property == "arrangement" && (crowds(a) || crowds(b)));
}

// "opposite or alternate", "opposite to whorled", 對生或輪生: alternatives in one breath.
bool areAlternatives(const Trait& a, const Trait& b, std::string_view text) {
  if (b.span.begin < a.span.end || b.span.begin - a.span.end > mostBetween) return b.span.begin < a.span.end;
  const std::string_view between = text.substr(a.span.end, b.span.begin - a.span.end);
  for (const std::string_view sign : {".", ";", "。", "；", "\n"})
    if (between.find(sign) != std::string_view::npos) return false;
  for (const std::string_view word : {" or", "or ", " to ", " and ", "-", "–", "或", "至", "rarely", "sometimes", "becoming", "below", "above", "下", "上", "及", "和", "then", "later"})
    if (between.find(word) != std::string_view::npos) return true;
  return false;
}

std::string said(const Trait& trait) { return "\"" + trait.text + "\""; }

bool sizesClash(const Trait& a, const Trait& b) {
  const bool measured = isOneOf(a.property, {"length", "width", "height", "diameter", "count", "merosity"});
  if (!measured || !a.low || !b.low || a.unit != b.unit || a.unit == "per fruit" || a.organ == "vein") return false;  // each glume and each leaf has its veins
  const double aLow = a.minimum.value_or(*a.low), aHigh = a.maximum.value_or(*a.high);
  const double bLow = b.minimum.value_or(*b.low), bHigh = b.maximum.value_or(*b.high);
  return aHigh < bLow || bHigh < aLow;
}

bool clash(const Trait& a, const Trait& b, std::string_view text) {
  if (a.organ != b.organ || a.part != b.part || a.which != b.which || a.property != b.property) return false;
  if (isDoubtful(a) || isDoubtful(b) || areAlternatives(a, b, text)) return false;
  if (!a.value.empty() && !b.value.empty()) return isExclusive(a) && a.value != b.value && kindOf(a) == kindOf(b) && !refines(a, b);
  return sizesClash(a, b);
}

Contradiction between(std::size_t first, std::size_t second, const Trait& a, const Trait& b, std::string_view against) {
  return {first, second, a.organ + " " + a.property + ": " + said(a) + std::string(against) + said(b)};
}

}  // namespace

std::vector<Contradiction> contradictionsIn(const Traits& traits, const std::vector<Denial>& denials, std::string_view text) {
  std::map<std::string, std::vector<std::size_t>> byKind;
  std::vector<Contradiction> found;
  for (std::size_t i = 0; i < traits.size(); ++i) {
    std::vector<std::size_t>& same = byKind[traits[i].organ + "|" + traits[i].part + "|" + traits[i].which + "|" + traits[i].property];
    if (same.size() > mostCompared) continue;
    for (const std::size_t earlier : same)
      if (clash(traits[earlier], traits[i], text)) {
        found.push_back(between(earlier, i, traits[earlier], traits[i], " against "));
        break;  // one witness is enough
      }
    same.push_back(i);
  }
  std::size_t compared = 0;
  for (const Denial& denial : denials) {
    if (++compared > mostCompared) break;
    for (std::size_t i = 0; i < traits.size(); ++i) {
      const Trait& t = traits[i];
      const bool same = t.organ == denial.trait.organ && t.property == denial.trait.property && t.value == denial.trait.value && t.part == denial.trait.part && t.which == denial.trait.which;
      if (!same || isDoubtful(t)) continue;
      found.push_back({i, i, t.organ + " " + t.property + ": " + said(t) + " against \"not " + denial.trait.text + "\""});
      break;
    }
  }
  return found;
}

}  // namespace axil::keywords
