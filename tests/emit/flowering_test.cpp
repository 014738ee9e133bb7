// The flowers of a description on a measured plant: on what is still to grow, and nowhere else.
#include "emit/flowering.hpp"

#include "emit/predictive.hpp"
#include "emit/structured.hpp"
#include "grown.hpp"
#include "keywords/keywords.hpp"
#include <cmath>

namespace axil::emit {
namespace {

using simeco::OrganKind;

quantify::Measurements measured() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= 8; ++i) points.push_back({0.002 * (i % 3), 0.1 * i, 0.003 * (i % 2)});
  skeleton3d::Skeleton plant = test::chainThrough(points);
  for (int i = 1; i <= 8; ++i) {
    const PlantDirection out = PlantDirection::along({std::cos(2.4 * i), 0.5, std::sin(2.4 * i)});
    plant.leaves.push_back({skeleton3d::StemId{1}, {points[static_cast<std::size_t>(i)]}, out, perpendicularTo(out, PlantDirection::up()), 0.1, 0.05, "ovate"});
  }
  return valueOf(quantify::measure(plant));
}

keywords::Traits traitsOf(const char* text) { return valueOf(keywords::readTraits(text)); }

std::vector<simeco::Organ> organsOf(const simeco::Plant& plant, OrganKind kind) {
  std::vector<simeco::Organ> organs;
  std::copy_if(plant.organs.begin(), plant.organs.end(), std::back_inserter(organs), [&](const simeco::Organ& o) { return o.kind == kind; });
  return organs;
}

constexpr const char* kUmbels = "Leaves opposite. Inflorescences terminal umbels of 10 flowers; petals 5, red; flowers 2 cm across.";

simeco::Grammar withText(const simeco::Grammar& grammar, const quantify::Measurements& m, const char* text, double metresPerUnit = 1) {
  const simeco::Grammar result = valueOf(withFlowers(grammar, traitsOf(text), floweringScaleOf(m, metresPerUnit)));
  for (const auto& trouble : simeco::check(result)) ADD_FAILURE() << trouble.message;
  EXPECT_EQ(simeco::print(simeco::parseSimeco(simeco::print(result)).grammar), simeco::print(result));
  return result;
}

TEST(Flowering, StandsOnThePredictedAxesAndLeavesTheMeasuredPlantAsItIs) {
  const auto m = measured();
  const simeco::Grammar bare = valueOf(predictiveGrammar(m, {}, {.stages = 2}));
  const simeco::Grammar flowering = withText(bare, m, kUmbels);
  const simeco::Plant plant = grownUp(flowering);
  const auto flowers = organsOf(plant, OrganKind::Flower);
  ASSERT_GE(flowers.size(), 10u);
  EXPECT_EQ(flowers.size() % 10, 0u) << "umbels of 10";
  const auto before = segmentOrgans(grownUp(bare), m.segments.size());
  const auto after = segmentOrgans(plant, m.segments.size());
  for (std::size_t s = 0; s < before.size(); ++s) {
    ASSERT_TRUE(before[s] != nullptr && after[s] != nullptr);
    EXPECT_EQ(before[s]->base, after[s]->base);
    EXPECT_EQ(before[s]->length, after[s]->length);
  }
}

TEST(Flowering, StandsInPlantsOfTheStructuredKindToo) {
  const auto m = measured();
  EXPECT_TRUE(organsOf(grownUp(valueOf(structuredGrammar(m))), OrganKind::Flower).empty());
  EXPECT_FALSE(organsOf(grownUp(withText(valueOf(structuredGrammar(m)), m, kUmbels)), OrganKind::Flower).empty());
}

TEST(Flowering, IsOfTheSizeThatTheTextSaysInAnyUnit) {
  const auto m = measured();
  const simeco::Grammar bare = valueOf(predictiveGrammar(m));
  const auto inMetres = organsOf(grownUp(withText(bare, m, kUmbels)), OrganKind::Flower);
  const auto inMillimetres = organsOf(grownUp(withText(bare, m, kUmbels, 0.001)), OrganKind::Flower);
  ASSERT_FALSE(inMetres.empty());
  ASSERT_EQ(inMetres.size(), inMillimetres.size());
  EXPECT_NEAR(inMillimetres.front().length, 1000 * inMetres.front().length, 1e-3 * inMillimetres.front().length);
  EXPECT_NEAR(inMetres.front().length, 0.01, 0.003);
}

TEST(Flowering, LeavesAGrammarAloneWhoseTextNamesNoFlowers) {
  const auto m = measured();
  const simeco::Grammar bare = valueOf(predictiveGrammar(m));
  EXPECT_TRUE(withText(bare, m, "Leaves opposite, ovate.") == bare);
}

TEST(Flowering, SetsFruitWhenTheFlowersAreOver) {
  const auto m = measured();
  const simeco::Plant plant = grownUp(withText(valueOf(predictiveGrammar(m)), m, "Flowers solitary, terminal, 1 cm across, petals 5, red. Fruit a berry 8 mm across."));
  EXPECT_FALSE(organsOf(plant, OrganKind::Fruit).empty());
  EXPECT_TRUE(organsOf(plant, OrganKind::Flower).empty());
}

}  // namespace
}  // namespace axil::emit
