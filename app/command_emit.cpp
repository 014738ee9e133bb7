#include "app/cli_interop.hpp"
#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "base/files.hpp"
#include "document/plant_file.hpp"
#include "simeco/simeco.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string_view>
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

/// The plants whose statistics count beside the project's own.
Result<std::vector<quantify::Measurements>> alsoOf(const EmitCommand& command) {
  std::vector<quantify::Measurements> plants;
  for (const std::string& file : command.also) {
    auto plant = document::readPlant(file, {.watch = terminalWatch()});
    if (!plant) return plant.failure();
    plants.push_back(std::move(plant->measurements));
  }
  return plants;
}

/// The grammar of a project; or of a skeleton file, which has a name and no more.
Result<simeco::Grammar> grammarIn(const EmitCommand& command, const document::ChainOptions& options) {
  if (std::filesystem::path(command.project).extension() == ".json") {
    const auto plant = document::readPlant(command.project, options);
    if (!plant) return plant.failure();
    document::Project project;
    project.name = plant->name;
    return document::grammarOf(project, plant->measurements, command.kind, options);
  }
  const auto open = document::loadProject(command.project);
  if (!open) return open.failure();
  return document::grammarOf(*open, command.kind, options);
}

/// Options that the kind does not read are mistakes: nothing is ignored silently.
std::string misplacedOption(const CLI::App& sub, const EmitCommand& command) {
  using document::GrammarKind;
  const bool predictive = command.kind == GrammarKind::Predictive;
  const bool structured = command.kind == GrammarKind::Structured;
  const bool exact = structured && command.structure.form == emit::StructuredForm::Exact;
  const auto given = [&sub](const char* option) { return sub.count(option) > 0; };
  for (const char* option : {"--style", "--stages"})
    if (given(option) && !predictive) return std::string(option) + " is of a predictive grammar; add --kind predictive or leave it out";
  if (given("--form") && !structured) return "--form is of a structured grammar; add --kind structured or leave it out";
  for (const char* option : {"--error", "--detail"})
    if (given(option) && !exact) return std::string(option) + " is of the exact form; add --kind structured --form exact or leave it out";
  if (given("--orders") && (!structured || exact)) return "--orders is of the statistical form; add --kind structured or leave it out";
  if (given("--also") && (exact || command.kind == GrammarKind::Initial)) return "--also adds statistics, which only predictive grammars and the statistical form have; leave it out";
  return {};
}

/// What the grammar's heading warns of is said in words too, since who pipes the text on may never read it.
void repeatWarnings(const simeco::Grammar& grammar) {
  constexpr std::string_view kWarning = "// Warning: ";
  for (const std::string& line : grammar.comments.before)
    if (line.starts_with(kWarning)) std::fprintf(stderr, "axil: warning: %s\n", line.substr(kWarning.size()).c_str());
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
  const auto also = alsoOf(command);
  if (!also) return report(also.error());
  emit::StructureOptions structure = command.structure;
  if (command.kind == document::GrammarKind::Structured) structure.also = *also;
  const document::ChainOptions options{.turning = command.turning,
                                       .decimals = command.decimals,
                                       .predictive = {.style = command.style, .stages = command.stages, .also = *also},
                                       .structure = structure,
                                       .watch = terminalWatch()};
  const auto grammar = grammarIn(command, options);
  if (!grammar) return report(grammar.error());
  repeatWarnings(*grammar);
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
                   "  axil emit a.json --kind structured --also b.json c.json > kind.simeco   # of plants measured elsewhere\n"
                   "  axil emit plant.axil --kind initial --dialect cpfg -o plant.l     # and plant.v, plant.a");
  sub.add_option("PROJECT", command.project, "The project (.axil), or a skeleton file (.json) as axil skeleton and axil grow -o plant.json write it")->required();
  sub.add_option("--kind", command.kind, "initial, predictive or structured")->transform(oneOf(kKinds))->option_text("KIND [initial]");
  sub.add_option("--dialect", command.dialect, "simeco, cpfg, lpy or mtg")->transform(oneOf(kDialects))->option_text("DIALECT [simeco]");
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
  sub.add_option("--also", command.also, "Of a predictive grammar or the statistical form: further plants of the species (.axil or skeleton .json) whose statistics count")->option_text("PLANT...");
  addLiteral(sub, command.turning);
  sub.parse_complete_callback([&sub, &command] {
    if (const std::string mistake = misplacedOption(sub, command); !mistake.empty()) throw CLI::ValidationError(mistake);
  });
}

}  // namespace axil::app
