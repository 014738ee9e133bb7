#include "simeco/engine.hpp"

#include "base/rng.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axil::simeco {
namespace {

Grammar grammarOf(const std::string& text) {
  const Parsed parsed = parseLSystem(text);
  EXPECT_TRUE(parsed.ok()) << text << "\n" << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}

struct Way {
  bool general = false;
  int threads = 1;
  std::size_t modulesForCalm = 512;
  bool stepByStep = false;  ///< never more than one step at once
};

struct Outcome {
  std::string text;
  std::vector<std::size_t> modulesPerStep;
  bool operator==(const Outcome&) const = default;
};
void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << outcome.text << " after";
  for (const std::size_t modules : outcome.modulesPerStep) *out << " " << modules;
}

Outcome derivedBy(const Grammar& grammar, const Way& way, std::int64_t steps, std::uint64_t seed = 1, bool single = false) {
  auto program = compile(grammar, 0);
  if (!program) throw std::runtime_error(program.error().message);
  EngineOptions options;
  options.seed = seed;
  options.threads = way.threads;
  options.generalWay = way.general;
  options.modulesPerThread = 3;
  options.modulesForCalm = way.modulesForCalm;
  options.singlePrecision = single;
  options.limits.modules = 200'000;
  auto engine = Engine::create(*program, options);
  if (!engine) throw std::runtime_error(engine.error().message);
  Outcome outcome;
  if (auto started = (*engine)->start(); !started) return {started.error().message, {}};
  for (std::int64_t done = way.stepByStep ? 0 : steps - 1; done < steps; ++done)
    if (auto ran = (*engine)->run(done + 1, outcome.modulesPerStep); !ran) return {"stopped", {}};
  outcome.text = toText((*engine)->string());
  return outcome;
}

/// Grammars of every kind that the plain way knows, made at random.
class RandomGrammar {
 public:
  explicit RandomGrammar(std::uint64_t seed) : rng_(seed) {}

  std::string text() {
    parametric_ = chance(0.5);
    stochastic_ = chance(0.3);
    contexts_ = chance(0.7);
    const bool decomposed = chance(0.3);
    std::string text = "Lsystem: 1\n";
    if (stochastic_) text += "seed: 5\n";
    text += "derivation length: 6\n";
    if (chance(0.5)) text += "ignore: +-\n";
    if (chance(0.1)) text += "consider: AB\n";
    text += "Axiom: " + modules(40, false, 0) + "\n";
    const std::uint64_t rules = 1 + rng_.below(6);
    for (std::uint64_t i = 0; i < rules; ++i) text += rule(3, stochastic_);
    if (decomposed) {
      text += "decomposition\nmaximum depth: " + std::to_string(1 + rng_.below(3)) + "\n";
      for (std::uint64_t i = 0; i < 2; ++i) text += rule(2, false);
    }
    return text + "endlsystem\n";
  }
  /// The same kind of grammar with a homomorphism.
  std::string drawnText() {
    std::string drawn = text();
    drawn.resize(drawn.size() - std::string_view("endlsystem\n").size());
    contexts_ = chance(0.2);
    stochastic_ = stochastic_ && chance(0.3);
    drawn += "homomorphism\nmaximum depth: " + std::to_string(rng_.below(4)) + "\n";
    for (int i = 0; i < 3; ++i) drawn += rule(4, false);
    return drawn + "endlsystem\n";
  }

 private:
  bool chance(double share) { return rng_.uniform() < share; }
  char letter() { return "ABC+-F"[rng_.below(6)]; }
  bool hasParameter(char c) const { return parametric_ && (c == 'A' || c == 'B'); }

  std::string expression(int variables) {
    if (variables == 0 || chance(0.3)) return std::to_string(rng_.below(4));
    const std::string x(1, static_cast<char>('x' + static_cast<char>(rng_.below(static_cast<std::uint64_t>(variables)))));
    switch (rng_.below(6)) {
      case 0: return x + "+1";
      case 1: return x + "*0.5";
      case 2: return x + "-2";
      case 3: return "(" + x + "*" + x + "+1)/3";
      case 4: return stochastic_ ? "ran(" + x + "+1)" : x + "/4";
      default: return x;
    }
  }
  std::string modules(std::uint64_t most, bool inRule, int variables) {
    std::string text;
    const std::uint64_t count = 1 + rng_.below(most);
    int open = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (chance(0.2)) text += "[", ++open;
      const char c = letter();
      text += c;
      if (hasParameter(c)) text += "(" + expression(variables) + ")";
      if (open > 0 && chance(0.5)) text += "]", --open;
    }
    while (open-- > 0) text += "]";
    // Brackets that nothing closes, or that nothing opened, must not confuse contexts either.
    if (!inRule && chance(0.1)) text += "]AB";
    if (!inRule && chance(0.1)) text += "[BA";
    return text;
  }
  std::string context(int& variables) {
    const char c = "ABCF"[rng_.below(4)];
    return hasParameter(c) ? std::string(1, c) + "(" + static_cast<char>('x' + variables++) + ")" : std::string(1, c);
  }
  std::string rule(std::uint64_t most, bool weighted) {
    int variables = 0;
    const char c = letter();
    std::string predecessor(1, c);
    if (hasParameter(c)) predecessor += std::string("(") + static_cast<char>('x' + variables++) + ")";
    std::string text = predecessor;
    if (contexts_ && chance(0.5)) text = context(variables) + " < " + text;
    if (contexts_ && variables < 3 && chance(0.5)) text += " > " + context(variables);
    if (variables > 0 && chance(0.4)) text += " : x" + std::string(chance(0.5) ? ">" : "<=") + std::to_string(rng_.below(4));
    text += " --> " + (chance(0.1) ? std::string("*") : modules(most, true, std::min(variables, 3)));
    if (weighted && chance(0.7)) text += std::string(text.find(" : ") == std::string::npos ? " : " : " : ") + std::to_string(1 + rng_.below(5));
    return text + "\n";
  }

  Rng rng_;
  bool parametric_ = false, stochastic_ = false, contexts_ = false;
};

TEST(Engine, EveryWayMakesTheSameString) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const std::string text = RandomGrammar(seed).text();
    const Parsed parsed = parseLSystem(text);
    ASSERT_TRUE(parsed.ok()) << text << parsed.diagnostics.front().message;
    const Outcome expected = derivedBy(parsed.grammar, {.general = true, .stepByStep = true}, 7, seed);
    EXPECT_EQ(derivedBy(parsed.grammar, {}, 7, seed), expected) << "seed " << seed << "\n" << text;
    EXPECT_EQ(derivedBy(parsed.grammar, {.threads = 3}, 7, seed), expected) << "three threads, seed " << seed << "\n" << text;
    EXPECT_EQ(derivedBy(parsed.grammar, {.threads = 2, .modulesForCalm = 1, .stepByStep = true}, 7, seed), expected) << "calm, seed " << seed << "\n" << text;
  }
}

Image imageBy(const Grammar& grammar, bool general, std::uint64_t seed, std::vector<std::string>& warnings) {
  EngineOptions options;
  options.seed = seed;
  options.generalWay = general;
  options.limits.modules = 200'000;
  auto engine = Engine::create(compile(grammar, 0).value(), options).value();
  EXPECT_TRUE(engine->start());
  std::vector<std::size_t> counts;
  if (!engine->run(3, counts)) return {};
  auto image = engine->imageOf(engine->string());
  warnings = engine->warnings();
  return image ? *std::move(image) : Image{};
}

TEST(Engine, EveryWayDrawsTheSameImage) {
  std::size_t drawn = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::string text = RandomGrammar(seed).drawnText();
    const Grammar grammar = grammarOf(text);
    std::vector<std::string> generalWarnings, warnings;
    const Image expected = imageBy(grammar, true, seed, generalWarnings), image = imageBy(grammar, false, seed, warnings);
    EXPECT_EQ(toText(image.string), toText(expected.string)) << "seed " << seed << "\n" << text;
    EXPECT_EQ(image.source, expected.source) << "seed " << seed << "\n" << text;
    EXPECT_EQ(image.drawnBy, expected.drawnBy) << "seed " << seed << "\n" << text;
    EXPECT_EQ(warnings, generalWarnings) << "seed " << seed << "\n" << text;
    drawn += image.drawnBy.empty() ? 0 : 1;
  }
  EXPECT_GT(drawn, 200u);
}

TEST(Engine, DecompositionOfAnyDepthIsTheSameEveryWay) {
  const std::string chain = "A(n) : n>0 --> B(n,2*n)[+A(n-1)]C\nA(n) --> D[A(n+90)]\n", tree = "A(n) : n>1 --> I(1)[+(40)A(n-2)]I(n)[-(30)A(n-1)]A(n-2)\nI(n) : n>0 --> I(n-1)F(n)\n";
  const std::string lottery = "A(n) --> A(n+5)B : 1\nA(n) --> A(n+7)[C] : 2\n";
  struct Model {
    std::string head, rules, depth;
  };
  // Depths below, at and above those that calls follow.
  for (const auto& [head, rules, depth] : {Model{"", "C --> C", "1"}, Model{"", "A(n) --> A(n+60)", "47"}, Model{"", "A(n) --> A(n+60)", "48"}, Model{"", "A(n) --> A(n+60)", "49"},
                                           Model{"", "A(n) : n<7 --> [A(n+1)]A(n+200)", "50"}, Model{"", "A(n) --> A(n)", "150"}, Model{"seed: 3\n", lottery, "70"}, Model{"seed: 3\n", lottery, "5"}}) {
    for (const std::string& decomposition : {chain, tree}) {
      const std::string text = "Lsystem: 1\n" + head + "derivation length: 3\nAxiom: A(3)[A(9)C]A(12)A(0)\n" + rules + "\ndecomposition\nmaximum depth: " + depth + "\n" + decomposition + "endlsystem\n";
      const Grammar grammar = grammarOf(text);
      const Outcome expected = derivedBy(grammar, {.general = true, .stepByStep = true}, 2, 4);
      EXPECT_EQ(derivedBy(grammar, {}, 2, 4), expected) << text;
      EXPECT_EQ(derivedBy(grammar, {.threads = 3}, 2, 4), expected) << text;
      EXPECT_EQ(derivedBy(grammar, {}, 2, 4, true), derivedBy(grammar, {.general = true}, 2, 4, true)) << text;
    }
  }
}

TEST(Engine, EveryWayStoresSinglePrecisionAlike) {
  const Grammar grammar = grammarOf("Lsystem: 1\nderivation length: 4\nAxiom: A(0.1)B\nA(x) --> A(x*1.1)B[A(0.3)]\nB --> A(0.7)\nendlsystem\n");
  EXPECT_EQ(derivedBy(grammar, {}, 4, 1, true), derivedBy(grammar, {.general = true}, 4, 1, true));
  EXPECT_NE(derivedBy(grammar, {}, 4, 1, true), derivedBy(grammar, {}, 4, 1, false));
  const Grammar constant = grammarOf("Lsystem: 1\nderivation length: 4\nAxiom: A(0.1)\nA(x) --> B(0.3)A(0.7)\nendlsystem\n");
  EXPECT_EQ(derivedBy(constant, {}, 4, 1, true), derivedBy(constant, {.general = true}, 4, 1, true));
}

TEST(Engine, ASignalIsFollowedThroughALongPlant) {
  // 3000 segments with side branches; the signal must turn into every branch, at any number of steps.
  std::string axiom = "J";
  for (int i = 0; i < 300; ++i) axiom += "I[+I[-I]I][[I]I]I";
  for (const char* rule : {"J < I --> J", "I > J --> J"}) {
    const std::string text = "Lsystem: 1\nignore: +-\nderivation length: 1\nAxiom: " + axiom + "J\n" + rule + "\nendlsystem\n";
    const Grammar grammar = grammarOf(text);
    for (const std::int64_t steps : {1, 2, 3, 50, 400, 900})
      EXPECT_EQ(derivedBy(grammar, {.modulesForCalm = 1}, steps), derivedBy(grammar, {.general = true}, steps)) << rule << " " << steps;
  }
}

TEST(Engine, AParameterThatCountsInPlaceIsFollowedToo) {
  std::string axiom = "A(0)";
  for (int i = 0; i < 200; ++i) axiom += "I[L(3)]";
  const Grammar grammar = grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: " + axiom + "\nA(t) : t<5 --> A(t+1)\nA(t) : t>=5 --> B(t)\nB(t) --> B(t*0.5)\nendlsystem\n");
  for (const std::int64_t steps : {3, 5, 6, 9}) EXPECT_EQ(derivedBy(grammar, {.modulesForCalm = 1}, steps), derivedBy(grammar, {.general = true}, steps));
}

TEST(Engine, LeapsCountEveryStepAndKeepTheLimit) {
  const Grammar koch = grammarOf("Lsystem: 1\nderivation length: 4\nAxiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\nendlsystem\n");
  const Outcome leapt = derivedBy(koch, {.threads = 2}, 4);
  EXPECT_EQ(leapt, derivedBy(koch, {.general = true}, 4));
  EXPECT_EQ(leapt.modulesPerStep, (std::vector<std::size_t>{59, 475, 3803, 30427}));
  DeriveOptions options;
  options.steps = 500;
  const auto stopped = derive(koch, options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::LimitReached);
  EXPECT_NE(stopped.error().message.find("in step 8; the rule that was growing it is F --> "), std::string::npos) << stopped.error().message;
}

TEST(Engine, RecursionWithoutEndInDecompositionStopsAtALimit) {
  DeriveOptions options;
  options.limits.modules = 10'000;
  const auto growing = derive(grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: A\nB --> B\ndecomposition\nmaximum depth: 1000000\nA --> AA\nendlsystem\n"), options);
  ASSERT_FALSE(growing);
  EXPECT_EQ(growing.error().code, ErrorCode::LimitReached);
  options.limits.seconds = 0.05;
  const std::string many(5000, 'A');
  const auto circling = derive(grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: " + many + "\nB --> B\ndecomposition\nmaximum depth: 1000000\nA --> A\nendlsystem\n"), options);
  ASSERT_FALSE(circling);
  EXPECT_EQ(circling.error().code, ErrorCode::LimitReached);
}

TEST(Engine, AnEndlessLoopStopsAtALimit) {
  DeriveOptions options;
  options.limits.loopIterations = 1000;
  const auto looped = derive(grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: A\nA : { i=0; while (1) { i=i+1; } } * --> B(i)\nendlsystem\n"), options);
  ASSERT_FALSE(looped);
  EXPECT_NE(looped.error().message.find("loop ran more than 1000 times"), std::string::npos) << looped.error().message;
}

TEST(Engine, AHostAnswersFunctionsAndChangesVariablesBetweenSteps) {
  DeriveOptions options;
  options.host.function = [](std::int64_t id, std::span<const double> x) -> Result<double> { return static_cast<double>(id) * 10 + x[0]; };
  options.host.exchange = [](std::span<double> variables) -> Result<void> {
    variables[0] += 100;
    return {};
  };
  std::int64_t calls = 0;
  options.host.betweenSteps = [&](HostStep& step) -> Result<void> {
    EXPECT_EQ(step.step(), calls++);
    EXPECT_TRUE(step.setVariable("g", static_cast<double>(calls)));
    EXPECT_FALSE(step.setVariable("nobody", 1));
    if (step.step() == 1) step.parameters()[0] = 7;
    return {};
  };
  const auto derived = derive(grammarOf("Lsystem: 1\nStart: { g=0; }\nderivation length: 2\nAxiom: A(1)\nA(x) : { y=x; com(y); } * --> A(func(2,y)+g*1000)\nendlsystem\n"), options);
  ASSERT_TRUE(derived) << derived.error().message;
  // First step: y = 101, g = 1; the host then writes 7, so the second has y = 107, g = 2.
  EXPECT_EQ(toText(derived->string), "A(2127)");
  EXPECT_EQ(calls, 3);
  EXPECT_FALSE(derive(grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: A(1)\nA(x) --> A(func(2,x))\nendlsystem\n")));
}

TEST(Engine, AnImageKnowsTheModuleThatEachOfItsModulesComesFrom) {
  const auto derived = derive(grammarOf("Lsystem: 1\nderivation length: 1\nAxiom: AB\nA --> AI\nhomomorphism\nI --> F[+L]\nB --> GG\nendlsystem\n"));
  ASSERT_TRUE(derived);
  EXPECT_EQ(toText(derived->string), "AIB");
  const auto image = imageOf(*derived);
  ASSERT_TRUE(image);
  EXPECT_EQ(toText(image->string), "AF[+L]GG");
  EXPECT_EQ(image->source, (std::vector<std::uint32_t>{0, 1, 1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(toText(derived->string), "AIB");
}

}  // namespace
}  // namespace axil::simeco
