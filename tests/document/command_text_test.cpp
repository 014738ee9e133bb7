#include "document/command_text.hpp"

#include "base/rng.hpp"
#include "random_commands.hpp"

#include <gtest/gtest.h>

#include <set>

namespace axil::document {
namespace {

std::string troubleWith(std::string_view line) {
  const auto parsed = parseCommand(line);
  return parsed ? "understood as " + print(*parsed) : parsed.error().message;
}

TEST(CommandText, AClickReadsAsPeopleWriteIt) {
  EXPECT_EQ(print(AddClick{NodeId(12), "front", {{512, 300}}}), "add_click 12 front 512 300");
  const auto parsed = parseCommand("  add_click  12 front 512\t300.5 ");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(*parsed, Command(AddClick{NodeId(12), "front", {{512, 300.5}}}));
}

TEST(CommandText, TextsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(print(SetName{"lantana"}), "set_name lantana");
  EXPECT_EQ(print(SetName{"馬纓丹"}), "set_name 馬纓丹");
  EXPECT_EQ(print(SetName{""}), "set_name \"\"");
  EXPECT_EQ(print(SetDescription{"Shrub;\nleaves \"opposite\""}), "set_description \"Shrub;\\nleaves \\\"opposite\\\"\"");
  EXPECT_EQ(print(AddView{"front", "my photo=1.jpg"}), "add_view front \"my photo=1.jpg\"");
}

TEST(CommandText, LeavesNameWhatIsGivenAndLeaveOutTheRest) {
  quantify::LeafArrangement leaves;
  leaves.stem = StemId(2);
  leaves.arrangement = "decussate";
  leaves.nodes = 4;
  leaves.angle = 55_deg;
  EXPECT_EQ(print(AddLeaves{leaves}), "add_leaves 2 arrangement=decussate nodes=4 angle=55");
  const auto radians = parseCommand("add_leaves 2 angle=0.5rad at=3,4");
  ASSERT_TRUE(radians);
  EXPECT_EQ(std::get<AddLeaves>(*radians).leaves.angle->radians(), 0.5);
  EXPECT_EQ(std::get<AddLeaves>(*radians).leaves.at, (std::vector{NodeId(3), NodeId(4)}));
}

TEST(CommandText, WhatIsPrintedReadsBackForRandomCommandsOfEveryKind) {
  Rng rng(11);
  for (std::size_t kind = 0; kind < std::variant_size_v<Command>; ++kind)
    for (int i = 0; i < 500; ++i) {
      const Command command = test::anyCommand(rng, kind);
      ASSERT_EQ(command.index(), kind);
      const std::string line = print(command);
      ASSERT_EQ(line.find('\n'), std::string::npos) << line;
      const auto parsed = parseCommand(line);
      ASSERT_TRUE(parsed) << line << "\n" << parsed.error().message;
      ASSERT_EQ(*parsed, command) << line;
      ASSERT_EQ(print(*parsed), line);
    }
}

TEST(CommandText, StepsReadBackToo) {
  Rng rng(12);
  for (int i = 0; i < 2000; ++i) {
    Step step;
    for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) step.push_back(test::anyCommand(rng, rng.below(std::variant_size_v<Command>)));
    const auto parsed = parseStep(print(step));
    ASSERT_TRUE(parsed) << print(step) << "\n" << parsed.error().message;
    ASSERT_EQ(*parsed, step);
  }
}

TEST(CommandText, NoLineCrashesHoweverItIsDamaged) {
  Rng rng(13);
  for (int i = 0; i < 20'000; ++i) {
    std::string line = print(test::anyCommand(rng, rng.below(std::variant_size_v<Command>)));
    const std::size_t at = rng.below(line.size());
    if (rng.below(2) == 0) line.resize(at);
    else line[at] = static_cast<char>(rng.below(256));
    if (const auto parsed = parseStep(line); !parsed) {
      ASSERT_FALSE(parsed.error().message.empty()) << line;
    }
  }
}

TEST(CommandText, ErrorsSayWhatIsWrongAndWhatIsTaken) {
  EXPECT_EQ(troubleWith("add_clik 12 front 1 2"), "there is no command 'add_clik'; did you mean add_click?");
  EXPECT_EQ(troubleWith("photosynthesise"), "there is no command 'photosynthesise'");
  EXPECT_EQ(troubleWith("add_click 12 front"), "add_click: X is missing; it takes add_click NODE VIEW X Y");
  EXPECT_EQ(troubleWith("add_click 12 front 1 2 3"), "add_click: '3' is one word too many; it takes add_click NODE VIEW X Y, and texts with blanks are quoted");
  EXPECT_EQ(troubleWith("add_click twelve front 1 2"), "add_click: NODE must be a whole number, not 'twelve'");
  EXPECT_EQ(troubleWith("add_click 12 front 1 nan"), "add_click: Y must be a number, not 'nan'");
  EXPECT_EQ(troubleWith("set_name \"open"), "the text that begins at byte 10 has no closing quote");
  EXPECT_EQ(troubleWith("set_name \"\\q\""), "the backslash at byte 11 begins no known escape; there are \\\" \\\\ \\n \\t \\r and \\xNN");
  EXPECT_EQ(troubleWith("add_leaves 2 angel=3"), "add_leaves: there is no option 'angel'; did you mean angle?");
  EXPECT_EQ(troubleWith("add_leaves 2 angle=3 angle=4"), "add_leaves: angle is given twice");
  EXPECT_EQ(troubleWith("add_leaves 2 angle=steep"), "add_leaves: angle must be a number of degrees (55) or radians (0.96rad), not 'steep'");
  EXPECT_EQ(troubleWith("set_camera_model front fisheye"), "set_camera_model: MODEL must be unknown, orthographic or perspective, not 'fisheye'");
  EXPECT_EQ(troubleWith("set_name a ; set_name b"), "there are several commands in the line; one is expected here");
  EXPECT_EQ(troubleWith(""), "there is no command; the first word says what to do, as add_click does");
}

TEST(CommandText, TheTableHasOneRowWithHelpForEveryCommandAndNoNameTwice) {
  std::set<std::string> names;
  EXPECT_EQ(commandTable().size(), std::variant_size_v<Command>);
  Rng rng(1);
  for (std::size_t i = 0; i < commandTable().size(); ++i) {
    const CommandInfo& info = commandTable()[i];
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.help.empty()) << info.name;
    const std::string line = print(test::anyCommand(rng, i));
    EXPECT_EQ(line.substr(0, line.find(' ')), info.name);
  }
  EXPECT_EQ(usageOf(commandTable()[Command(SetScale()).index()]), "set_scale VIEW FROM_X FROM_Y TO_X TO_Y LENGTH");
  EXPECT_EQ(usageOf(commandTable()[Command(AddStem()).index()]), "add_stem STEM NODE ..");
}

}  // namespace
}  // namespace axil::document
