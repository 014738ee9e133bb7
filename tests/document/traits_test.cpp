#include "document/traits.hpp"

#include "document/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::document {
namespace {

/// The facts after `lines`, each as "organ property value" or "organ property low-high unit".
std::vector<std::string> factsAfter(const std::string& lines) {
  const auto history = replay(Project(), "set_description \"Leaves rarely opposite, ovate, 3-8 cm long.\"\n" + lines);
  EXPECT_TRUE(history) << history.error().message;
  const auto traits = traitsOf(history->project());
  EXPECT_TRUE(traits);
  std::vector<std::string> facts;
  for (const auto& trait : *traits) {
    const std::string range = trait.low ? std::to_string(static_cast<int>(*trait.low)) + "-" + std::to_string(static_cast<int>(*trait.high)) + " " + trait.unit : "";
    facts.push_back((trait.qualifier.empty() ? "" : trait.qualifier + " ") + trait.organ + " " + trait.property + " " + trait.value + range);
  }
  return facts;
}

bool has(const std::vector<std::string>& facts, const std::string& fact) { return std::find(facts.begin(), facts.end(), fact) != facts.end(); }

TEST(Traits, WithoutDecisionsAreWhatTheDescriptionSays) {
  const auto facts = factsAfter("");
  EXPECT_TRUE(has(facts, "rarely leaf arrangement opposite")) << ::testing::PrintToString(facts);
  EXPECT_TRUE(has(facts, "leaf shape ovate"));
  EXPECT_TRUE(has(facts, "leaf length 3-8 cm"));
}

TEST(Traits, AnAcceptedOneIsNoLongerDoubtful) {
  const auto facts = factsAfter("accept_trait leaf arrangement opposite\n");
  EXPECT_TRUE(has(facts, "leaf arrangement opposite")) << ::testing::PrintToString(facts);
}

TEST(Traits, AChangedOneHasTheUsersValueAndARejectedOneIsGone) {
  const auto facts = factsAfter("change_trait leaf shape ovate linear\nreject_trait leaf arrangement opposite\n");
  EXPECT_TRUE(has(facts, "leaf shape linear")) << ::testing::PrintToString(facts);
  EXPECT_FALSE(has(facts, "leaf shape ovate"));
  EXPECT_FALSE(has(facts, "rarely leaf arrangement opposite"));
}

TEST(Traits, AFactOfTheUsersOwnStandsForAllThatIsSaidOfItsProperty) {
  const auto facts = factsAfter("change_trait leaf shape \"\" linear\nchange_trait_range leaf length \"\" 4 5 mm\n");
  EXPECT_TRUE(has(facts, "leaf shape linear")) << ::testing::PrintToString(facts);
  EXPECT_FALSE(has(facts, "leaf shape ovate"));
  EXPECT_TRUE(has(facts, "leaf length 4-5 mm"));
  EXPECT_FALSE(has(facts, "leaf length 3-8 cm"));
}

TEST(Traits, AUsersOwnFactsNeedNoDescription) {
  const auto history = replay(Project(), "change_trait leaf arrangement \"\" opposite\n");
  const auto traits = traitsOf(history->project());
  ASSERT_TRUE(traits);
  ASSERT_EQ(traits->size(), 1u);
  EXPECT_EQ(traits->front().value, "opposite");
}

}  // namespace
}  // namespace axil::document
