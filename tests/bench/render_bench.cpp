// A shrub of some 900 organs (330 stem segments, 490 leaves, flowers and fruits) and a tree of 131,000 segments.
#include "render/render.hpp"

#include "render/known_plants.hpp"
#include "simeco/simeco.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace axil;
using namespace axil::render;

/// Every segment forks in two, 17 times: 131,071 segments.
simeco::Plant forkedTree() {
  test::PlantMaker make;
  const std::int32_t stem = make.style(simeco::OrganKind::Stem);
  make.first({0, 0, 0}, {0, 1, 0}, 0.2, 0.02, stem);
  for (std::int32_t i = 0; i < 65'535; ++i) {
    const simeco::Organ below = make.plant.at(simeco::OrganId(i));
    const glm::dvec3 d = below.direction.unit(), side = below.rAxis.unit();
    make.on(simeco::OrganId(i), false, d + side * 0.2, below.length * 0.93, below.radius * 0.82, stem);
    make.on(simeco::OrganId(i), true, d - side * 0.7, below.length * 0.80, below.radius * 0.70, stem);
  }
  return make.plant;
}

void meshOfShrub(benchmark::State& state) {
  const simeco::Plant plant = test::shrub(2);
  for (auto _ : state) benchmark::DoNotOptimize(meshOf(plant));
}
BENCHMARK(meshOfShrub)->Unit(benchmark::kMillisecond);

void meshOf131000Segments(benchmark::State& state) {
  const simeco::Plant plant = forkedTree();
  for (auto _ : state) benchmark::DoNotOptimize(meshOf(plant));
}
BENCHMARK(meshOf131000Segments)->Unit(benchmark::kMillisecond);

void glbOf131000Segments(benchmark::State& state) {
  const PlantMesh mesh = meshOf(forkedTree()).value();
  for (auto _ : state) benchmark::DoNotOptimize(glbBytes(mesh));
}
BENCHMARK(glbOf131000Segments)->Unit(benchmark::kMillisecond);

/// A tree of 131,071 segments, 131,054 of them with a leaf outlined by the turtle: 1,179,606 modules.
constexpr const char* kLargeTree = R"(Lsystem: tree
derivation length: 17
Axiom: A(1,0.2)
A(l,w) --> !(w)F(l)[&(45)B(l*0.6,w*0.707)]/(137.5)A(l*0.9,w*0.707)
B(l,w) --> !(w)F(l)L[-(45)@vC(l*0.6,w*0.707)]C(l*0.9,w*0.707)
C(l,w) --> !(w)F(l)L[+(45)@vB(l*0.6,w*0.707)]B(l*0.9,w*0.707)
homomorphism
L --> [&(60){.+(20)f(0.1)-(20)f(0.1)-(20)f(0.1)+(20)+(160)f(0.1)-(20)f(0.1)}]
endlsystem
)";

/// The string alone: what the geometry below starts from.
void largeTreeDerivation(benchmark::State& state) {
  const simeco::Grammar grammar = simeco::parseLSystem(kLargeTree).grammar;
  for (auto _ : state) benchmark::DoNotOptimize(simeco::derive(grammar));
}
BENCHMARK(largeTreeDerivation)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Derived, interpreted by the turtle, and made organs.
void largeTreePlant(benchmark::State& state) {
  const simeco::Grammar grammar = simeco::parseLSystem(kLargeTree).grammar;
  for (auto _ : state) benchmark::DoNotOptimize(simeco::plantOfLSystem(grammar));
}
BENCHMARK(largeTreePlant)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

const simeco::Plant& largeTree() {
  static const simeco::Plant plant = simeco::plantOfLSystem(simeco::parseLSystem(kLargeTree).grammar).value();
  return plant;
}

void largeTreeGeometry(benchmark::State& state) {
  const simeco::Plant& plant = largeTree();
  for (auto _ : state) benchmark::DoNotOptimize(meshOf(plant));
}
BENCHMARK(largeTreeGeometry)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void largeTreeGlb(benchmark::State& state) {
  const PlantMesh mesh = meshOf(largeTree()).value();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = glbBytes(mesh)->size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}
BENCHMARK(largeTreeGlb)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void largeTreeObj(benchmark::State& state) {
  const PlantMesh mesh = meshOf(largeTree()).value();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = objAndMtl(mesh, "tree.mtl")->obj.size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}
BENCHMARK(largeTreeObj)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void firstPictureOfShrub(benchmark::State& state) {
  const simeco::Plant plant = test::shrub(2);
  for (auto _ : state) benchmark::DoNotOptimize(drawPlant(plant));
}
BENCHMARK(firstPictureOfShrub)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void furtherPictureOfShrub(benchmark::State& state) {
  const PlantMesh mesh = meshOf(test::shrub(2)).value();
  auto painter = Painter::open();
  if (!painter) return state.SkipWithError(painter.error().message.c_str());
  for (auto _ : state) benchmark::DoNotOptimize(painter->draw(mesh, {}));
}
BENCHMARK(furtherPictureOfShrub)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
