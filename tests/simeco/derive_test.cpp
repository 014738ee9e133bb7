#include "simeco/derive.hpp"

#include "base/files.hpp"
#include "simeco/engine.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

namespace axil::simeco {
namespace {

Grammar grammarOf(const std::string& text) {
  const Parsed parsed = parseSimeco(text);
  EXPECT_TRUE(parsed.ok()) << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}
Grammar rules(const std::string& text) { return grammarOf("EcoSystem 1.1 \"e\" { Plant \"p\" { Grow { " + text + " } } }"); }

Derivation derived(const Grammar& grammar, const DeriveOptions& options = {}) {
  auto derivation = derive(grammar, options);
  if (!derivation) throw std::runtime_error(derivation.error().message);
  return *std::move(derivation);
}
std::string textAfter(const std::string& text, std::int64_t steps, std::uint64_t seed = 1) {
  DeriveOptions options;
  options.steps = steps;
  options.seed = seed;
  return toText(derived(rules(text), options).string);
}
Error refusal(const std::string& text, const DeriveOptions& options = {}) {
  const auto derivation = derive(rules(text), options);
  return derivation ? Error{ErrorCode::BadInput, "it derived " + toText(derivation->string)} : derivation.error();
}

TEST(Derive, LantanaSettlesAfterTenStepsWithThePublishedCounts) {
  const auto text = readFile(std::string(AXIL_TEST_DIR) + "/data/lantana.simeco");
  ASSERT_TRUE(text) << text.error().message;
  const Derivation derivation = derived(grammarOf(*text));
  EXPECT_EQ(derivation.modulesPerStep, (std::vector<std::size_t>{1, 2, 4, 5, 7, 20, 63, 133, 178, 188}));
  EXPECT_TRUE(derivation.settled);
  const auto counts = letterCounts(derivation.string);
  EXPECT_EQ(counts.at("S"), 40u);
  EXPECT_EQ(counts.at("L"), 24u);
  EXPECT_EQ(counts.at("["), counts.at("]"));
  EXPECT_FALSE(counts.contains("A"));
  EXPECT_GT(derivation.peakBytes, 0u);
}

TEST(Derive, TheFirstMatchingRuleFiresAndOthersAreCopied) {
  EXPECT_EQ(textAfter("w = S(1) S(2) S(3) L(1); S(1) -> S(10) ; S(i) -> S(i+0.5, i < 3) ; S(1) -> S(99) ;", 1), "S(10)S(2.5)S(3)L(1)");
}

TEST(Derive, AllModulesAreRewrittenInParallel) {
  EXPECT_EQ(textAfter("w = A(0); A(0) -> A(1) A(2) ; A(1) -> A(0) ; A(2) -> L(1) ;", 3), "A(1)A(2)L(1)");
}

TEST(Derive, ContextsReadTheOldStringAcrossBrackets) {
  EXPECT_EQ(textAfter("w = S(1) [L(9)] S(2) S(3); S(1) < S(i) -> S(i+10) ;", 1), "S(1)[L(9)]S(12)S(3)");
  EXPECT_EQ(textAfter("w = S(2) [L(9) S(3)] S(1); S(i) > S(1) -> A(i) ;", 1), "A(2)[L(9)S(3)]S(1)");
  EXPECT_EQ(textAfter("w = S(7) [S(1) [S(2)]]; S(j) < S(i) -> S(10*j+i) ;", 1), "S(7)[S(71)[S(12)]]");
  EXPECT_EQ(textAfter("w = S(1) [S(2)]; S(2) > S(i) -> A(i) ;", 1), "S(1)[S(2)]");
}

TEST(Derive, TheThesisCounterRunsAndThenExpands) {
  const std::string text = "w = S(1002) S(5003); S(i) -> S(i+1, 1001 < i < 1006) ; S(1006) > S(5003) -> A(1003) ; A(1003) < S(5003) -> L(1) ;";
  EXPECT_EQ(textAfter(text, 4), "S(1006)S(5003)");
  EXPECT_EQ(textAfter(text, 5), "A(1003)S(5003)");
  EXPECT_EQ(toText(derived(rules(text)).string), "A(1003)L(1)");
}

TEST(Derive, ManyRulesForOneNumberEachKeepTextOrderWithTheOthers) {
  std::string text = "w = ";
  for (int i = 0; i < 40; ++i) text += "S(" + std::to_string(i) + ") ";
  text += "; ";
  for (int i = 0; i < 20; ++i) text += "S(" + std::to_string(i) + ") -> L(" + std::to_string(i) + ") ;\n";
  text += "S(i) -> R(i, i < 30) ;\n";
  for (int i = 20; i < 40; ++i) text += "S(" + std::to_string(i) + ") -> F(" + std::to_string(i) + ") ;\n";
  std::string expected;
  for (int i = 0; i < 40; ++i) expected += (i < 20 ? "L(" : i < 30 ? "R(" : "F(") + std::to_string(i) + ")";
  EXPECT_EQ(textAfter(text, 1), expected);
}

TEST(Derive, ExpressionsComputeWhatTheySay) {
  EXPECT_EQ(textAfter("w = S(3); S(i) -> S(2*i+1) S(i-5) S(i/2) S(7%i) S(2^i) S(-i) S(10-i) ;", 1), "S(7)S(-2)S(1.5)S(1)S(8)S(-3)S(7)");
  EXPECT_EQ(textAfter("w = S(3); S(i) -> S(min(i, 2)) S(max(i, 2)) S(floor(i/2)) S(sqrt(i*i)) S(abs(0-i)) S(sin(0*i)) ;", 1), "S(2)S(3)S(1)S(3)S(3)S(0)");
}

TEST(Derive, RandomDrawsDependOnSeedStepAndModuleAlone) {
  const std::string one = "w = A(0) S(0); S(i) -> S(random(0, 1)) ;";
  const std::string other = "w = A(0) S(0); A(i) -> A(random(5, 6) + normal(0, 1)) ; S(i) -> S(random(0, 1)) ;";
  const auto last = [](const std::string& text) { return text.substr(text.rfind('S')); };
  EXPECT_EQ(last(textAfter(one, 3)), last(textAfter(other, 3)));
  EXPECT_EQ(textAfter(other, 3), textAfter(other, 3));
  EXPECT_NE(textAfter(one, 3), textAfter(one, 3, 2));
  EXPECT_NE(textAfter(one, 3), textAfter(one, 4));
}

TEST(Derive, WeightedSuccessorsAreDrawnInProportion) {
  Grammar grammar = rules("w = A(0); A(0) -> A(0) A(0) ;");
  // A(0) -> L(1) : 1 | F(1) : 3
  Production& production = grammar.plants[0].rules.productions[0];
  const auto one = [&](const char* letter) { return Module{letter, {grammar.add(Number{1})}, {}}; };
  production.successors = {{{one("L")}, grammar.add(Number{1})}, {{one("F")}, grammar.add(Number{3})}};
  std::vector<Module> axiom;
  for (int i = 0; i < 40000; ++i) axiom.push_back({"A", {grammar.add(Number{0})}, {}});
  grammar.plants[0].rules.axiom = axiom;
  const auto counts = letterCounts(derived(grammar).string);
  EXPECT_EQ(counts.at("L") + counts.at("F"), 40000u);
  EXPECT_NEAR(static_cast<double>(counts.at("L")), 10000, 400);
}

TEST(Derive, AGrammarThatNeverSettlesEndsAtALimitThatNamesTheRule) {
  DeriveOptions options;
  options.limits.modules = 1000;
  const Error modules = refusal("w = A(0); A(i) -> A(i) A(i+1) ;", options);
  EXPECT_EQ(modules.code, ErrorCode::LimitReached);
  EXPECT_NE(modules.message.find("1000 modules"), std::string::npos) << modules.message;
  EXPECT_NE(modules.message.find("A(i) -> A(i)"), std::string::npos) << modules.message;
  options.limits.steps = 77;
  const Error steps = refusal("w = S(0); S(i) -> S(i+1) ;", options);
  EXPECT_EQ(steps.code, ErrorCode::LimitReached);
  EXPECT_NE(steps.message.find("77 steps"), std::string::npos) << steps.message;
  EXPECT_NE(steps.message.find("S(i) ->"), std::string::npos) << steps.message;
  options = {};
  options.limits.bytes = 1 << 16;
  EXPECT_EQ(refusal("w = A(0); A(i) -> A(i) A(i+1) ;", options).code, ErrorCode::LimitReached);
  options = {};
  options.limits.seconds = 0.02;
  options.limits.steps = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(refusal("w = S(0); S(i) -> S(i+1) ;", options).code, ErrorCode::LimitReached);
}

TEST(Derive, DivisionByZeroAndNumbersThatAreNotFiniteNameTheRule) {
  const Error division = refusal("w = S(0); S(i) -> S(1/i) ;");
  EXPECT_EQ(division.code, ErrorCode::NoAnswer);
  EXPECT_NE(division.message.find("division by zero in step 1, by the rule S(i) ->"), std::string::npos) << division.message;
  EXPECT_EQ(refusal("w = S(0); S(i) -> S(log(i)) ;").code, ErrorCode::NoAnswer);
  EXPECT_EQ(refusal("w = S(10); S(i) -> S(i*i) ;").code, ErrorCode::NoAnswer);
  EXPECT_EQ(refusal("w = S(4); S(i) -> L(1, 1/(i-4) > 0) ;").code, ErrorCode::NoAnswer);
}

TEST(Derive, CanBeCancelledAndReportsProgress) {
  CancelToken token;
  token.cancel();
  DeriveOptions options;
  options.watch.cancel = &token;
  EXPECT_EQ(refusal("w = S(0); S(0) -> S(1) ;", options).code, ErrorCode::Cancelled);
  double last = -1;
  options.watch = {};
  options.watch.progress = [&](std::string_view, double share) { last = share; };
  options.steps = 5;
  (void)derived(rules("w = S(0); S(i) -> S(i+1) ;"), options);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(Derive, TracesEveryModuleToTheRuleAndStepThatMadeIt) {
  DeriveOptions options;
  options.traced = true;
  const Derivation derivation = derived(rules("w = A(0) L(1); A(0) -> S(1) A(1) ; A(1) -> S(2) ;"), options);
  EXPECT_EQ(toText(derivation.string), "S(1)S(2)L(1)");
  EXPECT_EQ(derivation.origins, (std::vector<Origin>{{0, 1}, {1, 2}, {-1, 0}}));
}

TEST(Derive, AStepCountBeyondTheFixedPointIsKept) {
  DeriveOptions options;
  options.steps = 6;
  const Derivation derivation = derived(rules("w = S(0); S(0) -> S(1) ;"), options);
  EXPECT_EQ(derivation.modulesPerStep, (std::vector<std::size_t>(6, 1)));
  EXPECT_TRUE(derivation.settled);
  EXPECT_FALSE(derive(rules("w = S(0); S(0) -> S(1) ;"), {.steps = -1}));
}

TEST(Seeds, TheFilesOwnSeedAndTheCallersBothCount) {
  std::set<std::string> strings;
  for (const int own : {1, 2, 3})
    for (const std::uint64_t seed : {1u, 2u}) {
      const Parsed parsed = parseLSystem("Lsystem: 1\nseed: " + std::to_string(own) + "\nderivation length: 30\nAxiom: A\nA --> AB\nA --> BA\nendlsystem\n");
      const auto derived = derive(parsed.grammar, {.seed = seed});
      ASSERT_TRUE(derived) << derived.error().message;
      strings.insert(toText(derived->string));
    }
  EXPECT_EQ(strings.size(), 6u);
}

TEST(Seeds, InSimEcoASeedOfTheRulesLeavesTheFirstRuleThatFits) {
  std::set<std::string> chosen;
  for (const int own : {1, 2, 3, 4}) {
    const std::string head = "EcoSystem 1.1 \"e\" { Plant \"p\" { Stem { Stage 1 {} Stage 2 {} } Grow { seed = " + std::to_string(own) + "; w = A(0); ";
    const auto ordered = derive(parseSimeco(head + "A(i) : i < 3 -> S(1) A(i+1) ; A(i) -> S(2) ; } } }").grammar);
    ASSERT_TRUE(ordered) << ordered.error().message;
    EXPECT_EQ(toText(ordered->string), "S(1)S(1)S(1)S(2)");
    const auto drawn = derive(parseSimeco(head + "A(i) : i < 20 -> 1: S(1) A(i+1) | 1: S(2) A(i+1) ; A(i) -> S(2) ; } } }").grammar);
    ASSERT_TRUE(drawn) << drawn.error().message;
    chosen.insert(toText(drawn->string));
  }
  EXPECT_EQ(chosen.size(), 4u);
}

}  // namespace
}  // namespace axil::simeco
