#pragma once
/// \file
/// Plants grown by known rules, stage by stage, so that what is measured on them can be held against what made them.

#include "base/rng.hpp"
#include "base/turning.hpp"
#include "quantify/measure.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace axil::quantify {

/// An apex makes a segment a stage; at each node it passes a branch begins with `branching`; an axis of order 1 and more ends at a node with `ending`, the first with `leaderEnding`.
struct KnownRules {
  int stages = 12;
  double length = 0.1;
  double alongRatio = 0.95;      ///< from one segment to the next
  double lateralRatio = 0.6;     ///< of a branch's first segment to its bearer
  double lengthNoise = 0.05;     ///< deviation of the logarithm
  double branching = 0.7;
  int branchesAtNode = 1;
  double ending = 0.05;
  double leaderEnding = 0;
  double insertion_deg = 50;
  double insertionNoise_deg = 5;
  double divergence_deg = 137.5;
  double bend_deg = 0;
  int orders = 3;
  int leaves = 1;                ///< at every node, with the segment it tips
};

inline void growAxis(const KnownRules& rules, Rng& rng, skeleton3d::Skeleton& plant, skeleton3d::StemId stem, StemFrame frame, glm::dvec3 at, double length, int order, int stagesLeft) {
  using skeleton3d::NodeId;
  const auto rad = [](double degrees) { return degrees * std::numbers::pi / 180; };
  double around = 0;
  struct Start {
    NodeId node;
    glm::dvec3 at;
    StemFrame frame;
    double length;
    int stages;
  };
  std::vector<Start> starts;
  for (int stage = stagesLeft; stage > 0; --stage) {
    const double own = length * std::exp(rng.normal(0, rules.lengthNoise));
    at += frame.direction.unit() * own;
    const NodeId id{static_cast<std::int32_t>(plant.nodes.size()) + 1};
    plant.nodes.push_back({id, {at}, std::nullopt, {0, 0, 0}, {}});
    for (auto& s : plant.stems)
      if (s.id == stem) s.nodes.push_back(id);
    for (int l = 0; l < rules.leaves; ++l) {
      const StemFrame leaf = childFrame(frame, {Angle::fromDegrees(60), Angle::fromRadians(around + rad(180) + 2 * std::numbers::pi * l / rules.leaves)}, ChildKind::Branch);
      plant.leaves.push_back({stem, {at}, leaf.direction, leaf.adaxial, 0.05, 0.02, "ovate"});
    }
    if (order > 0 && rng.uniform() < rules.ending) break;
    if (order == 0 && rules.leaderEnding > 0 && rng.uniform() < rules.leaderEnding) break;
    if (order + 1 < rules.orders && rng.uniform() < rules.branching)
      for (int b = 0; b < rules.branchesAtNode; ++b) {
        const double rotr = rad(rng.normal(rules.insertion_deg, rules.insertionNoise_deg));
        const StemFrame branch = childFrame(frame, {Angle::fromRadians(rotr), Angle::fromRadians(around + 2 * std::numbers::pi * b / rules.branchesAtNode)}, ChildKind::Branch);
        starts.push_back({id, at, branch, own * rules.lateralRatio, stage - 1});
      }
    around += rad(rules.divergence_deg);
    if (rules.bend_deg > 0) frame = childFrame(frame, {Angle::fromRadians(rad(rules.bend_deg)), Angle{}}, ChildKind::Main);
    length *= rules.alongRatio;
  }
  for (const Start& s : starts) {
    if (s.stages < 1) continue;
    const skeleton3d::StemId id{static_cast<std::int32_t>(plant.stems.size()) + 1};
    plant.stems.push_back({id, stem, {s.node}});
    growAxis(rules, rng, plant, id, s.frame, s.at, s.length, order + 1, s.stages);
  }
}

inline Measurements grownBy(const KnownRules& rules, Rng rng) {
  skeleton3d::Skeleton plant;
  plant.root = skeleton3d::NodeId{1};
  plant.nodes.push_back({plant.root, {{0, 0, 0}}, std::nullopt, {0, 0, 0}, {}});
  plant.stems.push_back({skeleton3d::StemId{1}, std::nullopt, {plant.root}});
  growAxis(rules, rng, plant, skeleton3d::StemId{1}, firstFrame(PlantDirection::up()), {0, 0, 0}, rules.length, 0, rules.stages);
  auto measured = measure(plant);
  if (!measured) ADD_FAILURE() << measured.error().message << (measured.error().details.empty() ? "" : measured.error().details.front());
  return measured ? *measured : Measurements{};
}

inline std::vector<Measurements> manyGrownBy(const KnownRules& rules, std::uint64_t seed, int count) {
  std::cout << "seed " << seed << "\n";
  std::vector<Measurements> plants;
  for (int p = 0; p < count; ++p) plants.push_back(grownBy(rules, Rng(seed).split(static_cast<std::uint64_t>(p))));
  return plants;
}

}  // namespace axil::quantify
