#include "quantify/branching.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::quantify {

namespace {

constexpr int kMostPeriod = 8;
constexpr double kFew = 0.15;      // of the nodes of other phases may branch where every k-th does
constexpr double kClearlyLarger = 1.5;
constexpr double kMany = 0.6;      // of the nodes of the phase must

/// One node on an axis; only nodes that the axis goes on from.
struct Site {
  int rank = 0;
  int fromTip = 0;
  int last = 0;         ///< rank of the axis' last such node
  bool branched = false;
  double size = 0;      ///< segments carried by a branch, mean
  double vigour = 0;    ///< that over the nodes above: growth for its age
};

/// How many segments each axis carries, its laterals' included.
std::vector<double> sizesOf(const PlantStructure& structure) {
  std::vector<double> sizes(structure.axes.size());
  for (std::size_t a = structure.axes.size(); a-- > 0;) {
    sizes[a] += static_cast<double>(structure.axes[a].segments.size());
    if (const auto parent = structure.axes[a].parent) sizes[static_cast<std::size_t>(parent->value)] += sizes[a];
  }
  return sizes;
}

std::vector<Site> sitesOf(std::span<const MeasuredPlant> plants, int order) {
  std::vector<Site> sites;
  for (const MeasuredPlant& plant : plants) {
    const std::vector<double> sizes = sizesOf(*plant.structure);
    for (const Axis& axis : plant.structure->axes) {
      if (axis.order != order) continue;
      std::map<SegmentId, double> carried;
      for (const AxisId lateral : axis.laterals) carried[*plant.structure->at(lateral).bearer] += sizes[static_cast<std::size_t>(lateral.value)];
      for (const SegmentId s : axis.segments) {
        const SegmentPlace& place = plant.structure->at(s);
        if (!place.goesOn) continue;
        sites.push_back({place.rank, place.fromTip, static_cast<int>(axis.segments.size()) - 2, place.branches > 0,
                         place.branches > 0 ? carried.at(s) / place.branches : 0, 0});
        sites.back().vigour = sites.back().size / static_cast<double>(place.fromTip);
      }
    }
  }
  return sites;
}

double shareOf(const std::vector<Site>& sites) {
  const auto branched = std::count_if(sites.begin(), sites.end(), [](const Site& s) { return s.branched; });
  return sites.empty() ? 0 : static_cast<double>(branched) / static_cast<double>(sites.size());
}

/// The first distance from the tip at which nodes branch at least half as often as older ones do.
int delayOf(const std::vector<Site>& sites) {
  int furthest = 0;
  for (const Site& s : sites) furthest = std::max(furthest, s.fromTip);
  for (int d = 1; d <= furthest; ++d) {
    std::vector<Site> here;
    std::vector<Site> older;
    for (const Site& s : sites)
      if (s.fromTip == d) here.push_back(s);
      else if (s.fromTip > d) older.push_back(s);
    if (shareOf(here) > 0 && shareOf(here) >= 0.5 * shareOf(older)) return d - 1;
    // Few nodes say little: a miss at one of them is no delay where older ones miss as often.
    if (!here.empty() && std::pow(1 - shareOf(older), static_cast<double>(here.size())) > 0.05) return d - 1;
  }
  return 0;
}

/// Whether every k-th node branches, and which.
bool everyKth(const std::vector<Site>& sites, BranchingPattern& pattern) {
  for (int k = 2; k <= kMostPeriod; ++k) {
    std::vector<std::vector<Site>> phases(static_cast<std::size_t>(k));
    for (const Site& s : sites) phases[static_cast<std::size_t>(s.rank % k)].push_back(s);
    if (std::any_of(phases.begin(), phases.end(), [](const auto& p) { return p.size() < 2; })) continue;
    for (int phase = 0; phase < k; ++phase) {
      std::vector<Site> others;
      for (int p = 0; p < k; ++p)
        if (p != phase) others.insert(others.end(), phases[static_cast<std::size_t>(p)].begin(), phases[static_cast<std::size_t>(p)].end());
      if (shareOf(phases[static_cast<std::size_t>(phase)]) < kMany || shareOf(others) > kFew) continue;
      pattern.period = k;
      pattern.phase = phase;
      return true;
    }
  }
  return false;
}

std::size_t thirdOf(const Site& s) {
  if (s.last <= 0) return 1;
  return std::min<std::size_t>(2, static_cast<std::size_t>(3 * s.rank / (s.last + 1)));
}

/// Whether two shares differ by more than chance and by a good part: two standard errors and 0.25.
bool clearlyMore(double a, double b, double n) { return a - b > 0.25 && a - b > 2 * std::sqrt(0.25 * 2 / std::max(1.0, n / 3)); }

BranchingHabit habitBy(const std::array<double, 3>& v, auto more) {
  if (more(v[2], v[0]) && v[2] >= v[1]) return BranchingHabit::Acrotonic;
  if (more(v[0], v[2]) && v[0] >= v[1]) return BranchingHabit::Basitonic;
  if (more(v[1], v[0]) && more(v[1], v[2])) return BranchingHabit::Mesotonic;
  return BranchingHabit::Even;
}

}  // namespace

const char* nameOf(BranchingHabit habit) {
  switch (habit) {
    case BranchingHabit::None: return "none";
    case BranchingHabit::Even: return "even";
    case BranchingHabit::EveryKth: return "every k-th";
    case BranchingHabit::Acrotonic: return "acrotonic";
    case BranchingHabit::Mesotonic: return "mesotonic";
    case BranchingHabit::Basitonic: return "basitonic";
  }
  return "none";
}

int branchingDelayOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order) {
  const int seen = delayOf(sitesOf(plants, order));
  const bool told = order + 1 < static_cast<int>(schedule.orders.size()) && schedule.of(order).steady && schedule.of(order + 1).steady;
  return told ? std::min(seen, std::max(0, schedule.of(order + 1).delay)) : seen;
}

BranchingPattern branchingPatternOf(std::span<const MeasuredPlant> plants, const Schedule& schedule, int order) {
  BranchingPattern pattern;
  pattern.order = order;
  std::vector<Site> sites = sitesOf(plants, order);
  pattern.delay = branchingDelayOf(plants, schedule, order);
  std::erase_if(sites, [&](const Site& s) { return s.fromTip <= pattern.delay; });
  pattern.nodes = sites.size();
  std::array<double, 3> counts{0, 0, 0};
  std::array<double, 3> branched{0, 0, 0};
  std::array<double, 3> vigours{0, 0, 0};
  double axes = 0;
  double segments = 0;
  for (const Site& s : sites) {
    counts[thirdOf(s)] += 1;
    branched[thirdOf(s)] += s.branched ? 1 : 0;
    pattern.sizes[thirdOf(s)] += s.size;
    vigours[thirdOf(s)] += s.vigour;
    pattern.branched += s.branched ? 1 : 0;
    axes += s.rank == 0 ? 1 : 0;
    segments += s.rank == 0 ? s.last + 2 : 0;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (counts[k] > 0) pattern.shares[k] = branched[k] / counts[k];
    if (branched[k] > 0) pattern.sizes[k] /= branched[k];
    if (branched[k] > 0) vigours[k] /= branched[k];
  }
  if (axes > 0) pattern.growthUnit = segments / axes;
  if (pattern.branched == 0) return pattern;
  if (everyKth(sites, pattern)) {
    pattern.habit = BranchingHabit::EveryKth;
    pattern.growthUnit = pattern.period;
    return pattern;
  }
  const double n = static_cast<double>(sites.size());
  pattern.habit = habitBy(pattern.shares, [n](double a, double b) { return clearlyMore(a, b, n); });
  if (pattern.habit != BranchingHabit::Even) return pattern;
  // Young branches are small: larger ones above are acrotonic beyond doubt, larger ones below basitonic only where they also grew faster.
  const auto more = [](double a, double b) { return a > kClearlyLarger * b; };
  const BranchingHabit bySize = habitBy(pattern.sizes, more);
  if (bySize == BranchingHabit::Acrotonic || (bySize != BranchingHabit::Even && bySize == habitBy(vigours, more))) pattern.habit = bySize;
  return pattern;
}

}  // namespace axil::quantify
