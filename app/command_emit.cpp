#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "base/files.hpp"
#include "document/plant_file.hpp"
#include "simeco/simeco.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace axil::app {

namespace {

struct EmitCommand {
  std::string project;
  document::GrammarKind kind = document::GrammarKind::Initial;
  emit::Dialect dialect = emit::Dialect::SimEco;
  TurningRule turning = TurningRule::Exact;
  int decimals = 6;
  std::uint64_t seed = 1;
  std::string out;
  emit::StructureOptions structure;
  emit::PredictiveStyle style = emit::PredictiveStyle::Layered;
  int stages = 1;
  std::vector<std::string> also;
};

/// How to predict: by the plant's own statistics and those of the plants named beside it.
Result<emit::PredictiveOptions> predictiveOptions(const EmitCommand& command) {
  emit::PredictiveOptions options{.style = command.style, .stages = command.stages, .also = {}};
  for (const std::string& file : command.also) {
    auto plant = document::readPlant(file, {.watch = terminalWatch()});
    if (!plant) return plant.failure();
    options.also.push_back(std::move(plant->measurements));
  }
  return options;
}

/// To OUT, with the files that the dialect wants beside it; without OUT the text alone, to stdout.
int written(const emit::DialectText& text, const std::string& out) {
  if (out.empty()) return print(text.text);
  namespace fs = std::filesystem;
  if (auto done = writeFile(out, text.text); !done) return report(done.error());
  for (const auto& [content, ending] : {std::pair{&text.view, ".v"}, std::pair{&text.animation, ".a"}}) {
    if (content->empty()) continue;
    if (auto done = writeFile(fs::path(out).replace_extension(ending), *content); !done) return report(done.error());
  }
  return 0;
}

int run(const EmitCommand& command) {
  if (command.dialect != emit::Dialect::SimEco && command.turning == TurningRule::Literal)
    return report({ErrorCode::BadInput, "only SimEco text can follow the literal turning rule; leave --literal out for other dialects", {}});
  const auto predictive = predictiveOptions(command);
  if (!predictive) return report(predictive.error());
  const document::ChainOptions options{.turning = command.turning, .decimals = command.decimals, .predictive = *predictive, .structure = command.structure, .watch = terminalWatch()};
  const auto open = document::loadProject(command.project);
  if (!open) return report(open.error());
  const auto grammar = document::grammarOf(*open, command.kind, options);
  if (!grammar) return report(grammar.error());
  const auto text = emit::inDialect(*grammar, command.dialect, {.seed = command.seed});
  return text ? written(*text, command.out) : report(text.error());
}

const std::map<std::string, document::GrammarKind> kKinds = {{"initial", document::GrammarKind::Initial},
                                                             {"predictive", document::GrammarKind::Predictive},
                                                             {"structured", document::GrammarKind::Structured}};
const std::map<std::string, emit::PredictiveStyle> kStyles = {{"layered", emit::PredictiveStyle::Layered}, {"thesis", emit::PredictiveStyle::Thesis}};
const std::map<std::string, emit::StructuredForm> kForms = {{"statistical", emit::StructuredForm::Statistical}, {"exact", emit::StructuredForm::Exact}};
const std::map<std::string, emit::Dialect> kDialects = {
    {"simeco", emit::Dialect::SimEco}, {"cpfg", emit::Dialect::Cpfg}, {"lpy", emit::Dialect::LPy}, {"mtg", emit::Dialect::Mtg}};

}  // namespace

void addEmit(CLI::App& sub, int& status) {
  auto& command = onCall<EmitCommand>(sub, status, run);
  addExamples(sub, "  axil emit plant.axil --kind initial > plant.simeco      # regrows exactly what was measured\n"
                   "  axil emit plant.axil --kind predictive > next.simeco    # goes on growing from there\n"
                   "  axil emit plant.axil --kind structured > rules.simeco   # the same habit in few rules\n"
                   "  axil emit plant.axil --kind initial --dialect cpfg -o plant.l     # and plant.v, plant.a");
  addProject(sub, command.project);
  sub.add_option("--kind", command.kind, "initial, predictive or structured")->transform(CLI::CheckedTransformer(kKinds))->option_text("KIND [initial]");
  sub.add_option("--dialect", command.dialect, "simeco, cpfg, lpy or mtg")->transform(CLI::CheckedTransformer(kDialects))->option_text("DIALECT [simeco]");
  sub.add_option("--decimals", command.decimals, "Digits after the point; -1 prints full precision")->check(CLI::Range(-1, 15))->capture_default_str();
  sub.add_option("-o,--out", command.out, "Write to this file instead of stdout; cpfg's view and animation files go beside it");
  sub.add_option("--seed", command.seed, "Which plant of a family the mtg table shows, and the seed in a lpy program")->capture_default_str();
  sub.add_option("--form", command.structure.form, "Of a structured grammar: statistical (a family of such plants) or exact (this plant, rules and tables)")
      ->transform(CLI::CheckedTransformer(kForms))
      ->option_text("FORM [statistical]");
  sub.add_option("--error", command.structure.maximumError, "Exact form: how far a node may be off, as a share of the height")->check(CLI::Range(1e-6, 0.5))->capture_default_str();
  sub.add_option("--detail", command.structure.detail, "Exact form: how much errors weigh against the length of the text")->check(CLI::Range(1e-3, 1e6))->capture_default_str();
  sub.add_option("--orders", command.structure.orders, "Statistical form: keep so many branching orders")->check(CLI::Range(1, 1000));
  sub.add_option("--style", command.style, "Of a predictive grammar: layered (statistics by order and rank) or thesis (ranges, one stage)")
      ->transform(CLI::CheckedTransformer(kStyles))
      ->option_text("STYLE [layered]");
  sub.add_option("--stages", command.stages, "Of a predictive grammar: how many stages ahead")->check(CLI::Range(1, emit::kMostStages))->capture_default_str();
  sub.add_option("--also", command.also, "Of a predictive grammar: further plants of the species (.axil or skeleton .json) whose statistics count, each once")->option_text("PLANT...");
  addLiteral(sub, command.turning);
}

}  // namespace axil::app
