#include "quantify/ages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace axil::quantify {

namespace {

constexpr std::size_t kFewestPlants = 5;
constexpr int kRounds = 40;
constexpr double kClearly = 3;  // of the log-likelihood: plants that look of many ages mostly are

/// Plants explained by a set of ages.
struct Explanation {
  double misfit = 0;          ///< half of Bayes' criterion
  std::vector<double> ages;   ///< the likeliest of each plant
};

/// The chance that all newest tips of a plant have ended.
double chanceOfEnd(const ShownAge& plant, const std::array<double, 2>& shares) {
  return std::pow(shares[0], plant.kinds[0].newest) * std::pow(shares[1], plant.kinds[1].newest);
}

class Explainer {
 public:
  Explainer(std::span<const ShownAge> plants, std::vector<double> ages) : plants_(plants), ages_(std::move(ages)), parts_(ages_.size(), 1 / static_cast<double>(ages_.size())) {
    for (std::size_t k = 0; k < 2; ++k) {
      double ended = 1, nodes = 2;
      for (const ShownAge& plant : plants_) ended += plant.kinds[k].ended, nodes += plant.kinds[k].nodes;
      shares_[k] = ended / nodes;
    }
  }

  Explanation explained() {
    for (int round = 0; round < kRounds; ++round) improve();
    Explanation result;
    const double numbers = static_cast<double>(ages_.size() - 1);
    result.misfit = -logLikelihood() + 0.5 * numbers * std::log(static_cast<double>(plants_.size()));
    for (const ShownAge& plant : plants_) {
      const std::vector<double> weights = weightsOf(plant);
      result.ages.push_back(ages_[static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin())]);
    }
    return result;
  }

 private:
  /// Of each age, how likely it is together with the plant's newest tips.
  [[nodiscard]] std::vector<double> weightsOf(const ShownAge& plant) const {
    std::vector<double> weights;
    for (std::size_t a = 0; a < ages_.size(); ++a)
      weights.push_back(ages_[a] < plant.now ? 0 : parts_[a] * (ages_[a] > plant.now ? chanceOfEnd(plant, shares_) : 1));
    return weights;
  }

  void improve() {
    std::vector<double> parts(ages_.size(), 0);
    std::array<double, 2> ended{0, 0}, nodes{0, 0};
    for (const ShownAge& plant : plants_) {
      const std::vector<double> weights = weightsOf(plant);
      double sum = 0, older = 0;
      for (std::size_t a = 0; a < ages_.size(); ++a) sum += weights[a], older += ages_[a] > plant.now ? weights[a] : 0;
      if (!(sum > 0)) continue;
      for (std::size_t a = 0; a < ages_.size(); ++a) parts[a] += weights[a] / sum / static_cast<double>(plants_.size());
      for (std::size_t k = 0; k < 2; ++k) {
        const double decided = plant.kinds[k].newest * older / sum;
        ended[k] += plant.kinds[k].ended + decided;
        nodes[k] += plant.kinds[k].nodes + decided;
      }
    }
    parts_ = parts;
    for (std::size_t k = 0; k < 2; ++k) shares_[k] = nodes[k] > 0 ? std::clamp(ended[k] / nodes[k], 1e-9, 1 - 1e-9) : 0.5;
  }

  [[nodiscard]] double logLikelihood() const {
    double log = 0;
    for (const ShownAge& plant : plants_) {
      double sum = 0;
      for (const double w : weightsOf(plant)) sum += w;
      log += std::log(std::max(sum, 1e-300));
      for (std::size_t k = 0; k < 2; ++k)
        log += plant.kinds[k].ended * std::log(shares_[k]) + (plant.kinds[k].nodes - plant.kinds[k].ended) * std::log(1 - shares_[k]);
    }
    return log;
  }

  std::span<const ShownAge> plants_;
  std::vector<double> ages_;
  std::vector<double> parts_;           ///< of the plants that are of each age
  std::array<double, 2> shares_{0, 0};  ///< of nodes at which an axis ends
};

std::vector<double> shownAges(std::span<const ShownAge> plants) {
  std::vector<double> ages;
  for (const ShownAge& plant : plants) ages.push_back(plant.now);
  return ages;
}

/// The logarithm of the ways to choose some of a number of ages: what looking among many costs (Chen and Chen 2008).
double logChoices(std::size_t of, std::size_t some) {
  const double n = static_cast<double>(of), k = static_cast<double>(some);
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// The set of ages among `candidates` that explains best, found by adding one at a time to the greatest.
Explanation fewestAges(std::span<const ShownAge> plants, std::vector<double> candidates) {
  std::vector<double> chosen{candidates.back()};
  candidates.pop_back();
  const std::size_t others = candidates.size();
  Explanation best = Explainer(plants, chosen).explained();
  while (!candidates.empty()) {
    std::size_t added = candidates.size();
    Explanation better = best;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      std::vector<double> more = chosen;
      more.push_back(candidates[c]);
      Explanation own = Explainer(plants, std::move(more)).explained();
      own.misfit += logChoices(others, chosen.size());
      if (own.misfit >= better.misfit) continue;
      better = std::move(own);
      added = c;
    }
    if (added == candidates.size()) break;
    best = std::move(better);
    chosen.push_back(candidates[added]);
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(added));
  }
  return best;
}

}  // namespace

std::vector<double> agesOf(std::span<const ShownAge> plants) {
  const std::vector<double> shown = shownAges(plants);
  std::vector<double> all = shown;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (plants.size() < kFewestPlants || all.size() < 2) return shown;
  const Explanation few = fewestAges(plants, all);
  const Explanation each = Explainer(plants, all).explained();
  return few.misfit + kClearly < each.misfit ? few.ages : shown;
}

}  // namespace axil::quantify
