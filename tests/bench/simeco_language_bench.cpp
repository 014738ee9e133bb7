// The SimEco front end on lantana-like text: parse (goal: 2,000 segments in 15 ms), check, print.
#include <benchmark/benchmark.h>

#include "simeco/language.hpp"
#include "simeco/language_service.hpp"

namespace axil::simeco {
namespace {

/// A plant of `segments` stages, each with the appendix' attributes and a rule that makes the next.
std::string textOf(int segments) {
  Grammar grammar;
  grammar.name = "bench";
  const auto number = [&](double value) { return grammar.add(fixedNumber(value, 6)); };
  const auto call = [&](const char* function, int arguments) {
    Call made{function, {}};
    for (int i = 0; i < arguments; ++i) made.arguments.push_back(number(0.1 * i));
    return grammar.add(std::move(made));
  };
  const auto module = [&](const char* letter, ExprId argument) { return Module{letter, {argument}, {}}; };
  PlantGrammar plant;
  plant.name = "bench";
  OrganBlock stem{OrganKind::Stem, {}, {}, {}, {}};
  plant.rules.label = "w";
  plant.rules.axiom = {module("S", grammar.add(Number{0, 0}))};
  for (int i = 0; i < segments; ++i) {
    Stage stage;
    stage.number = i;
    const auto say = [&](const char* name, ExprId value) { stage.attributes.push_back({name, value, {}, {}}); };
    say("Model", grammar.add(Text{"DefaultStem.i"}));
    say("TextureFront", grammar.add(Text{"seafloor.bmp"}));
    say("GrowRate", number(0.1 + 1e-5 * i));
    say("GrowTime", number(1));
    say("BroadenRate", number(0.2));
    say("ColorFront", call("RGBA", 4));
    say("MaterialFront", call("MTRL", 6));
    stem.stages.push_back(std::move(stage));
    if (i + 1 == segments) break;
    Production rule;
    rule.predecessor = {module("S", grammar.add(Number{static_cast<double>(i), 0}))};
    Successor successor;
    for (const char* bracket : {"[", "]", ""}) {
      if (*bracket != '\0') successor.modules.push_back({bracket, {}, {}});
      if (*bracket == ']') continue;
      successor.modules.push_back(module("rotr", number(1e-4 * i)));
      successor.modules.push_back(module("rotu", number(-1e-4 * i)));
      successor.modules.push_back(module("S", grammar.add(Number{static_cast<double>(i + 1), 0})));
    }
    rule.successors = {std::move(successor)};
    plant.rules.productions.push_back(std::move(rule));
  }
  plant.organs.push_back(std::move(stem));
  grammar.plants.push_back(std::move(plant));
  return print(grammar);
}

void parseBenchmark(benchmark::State& state) {
  const std::string text = textOf(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(parseSimeco(text).grammar.plants.size());
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(text.size()));
  state.SetLabel(std::to_string(text.size()) + " bytes");
}
BENCHMARK(parseBenchmark)->Name("simeco/parse")->Arg(2000)->Arg(20000)->Unit(benchmark::kMillisecond);

void checkBenchmark(benchmark::State& state) {
  const Grammar grammar = parseSimeco(textOf(static_cast<int>(state.range(0)))).grammar;
  for (auto _ : state) benchmark::DoNotOptimize(check(grammar).size());
}
BENCHMARK(checkBenchmark)->Name("simeco/check")->Arg(2000)->Unit(benchmark::kMillisecond);

void printBenchmark(benchmark::State& state) {
  const Grammar grammar = parseSimeco(textOf(static_cast<int>(state.range(0)))).grammar;
  for (auto _ : state) benchmark::DoNotOptimize(print(grammar).size());
}
BENCHMARK(printBenchmark)->Name("simeco/print")->Arg(2000)->Unit(benchmark::kMillisecond);


// ---- an editor: tokens at every key stroke, the meaning when typing pauses, of texts of 10,000 rules

std::string tenThousandRules(Language language) {
  const bool classic = language == Language::LSystem;
  std::string text = classic ? "#define D 22.5\nLsystem: 1\nderivation length: 3\nAxiom: A(1)\n" : "EcoSystem 1.1 \"e\" {\n    Plant \"p\" {\n        Stem {\n            Stage 1 {}\n        }\n        Grow {\n            w = A(0);\n";
  for (int i = 0; i < 10'000; ++i) {
    const std::string n = std::to_string(i), next = std::to_string(i + 1);
    text += classic ? "A(x) : x>" + n + " && x<" + next + " --> F(x*0.9)[+(D)B(x/2)]/(137.5)A(x+1) // rule\n"
                    : "            A(" + n + ") -> S(1) [rotr(0.915944)rotu(-2.102210)S(1)] A(" + next + ") ; // rule\n";
  }
  return text + (classic ? "endlsystem\n" : "        }\n    }\n}\n");
}

template <class Work>
void editorBenchmark(benchmark::State& state, Language language, Work work) {
  const std::string text = tenThousandRules(language);
  for (auto _ : state) benchmark::DoNotOptimize(work(text, language));
  state.SetLabel(std::to_string(text.size()) + " bytes, 10,000 rules");
}
const auto tokensWork = [](const std::string& text, Language language) { return tokensOf(text, language).size(); };
const auto analyseWork = [](const std::string& text, Language language) { return analyse(text, language).symbols.size(); };
const auto layoutWork = [](const std::string& text, Language language) { return formatted(text, language).value().size(); };
BENCHMARK_CAPTURE(editorBenchmark, tokens_classic, Language::LSystem, tokensWork)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(editorBenchmark, tokens_simeco, Language::SimEco, tokensWork)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(editorBenchmark, analyse_classic, Language::LSystem, analyseWork)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(editorBenchmark, analyse_simeco, Language::SimEco, analyseWork)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(editorBenchmark, layout_classic, Language::LSystem, layoutWork)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(editorBenchmark, layout_simeco, Language::SimEco, layoutWork)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace axil::simeco
