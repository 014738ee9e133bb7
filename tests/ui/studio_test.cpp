#include "ui/headless.hpp"

#include "document/lookup.hpp"
#include "document/project.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace axil::ui {
namespace {

const std::filesystem::path kLantana = std::filesystem::path(AXIL_SAMPLES_DIR) / "lantana" / "lantana.axil";

HeadlessStudio opened(const StudioOptions& options = {}) {
  auto headless = HeadlessStudio::open(options, 1200, 800);
  EXPECT_TRUE(headless) << headless.error().message;
  if (auto open = headless->studio().open(kLantana); !open) ADD_FAILURE() << open.error().message;
  headless->studio().state().snap = false;  // clicks are looked for where they were made
  return std::move(*headless);
}

void run(HeadlessStudio& headless, std::string_view lines) {
  if (auto ran = headless.run(lines); !ran) ADD_FAILURE() << ran.error().message;
}

const skeleton3d::ClickedNode& nodeWith(const document::Project& project, int id) {
  return project.nodes[document::nodeWithId(project, document::NodeId(id)).value()].node;
}

std::size_t coloursIn(const render::Image& image, int x, int y, int width, int height) {
  std::set<std::uint32_t> colours;
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) {
      const std::uint8_t* p = &image.rgb[(static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(column)) * 3];
      colours.insert(p[0] | p[1] << 8 | p[2] << 16);
    }
  return colours.size();
}

TEST(Studio, ShowsTheSampleInEveryPane) {
  HeadlessStudio headless = opened();
  const auto picture = headless.picture();
  ASSERT_TRUE(picture) << picture.error().message;
  ASSERT_EQ(picture->width_px, 1200);
  for (const char* pane : {"pane_front", "pane_right", "pane_top", "pane_plant"}) {
    const auto [x, y, width, height] = headless.studio().state().landmarks.at(pane);
    EXPECT_GT(coloursIn(*picture, static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)), 200u) << pane;
  }
}

// The mouse stands on whole pixels of the screen: a click is that exact.
TEST(Studio, AClickLengthensTheSelectedStemAndASecondPhotoPlacesTheNode) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui press stem_4\nui click front 395 300\n");
  const document::Project& project = headless.studio().session().project();
  ASSERT_EQ(project.nodes.size(), 18u);
  const auto stem = project.stems[document::stemWithId(project, document::StemId(4)).value()].stem;
  EXPECT_EQ(stem.nodes.back(), document::NodeId(18));
  EXPECT_NEAR(nodeWith(project, 18).clicks.at("front").px.x, 395, 3.6);
  run(headless, "ui shift_click right 433 305\n");
  EXPECT_NEAR(nodeWith(headless.studio().session().project(), 18).clicks.at("right").px.y, 305, 3.6);
}

TEST(Studio, UndoByKeyGivesBackAnEqualProject) {
  HeadlessStudio headless = opened();
  const document::Project before = headless.studio().session().project();
  run(headless, "ui wait\nui press stem_4\nui click front 395 300\nui key ctrl+z\n");
  EXPECT_EQ(headless.studio().session().project(), before);
  run(headless, "ui key ctrl+shift+z\n");
  EXPECT_EQ(headless.studio().session().project().nodes.size(), 18u);
}

TEST(Studio, DraggingANodeIsOneStep) {
  HeadlessStudio headless = opened();
  const std::size_t steps = headless.studio().session().history().entries().size();
  run(headless, "ui wait\nui drag front 423.8 848.3 463.8 808.3\n");
  EXPECT_EQ(headless.studio().session().history().entries().size(), steps + 1);
  EXPECT_NEAR(nodeWith(headless.studio().session().project(), 2).clicks.at("front").px.x, 463.8, 3.6);
}

TEST(Studio, ClicksLandOnTheSamePixelWhenZoomedIn) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui press stem_4\nui key 1\nui wheel front 395 300 14\nui click front 395.2 300.4\n");
  const auto& click = nodeWith(headless.studio().session().project(), 18).clicks.at("front").px;
  EXPECT_NEAR(click.x, 395.2, 0.2);
  EXPECT_NEAR(click.y, 300.4, 0.2);
}

TEST(Studio, WhatIsStillMissingIsSaidAndTheRestStaysShown) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui press stem_4\nui click front 395 300\nui wait\n");
  EXPECT_TRUE(headless.studio().session().isDirty());
  const auto picture = headless.picture();
  ASSERT_TRUE(picture);
  const auto [x, y, width, height] = headless.studio().state().landmarks.at("pane_plant");
  EXPECT_GT(coloursIn(*picture, static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)), 200u);
  EXPECT_EQ(headless.studio().state().shownTroubles, 1u) << "node 18 lacks a second click";
}

TEST(Studio, EveryPartOfTheWayIsDrawnInEveryLanguageAndTheme) {
  HeadlessStudio headless = opened();
  for (const char* way : {"describe", "photos", "stems", "leaves", "grammar", "grow"})
    for (const char* look : {"en\nui theme dark", "zh_hant\nui theme light", "zh_hans\nui scale 1.5"}) {
      run(headless, "ui way " + std::string(way) + "\nui language " + look + "\n");
      const auto picture = headless.picture();
      ASSERT_TRUE(picture);
      EXPECT_GT(coloursIn(*picture, 0, 0, 1200, 800), 60u) << way << " " << look;
    }
}

TEST(Studio, ALineThatCannotBeDoneNamesItself) {
  HeadlessStudio headless = opened();
  const auto ran = headless.run("# nothing\nset_seed 7\nui press no_such_button\n");
  ASSERT_FALSE(ran);
  EXPECT_NE(ran.error().message.find("line 3"), std::string::npos) << ran.error().message;
  EXPECT_EQ(headless.studio().session().project().seed, 7u);
}

TEST(Studio, BeginsWithWhatCanBeOpened) {
  auto headless = HeadlessStudio::open({}, 1000, 700);
  ASSERT_TRUE(headless) << headless.error().message;
  run(*headless, "ui press open_sample\nui wait\n");
  EXPECT_EQ(headless->studio().session().project().name, "lantana");
}

}  // namespace
}  // namespace axil::ui
