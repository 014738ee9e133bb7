#include "quantify/mixed.hpp"

#include "base/text.hpp"
#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace axil::quantify {

namespace {

constexpr double kSure = 4;        // standard errors
constexpr std::size_t kEnough = 5;  // samples of a plant that count

/// What is compared, and by how much plants of one kind may differ whatever their samples say.
struct Row {
  Quantity quantity;
  double free;
  bool byOrder;
};
constexpr Row kRows[] = {{Quantity::Insertion, 0.14, true},  {Quantity::LeafAngle, 0.17, true},   {Quantity::Bend, 0.14, true},
                         {Quantity::LateralRatio, 0.35, true}, {Quantity::LengthRatio, 0.18, true}, {Quantity::Branching, 0.3, true},
                         {Quantity::LeavesPerNode, 0.6, false}};

/// One plant's own centre.
struct Own {
  std::size_t plant = 0;
  double value = 0;
  double deviation = 0;
  double error = 0;
};

std::vector<Own> ownValues(const std::vector<Sample>& samples, std::optional<int> order, bool share) {
  std::map<std::size_t, std::vector<double>> plants;
  for (const Sample& s : samples)
    if (!order || s.order == *order) plants[s.plant].push_back(s.value);
  std::vector<Own> own;
  for (const auto& [plant, values] : plants) {
    if (values.size() < kEnough) continue;
    Centre centre = centreOf(values);
    if (share) {
      double sum = 0;
      for (const double v : values) sum += v;
      const double p = (sum + 0.5) / (static_cast<double>(values.size()) + 1);
      centre = {sum / static_cast<double>(values.size()), std::sqrt(p * (1 - p))};
    }
    own.push_back({plant, centre.value, centre.deviation, centre.deviation / std::sqrt(static_cast<double>(values.size()))});
  }
  return own;
}

double medianOfOthers(const std::vector<Own>& own, std::size_t but) {
  std::vector<double> values;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (i != but) values.push_back(own[i].value);
  return medianOf(std::move(values));
}

/// How far plants spread that are no outliers; 0 for few plants.
double usualSpread(const std::vector<Own>& own) {
  if (own.size() < 4) return 0;
  std::vector<double> values;
  for (const Own& o : own) values.push_back(o.value);
  const double middle = medianOf(values);
  for (double& v : values) v = std::abs(v - middle);
  return 1.4826 * medianOf(std::move(values));
}

/// Plants that stand apart from the others; all of them where they fall into groups.
std::vector<Own> apart(const std::vector<Own>& own, double free) {
  std::vector<Own> out;
  if (own.size() < 2) return out;
  std::vector<double> deviations;
  for (const Own& o : own) deviations.push_back(o.deviation);
  const double within = medianOf(deviations);
  const double spread = usualSpread(own);
  const bool groups = spread > std::max(free, within);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double off = std::abs(own[i].value - medianOfOthers(own, i));
    const double unsure = kSure * std::max(own[i].error, within / std::sqrt(static_cast<double>(kEnough) * 4));
    if (off > unsure && off > std::max(free, within) && (groups || off > 3 * spread)) out.push_back(own[i]);
  }
  return out;
}

std::string valueText(const QuantityName& name, double value) {
  if (name.kind == QuantityName::Kind::Angle) return fixed(value * 180 / std::numbers::pi, 1) + " degrees";
  if (name.kind == QuantityName::Kind::Ratio) return fixed(std::exp(value), 2);
  if (name.kind == QuantityName::Kind::Share) return fixed(100 * value, 0) + " %";
  return fixed(value, 2);
}

std::string sentence(const QuantityName& name, const std::vector<Own>& strangers, const std::vector<Own>& own) {
  std::string plants;
  for (const Own& o : strangers) plants += (plants.empty() ? "plant " : ", plant ") + std::to_string(o.plant + 1) + " (" + valueText(name, o.value) + ")";
  std::vector<double> rest;
  for (const Own& o : own)
    if (std::none_of(strangers.begin(), strangers.end(), [&](const Own& s) { return s.plant == o.plant; })) rest.push_back(o.value);
  const std::string others = rest.empty() ? "no two groups of plants agree" : "the others have " + valueText(name, medianOf(rest));
  return std::string("the plants disagree in ") + name.words + ": " + plants + "; " + others + "; they may be of different species: take statistics of each alone";
}

/// Leaves or branches of each plant alone.
void compareArrangements(std::vector<std::string>& out, std::span<const MeasuredPlant> plants, OrgansAround organs) {
  std::map<std::string, std::vector<std::size_t>> presets;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const Phyllotaxis fit = phyllotaxisOf(plants.subspan(p, 1), organs);
    const bool sure = fit.samples >= kEnough && fit.chance < 1e-3 && fit.off.degrees() < 8;
    if (sure) presets[fit.preset].push_back(p);
  }
  if (presets.size() < 2) return;
  std::string text;
  for (const auto& [preset, members] : presets) text += (text.empty() ? "" : ", ") + preset + " on " + std::to_string(members.size());
  out.push_back(std::string("the plants disagree in how ") + (organs == OrgansAround::Leaves ? "leaves" : "branches") + " stand around their axes: " + text +
                "; they may be of different species: take statistics of each alone");
}

}  // namespace

std::vector<std::string> disagreements(const LayeredStatistics& statistics, std::span<const MeasuredPlant> plants) {
  std::vector<std::string> out;
  if (plants.size() < 2) return out;
  for (const Row& row : kRows) {
    const QuantityName& name = quantityNames()[static_cast<std::size_t>(row.quantity)];
    const auto& samples = statistics.samples[static_cast<std::size_t>(row.quantity)];
    // The order with the most samples speaks.
    std::optional<int> order;
    std::size_t most = 0;
    for (const OrderLayer& layer : statistics.of(row.quantity).orders)
      if (row.byOrder && layer.estimate.samples > most) {
        most = layer.estimate.samples;
        order = layer.order;
      }
    const std::vector<Own> own = ownValues(samples, order, name.kind == QuantityName::Kind::Share);
    if (const std::vector<Own> strangers = apart(own, row.free); !strangers.empty()) out.push_back(sentence(name, strangers, own));
  }
  compareArrangements(out, plants, OrgansAround::Leaves);
  compareArrangements(out, plants, OrgansAround::Branches);
  return out;
}

}  // namespace axil::quantify
