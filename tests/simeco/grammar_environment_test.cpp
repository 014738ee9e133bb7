// What a grammar's own text says about its surroundings acts as if the host had said it.

#include "simeco/growth.hpp"
#include "simeco/language.hpp"

#include <gtest/gtest.h>

namespace axil::simeco {
namespace {

std::string vine(const std::string& surroundings) {
  return "EcoSystem 1.1 \"e\" {\n" + surroundings +
         "    Plant \"p\" {\n        Stem {\n            Stage 1 {\n                GrowRate = 0.2;\n            }\n        }\n        Grow {\n            w = A(0);\n"
         "            A(i) : i < 8 -> S(1) A(i+1) ;\n        }\n    }\n}\n";
}

Plant grown(const std::string& surroundings, const Environment& environment = {}) {
  const Parsed parsed = parseSimeco(vine(surroundings));
  EXPECT_TRUE(parsed.ok());
  EXPECT_TRUE(check(parsed.grammar).empty());
  GrowOptions options;
  options.environment = environment;
  const auto growth = prepareGrowth(parsed.grammar, options);
  EXPECT_TRUE(growth) << growth.error().message;
  return plantAt(*growth, 20).value();
}

void expectSameOrgans(const Plant& a, const Plant& b) {
  ASSERT_EQ(a.organs.size(), b.organs.size());
  for (std::size_t i = 0; i < a.organs.size(); ++i) EXPECT_EQ(a.organs[i].tip().at, b.organs[i].tip().at) << i;
}

TEST(GrammarEnvironment, AnObstacleOfTheTextActsAsOneOfTheHost) {
  const Plant own = grown("    Obstacle = sphere(0.02, 0.9, 0, 0.2);\n    Obstacle = box(-1, 1.5, -1, 1, 1.6, 1);\n");
  const Plant given = grown("", {.obstacles = {SphereObstacle{{{0.02, 0.9, 0}}, 0.2}, BoxObstacle{{{-1, 1.5, -1}}, {{1, 1.6, 1}}}}});
  expectSameOrgans(own, given);
  double highest = 0;
  for (const Organ& organ : own.organs) highest = std::max(highest, organ.tip().at.y);
  EXPECT_LT(highest, 1.5) << "the box is a roof";
  const Plant free = grown("");
  EXPECT_GT(free.organs.back().tip().at.y, 1.59);
}

TEST(GrammarEnvironment, AnObstacleOfAWrongKindIsRefusedWhereItStands) {
  const std::string text = vine("    Obstacle = vector(1, 2, 3);\n");
  const auto found = check(parseSimeco(text).grammar);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(placeOf(text, found[0].span.begin), (SourcePlace{2, 16}));
  EXPECT_FALSE(prepareGrowth(parseSimeco(vine("    Obstacle = sphere(0, 1, 0, -1);\n")).grammar));
  EXPECT_FALSE(check(parseSimeco("EcoSystem 1.0 \"e\" { Obstacle = sphere(0, 1, 0, 1); }").grammar).empty()) << "1.1 only";
}

}  // namespace
}  // namespace axil::simeco
