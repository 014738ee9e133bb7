// Grammar and photos, both directions: a line is its stem, an edited number moves clicks, a draft with errors leaves the last plant.
#include "document/lookup.hpp"
#include "ui/grammar_links.hpp"
#include "ui/headless.hpp"
#include "ui/organ_pick.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axil::ui {
namespace {

namespace fs = std::filesystem;
const fs::path kLantana = fs::path(AXIL_SAMPLES_DIR) / "lantana" / "lantana.axil";

HeadlessStudio opened() {
  auto headless = HeadlessStudio::open({}, 1400, 900);
  EXPECT_TRUE(headless) << headless.error().message;
  if (auto open = headless->studio().open(kLantana); !open) ADD_FAILURE() << open.error().message;
  return std::move(*headless);
}

void run(HeadlessStudio& headless, std::string_view lines) {
  if (auto ran = headless.run(lines); !ran) ADD_FAILURE() << ran.error().message;
}

/// The text with the first GrowRate of a stage made longer.
std::string stretched(std::string text, int stage, double factor) {
  const std::size_t at = text.find("Stage " + std::to_string(stage) + " {");
  const std::size_t rate = text.find("GrowRate = ", at) + 11, end = text.find(';', rate);
  return text.substr(0, rate) + std::to_string(std::stod(text.substr(rate, end - rate)) * factor) + text.substr(end);
}

TEST(GrammarLinks, EveryStageAndRuleOfAStemSpeaksOfItsSegment) {
  const std::string text =
      "EcoSystem 1.0 \"e\" {\n    Plant \"p\" {\n        Stem {\n            Stage 2 {\n                GrowRate = 1.0;\n            }\n            Stage 3 {}\n        }\n"
      "        Axiom w = S(2);\n        w: S(2) -> S(0) S(3);\n    }\n}\n";
  const auto parsed = simeco::parseSimeco(text);
  const auto segments = segmentsOfLines(text, parsed.grammar);
  ASSERT_GE(segments.size(), 8u);
  EXPECT_EQ(segments[0], -1);
  EXPECT_EQ(segments[3], 0);
  EXPECT_EQ(segments[4], 0);
  EXPECT_EQ(segments[6], 1);
}

simeco::OrganStyle styleOf(simeco::OrganKind kind, int stage) {
  simeco::OrganStyle style;
  style.kind = kind;
  style.stage = stage;
  return style;
}

TEST(OrganPick, TheOneInFrontOfThoseUnderTheMouseIsChosen) {
  simeco::Plant plant;
  plant.styles = {styleOf(simeco::OrganKind::Stem, stageOfSegment(4)), styleOf(simeco::OrganKind::Leaf, 1)};
  const auto organ = [&](simeco::OrganKind kind, PlantPoint base, glm::dvec3 direction, double length, double radius) {
    simeco::Organ made;
    made.kind = kind;
    made.style = kind == simeco::OrganKind::Leaf ? 1 : 0;
    made.base = base;
    made.direction = PlantDirection::along(direction);
    made.length = length;
    made.radius = radius;
    return made;
  };
  plant.organs = {organ(simeco::OrganKind::Stem, {{0, 0, 0}}, {0, 1, 0}, 1, 0.01), organ(simeco::OrganKind::Leaf, {{0, 0.5, 0}}, {0, 0, 1}, 0.3, 0.1)};
  plant.organs[1].parent = simeco::OrganId(0);
  const auto camera = *skeleton3d::nominalCamera("front", {.model = skeleton3d::CameraModel::Perspective, .target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 1000, .size_px = {800, 800}});
  const auto at = [&](PlantPoint p) { return skeleton3d::project(camera, p); };
  EXPECT_EQ(organUnder(plant, camera, at({{0, 0.5, 0.2}}), 4), simeco::OrganId(1)) << "the leaf stands before the stem";
  EXPECT_EQ(organUnder(plant, camera, at({{0, 0.9, 0}}), 4), simeco::OrganId(0));
  EXPECT_FALSE(organUnder(plant, camera, at({{0.3, 0.9, 0}}), 4));
  EXPECT_EQ(segmentOfOrgan(plant, simeco::OrganId(1)), 4) << "a leaf is of the segment it stands on";
  simeco::Organ stalk = plant.organs[1];
  stalk.kind = simeco::OrganKind::Stem;
  stalk.style = 2;
  plant.styles.push_back(styleOf(simeco::OrganKind::Stem, stageOfSegment(0) - 1));
  plant.organs.insert(plant.organs.begin() + 1, stalk);
  plant.organs[2].parent = simeco::OrganId(1);
  EXPECT_EQ(segmentOfOrgan(plant, simeco::OrganId(2)), 4) << "through its stalk";
}

TEST(OrganPick, AChosenLeafLightsUpItsRuleItsSegmentAndItsClicks) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui way grammar\nui press kind_initial\nui wait\n");
  auto& state = headless.studio().state();
  const auto pane = state.landmarks.at("pane_plant");
  // All over the pane, until a leaf is under the mouse.
  for (float y = 40; y < pane[3] && !(state.organ && state.organ->kind == simeco::OrganKind::Leaf); y += 12)
    for (float x = 40; x < pane[2] && !(state.organ && state.organ->kind == simeco::OrganKind::Leaf); x += 12)
      run(headless, "ui click_in pane_plant " + std::to_string(x) + " " + std::to_string(y) + "\n");
  ASSERT_TRUE(state.organ && state.organ->kind == simeco::OrganKind::Leaf);
  EXPECT_TRUE(state.organ->where) << "its rule's place in the text";
  EXPECT_TRUE(state.selection.node) << "the node that its segment ends at";
}

TEST(GrammarPane, ALongerSegmentInTheGrammarMovesTheClicksOfWhatGrowsOnIt) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui way grammar\nui press kind_initial\nui wait\nui press grammar_edit\nui wait\n");
  auto& draft = headless.studio().state().grammarDraft;
  ASSERT_TRUE(draft.has_value());
  const document::Project before = headless.studio().session().project();
  draft->text = stretched(draft->text, 2, 1.2);
  ++draft->version;
  run(headless, "ui wait\nui press grammar_apply\nui wait\n");
  const document::Project after = headless.studio().session().project();
  EXPECT_FALSE(headless.studio().state().grammarDraft.has_value());
  ASSERT_EQ(after.nodes.size(), before.nodes.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < after.nodes.size(); ++i)
    if (after.nodes[i].node.clicks != before.nodes[i].node.clicks) ++moved;
  EXPECT_EQ(moved, before.nodes.size() - 1) << "all but the base stand higher";
  run(headless, "ui key ctrl+z\n");
  EXPECT_EQ(headless.studio().session().project(), before) << "one step";
}

TEST(GrammarPane, ADraftWithErrorsKeepsTheLastPlantAndSaysWhereItIsWrong) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui way grammar\nui press grammar_edit\nui wait\n");
  auto& draft = headless.studio().state().grammarDraft;
  ASSERT_TRUE(draft.has_value());
  draft->text.replace(draft->text.find("Stem"), 4, "Stme");
  ++draft->version;
  run(headless, "ui wait\n");
  const auto picture = headless.picture();
  ASSERT_TRUE(picture);
  run(headless, "ui press discard\nui wait\n");
  EXPECT_FALSE(headless.studio().state().grammarDraft.has_value());
}

TEST(GrowPane, EnvironmentAndGhostsComeAndGo) {
  HeadlessStudio headless = opened();
  run(headless, "ui wait\nui way grow\nui wait\nui press env_rain\nui wait\n");
  EXPECT_TRUE(headless.studio().state().environment.rainRate.has_value());
  headless.studio().state().ghosts = 3;
  const auto with = headless.picture();
  headless.studio().state().ghosts = 0;
  const auto without = headless.picture();
  ASSERT_TRUE(with && without);
  EXPECT_NE(with->rgb, without->rgb);
}

TEST(GrowPane, WritesWhatTheFilesEndingSays) {
  HeadlessStudio headless = opened();
  const fs::path folder = fs::temp_directory_path() / "axil_export_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  run(headless, "ui wait\nui way grow\nui wait\n");
  for (const char* ending : {".png", ".glb", ".obj", ".ply", ".simeco", ".l", ".lpy", ".mtg"}) {
    headless.studio().state().wishes.push_back(WishExportFile{folder / (std::string("plant") + ending)});
    run(headless, "ui wait\n");
    EXPECT_TRUE(fs::exists(folder / (std::string("plant") + ending))) << ending << ": " << (headless.studio().state().notice ? headless.studio().state().notice->text : "");
  }
  headless.studio().state().wishes.push_back(WishExportFile{folder / "plant.doc"});
  run(headless, "ui wait\n");
  ASSERT_TRUE(headless.studio().state().notice.has_value());
  EXPECT_EQ(headless.studio().state().notice->kind, NoticeKind::Failed);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace axil::ui
