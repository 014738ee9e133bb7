#include "quantify/fates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace axil::quantify {

namespace {

constexpr int kMostFirstRanks = 12;
constexpr int kMostPeriod = 8;
constexpr double kNodesANumber = 4;  // fewer nodes fit any table of ranks
constexpr double kCertain = 8;   // nodes that agree leave no doubt

using Counts = std::vector<std::vector<double>>;  // [row][fate]

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

double logLikelihood(const Counts& counts) {
  double log = 0;
  for (const auto& row : counts) {
    const double n = sumOf(row);
    for (const double c : row)
      if (c > 0) log += c * std::log(c / n);
  }
  return log;
}

/// Nodes as (rank, index of their fate).
struct Node {
  int rank = 0;
  std::size_t fate = 0;
};

class Fitter {
 public:
  explicit Fitter(std::span<const NodeFate> nodes) {
    std::map<std::pair<bool, int>, std::size_t> kinds;
    for (const NodeFate& n : nodes) kinds[{!n.goesOn, n.branches}] = 0;
    for (auto& [kind, index] : kinds) {
      index = table_.fates.size();
      table_.fates.push_back({!kind.first, kind.second, 0, 0});
    }
    for (const NodeFate& n : nodes) {
      nodes_.push_back({n.rank, kinds.at({!n.goesOn, n.branches})});
      ++table_.fates[nodes_.back().fate].count;
      last_ = std::max(last_, n.rank);
    }
    for (Fate& fate : table_.fates) fate.share = static_cast<double>(fate.count) / static_cast<double>(nodes_.size());
  }

  FateTable table() {
    if (table_.fates.size() < 2) {
      if (table_.fates.empty()) table_.fates = {{true, 0, 1, 0}};
      table_.byRank = {{1}};
      table_.seen = {static_cast<double>(nodes_.size())};
      return std::move(table_);
    }
    const double free = static_cast<double>(table_.fates.size() - 1);
    take(FateTable::Shape::Alike, countsBy(1, [](int) { return 0; }), free);
    for (int first = 2; first <= std::min(kMostFirstRanks, last_ + 1); ++first)
      take(FateTable::Shape::FirstRanks, countsBy(first, [first](int rank) { return std::min(rank, first - 1); }), free * first);
    for (int period = 2; period <= std::min(kMostPeriod, (last_ + 1) / 2); ++period)
      take(FateTable::Shape::Periodic, countsBy(period, [period](int rank) { return rank % period; }), free * period);
    takeRising(free);
    return std::move(table_);
  }

 private:
  template <class RowOf>
  [[nodiscard]] Counts countsBy(int rows, RowOf rowOf) const {
    Counts counts(static_cast<std::size_t>(rows), std::vector<double>(table_.fates.size(), 0));
    for (const Node& n : nodes_) counts[static_cast<std::size_t>(rowOf(n.rank))][n.fate] += 1;
    return counts;
  }
  [[nodiscard]] double criterion(double logLikelihood, double numbers) const { return -2 * logLikelihood + numbers * std::log(static_cast<double>(nodes_.size())); }

  void take(FateTable::Shape shape, const Counts& counts, double numbers) {
    const bool few = counts.size() > 1 && static_cast<double>(nodes_.size()) < kNodesANumber * numbers;
    if (few || std::any_of(counts.begin(), counts.end(), [](const auto& row) { return sumOf(row) == 0; })) return;
    const double own = criterion(logLikelihood(counts), numbers);
    if (own >= least_) return;
    least_ = own;
    table_.shape = shape;
    table_.byRank.clear();
    table_.seen.clear();
    for (const auto& row : counts) {
      const double n = sumOf(row);
      const bool certain = n >= kCertain && std::count(row.begin(), row.end(), n) == 1;
      // Half an observation of the whole keeps rows that were seldom seen from being certain.
      const double prior = certain || counts.size() == 1 ? 0 : 0.5;
      std::vector<double> shares;
      for (std::size_t f = 0; f < row.size(); ++f) shares.push_back((row[f] + prior * table_.fates[f].share) / (n + prior));
      table_.byRank.push_back(std::move(shares));
      table_.seen.push_back(n);
    }
  }

  /// Logistic regression of branching on rank, by Newton's method.
  struct Odds {
    double start = 0;
    double slope = 0;
    [[nodiscard]] double at(double rank) const { return 1 / (1 + std::exp(-start - slope * rank)); }
  };
  [[nodiscard]] bool branches(const Node& n) const { return table_.fates[n.fate].branches > 0; }
  [[nodiscard]] std::optional<Odds> fittedOdds(double share) const {
    Odds odds{std::log(share / (1 - share)), 0};
    for (int step = 0; step < 40; ++step) {
      double g0 = 0, g1 = 0, h00 = 1e-9, h01 = 0, h11 = 1e-9;
      for (const Node& n : nodes_) {
        const double p = odds.at(n.rank), off = (branches(n) ? 1 : 0) - p, w = p * (1 - p);
        g0 += off; g1 += off * n.rank;
        h00 += w; h01 += w * n.rank; h11 += w * n.rank * n.rank;
      }
      const double d = h00 * h11 - h01 * h01;
      if (!(d > 1e-12)) return std::nullopt;
      const double a = (h11 * g0 - h01 * g1) / d, b = (h00 * g1 - h01 * g0) / d;
      // Short steps: data that are split cleanly have no finite answer.
      odds.start += std::clamp(a, -2.0, 2.0);
      odds.slope += std::clamp(b, -0.5, 0.5);
      if (std::abs(a) < 1e-9 && std::abs(b) < 1e-9) break;
    }
    return std::isfinite(odds.start) && std::isfinite(odds.slope) ? std::optional(odds) : std::nullopt;
  }

  void takeRising(double free) {
    double share = 0;
    for (const Fate& f : table_.fates) share += f.branches > 0 ? f.share : 0;
    if (share <= 0 || share >= 1 || last_ < 2) return;
    const auto odds = fittedOdds(share);
    if (!odds) return;
    double log = 0;
    for (const Node& n : nodes_) {
      const double p = std::clamp(odds->at(n.rank), 1e-9, 1 - 1e-9);
      const double within = table_.fates[n.fate].share / (branches(n) ? share : 1 - share);
      log += std::log((branches(n) ? p : 1 - p) * within);
    }
    if (criterion(log, free + 1) >= least_) return;
    least_ = criterion(log, free + 1);
    table_.shape = FateTable::Shape::Rising;
    table_.byRank.clear();
    // The trend goes on to twice the highest rank seen.
    for (int rank = 0; rank <= 2 * last_ + 1; ++rank) {
      const double p = odds->at(rank);
      std::vector<double> shares;
      for (const Fate& f : table_.fates) shares.push_back(f.branches > 0 ? p * f.share / share : (1 - p) * f.share / (1 - share));
      table_.byRank.push_back(std::move(shares));
    }
    table_.seen.assign(table_.byRank.size(), static_cast<double>(nodes_.size()));
  }

  FateTable table_;
  std::vector<Node> nodes_;
  int last_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::size_t FateTable::rowOf(int rank) const {
  const auto r = static_cast<std::size_t>(std::max(0, rank));
  return shape == Shape::Periodic ? r % byRank.size() : std::min(r, byRank.size() - 1);
}

double FateTable::branchingAt(int rank) const {
  const auto& shares = at(rank);
  double sum = 0;
  for (std::size_t f = 0; f < fates.size(); ++f) sum += fates[f].branches > 0 ? shares[f] : 0;
  return sum;
}

FateTable fateTableOf(std::span<const NodeFate> nodes) { return Fitter(nodes).table(); }

}  // namespace axil::quantify
