// Derivation throughput: final modules per second of derivation alone (no parsing, no output), for eleven workloads that load
// one thing each. Beside each: the share of the memory bound reached, that is the time a plain copy of the final string would
// take on this machine, measured here, over the time of the derivation. `@v` is two letters and two modules here.

#include "simeco/derive.hpp"
#include "simeco/lsystem_language.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

namespace axil::simeco {
namespace {

struct Workload {
  const char* name;
  const char* text;
  int visitsEachStep;  ///< 1: the rate that counts is modules visited, the string is long from the start
};

constexpr const char* kMonopodial =
    "#define r1 0.9\n#define r2 0.6\n#define a0 45\n#define a2 45\n#define d 137.5\n#define wr 0.707\nLsystem: 1\nderivation length: 17\n"
    "Axiom: A(1,10)\n"
    "A(l,w) : 1 --> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\n"
    "B(l,w) : 1 --> !(w)F(l)[-(a2)@vC(l*r2,w*wr)]C(l*r1,w*wr)\n"
    "C(l,w) : 1 --> !(w)F(l)[+(a2)@vB(l*r2,w*wr)]B(l*r1,w*wr)\nendlsystem\n";

constexpr Workload kWorkloads[] = {
    {"koch", "Lsystem: 1\nderivation length: 6\nAxiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\nendlsystem\n", 0},
    {"bracketed_plant", "Lsystem: 1\nderivation length: 9\nAxiom: X\nX --> F-[[X]+X]+F[+FX]-X\nF --> FF\nendlsystem\n", 0},
    {"monopodial", kMonopodial, 0},
    {"row_of_trees",
     "#define p 0.3\n#define q 0.7\n#define h 0.458257569\nLsystem: 1\nderivation length: 16\nAxiom: F(1,0)\n"
     "F(x,t) : t==0 --> F(x*p,2)+F(x*h,1)--F(x*h,1)+F(x*q,0)\nF(x,t) : t>0 --> F(x,t-1)\nendlsystem\n",
     0},
    {"acropetal_signal",
     "Lsystem: 1\nderivation length: 1013\nignore: +-\nAxiom: JX(12)\nJ < I --> J\nX(n) : n>0 --> X(n-1)X(n-1)\nX(n) : n==0 --> I[+I][-I]\nendlsystem\n", 1},
    {"basipetal_signal",
     "Lsystem: 1\nderivation length: 1013\nignore: +-\nAxiom: X(12)J\nI > J --> J\nX(n) : n>0 --> X(n-1)X(n-1)\nX(n) : n==0 --> I[+I][-I]\nendlsystem\n", 1},
    {"nested_brackets", "Lsystem: 1\nderivation length: 2003\nignore: +-\nAxiom: X(1000)J\nI > J --> J\nX(n) : n>0 --> I[+X(n-1)]I\nendlsystem\n", 1},
    {"stochastic",
     "Lsystem: 1\nseed: 1234\nderivation length: 10\nAxiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\nendlsystem\n", 0},
    {"hogeweg_hesper",
     "Lsystem: 1\nderivation length: 50\nignore: +-F\nAxiom: FBFBFB\nA < A > A --> A\nA < A > B --> B[+FBFB]\nA < B > A --> B\nA < B > B --> B\n"
     "B < A > A --> A\nB < A > B --> BFB\nB < B > A --> A\nB < B > B --> A\n+ --> -\n- --> +\nendlsystem\n",
     0},
    {"decomposition",
     "Lsystem: 1\nderivation length: 18\nAxiom: A(0)\nA(t) --> A(t+1)\nI(t) --> I(t+1)\ndecomposition\nmaximum depth: 3\n"
     "A(t) : t>=2 --> S(1)[+(40)A(t-2)]S(0)[-(30)A(t-1)]A(t-2)\nS(n) : n>0 --> S(n-1)I(0)\nS(n) : n==0 --> I(0)\nendlsystem\n",
     0},
    // Its homomorphism draws leaves; the string is derived without them, longer than the file asks so that there is something to measure.
    {"geometry_tree",
     "#define r1 0.9\n#define r2 0.6\n#define a0 45\n#define a2 45\n#define d 137.5\n#define wr 0.707\nLsystem: 1\nderivation length: 17\n"
     "Axiom: A(1,0.2)\n"
     "A(l,w) : 1 --> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\n"
     "B(l,w) : 1 --> !(w)F(l)L[-(a2)@vC(l*r2,w*wr)]C(l*r1,w*wr)\n"
     "C(l,w) : 1 --> !(w)F(l)L[+(a2)@vB(l*r2,w*wr)]B(l*r1,w*wr)\n"
     "homomorphism\nL --> [&(60){.+(20)f(0.1)-(20)f(0.1)-(20)f(0.1)+(20)+(160)f(0.1)-(20)f(0.1)}]\nendlsystem\n",
     0},
};

double secondsOf(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Bytes per second of a plain copy on this machine: 64 MiB, warm, best of several.
double copyBandwidth() {
  static const double best = [] {
    const std::size_t bytes = std::size_t{64} << 20;
    std::vector<char> from(bytes, 1), to(bytes, 2);
    double shortest = 1e9;
    for (int i = 0; i < 9; ++i) {
      shortest = std::min(shortest, secondsOf([&] { std::memcpy(to.data(), from.data(), bytes); }));
      benchmark::DoNotOptimize(to.data());
    }
    return static_cast<double>(bytes) / shortest;
  }();
  return best;
}

double stringBytes(const ModuleString& string) { return static_cast<double>(string.size() + 8 * string.parameters().size()); }

/// Modules that the steps of a derivation read.
double visits(const Derivation& derivation) {
  double sum = 1;
  for (const std::size_t modules : derivation.modulesPerStep) sum += static_cast<double>(modules);
  return sum - static_cast<double>(derivation.modulesPerStep.back());
}

void derivation(benchmark::State& state, const Workload& workload) {
  const Parsed parsed = parseLSystem(workload.text);
  if (!parsed.ok()) return state.SkipWithError(parsed.diagnostics.front().message.c_str());
  DeriveOptions options;
  options.threads = static_cast<int>(state.range(0));
  double modules = 0, bytes = 0, visited = 0, peak = 0, allowed = 1, shortest = 1e9, busiest = 1e9;
  for ([[maybe_unused]] auto _ : state) {
    const std::clock_t before = std::clock();
    const auto derived = derive(parsed.grammar, options);
    busiest = std::min(busiest, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    if (!derived) return state.SkipWithError(derived.error().message.c_str());
    state.SetIterationTime(derived->seconds);
    shortest = std::min(shortest, derived->seconds);
    modules = static_cast<double>(derived->string.size());
    bytes = stringBytes(derived->string);
    visited = visits(*derived);
    peak = static_cast<double>(derived->peakBytes);
    allowed = 16 * (modules + static_cast<double>(derived->string.parameters().size()));
  }
  state.counters["modules"] = modules;
  state.counters["modules/s"] = (workload.visitsEachStep != 0 ? visited : modules) / shortest;
  // Of all processors' time: what other work on the machine takes is not in it.
  state.counters["modules/cpu_s"] = (workload.visitsEachStep != 0 ? visited : modules) / std::max(busiest, 1e-6);
  state.counters["GB/s_copy"] = copyBandwidth() / 1e9;
  state.counters["of_bound"] = bytes / copyBandwidth() / shortest;
  state.counters["bytes/module"] = peak / modules;
  // Of twice 8 bytes a module and 8 a parameter of the final string.
  state.counters["of_memory"] = peak / allowed;
}

/// How the time grows with the length of the string: 1 is linear. Figures at two lengths, about thirty times apart.
void exponent(benchmark::State& state, const char* text, std::int64_t shortSteps, std::int64_t longSteps) {
  const Parsed parsed = parseLSystem(text);
  double smaller = 1e9, larger = 1e9, few = 1, many = 1;
  for ([[maybe_unused]] auto _ : state) {
    for (const std::int64_t steps : {shortSteps, longSteps}) {
      DeriveOptions options;
      options.steps = steps;
      const auto derived = derive(parsed.grammar, options);
      if (!derived) return state.SkipWithError(derived.error().message.c_str());
      (steps == shortSteps ? smaller : larger) = std::min(steps == shortSteps ? smaller : larger, derived->seconds);
      (steps == shortSteps ? few : many) = static_cast<double>(derived->string.size());
    }
  }
  state.counters["exponent"] = std::log(larger / smaller) / std::log(many / few);
}

const bool kRegistered = [] {
  for (const Workload& workload : kWorkloads)
    benchmark::RegisterBenchmark((std::string("simeco/derive/") + workload.name).c_str(), [&workload](benchmark::State& state) { derivation(state, workload); })
        ->Arg(1)
        ->Arg(2)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("simeco/exponent/monopodial", [](benchmark::State& state) { exponent(state, kMonopodial, 14, 19); })->Iterations(5)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("simeco/exponent/hogeweg_hesper", [](benchmark::State& state) { exponent(state, kWorkloads[8].text, 42, 56); })
      ->Iterations(5)
      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace axil::simeco
