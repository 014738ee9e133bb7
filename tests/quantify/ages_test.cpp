#include "quantify/ages.hpp"

#include "known_growth.hpp"
#include "quantify/layers.hpp"

#include <cmath>
#include <cstdio>

namespace axil::quantify {
namespace {

/// What a plant shows whose leader ends by chance and bears nothing, `stages` after it began.
ShownAge leaderOf(Rng& rng, int stages, double ending) {
  ShownAge plant;
  for (int stage = 0; stage < stages; ++stage) {
    plant.now = stage;
    if (rng.uniform() >= ending) continue;
    // What ended at the newest stage looks as if it still grew.
    plant.kinds[0] = {1, 0, static_cast<double>(stage)};
    return plant;
  }
  plant.kinds[0] = {1, 0, static_cast<double>(stages - 1)};
  return plant;
}

TEST(Ages, SharesOfEndingAreUnbiasedWhereTheLeadingAxisMayEnd) {
  const KnownRules rules{.stages = 14, .branching = 0.5, .ending = 0.15, .leaderEnding = 0.1, .orders = 2, .leaves = 0};
  constexpr int kSets = 10;
  double off = 0, variance = 0;
  for (std::uint64_t seed = 400; seed < 400 + kSets; ++seed) {
    const auto s = layeredStatistics(manyGrownBy(rules, seed, 100));
    ASSERT_TRUE(s);
    const Estimate& share = s->of(Quantity::Ending).order(0)->estimate;
    off += (share.own - rules.leaderEnding) / kSets;
    variance += 0.1 * 0.9 / static_cast<double>(share.samples) / kSets / kSets;
  }
  std::printf("seeds 400 to 409, %d sets of 100 plants: share of endings of the leading axis off by %+.4f on the average, standard error %.4f\n", kSets, off, std::sqrt(variance));
  EXPECT_LT(std::abs(off), 3 * std::sqrt(variance)) << off << " with standard error " << std::sqrt(variance);
}

TEST(Ages, PlantsWhoseLeadersEndedAreAsOldAsTheOldest) {
  std::cout << "seed 410\n";
  Rng rng(410);
  std::vector<ShownAge> plants;
  for (int p = 0; p < 100; ++p) plants.push_back(leaderOf(rng, 12, 0.1));
  for (const double age : agesOf(plants)) EXPECT_EQ(age, 11);
}

TEST(Ages, PlantsThatGrowAreOfTheAgesTheyShow) {
  std::vector<ShownAge> plants;
  for (int p = 0; p < 40; ++p) {
    const double stages = 8 + (3 * p) % 7;
    plants.push_back({stages - 1, {{1, 0, stages - 1}, {3, 2, 4 * stages}}});
  }
  const std::vector<double> ages = agesOf(plants);
  for (std::size_t p = 0; p < plants.size(); ++p) EXPECT_EQ(ages[p], plants[p].now);
}

TEST(Ages, TwoAgesAreToldFromEndings) {
  std::cout << "seed 411\n";
  Rng rng(411);
  std::vector<ShownAge> plants;
  for (int p = 0; p < 200; ++p) plants.push_back(leaderOf(rng, p % 2 == 0 ? 8 : 16, 0.05));
  const std::vector<double> ages = agesOf(plants);
  for (std::size_t p = 0; p < plants.size(); ++p) {
    EXPECT_TRUE(ages[p] == 7 || ages[p] == 15) << ages[p];
    EXPECT_GE(ages[p], plants[p].now);
  }
}

TEST(Ages, FourPlantsTellNothingOfEachOther) {
  const std::vector<ShownAge> plants{{3, {{1, 0, 3}, {}}}, {9, {{1, 0, 9}, {}}}, {9, {{1, 0, 9}, {}}}, {9, {{1, 0, 9}, {}}}};
  EXPECT_EQ(agesOf(plants), (std::vector<double>{3, 9, 9, 9}));
}

}  // namespace
}  // namespace axil::quantify
