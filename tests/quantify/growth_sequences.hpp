#pragma once
/// \file
/// Plants of many habits grown stage by stage, each measured at two ages: growth sequences to foretell. Unlike known_growth.hpp every stage is grown on all axes before the
/// next, so that the younger plant is exactly a part of the older one.

#include "base/rng.hpp"
#include "base/turning.hpp"
#include "quantify/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <optional>
#include <vector>

namespace axil::quantify {

struct Sprout {
  double lean_deg = 0;
  double around_deg = 0;
  double ratio = 1;    ///< of its lengths to its bearer's
};

/// How an apex grows. Functions take the branching order, and the rank of the node.
struct Habit {
  const char* name = "";
  int stages = 12;
  double length = 0.08;
  double along = 0.96;         ///< a segment over the one below; at the base, where it changes
  double change = 1;           ///< of that, from one rank to the next
  double noise = 0.1;          ///< deviation of the logarithm of lengths
  double divergence_deg = 137.5;
  int orders = 3;
  double ending = 0.05;        ///< of a node to end an axis of order 1 and more (of any order where modules fork)
  int delay = 0;               ///< stages that a branch waits
  int leaves = 0;
  int module = 0;              ///< segments after which an axis forks; 0: never
  std::function<double(int, int)> branching = [](int, int) { return 0.6; };
  std::function<double(int)> byAge = [](int) { return 1.0; };   ///< a factor of all lengths made in a stage of the plant
  std::function<double(int)> byRank = [](int) { return 1.0; };  ///< and one of lengths at a rank of any axis
  std::function<double(int)> rate = [](int) { return 1.0; };
  std::function<int(int)> most = [](int) { return 1000; };
  std::function<std::vector<Sprout>(Rng&)> sprouts = [](Rng& rng) { return std::vector<Sprout>{{rng.normal(50, 4), 0, 0.6}}; };
};

class Sequence {
 public:
  Sequence(const Habit& habit, Rng rng) : habit_(habit), rng_(rng) {
    nodes_.push_back({glm::dvec3{0, 0, 0}, 0});
    start({std::nullopt, 0, 0, firstFrame(PlantDirection::up()), habit.length, 0});
    for (stage_ = 1; stage_ <= habit.stages; ++stage_) step();
  }
  /// As it was after so many stages.
  [[nodiscard]] Measurements at(int stage) const {
    skeleton3d::Skeleton plant;
    plant.root = skeleton3d::NodeId{1};
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (nodes_[n].born <= stage) plant.nodes.push_back({idOf(n), {nodes_[n].at}, std::nullopt, {0, 0, 0}, {}});
    for (std::size_t s = 0; s < stems_.size(); ++s) {
      skeleton3d::Stem stem{skeleton3d::StemId{static_cast<std::int32_t>(s) + 1}, stems_[s].parent, {}};
      for (const std::size_t n : stems_[s].nodes)
        if (nodes_[n].born <= stage) stem.nodes.push_back(idOf(n));
      if (stem.nodes.size() > 1) plant.stems.push_back(std::move(stem));
    }
    for (const auto& [leaf, born] : leaves_)
      if (born <= stage) plant.leaves.push_back(leaf);
    auto measured = measure(plant);
    if (!measured) ADD_FAILURE() << measured.error().message;
    return measured ? *measured : Measurements{};
  }

 private:
  struct Node {
    glm::dvec3 at;
    int born = 0;
  };
  struct StemNodes {
    std::optional<skeleton3d::StemId> parent;
    std::vector<std::size_t> nodes;
  };
  struct Bud {
    std::optional<skeleton3d::StemId> parent;
    std::size_t node = 0;
    int order = 0;
    StemFrame frame;
    double length = 0;
    int due = 0;
  };
  struct Apex {
    std::size_t stem = 0, node = 0;
    int order = 0, rank = 0;
    StemFrame frame;
    double length = 0;
    double around = 0;
    bool alive = true;
  };
  static skeleton3d::NodeId idOf(std::size_t n) { return skeleton3d::NodeId{static_cast<std::int32_t>(n) + 1}; }
  static Angle radiansOf(double degrees) { return Angle::fromDegrees(degrees); }

  void start(const Bud& bud) {
    stems_.push_back({bud.parent, {bud.node}});
    apices_.push_back({stems_.size() - 1, bud.node, bud.order, 0, bud.frame, bud.length, 0, true});
  }
  void step() {
    std::vector<Bud> waiting;
    for (const Bud& bud : buds_) (bud.due == stage_ ? due_ : waiting).push_back(bud);
    buds_ = std::move(waiting);
    for (const Bud& bud : due_) start(bud);
    due_.clear();
    for (std::size_t a = 0; a < apices_.size(); ++a)
      if (apices_[a].alive) grow(apices_[a]);
  }
  void grow(Apex& apex) {
    if (apex.rank >= habit_.most(apex.order)) apex.alive = false;
    if (!apex.alive || rng_.uniform() >= habit_.rate(apex.order)) return;
    const double ageless = apex.length * std::exp(rng_.normal(0, habit_.noise)), length = ageless * habit_.byAge(stage_) * habit_.byRank(apex.rank);
    nodes_.push_back({nodes_[apex.node].at + apex.frame.direction.unit() * length, stage_});
    apex.node = nodes_.size() - 1;
    stems_[apex.stem].nodes.push_back(apex.node);
    const skeleton3d::StemId stem{static_cast<std::int32_t>(apex.stem) + 1};
    for (int l = 0; l < habit_.leaves; ++l) {
      const StemFrame leaf = childFrame(apex.frame, {radiansOf(60), radiansOf(apex.around + 360.0 * l / habit_.leaves)}, ChildKind::Branch);
      leaves_.push_back({{stem, {nodes_[apex.node].at}, leaf.direction, leaf.adaxial, 0.05, 0.02, "ovate"}, stage_});
    }
    const int rank = apex.rank++;
    const bool forks = habit_.module > 0 && apex.rank >= habit_.module;
    const bool ends = (habit_.module > 0 ? forks : apex.order > 0) && rng_.uniform() < habit_.ending;
    const bool bears = habit_.module > 0 ? forks && !ends : apex.order + 1 < habit_.orders && rng_.uniform() < habit_.branching(apex.order, rank);
    if (bears)
      for (const Sprout& sprout : habit_.sprouts(rng_)) {
        const StemFrame frame = childFrame(apex.frame, {radiansOf(sprout.lean_deg), radiansOf(apex.around + sprout.around_deg)}, ChildKind::Branch);
        buds_.push_back({stem, apex.node, apex.order + 1, frame, (habit_.module > 0 ? apex.length : ageless) * sprout.ratio, stage_ + 1 + habit_.delay});
      }
    apex.around += habit_.divergence_deg;
    apex.length *= habit_.along * std::pow(habit_.change, rank);
    apex.alive = !ends && !forks;
  }

  const Habit& habit_;
  Rng rng_;
  int stage_ = 0;
  std::vector<Node> nodes_;
  std::vector<StemNodes> stems_;
  std::vector<std::pair<skeleton3d::Leaf, int>> leaves_;
  std::vector<Apex> apices_;
  std::vector<Bud> buds_, due_;
};

/// Habits of the kinds that botanists tell apart, with noise of 5 to 15 %.
inline std::vector<Habit> knownHabits() {
  const auto pair = [](Rng& rng) { return std::vector<Sprout>{{rng.normal(42, 4), 0, 0.5}, {rng.normal(42, 4), 180, 0.5}}; };
  return {{.name = "monopodial, spiral", .leaves = 1},
          {.name = "decussate pairs", .stages = 9, .noise = 0.08, .divergence_deg = 90, .leaves = 2, .branching = [](int, int) { return 0.55; }, .sprouts = pair},
          {.name = "few branches, many ends", .stages = 14, .along = 0.9, .noise = 0.12, .ending = 0.15, .branching = [](int, int) { return 0.4; }},
          {.name = "sympodial, unequal arms", .stages = 11, .along = 1, .noise = 0.08, .divergence_deg = 90, .ending = 0.04, .module = 2,
           .sprouts = [](Rng& rng) { return std::vector<Sprout>{{rng.normal(35, 3), 0, 0.85}, {rng.normal(57, 3), 180, 0.7}}; }},
          {.name = "Leeuwenberg-like", .stages = 7, .divergence_deg = 0, .ending = 0.1, .module = 1,
           .sprouts = [](Rng& rng) { return std::vector<Sprout>{{rng.normal(35, 4), 0, 0.85}, {rng.normal(35, 4), 120, 0.85}, {rng.normal(35, 4), 240, 0.85}}; }},
          {.name = "acrotonic", .stages = 13, .along = 1, .orders = 2, .branching = [](int, int rank) { return std::min(1.0, 0.1 + rank / 12.0); }},
          {.name = "basitonic", .ending = 0.08, .leaves = 1, .branching = [](int, int rank) { return std::max(0.0, 1 - rank / 10.0); }},
          {.name = "axes of five and three segments", .ending = 0, .branching = [](int, int) { return 0.7; }, .most = [](int order) { return order == 0 ? 1000 : order == 1 ? 5 : 3; }},
          {.name = "branches that rest", .stages = 14, .ending = 0, .rate = [](int order) { return order == 0 ? 1.0 : order == 1 ? 0.6 : 0.4; }},
          {.name = "lengths that swell and dwindle", .stages = 13, .length = 0.03, .along = 1.35, .change = 0.945},
          {.name = "late branches", .stages = 13, .noise = 0.15, .ending = 0.03, .delay = 2},
          {.name = "every third node", .stages = 14, .along = 0.98, .divergence_deg = 120, .ending = 0.06, .leaves = 1, .branching = [](int, int rank) { return rank % 3 == 2 ? 1.0 : 0.0; }}};
}

}  // namespace axil::quantify
