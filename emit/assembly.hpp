#pragma once
/// \file
/// From a Plan to a Grammar, in pieces that the initial and the predictive grammar share. Private to this room.

#include "emit/initial.hpp"
#include "emit/plan.hpp"
#include "simeco/grammar.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace axil::emit {

/// The initial grammar and where its segments' rules stand.
struct Assembled {
  simeco::Grammar grammar;
  std::vector<std::optional<std::size_t>> ruleOf;  ///< production of each segment; none where nothing leaves its tip
  std::vector<int> bornAt;                         ///< derivation step in which each segment appears
  int firstFreeApex = 10;
};

[[nodiscard]] Assembled assembled(const Plan& plan, const EmitOptions& options);

/// A stem stage of `length` and `radius`, a leaf stage of `leaf`; `length` may be an expression that each organ draws anew.
[[nodiscard]] simeco::Stage stemStage(simeco::Grammar& grammar, int number, simeco::ExprId length, double radius, const Digits& digits, const EmitOptions& options);
[[nodiscard]] simeco::Stage stemStage(simeco::Grammar& grammar, int number, double length, double radius, const Digits& digits, const EmitOptions& options);
[[nodiscard]] simeco::Stage leafStage(simeco::Grammar& grammar, int number, const LeafStage& leaf, const Digits& digits, const EmitOptions& options);

/// An empty SimEco grammar of one plant: attributes and the six organ blocks in their order, no stages, no rules.
[[nodiscard]] simeco::Grammar emptyGrammar(const EmitOptions& options, const glm::dvec3& position, const glm::dvec3& direction, const Digits& digits);
[[nodiscard]] simeco::OrganBlock& blockOf(simeco::PlantGrammar& plant, simeco::OrganKind kind);

/// "1 leaf", "2 leaves".
[[nodiscard]] std::string countOf(std::size_t count, const std::string& thing, const std::string& things);

/// Stage 0: the growing point.
[[nodiscard]] simeco::Stage growingPointStage(simeco::Grammar& grammar, double length, const EmitOptions& options);

}  // namespace axil::emit
