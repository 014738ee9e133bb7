#include "skeleton3d/stem_colour.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

constexpr int kBins = 16;  ///< a channel

/// Colours counted in bins; each colour also counts in the bins about it.
class Histogram {
 public:
  void add(const std::uint8_t* rgb, double weight) { counts_[bin(rgb[0] / kBins, rgb[1] / kBins, rgb[2] / kBins)] += weight, total_ += weight; }
  [[nodiscard]] double total() const { return total_; }

  /// Share of a bin, spread over its neighbours with weights 1/4, 1/2, 1/4 a channel.
  [[nodiscard]] std::vector<double> shares() const {
    std::vector<double> from = counts_, to(counts_.size());
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kBins * kBins * kBins; ++i) {
        const int stride = axis == 0 ? kBins * kBins : axis == 1 ? kBins : 1, place = i / stride % kBins;
        const double here = from[static_cast<std::size_t>(i)];
        to[static_cast<std::size_t>(i)] = 0.5 * here + 0.25 * (place > 0 ? from[static_cast<std::size_t>(i - stride)] : here) +
                                          0.25 * (place + 1 < kBins ? from[static_cast<std::size_t>(i + stride)] : here);
      }
      std::swap(from, to);
    }
    for (double& share : from) share /= std::max(total_, 1.0);
    return from;
  }

  static std::size_t bin(int r, int g, int b) { return static_cast<std::size_t>((r * kBins + g) * kBins + b); }

 private:
  std::vector<double> counts_ = std::vector<double>(kBins * kBins * kBins, 0.0);
  double total_ = 0;
};

const std::uint8_t* pixelAt(const Photo& photo, glm::dvec2 at) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  if (x < 0 || y < 0 || x >= photo.width || y >= photo.height) return nullptr;
  return photo.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width) + static_cast<std::size_t>(x));
}

void addSamples(const Photo& photo, const EdgePair& edges, double least, Histogram& inside, Histogram& beside) {
  if (edges.strength < least) return;
  const glm::dvec2 middle = 0.5 * (edges.left + edges.right), half = 0.5 * (edges.right - edges.left);
  const double length = glm::length(half);
  if (!(length > 0)) return;
  const glm::dvec2 out = half / length;
  for (const double f : {-0.6, -0.3, 0.0, 0.3, 0.6})
    if (const auto* p = pixelAt(photo, middle + f * half)) inside.add(p, 0.2);
  for (const double away : {3.0, 5.0, 8.0, 12.0})
    for (const double sign : {-1.0, 1.0})
      if (const auto* p = pixelAt(photo, middle + sign * (length + away) * out)) beside.add(p, 0.125);
}

double medianStrength(std::span<const std::vector<EdgePair>> stems) {
  std::vector<double> all;
  for (const auto& stem : stems)
    for (const EdgePair& e : stem) all.push_back(e.strength);
  if (all.empty()) return 0;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

}  // namespace

StemLikelihood likelihoodOf(const Photo& photo, std::span<const std::vector<EdgePair>> stems) {
  Histogram inside, beside;
  const double least = std::max(0.5 * medianStrength(stems), 4.0);
  for (const auto& stem : stems)
    for (const EdgePair& edges : stem) addSamples(photo, edges, least, inside, beside);
  if (inside.total() < 40) return {};
  const std::vector<double> in = inside.shares(), by = beside.shares();
  std::vector<std::uint8_t> table;
  double told = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double share = in[i] / (in[i] + by[i] + 2e-5);
    told += in[i] * share - by[i] * share;
    table.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  if (told < 0.3) return {};
  StemLikelihood likelihood;
  likelihood.reserve(photo.rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < photo.rgb.size(); i += 3)
    likelihood.push_back(table[Histogram::bin(photo.rgb[i] / kBins, photo.rgb[i + 1] / kBins, photo.rgb[i + 2] / kBins)]);
  return likelihood;
}

}  // namespace axil::skeleton3d::detail
