// Hostile grammars end quickly, in one clear message that names the rule and its line; every limit holds in every way of deriving.

#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_plant.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace axil::simeco {
namespace {

Grammar lsystem(const std::string& text) {
  const Parsed parsed = parseLSystem(text);
  EXPECT_TRUE(parsed.ok()) << text << "\n" << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}

/// Small limits, so that the tests are quick.
DeriveOptions small() {
  DeriveOptions options;
  options.limits = {.modules = 50'000, .bytes = 4 << 20, .steps = 2000, .settlingSteps = 500, .loopIterations = 100'000, .expressionDepth = 200, .seconds = 20};
  return options;
}

/// The message with which a derivation or its image ends, whatever the number of threads.
std::string endOf(const std::string& text, DeriveOptions options = small()) {
  std::string message;
  for (const int threads : {1, 4}) {
    options.threads = threads;
    const auto begin = std::chrono::steady_clock::now();
    const auto derivation = derive(lsystem(text), options);
    std::string now = derivation ? "" : derivation.error().message;
    if (derivation)
      if (const auto image = imageOf(*derivation); !image) now = image.error().message;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 10) << text;
    if (threads == 1) message = now;
    EXPECT_EQ(now, message) << text;
  }
  return message;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kHead = "Lsystem: 1\nderivation length: 1000\n";

TEST(EngineLimits, TooManyModulesNameTheRuleThatGrowsWithItsLineInEveryWay) {
  struct Case {
    const char* way;
    std::string text;
    const char* rule;
  };
  const std::string head = kHead;
  const Case cases[] = {
      {"leap", head + "Axiom: AB\nB --> B\nA --> AA\nendlsystem\n", "A --> AA (line 5)"},
      {"plain, with parameters", head + "Axiom: BA(1)\nB --> B\nA(x) : x>0 --> A(x)A(x)\nendlsystem\n", "A(x) --> A(x)A(x) (line 5)"},
      {"plain, bytes", head + "seed: 1\nAxiom: BA\nB --> B\nA --> AA : 1\nA --> AAA : 2\nendlsystem\n", "A --> AAA (line 7)"},
      {"contexts", head + "Axiom: BAA\nB --> B\nB < A --> AA\nA < A --> AA\nendlsystem\n", "A --> AA (line 6)"},
      {"general", head + "Start: {n=0;}\nAxiom: BA\nB --> B\nA : {n=n+1;} * --> AA\nendlsystem\n", "A --> AA (line 6)"},
      {"decomposition, general", head + "Start: {n=0;}\nAxiom: A\nB : {n=1;} * --> B\ndecomposition\nmaximum depth: 1000000\nA --> AA\nendlsystem\n", "A --> AA (line 8)"},
      {"decomposition, plain", head + "Axiom: A\nB --> B\ndecomposition\nmaximum depth: 1000000\nA --> CA\nendlsystem\n", "A --> CA (line 7)"},
      {"homomorphism", "Lsystem: 1\nderivation length: 1\nAxiom: AB\nB --> C\nhomomorphism\nmaximum depth: 1000000\nC --> C\nA --> FA\nendlsystem\n", "A --> FA (line 8)"},
      {"sub-L-system", head + "Axiom: ?(2,1)A$\nB --> B\nendlsystem\nLsystem: 2\nAxiom: A\nC --> C\nA --> AA\nendlsystem\n", "A --> AA (line 9)"},
      {"ring", "Lsystem: 1\nderivation length: 1000\nring Lsystem\nAxiom: BA\nA > B --> AA\nA --> AA\nendlsystem\n", "A --> AA (line 6)"},
  };
  for (const Case& c : cases) {
    const std::string message = endOf(c.text);
    EXPECT_TRUE(has(message, "modules") && has(message, c.rule)) << c.way << ": " << message;
  }
}

TEST(EngineLimits, MemoryIsLimitedBeforeItIsTaken) {
  DeriveOptions options = small();
  options.limits.modules = 20'000'000;
  options.limits.bytes = 1 << 16;
  std::string many = "A(x";
  for (int i = 0; i < 15; ++i) many += ",x";
  for (const std::string extra : {"", "Start: {n=0;}\n"}) {
    const std::string text = std::string(kHead) + extra + "Axiom: A(1)\nA(x) --> " + many + ")A(x)\n" + (extra.empty() ? "" : "C : {n=1;} * --> C\n") + "endlsystem\n";
    const std::string message = endOf(text, options);
    EXPECT_TRUE(has(message, "bytes") && has(message, "A(x) --> ")) << message;
  }
  const std::string drawn = endOf("Lsystem: 1\nderivation length: 1\nAxiom: A(1)\nB --> B\nhomomorphism\nmaximum depth: 1000000\nA(x) --> " + many + ")A(x)\nendlsystem\n", options);
  EXPECT_TRUE(has(drawn, "bytes")) << drawn;
}

TEST(EngineLimits, StepsLoopsAndDepthAreLimited) {
  DeriveOptions options = small();
  EXPECT_TRUE(has(endOf("Lsystem: 1\nderivation length: 100000\nAxiom: AB\nB --> C\nC --> B\nendlsystem\n", options), "limited to 2000 steps"));
  EXPECT_TRUE(has(endOf(std::string(kHead) + "Axiom: A\nA : {i=0; while (1) {i=i+1;}} * --> A\nendlsystem\n", options), "loop ran more than 100000 times"));
  // Trouble in a block of the header names the block.
  EXPECT_TRUE(endOf("Lsystem: 1\nderivation length: 2\nStart: {i=0; while (1) {i=i+1;}}\nAxiom: A\nA --> A\nendlsystem\n", options).ends_with("100000 times in Start"));
  EXPECT_TRUE(has(endOf("Lsystem: 1\nderivation length: 9\nStart: {n=3;}\nStartEach: {n=n-1; x=1/n;}\nAxiom: A\nA --> AB\nendlsystem\n", options), "zero in StartEach, in step 3"));
  std::string deep = "x";
  for (int i = 0; i < 150; ++i) deep = "(" + deep + "+1)";
  options.limits.expressionDepth = 100;
  EXPECT_TRUE(has(endOf(std::string(kHead) + "Axiom: A(1)\nA(x) --> A(" + deep + ")\nendlsystem\n", options), "nested deeper than the limit of 100"));
}

TEST(EngineLimits, TimeEndsARecursionThatNoOtherLimitEnds) {
  DeriveOptions options;
  options.limits.seconds = 0.5;
  for (const char* section : {"decomposition", "homomorphism"}) {
    // 60 modules, a million rules deep each.
    const auto derivation = derive(lsystem("Lsystem: 1\nderivation length: 1\nAxiom: " + std::string(60, 'A') + "\nB --> B\n" + section + "\nmaximum depth: 1000000\nA --> A\nendlsystem\n"), options);
    std::string message = derivation ? "" : derivation.error().message;
    if (derivation)
      if (const auto image = imageOf(*derivation); !image) message = image.error().message;
    EXPECT_TRUE(has(message, "longer than its limit of 0.5 s") && has(message, "A --> A")) << message;
  }
}

TEST(EngineLimits, ADecompositionWithoutEndCanBeCancelled) {
  CancelToken token;
  token.cancel();
  DeriveOptions options = small();
  options.watch.cancel = &token;
  const auto stopped = derive(lsystem("Lsystem: 1\nderivation length: 1\nAxiom: A\nB --> B\ndecomposition\nmaximum depth: 1000000\nA --> A\nendlsystem\n"), options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

TEST(EngineLimits, WhateverRulesMakeOfBracketsAndNumbersNothingBreaks) {
  // Made by rules: brackets that nothing closes or opens, infinities, nan, zero divisors, cuts everywhere, empty strings.
  for (const char* rules : {"A --> ]A]\n", "A --> [A[\n", "A --> ][\n", "[ --> ]\n] --> [\nA --> [A]\n", "A --> *\n", "A --> %A%\n% --> A%\n", "A --> [%]A%\n",
                            "A --> B(1/0)\nB(x) --> B(x*1e.0)\n", "A --> B(log(0))B(sqrt(-1))\nB(x) : x>0 --> C(x)\nC(x) --> B(0-x)\n", "A --> B(exp(1000)-exp(1000))\nB(x) : x==x --> A\n",
                            "A < A > A --> [A]\nA --> AA\n", "A > [A]A --> A\nA > =]A --> *\nA --> A[A]A\n", "A --> ?P(0,0)A\n", "A --> ?(1,2)A$\n", "A --> $A\n",
                            "A --> B(0%0)\nB(x) --> B(x%(x-x))\n"}) {
    const std::string text = std::string("Lsystem: 1\nderivation length: 9\nAxiom: A[A]A\n") + rules + "endlsystem\n";
    const Parsed parsed = parseLSystem(text);
    if (!parsed.ok()) continue;  // what the front end refuses needs no engine
    LSystemPlantOptions options;
    options.derive.derive = small();
    const auto plant = plantOfLSystem(parsed.grammar, options);
    EXPECT_TRUE(plant || !plant.error().message.empty()) << text;
    const std::string message = endOf(text);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(EngineLimits, DeepBracketsCostNoStack) {
  std::string axiom(20'000, '[');
  axiom += "A" + std::string(20'000, ']') + "A";
  DeriveOptions options = small();
  options.limits.modules = 1'000'000;
  EXPECT_EQ(endOf("Lsystem: 1\nderivation length: 3\nAxiom: " + axiom + "\nA > A --> AB\nB < A --> B\nendlsystem\n", options), "");
}

TEST(EngineLimits, AGrowthThatNeverEndsNamesItsRule) {
  const Parsed parsed = parseSimeco("EcoSystem 1.1 \"e\" {\n Plant \"p\" {\n  Stem { Stage 1 { GrowRate = 1; } }\n  Grow {\n   w = A(0);\n   A(i) -> S(1) [A(i)] A(i+1) ;\n  }\n }\n}\n");
  ASSERT_TRUE(parsed.ok());
  GrowOptions options;
  options.limits.modules = 10'000;
  const auto growth = prepareGrowth(parsed.grammar, options);
  ASSERT_FALSE(growth);
  EXPECT_TRUE(has(growth.error().message, "(line 6)")) << growth.error().message;
}

}  // namespace
}  // namespace axil::simeco
