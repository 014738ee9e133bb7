#include "quantify/phyllotaxis.hpp"

#include "keywords/keywords.hpp"
#include "quantify/circular.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace axil::quantify {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRegular = 0.05;      // chance above which no preset is named
constexpr double kPresetReach = 10 * std::numbers::pi / 180;
constexpr double kAgree = 0.6;         // concentration from which axes wind the same way
const double kStraightAcross = 3 * std::numbers::pi / 180;  // of 0 or half a period: no winding

/// What stands at one node of an axis.
struct Node {
  int rank = 0;
  std::vector<double> azimuths;
};
using AxisNodes = std::vector<Node>;

std::vector<double> azimuthsAt(const MeasuredPlant& plant, SegmentId segment, OrgansAround organs) {
  std::vector<double> azimuths;
  if (organs == OrgansAround::Leaves) {
    azimuths = plant.structure->leafAzimuths[static_cast<std::size_t>(segment.value)];
  } else {
    const AxisId own = plant.structure->at(segment).axis;
    for (const SegmentId child : plant.measurements->at(segment).children)
      if (plant.structure->at(child).axis != own) azimuths.push_back(plant.structure->at(child).azimuth);
  }
  std::erase_if(azimuths, [](double a) { return std::isnan(a); });
  return azimuths;
}

/// The nodes of each axis that bear such organs. What a fork ends in is no arrangement around the axis.
std::vector<AxisNodes> nodesOf(std::span<const MeasuredPlant> plants, OrgansAround organs, std::optional<int> order) {
  std::vector<AxisNodes> all;
  for (const MeasuredPlant& plant : plants)
    for (const Axis& axis : plant.structure->axes) {
      if (order && axis.order != *order) continue;
      AxisNodes nodes;
      for (const SegmentId s : axis.segments) {
        if (organs == OrgansAround::Branches && axis.forks && s == axis.tip()) continue;
        if (auto azimuths = azimuthsAt(plant, s, organs); !azimuths.empty()) nodes.push_back({plant.structure->at(s).rank, std::move(azimuths)});
      }
      if (!nodes.empty()) all.push_back(std::move(nodes));
    }
  return all;
}

/// The commonest key; of equally common ones the smallest.
int commonest(const std::map<int, std::size_t>& counts) {
  const auto rarer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(counts.begin(), counts.end(), rarer)->first;
}

/// Differences between neighbouring nodes, an entry an axis.
std::vector<std::vector<double>> differencesOf(const std::vector<AxisNodes>& axes, int perNode) {
  const double period = kTurn / perNode;
  std::map<int, std::size_t> gaps;
  for (const AxisNodes& nodes : axes)
    for (std::size_t i = 1; i < nodes.size(); ++i) ++gaps[nodes[i].rank - nodes[i - 1].rank];
  std::vector<std::vector<double>> all;
  if (gaps.empty()) return all;
  const int gap = gaps.contains(1) && 4 * gaps.at(1) >= gaps.at(commonest(gaps)) ? 1 : commonest(gaps);
  for (const AxisNodes& nodes : axes) {
    std::vector<double> differences;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Node& low = nodes[i - 1];
      const Node& high = nodes[i];
      const auto full = static_cast<std::size_t>(perNode);
      if (high.rank - low.rank != gap || low.azimuths.size() != full || high.azimuths.size() != full) continue;
      differences.push_back(wrappedTo(circularMeanOf(high.azimuths, period).mean - circularMeanOf(low.azimuths, period).mean, period));
    }
    if (!differences.empty()) all.push_back(std::move(differences));
  }
  return all;
}

struct Divergences {
  std::vector<double> values;
  Winding winding = Winding::None;
};

/// All differences, wound one way.
Divergences wound(const std::vector<std::vector<double>>& axes, double period) {
  Divergences result;
  for (const auto& own : axes) result.values.insert(result.values.end(), own.begin(), own.end());
  const CircularMean all = circularMeanOf(result.values, period);
  const double side = std::min(std::abs(all.mean), period / 2 - std::abs(all.mean));
  if (all.concentration >= kAgree) {
    result.winding = side < kStraightAcross ? Winding::None : all.mean > 0 ? Winding::Left : Winding::Right;
    if (all.mean < 0)
      for (double& v : result.values) v = -v;
    return result;
  }
  result.values.clear();
  for (const auto& own : axes) {
    const double sign = circularMeanOf(own, period).mean < 0 ? -1 : 1;
    for (const double v : own) result.values.push_back(sign * v);
  }
  result.winding = Winding::Either;
  return result;
}

/// Words that tell how dense or orderly leaves are; their divergence is the spiral's for want of another. (A cycle of unequal turns has no mean to compare with.)
bool saysNoAngle(std::string_view name) { return name == "scattered" || name == "imbricate"; }

/// An arrangement is named where the mean is no further from it than plants of one arrangement vary.
void namePreset(Phyllotaxis& fit) {
  if (fit.samples < 2) return;
  if (fit.chance > kRegular) {
    fit.preset = "irregular";
    return;
  }
  double best = kTurn;
  for (const std::string& name : keywords::arrangementNames()) {
    const auto preset = keywords::arrangementNamed(name);
    if (!preset || preset->clustered || !preset->cycle.empty() || saysNoAngle(name)) continue;
    if (preset->leavesPerNode != fit.perNode && !(fit.perNode > 2 && preset->leavesPerNode > 2)) continue;
    // The vocabulary's whorl has three; others stand above the gaps of the whorl below as it does.
    const auto whorl = preset->leavesPerNode == fit.perNode ? *preset : keywords::withLeavesPerNode(*preset, fit.perNode);
    const double period = fit.period().radians();
    const double expected = std::abs(wrappedTo(whorl.divergence.radians(), period));
    const double off = std::abs(fit.divergence.radians() - expected);
    if (off > best + 1e-9) continue;  // of equal ones the later in the table, which is the more precise
    best = off;
    fit.nearest = name;
    fit.presetDivergence = Angle::fromRadians(expected);
    fit.off = Angle::fromRadians(off);
  }
  const double reach = std::max(kPresetReach, 3 * fit.error.radians());
  fit.preset = !fit.nearest.empty() && best <= reach ? fit.nearest : "none";
}

Phyllotaxis fitted(const std::vector<AxisNodes>& axes, OrgansAround organs) {
  Phyllotaxis fit;
  fit.organs = organs;
  std::map<int, std::size_t> counts;
  std::size_t nodes = 0;
  for (const AxisNodes& axis : axes)
    for (const Node& node : axis) {
      ++counts[static_cast<int>(node.azimuths.size())];
      ++nodes;
    }
  if (nodes == 0) return fit;
  fit.perNode = commonest(counts);
  fit.perNodeShare = static_cast<double>(counts.at(fit.perNode)) / static_cast<double>(nodes);
  const double period = fit.period().radians();
  const Divergences divergences = wound(differencesOf(axes, fit.perNode), period);
  const CircularMean mean = circularMeanOf(divergences.values, period);
  fit.samples = mean.samples;
  fit.divergence = Angle::fromRadians(std::abs(mean.mean));
  fit.deviation = Angle::fromRadians(mean.deviation);
  fit.concentration = mean.concentration;
  fit.chance = mean.chance;
  fit.winding = divergences.winding;
  if (mean.samples > 0) fit.error = Angle::fromRadians(mean.deviation / std::sqrt(static_cast<double>(mean.samples)));
  namePreset(fit);
  return fit;
}

}  // namespace

Phyllotaxis phyllotaxisOf(std::span<const MeasuredPlant> plants, OrgansAround organs) { return fitted(nodesOf(plants, organs, std::nullopt), organs); }

Phyllotaxis phyllotaxisOf(std::span<const MeasuredPlant> plants, OrgansAround organs, int order) { return fitted(nodesOf(plants, organs, order), organs); }

}  // namespace axil::quantify
