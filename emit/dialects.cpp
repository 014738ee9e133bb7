#include "emit/dialects.hpp"

#include "emit/mtg.hpp"
#include "emit/turtle_program.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"

#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using simeco::Grammar;

/// How the program is to draw: widths in the plant's unit, nothing bent, and steps that the rules need.
std::string viewText() {
  return "angle increment: 90\nline style: cylinder\ninitial line width: 0.01\ninitial color: 1\ntapered lines: off\n";
}
std::string animationText(std::int64_t steps) {
  return "double buffer: on\nclear between frames: on\nscale between frames: off\nfirst frame: 0\nlast frame: " + std::to_string(steps) + "\n";
}

Result<DialectText> inCpfg(const Grammar& grammar) {
  const auto steps = stepsUntilComplete(grammar);
  if (!steps) return steps.failure();
  auto text = cpfgProgram(grammar, *steps);
  if (!text) return text.failure();
  return DialectText{*std::move(text), viewText(), animationText(*steps)};
}

Result<DialectText> inLpy(const Grammar& grammar, std::uint64_t seed) {
  const auto steps = stepsUntilComplete(grammar);
  if (!steps) return steps.failure();
  auto text = lpyProgram(grammar, *steps, seed);
  if (!text) return text.failure();
  return DialectText{*std::move(text), {}, {}};
}

Result<DialectText> inMtg(const Grammar& grammar, std::uint64_t seed) {
  simeco::GrowOptions options;
  options.seed = seed;
  const auto growth = simeco::prepareGrowth(grammar, options);
  if (!growth) return growth.failure();
  const auto plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  if (!plant) return plant.failure();
  std::vector<std::string> notes;
  for (const std::string& line : grammar.comments.before)
    if (line.starts_with("// ")) notes.push_back(line.substr(3));
  auto text = mtgText(*plant, notes);
  if (!text) return text.failure();
  return DialectText{*std::move(text), {}, {}};
}

}  // namespace

std::optional<Dialect> dialectNamed(std::string_view name) {
  if (name == "simeco") return Dialect::SimEco;
  if (name == "cpfg") return Dialect::Cpfg;
  if (name == "lpy") return Dialect::LPy;
  if (name == "mtg") return Dialect::Mtg;
  return std::nullopt;
}

Result<DialectText> inDialect(const Grammar& grammar, Dialect dialect, const DialectOptions& options) {
  if (grammar.plants.empty() || grammar.language != simeco::Language::SimEco)
    return fail(ErrorCode::BadInput, "only a SimEco grammar with a plant can be written in other dialects");
  switch (dialect) {
    case Dialect::SimEco: return DialectText{simeco::print(grammar), {}, {}};
    case Dialect::Cpfg: return inCpfg(grammar);
    case Dialect::LPy: return inLpy(grammar, options.seed);
    case Dialect::Mtg: return inMtg(grammar, options.seed);
  }
  return fail(ErrorCode::BadInput, "unknown dialect");
}

}  // namespace axil::emit
