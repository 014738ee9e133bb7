#include "base/rng.hpp"
#include "emit/emit.hpp"
#include "quantify/quantify.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "skeleton3d/skeleton3d.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

namespace axil::emit {
namespace {

using skeleton3d::NodeId;
using skeleton3d::StemId;

struct Clicks {
  std::vector<skeleton3d::View> views;
  std::vector<skeleton3d::ClickedNode> nodes;
  std::vector<skeleton3d::ClickedStem> stems;
};

/// A trunk with winding branches of 20 segments each, clicked without error in three orthographic views.
Clicks clicksOf(int segments) {
  Clicks made;
  for (const char* name : {"front", "right", "top"})
    made.views.push_back({name, *skeleton3d::nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 2200}), {1200, 1600}});
  for (int i = 0; i <= segments; ++i) {
    const int branch = i / 20;
    const int along = i % 20;
    const double turn = 2.4 * branch + 0.05 * along;
    const double up = branch == 0 ? 0.045 * along : 0.045 * (1 + branch % 19) + 0.004 * along;
    const double out = branch == 0 ? 0.001 * along : 0.02 * along + 0.01;
    const PlantPoint at{{out * std::cos(turn), up, out * std::sin(turn)}};
    skeleton3d::ClickedNode node{NodeId(i), {}, std::nullopt};
    for (const skeleton3d::View& view : made.views) node.clicks[view.name] = skeleton3d::project(view.camera, at);
    made.nodes.push_back(node);
    if (along == 0) made.stems.push_back({StemId(branch), branch == 0 ? std::vector<NodeId>{} : std::vector{NodeId(1 + branch % 19)}});
    made.stems.back().nodes.push_back(NodeId(i));
  }
  return made;
}

skeleton3d::Skeleton skeletonOf(int segments) {
  const Clicks clicks = clicksOf(segments);
  return *skeleton3d::buildSkeleton(clicks.views, clicks.nodes, clicks.stems);
}

void chainBenchmark(benchmark::State& state) {
  const Clicks clicks = clicksOf(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const auto skeleton = skeleton3d::buildSkeleton(clicks.views, clicks.nodes, clicks.stems);
    const auto measured = quantify::measure(*skeleton);
    const std::string text = simeco::print(*initialGrammar(*measured));
    benchmark::DoNotOptimize(simeco::parseSimeco(text).ok());
  }
}
BENCHMARK(chainBenchmark)->Name("chain/skeleton_quantify_emit_parse")->Arg(2000)->Unit(benchmark::kMillisecond);

void measureBenchmark(benchmark::State& state) {
  const auto skeleton = skeletonOf(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(quantify::measure(skeleton).has_value());
}
BENCHMARK(measureBenchmark)->Name("quantify/measure")->Arg(2000)->Unit(benchmark::kMillisecond);

void emitBenchmark(benchmark::State& state) {
  const auto measured = *quantify::measure(skeletonOf(static_cast<int>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(simeco::print(*initialGrammar(measured)).size());
}
BENCHMARK(emitBenchmark)->Name("emit/initial_text")->Arg(2000)->Unit(benchmark::kMillisecond);

/// Structure, statistics, every kind and style of grammar, and the initial one in every dialect.
void allGrammarsBenchmark(benchmark::State& state) {
  const auto measured = *quantify::measure(skeletonOf(static_cast<int>(state.range(0))));
  for (auto _ : state) {
    benchmark::DoNotOptimize(quantify::plantStructure(measured).axes.size());
    benchmark::DoNotOptimize(quantify::layeredStatistics({&measured, 1}).has_value());
    benchmark::DoNotOptimize(predictiveGrammar(measured).has_value());
    benchmark::DoNotOptimize(predictiveGrammar(measured, {}, {.style = PredictiveStyle::Thesis}).has_value());
    benchmark::DoNotOptimize(structuredGrammar(measured).has_value());
    benchmark::DoNotOptimize(structuredGrammar(measured, {}, {.form = StructuredForm::Exact}).has_value());
    for (const Dialect dialect : {Dialect::SimEco, Dialect::Cpfg, Dialect::LPy, Dialect::Mtg}) benchmark::DoNotOptimize(inDialect(*initialGrammar(measured), dialect).has_value());
  }
}
BENCHMARK(allGrammarsBenchmark)->Name("emit/structure_statistics_and_all_grammars")->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace axil::emit
