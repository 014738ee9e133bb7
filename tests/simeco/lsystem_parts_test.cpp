// A string drawn by several turtles is the plant that one turtle draws.

#include "base/files.hpp"
#include "base/rng.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_plant.hpp"
#include "simeco/turtle_parts.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace axil::simeco {
namespace {

namespace fs = std::filesystem;

Result<Plant> drawnBy(int threads, const Grammar& grammar, const LSystemView& view) {
  LSystemPlantOptions options;
  options.derive.view = view;
  options.derive.derive.threads = threads;
  options.derive.derive.limits.modules = 300'000;
  options.modulesPerThread = 1;
  return plantOfLSystem(grammar, options);
}

void expectTheSamePlant(const Grammar& grammar, const LSystemView& view, const std::string& name) {
  const auto one = drawnBy(1, grammar, view);
  for (const int threads : {2, 3, 7}) {
    const auto several = drawnBy(threads, grammar, view);
    ASSERT_EQ(one.has_value(), several.has_value()) << name << " with " << threads << " threads";
    if (!one) EXPECT_EQ(one.error().message, several.error().message) << name;
    else EXPECT_TRUE(*one == *several) << name << " with " << threads << " threads";
  }
}

TEST(LSystemParts, EveryModelIsDrawnTheSameByAnyNumberOfThreads) {
  std::vector<fs::path> folders{fs::path(AXIL_TEST_DIR) / "../../samples/classic", fs::path(AXIL_TEST_DIR) / "lsystem"};
  for (const char* shared : {"data/lsystems/models", "data/lsystems/turtle"})
    if (fs::exists(test::sharedPath(shared))) folders.push_back(test::sharedPath(shared));
  int models = 0;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".l") continue;
      const Parsed parsed = parseLSystem(readFile(entry.path()).value(), {.include = includesBeside(entry.path())});
      const auto view = viewBeside(entry.path());
      if (!parsed.ok() || !view) continue;
      expectTheSamePlant(parsed.grammar, *view, entry.path().filename().string());
      ++models;
    }
  EXPECT_GE(models, 15);
}

/// A row of letters that turtles know, with whole numbers; now and then one that reaches beyond its branch.
std::string randomRow(Rng& rng, int length, int depth) {
  static const std::vector<std::string> calm = {"F",  "F(2)", "f",    "G(3)", "+(90)", "-(30)", "&(20)", "^", "/(45)", "\\(10)", "|", "!(2)", "#",
                                                ";(3)", ",",  "@v", "~l(2)", "@O(2)", "@c(1)", "@Di(2)", "@M(1,2,3)", "@R(1,2,3)", "A(1)", "B", "FF", "@!(5)", "[F]"};
  static const std::vector<std::string> wild = {"@", "~", "?", "?(1,2)", "$", "{(1)", "}", "{", "@Gs", "@Gc(3)", "@Ge(2)", "@Gt(2)", "%", "@b", "@T", "@PS(1)", ".", "@[", "~F"};
  std::string row;
  for (int i = 0; i < length; ++i) {
    const double die = rng.uniform();
    if (die < 0.25 && depth > 0) row += "[" + randomRow(rng, length / 2, depth - 1) + "]";
    else if (die < 0.32 && depth >= 0) row += "{" + randomRow(rng, 3, -1) + "}";
    else if (die < 0.325) row += wild[rng.below(wild.size())];
    else row += calm[rng.below(calm.size())];
  }
  return row;
}

TEST(LSystemParts, RandomStringsAreDrawnTheSameByAnyNumberOfThreads) {
  int drawn = 0;
  std::size_t organs = 0;
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    Rng rng(seed);
    const std::string text = "Lsystem: x\nderivation length: 0\nAxiom: " + randomRow(rng, 24, 4) + "\nX --> X\nhomomorphism\nmaximum depth: 2\nA(x) --> " + randomRow(rng, 6, 1) +
                             "B\nB --> [+F(3)]~l\nendlsystem\n";
    const Parsed parsed = parseLSystem(text);
    if (!parsed.ok()) continue;
    const LSystemView view = parseLSystemView(seed % 3 == 0 ? "line style: cylinder\ntropism: T: 0 -1 0 A: 0 I: 1 E: 0.2 S: 0.1\n" : seed % 3 == 1 ? "interpretation past %: off\n" : "").view;
    expectTheSamePlant(parsed.grammar, view, "seed " + std::to_string(seed));
    // Single precision takes the way that draws the image as a whole.
    LSystemPlantOptions whole;
    whole.derive.view = view;
    whole.derive.derive.limits.modules = 300'000;
    whole.derive.derive.singlePrecision = true;
    whole.derive.derive.traced = true;
    const auto inOne = plantOfLSystem(parsed.grammar, whole), inParts = drawnBy(3, parsed.grammar, view);
    ASSERT_EQ(inOne.has_value(), inParts.has_value()) << "seed " << seed << ": " << (inParts ? std::string() : inParts.error().message) << "\n" << text;
    if (!inOne) continue;
    EXPECT_TRUE(*inOne == *inParts) << "seed " << seed << "\n" << text;
    ++drawn;
    organs += inOne->organs.size();
  }
  EXPECT_GE(drawn, 30);
  EXPECT_GE(organs, 1000u);
}

/// The modules that a stretch covers, as letters.
std::string lettersOf(const ModuleString& string, std::size_t begin, std::size_t end) {
  std::string letters;
  for (std::size_t i = begin; i < end; ++i) letters += string.symbols()[string.codes()[i]].letter;
  return letters;
}

TEST(LSystemParts, APathPassesOverTheBranchesThatAreClosed) {
  const Parsed parsed = parseLSystem("Lsystem: x\nAxiom: A(1)[BC[D]]E(2,3)[F[G]H(4)[I\n\nendlsystem\n");
  ASSERT_TRUE(parsed.ok());
  const auto derived = derive(parsed.grammar, {.steps = 0});
  ASSERT_TRUE(derived) << derived.error().message;
  const auto parts = turtle::partsOf(derived->string, 2);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(lettersOf(derived->string, parts[1].own.begin, parts[1].own.end), "[F[G]H[I");
  ASSERT_EQ(parts[1].path.size(), 2u);
  EXPECT_EQ(lettersOf(derived->string, parts[1].path[0].begin, parts[1].path[0].end), "A");
  EXPECT_EQ(lettersOf(derived->string, parts[1].path[1].begin, parts[1].path[1].end), "E");
  EXPECT_EQ(parts[1].path[1].parameter, 1u);
  EXPECT_EQ(parts[1].own.parameter, 3u);
}

TEST(LSystemParts, AStringThatClosesWhatIsNotOpenIsOnePart) {
  const Parsed parsed = parseLSystem("Lsystem: x\nAxiom: ABAABBAA\nA --> [F]\nB --> ]F[\nendlsystem\n");
  const auto derived = derive(parsed.grammar, {.steps = 1});
  ASSERT_TRUE(derived) << derived.error().message;
  EXPECT_EQ(turtle::partsOf(derived->string, 3).size(), 1u);
}

/// Long enough for whole blocks to be passed over.
TEST(LSystemParts, ALongStringIsDrawnTheSameByAnyNumberOfThreads) {
  const Parsed parsed = parseLSystem(
      "Lsystem: x\nderivation length: 12\nAxiom: A(1,0.2)\nA(l,w) --> !(w)F(l)[&(45)B(l*0.6,w*0.7)]/(137.5)A(l*0.9,w*0.7)\nB(l,w) --> !(w)F(l)L[-(45)@vB(l*0.6,w*0.7)]B(l*0.9,w*0.7)\n"
      "homomorphism\nL --> [&(60){.+(20)f(0.1)-(20)f(0.1)}]\nendlsystem\n");
  ASSERT_TRUE(parsed.ok());
  expectTheSamePlant(parsed.grammar, {}, "long");
}

}  // namespace
}  // namespace axil::simeco
