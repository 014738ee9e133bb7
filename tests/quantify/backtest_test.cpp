/// Growth sequences of many habits, foretold one stage ahead from the younger plants.

#include "quantify/backtest.hpp"

#include "growth_sequences.hpp"
#include "quantify/fates.hpp"
#include "quantify/layers.hpp"

#include <algorithm>
#include <cstdio>

namespace axil::quantify {
namespace {

struct Ages {
  std::vector<Measurements> early, late;
};
Ages grownThrough(const Habit& habit, std::uint64_t seed, std::uint64_t plants, int stages = 1) {
  Ages ages;
  for (std::uint64_t p = 0; p < plants; ++p) {
    const Sequence sequence(habit, Rng(seed).split(p));
    // A plant that ended at once has nothing to foretell.
    if (sequence.at(habit.stages - stages).segments.size() < 3) continue;
    ages.early.push_back(sequence.at(habit.stages - stages));
    ages.late.push_back(sequence.at(habit.stages));
  }
  return ages;
}

void print(const char* name, const BacktestSkill& s) {
  std::printf("| %s | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.1f %% (%.1f) | %.1f %% | %.1f %% | %.1f %% of %zu | %.0f %% |\n", name, 100 * s.lengthError, 100 * s.lengthErrorRepeated,
              100 * s.lengthErrorThesis, 100 * s.countError, 100 * s.togetherError, 100 * s.newError, 100 * s.newErrorByChance, 100 * s.newErrorRepeated, 100 * s.newErrorThesis,
              100 * s.lengthCoverage, s.lengths, 100 * s.countCoverage);
}

/// The figures of docs/prediction.md.
TEST(Sequences, EveryHabitIsForetoldOneStageAhead) {
  const std::uint64_t seed = 91;
  std::printf("seed %d, 20 plants each\n", static_cast<int>(seed));
  double held = 0, lengths = 0, heldCounts = 0, counts = 0;
  for (const Habit& habit : knownHabits()) {
    SCOPED_TRACE(habit.name);
    const Ages ages = grownThrough(habit, seed, 20);
    const auto test = backtest(ages.early, ages.late, 1);
    ASSERT_TRUE(test) << test.error().message;
    const BacktestSkill& s = test->skill;
    print(habit.name, s);
    EXPECT_LT(s.lengthError, 0.15);
    EXPECT_LT(s.lengthError, s.lengthErrorRepeated);
    EXPECT_LT(s.countError, 0.1);
    EXPECT_LT(s.togetherError, 0.1);
    // Of a hundred lengths four in a hundred more or less are chance.
    const double chance = 2 * std::sqrt(0.9 * 0.1 / static_cast<double>(s.lengths));
    EXPECT_GT(s.lengthCoverage, 0.85 - chance);
    EXPECT_LT(s.lengthCoverage, 0.95 + chance);
    held += s.lengthCoverage * static_cast<double>(s.lengths);
    lengths += static_cast<double>(s.lengths);
    heldCounts += s.countCoverage * static_cast<double>(test->plants.size());
    counts += static_cast<double>(test->plants.size());
  }
  EXPECT_NEAR(held / lengths, 0.9, 0.03);
  EXPECT_NEAR(heldCounts / counts, 0.9, 0.05);
}

TEST(Sequences, OnePlantIsForetoldToo) {
  const std::uint64_t seed = 92;
  std::printf("seed %d\n", static_cast<int>(seed));
  for (const Habit& habit : knownHabits())
    for (std::uint64_t p = 0; p < 3; ++p) {
      const Ages ages = grownThrough(habit, seed + p, 1);
      if (ages.early.empty()) continue;
      const auto test = backtest(ages.early, ages.late, 1);
      ASSERT_TRUE(test) << habit.name << ": " << test.error().message;
      EXPECT_LT(test->skill.lengthError, 0.3) << habit.name;
    }
}

TEST(Sequences, LengthsThatFollowALawOfGrowthAreForetoldOnSideAxesToo) {
  const std::uint64_t seed = 95;
  std::printf("seed %d\n", static_cast<int>(seed));
  const std::vector<Habit> habits{{.name = "swell and dwindle with age", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return std::exp(-std::pow(stage - 7, 2) / 30.0); }},
                                  {.name = "grow up to a level", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return 1 / (1 + std::exp(5.0 - stage)); }},
                                  {.name = "slow down", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return 1 / (1 + std::exp(stage - 9.0)); }},
                                  {.name = "rise by Mitscherlich's law", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return 1 - 0.9 * std::exp((1 - stage) / 2.5); }},
                                  {.name = "rise by Gompertz' law", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return std::exp(-3 * std::exp((1 - stage) / 3.0)); }},
                                  {.name = "fall to a level", .along = 1, .noise = 0.07, .orders = 2, .byAge = [](int stage) { return 0.25 + 1.2 * std::exp((1 - stage) / 3.0); }},
                                  {.name = "rise to a level along each axis", .along = 1, .noise = 0.07, .orders = 2, .byRank = [](int rank) { return 1 - 0.9 * std::exp(-rank / 2.5); }},
                                  {.name = "slow down along each axis", .along = 1, .noise = 0.07, .orders = 2, .byRank = [](int rank) { return 1 / (1 + std::exp(rank - 6.0)); }}};
  for (const Habit& habit : habits) {
    const Ages ages = grownThrough(habit, seed, 20);
    const auto test = backtest(ages.early, ages.late, 1);
    ASSERT_TRUE(test) << habit.name << ": " << test.error().message;
    const BacktestSkill& skill = test->skill;
    std::printf("%s: length %.1f %% (last again %.1f), intervals hold %.1f %% of %zu\n", habit.name, 100 * skill.lengthError, 100 * skill.lengthErrorRepeated, 100 * skill.lengthCoverage, skill.lengths);
    EXPECT_LT(skill.lengthError, 0.1) << habit.name;
    EXPECT_LT(skill.lengthError, skill.lengthErrorRepeated) << habit.name;
    EXPECT_NEAR(skill.lengthCoverage, 0.9, 0.1) << habit.name;
  }
}

std::vector<NodeFate> fatesBy(const std::function<NodeFate(int, Rng&)>& of, int ranks, int axes, std::uint64_t seed) {
  std::vector<NodeFate> nodes;
  Rng rng(seed);
  for (int a = 0; a < axes; ++a)
    for (int rank = 0; rank < ranks; ++rank) nodes.push_back(of(rank, rng));
  return nodes;
}

TEST(Fates, TheShapeThatMadeThemIsFound) {
  const std::uint64_t seed = 93;
  using Shape = FateTable::Shape;
  const auto share = [](double p) { return [p](int rank, Rng& rng) { return NodeFate{rank, true, rng.uniform() < p ? 1 : 0}; }; };
  const FateTable alike = fateTableOf(fatesBy(share(0.4), 10, 20, seed));
  EXPECT_EQ(alike.shape, Shape::Alike);
  EXPECT_NEAR(alike.branchingAt(3), 0.4, 0.1);
  const FateTable third = fateTableOf(fatesBy([](int rank, Rng&) { return NodeFate{rank, true, rank % 3 == 2 ? 1 : 0}; }, 10, 4, seed));
  EXPECT_EQ(third.shape, Shape::Periodic);
  EXPECT_EQ(third.branchingAt(20), 1);
  EXPECT_EQ(third.branchingAt(21), 0);
  const FateTable module = fateTableOf(fatesBy([](int rank, Rng&) { return NodeFate{rank, rank < 2, rank < 2 ? 0 : 2}; }, 3, 12, seed));
  EXPECT_EQ(module.shape, Shape::FirstRanks);
  EXPECT_EQ(module.branchingAt(0), 0);
  EXPECT_EQ(module.branchingAt(2), 1);
  const FateTable rising = fateTableOf(fatesBy([](int rank, Rng& rng) { return NodeFate{rank, true, rng.uniform() < rank / 12.0 ? 1 : 0}; }, 12, 20, seed));
  EXPECT_EQ(rising.shape, Shape::Rising);
  EXPECT_LT(rising.branchingAt(0), 0.2);
  EXPECT_GT(rising.branchingAt(13), 0.8);
  EXPECT_EQ(fateTableOf({}).at(5), std::vector<double>{1});
}

TEST(Arms, UnequalOnesAreToldApartAndEqualOnesAreNot) {
  const std::vector<Habit> habits = knownHabits();
  const auto named = [&](const char* name) { return *std::find_if(habits.begin(), habits.end(), [name](const Habit& h) { return std::string(h.name) == name; }); };
  const Habit unequal = named("sympodial, unequal arms");
  const auto s = layeredStatistics(grownThrough(unequal, 94, 10).late);
  ASSERT_TRUE(s);
  ASSERT_EQ(s->arms.size(), 1u);
  ASSERT_EQ(s->arms.front().arms.size(), 2u);
  constexpr double kDegree = std::numbers::pi / 180;
  EXPECT_NEAR(s->arms.front().arms[0].insertion.value / kDegree, 35, 1);
  EXPECT_NEAR(s->arms.front().arms[1].insertion.value / kDegree, 57, 1);
  EXPECT_NEAR(s->arms.front().arms[0].lateralRatio.value / 0.85, 1, 0.02);
  EXPECT_NEAR(s->arms.front().arms[1].lateralRatio.value / 0.7, 1, 0.02);
  const auto equal = layeredStatistics(grownThrough(named("Leeuwenberg-like"), 94, 10).late);
  ASSERT_TRUE(equal);
  EXPECT_TRUE(equal->arms.empty());
}

}  // namespace
}  // namespace axil::quantify
