#include "emit/arrangement.hpp"

#include "emit/text_grammar.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace axil::emit {

Result<simeco::Grammar> arrangementGrammar(const keywords::ArrangementPreset& arrangement) {
  constexpr int nodes = 6;
  constexpr double internode_m = 0.03, leaf_m = 0.06;
  std::vector<double> turns;
  for (const Angle& angle : arrangement.cycle) turns.push_back(angle.radians());
  if (turns.empty()) turns.push_back(arrangement.divergence.radians());
  PlantText plant;
  plant.name = arrangement.name;
  const bool onStalk = arrangement.clustered && arrangement.name != "rosette";
  plant.stems = stemStage(1, "", num(arrangement.clustered ? 0.0008 : internode_m), 0.0016, 1, "");
  if (onStalk) plant.stems += stemStage(2, "", "0.04", 0.0016, 1, "");
  plant.leaves = leafStage(1, "elliptic, width 46", leaf_m, 1, glm::dvec3{0.24, 0.46, 0.15});
  plant.axiom = onStalk ? "S(2) A(0)" : "A(0)";
  const int count = std::clamp(arrangement.leavesPerNode, 1, 24);
  for (int n = 0; n < (arrangement.clustered ? std::max(nodes, 12) : nodes); ++n) {
    plant.rules += "            A(" + std::to_string(n) + ") -> S(1) ";
    for (int i = 0; i < count; ++i) plant.rules += "[" + turn(arrangement.clustered ? 1.25 - 0.07 * n : 1.0, 2 * std::numbers::pi * i / count) + "L(1)] ";
    plant.rules += turn(0, turns[static_cast<std::size_t>(n) % turns.size()]) + "A(" + std::to_string(n + 1) + ") ;\n";
  }
  plant.rules += "            A(i) ->  ;\n";
  return grammarOf(plant);
}

}  // namespace axil::emit
