#include "drawn_stems.hpp"
#include "skeleton3d/draft.hpp"

#include <gtest/gtest.h>

namespace axil::skeleton3d {
namespace {

using test::drawnPhoto;
using test::DrawnStem;

constexpr int kWidth = 600, kHeight = 800;

DrawnStem stem(std::vector<glm::dvec2> points, double width_px, cv::Scalar colour) { return {std::move(points), width_px, colour}; }

/// A plant of thin stems, by its colour: two of its branches meet in the picture, so that they close round a piece of the background.
std::vector<DrawnStem> plant(cv::Scalar colour) {
  return {stem({{300, 720}, {306, 420}, {298, 120}}, 9, colour), stem({{304, 560}, {420, 470}, {470, 300}}, 5, colour),
          stem({{304, 400}, {220, 330}, {150, 180}}, 4, colour), stem({{470, 300}, {400, 250}, {300, 200}}, 4, colour)};
}

/// The wall behind it and the table, lit unevenly, with the plant's shadow.
Photo photographed(const std::vector<DrawnStem>& stems) {
  std::vector<DrawnStem> all{stem({{0, 720}, {600, 720}}, 320, {226, 226, 222}), stem({{300, 724}, {520, 690}, {560, 640}}, 12, {198, 198, 195})};
  all.insert(all.end(), stems.begin(), stems.end());
  return drawnPhoto({kWidth, kHeight}, {214, 214, 212}, all, 2, 3);
}

struct Agreement {
  double recall = 0, precision = 0;
};

/// Against the drawing itself, without noise, in black on white.
Agreement agreement(const Mask& mask, std::vector<DrawnStem> stems) {
  for (DrawnStem& stem : stems) stem.colour = {0, 0, 0};
  const Photo drawn = drawnPhoto({kWidth, kHeight}, {255, 255, 255}, stems, 0, 1);
  double both = 0, found = 0, there = 0;
  for (std::size_t i = 0; i < mask.plant.size(); ++i) {
    const bool isPlant = drawn.rgb[3 * i] < 128;
    there += isPlant, found += mask.plant[i] != 0, both += isPlant && mask.plant[i] != 0;
  }
  return {both / there, both / found};
}

TEST(Mask, ThinStemsBeforeAPlainBackgroundAreFoundByTheirColourAndShadowsAreNot) {
  for (const cv::Scalar& colour : {cv::Scalar(95, 130, 60), cv::Scalar(96, 78, 62), cv::Scalar(150, 60, 50)}) {
    const auto stems = plant(colour);
    const auto mask = maskByColour(photographed(stems), {{18, 24}, {582, 776}});
    ASSERT_TRUE(mask) << mask.error().message;
    const Agreement with = agreement(*mask, stems);
    std::printf("colour %.0f %.0f %.0f: %.3f of the plant found, %.3f of what is found is the plant's\n", colour[0], colour[1], colour[2], with.recall, with.precision);
    EXPECT_GT(with.recall, 0.95);
    EXPECT_GT(with.precision, 0.9);
  }
}

TEST(Mask, ABoxLeavesOutWhatStandsBesideThePlant) {
  auto stems = plant({95, 130, 60});
  auto withPot = stems;
  withPot.push_back(stem({{30, 300}, {90, 300}}, 200, {60, 80, 160}));
  const auto mask = maskByColour(photographed(withPot), {{120, 60}, {560, 776}});
  ASSERT_TRUE(mask) << mask.error().message;
  EXPECT_GT(agreement(*mask, stems).precision, 0.9);
}

TEST(Mask, WithoutAnythingStrangeThereIsNoPlant) {
  const auto mask = maskByColour(drawnPhoto({kWidth, kHeight}, {214, 214, 212}, {}, 2, 3), {{18, 24}, {582, 776}});
  EXPECT_FALSE(mask);
}

}  // namespace
}  // namespace axil::skeleton3d
