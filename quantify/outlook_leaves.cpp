#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axil::quantify {

namespace {

double widthOverLength(std::span<const MeasuredPlant> plants, int order) {
  std::vector<double> shares;
  for (const MeasuredPlant& plant : plants)
    for (std::size_t s = 0; s < plant.measurements->segments.size(); ++s)
      for (const LeafMeasure& leaf : plant.measurements->segments[s].leaves)
        if (plant.structure->places[s].order == order) shares.push_back(leaf.width / leaf.length);
  return shares.empty() ? 0 : medianOf(std::move(shares));
}

double shareIn(const std::map<int, std::vector<double>>& counts, int age) {
  const auto found = counts.find(age);
  if (found == counts.end()) return 0;
  double sum = 0;
  for (const double c : found->second) sum += c;
  return sum / static_cast<double>(found->second.size());
}

/// Nodes that bear a leaf and that don't, at one age or rank.
struct Borne {
  double with = 0;
  double without = 0;
};

/// How few nodes contradict the best threshold: bare up to it and leafy above, or the other way round.
enum class BareWhere { Below, Above };
double fewestContradictions(const std::map<int, Borne>& nodes, BareWhere bare) {
  double leafyBelow = 0, bareAbove = 0;
  for (const auto& [place, n] : nodes) bareAbove += bare == BareWhere::Below ? n.without : n.with;
  double fewest = bareAbove;
  for (const auto& [place, n] : nodes) {
    leafyBelow += bare == BareWhere::Below ? n.with : n.without;
    bareAbove -= bare == BareWhere::Below ? n.without : n.with;
    fewest = std::min(fewest, leafyBelow + bareAbove);
  }
  return fewest;
}

/// Whether bare nodes are old ones rather than low ones. On axes of one length nobody can tell; then leaves are not said to fall.
bool leavesFallWithAge(std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics) {
  std::map<int, std::map<int, Borne>> byAge, byRank;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (std::size_t s = 0; s < plants[p].measurements->segments.size(); ++s) {
      const SegmentPlace& place = plants[p].structure->places[s];
      if (!statistics.schedule.plants[p].grows[static_cast<std::size_t>(place.axis.value)]) continue;
      const bool leafy = !plants[p].measurements->segments[s].leaves.empty();
      for (Borne* n : {&byAge[place.order][place.fromTip], &byRank[place.order][place.rank]}) (leafy ? n->with : n->without) += 1;
    }
  double old = 0, low = 0;
  for (const auto& [order, nodes] : byAge) old += fewestContradictions(nodes, BareWhere::Above);
  for (const auto& [order, nodes] : byRank) low += fewestContradictions(nodes, BareWhere::Below);
  return old < low;
}

/// Whether the youngest node has its leaves, and whether old ones have lost theirs.
void setLeafTimes(OrderOutlook& o, const std::map<int, std::vector<double>>& counts) {
  double best = 0;
  int oldest = 0;
  for (const auto& [age, values] : counts) {
    if (age <= 3) best = std::max(best, shareIn(counts, age));
    oldest = std::max(oldest, age);
  }
  o.leafShare = best;
  o.leafAtOwnTip = shareIn(counts, 0) >= 0.5 * best;
  if (best <= 0) return;
  // Gone for good: from some age on (nearly) none has leaves, on three nodes and more.
  int last = oldest;
  std::size_t bare = 0;
  while (last >= 0 && shareIn(counts, last) <= 0.1 * best) {
    if (const auto found = counts.find(last); found != counts.end()) bare += found->second.size();
    --last;
  }
  if (bare >= 3 && last >= 0 && last < oldest) o.leafSpan = last + 1;
}

void setLeafSizes(OrderOutlook& o, const std::map<int, std::vector<double>>& sizes) {
  std::vector<double> all;
  for (const auto& [age, logs] : sizes) all.insert(all.end(), logs.begin(), logs.end());
  int oldest = sizes.rbegin()->first;
  // The youngest age from which leaves are within a tenth of all older ones.
  for (int age = 0; age <= oldest; ++age) {
    std::vector<double> here;
    std::vector<double> older;
    for (const auto& [a, logs] : sizes) (a <= age ? here : older).insert((a <= age ? here : older).end(), logs.begin(), logs.end());
    const auto own = sizes.find(age);
    if (own == sizes.end()) continue;
    if (older.empty() || medianOf(own->second) >= medianOf(older) + std::log(0.9)) {
      std::vector<double> grown = own->second;
      grown.insert(grown.end(), older.begin(), older.end());
      const Centre centre = centreOf(grown);
      o.leafLength = std::exp(centre.value);
      o.leafDeviation = centre.deviation;
      o.leafStages = std::max(1, age + (o.leafAtOwnTip ? 1 : 0));
      return;
    }
  }
}

}  // namespace

void setLeaves(OrderOutlook& o, std::span<const MeasuredPlant> plants, const LayeredStatistics& statistics) {
  std::map<int, std::vector<double>> countsByAge;  // leaves of segments of growing axes, by their distance from the tip
  std::map<int, std::vector<double>> sizesByAge;
  std::vector<double> petioles;
  std::map<int, std::size_t> perNode;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (std::size_t s = 0; s < plants[p].measurements->segments.size(); ++s) {
      const SegmentPlace& place = plants[p].structure->places[s];
      if (place.order != o.order) continue;
      const auto& leaves = plants[p].measurements->segments[s].leaves;
      if (statistics.schedule.plants[p].grows[static_cast<std::size_t>(place.axis.value)]) countsByAge[place.fromTip].push_back(leaves.empty() ? 0 : 1);
      for (const LeafMeasure& leaf : leaves) {
        sizesByAge[place.fromTip].push_back(std::log(leaf.length));
        petioles.push_back(leaf.petiole);
      }
      if (!leaves.empty()) ++perNode[static_cast<int>(leaves.size())];
    }
  if (perNode.empty()) return;
  o.perNode = std::max_element(perNode.begin(), perNode.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
  setLeafTimes(o, countsByAge);
  if (o.leafSpan && leavesFallWithAge(plants, statistics)) o.leafLasts = o.leafSpan;
  setLeafSizes(o, sizesByAge);
  o.petiole = medianOf(std::move(petioles));
  const Estimate& angle = statistics.of(Quantity::LeafAngle).nearest(o.order);
  o.leafAngle = angle.value;
  o.leafAngleDeviation = angle.deviation;
  o.leafWidth = o.leafLength * widthOverLength(plants, o.order);
}

}  // namespace axil::quantify
