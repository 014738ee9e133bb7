// What a hand can do with many nodes, with the menu of a place, with the palette and with the borders: through the window's own input.
#include "document/lookup.hpp"
#include "ui/headless.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

namespace axil::ui {
namespace {

const std::filesystem::path kLantana = std::filesystem::path(AXIL_SAMPLES_DIR) / "lantana" / "lantana.axil";

HeadlessStudio opened() {
  auto headless = HeadlessStudio::open({}, 1200, 800);
  EXPECT_TRUE(headless) << headless.error().message;
  if (auto open = headless->studio().open(kLantana); !open) ADD_FAILURE() << open.error().message;
  headless->studio().state().snap = false;  // clicks are looked for where they were made
  return std::move(*headless);
}

void run(HeadlessStudio& headless, std::string_view lines) {
  if (auto ran = headless.run(lines); !ran) ADD_FAILURE() << ran.error().message;
}

PhotoPoint clickOf(HeadlessStudio& headless, int node, const char* view) {
  const auto& project = headless.studio().session().project();
  return project.nodes[document::nodeWithId(project, document::NodeId(node)).value()].node.clicks.at(view);
}

TEST(Hand, ABoxSelectsTheNodesInItAndDeleteRemovesThemAllAsOneStep) {
  HeadlessStudio headless = opened();
  const std::size_t nodes = headless.studio().session().project().nodes.size();
  run(headless, "ui wait\nui key 1\nui drag front 330 400 600 130\n");
  const std::size_t selected = headless.studio().state().selection.all().size();
  EXPECT_GT(selected, 2u);
  EXPECT_LT(selected, nodes);
  const std::size_t steps = headless.studio().session().history().entries().size();
  run(headless, "ui key escape\nui key ctrl+a\n");
  EXPECT_EQ(headless.studio().state().selection.all().size(), nodes);
  EXPECT_EQ(headless.studio().session().history().entries().size(), steps) << "selecting is no step";
}

TEST(Hand, SelectedNodesAreDraggedTogetherByTheSameAmount) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui key 1\nui press stem_2\nui key a\n");
  const auto chosen = headless.studio().state().selection.all();
  ASSERT_GE(chosen.size(), 3u);
  std::vector<glm::dvec2> before;
  for (const auto id : chosen) before.push_back(clickOf(headless, id.value, "front").px);
  const auto at = clickOf(headless, chosen.front().value, "front").px;
  const std::size_t steps = headless.studio().session().history().entries().size();
  run(headless, "ui drag front " + std::to_string(at.x) + " " + std::to_string(at.y) + " " + std::to_string(at.x + 40) + " " + std::to_string(at.y - 30) + "\n");
  EXPECT_EQ(headless.studio().session().history().entries().size(), steps + 1);
  const glm::dvec2 moved = clickOf(headless, chosen.front().value, "front").px - before.front();
  EXPECT_NEAR(moved.x, 40, 3);
  EXPECT_NEAR(moved.y, -30, 3);
  for (std::size_t i = 0; i < chosen.size(); ++i) EXPECT_NEAR(glm::distance(clickOf(headless, chosen[i].value, "front").px - before[i], moved), 0, 1e-9) << i;
}

TEST(Hand, TheMenuOfANodeSplitsItsStemAndJoiningPutsItTogetherAgain) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\n");
  const document::Project before = headless.studio().session().project();
  const auto& stem = before.stems[document::stemWithId(before, document::StemId(1)).value()].stem;
  const auto inner = stem.nodes[2];
  const auto at = clickOf(headless, inner.value, "front").px;
  run(headless, "ui key 1\nui menu front " + std::to_string(at.x) + " " + std::to_string(at.y) + "\nui press menu_key_split\n");
  const document::Project split = headless.studio().session().project();
  ASSERT_EQ(split.stems.size(), before.stems.size() + 1);
  const auto upper = split.stems.back().stem;
  const auto tip = clickOf(headless, upper.nodes.back().value, "front").px;
  run(headless, "ui click front " + std::to_string(tip.x) + " " + std::to_string(tip.y) + "\nui key j\nui click front " + std::to_string(at.x) + " " + std::to_string(at.y) + "\n");
  const document::Project joined = headless.studio().session().project();
  ASSERT_EQ(joined.stems.size(), before.stems.size());
  EXPECT_EQ(joined.stems[document::stemWithId(joined, document::StemId(1)).value()].stem.nodes, stem.nodes);
}

TEST(Hand, RightClickOnABareStemGivesItTheLeavesOfTheDescription) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nadd_node 50 front 250 800\nadd_click 50 right 300 800\nstart_branch 9 2\nappend_node 9 50\nui wait\n");
  const std::size_t leaves = headless.studio().session().project().leaves.size();
  run(headless, "ui way leaves\nui menu front 250 800\n");
  const auto& project = headless.studio().session().project();
  ASSERT_EQ(project.leaves.size(), leaves + 1);
  const auto& added = project.leaves[leaves].arrangement;
  EXPECT_EQ(added.stem, document::StemId(9));
  EXPECT_NE(added.arrangement, "alternate") << "the description says opposite";
  run(headless, "ui menu front 250 800\n");
  EXPECT_EQ(headless.studio().session().project().leaves.size(), leaves + 1) << "a stem with leaves keeps those it has";
}

TEST(Hand, AClickBesideAStemGoesToItsCentreLineUnlessSnappingIsOff) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui key 1\nui key s\n");  // on
  ASSERT_TRUE(headless.studio().state().snap);
  // The trunk of the sample runs through (424.3, 924.7), between its first two nodes; the mouse is put 6 px beside it.
  const glm::dvec2 a = clickOf(headless, 1, "front").px, b = clickOf(headless, 2, "front").px, middle = (a + b) / 2.0;
  run(headless, "ui press stem_4\nui shift_click front " + std::to_string(middle.x + 6) + " " + std::to_string(middle.y) + "\n");
  EXPECT_NEAR(clickOf(headless, 18, "front").px.x, middle.x, 1.5);
  run(headless, "ui key ctrl+z\nui press stem_4\nui key s\nui shift_click front " + std::to_string(middle.x + 6) + " " + std::to_string(middle.y) + "\n");
  EXPECT_NEAR(clickOf(headless, 18, "front").px.x, middle.x + 6, 2.5) << "the mouse stands on whole pixels of the screen";
}

TEST(Hand, ANodeDraggedInSpaceMovesItsClicksInEveryPhotoAsOneStep) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui way stems\nui orbit 0 0 1\nui press stem_2\nui wait\n");
  const int node = headless.studio().state().selection.node.value().value;
  const PhotoPoint front = clickOf(headless, node, "front"), right = clickOf(headless, node, "right");
  const std::size_t steps = headless.studio().session().history().entries().size();
  run(headless, "ui pull selected_in_space 30 0\nui wait\n");
  EXPECT_EQ(headless.studio().session().history().entries().size(), steps + 1);
  // Looked at from the front, a pull to the right is one to the right in the front photo and none across the right one.
  EXPECT_GT(clickOf(headless, node, "front").px.x - front.px.x, 20);
  EXPECT_LT(std::abs(clickOf(headless, node, "front").px.y - front.px.y), 12);
  EXPECT_LT(std::abs(clickOf(headless, node, "right").px.x - right.px.x), 30);
  run(headless, "ui key ctrl+z\n");
  EXPECT_EQ(clickOf(headless, node, "front").px, front.px);
}

TEST(Hand, AStemIsFollowedToTheMouseAndTakenInTheOtherPhotosWithOneKey) {
  HeadlessStudio headless = opened();
  const auto project = [&] { return headless.studio().session().project(); };
  const auto clicksOf = [&](document::NodeId node) { return project().nodes[document::nodeWithId(project(), node).value()].node.clicks; };
  // Stem 2 of the sample is taken away and traced again: its branch point, its tip in the front photo, Enter.
  const auto tip = clicksOf(project().stems[document::stemWithId(project(), document::StemId(2)).value()].stem.nodes.back());
  const std::string at = std::to_string(tip.at("front").px.x) + " " + std::to_string(tip.at("front").px.y);
  run(headless, "ui wait\nremove_stem 2\nui way stems\nui press stem_1\nui click front 415.5 556.8\nui wait\nui move front " + at + "\nui wait\nui click front " + at + "\nui wait\n");
  const auto stem = project().stems.back().stem.nodes;
  EXPECT_GT(stem.size(), 2u) << "the branch is bent";
  EXPECT_LE(stem.size(), 14u);
  const std::size_t steps = headless.studio().session().history().entries().size();
  run(headless, "ui key enter\nui wait\n");
  EXPECT_EQ(headless.studio().session().history().entries().size(), steps + 1);
  const auto clicks = clicksOf(stem.back());
  ASSERT_GE(clicks.size(), 2u);
  for (const auto& [view, click] : clicks) EXPECT_LT(glm::distance(click.px, tip.at(view).px), 40) << view;
  run(headless, "ui key ctrl+z\nui wait\n");
  EXPECT_EQ(clicksOf(stem.back()).size(), 1u);
}

TEST(Hand, ThePaletteDoesWhatItsNameSays) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui key ctrl+k\nui type light\nui key enter\n");
  EXPECT_EQ(headless.studio().state().theme, Theme::Light);
  EXPECT_FALSE(headless.studio().state().palette.has_value());
  run(headless, "ui key ctrl+k\nui type loupe\nui press do_key_loupe\n");
  EXPECT_TRUE(headless.studio().state().loupe);
}

TEST(Hand, WaitingNodesArePlacedOnTheirStemsWithOnePressAsOneStep) {
  HeadlessStudio headless = opened();
  run(headless, "remove_click 3 right ; remove_click 3 top ; remove_click 4 right ; remove_click 4 top\nui wait\nui press place_waiting\nui wait\n");
  const document::Project& project = headless.studio().session().project();
  for (const int id : {3, 4}) EXPECT_EQ(project.nodes[document::nodeWithId(project, document::NodeId(id)).value()].node.clicks.size(), 2u) << id;
  run(headless, "undo\n");
  const document::Project& before = headless.studio().session().project();
  EXPECT_EQ(before.nodes[document::nodeWithId(before, document::NodeId(3)).value()].node.clicks.size(), 1u);
}

TEST(Hand, ABorderThatIsDraggedGivesRoom) {
  HeadlessStudio headless = opened();
  const float before = headless.studio().state().preferences.layout.left;
  run(headless, "ui wait\nui pull border_left 60 0\n");
  EXPECT_NEAR(headless.studio().state().preferences.layout.left, before + 60, 2);
}

TEST(Hand, TheTourLeadsThroughFiveCardsAndEnds) {
  auto headless = HeadlessStudio::open({}, 1200, 800);
  ASSERT_TRUE(headless) << headless.error().message;
  run(*headless, "ui press tour_offer\nui wait\nui press tour_next\nui press tour_next\nui press tour_next\nui press tour_next\n");
  EXPECT_EQ(headless->studio().state().way, Way::Grow);
  run(*headless, "ui press tour_done\n");
  EXPECT_FALSE(headless->studio().state().tour.has_value());
}

}  // namespace
}  // namespace axil::ui
