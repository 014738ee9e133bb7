#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "simeco/simeco.hpp"

#include <CLI/CLI.hpp>

#include <map>

namespace axil::app {

namespace {

struct EmitCommand {
  std::string project;
  document::GrammarKind kind = document::GrammarKind::Initial;
  emit::Dialect dialect = emit::Dialect::SimEco;
  TurningRule turning = TurningRule::Exact;
  int decimals = 6;
};

int run(const EmitCommand& command) {
  const document::ChainOptions options{.turning = command.turning, .decimals = command.decimals, .watch = terminalWatch()};
  if (command.dialect == emit::Dialect::SimEco)
    return printed(command.project, options, [&](const auto& open, const auto& o) { return document::grammarOf(open, command.kind, o); }, simeco::print);
  if (command.kind != document::GrammarKind::Initial)
    return report({ErrorCode::BadInput, std::string("the ") + document::nameOf(command.kind) + " grammar can only be written as simeco; use --kind initial for other dialects", {}});
  return printed(command.project, options, [&](const auto& open, const auto& o) { return document::dialectOf(open, command.dialect, o); },
                 [](const std::string& text) { return text; });
}

const std::map<std::string, document::GrammarKind> kKinds = {{"initial", document::GrammarKind::Initial},
                                                             {"predictive", document::GrammarKind::Predictive},
                                                             {"structured", document::GrammarKind::Structured}};
const std::map<std::string, emit::Dialect> kDialects = {
    {"simeco", emit::Dialect::SimEco}, {"cpfg", emit::Dialect::Cpfg}, {"lpy", emit::Dialect::LPy}, {"mtg", emit::Dialect::Mtg}};

}  // namespace

void addEmit(CLI::App& sub, int& status) {
  auto& command = onCall<EmitCommand>(sub, status, run);
  addExamples(sub, "  axil emit plant.axil --kind initial > plant.simeco      # regrows exactly what was measured\n"
                   "  axil emit plant.axil --kind predictive > next.simeco    # goes on growing from there\n"
                   "  axil emit plant.axil --kind structured > rules.simeco   # the same habit in few rules\n"
                   "  axil emit plant.axil --kind initial --dialect cpfg > plant.l");
  addProject(sub, command.project);
  sub.add_option("--kind", command.kind, "initial, predictive or structured")->transform(CLI::CheckedTransformer(kKinds))->option_text("KIND [initial]");
  sub.add_option("--dialect", command.dialect, "simeco, cpfg, lpy or mtg")->transform(CLI::CheckedTransformer(kDialects))->option_text("DIALECT [simeco]");
  sub.add_option("--decimals", command.decimals, "Digits after the point; -1 prints full precision")->check(CLI::Range(-1, 15))->capture_default_str();
  addLiteral(sub, command.turning);
}

}  // namespace axil::app
