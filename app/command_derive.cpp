#include "app/cli_interop.hpp"
#include "app/commands.hpp"
#include "app/grammar_options.hpp"
#include "app/terminal.hpp"
#include "base/text.hpp"
#include "simeco/engine.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace axil::app {

namespace {

struct DeriveCommand {
  std::string grammar;
  std::string plant;  ///< its name; empty: the first
  std::optional<std::int64_t> steps;
  std::uint64_t seed = 1;
  enum class Print { Text, Counts, Stats } print = Print::Text;
  bool trace = false;
  bool json = false;
  bool interpreted = false;
  bool singlePrecision = false;
  int threads = 0;
  simeco::Limits limits;
};

using Json = nlohmann::ordered_json;

std::string countsText(const simeco::Derivation& derivation) {
  return Json{{"steps", derivation.modulesPerStep}, {"letters", simeco::letterCounts(derivation.string)}}.dump() + "\n";
}

std::string statsText(const simeco::Derivation& derivation) {
  return Json{{"modules", derivation.string.size()},
              {"steps", derivation.modulesPerStep.size()},
              {"derive_seconds", derivation.seconds},
              {"peak_bytes", derivation.peakBytes},
              {"threads", derivation.threads}}
             .dump() + "\n";
}

/// An L-system may ask where its turtle is, and its view file says where that starts.
Result<simeco::Derivation> derived(const simeco::Grammar& grammar, const std::string& path, const simeco::DeriveOptions& options) {
  if (grammar.language != simeco::Language::LSystem) return simeco::derive(grammar, options);
  const auto view = simeco::viewBeside(path);
  if (!view) return view.failure();
  return simeco::deriveLSystem(grammar, {.derive = options, .view = *view});
}

std::string stringText(const simeco::Grammar& grammar, const simeco::ModuleString& string) {
  return (grammar.language == simeco::Language::LSystem ? simeco::toLSystemText(string) : simeco::toText(string)) + "\n";
}

/// The string, or what is drawn of it.
Result<std::string> stringText(const simeco::Grammar& grammar, const simeco::Derivation& derivation, const DeriveCommand& command) {
  if (!command.interpreted) return stringText(grammar, derivation.string);
  const auto image = simeco::imageOf(derivation);
  if (!image) return image.failure();
  return stringText(grammar, image->string);
}

// ---- trace: which rule made which module at which step

struct Traced {
  const simeco::Grammar& grammar;
  const simeco::Derivation& derivation;

  [[nodiscard]] const simeco::RuleInfo* rule(const simeco::Origin& origin) const {
    const auto& rules = derivation.engine->program().rules;
    return origin.production < 0 || static_cast<std::size_t>(origin.production) >= rules.size() ? nullptr : &rules[static_cast<std::size_t>(origin.production)];
  }
  [[nodiscard]] int lineOf(const simeco::RuleInfo& info) const {
    const auto& starts = grammar.source.starts;
    return static_cast<int>(std::upper_bound(starts.begin(), starts.end(), info.where.begin) - starts.begin());
  }
  [[nodiscard]] std::string module(const simeco::ModuleView& view) const {
    std::string text(view.letter);
    for (std::size_t i = 0; i < view.parameters.size(); ++i) text += (i == 0 ? "(" : ",") + shortest(view.parameters[i]);
    return view.parameters.empty() ? text : text + ")";
  }
};

/// A line a module: `step 3  S(9)  A(3) -> ... (plant.simeco:12)`.
std::string traceText(const Traced& traced) {
  std::string text;
  std::size_t i = 0;
  for (const simeco::ModuleView view : traced.derivation.string) {
    const simeco::Origin origin = traced.derivation.origins[i++];
    const simeco::RuleInfo* rule = traced.rule(origin);
    text += std::to_string(i) + "\t" + traced.module(view) + "\tstep " + std::to_string(origin.step) + "\t" + (rule == nullptr ? "axiom" : rule->name) + "\n";
  }
  return text;
}

std::string traceJson(const Traced& traced) {
  Json rules = Json::array();
  for (const simeco::RuleInfo& info : traced.derivation.engine->program().rules) rules.push_back({{"rule", info.name}, {"line", traced.lineOf(info)}});
  Json modules = Json::array();
  std::size_t i = 0;
  for (const simeco::ModuleView view : traced.derivation.string) {
    const simeco::Origin origin = traced.derivation.origins[i++];
    Json module{{"letter", view.letter}, {"parameters", view.parameters}, {"step", origin.step}, {"rule", nullptr}};
    if (origin.production >= 0) module["rule"] = origin.production;
    modules.push_back(std::move(module));
  }
  return Json{{"rules", rules}, {"modules", modules}}.dump() + "\n";
}

int run(const DeriveCommand& command) {
  const auto grammar = grammarIn(command.grammar);
  if (!grammar) return report(grammar.error());
  const auto plant = plantNamed(*grammar, command.plant);
  if (!plant) return report(plant.error());
  if (command.plant.empty() && grammar->plants.size() > 1)
    std::fprintf(stderr, "axil: note: the ecosystem has %zu plants; this is \"%s\", --plant NAME derives another\n", grammar->plants.size(), grammar->plants.front().name.c_str());
  simeco::DeriveOptions options;
  options.plant = *plant;
  options.steps = command.steps;
  options.seed = seedOf(command.seed, *plant);
  options.limits = command.limits;
  options.threads = command.threads;
  options.singlePrecision = command.singlePrecision;
  options.watch = terminalWatch();
  options.host.print = [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); };
  options.host.files = simeco::filesBeside(command.grammar);
  options.traced = command.trace;
  const auto derivation = derived(*grammar, command.grammar, options);
  if (!derivation) return report(derivation.error());
  for (const std::string& warning : derivation->warnings) std::fprintf(stderr, "%s: warning: %s\n", command.grammar.c_str(), warning.c_str());
  if (command.trace) return print(command.json ? traceJson({*grammar, *derivation}) : traceText({*grammar, *derivation}));
  switch (command.print) {
    case DeriveCommand::Print::Counts: return print(countsText(*derivation));
    case DeriveCommand::Print::Stats: return print(statsText(*derivation));
    case DeriveCommand::Print::Text: break;
  }
  const auto text = stringText(*grammar, *derivation, command);
  return text ? print(*text) : report(text.error());
}

}  // namespace

void addDerive(CLI::App& sub, int& status) {
  auto& command = onCall<DeriveCommand>(sub, status, run);
  addExamples(sub, "  axil derive plant.simeco --steps 3\n  axil derive plant.simeco --counts    # modules after every step, letters of the last string");
  addGrammar(sub, command.grammar);
  sub.add_option("--steps", command.steps, "Derivation steps; by default the file's own length, else until nothing changes")->check(notNegative());
  addPlant(sub, command.plant, "the first");
  addSeed(sub, command.seed);
  addLimits(sub, command.limits);
  auto* counts = sub.add_flag_callback("--counts", [&command] { command.print = DeriveCommand::Print::Counts; }, "Print JSON: modules a step, letters of the string");
  sub.add_flag_callback("--stats", [&command] { command.print = DeriveCommand::Print::Stats; }, "Print JSON: modules, seconds, bytes, threads; no string")->excludes(counts);
  auto* trace = sub.add_flag("--trace", command.trace, "Print a line a module: its number, the module, the step and the rule that made it")->excludes(counts);
  sub.add_flag("--json", command.json, "With --trace: print JSON, the rules with their lines and of each module its step and rule (null: the axiom)")->needs(trace);
  sub.add_flag("--interpreted", command.interpreted, "Print the string as it is drawn, after the homomorphism")->excludes(trace)->excludes(counts);
  sub.add_flag("--single", command.singlePrecision, "Keep parameters in single precision, as classic programs do");
  sub.add_option("--threads", command.threads, "Threads; 0 takes what the machine has. The string does not depend on it")->check(CLI::Range(0, 1024))->capture_default_str();
}

}  // namespace axil::app
