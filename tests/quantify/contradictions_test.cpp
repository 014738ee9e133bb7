// Simulated plants with known leaves against descriptions that fit them and that do not.
#include "quantify/contradictions.hpp"

#include "keywords/keywords.hpp"
#include "quantify/leaves.hpp"
#include "quantify/measure.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

namespace axil::quantify {
namespace {

// A post 1 m high with leaves at eight nodes, 6 cm long, 50 degrees from the stem.
Measurements plantWith(const char* arrangement) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.4, 0}, {0, 1, 0}};
  LeafArrangement wanted;
  wanted.stem = skeleton3d::StemId{1};
  wanted.arrangement = arrangement;
  wanted.nodes = 8;
  wanted.length = 0.06;
  wanted.angle = 50_deg;
  const auto skeleton = withLeaves(test::chainThrough(points), std::span(&wanted, 1));
  EXPECT_TRUE(skeleton) << skeleton.error().message;
  const auto measured = measure(*skeleton);
  EXPECT_TRUE(measured) << measured.error().message;
  return *measured;
}

std::vector<std::string> linesFor(const char* arrangement, std::string_view text) {
  const auto traits = keywords::readTraits(text);
  EXPECT_TRUE(traits);
  std::vector<std::string> lines;
  for (const PhotoContradiction& c : contradictionsWith(*traits, plantWith(arrangement))) {
    EXPECT_EQ(text.substr(c.start, c.end - c.start), c.words);
    lines.push_back(c.line());
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(PhotoContradictions, AreNoneWhereTextAndPlantAgree) {
  EXPECT_EQ(linesFor("spiral", "Leaves alternate, spirally arranged, 5-8 cm long, at an angle of 45-60 degrees."), Lines{});
  EXPECT_EQ(linesFor("decussate", "Leaves opposite, decussate, 4-6 cm long."), Lines{});
  EXPECT_EQ(linesFor("distichous", "Leaves distichous."), Lines{});
  EXPECT_EQ(linesFor("whorled 4", "Leaves whorled."), Lines{});
  EXPECT_EQ(linesFor("spiral", "Leaves opposite or alternate."), Lines{}) << "one of the alternatives fits";
  EXPECT_EQ(linesFor("spiral", "Leaves alternate, rarely opposite."), Lines{});
}

TEST(PhotoContradictions, ShowTheWordsAndTheNumbers) {
  EXPECT_EQ(linesFor("spiral", "Leaves opposite, ovate."), (Lines{"text: \"opposite\"; measured nodes carry one leaf, divergence 138 ± 0 degrees"}));
  EXPECT_EQ(linesFor("decussate", "Leaves alternate."), (Lines{"text: \"alternate\"; measured nodes carry two leaves, divergence 90 ± 0 degrees"}));
  EXPECT_EQ(linesFor("spiral", "Leaves distichous."), (Lines{"text: \"distichous\"; measured nodes carry one leaf, divergence 138 ± 0 degrees"}));
}

TEST(PhotoContradictions, CompareLengthsAndAngles) {
  EXPECT_EQ(linesFor("spiral", "Leaves 10-15 cm long."), (Lines{"text: \"10-15 cm long\"; measured leaf length 6 ± 0 cm"}));
  EXPECT_EQ(linesFor("spiral", "Leaves (5-)10-15 cm long."), Lines{}) << "exceptions are allowed";
  EXPECT_EQ(linesFor("spiral", "Leaves spreading at 80-90 degrees."), (Lines{"text: \"80-90 degrees\"; measured angle of the leaves to their stem 50 ± 0 degrees"}));
}

TEST(PhotoContradictions, NeedEnoughLeaves) {
  const auto traits = keywords::readTraits("Leaves opposite, 10-15 cm long.");
  ASSERT_TRUE(traits);
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 1, 0}};
  LeafArrangement wanted;
  wanted.stem = skeleton3d::StemId{1};
  wanted.arrangement = "spiral";
  wanted.nodes = 2;
  const auto skeleton = withLeaves(test::chainThrough(points), std::span(&wanted, 1));
  ASSERT_TRUE(skeleton);
  EXPECT_TRUE(contradictionsWith(*traits, *measure(*skeleton)).empty());
}

}  // namespace
}  // namespace axil::quantify
