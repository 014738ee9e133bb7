// At most 8 bytes a module and 8 a parameter, and twice that while a step runs. A module that draws carries its identity as one more
// parameter. Counted for every way of deriving, beside a small constant.

#include "simeco/derive.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::simeco {
namespace {

struct Case {
  const char* name;
  std::string rules;
  std::int64_t steps;
};

const std::string kHead = "Lsystem: 1\nderivation length: 1\n";

std::vector<Case> cases() {
  return {
      {"leap", "Axiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\n", 5},
      {"parameters", "Axiom: A(1,10)\nA(l,w) : l>0 --> F(l)[&(45)A(l*0.6,w)]A(l*0.9,w*0.7)\n", 13},
      {"many parameters that stay", "Axiom: X(12)\nX(n) : n>0 --> X(n-1)X(n-1)\nX(n) : n==0 --> P(1,2,3,4,5,6)\nP(a,b,c,d,e,f) : a<9 --> P(a+1,b,c,d,e,f)\n", 20},
      {"acropetal signal", "ignore: +-\nAxiom: JX(10)\nJ < I --> J\nX(n) : n>0 --> X(n-1)X(n-1)\nX(n) : n==0 --> I[+I][-I]\n", 200},
      {"basipetal signal", "ignore: +-\nAxiom: X(12)J\nI > J --> J\nX(n) : n>0 --> X(n-1)X(n-1)\nX(n) : n==0 --> I[+I][-I]\n", 200},
      {"nested brackets", "ignore: +-\nAxiom: X(1000)J\nI > J --> J\nX(n) : n>0 --> I[+X(n-1)]I\n", 1500},
      {"contexts with parameters", "Axiom: X(11)\nX(n) : n>0 --> X(n-1)[I(1)]X(n-1)\nX(n) : n==0 --> I(0)\nI(a) < I(x) > I(b) --> I(a+b)\n", 16},
      {"contexts that name brackets", "Axiom: X(11)\nX(n) : n>0 --> X(n-1)[I]X(n-1)\nX(n) : n==0 --> I\nI < I > [I]I --> I\n", 16},
      {"stochastic", "seed: 3\nAxiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\n", 8},
      {"general", "Start: {n=0;}\nAxiom: X(12)\nX(m) : m>0 {n=n+1;} --> X(m-1)[I(m)]X(m-1)\n", 14},
      {"decomposition", "Axiom: A(0)\nA(t) --> A(t+1)\ndecomposition\nmaximum depth: 3\nA(t) : t>=2 --> I(1)[+(40)A(t-2)]I(0)[-(30)A(t-1)]A(t-2)\n", 12},
  };
}

/// Of any string on the way; the models here have them within the first twenty steps.
double mostParameters(const Grammar& grammar, std::int64_t steps) {
  std::size_t most = 0;
  DeriveOptions options;
  options.threads = 1;
  for (options.steps = 1; *options.steps <= std::min<std::int64_t>(steps, 20); ++*options.steps)
    if (const auto derivation = derive(grammar, options); derivation) most = std::max(most, derivation->string.parameters().size());
  return static_cast<double>(most);
}

TEST(EngineMemory, AStepTakesAtMostTwiceEightBytesAModuleAndAParameter) {
  constexpr double constant = 8 << 10;
  for (const Case& c : cases()) {
    const Parsed parsed = parseLSystem(kHead + c.rules + "endlsystem\n");
    ASSERT_TRUE(parsed.ok()) << c.name << parsed.diagnostics.front().message;
    for (const int threads : {1, 2, 8}) {
      DeriveOptions options;
      options.steps = c.steps;
      options.threads = threads;
      const auto derivation = derive(parsed.grammar, options);
      ASSERT_TRUE(derivation) << c.name << derivation.error().message;
      const std::size_t most = *std::max_element(derivation->modulesPerStep.begin(), derivation->modulesPerStep.end());
      const double modules = static_cast<double>(most);
      const double parameters = mostParameters(parsed.grammar, c.steps) + (std::string(c.name) == "stochastic" ? modules : 0);
      const double bound = 2 * (8 * modules + 8 * parameters);
      EXPECT_LE(static_cast<double>(derivation->peakBytes), bound + constant * threads)
          << c.name << ", " << threads << " threads: " << modules << " modules, " << parameters << " parameters";
      EXPECT_GT(derivation->peakBytes, derivation->string.size()) << c.name;
    }
  }
}

}  // namespace
}  // namespace axil::simeco
