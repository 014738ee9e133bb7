#include "emit/unmade.hpp"

#include "emit/assembly.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using simeco::Module;
using simeco::OrganKind;

std::optional<int> numberOf(const simeco::Grammar& grammar, const Module& module) {
  if (module.arguments.empty()) return std::nullopt;
  const auto* number = std::get_if<simeco::Number>(&grammar.at(module.arguments.front()).node);
  return number == nullptr ? std::nullopt : std::optional(static_cast<int>(number->value));
}

}  // namespace

void dropUnmade(simeco::Grammar& grammar, int firstApex) {
  simeco::RuleSet& rules = grammar.plants.front().rules;
  auto& productions = rules.productions;
  for (bool dropped = true; dropped;) {
    std::map<std::pair<std::string, int>, bool> made;
    const auto note = [&](const std::vector<Module>& modules, const Module* own) {
      for (const Module& module : modules)
        if (const auto number = numberOf(grammar, module); number && !(own != nullptr && module.letter == own->letter && number == numberOf(grammar, *own))) made[{module.letter, *number}] = true;
    };
    note(rules.axiom, nullptr);
    for (const auto& rule : productions)
      for (const auto& successor : rule.successors) note(successor.modules, &rule.predecessor.front());
    const auto before = productions.size();
    std::erase_if(productions, [&](const simeco::Production& rule) {
      const Module& own = rule.predecessor.front();
      const auto number = numberOf(grammar, own);
      return own.letter == "A" && number && *number >= firstApex && !made.contains({"A", *number});
    });
    dropped = productions.size() < before;
    if (dropped) continue;
    for (const OrganKind kind : {OrganKind::Stem, OrganKind::Leaf})
      std::erase_if(blockOf(grammar.plants.front(), kind).stages, [&](const simeco::Stage& stage) { return !made.contains({kind == OrganKind::Stem ? "S" : "L", stage.number}); });
  }
}

}  // namespace axil::emit
