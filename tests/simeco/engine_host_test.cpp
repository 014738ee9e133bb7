// What a host may do between steps: interaction rules on a selection, pruning, communication with an environment; and what every drawn thing
// knows of where it comes from.

#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_plant.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <map>

namespace axil::simeco {
namespace {

Grammar lsystem(const std::string& text) {
  const Parsed parsed = parseLSystem(text);
  EXPECT_TRUE(parsed.ok()) << text << "\n" << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}

/// Derives `steps` steps; `act` is called before step `when` + 1.
Result<Derivation> derivedWith(const Grammar& grammar, std::int64_t steps, std::int64_t when, const std::function<Result<void>(HostStep&)>& act) {
  DeriveOptions options;
  options.steps = steps;
  options.host.betweenSteps = [&](HostStep& step) -> Result<void> { return step.step() == when && !step.finished() ? act(step) : Result<void>{}; };
  return derive(grammar, options);
}

Grammar withInteraction(const std::string& rules, const std::vector<std::pair<std::string, std::string>>& interaction) {
  // The section is the RTIL dialect's; here it is put in from a second text's productions.
  Grammar grammar = lsystem(rules);
  std::string text = "Lsystem: 1\nAxiom: I(1)B\n";
  for (const auto& [from, to] : interaction) text += from + " --> " + to + "\n";
  const Grammar more = lsystem(text + "endlsystem\n");
  // Its expressions are appended; ids shift by what is there already.
  const auto shift = static_cast<std::int32_t>(grammar.expressions.size());
  for (Expr expr : more.expressions) {
    if (auto* binary = std::get_if<Binary>(&expr.node)) binary->left.value += shift, binary->right.value += shift;
    grammar.expressions.push_back(expr);
  }
  for (Production production : more.plants[0].rules.productions) {
    for (auto* modules : {&production.predecessor, &production.successors[0].modules})
      for (Module& module : *modules)
        for (ExprId& id : module.arguments) id.value += shift;
    grammar.plants[0].rules.interaction.push_back(production);
  }
  return grammar;
}

const std::string kStem = "Lsystem: 1\nderivation length: 2\nAxiom: I(1)I(2)[I(3)]I(4)\nB I(x) --> I(x) B\nendlsystem\n";

TEST(Interaction, ARuleActsOnTheSelectionAloneAndTheDerivationGoesOn) {
  // A bug is put before a selected internode; later steps let it climb (RTIL-system 2010).
  const Grammar grammar = withInteraction(kStem, {{"I(x)", "BI(x)"}, {"I(x)", "I(x*10)"}});
  const auto bug = derivedWith(grammar, 2, 1, [](HostStep& step) -> Result<void> {
    const std::size_t selected[] = {0};
    const auto fired = step.interact(selected);
    EXPECT_TRUE(fired && *fired == 1);
    return {};
  });
  ASSERT_TRUE(bug) << bug.error().message;
  EXPECT_EQ(toText(bug->string), "I(1)BI(2)[I(3)]I(4)");
  const auto second = derivedWith(grammar, 1, 0, [](HostStep& step) -> Result<void> {
    const std::size_t selected[] = {1, 3};  // 3 is I(3) behind its bracket
    const auto fired = step.interact(selected, 1);
    EXPECT_TRUE(fired && *fired == 2);
    return {};
  });
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(toText(second->string), "I(1)I(20)[I(30)]I(4)");
}

TEST(Interaction, WithoutItsRulesTheProductionsActOnTheSelection) {
  const auto derived = derivedWith(lsystem("Lsystem: 1\nderivation length: 1\nAxiom: AAA\nA --> B[A]\nB --> C\nendlsystem\n"), 1, 0, [](HostStep& step) -> Result<void> {
    const std::size_t selected[] = {1};
    EXPECT_TRUE(step.interact(selected));
    EXPECT_EQ(toText(step.string()), "AB[A]A");
    return {};
  });
  ASSERT_TRUE(derived) << derived.error().message;
  EXPECT_EQ(toText(derived->string), "B[A]C[B[A]]B[A]");
}

TEST(Interaction, WhatIsNotThereCannotBeSelected) {
  for (const auto& [module, rule] : {std::pair{std::size_t{99}, std::size_t{0}}, {std::size_t{0}, std::size_t{9}}}) {
    const auto derived = derivedWith(lsystem(kStem), 1, 0, [module = module, rule = rule](HostStep& step) -> Result<void> {
      const std::size_t selected[] = {module};
      const auto fired = step.interact(selected, rule);
      if (!fired) return fired.failure();
      return {};
    });
    ASSERT_FALSE(derived);
    EXPECT_EQ(derived.error().code, ErrorCode::BadInput) << derived.error().message;
  }
}

TEST(Interaction, PruningTakesWhatStandsOnTheSelectionAndLeavesBranchesBeforeIt) {
  const auto pruned = derivedWith(lsystem("Lsystem: 1\nderivation length: 1\nAxiom: A[C[D]E]BF[G]H\nX --> X\nH --> K\nendlsystem\n"), 1, 0, [](HostStep& step) -> Result<void> {
    const std::size_t selected[] = {3, 9};  // [ of D inside C, and B
    return step.prune(selected);
  });
  ASSERT_TRUE(pruned) << pruned.error().message;
  EXPECT_EQ(toText(pruned->string), "A[C]B");
}

/// Where each module of the string ends that is drawn as a segment.
class SegmentEnds : public TurtleSink {
 public:
  explicit SegmentEnds(const Image& image) : image_(image) {}
  void segment(const TurtleSegment& s) override { ends[image_.source[s.module]] = s.end; }
  std::map<std::size_t, glm::dvec3> ends;

 private:
  const Image& image_;
};

TEST(Host, ComLetsInternodesGrowAsLongAsTheyAreOutsideASphere) {
  // RTIL-system 2010, figure 5: com asks the environment whether the internode at hand is inside; calls come in the string's order, so the
  // host answers them from the places that it saw before the step.
  const Grammar grammar = lsystem(
      "Lsystem: 1\nderivation length: 20\nAxiom: [I(1)][+(90)I(1)]\nI(i) : {x=0; com(x);} (x==1) --> I(i+0.5)\nhomomorphism\nI(i) --> F(i)\nendlsystem\n");
  const glm::dvec3 centre{0, 5, 0};
  constexpr double radius = 2;
  std::vector<bool> outside;
  std::size_t calls = 0;
  DeriveOptions options;
  options.host.betweenSteps = [&](HostStep& step) -> Result<void> {
    const auto image = step.image();
    if (!image) return image.failure();
    SegmentEnds places(*image);
    const auto drawn = interpret(image->string, {}, places);
    if (!drawn) return drawn.failure();
    outside.clear();
    for (const auto& [module, end] : places.ends) outside.push_back(glm::distance(end, centre) > radius);
    EXPECT_EQ(calls, step.step() == 0 ? 0u : 2u);
    calls = 0;
    return {};
  };
  options.host.exchange = [&](std::span<double> variables) -> Result<void> {
    variables[0] = outside.at(calls++) ? 1 : 0;
    return {};
  };
  const auto derived = derive(grammar, options);
  ASSERT_TRUE(derived) << derived.error().message;
  EXPECT_EQ(toText(derived->string), "[I(3)][+(90)I(11)]");
}

TEST(Host, WhatFuncAndComFailWithEndsTheDerivation) {
  const Grammar grammar = lsystem("Lsystem: 1\nStart: { g=1; }\nderivation length: 2\nAxiom: A\nA : {com(g);} g<3 --> A(func(7,g))\nendlsystem\n");
  DeriveOptions options;
  options.host.exchange = [](std::span<double> variables) -> Result<void> {
    ++variables[0];
    return {};
  };
  options.host.function = [](std::int64_t, std::span<const double>) -> Result<double> { return fail(ErrorCode::NoAnswer, "the soil is unknown here"); };
  const auto failed = derive(grammar, options);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("the soil is unknown here"), std::string::npos) << failed.error().message;
  options.host.function = [](std::int64_t id, std::span<const double> x) -> Result<double> { return static_cast<double>(id) * x[0]; };
  const auto derived = derive(grammar, options);
  ASSERT_TRUE(derived) << derived.error().message;
  EXPECT_EQ(toText(derived->string), "A(14)");
  EXPECT_EQ(derived->variables.at("g"), 2);  // what com wrote into a global stays
}

TEST(Environment, ItAnswersEveryCommunicationModuleBeforeTheRulesRun) {
  DeriveLSystemOptions options;
  options.derive.steps = 2;
  std::vector<std::string> seen;
  options.environment = [&](const Communication& c) -> Result<void> {
    for (const Message& m : c.messages) {
      seen.push_back(std::to_string(c.step) + ":" + std::to_string(m.module) + ":" + std::to_string(static_cast<int>(m.frame.position.y)) + ":" +
                     (m.following ? std::string(m.following->letter) : "-") + ":" + std::to_string(static_cast<int>(m.parameters[0])));
      m.parameters[0] = 10 * m.frame.position.y + static_cast<double>(c.step);
    }
    return {};
  };
  const auto derived = deriveLSystem(lsystem("Lsystem: 1\nderivation length: 2\nAxiom: F?E(0)A\nA > * --> A\n?E(x)A : x>5 --> F?E(x)A\nE(x) : x>0 --> E(x)\nendlsystem\n"), options);
  ASSERT_TRUE(derived) << derived.error().message;
  EXPECT_EQ(seen, (std::vector<std::string>{"0:2:1:A:0", "1:3:2:A:10"}));
  EXPECT_EQ(toText(derived->string), "FFF?E(21)A");
}

TEST(Environment, LightReachesTheTopAndLessOfItWhatIsShaded) {
  DeriveLSystemOptions options;
  options.derive.steps = 1;
  options.environment = lightProgram();
  // A large leaf high up; below it one place in its shade and one beside it. The reply is read by the rule that copies it.
  const auto derived = deriveLSystem(
      lsystem("Lsystem: 1\nderivation length: 1\nAxiom: [f(10){F(4)+(90)F(4)+(90)F(4)+(90)F(4)}?E(0)][+(90)f(2)?E(0)][-(90)f(40)?E(0)]\nX --> X\nendlsystem\n"), options);
  ASSERT_TRUE(derived) << derived.error().message;
  std::vector<double> light;
  for (const ModuleView module : derived->string)
    if (module.letter == "E") light.push_back(module.parameters[0]);
  ASSERT_EQ(light.size(), 3u);
  EXPECT_GT(light[0], 0.9);
  EXPECT_LT(light[1], light[0]);
  EXPECT_GT(light[2], light[1]);
  EXPECT_FALSE(deriveLSystem(lsystem("Lsystem: 1\nderivation length: 1\nAxiom: F?E(0)\nX --> X\nendlsystem\n"), {.environment = lightProgram({0, 0, 0})}));
}

TEST(Trace, EveryDrawnThingLeadsToItsRuleAndItsPlaceInTheText) {
  const std::string text = "Lsystem: 1\nderivation length: 2\nAxiom: AF\nA --> FA\ndecomposition\nA --> [+B]A\nB --> {.f.f.}\nhomomorphism\nF --> ;G\nendlsystem\n";
  const Grammar grammar = lsystem(text);
  const auto plant = plantOfLSystem(grammar);
  ASSERT_TRUE(plant) << plant.error().message;
  ASSERT_FALSE(plant->organs.empty());
  int axiom = 0, production = 0;
  for (const Organ& organ : plant->organs) {
    EXPECT_GE(organ.module, 0);
    const RuleInfo* rule = plant->rules.find(organ.production);
    axiom += rule == nullptr ? 1 : 0;
    if (rule == nullptr) continue;
    ++production;
    EXPECT_EQ(rule->kind, RuleKind::Production);
    EXPECT_EQ(rule->name, "A --> FA (line 4)");
    EXPECT_EQ(text.substr(rule->where.begin, 1), "A");
  }
  EXPECT_EQ(axiom, 1);
  EXPECT_EQ(production, 2);

  DeriveOptions options;
  options.traced = true;
  const auto derived = derive(grammar, options);
  ASSERT_TRUE(derived);
  std::size_t at = 0;
  for (const ModuleView module : derived->string) {
    const Origin origin = derived->origins[at++];
    const RuleInfo* rule = derived->rules.find(origin.production);
    if (module.letter == "+" || module.letter == "[") {
      ASSERT_NE(rule, nullptr);
      EXPECT_EQ(rule->kind, RuleKind::Decomposition);
      EXPECT_TRUE(rule->name.starts_with("A --> [+B]A")) << rule->name;
    }
  }
  const auto image = imageOf(*derived);
  ASSERT_TRUE(image);
  ASSERT_EQ(image->drawnBy.size(), image->string.size());
  for (std::size_t i = 0; i < image->drawnBy.size(); ++i) {
    const std::string letter = image->string.symbols()[image->string.codes()[i]].letter;
    const RuleInfo* rule = derived->rules.find(image->drawnBy[i]);
    EXPECT_EQ(rule != nullptr && rule->kind == RuleKind::Homomorphism, letter == "G" || letter == ";") << letter;
  }
}

}  // namespace
}  // namespace axil::simeco
