#include "document/history.hpp"

#include "base/rng.hpp"
#include "counted_memory.hpp"
#include "document/command_text.hpp"
#include "document/lookup.hpp"
#include "document/replay.hpp"
#include "random_commands.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>

namespace axil::document {
namespace {

using test::likelyCommand;
using test::plantOf;

std::uint64_t seedOfToday() {
  const char* given = std::getenv("AXIL_TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count());
}

/// What no command may ever break, whatever was done: the stems of `project` are part of a tree.
std::string faultOf(const Project& project) {
  std::set<NodeId> nodes;
  std::set<StemId> stems;
  std::map<NodeId, StemId> inside;
  for (const ProjectNode& node : project.nodes)
    if (!nodes.insert(node.node.id).second) return "node " + std::to_string(node.node.id.value) + " twice";
  for (const ProjectStem& stem : project.stems) {
    if (!stems.insert(stem.stem.id).second) return "stem " + std::to_string(stem.stem.id.value) + " twice";
    if (stem.stem.nodes.empty()) return "a stem without nodes";
    for (std::size_t n = 0; n < stem.stem.nodes.size(); ++n) {
      if (!nodes.contains(stem.stem.nodes[n])) return "a stem with an unknown node";
      if (n > 0 && !inside.emplace(stem.stem.nodes[n], stem.stem.id).second) return "a node inside two stems";
    }
  }
  for (const ProjectStem& stem : project.stems) {
    std::optional<NodeId> base = stem.stem.nodes.front();
    for (std::size_t up = 0; base && inside.contains(*base); ++up) {
      if (up > project.stems.size()) return "stems in a circle";
      base = project.stems[*stemWithId(project, inside.at(*base))].stem.nodes.front();
    }
  }
  for (const ProjectLeaves& leaves : project.leaves) {
    const auto stem = stemWithId(project, leaves.arrangement.stem);
    if (!stem) return "leaves on no stem";
    const auto& on = project.stems[*stem].stem.nodes;
    for (const NodeId node : leaves.arrangement.at)
      if (std::find(on.begin(), on.end(), node) == on.end()) return "leaves at a node that their stem does not have";
  }
  for (const ProjectNode& node : project.nodes)
    for (const auto& [view, click] : node.node.clicks)
      if (!viewNamed(project, view)) return "a click in an unknown view";
  return {};
}

TEST(History, BeginsWithTheProjectAsItWasGivenAndHasNothingToUndo) {
  History history(plantOf(20));
  EXPECT_EQ(history.project(), plantOf(20));
  EXPECT_FALSE(history.canUndo());
  const auto undone = history.undo();
  ASSERT_FALSE(undone);
  EXPECT_EQ(undone.error().message, "there is nothing to undo");
}

TEST(History, UndoAndRedoWalkThroughAllStates) {
  History history(plantOf(20));
  ASSERT_TRUE(history.run(SetName{"one"}));
  ASSERT_TRUE(history.run(SetName{"two"}));
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.project().name, "one");
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.project(), plantOf(20));
  ASSERT_TRUE(history.redo(2));
  EXPECT_EQ(history.project().name, "two");
  ASSERT_TRUE(history.goTo(1));
  EXPECT_EQ(history.project().name, "one");
  EXPECT_FALSE(history.redo(2));
  EXPECT_EQ(history.position(), 1u);
}

TEST(History, AStepAfterUndoForgetsWhatWasUndone) {
  History history(plantOf(20));
  ASSERT_TRUE(history.run(SetName{"one"}));
  ASSERT_TRUE(history.undo());
  ASSERT_TRUE(history.run(SetName{"other"}));
  EXPECT_FALSE(history.canRedo());
  EXPECT_EQ(history.entries().size(), 2u);
  EXPECT_EQ(print(history.entries().back().step), "set_name other");
}

TEST(History, ARefusedStepLeavesNoTraceEvenWhenItsBeginningWasFine) {
  History history(plantOf(20));
  ASSERT_FALSE(history.run(Step{SetName{"half"}, RemoveStem{StemId(99)}}));
  EXPECT_EQ(history.project(), plantOf(20));
  EXPECT_EQ(history.entries().size(), 1u);
}

TEST(History, AStepOfSeveralCommandsIsUndoneAsOne) {
  History history(plantOf(20));
  ASSERT_TRUE(history.run(Step{AddNode{NodeId(99), "front", {{5, 5}}}, AppendNode{StemId(1), NodeId(99)}}));
  EXPECT_EQ(history.project().stems[0].stem.nodes.back(), NodeId(99));
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.project(), plantOf(20));
}

TEST(History, AStepThatChangesNothingIsNotKept) {
  History history(plantOf(20));
  ASSERT_TRUE(history.run(SetName{"one"}));
  ASSERT_TRUE(history.undo());
  const auto ran = history.run(SetName{history.project().name});
  ASSERT_TRUE(ran);
  EXPECT_EQ(*ran, History::Ran::Unchanged);
  EXPECT_TRUE(history.canRedo());
}

/// A copy that shares nothing with its original.
Project deepCopy(const Project& project) {
  Project copy = project;
  const auto own = [](const auto& list) {
    std::decay_t<decltype(list)> fresh;
    for (const auto& element : list) fresh.push_back(element);
    return fresh;
  };
  copy.description = std::string(project.description.text());
  copy.traits = own(project.traits);
  copy.views = own(project.views);
  copy.nodes = own(project.nodes);
  copy.stems = own(project.stems);
  copy.leaves = own(project.leaves);
  return copy;
}

// Beside the history stands a plain list of copies that share nothing: what undo gives back is compared with those.
TEST(History, AHundredThousandRandomCommandsWithUndoAndRedoBetween) {
  const std::uint64_t seed = seedOfToday();
  SCOPED_TRACE("AXIL_TEST_SEED=" + std::to_string(seed));
  std::cout << "random commands: AXIL_TEST_SEED=" << seed << "\n";
  Rng rng(seed);
  History history(plantOf(20));
  std::vector<Project> copies{deepCopy(history.project())};
  std::map<std::size_t, int> worked, refused;
  for (int i = 0; i < 100'000; ++i) {
    if (rng.below(10) == 0) {
      const std::size_t to = rng.below(3) == 0 ? rng.below(history.entries().size()) : history.position() - std::min<std::size_t>(history.position(), rng.below(4));
      ASSERT_TRUE(history.goTo(to));
      ASSERT_EQ(history.project(), copies[history.position()]);
      continue;
    }
    const Command command = likelyCommand(rng, history.project());
    const auto before = history.snapshot();
    const std::size_t position = history.position();
    const auto ran = history.run(command);
    ++(ran ? worked : refused)[command.index()];
    if (!ran) {
      ASSERT_FALSE(ran.error().message.empty()) << print(command);
      ASSERT_EQ(history.snapshot(), before) << print(command);
      continue;
    }
    if (*ran == History::Ran::Unchanged) continue;
    ASSERT_EQ(faultOf(history.project()), "") << print(command);
    ASSERT_EQ(*history.entries()[position].after, copies[position]) << print(command);
    copies.erase(copies.begin() + static_cast<std::ptrdiff_t>(position + 1), copies.end());
    copies.push_back(deepCopy(history.project()));
  }
  for (std::size_t kind = 0; kind < std::variant_size_v<Command>; ++kind) {
    EXPECT_GT(refused[kind], 0) << commandTable()[kind].name << " was never refused";
    const std::string& name = commandTable()[kind].name;
    const bool rare = name == "set_unit" || name == "set_seed";  // drawn at random only
    EXPECT_TRUE(rare || worked[kind] > 0) << name << " never worked";
  }
}

TEST(History, EveryStateOfARandomSessionReadsBackFromItsFile) {
  Rng rng(6);
  History history(plantOf(20));
  for (int i = 0; i < 3000; ++i) {
    const Command command = likelyCommand(rng, history.project());
    if (!history.run(command)) continue;
    const auto again = parseProject(projectText(history.project()));
    ASSERT_TRUE(again) << print(command) << "\n" << again.error().message << (again.error().details.empty() ? "" : again.error().details.front());
    ASSERT_EQ(*again, history.project()) << print(command);
  }
}

TEST(History, AllStatesOfARandomSessionComeBackFromItsLines) {
  Rng rng(5);
  History history(plantOf(20));
  std::string lines = "# a session\n\n";
  for (int i = 0; i < 2000; ++i) {
    const Command command = likelyCommand(rng, history.project());
    if (const auto ran = history.run(command); ran && *ran == History::Ran::Changed) lines += print(command) + "\n";
    if (rng.below(20) == 0 && history.undo()) lines += "undo\n";
    if (rng.below(40) == 0 && history.redo()) lines += "redo\n";
  }
  const auto again = replay(plantOf(20), lines);
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->entries().size(), history.entries().size());
  EXPECT_EQ(again->position(), history.position());
  for (std::size_t i = 0; i < history.entries().size(); ++i) ASSERT_EQ(*again->entries()[i].after, *history.entries()[i].after) << i;
}

TEST(History, TenThousandStepsOnFiveHundredSegmentsStayBelowFiftyMegabytes) {
  Rng rng(3);
  const Project plant = plantOf(500);
  const std::size_t before = test::bytesHeld();
  History history(plant);
  std::int32_t next = 1000;
  while (history.entries().size() <= 10'000) {
    const NodeId node = plant.nodes[rng.below(plant.nodes.size())].node.id;
    const PhotoPoint at{{rng.uniform(0, 1200), rng.uniform(0, 1600)}};
    const std::uint64_t what = rng.below(10);
    // What a session is made of: dragging clicks mostly; new nodes on stems, later taken away again; leaves, widths, words.
    Step step{MoveClick{node, "front", at}};
    if (what == 0) step = {AddNode{NodeId(next), "front", at}, AppendNode{StemId(1), NodeId(next)}}, ++next;
    if (what == 1 && nodeWithId(history.project(), NodeId(next - 1))) step = {RemoveNodes{{NodeId(next - 1)}}};
    if (what == 2) step = {SetRadius{node, rng.uniform(0, 0.01)}};
    if (what == 3) step = {ChangeLeaves{1 + static_cast<int>(rng.below(plant.leaves.size())), plant.leaves[0].arrangement}};
    if (what == 4) step = {SetOrigin{"front", at}};
    ASSERT_TRUE(history.run(step)) << print(step);
  }
  const double megabytes = static_cast<double>(test::bytesHeld() - before) / 1e6;
  RecordProperty("megabytes", std::to_string(megabytes));
  std::cout << "10,000 steps on 500 segments hold " << megabytes << " MB\n";
  EXPECT_LT(megabytes, 50);
  EXPECT_GT(megabytes, 1) << "nothing was counted";
}

TEST(History, UndoTakesLessThanFiveMilliseconds) {
  History history(plantOf(500));
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(history.run(MoveClick{NodeId(1 + i % 500), "front", {{i * 1.0, 3}}}));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(history.undo());
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() / 1000;
  EXPECT_LT(ms, 5);
  EXPECT_EQ(history.project(), plantOf(500));
}

TEST(Replay, SaysWhichLineCannotBeDone) {
  const auto broken = replay(plantOf(20), "set_name one\n# nothing\nmove_click 77 front 1 1\n");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().message, "line 3 (move_click 77 front 1 1): there is no node 77");
}

TEST(Replay, GoesOnPastLinesThatDoNotApplyWhenAsked) {
  const Replayed replayed = replayWhatApplies(plantOf(20), "set_name one\nnonsense\nset_unit cm\nredo\n");
  EXPECT_EQ(replayed.history.project().unit, "cm");
  ASSERT_EQ(replayed.faults.size(), 2u);
  EXPECT_EQ(replayed.faults[0].substr(0, 18), "line 2 (nonsense):");
}

TEST(Replay, UndoAndRedoTakeANumberOfSteps) {
  const auto history = replay(plantOf(20), "set_name one\nset_name two\nset_name three\nundo 3\nredo 2\n");
  ASSERT_TRUE(history);
  EXPECT_EQ(history->project().name, "two");
  EXPECT_FALSE(replay(plantOf(20), "set_name one\nundo 0\n"));
  EXPECT_FALSE(replay(plantOf(20), "set_name one\nundo two\n"));
}

}  // namespace
}  // namespace axil::document
