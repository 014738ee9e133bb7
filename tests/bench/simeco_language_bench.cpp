// The SimEco front end on lantana-like text: parse (goal: 2,000 segments in 15 ms), check, print.
#include <benchmark/benchmark.h>

#include "simeco/language.hpp"

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

}  // namespace
}  // namespace axil::simeco
