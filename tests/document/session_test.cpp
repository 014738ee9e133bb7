#include "document/lookup.hpp"
#include "document/session.hpp"

#include "base/files.hpp"
#include "document/command_text.hpp"
#include "random_commands.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <sys/resource.h>
#include <unistd.h>

namespace axil::document {
namespace {

namespace fs = std::filesystem;

/// A tree of known shape, clicked exactly in three orthographic views without photos.
Project clickedTree(int segments) {
  Rng rng(21);
  const skeleton3d::Skeleton tree = test::randomTree(rng, {.segments = segments, .leaves = 0, .radii = false});
  Project project;
  for (const char* name : {"front", "right", "top"}) {
    ProjectView view;
    view.view.name = name;
    view.view.camera = *skeleton3d::nominalCamera(name, {.model = skeleton3d::CameraModel::Orthographic, .scale_px_per_unit = 500, .size_px = {4000, 6000}});
    project.views.push_back(view);
  }
  for (const skeleton3d::Node& node : tree.nodes) {
    ProjectNode clicked;
    clicked.node.id = node.id;
    for (const ProjectView& view : project.views) clicked.node.clicks[view.view.name] = skeleton3d::project(view.view.camera, node.position);
    project.nodes.push_back(clicked);
  }
  for (const skeleton3d::Stem& stem : tree.stems) project.stems.push_back({{stem.id, stem.nodes}, {}});
  return project;
}

class SessionTest : public ::testing::Test {
 protected:
  SessionTest()
      : folder_(fs::canonical(fs::temp_directory_path()) / ("axil_session_" + std::to_string(::getpid()) + "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name())),
        path_(folder_ / "plant.axil") {
    fs::remove_all(folder_);
    options_.stateFolder = folder_ / "state";
    EXPECT_TRUE(saveProject(clickedTree(12), path_));
  }
  ~SessionTest() override { fs::remove_all(folder_); }

  Session opened() {
    auto session = Session::open(path_, options_);
    EXPECT_TRUE(session) << session.error().message;
    return std::move(*session);
  }

  fs::path folder_, path_;
  SessionOptions options_;
};

void line(Session& session, const std::string& text) {
  const auto ran = session.runLine(text);
  ASSERT_TRUE(ran) << text << ": " << ran.error().message;
}

TEST_F(SessionTest, KnowsWhetherThereIsSomethingToSave) {
  Session session = opened();
  EXPECT_FALSE(session.isDirty());
  line(session, "set_name one");
  EXPECT_TRUE(session.isDirty());
  line(session, "undo");
  EXPECT_FALSE(session.isDirty());
  line(session, "redo");
  ASSERT_TRUE(session.save());
  EXPECT_FALSE(session.isDirty());
  EXPECT_EQ(loadProject(path_)->project, session.project());
  ASSERT_TRUE(session.undo());
  EXPECT_TRUE(session.isDirty());
}

TEST_F(SessionTest, TheUsersFileIsTouchedBySaveAlone) {
  const std::string before = *readFile(path_);
  Session session = opened();
  line(session, "set_name one");
  line(session, "remove_stem 1");
  EXPECT_EQ(*readFile(path_), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2) << "the project and the state folder";
}

TEST_F(SessionTest, LookingAtAProjectLeavesNoJournal) {
  { Session session = opened(); }
  EXPECT_FALSE(fs::exists(options_.stateFolder / "journals"));
}

TEST_F(SessionTest, ACrashedSessionIsResumedWithItsWholeHistory) {
  std::vector<std::shared_ptr<const Project>> states;
  {
    Session session = opened();
    line(session, "set_name one");
    line(session, "set_name two");
    ASSERT_TRUE(session.save());
    line(session, "set_unit cm");
    ASSERT_TRUE(session.undo(2));
    for (const auto& entry : session.history().entries()) states.push_back(entry.after);
  }
  const auto left = leftJournals(options_.stateFolder, path_);
  ASSERT_EQ(left.size(), 1u);
  auto recovered = recover(left[0].file);
  ASSERT_TRUE(recovered);
  auto session = Session::resume(std::move(*recovered), options_);
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->path(), path_);
  EXPECT_EQ(session->project().name, "one");
  EXPECT_TRUE(session->isDirty());
  ASSERT_EQ(session->history().entries().size(), states.size());
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(*session->history().entries()[i].after, *states[i]);
  EXPECT_TRUE(leftJournals(options_.stateFolder).empty()) << "the old journal is replaced by one that is in use";
  ASSERT_TRUE(session->save());
  session->close();
  EXPECT_TRUE(fs::is_empty(options_.stateFolder / "journals"));
  EXPECT_TRUE(fs::is_empty(options_.stateFolder / "locks"));
}

TEST_F(SessionTest, ASecondWindowIsToldAndMayLookAnyway) {
  Session first = opened();
  const auto second = Session::open(path_, options_);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("open in another window"), std::string::npos);
  options_.ifOpenElsewhere = IfOpenElsewhere::OpenAnyway;
  auto third = Session::open(path_, options_);
  ASSERT_TRUE(third);
  EXPECT_TRUE(third->openElsewhere());
  first.close();
  options_.ifOpenElsewhere = IfOpenElsewhere::Refuse;
  EXPECT_TRUE(Session::open(path_, options_));
}

TEST_F(SessionTest, AFileThatChangedOnDiskIsNotOverwrittenUnasked) {
  Session session = opened();
  line(session, "set_name one");
  std::ofstream(path_, std::ios::app) << "\n";
  const auto refused = session.save();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("was changed by another program"), std::string::npos);
  EXPECT_TRUE(session.isDirty());
  ASSERT_TRUE(session.save(IfChangedOnDisk::Overwrite));
  EXPECT_EQ(loadProject(path_)->project.name, "one");
}

TEST_F(SessionTest, AFolderThatCannotBeWrittenLeavesTheWorkUnsavedAndWhole) {
  Session session = opened();
  line(session, "set_name one");
  std::ofstream(folder_ / "file") << "x";
  const auto failed = session.saveAs(folder_ / "file" / "b.axil");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::Unwritable);
  EXPECT_EQ(session.path(), path_);
  EXPECT_TRUE(session.isDirty());
  EXPECT_TRUE(session.save());
}

TEST_F(SessionTest, SavedUnderAnotherNameItGoesOnThereAndFindsItsPhotos) {
  Session session = opened();
  line(session, "relink_photo front pictures/front.jpg");
  line(session, "relink_photo right /far/right.jpg");
  line(session, "relink_photo top elsewhere/top.jpg");
  ASSERT_TRUE(session.saveAs(folder_ / "elsewhere" / "b.axil"));
  EXPECT_EQ(session.path(), folder_ / "elsewhere" / "b.axil");
  EXPECT_FALSE(session.isDirty());
  const auto there = loadProject(session.path());
  ASSERT_TRUE(there);
  EXPECT_EQ(there->project.views[0].photo, (folder_ / "pictures/front.jpg").string());
  EXPECT_EQ(there->project.views[1].photo, "/far/right.jpg");
  EXPECT_EQ(there->project.views[2].photo, "top.jpg");
  options_.ifOpenElsewhere = IfOpenElsewhere::Refuse;
  EXPECT_TRUE(Session::open(path_, options_)) << "the old file is free";
  line(session, "set_name two");
  EXPECT_TRUE(session.save());
}

TEST_F(SessionTest, AnUntitledProjectIsKeptInTheJournalUntilItHasAFile) {
  {
    Session session = Session::untitled(options_);
    EXPECT_FALSE(session.isDirty());
    line(session, "set_name fresh");
    EXPECT_TRUE(session.isDirty());
    EXPECT_FALSE(session.save());
  }
  const auto left = leftJournals(options_.stateFolder);
  ASSERT_EQ(left.size(), 1u);
  auto recovered = recover(left[0].file);
  ASSERT_TRUE(recovered);
  auto session = Session::resume(std::move(*recovered), options_);
  ASSERT_TRUE(session);
  EXPECT_EQ(session->project().name, "fresh");
  ASSERT_TRUE(session->saveAs(folder_ / "fresh.axil"));
  EXPECT_EQ(loadProject(folder_ / "fresh.axil")->project, session->project());
}

TEST_F(SessionTest, WithoutAJournalWorkGoesOnAndTheTroubleIsShown) {
  std::ofstream(folder_ / "file") << "x";
  options_.stateFolder = folder_ / "file";
  Session session = opened();
  line(session, "set_name one");
  ASSERT_TRUE(session.journalTrouble());
  EXPECT_EQ(session.journalTrouble()->code, ErrorCode::Unwritable);
  EXPECT_EQ(session.project().name, "one");
  fs::remove(folder_ / "file");
  line(session, "set_name two");
  EXPECT_FALSE(session.journalTrouble()) << "each action tries again";
  EXPECT_EQ(session.history().position(), 2u);
}

// A disk that is full: the limit on file sizes makes the system refuse to write on, as a full disk does.
TEST_F(SessionTest, AFullDiskKeepsTheJournalWrittenSoFarAndCatchesUpLater) {
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  Session session = opened();
  line(session, "set_name one");
  const rlimit full{20'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full);
  line(session, "set_description \"" + std::string(30'000, 'x') + "\"");
  const bool troubled = session.journalTrouble().has_value();
  const auto failed = session.save();
  line(session, "set_name two");
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(troubled);
  EXPECT_FALSE(failed);
  EXPECT_EQ(loadProject(path_)->project.name, "plant") << "the file is as it was";
  line(session, "set_name three");
  EXPECT_FALSE(session.journalTrouble());
  const auto saved = session.history().snapshot();
  { const Session gone = std::move(session); }
  const auto left = leftJournals(options_.stateFolder);
  ASSERT_EQ(left.size(), 1u);
  const auto recovered = recover(left[0].file);
  ASSERT_TRUE(recovered);
  EXPECT_EQ(recovered->history.project(), *saved);
  EXPECT_EQ(recovered->history.position(), 4u);
}

TEST_F(SessionTest, ReplaysASavedSessionWithoutAWindow) {
  options_.stateFolder.clear();
  Session session = Session::untitled(options_);
  ASSERT_TRUE(session.replayLines("add_view front \"\"\nadd_node 1 front 5 5\nadd_stem 1 1\nundo\n"));
  EXPECT_EQ(session.history().position(), 2u);
  const auto failed = session.replayLines("set_name x\nadd_stem 1 7\n");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "line 2 (add_stem 1 7): there is no node 7");
  EXPECT_EQ(session.project().name, "x");
}

// ---- what follows from the project -----------------------------------------------------------------------------------

TEST_F(SessionTest, DerivedValuesAreMadeOnceForTheSameInputs) {
  Session session = opened();
  ASSERT_TRUE(session.skeleton().isCurrent()) << session.skeleton().trouble->message;
  EXPECT_EQ(session.skeleton().good->nodes.size(), 13u);
  const auto before = session.grammarText(GrammarKind::Initial).good;
  ASSERT_TRUE(before);
  line(session, "add_leaves 1 nodes=3");
  ASSERT_TRUE(session.skeleton().isCurrent()) << session.skeleton().trouble->message;
  EXPECT_EQ(session.derived().timesMeasured(), 1u) << "leaves do not move a camera";
  EXPECT_EQ(session.derived().timesSolved(), 2u);
  EXPECT_NE(*session.grammarText(GrammarKind::Initial).good, *before);
  line(session, "set_seed 5");
  (void)session.grammarText(GrammarKind::Initial);
  EXPECT_EQ(session.derived().timesSolved(), 2u);
  ASSERT_TRUE(session.undo(2));
  EXPECT_EQ(*session.grammarText(GrammarKind::Initial).good, *before);
}

TEST_F(SessionTest, LeavesHaveTheColourThatTheDescriptionSays) {
  Session session = opened();
  line(session, "add_leaves 1 nodes=3");
  const auto green = session.grammarText(GrammarKind::Initial).good;
  line(session, "set_description \"Shrub. Leaves opposite, ovate, dark purple.\"");
  const auto purple = session.grammarText(GrammarKind::Initial).good;
  ASSERT_TRUE(green && purple);
  EXPECT_NE(*green, *purple);
  EXPECT_NE(green->find("RGBA(0.220000, 0.500000, 0.160000, 1.000000)"), std::string::npos);
  EXPECT_EQ(purple->find("RGBA(0.220000, 0.500000, 0.160000, 1.000000)"), std::string::npos);
}

TEST_F(SessionTest, TheLastGoodPlantStaysWhileThePresentOneIsInTrouble) {
  Session session = opened();
  line(session, "add_node 500 front 5 5");
  EXPECT_TRUE(session.skeleton().isCurrent()) << "a node of one view waits and troubles nobody";
  const auto good = session.skeleton().good;
  const auto text = session.grammarText(GrammarKind::Initial).good;
  // Then it lies on the tip of a stem that it lengthens: a segment of no length.
  const auto& stem = session.project().stems.back().stem;
  const auto clicks = session.project().nodes[nodeWithId(session.project(), stem.nodes.back()).value()].node.clicks;
  const auto at = [&](const char* view) { return std::string(view) + " " + std::to_string(clicks.at(view).px.x) + " " + std::to_string(clicks.at(view).px.y); };
  line(session, "move_click 500 " + at("front") + " ; add_click 500 " + at("right") + " ; append_node " + std::to_string(stem.id.value) + " 500");
  const auto& shown = session.skeleton();
  ASSERT_TRUE(shown.trouble);
  EXPECT_NE(shown.trouble->message.find("500"), std::string::npos) << shown.trouble->message;
  EXPECT_EQ(shown.good, good);
  EXPECT_FALSE(session.grammarText(GrammarKind::Initial).isCurrent());
  EXPECT_EQ(session.grammarText(GrammarKind::Initial).good, text);
  ASSERT_TRUE(session.undo());
  EXPECT_TRUE(session.grammarText(GrammarKind::Initial).isCurrent());
}

TEST_F(SessionTest, AMissingPhotoIsNamedAndDoesNotTakeThePlantAway) {
  Session session = opened();
  line(session, "relink_photo front nowhere.jpg");
  EXPECT_TRUE(session.skeleton().isCurrent());
  const auto troubles = session.photoTroubles();
  ASSERT_EQ(troubles.size(), 1u);
  EXPECT_EQ(troubles[0].view, "front");
  EXPECT_EQ(troubles[0].error.code, ErrorCode::NotFound);
}

TEST_F(SessionTest, PhotosAreLookedAtOnceAndAgainWhenTheyChange) {
  int looks = 0;
  options_.chain.probePhoto = [&](const fs::path&) {
    ++looks;
    return Result<skeleton3d::PhotoInfo>(skeleton3d::PhotoInfo{.width = 4000, .height = 6000});
  };
  std::ofstream(folder_ / "front.jpg") << "a picture";
  Session session = opened();
  line(session, "relink_photo front front.jpg");
  for (int i = 0; i < 5; ++i) {
    line(session, "move_click 1 front " + std::to_string(1000 + i) + " 3000");
    (void)session.skeleton();
    (void)session.photoTroubles();
  }
  EXPECT_EQ(looks, 1);
  std::ofstream(folder_ / "front.jpg") << "another picture";
  (void)session.skeleton();
  EXPECT_EQ(looks, 2);
}

TEST_F(SessionTest, DecisionsOnTheDescriptionReachTheLeaves) {
  Session session = opened();
  line(session, "set_description \"Leaves opposite, ovate.\"");
  line(session, "add_leaves 1 nodes=2");
  ASSERT_TRUE(session.skeleton().isCurrent());
  EXPECT_EQ(session.skeleton().good->leaves.size(), 4u);
  line(session, "change_trait leaf arrangement opposite alternate");
  EXPECT_EQ(session.skeleton().good->leaves.size(), 2u);
  line(session, "reject_trait leaf shape ovate");
  EXPECT_TRUE(session.skeleton().good->leaves.front().shape.empty());
  line(session, "change_trait leaf shape \"\" linear");
  EXPECT_EQ(session.skeleton().good->leaves.front().shape, "linear");
}

TEST(SessionSpeed, AClickOnFiveHundredSegmentsIsFollowedByGrammarWithinFiftyMilliseconds) {
  Session session = Session::untitled({}, clickedTree(500));
  ASSERT_TRUE(session.grammarText(GrammarKind::Initial).isCurrent()) << session.skeleton().trouble->message;
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const PhotoPoint at = session.project().nodes[100].node.clicks.at("front");
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_TRUE(session.run(MoveClick{session.project().nodes[100].node.id, "front", {{at.px.x + 0.25, at.px.y}}}));
    ASSERT_TRUE(session.grammarText(GrammarKind::Initial).isCurrent()) << session.skeleton().trouble->message;
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::cout << "a click at 500 segments to the initial grammar's text: " << best << " ms\n";
  EXPECT_LT(best, 50);
}

}  // namespace
}  // namespace axil::document
