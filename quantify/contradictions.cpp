#include "quantify/contradictions.hpp"

#include "base/text.hpp"
#include "base/units.hpp"
#include "keywords/presets.hpp"
#include "quantify/phyllotaxis.hpp"
#include "quantify/statistics.hpp"
#include "quantify/structure.hpp"

#include <algorithm>
#include <cmath>

namespace axil::quantify {

namespace {

using keywords::Trait;
using keywords::Traits;

constexpr std::size_t kFewest = 3;          // measured nodes or leaves
constexpr double kClearShare = 0.7;         // of the nodes that carry the commonest number
constexpr double kDivergenceSlack_deg = 15;
constexpr double kAngleSlack_deg = 10;
constexpr double kLengthSlack = 0.15;

bool isFirm(const Trait& t) { return t.qualifier != "rarely" && t.qualifier != "sometimes"; }

// What is said of the organ as a whole.
Traits statementsOf(const Traits& said, std::string_view organ, std::string_view property) {
  Traits found;
  for (const Trait& t : said) {
    const bool whole = t.part.empty() || t.part == "blade" || t.part == "surface";
    if (t.organ == organ && t.property == property && whole && isFirm(t)) found.push_back(t);
  }
  return found;
}

std::string rounded(double value) { return shortest(roundedTo(value, 1)); }
std::string whole(double value) { return shortest(roundedTo(value, 0)); }

std::string leavesInWords(int count) { return count == 1 ? "one leaf" : count == 2 ? "two leaves" : std::to_string(count) + " leaves"; }

PhotoContradiction against(const Trait& words, std::string measured) { return {words.text, words.start, words.end, std::move(measured)}; }

// "alternate" and "opposite" alone say nothing of the turn from node to node.
bool saysDivergence(const keywords::ArrangementPreset& preset) {
  return preset.name != "alternate" && preset.name != "opposite" && preset.name != "imbricate" && preset.name != "scattered" && preset.name != "whorled" && !preset.clustered && preset.cycle.empty();
}

bool fitsNumber(const keywords::ArrangementPreset& preset, int perNode) {
  if (preset.clustered) return true;
  return preset.leavesPerNode == perNode || (preset.name == "whorled" && perNode >= 3);
}

bool fitsDivergence(const keywords::ArrangementPreset& preset, const Phyllotaxis& measured) {
  if (!saysDivergence(preset) || preset.leavesPerNode != measured.perNode || measured.samples < kFewest) return true;
  const double period = measured.period().degrees();
  const double said = std::abs(std::remainder(preset.divergence.degrees(), period));
  const double off = std::abs(measured.divergence.degrees() - said);
  return off <= std::max(kDivergenceSlack_deg, 3 * measured.error.degrees());
}

std::string measuredWords(const Phyllotaxis& p) {
  std::string text = "measured nodes carry " + leavesInWords(p.perNode);
  if (p.samples >= kFewest) text += ", divergence " + whole(p.divergence.degrees()) + " ± " + whole(p.deviation.degrees()) + " degrees";
  return text;
}

void compareArrangement(const Traits& said, const Measurements& measurements, const PlantStructure& structure, std::vector<PhotoContradiction>& found) {
  const Traits statements = statementsOf(said, "leaf", "arrangement");
  if (statements.empty()) return;
  const std::vector<MeasuredPlant> plants{{&measurements, &structure}};
  const Phyllotaxis measured = phyllotaxisOf(plants, OrgansAround::Leaves);
  if (measured.perNode == 0 || measured.perNodeShare < kClearShare || measured.samples + 1 < kFewest) return;
  const Trait* wrong = nullptr;
  bool someNumberFits = false;
  for (const Trait& statement : statements) {
    const auto preset = keywords::arrangementNamed(statement.value);
    if (!preset) return;
    const bool numberFits = fitsNumber(*preset, measured.perNode);
    // "opposite, decussate": the precise word can be wrong where the wide one holds.
    if (!numberFits || !fitsDivergence(*preset, measured)) {
      if (wrong == nullptr || numberFits) wrong = &statement;
      if (numberFits) someNumberFits = false;
    } else {
      someNumberFits = true;
    }
  }
  if (wrong != nullptr && !someNumberFits) found.push_back(against(*wrong, measuredWords(measured)));
}

void compareRange(const Traits& statements, const std::vector<double>& values, double slackLow, double slackHigh, double perUnit, const std::string& what, const std::string& unit,
                  std::vector<PhotoContradiction>& found) {
  if (statements.empty() || values.size() < kFewest) return;
  const Spread spread = spreadOf(values);
  for (const Trait& t : statements) {
    if (!t.high) return;
    const double low = t.minimum.value_or(t.low.value_or(0)) * perUnit;
    const double high = t.maximum.value_or(*t.high) * perUnit;
    if (spread.mean >= low * (1 - slackLow) - slackHigh && spread.mean <= high * (1 + slackLow) + slackHigh) return;  // one of them fits
  }
  found.push_back(against(statements.front(), what + " " + rounded(spread.mean / perUnit) + " ± " + rounded(spread.deviation / perUnit) + " " + unit));
}

std::vector<const LeafMeasure*> leavesOf(const Measurements& measurements) {
  std::vector<const LeafMeasure*> leaves;
  for (const LeafMeasure& leaf : measurements.rootLeaves) leaves.push_back(&leaf);
  for (const Segment& segment : measurements.segments)
    for (const LeafMeasure& leaf : segment.leaves) leaves.push_back(&leaf);
  return leaves;
}

void compareLengths(const Traits& said, const Measurements& measurements, std::vector<PhotoContradiction>& found) {
  const Traits statements = statementsOf(said, "leaf", "length");
  if (statements.empty()) return;
  const auto ours = metresPer(measurements.unit), theirs = metresPer(statements.front().unit);
  if (!ours || !theirs) return;
  std::vector<double> lengths;
  for (const LeafMeasure* leaf : leavesOf(measurements))
    if (leaf->length > 0) lengths.push_back(leaf->length);
  compareRange(statements, lengths, kLengthSlack, 0, *theirs / *ours, "measured leaf length", statements.front().unit, found);
}

void compareAngles(const Traits& said, const Measurements& measurements, std::vector<PhotoContradiction>& found) {
  std::vector<double> leafAngles;
  std::vector<double> branchAngles;
  for (const LeafMeasure* leaf : leavesOf(measurements)) leafAngles.push_back(leaf->rotr.degrees());
  for (const Segment& segment : measurements.segments)
    if (segment.kind == SegmentKind::Branch) branchAngles.push_back(segment.rotr.degrees());
  compareRange(statementsOf(said, "leaf", "angle"), leafAngles, 0, kAngleSlack_deg, 1, "measured angle of the leaves to their stem", "degrees", found);
  compareRange(statementsOf(said, "branch", "angle"), branchAngles, 0, kAngleSlack_deg, 1, "measured angle of the branches to their stem", "degrees", found);
}

}  // namespace

std::vector<PhotoContradiction> contradictionsWith(const Traits& said, const Measurements& measurements) {
  std::vector<PhotoContradiction> found;
  const PlantStructure structure = plantStructure(measurements);
  compareArrangement(said, measurements, structure, found);
  compareLengths(said, measurements, found);
  compareAngles(said, measurements, found);
  return found;
}

}  // namespace axil::quantify
