// Draws belong to (seed, step, who the module is): what is added elsewhere shifts nobody's.

#include "simeco/derive.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::simeco {
namespace {

Grammar lsystem(const std::string& text) {
  const Parsed parsed = parseLSystem(text);
  EXPECT_TRUE(parsed.ok()) << text << "\n" << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}
Grammar simeco(const std::string& text) {
  const Parsed parsed = parseSimeco(text);
  EXPECT_TRUE(parsed.ok()) << text << "\n" << (parsed.diagnostics.empty() ? "" : parsed.diagnostics.front().message);
  return parsed.grammar;
}

std::string derived(const Grammar& grammar, std::int64_t steps, std::uint64_t seed, int threads = 1) {
  DeriveOptions options;
  options.steps = steps;
  options.seed = seed;
  options.threads = threads;
  const auto derivation = derive(grammar, options);
  return derivation ? toText(derivation->string) : derivation.error().message;
}
/// The part of a text behind a letter that stands in it once.
std::string behind(const std::string& text, char mark) {
  const auto at = text.find(mark);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? "" : text.substr(at);
}

/// Ways to draw: by weight, in parameters, in conditions, in decomposition; with and without what runs the general way.
constexpr const char* kDrawing[] = {
    "F --> F[+F]F : 0.4\nF --> F[-F] : 0.6\n",
    "F --> FA(ran(1))\nA(x) --> A(x+ran(x))[F]\n",
    "F : ran(1)<0.5 --> FF\nF --> F[+F]\n",
    "F --> {DF}\ndecomposition\nmaximum depth: 3\nD --> B(ran(2))\nB(x) : ran(2)<x --> B(x)F\n",
    "F : {y=ran(3);} * --> F[C(y)]F : 0.3\nF --> F : 0.7\n",
};

TEST(Identity, AnAddedRuleThatMakesModulesOnTheLeftLeavesAllOthersAsTheyWere) {
  for (const char* rules : kDrawing) {
    const std::string text = rules;
    const auto decomposition = text.find("decomposition");
    const std::string productions = text.substr(0, decomposition), rest = decomposition == std::string::npos ? "" : text.substr(decomposition);
    const std::string head = "Lsystem: 1\nseed: 3\nderivation length: 1\nAxiom: L|F[F]F\n";
    const Grammar plain = lsystem(head + productions + rest + "endlsystem\n");
    const Grammar more = lsystem(head + productions + "L --> LLXX\nX --> X[L]X : 0.5\nX --> X : 0.5\n" + rest + "endlsystem\n");
    for (const std::uint64_t seed : {1u, 2u, 77u})
      for (const int threads : {1, 3}) {
        const std::string before = derived(plain, 5, seed, threads), after = derived(more, 5, seed, threads);
        ASSERT_LT(before.size(), after.size()) << rules;
        EXPECT_EQ(behind(after, '|'), behind(before, '|')) << "seed " << seed << "\n" << rules;
      }
    EXPECT_NE(derived(plain, 5, 1), derived(plain, 5, 2)) << rules;
  }
}

TEST(Identity, ATurnPutIntoASuccessorShiftsNobody) {
  const std::string head = "Lsystem: 1\nseed: 3\nderivation length: 6\nAxiom: F\n";
  const std::string before = derived(lsystem(head + "F --> F[F]F : 1\nF --> F : 1\nendlsystem\n"), 6, 9);
  std::string after = derived(lsystem(head + "F --> /F[+F]-F : 1\nF --> F : 1\nendlsystem\n"), 6, 9);
  std::erase_if(after, [](char c) { return c == '+' || c == '-' || c == '/'; });
  EXPECT_EQ(after, before);
}

TEST(Identity, TwinsOfOneParentDrawDifferently) {
  const Grammar grammar = lsystem("Lsystem: 1\nseed: 1\nderivation length: 1\nAxiom: A\nA --> AA\nendlsystem\n");
  const Grammar drawing = lsystem("Lsystem: 1\nderivation length: 1\nAxiom: A\nA --> AA\nA : 0 --> B\nhomomorphism\nA --> N(ran(1))\nendlsystem\n");
  DeriveOptions options;
  options.steps = 10;
  const auto derivation = derive(drawing, options);
  ASSERT_TRUE(derivation) << derivation.error().message;
  const auto image = imageOf(*derivation);
  ASSERT_TRUE(image) << image.error().message;
  std::vector<double> numbers(image->string.parameters().begin(), image->string.parameters().end());
  ASSERT_EQ(numbers.size(), 1024u);
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
  // Looking twice shows the same picture.
  EXPECT_EQ(toText(imageOf(*derivation)->string), toText(image->string));
  (void)grammar;
}

TEST(Identity, TimeSlicesAndThreadsChangeNothing) {
  for (const char* rules : kDrawing) {
    const Grammar grammar = lsystem("Lsystem: 1\nseed: 3\nderivation length: 1\nAxiom: F[F]F\n" + std::string(rules) + "endlsystem\n");
    const std::string once = derived(grammar, 7, 4);
    for (const int threads : {2, 5}) EXPECT_EQ(derived(grammar, 7, 4, threads), once);
    DeriveOptions options;
    options.steps = 7;
    options.seed = 4;
    options.traced = true;
    EXPECT_EQ(toText(derive(grammar, options)->string), once) << "traced\n" << rules;
  }
}

TEST(Identity, OnlyGrammarsThatDrawCarryIdentities) {
  EXPECT_TRUE(derive(lsystem("Lsystem: 1\nderivation length: 3\nAxiom: A\nA --> AA\nendlsystem\n"))->string.identities().empty());
  EXPECT_TRUE(derive(lsystem("Lsystem: 1\nseed: 2\nderivation length: 3\nAxiom: A\nA --> AA : 1\nA --> A : 1\nendlsystem\n"))->string.identities().empty());
  EXPECT_FALSE(derive(lsystem("Lsystem: 1\nderivation length: 3\nAxiom: A\nA --> AA\nhomomorphism\nA --> B(ran(2))\nendlsystem\n"))->string.identities().empty());
}

std::string ecosystem(const std::string& rules) {
  return "EcoSystem 1.1 \"e\" {\n Plant \"p\" {\n  Stem {\n   Stage 1 { GrowRate = random(0.1, 0.2); GrowTime = 1; }\n   Stage 2 { GrowRate = 0.3; }\n  }\n"
         "  Leaf { Stage 1 { GrowRate = normal(0.1, 0.01); } }\n  Grow {\n   w = [S(9)] S(2) S(8);\n" +
         rules + "  }\n }\n}\n";
}

TEST(Identity, DrawnOrgansStayAsTheyAreWhenARuleIsAddedElsewhere) {
  const std::string rules = "   S(8) -> S(1) [rotr(random(0.2, 0.9)) L(1)] S(8) ;\n";
  GrowOptions options;
  options.steps = 5;
  const auto before = prepareGrowth(simeco(ecosystem(rules)), options), after = prepareGrowth(simeco(ecosystem(rules + "   S(9) -> S(1) S(9) ;\n")), options);
  ASSERT_TRUE(before && after);
  const auto organsOf = [](const Growth& growth) {
    std::vector<std::string> lines;
    const auto plant = plantAt(growth, 7);
    for (const Organ& organ : plant->organs)
      lines.push_back(std::string(letterOf(organ.kind)) + " " + std::to_string(organ.length) + " " + std::to_string(organ.direction.unit().x) + " " + std::to_string(organ.production));
    return lines;
  };
  std::vector<std::string> all = organsOf(*after);
  // The added rule's organs are those of production 1; the others are the plant as it was.
  std::erase_if(all, [](const std::string& line) { return line.ends_with(" 1"); });
  EXPECT_EQ(all, organsOf(*before));
  EXPECT_GT(organsOf(*after).size(), all.size());
}

}  // namespace
}  // namespace axil::simeco
