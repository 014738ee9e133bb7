#pragma once
/// \file
/// Known generators, written as the rules of a grammar: grown from several seeds and measured without error.

#include "grown.hpp"
#include "quantify/layers.hpp"
#include "quantify/measure.hpp"

#include <string>
#include <vector>

namespace axil::emit {

/// The grown plant's stems as a skeleton; a bracketed organ begins a stem.
inline skeleton3d::Skeleton skeletonOf(const simeco::Plant& plant) {
  using skeleton3d::NodeId;
  using skeleton3d::StemId;
  skeleton3d::Skeleton skeleton;
  skeleton.root = NodeId{0};
  skeleton.nodes.push_back({NodeId{0}, plant.organs.front().base, std::nullopt, {0, 0, 0}, {}});
  std::vector<NodeId> tips(plant.organs.size());
  std::vector<std::size_t> stems(plant.organs.size());
  for (std::size_t o = 0; o < plant.organs.size(); ++o) {
    const simeco::Organ& organ = plant.organs[o];
    if (organ.kind != simeco::OrganKind::Stem) continue;
    const bool starts = !organ.parent || organ.branch;
    const std::size_t below = organ.parent ? static_cast<std::size_t>(organ.parent->value) : 0;
    const NodeId base = organ.parent ? tips[below] : NodeId{0};
    if (starts) {
      const StemId id{static_cast<std::int32_t>(skeleton.stems.size())};
      skeleton.stems.push_back({id, organ.parent ? std::optional(StemId{static_cast<std::int32_t>(stems[below])}) : std::nullopt, {base}});
      stems[o] = skeleton.stems.size() - 1;
    } else {
      stems[o] = stems[below];
    }
    tips[o] = NodeId{static_cast<std::int32_t>(skeleton.nodes.size())};
    skeleton.nodes.push_back({tips[o], organ.tip(), std::nullopt, {0, 0, 0}, {}});
    skeleton.stems[stems[o]].nodes.push_back(tips[o]);
  }
  return skeleton;
}

inline std::vector<quantify::Measurements> measuredFrom(const simeco::Grammar& grammar, int plants, std::uint64_t firstSeed, std::optional<std::int64_t> steps = std::nullopt) {
  std::vector<quantify::Measurements> measured;
  for (int p = 0; p < plants; ++p) {
    simeco::GrowOptions options;
    options.seed = firstSeed + static_cast<std::uint64_t>(p);
    options.steps = steps;
    measured.push_back(valueOf(quantify::measure(skeletonOf(grownUp(grammar, options)))));
  }
  return measured;
}

/// Plants of the rules after so many steps, from seeds `firstSeed` on.
inline std::vector<quantify::Measurements> plantsOf(const std::string& rules, std::int64_t steps, int plants, std::uint64_t firstSeed = 1) {
  const std::string text = "EcoSystem 1.1 \"g\" { Plant \"p\" { DeriveTime = 1; Stem { Stage 1(l) { GrowRate = l; } } Grow { " + rules + " } } }";
  const simeco::Parsed parsed = simeco::parseSimeco(text);
  for (const Diagnostic& d : parsed.diagnostics) ADD_FAILURE() << formatDiagnostic(d, text, "generator");
  return measuredFrom(parsed.grammar, plants, firstSeed, steps);
}

inline quantify::LayeredStatistics statisticsOf(const std::string& rules, std::int64_t steps, int plants) {
  return valueOf(quantify::layeredStatistics(plantsOf(rules, steps, plants)));
}

}  // namespace axil::emit
