#include "quantify/family.hpp"

#include "quantify/arms.hpp"
#include "quantify/circular.hpp"
#include "quantify/estimate.hpp"
#include "quantify/prepared.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr std::size_t kEnoughAxes = 12;   // for an order to have rules of its own
constexpr double kRounding = 1e-4;        // of logarithms: no chance
constexpr double kLittle = 0.3;           // of what levels seem to vary, so little is none
constexpr std::size_t kTested = 8;        // fewer samples contradict nothing

/// One axis and what it could have made.
struct AxisCase {
  std::size_t plant = 0;
  const Axis* axis = nullptr;
  double potential = 0;        ///< segments it may make in all
  double bearerLeft = 0;       ///< of its bearer, after the node it stands at
  double bearerRank = 0;
  [[nodiscard]] double count() const { return static_cast<double>(axis->segments.size()); }
};

class FamilyMaker {
 public:
  FamilyMaker(std::span<const MeasuredPlant> plants, Outlook outlook) : plants_(plants), outlook_(std::move(outlook)) {}

  Family made() {
    family_.plants = plants_.size();
    setAges();
    setGroups();
    setArmPlaces();
    for (std::size_t g = 0; g < family_.orders.size(); ++g) setExtent(g);
    for (std::size_t g = 0; g < family_.orders.size(); ++g) {
      FamilyOrder& o = family_.orders[g];
      o.outlook = outlook_.of(o.order);
      setFates(g);
      setLengths(g);
      setAngles(g);
      setRadius(g);
      setLeaves(g);
    }
    // After the levels of all orders are known: a branch starts from its bearer's.
    for (std::size_t g = 0; g < family_.orders.size(); ++g) setStart(g);
    std::vector<double> stages;
    double collar = 0;
    for (std::size_t p = 0; p < plants_.size(); ++p) {
      stages.push_back(cases_[p].front().potential);
      for (const Axis& axis : plants_[p].structure->axes) collar += !axis.bearer && axis.order > 0 ? 1 : 0;
    }
    family_.stages = countsOf(stages);
    family_.collarAxes = static_cast<int>(std::lround(collar / static_cast<double>(plants_.size())));
    family_.statistics = std::move(outlook_.statistics);
    return std::move(family_);
  }

 private:
  [[nodiscard]] const Schedule& schedule() const { return outlook_.statistics.schedule; }
  [[nodiscard]] std::size_t groupOf(int order) const {
    std::size_t g = 0;
    while (g + 1 < family_.orders.size() && family_.orders[g + 1].order <= order) ++g;
    return g;
  }

  /// Stages of each plant. Where most plants are of one age and none is older, smaller ones have ended early.
  void setAges() {
    double most = 0, oldest = 0;
    for (const PlantSchedule& plant : schedule().plants) most = std::max(most, plant.now + 1);
    for (const PlantSchedule& plant : schedule().plants) oldest += plant.now + 1.5 > most ? 1 : 0;
    for (const PlantSchedule& plant : schedule().plants) ages_.push_back(2 * oldest >= static_cast<double>(plants_.size()) ? most : plant.now + 1);
  }

  void setGroups() {
    std::map<int, std::size_t> axes;
    std::ptrdiff_t sympodial = 0;
    for (const MeasuredPlant& plant : plants_) {
      for (const Axis& axis : plant.structure->axes) ++axes[axis.order];
      sympodial += plant.structure->branching == Branching::Sympodial ? 1 : plant.structure->branching == Branching::Monopodial ? -1 : 0;
    }
    family_.deepest = static_cast<int>(axes.size());
    for (const auto& [order, count] : axes) {
      // Axes that fork are modules of one kind, whatever their order.
      const bool alike = sympodial > 0 && order > (modulesAlike() ? 0 : 1);
      if (alike || (order > 1 && (count < kEnoughAxes || axes[order - 1] < kEnoughAxes))) {
        family_.orders.back().lastOrder = order;
        continue;
      }
      FamilyOrder o;
      o.order = o.lastOrder = order;
      family_.orders.push_back(std::move(o));
    }
    cases_.resize(plants_.size());
    for (std::size_t p = 0; p < plants_.size(); ++p) {
      for (const Axis& axis : plants_[p].structure->axes) cases_[p].push_back({p, &axis, 0, 0, -1});
    }
  }

  /// Whether first axes are as long as the modules above them.
  [[nodiscard]] bool modulesAlike() const {
    std::vector<double> first, others;
    for (const MeasuredPlant& plant : plants_)
      for (const Axis& axis : plant.structure->axes) (axis.order == 0 ? first : others).push_back(static_cast<double>(axis.segments.size()));
    const Moments a = momentsOf(first), b = momentsOf(others);
    return std::abs(a.mean - b.mean) <= 0.05 + 2 * std::max(a.deviation, b.deviation) / std::sqrt(static_cast<double>(first.size()));
  }

  template <class Visit>
  void eachCase(std::size_t g, Visit visit) {
    for (auto& plant : cases_)
      for (AxisCase& c : plant)
        if (groupOf(c.axis->order) == g) visit(c);
  }

  // ---- how many segments -----------------------------------------------------------------------------------------------

  void setExtent(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    // What comes together with its bearer stands on an axis' last segment too, as what an axis ends in.
    bool steady = !schedule().branchesAtOnce && (g == 0 || family_.orders[g - 1].extent == Extent::Stages);
    for (int order = o.order; order <= o.lastOrder; ++order) steady = steady && schedule().of(order).steady;
    std::size_t full = 0, all = 0;
    if (g == 0) {
      eachCase(g, [&](AxisCase& c) {
        if (c.axis->order > 0) return;
        ++all;
        full += c.count() + 0.5 > ages_[c.plant] ? 1 : 0;
      });
      // A first axis that ends in a fork has not ended by chance.
      steady = steady && (2 * full >= all || family_.orders.size() == 1 || forksOften());
    }
    o.extent = steady ? Extent::Stages : Extent::Own;
    o.delay = steady ? schedule().of(o.order).delay : 0;
    eachCase(g, [&](AxisCase& c) { setPotential(o, c); });
    if (steady) setMost(g);
    else setOwn(g);
  }
  [[nodiscard]] bool forksOften() const {
    std::size_t forks = 0;
    for (const MeasuredPlant& plant : plants_) forks += plant.structure->axes.front().forks ? 1 : 0;
    return 2 * forks >= plants_.size();
  }

  void setPotential(const FamilyOrder& o, AxisCase& c) {
    c.bearerLeft = ages_[c.plant];
    if (c.axis->bearer) {
      const AxisCase& bearer = cases_[c.plant][static_cast<std::size_t>(c.axis->parent->value)];
      const SegmentPlace& place = plants_[c.plant].structure->at(*c.axis->bearer);
      c.bearerRank = place.rank;
      c.bearerLeft = bearer.potential - place.rank - 1;
    }
    c.potential = o.extent == Extent::Stages ? std::max(c.count(), c.bearerLeft - (c.axis->bearer ? o.delay : 0)) : c.count();
  }

  /// A number of segments that axes end at too often for chance.
  void setMost(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    double longest = 0, nodes = 0, ended = 0;
    eachCase(g, [&](const AxisCase& c) { longest = std::max(longest, c.count()); });
    double atLongest = 0, further = 0;
    eachCase(g, [&](const AxisCase& c) {
      further += c.count() >= longest && c.potential > longest ? 1 : 0;
      if (c.axis->forks) return;
      atLongest += c.count() >= longest && c.potential > longest ? 1 : 0;
      nodes += std::min(c.count(), longest - 1);
      ended += c.count() < longest && c.potential > c.count() ? 1 : 0;
    });
    if (further < 2 || atLongest < further || longest < 2) return;
    const double chance = nodes > 0 ? std::max(ended, 0.5) / nodes : 0.5;
    if (std::pow(chance, atLongest) > 0.01) return;
    o.most = static_cast<int>(longest);
    eachCase(g, [&](AxisCase& c) { c.potential = std::min(c.potential, longest); });
  }

  /// Left as a line along the bearer, or alike everywhere.
  void setOwn(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    std::vector<double> y, left, rank;
    eachCase(g, [&](const AxisCase& c) {
      y.push_back(c.count());
      left.push_back(c.bearerLeft);
      rank.push_back(c.bearerRank);
    });
    const double n = static_cast<double>(y.size());
    const auto criterion = [&](const std::vector<double>& misses, double numbers) {
      double sum = 0;
      for (const double m : misses) sum += m * m;
      return n * std::log(sum / n + 0.02) + numbers * std::log(n);
    };
    const double mean = momentsOf(y).mean;
    std::vector<double> best;
    for (const double v : y) best.push_back(v - mean);
    double least = criterion(best, 1);
    for (const Along along : {Along::Left, Along::Rank}) {
      if (g == 0 || y.size() < kTested) break;
      const std::vector<double>& x = along == Along::Left ? left : rank;
      const double middle = momentsOf(x).mean;
      double xy = 0, xx = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - middle) * (y[i] - mean);
        xx += (x[i] - middle) * (x[i] - middle);
      }
      if (xx == 0) continue;
      std::vector<double> misses;
      for (std::size_t i = 0; i < x.size(); ++i) misses.push_back(y[i] - mean - xy / xx * (x[i] - middle));
      if (criterion(misses, 2) + 6 >= least) continue;
      least = criterion(misses, 2);
      o.along = along;
      o.slope = xy / xx;
      for (double& m : misses) m += mean - o.slope * middle;
      best = std::move(misses);
    }
    o.own = o.along == Along::Nothing ? countsOf(y) : distributionOf(best);
  }

  // ---- what becomes of a node --------------------------------------------------------------------------------------------

  void setFates(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    const int delay = g + 1 < family_.orders.size() ? family_.orders[g + 1].delay : o.delay;
    std::map<int, double> ends;
    std::vector<NodeFate> nodes;
    eachCase(g, [&](const AxisCase& c) {
      ++o.axes;
      o.segments += c.axis->segments.size();
      const PlantStructure& structure = *plants_[c.plant].structure;
      for (const SegmentId s : c.axis->segments) {
        const SegmentPlace& place = structure.at(s);
        const double left = c.potential - place.rank - 1;
        o.insertions += static_cast<std::size_t>(place.branches);
        if (o.extent == Extent::Own && !place.goesOn) {
          // Where the measured plants stop at their highest order, axes have not ended for good.
          if (c.axis->order + 1 < structure.orders || o.lastOrder == o.order) ends[place.branches] += 1;
          continue;
        }
        // Too young to branch, or to have ended beyond doubt.
        if (o.extent == Extent::Stages && left - delay < 1) continue;
        nodes.push_back({place.rank, place.goesOn, place.branches});
      }
    });
    o.nodes = nodes.size();
    o.fates = fateTableOf(nodes);
    double sum = 0;
    for (const auto& [arms, count] : ends) sum += count;
    for (const auto& [arms, count] : ends) o.ends.push_back({arms, count / sum});
    if (o.ends.empty()) o.ends = {{0, 1}};
  }

  // ---- lengths -----------------------------------------------------------------------------------------------------------

  static std::vector<double> logsOf(const Measurements& m, const Axis& axis) {
    std::vector<double> logs;
    for (const SegmentId s : axis.segments) logs.push_back(std::log(m.at(s).length));
    return logs;
  }

  void setLengths(std::size_t g) {
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

  /// Of an axis: its first length, or the level its lengths vary around.
  double levelOf(const AxisCase& c) {
    const std::size_t g = groupOf(c.axis->order);
    const FamilyOrder& o = family_.orders[g];
    const std::vector<double> logs = logsOf(*plants_[c.plant].measurements, *c.axis);
    if (o.followsBelow) return logs.front();
    double level = 0;
    for (std::size_t i = 0; i < logs.size(); ++i) level += logs[i] - std::log(o.step) * static_cast<double>(i);
    return level / static_cast<double>(logs.size());
  }
  double lengthAt(const AxisCase& c, int rank) {
    const FamilyOrder& o = family_.orders[groupOf(c.axis->order)];
    if (o.followsBelow) return std::log(plants_[c.plant].measurements->at(c.axis->segments[static_cast<std::size_t>(rank)]).length);
    return levelOf(c) + std::log(o.step) * rank;
  }

  /// Where each axis that is an arm stands among its sisters.
  void setArmPlaces() {
    for (std::size_t g = 0; g < family_.orders.size(); ++g)
      for (const Arms& arms : armsOf(plants_, family_.orders[g].order, family_.orders[g].lastOrder))
        for (std::size_t a = 0; a < arms.members.size(); ++a)
          for (const ArmMember& member : arms.members[a]) armOf_[{member.plant, member.base}] = {g, arms.count, a};
  }
  struct ArmPlace {
    std::size_t bearers = 0;   ///< group of what bears it
    int count = 0;             ///< 0: no arm
    std::size_t arm = 0;
    friend auto operator<=>(const ArmPlace&, const ArmPlace&) = default;
  };
  [[nodiscard]] ArmPlace armOf(const AxisCase& c) const {
    const auto found = armOf_.find({c.plant, c.axis->base()});
    return found == armOf_.end() ? ArmPlace{} : found->second;
  }

  void setStart(std::size_t g) {
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
  /// Where axes have one segment each, sisters tell a bearer's own chance from the level that they inherit: all of them are short against a bearer that is long by chance.
  static double noiseOfBearers(const std::map<std::pair<std::size_t, SegmentId>, std::vector<std::pair<ArmPlace, double>>>& sisters, const std::map<ArmPlace, std::vector<double>>& ratios) {
    std::vector<std::vector<double>> groups;
    for (const auto& [bearer, members] : sisters) {
      groups.emplace_back();
      for (const auto& [arm, ratio] : members) groups.back().push_back(ratio - momentsOf(ratios.at(arm)).mean);
    }
    return std::min(betweenGroups(groups), deviationWithin(ratios) / std::numbers::sqrt2);
  }
  /// Where levels follow from one another, all axes tell that of the first ones.
  double levelOfFirst(const std::map<ArmPlace, std::vector<double>>& ratios) {
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
  /// Gives lengths of axes of one segment a chance of their own, and those of the only bearer below them, which are told by nothing else.
  void giveNoise(std::size_t g, double noise, std::size_t samples) {
    const Distribution chance{.form = Distribution::Form::Normal, .centre = std::exp(noise * noise / 2), .spread = noise, .values = {}, .samples = samples};
    const FamilyOrder& first = family_.orders.front();
    for (std::size_t own = g == 1 && first.segments == first.axes ? 0 : g; own <= g; ++own) family_.orders[own].factor = chance;
  }
  /// Around the mean of each arm.
  static double deviationWithin(const std::map<ArmPlace, std::vector<double>>& groups) {
    double squares = 0, freedom = 0;
    for (const auto& [place, values] : groups) {
      const double n = static_cast<double>(values.size());
      squares += (n - 1) * std::pow(momentsOf(values).deviation, 2);
      freedom += n - 1;
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : 0;
  }

  // ---- angles ------------------------------------------------------------------------------------------------------------

  void setAngles(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    std::vector<double> bends, sides, insertions;
    eachCase(g, [&](const AxisCase& c) {
      const Measurements& m = *plants_[c.plant].measurements;
      const PlantStructure& structure = *plants_[c.plant].structure;
      for (std::size_t i = 0; i < c.axis->segments.size(); ++i) {
        const SegmentId s = c.axis->segments[i];
        if (i > 0) {
          bends.push_back(m.at(s).rotr.radians());
          if (bends.back() > 0.2 * std::numbers::pi / 180) sides.push_back(m.at(s).rotu.radians());
        }
        for (const SegmentId child : m.at(s).children)
          if (structure.at(child).axis != structure.at(s).axis) insertions.push_back(m.at(child).rotr.radians());
      }
    });
    o.bend = distributionOf(bends);
    const CircularMean side = circularMeanOf(sides);
    o.bendsToOneSide = side.samples >= kTested && side.concentration > 0.6;
    o.side = side.mean;
    o.sideDeviation = side.deviation;
    o.insertion = distributionOf(insertions);
    for (const Arms& arms : armsOf(plants_, o.order, o.lastOrder))
      for (const auto& members : arms.members) {
        std::vector<double> leans;
        for (const ArmMember& member : members) leans.push_back(plants_[member.plant].measurements->at(member.base).rotr.radians());
        o.arms[arms.count].push_back({distributionOf(std::move(leans)), {}});
      }
  }

  // ---- bodies ------------------------------------------------------------------------------------------------------------

  void setRadius(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    std::vector<Sample> samples;
    std::vector<std::size_t> axisOf;
    std::size_t axes = 0;
    eachCase(g, [&](const AxisCase& c) {
      for (std::size_t i = 0; i < c.axis->segments.size(); ++i)
        if (const auto r = plants_[c.plant].measurements->at(c.axis->segments[i]).radius; r && *r > 0) {
          samples.push_back({c.plant, o.order, static_cast<int>(i), *r});
          axisOf.push_back(axes);
        }
      ++axes;
    });
    if (samples.empty()) return;
    const Trend trend = trendOf(samples, axisOf, true);
    o.radiusStep = trend.clear() ? std::min(1.0, std::exp(trend.slope)) : 1;
    std::vector<double> starts;
    for (const Sample& s : samples) starts.push_back(std::log(s.value) - std::log(o.radiusStep) * s.rank);
    o.radius = std::exp(medianOf(starts));
  }

  void setLeaves(std::size_t g) {
    FamilyOrder& o = family_.orders[g];
    std::vector<double> lengths;
    double with = 0;
    eachCase(g, [&](const AxisCase& c) {
      for (const SegmentId s : c.axis->segments) {
        const auto& leaves = plants_[c.plant].measurements->at(s).leaves;
        with += leaves.empty() ? 0 : 1;
        for (const LeafMeasure& leaf : leaves) lengths.push_back(leaf.length);
      }
    });
    if (lengths.empty()) return;
    // Grown plants are of the measured ones' ages: whether old nodes lost their leaves or low ones never had any, they are bare alike.
    o.outlook.leafLasts = o.extent == Extent::Stages ? o.outlook.leafSpan : std::nullopt;
    o.leafShare = o.outlook.leafLasts ? o.outlook.leafShare : with / static_cast<double>(o.segments);
    o.leafLength = distributionOf(lengths);
  }

  std::span<const MeasuredPlant> plants_;
  Outlook outlook_;
  Family family_;
  std::vector<std::vector<AxisCase>> cases_;   ///< of each plant, by AxisId
  std::vector<double> ages_;                   ///< of each plant, stages
  std::map<std::size_t, bool> alike_;          ///< axes of a group share one level
  std::map<std::size_t, double> residual_;
  std::map<std::pair<std::size_t, SegmentId>, ArmPlace> armOf_;
};

}  // namespace

Result<Family> familyOf(std::span<const Measurements> given) {
  const auto ready = prepared(given);
  if (!ready) return ready.failure();
  return FamilyMaker(ready->measured, outlookOf(*ready)).made();
}

}  // namespace axil::quantify
