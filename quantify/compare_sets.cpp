#include "quantify/compare.hpp"

#include "base/rng.hpp"
#include "quantify/plant_nodes.hpp"
#include "quantify/structure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace axil::quantify {

namespace {

constexpr std::size_t kMostExchanges = 999;
constexpr double kMostWork = 2e8;          // samples looked at
constexpr double kFewestArrangements = 100;
constexpr std::uint64_t kSeed = 19930101;

/// Kolmogorov's distribution: the chance of a distance as large, with Stephens' correction for small samples.
double chanceOf(double ks, double n) {
  const double x = ks * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
  if (x < 0.2) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

constexpr double kSame = 1e-9;  // lengths as shares of a height, radians: what differs by less differs by rounding alone

/// One number measured on a plant.
struct Drawn {
  double value = 0;
  std::size_t plant = 0;
};

struct Samples {
  const char* quantity;
  std::vector<Drawn> drawn;
};

void addSegments(std::vector<Samples>& all, const Measurements& m, StemEnds ends, std::size_t plant, double unit) {
  const PlantStructure structure = plantStructure(m, ends);
  std::size_t leaves = m.rootLeaves.size();
  const auto add = [&](std::size_t quantity, double value) { all[quantity].drawn.push_back({value, plant}); };
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    const SegmentPlace& place = structure.places[s];
    add(0, m.segments[s].length / unit);
    leaves += m.segments[s].leaves.size();
    for (const LeafMeasure& leaf : m.segments[s].leaves) add(7, leaf.length / unit);
    if (place.goesOn) add(3, place.branches);
    if (m.segments[s].parent) add(place.rank > 0 ? 1 : 2, m.segments[s].rotr.radians());
  }
  for (const Axis& axis : structure.axes) add(4, static_cast<double>(axis.segments.size()));
  add(5, static_cast<double>(m.segments.size()));
  add(6, static_cast<double>(leaves));
}

/// Of all plants, those of A before those of B; sorted by value.
std::vector<Samples> samplesOf(std::span<const Measurements> a, std::span<const Measurements> b) {
  double unit = 0;
  for (const Measurements& m : a) unit += heightOf(nodesOf(m)) / static_cast<double>(a.size());
  std::vector<Samples> all{{"length", {}}, {"bend", {}}, {"insertion", {}}, {"branches", {}}, {"axis_segments", {}}, {"plant_segments", {}}, {"leaves", {}}, {"leaf_length", {}}};
  std::vector<Measurements> both(a.begin(), a.end());
  both.insert(both.end(), b.begin(), b.end());
  const StemEnds ends = stemEndsOf(both);  // one measure for both sets
  for (std::size_t p = 0; p < both.size(); ++p) addSegments(all, both[p], ends, p, unit);
  for (Samples& samples : all)
    std::sort(samples.drawn.begin(), samples.drawn.end(), [](const Drawn& x, const Drawn& y) { return std::pair(x.value, x.plant) < std::pair(y.value, y.plant); });
  return all;
}

/// The distance between the samples of plants that are in the first set and those that are not.
double distanceBetween(const std::vector<Drawn>& sorted, const std::vector<bool>& first) {
  double n = 0;
  for (const Drawn& d : sorted) n += first[d.plant] ? 1 : 0;
  const double m = static_cast<double>(sorted.size()) - n;
  if (n == 0 || m == 0) return 0;
  double i = 0, j = 0, worst = 0;
  for (std::size_t at = 0; at < sorted.size();) {
    const double x = sorted[at].value;
    for (; at < sorted.size() && sorted[at].value <= x + kSame; ++at) (first[sorted[at].plant] ? i : j) += 1;
    worst = std::max(worst, std::abs(i / n - j / m));
  }
  // Sets of other sizes, other distances: brought to what tells them apart.
  return worst * std::sqrt(n * m / (n + m));
}

double arrangements(std::size_t a, std::size_t b) { return std::exp(std::lgamma(static_cast<double>(a + b) + 1) - std::lgamma(static_cast<double>(a) + 1) - std::lgamma(static_cast<double>(b) + 1)); }

/// Distances of every quantity, [exchange][quantity]; the sets as they are come first.
std::vector<std::vector<double>> exchanged(const std::vector<Samples>& samples, std::size_t a, std::size_t plants, std::size_t exchanges) {
  std::vector<bool> first(plants, false);
  std::fill(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(a), true);
  std::vector<std::vector<double>> distances;
  Rng rng(kSeed);
  for (std::size_t e = 0; e <= exchanges; ++e) {
    std::vector<double> row;
    for (const Samples& s : samples) row.push_back(distanceBetween(s.drawn, first));
    distances.push_back(std::move(row));
    for (std::size_t i = plants; i-- > 1;) {
      const auto j = static_cast<std::size_t>(rng.uniform() * static_cast<double>(i + 1));
      const bool own = first[i];
      first[i] = first[j];
      first[j] = own;
    }
  }
  return distances;
}

/// Of each row, the share of rows with a distance as large, per quantity.
std::vector<std::vector<double>> sharesAsLarge(const std::vector<std::vector<double>>& distances) {
  std::vector<std::vector<double>> shares(distances.size(), std::vector<double>(distances.front().size(), 1));
  for (std::size_t q = 0; q < distances.front().size(); ++q) {
    std::vector<double> sorted;
    for (const auto& row : distances) sorted.push_back(row[q]);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t e = 0; e < distances.size(); ++e) {
      const auto below = std::lower_bound(sorted.begin(), sorted.end(), distances[e][q] - kSame) - sorted.begin();
      shares[e][q] = static_cast<double>(sorted.size() - static_cast<std::size_t>(below)) / static_cast<double>(sorted.size());
    }
  }
  return shares;
}

void exchangePlants(SetComparison& result, const std::vector<Samples>& samples, std::size_t a, std::size_t plants) {
  double size = 1;
  for (const Samples& s : samples) size += static_cast<double>(s.drawn.size());
  result.exchanges = std::min(kMostExchanges, std::max<std::size_t>(99, static_cast<std::size_t>(kMostWork / size)));
  const auto shares = sharesAsLarge(exchanged(samples, a, plants, result.exchanges));
  for (std::size_t q = 0; q < samples.size(); ++q) result.distances[q].p = shares.front()[q];
  const auto least = [](const std::vector<double>& row) { return *std::min_element(row.begin(), row.end()); };
  const double own = least(shares.front());
  double asLow = 0;
  for (const auto& row : shares) asLow += least(row) <= own + kSame ? 1 : 0;
  result.p = asLow / static_cast<double>(shares.size());
}

}  // namespace

DistributionDistance distanceOf(std::string quantity, std::vector<double> a, std::vector<double> b) {
  DistributionDistance d;
  d.quantity = std::move(quantity);
  d.samplesA = a.size();
  d.samplesB = b.size();
  if (a.empty() || b.empty()) return d;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  d.meanA = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
  d.meanB = std::accumulate(b.begin(), b.end(), 0.0) / static_cast<double>(b.size());
  std::size_t i = 0;
  std::size_t j = 0;
  double last = std::min(a.front(), b.front());
  while (i < a.size() || j < b.size()) {
    const double x = i == a.size() ? b[j] : j == b.size() ? a[i] : std::min(a[i], b[j]);
    const double apart = std::abs(static_cast<double>(i) / static_cast<double>(a.size()) - static_cast<double>(j) / static_cast<double>(b.size()));
    d.wasserstein += apart * (x - last);
    last = x;
    while (i < a.size() && a[i] <= x + kSame) ++i;
    while (j < b.size() && b[j] <= x + kSame) ++j;
    d.ks = std::max(d.ks, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) - static_cast<double>(j) / static_cast<double>(b.size())));
  }
  const double n = static_cast<double>(a.size()) * static_cast<double>(b.size()) / static_cast<double>(a.size() + b.size());
  d.p = d.pIndependent = chanceOf(d.ks, n);
  return d;
}

Result<SetComparison> compareSets(std::span<const Measurements> a, std::span<const Measurements> b) {
  if (a.empty() || b.empty()) return fail(ErrorCode::BadInput, "a set has no plant; give at least one on either side");
  for (const auto& set : {a, b})
    for (const Measurements& m : set) {
      if (m.segments.empty()) return fail(ErrorCode::NoAnswer, "a plant without a segment cannot be compared; measure one stem at least");
      if (m.unit != a.front().unit) return fail(ErrorCode::BadInput, "the plants' lengths are in " + a.front().unit + " and in " + m.unit + "; bring all to one unit");
    }
  const std::vector<Samples> samples = samplesOf(a, b);
  SetComparison result;
  for (const Samples& s : samples) {
    std::vector<double> x, y;
    for (const Drawn& d : s.drawn) (d.plant < a.size() ? x : y).push_back(d.value);
    result.distances.push_back(distanceOf(s.quantity, std::move(x), std::move(y)));
  }
  if (arrangements(a.size(), b.size()) >= kFewestArrangements) {
    exchangePlants(result, samples, a.size(), a.size() + b.size());
    return result;
  }
  double tests = 0;
  for (const DistributionDistance& d : result.distances) {
    tests += d.samplesA > 0 && d.samplesB > 0 ? 1 : 0;
    result.p = std::min(result.p, d.p);
  }
  result.p = std::min(1.0, result.p * std::max(1.0, tests));
  return result;
}

}  // namespace axil::quantify
