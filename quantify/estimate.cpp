#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace axil::quantify {

namespace {

constexpr double kTuning = 1.345;       // Huber: 95 % efficient on normal samples
constexpr double kNormalMad = 1.4826;
constexpr int kSteps = 50;
constexpr int kRounds = 10;             // of a trend
constexpr double kMostExtrapolation = 10;
constexpr double kClear = 2;            // standard errors by which a layer is another thing than its parent
constexpr double kCertain = 5;          // and by which it has nothing to do with it
constexpr double kFewNodes = 100;       // a share of more is drawn to its parent the less
constexpr double kNormalTail = 2.3;     // deviations beyond which plants are said to differ, 1 %

/// Reorders `values`.
double quantileAmong(std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), below, values.end());
  if (below + 1 == values.end()) return *below;
  return *below + (at - std::floor(at)) * (*std::min_element(below + 1, values.end()) - *below);
}

double meanOf(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double deviationAround(std::span<const double> values, double centre) {
  if (values.size() < 2) return 0;
  double sum = 0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Samples by plant, in the order of plants.
std::map<std::size_t, std::vector<double>> byPlant(std::span<const Sample> samples) {
  std::map<std::size_t, std::vector<double>> plants;
  for (const Sample& s : samples) plants[s.plant].push_back(s.value);
  return plants;
}

/// The deviation within plants, all plants together.
double withinOf(const std::map<std::size_t, std::vector<double>>& plants, const std::vector<Centre>& centres) {
  double squares = 0;
  double freedom = 0;
  std::size_t p = 0;
  for (const auto& [plant, values] : plants) {
    const double n = static_cast<double>(values.size());
    squares += centres[p].deviation * centres[p].deviation * (n - 1);
    freedom += n - 1;
    ++p;
  }
  return freedom > 0 ? std::sqrt(squares / freedom) : 0;
}

/// How much shares of plants differ beyond chance, where p is all plants' share and each makes `own[i]` of them. How many nodes a plant has may hang on what became of the
/// first ones (an axis that ends has no more), so a plant's own share is no binomial one; but its sum of (sample - p) is as wide as p (1 - p) times its nodes, whatever stopped it.
double betweenShares(std::span<const double> own, std::span<const double> counts, double p) {
  double n = 0, squares = 0, off = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    n += counts[i];
    squares += counts[i] * counts[i];
    off += std::pow(counts[i] * (own[i] - p), 2);
  }
  const double single = p * (1 - p);
  const double byChance = single * (n - squares / n);
  if (off <= byChance + kNormalTail * single * std::sqrt(2 * squares)) return 0;
  return std::sqrt((off - byChance) / squares);
}

/// The mean of shares: of all nodes alike, unless plants differ by more than chance.
Combined combinedShares(std::span<const double> own, std::span<const double> counts, double p) {
  Combined result;
  result.between = betweenShares(own, counts, p);
  double weights = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double w = result.between > 0 ? 1 / (p * (1 - p) / counts[i] + result.between * result.between) : counts[i];
    weights += w;
    result.value += w * own[i];
  }
  result.value /= weights;
  result.error = result.between > 0 ? std::sqrt(1 / weights) : std::sqrt(p * (1 - p) / weights);
  return result;
}

/// The samples of one axis: ranks, and what was measured there (its logarithm).
struct AxisPoints {
  std::vector<double> ranks, values;
};
std::vector<AxisPoints> axisPoints(std::span<const Sample> samples, std::span<const std::size_t> axisOf, bool logarithmic) {
  std::map<std::size_t, std::size_t> places;
  std::vector<AxisPoints> axes;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (logarithmic && !(samples[i].value > 0)) continue;
    const auto place = places.try_emplace(axisOf[i], axes.size());
    if (place.second) axes.emplace_back();
    AxisPoints& axis = axes[place.first->second];
    axis.ranks.push_back(samples[i].rank);
    axis.values.push_back(logarithmic ? std::log(samples[i].value) : samples[i].value);
  }
  return axes;
}

/// The slope of least squares within axes, in which what lies further than `reach` from the median level of its axis (along the slope before) counts less.
struct Slope {
  double value = 0;
  double squares = 0;                                ///< of ranks around their axis' mean
  std::vector<std::pair<double, double>> centres;    ///< of each axis
};
Slope slopeOf(const std::vector<AxisPoints>& axes, double before, double reach) {
  Slope slope;
  double products = 0;
  std::vector<double> levels, weights;
  for (const AxisPoints& axis : axes) {
    const std::size_t n = axis.ranks.size();
    weights.assign(n, 1);
    if (n > 1 && std::isfinite(reach)) {
      levels.resize(n);
      for (std::size_t i = 0; i < n; ++i) weights[i] = levels[i] = axis.values[i] - before * axis.ranks[i];
      const double level = quantileAmong(levels, 0.5);
      for (double& w : weights) w = std::min(1.0, reach / std::max(std::abs(w - level), 1e-300));
    }
    double w = 0, x = 0, y = 0;
    for (std::size_t i = 0; i < n; ++i) w += weights[i], x += weights[i] * axis.ranks[i], y += weights[i] * axis.values[i];
    x /= w, y /= w;
    slope.centres.emplace_back(x, y);
    for (std::size_t i = 0; i < n; ++i) {
      slope.squares += weights[i] * (axis.ranks[i] - x) * (axis.ranks[i] - x);
      products += weights[i] * (axis.ranks[i] - x) * (axis.values[i] - y);
    }
  }
  slope.value = slope.squares > 0 ? products / slope.squares : 0;
  return slope;
}

}  // namespace

double quantileOf(std::vector<double> values, double share) { return quantileAmong(values, share); }

double medianOf(std::vector<double> values) { return quantileOf(std::move(values), 0.5); }

Centre centreOf(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> copy(values.begin(), values.end());
  const double median = quantileAmong(copy, 0.5);
  for (double& v : copy) v = std::abs(v - median);
  const double scale = kNormalMad * quantileAmong(copy, 0.5);
  const double mean = meanOf(values);
  // More than half of the samples alike (or too few to tell): the scale of all of them.
  if (values.size() < 3 || scale <= 0) {
    const bool constant = scale <= 0 && values.size() >= 3;
    const double centre = constant ? median : mean;
    const double deviation = deviationAround(values, mean);
    if (!constant || deviation == 0) return {centre, deviation};
    // Mostly one value, some others: a mixture, of which the mean is what repeats.
    return {mean, deviation};
  }
  double centre = median;
  for (int step = 0; step < kSteps; ++step) {
    double sum = 0;
    double weight = 0;
    for (const double v : values) {
      const double off = std::abs(v - centre) / scale;
      const double w = off <= kTuning ? 1 : kTuning / off;
      sum += w * v;
      weight += w;
    }
    const double next = sum / weight;
    const bool still = std::abs(next - centre) <= 1e-12 * scale;
    centre = next;
    if (still) break;
  }
  std::vector<double> winsorised(values.begin(), values.end());
  constexpr double kReach = 4;  // further out is a slip, not spread
  for (double& v : winsorised) v = std::clamp(v, centre - kReach * scale, centre + kReach * scale);
  return {centre, deviationAround(winsorised, meanOf(winsorised))};
}

Combined combined(std::span<const double> values, std::span<const double> variances) {
  Combined result;
  const std::size_t k = values.size();
  if (k == 0) return result;
  const double most = *std::max_element(variances.begin(), variances.end());
  if (most <= 0 || k == 1) {  // exact values differ only between themselves
    result.value = meanOf(values);
    result.between = deviationAround(values, result.value);
    result.error = k > 1 ? result.between / std::sqrt(static_cast<double>(k)) : std::sqrt(most);
    return result;
  }
  const double floor = 1e-9 * most;
  double sum = 0;
  double sumSquares = 0;
  double weighted = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const double w = 1 / std::max(variances[i], floor);
    sum += w;
    sumSquares += w * w;
    weighted += w * values[i];
  }
  const double fixed = weighted / sum;
  double q = 0;
  for (std::size_t i = 0; i < k; ++i) q += (values[i] - fixed) * (values[i] - fixed) / std::max(variances[i], floor);
  const double tau2 = std::max(0.0, (q - static_cast<double>(k - 1)) / (sum - sumSquares / sum));
  double weights = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const double w = 1 / (std::max(variances[i], floor) + tau2);
    weights += w;
    result.value += w * values[i];
  }
  result.value /= weights;
  result.error = std::sqrt(1 / weights);
  result.between = std::sqrt(tau2);
  return result;
}

double betweenGroups(std::span<const std::vector<double>> groups) {
  constexpr double kFewest = 8, kClearly = 3;
  double count = 0, squares = 0, members = 0, all = 0, within = 0, between = 0;
  for (const auto& group : groups) {
    if (group.size() < 2) continue;
    const double n = static_cast<double>(group.size());
    count += 1;
    members += n;
    squares += n * n;
    all += n * meanOf(group);
    within += (n - 1) * std::pow(deviationAround(group, meanOf(group)), 2);
  }
  if (count < kFewest) return 0;
  for (const auto& group : groups)
    if (group.size() > 1) between += static_cast<double>(group.size()) * std::pow(meanOf(group) - all / members, 2);
  within /= members - count;
  between /= count - 1;
  const double byChance = std::sqrt(2 / (count - 1) + 2 / (members - count));
  if (between <= (1 + kClearly * byChance) * within) return 0;
  return std::sqrt((between - within) * (count - 1) / (members - squares / members));
}

Estimate estimateOf(std::span<const Sample> samples, SampleKind kind) {
  Estimate estimate;
  estimate.samples = samples.size();
  if (samples.empty()) return estimate;
  const auto plants = byPlant(samples);
  estimate.plants = plants.size();
  std::vector<Centre> centres;
  std::vector<double> all;
  for (const auto& [plant, values] : plants) {
    centres.push_back(kind == SampleKind::Share ? Centre{meanOf(values), deviationAround(values, meanOf(values))} : centreOf(values));
    all.insert(all.end(), values.begin(), values.end());
  }
  const double mean = meanOf(all);
  double within = withinOf(plants, centres);
  if (kind == SampleKind::Share) within = std::sqrt(mean * (1 - mean));
  // One sample a plant: plants and samples cannot be told apart.
  else if (all.size() == plants.size()) within = deviationAround(all, mean);
  std::vector<double> values;
  std::vector<double> variances, counts;
  std::size_t p = 0;
  for (const auto& [plant, own] : plants) {
    values.push_back(centres[p++].value);
    counts.push_back(static_cast<double>(own.size()));
    variances.push_back(within * within / static_cast<double>(own.size()));
  }
  const Combined all2 = kind == SampleKind::Share ? combinedShares(values, counts, mean) : combined(values, variances);
  estimate.own = estimate.value = all2.value;
  estimate.error = all2.error;
  estimate.between = all2.between;
  estimate.deviation = within;
  constexpr std::size_t kEnough = 20;
  estimate.low = quantileOf(all, all.size() < kEnough ? 0 : 0.05);
  estimate.high = quantileOf(all, all.size() < kEnough ? 1 : 0.95);
  return estimate;
}

void pool(std::vector<Estimate*>& sisters, std::span<const double> expected, SampleKind kind) {
  if (sisters.size() < 2) return;
  std::vector<double> off;
  std::vector<double> variances;
  double widest = 0;
  for (const Estimate* e : sisters) widest = std::max(widest, e->deviation);
  for (std::size_t i = 0; i < sisters.size(); ++i) {
    // A single sample has no spread of its own; it is as unsure as a sample of its sisters.
    double spread = std::max(sisters[i]->error, sisters[i]->samples < 2 ? widest : 0);
    if (kind == SampleKind::Share) spread = std::max(spread, std::sqrt(std::max(0.0, expected[i] * (1 - expected[i])) / static_cast<double>(std::max<std::size_t>(1, sisters[i]->samples))));
    off.push_back(sisters[i]->own - expected[i]);
    variances.push_back(spread * spread);
  }
  const double between = combined(off, variances).between;
  for (std::size_t i = 0; i < sisters.size(); ++i) {
    const double unsure = variances[i];
    const double total = unsure + between * between;
    // A layer that is clearly off its parent is another thing, and keeps to itself (the limited translation of Efron and Morris 1972).
    const double far = unsure > 0 ? off[i] * off[i] / unsure : 0;
    const double clearly = far > kCertain * kCertain ? 0 : far > kClear * kClear ? kClear * kClear / far : 1;
    const double few = kind == SampleKind::Share ? std::min(1.0, kFewNodes / static_cast<double>(std::max<std::size_t>(1, sisters[i]->samples))) : 1;
    sisters[i]->pooled = total > 0 ? few * clearly * unsure / total : 0;
    sisters[i]->value = sisters[i]->own - sisters[i]->pooled * off[i];
  }
}

double Trend::at(double rank) const {
  const double y = start + slope * rank;
  if (!logarithmic) return y;
  const double last = start + slope * lastRank;
  const double most = std::log(kMostExtrapolation);
  return std::exp(rank > lastRank ? std::clamp(y, last - most, last + most) : y);
}

double Trend::step() const { return logarithmic ? std::exp(slope) : slope; }

Trend trendOf(std::span<const Sample> samples, std::span<const std::size_t> axisOf, bool logarithmic) {
  Trend trend;
  trend.logarithmic = logarithmic;
  const std::vector<AxisPoints> axes = axisPoints(samples, axisOf, logarithmic);
  for (const AxisPoints& axis : axes) {
    trend.samples += axis.ranks.size();
    trend.lastRank = std::max(trend.lastRank, static_cast<int>(*std::max_element(axis.ranks.begin(), axis.ranks.end())));
  }
  if (trend.samples == 0) return trend;
  // Within axes: what axes start from does not enter the slope. Huber's weights, a few rounds.
  double reach = std::numeric_limits<double>::infinity();
  std::vector<double> starts(axes.size());
  for (int round = 0; round < kRounds; ++round) {
    const Slope slope = slopeOf(axes, trend.slope, reach);
    const bool still = round > 0 && std::abs(slope.value - trend.slope) <= 1e-12 * std::abs(slope.value);
    trend.slope = slope.value;
    double squares = 0;
    std::vector<double> offs;
    offs.reserve(trend.samples);
    for (std::size_t a = 0; a < axes.size(); ++a) {
      starts[a] = slope.centres[a].second - trend.slope * slope.centres[a].first;
      for (std::size_t i = 0; i < axes[a].ranks.size(); ++i) {
        offs.push_back(std::abs(axes[a].values[i] - starts[a] - trend.slope * axes[a].ranks[i]));
        squares += offs.back() * offs.back();
      }
    }
    const double freedom = static_cast<double>(trend.samples) - static_cast<double>(axes.size()) - 1;
    trend.residual = freedom > 0 ? std::sqrt(squares / freedom) : 0;
    trend.slopeError = slope.squares > 0 ? trend.residual / std::sqrt(slope.squares) : 0;
    reach = 2 * std::max(kNormalMad * quantileAmong(offs, 0.5), 1e-12);
    if (still) break;
  }
  const Centre centre = centreOf(starts);
  trend.start = centre.value;
  trend.axisDeviation = centre.deviation;
  return trend;
}

}  // namespace axil::quantify
