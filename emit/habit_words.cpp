#include "emit/habit_words.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "quantify/branching.hpp"
#include "quantify/phyllotaxis.hpp"

#include <algorithm>
#include <vector>

namespace axil::emit {

namespace {

using quantify::MeasuredPlant;
using quantify::PlantStructure;

std::string branchingWords(const std::vector<PlantStructure>& structures) {
  std::ptrdiff_t balance = 0;
  bool branched = false;
  for (const PlantStructure& s : structures) {
    branched = branched || s.branching != quantify::Branching::None;
    balance += s.branching == quantify::Branching::Sympodial ? 1 : s.branching == quantify::Branching::Monopodial ? -1 : 0;
  }
  return !branched ? "unbranched" : balance > 0 ? "sympodial" : "monopodial";
}

std::string patternWords(const std::vector<MeasuredPlant>& plants) {
  const auto pattern = quantify::branchingPatternOf(plants, quantify::scheduleOf(plants), 0);
  if (pattern.habit == quantify::BranchingHabit::EveryKth) return ", every " + std::to_string(pattern.period) + ". node branches";
  if (pattern.habit == quantify::BranchingHabit::None || pattern.habit == quantify::BranchingHabit::Even) return {};
  return std::string(", ") + quantify::nameOf(pattern.habit);
}

std::string arrangementWords(const std::vector<MeasuredPlant>& plants, quantify::OrgansAround organs, const std::string& name) {
  const auto fit = quantify::phyllotaxisOf(plants, organs);
  if (fit.perNode == 0) return {};
  std::string words = "; " + name + " " + (fit.preset.empty() || fit.preset == "none" ? std::to_string(fit.perNode) + " a node" : fit.preset);
  if (fit.samples > 0 && fit.chance <= 0.05) words += " (" + fixed(fit.divergence.degrees(), 0) + " degrees on)";
  return words;
}

}  // namespace

std::string habitWords(std::span<const quantify::Measurements> measured) {
  const std::vector<PlantStructure> structures = quantify::plantStructures(measured);
  std::vector<MeasuredPlant> plants;
  int orders = 0;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    plants.push_back({&measured[p], &structures[p]});
    orders = std::max(orders, structures[p].orders);
  }
  std::string words = branchingWords(structures);
  if (orders > 1) words += ", " + countOf(static_cast<std::size_t>(orders), "branching order", "branching orders") + patternWords(plants);
  return words + arrangementWords(plants, quantify::OrgansAround::Branches, "branches") + arrangementWords(plants, quantify::OrgansAround::Leaves, "leaves");
}

}  // namespace axil::emit
