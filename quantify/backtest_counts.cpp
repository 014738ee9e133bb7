#include "base/rng.hpp"
#include "quantify/backtest_parts.hpp"
#include "quantify/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace axil::quantify {

namespace {

constexpr int kGrown = 400;
constexpr std::uint64_t kSeed = 20050607;
constexpr double kMostOrgans = 1e6;  // of a grown plant; more is a plant out of hand, and no forecast

/// Grows numbers of organs from an outlook.
class Counter {
 public:
  Counter(const Outlook& outlook, Rng& rng) : outlook_(outlook), rng_(rng) {
    for (const OrderOutlook& o : outlook.orders) fates_.push_back(drawnFates(o.fates));
  }

  Organs grown(int stages) {
    organs_ = {};
    for (const TipOutlook& tip : outlook_.tips) apex(tip.order, tip.nextRank, stages);
    for (const BudOutlook& bud : outlook_.buds)
      if (bud.waits < stages && rng_.uniform() < bud.share) start(bud.order, stages - bud.waits);
    return organs_;
  }

 private:
  /// Shares as unsure as their nodes leave them. Rows that tell one trend stray together.
  FateTable drawnFates(FateTable table) {
    std::vector<double> strays;
    for (std::size_t row = 0; row < table.byRank.size(); ++row) {
      auto& shares = table.byRank[row];
      double sum = 0;
      for (std::size_t f = 0; f < shares.size(); ++f) {
        if (row == 0 || table.shape != FateTable::Shape::Rising) strays.resize(shares.size()), strays[f] = rng_.normal();
        const double n = std::max(1.0, table.seen[row]);
        shares[f] = std::max(0.0, shares[f] + std::sqrt(shares[f] * (1 - shares[f]) / n) * strays[f]);
        sum += shares[f];
      }
      for (double& share : shares) share = sum > 0 ? share / sum : 1.0 / static_cast<double>(shares.size());
    }
    return table;
  }

  [[nodiscard]] std::size_t indexOf(int order) const { return static_cast<std::size_t>(std::min(order, static_cast<int>(outlook_.orders.size()) - 1)); }

  void leavesOn(const OrderOutlook& o) {
    if (o.perNode > 0 && rng_.uniform() < o.leafShare) organs_.leaves += o.perNode;
  }

  void start(int order, int stages) {
    if (stages <= 0) return;
    organs_.segments += 1;
    const OrderOutlook& o = outlook_.of(order);
    if (o.leafAtOwnTip) leavesOn(o);
    apex(order, 1, stages - 1);
  }

  void apex(int order, int rank, int stages) {
    const std::size_t place = indexOf(order);
    const OrderOutlook& o = outlook_.orders[place];
    for (; stages > 0 && organs_.segments < kMostOrgans; --stages) {
      if (o.most && rank >= *o.most) return;
      if (!o.schedule.steady && rng_.uniform() >= o.schedule.rate) continue;
      const Fate fate = drawn(fates_[place], rank - 1);
      if (!o.leafAtOwnTip) leavesOn(o);
      for (int b = 0; b < fate.branches; ++b) start(order + 1, stages - o.delay);
      if (!fate.goesOn) return;
      organs_.segments += 1;
      if (o.leafAtOwnTip) leavesOn(o);
      ++rank;
    }
  }

  Fate drawn(const FateTable& table, int rank) {
    const std::vector<double>& shares = table.at(rank);
    double u = rng_.uniform();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      u -= shares[i];
      if (u < 0) return table.fates[i];
    }
    return table.fates.back();
  }

  const Outlook& outlook_;
  Rng& rng_;
  std::vector<FateTable> fates_;
  Organs organs_;
};

/// The whole numbers between which the share of `sorted` nearest to 90 % lies, of intervals whose tails are alike.
constexpr double kHeld = 0.9;
std::pair<double, double> holdingNinety(const std::vector<double>& sorted) {
  const double n = static_cast<double>(sorted.size());
  const double middle = medianOf(sorted);
  std::pair<double, double> best{sorted.front(), sorted.back()};
  double least = 1;
  for (std::size_t tail = 0; 2 * tail < sorted.size(); ++tail) {
    // Whole numbers leave steps: each end may take a whole number more or less.
    for (const auto& [low, high] : {std::pair(sorted[tail], sorted[sorted.size() - 1 - tail]), std::pair(sorted[tail] + 1, sorted[sorted.size() - 1 - tail]),
                                    std::pair(sorted[tail], sorted[sorted.size() - 1 - tail] - 1)}) {
      if (low > middle || high < middle) continue;
      const auto from = std::lower_bound(sorted.begin(), sorted.end(), low), to = std::upper_bound(sorted.begin(), sorted.end(), high);
      const double off = std::abs(static_cast<double>(to - from) / n - kHeld);
      if (off >= least) continue;
      least = off;
      best = {low, high};
    }
  }
  return best;
}

/// The number with the least mean percentage error of all organs, `earlier` ones and new, against `sorted`: their median, each weighing as much as a miss of one costs there.
double leastPercentage(const std::vector<double>& sorted, double earlier) {
  double all = 0, below = 0;
  for (const double v : sorted) all += 1 / (earlier + v);
  for (const double v : sorted) {
    below += 1 / (earlier + v);
    if (2 * below >= all) return v;
  }
  return sorted.back();
}

}  // namespace

void countOrgans(BacktestOfPlant& result, const Organs& earlier, const Outlook& outlook, int stages) {
  std::vector<double> segments;
  std::vector<double> leaves;
  for (int g = 0; g < kGrown; ++g) {
    Rng rng = Rng(kSeed).split(static_cast<std::uint64_t>(g));
    const Organs organs = Counter(outlook, rng).grown(stages);
    segments.push_back(organs.segments);
    leaves.push_back(organs.leaves);
  }
  // No plant is without a segment; of leaves one stands for none.
  const auto fill = [](ForetoldCount& count, std::vector<double> values, double before) {
    std::sort(values.begin(), values.end());
    for (const double v : values) count.mean += v / static_cast<double>(values.size());
    count.foretold = leastPercentage(values, std::max(1.0, before));
    std::tie(count.low, count.high) = holdingNinety(values);
    for (const double v : values) count.chance += std::abs(v - count.foretold) / static_cast<double>(values.size());
  };
  fill(result.newSegments, segments, earlier.segments);
  fill(result.newLeaves, leaves, earlier.leaves);
}

}  // namespace axil::quantify
