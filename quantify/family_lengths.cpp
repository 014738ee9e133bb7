#include "quantify/family_maker.hpp"

#include "quantify/arms.hpp"
#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axil::quantify {

namespace {

constexpr double kRounding = 1e-4;        // of logarithms: no chance
constexpr double kLittle = 0.3;           // of what levels seem to vary, so little is none

}  // namespace

std::vector<double> FamilyMaker::logsOf(const Measurements& m, const Axis& axis) {
  std::vector<double> logs;
  for (const SegmentId s : axis.segments) logs.push_back(std::log(m.at(s).length));
  return logs;
}

void FamilyMaker::setLengths(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<Sample> samples;
  std::vector<std::size_t> axisOf;
  std::vector<double> steps;
  std::size_t axes = 0;
  eachCase(g, [&](const AxisCase& c) {
    const std::vector<double> logs = logsOf(*plants_[c.plant].measurements, *c.axis);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      samples.push_back({c.plant, o.order, static_cast<int>(i), std::exp(logs[i])});
      axisOf.push_back(axes);
      if (i > 0) steps.push_back(logs[i] - logs[i - 1]);
    }
    ++axes;
  });
  const Trend trend = trendOf(samples, axisOf, true);
  const double slope = trend.clear() ? trend.slope : 0;
  const double usualStep = momentsOf(steps).mean;
  // Which foretells the next better: the segment below, or the level of all below?
  double byBelow = 0, byLevel = 0;
  std::vector<double> levels, misses;
  eachCase(g, [&](const AxisCase& c) {
    const std::vector<double> logs = logsOf(*plants_[c.plant].measurements, *c.axis);
    double level = 0;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      if (i > 0) {
        byBelow += std::pow(logs[i] - logs[i - 1] - usualStep, 2);
        byLevel += std::pow(logs[i] - slope * static_cast<double>(i) - level / static_cast<double>(i), 2);
      }
      level += logs[i] - slope * static_cast<double>(i);
    }
    level /= static_cast<double>(logs.size());
    levels.push_back(level);
    if (logs.size() < 2) return;
    const double few = std::sqrt(static_cast<double>(logs.size()) / static_cast<double>(logs.size() - 1));
    for (std::size_t i = 0; i < logs.size(); ++i) misses.push_back(few * (logs[i] - slope * static_cast<double>(i) - level));
  });
  o.followsBelow = steps.size() >= 3 && byBelow < 0.96 * byLevel;
  if (o.followsBelow) {
    std::vector<double> factors;
    for (const double s : steps) factors.push_back(std::exp(s));
    o.factor = distributionOf(factors);
    return;
  }
  o.step = std::exp(slope);
  const Moments miss = momentsOf(misses);
  const Moments level = momentsOf(levels);
  alike_[g] = misses.size() > 2 && levels.size() > 2 && level.deviation < 1.2 * miss.deviation / std::sqrt(static_cast<double>(samples.size()) / static_cast<double>(levels.size()));
  if (alike_[g]) {
    misses.clear();
    for (const Sample& s : samples) misses.push_back(std::log(s.value) - slope * s.rank - level.mean);
  }
  std::vector<double> factors;
  for (const double m : misses) factors.push_back(std::exp(m));
  o.factor = factors.empty() ? distributionOf({1}) : distributionOf(factors);
  residual_[g] = miss.deviation;
}

double FamilyMaker::levelOf(const AxisCase& c) {
  const std::size_t g = groupOf(c.axis->order);
  const FamilyOrder& o = family_.orders[g];
  const std::vector<double> logs = logsOf(*plants_[c.plant].measurements, *c.axis);
  if (o.followsBelow) return logs.front();
  double level = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) level += logs[i] - std::log(o.step) * static_cast<double>(i);
  return level / static_cast<double>(logs.size());
}

double FamilyMaker::lengthAt(const AxisCase& c, int rank) {
  const FamilyOrder& o = family_.orders[groupOf(c.axis->order)];
  if (o.followsBelow) return std::log(plants_[c.plant].measurements->at(c.axis->segments[static_cast<std::size_t>(rank)]).length);
  return levelOf(c) + std::log(o.step) * rank;
}

void FamilyMaker::setArmPlaces() {
  for (std::size_t g = 0; g < family_.orders.size(); ++g)
    for (const Arms& arms : armsOf(plants_, family_.orders[g].order, family_.orders[g].lastOrder))
      for (std::size_t a = 0; a < arms.members.size(); ++a)
        for (const ArmMember& member : arms.members[a]) armOf_[{member.plant, member.base}] = {g, arms.count, a};
}

FamilyMaker::ArmPlace FamilyMaker::armOf(const AxisCase& c) const {
  const auto found = armOf_.find({c.plant, c.axis->base()});
  return found == armOf_.end() ? ArmPlace{} : found->second;
}

void FamilyMaker::setStart(std::size_t g) {
  FamilyOrder& o = family_.orders[g];
  std::vector<double> own, trunks;
  std::map<ArmPlace, std::vector<double>> ratios, levels;
  std::map<std::pair<std::size_t, SegmentId>, std::vector<std::pair<ArmPlace, double>>> sisters;
  double segments = 0;
  std::size_t borne = 0;
  eachCase(g, [&](const AxisCase& c) {
    if (!c.axis->bearer && o.lastOrder > 0) {
      trunks.push_back(levelOf(c));
      if (o.order == 0) return;
    }
    own.push_back(levelOf(c));
    levels[armOf(c)].push_back(own.back());
    segments += c.count();
    if (!c.axis->bearer) return;
    ++borne;
    const double ratio = own.back() - lengthAt(cases_[c.plant][static_cast<std::size_t>(c.axis->parent->value)], static_cast<int>(c.bearerRank));
    ratios[armOf(c)].push_back(ratio);
    sisters[{c.plant, *c.axis->bearer}].emplace_back(armOf(c), ratio);
  });
  if (g == 0) family_.firstLength = std::exp(centreOf(trunks.empty() ? own : trunks).value);
  if (own.empty()) {
    own = trunks;
    levels[{}] = own;
  }
  const Centre centre = centreOf(own);
  o.usual = std::exp(centre.value);
  o.startsFromBearer = borne == own.size() && borne > 0 && (borne == 1 || deviationWithin(ratios) < 0.95 * deviationWithin(levels));
  const auto& logs = o.startsFromBearer ? ratios : levels;
  const double middle = o.startsFromBearer ? 0 : centre.value;
  // A level measured on few segments varies with them.
  double keep = alike_[g] ? 0 : 1;
  if (const double spread = deviationWithin(logs); !o.followsBelow && spread > 0 && keep > 0) {
    const double noise = residual_[g] * residual_[g] * static_cast<double>(own.size()) / segments;
    keep = std::sqrt(std::max(0.0, 1 - noise / (spread * spread)));
  }
  if (o.startsFromBearer && segments == static_cast<double>(own.size()))
    if (const double noise = noiseOfBearers(sisters, ratios); noise > kRounding) {
      giveNoise(g, noise, own.size());
      keep = std::sqrt(std::max(0.0, 1 - 2 * std::pow(noise / deviationWithin(logs), 2)));
      if (keep < kLittle && g + 1 == family_.orders.size()) family_.firstLength = std::exp(levelOfFirst(ratios));
    }
  std::vector<double> all;
  for (const auto& [place, values] : logs) {
    const double mean = momentsOf(values).mean;
    std::vector<double> factors;
    for (const double l : values) factors.push_back(std::exp(mean + keep * (l - mean) - middle));
    all.insert(all.end(), factors.begin(), factors.end());
    if (place.count > 0) family_.orders[place.bearers].arms.at(place.count)[place.arm].start = distributionOf(std::move(factors));
  }
  if (alike_[g] && !o.startsFromBearer && armOf_.empty()) {
    o.usual = std::exp(momentsOf(own).mean);
    all.assign(1, 1);
  }
  o.start = distributionOf(std::move(all));
}

double FamilyMaker::noiseOfBearers(const std::map<std::pair<std::size_t, SegmentId>, std::vector<std::pair<ArmPlace, double>>>& sisters, const std::map<ArmPlace, std::vector<double>>& ratios) {
  std::vector<std::vector<double>> groups;
  for (const auto& [bearer, members] : sisters) {
    groups.emplace_back();
    for (const auto& [arm, ratio] : members) groups.back().push_back(ratio - momentsOf(ratios.at(arm)).mean);
  }
  return std::min(betweenGroups(groups), deviationWithin(ratios) / std::numbers::sqrt2);
}

double FamilyMaker::levelOfFirst(const std::map<ArmPlace, std::vector<double>>& ratios) {
  std::vector<double> levels;
  for (const auto& plant : cases_) {
    std::vector<double> offsets(plant.size(), 0);
    for (std::size_t a = 0; a < plant.size(); ++a) {
      const AxisCase& c = plant[a];
      const auto own = ratios.find(armOf(c));
      if (c.axis->bearer && own != ratios.end()) offsets[a] = offsets[static_cast<std::size_t>(c.axis->parent->value)] + momentsOf(own->second).mean;
      levels.push_back(levelOf(c) - offsets[a]);
    }
  }
  return momentsOf(levels).mean;
}

void FamilyMaker::giveNoise(std::size_t g, double noise, std::size_t samples) {
  const Distribution chance{.form = Distribution::Form::Normal, .centre = std::exp(noise * noise / 2), .spread = noise, .values = {}, .samples = samples};
  const FamilyOrder& first = family_.orders.front();
  for (std::size_t own = g == 1 && first.segments == first.axes ? 0 : g; own <= g; ++own) family_.orders[own].factor = chance;
}

double FamilyMaker::deviationWithin(const std::map<ArmPlace, std::vector<double>>& groups) {
  double squares = 0, freedom = 0;
  for (const auto& [place, values] : groups) {
    const double n = static_cast<double>(values.size());
    squares += (n - 1) * std::pow(momentsOf(values).deviation, 2);
    freedom += n - 1;
  }
  return freedom > 0 ? std::sqrt(squares / freedom) : 0;
}

}  // namespace axil::quantify
