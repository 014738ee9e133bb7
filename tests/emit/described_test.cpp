// Plants from words alone, and the small grammars of inflorescences.
#include "emit/arrangement.hpp"
#include "emit/described.hpp"
#include "emit/inflorescence.hpp"
#include "keywords/keywords.hpp"
#include "simeco/simeco.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::emit {
namespace {

using simeco::OrganKind;

simeco::Plant grown(const Result<simeco::Grammar>& grammar) {
  EXPECT_TRUE(grammar) << (grammar ? "" : grammar.error().message + (grammar.error().details.empty() ? "" : "\n" + grammar.error().details.front()));
  if (!grammar) return {};
  const auto growth = simeco::prepareGrowth(*grammar, {});
  EXPECT_TRUE(growth) << (growth ? "" : growth.error().message);
  if (!growth) return {};
  auto plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  EXPECT_TRUE(plant);
  return plant ? *plant : simeco::Plant{};
}

std::vector<simeco::Organ> organsOf(const simeco::Plant& plant, OrganKind kind) {
  std::vector<simeco::Organ> organs;
  std::copy_if(plant.organs.begin(), plant.organs.end(), std::back_inserter(organs), [&](const simeco::Organ& o) { return o.kind == kind; });
  return organs;
}

Result<simeco::Grammar> described(const std::string& text) {
  const auto traits = keywords::readTraits(text);
  if (!traits) return traits.failure();
  return describedGrammar(*traits);
}

std::string textOf(const std::string& description) {
  const auto grammar = described(description);
  EXPECT_TRUE(grammar) << (grammar ? "" : grammar.error().message);
  return grammar ? simeco::print(*grammar) : "";
}

TEST(Inflorescences, EachIsAGrammarThatGrowsIntoItsFlowers) {
  for (const std::string& name : inflorescenceNames()) {
    SCOPED_TRACE(name);
    InflorescencePlan plan;
    plan.type = *inflorescenceNamed(name);
    plan.flowers = plan.type == InflorescenceType::Solitary ? 1 : 15;
    const auto grammar = inflorescenceGrammar(plan);
    ASSERT_TRUE(grammar);
    EXPECT_TRUE(simeco::check(*grammar).empty()) << simeco::check(*grammar).front().message;
    const std::size_t flowers = organsOf(grown(grammar), OrganKind::Flower).size();
    if (plan.type == InflorescenceType::Solitary) EXPECT_EQ(flowers, 1u);
    else EXPECT_TRUE(flowers >= 8 && flowers <= 60) << flowers;
  }
  EXPECT_FALSE(inflorescenceNamed("bouquet"));
}

TEST(Inflorescences, HaveTheFormsThatTheirNamesMean) {
  const auto flowersOf = [](InflorescenceType type) {
    InflorescencePlan plan;
    plan.type = type;
    plan.flowers = 18;
    return organsOf(grown(inflorescenceGrammar(plan)), OrganKind::Flower);
  };
  const auto spread = [](const std::vector<simeco::Organ>& flowers) {
    double low = 1e9, high = -1e9, out = 0;
    for (const simeco::Organ& f : flowers) {
      low = std::min(low, f.base.at.y);
      high = std::max(high, f.base.at.y);
      out = std::max(out, std::hypot(f.base.at.x, f.base.at.z));
    }
    return std::pair{high - low, out};
  };
  const auto [racemeHeight, racemeRadius] = spread(flowersOf(InflorescenceType::Raceme));
  EXPECT_GT(racemeHeight, 3 * racemeRadius) << "a raceme is long";
  const auto [corymbHeight, corymbRadius] = spread(flowersOf(InflorescenceType::Corymb));
  EXPECT_LT(corymbHeight, 0.6 * corymbRadius) << "a corymb is flat";
  // The rays of an umbel leave one point: flowers stand at one distance from it.
  InflorescencePlan plan;
  plan.type = InflorescenceType::Umbel;
  const simeco::Plant umbel = grown(inflorescenceGrammar(plan));
  const auto rays = organsOf(umbel, OrganKind::Flower);
  ASSERT_GE(rays.size(), 8u);
  const PlantPoint centre = umbel.at(*umbel.at(*rays.front().parent).parent).tip();
  for (const simeco::Organ& flower : rays) EXPECT_NEAR(glm::distance(flower.base.at, centre.at), glm::distance(rays.front().base.at, centre.at), 1e-9);
}

TEST(Arrangement, TheStemShowsTheDivergenceOfTheWord) {
  for (const std::string name : {"distichous", "decussate", "spiral"}) {
    const keywords::ArrangementPreset preset = *keywords::arrangementNamed(name);
    const auto leaves = organsOf(grown(arrangementGrammar(preset)), OrganKind::Leaf);
    ASSERT_GE(leaves.size(), 6u) << name;
    const auto azimuth = [](const simeco::Organ& leaf) { return std::atan2(leaf.direction.unit().z, leaf.direction.unit().x); };
    const double turned = std::remainder(azimuth(leaves[static_cast<std::size_t>(preset.leavesPerNode)]) - azimuth(leaves[0]), 2 * std::numbers::pi);
    // Either way round: which way a positive turn goes is the turtle's business; decussate pairs look the same half a turn on.
    const double wanted = std::remainder(preset.divergence.radians(), 2 * std::numbers::pi);
    EXPECT_NEAR(std::abs(std::cos(turned)), std::abs(std::cos(wanted)), 1e-5) << name;
  }
}

TEST(Described, AnotherWordIsAnotherPlant) {
  const std::string base = "Erect shrub, 1-2 m tall. Leaves opposite, ovate, 4-6 cm long, margin entire. Flowers red, 5-merous, 2 cm in diameter, in terminal racemes.";
  const std::string text = textOf(base);
  EXPECT_NE(text.find("margin entire"), std::string::npos);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"shrub, 1-2 m", "herb, 20-40 cm"}, {"opposite", "alternate"}, {"ovate", "linear"}, {"4-6 cm", "9-11 cm"}, {"entire", "serrate"}, {"red", "white"}, {"5-merous", "4-merous"}, {"racemes", "umbels"}}) {
    std::string other = base;
    other.replace(other.find(from), from.size(), to);
    EXPECT_NE(textOf(other), text) << to;
  }
}

TEST(Described, APlantHasTheLeavesAndTheHeightOfTheText) {
  const simeco::Plant plant = grown(described("Erect herb, 40 cm tall, unbranched. Leaves opposite, lanceolate, 5 cm long, sessile. Flowers solitary, terminal, yellow."));
  const auto leaves = organsOf(plant, OrganKind::Leaf);
  ASSERT_GE(leaves.size(), 10u);
  for (const simeco::Organ& leaf : leaves) EXPECT_NEAR(leaf.length, 0.05, 0.006);
  double top = 0;
  for (const simeco::Organ& o : organsOf(plant, OrganKind::Stem)) top = std::max(top, o.tip().at.y);
  EXPECT_NEAR(top, 0.40, 0.12);
}

TEST(Described, WordsThatSayNothingOfAPlantGiveNoPlant) {
  const auto nothing = describedGrammar({});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::NoAnswer);
}

TEST(Described, EveryCommentNamesItsEvidence) {
  const std::string text = textOf("Shrub, 1-2 m tall. Leaves decussate, ovate, 4-6 cm long.");
  for (const char* word : {"shrub", "1-2 m", "decussate", "4-6 cm"}) EXPECT_NE(text.find(std::string("// ")), std::string::npos) << word;
  EXPECT_NE(text.find("No flowers"), std::string::npos);
}

}  // namespace
}  // namespace axil::emit
