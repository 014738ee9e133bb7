#include "quantify/arms.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace axil::quantify {

namespace {

constexpr double kApart = 2.5;
constexpr std::size_t kFewestNodes = 4;
constexpr double kAlike = 1e-3;   // radians, and of logarithms: what differs by less is rounding

/// An axis at a node, and what it may be told by.
struct Candidate {
  ArmMember member;
  double lean = 0;
  double shortness = 0;   ///< -log of its length over its bearer's
};

std::map<int, std::vector<std::vector<Candidate>>> nodesByCount(std::span<const MeasuredPlant> plants, int low, int high) {
  std::map<int, std::vector<std::vector<Candidate>>> nodes;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const Measurements& m = *plants[p].measurements;
    const PlantStructure& structure = *plants[p].structure;
    for (std::size_t s = 0; s < m.segments.size(); ++s) {
      if (structure.places[s].branches < 2 || structure.places[s].order < low || structure.places[s].order > high) continue;
      std::vector<Candidate> here;
      for (const SegmentId child : m.segments[s].children)
        if (structure.at(child).axis != structure.places[s].axis)
          here.push_back({{p, child}, m.at(child).rotr.radians(), -std::log(m.at(child).length / m.segments[s].length)});
      nodes[static_cast<int>(here.size())].push_back(std::move(here));
    }
  }
  return nodes;
}

/// The greatest gap between neighbouring arms, in their deviations. Sorts the candidates of each node.
double separation(std::vector<std::vector<Candidate>>& nodes, double Candidate::*by) {
  for (auto& node : nodes) std::stable_sort(node.begin(), node.end(), [by](const Candidate& a, const Candidate& b) { return a.*by < b.*by; });
  const double n = static_cast<double>(nodes.size());
  std::vector<double> means, deviations;
  for (std::size_t arm = 0; arm < nodes.front().size(); ++arm) {
    double sum = 0, squares = 0;
    for (const auto& node : nodes) sum += node[arm].*by;
    for (const auto& node : nodes) squares += std::pow(node[arm].*by - sum / n, 2);
    means.push_back(sum / n);
    deviations.push_back(std::sqrt(squares / (n - 1)));
  }
  double widest = 0;
  for (std::size_t arm = 1; arm < means.size(); ++arm)
    widest = std::max(widest, (means[arm] - means[arm - 1]) / std::max(kAlike, std::hypot(deviations[arm], deviations[arm - 1]) / std::numbers::sqrt2));
  return widest;
}

}  // namespace

std::vector<Arms> armsOf(std::span<const MeasuredPlant> plants, int low, int high, ArmsBy by) {
  std::vector<Arms> all;
  for (auto& [count, nodes] : nodesByCount(plants, low, high)) {
    if (nodes.size() < kFewestNodes) continue;
    auto byLength = nodes;
    const double lengths = by == ArmsBy::Lean ? 0 : separation(byLength, &Candidate::shortness);
    const double leans = separation(nodes, &Candidate::lean);
    if (std::max(leans, lengths) < kApart) continue;
    Arms arms{count, std::vector<std::vector<ArmMember>>(static_cast<std::size_t>(count))};
    for (const auto& node : leans >= lengths ? nodes : byLength)
      for (std::size_t arm = 0; arm < node.size(); ++arm) arms.members[arm].push_back(node[arm].member);
    all.push_back(std::move(arms));
  }
  return all;
}

}  // namespace axil::quantify
