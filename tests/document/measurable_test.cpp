#include "document/measurable.hpp"

#include "document/replay.hpp"

#include <gtest/gtest.h>

namespace axil::document {
namespace {

Project projectOf(std::string_view lines) {
  const auto history = replay(Project{}, lines);
  EXPECT_TRUE(history) << history.error().message;
  return history ? history->project() : Project{};
}

const std::string kStem =
    "add_view front \"\"\nadd_view right \"\"\n"
    "add_node 1 front 0 0 ; add_click 1 right 0 0 ; add_stem 1 1\n"
    "add_node 2 front 0 10 ; add_click 2 right 0 10 ; append_node 1 2\n";

TEST(MeasurablePart, IsTheWholeWhereNothingIsMissing) {
  const Project project = projectOf(kStem);
  EXPECT_EQ(measurablePart(project), project);
}

TEST(MeasurablePart, LeavesOutANodeWithOneClickAndWhatHangsOnIt) {
  const Project part = projectOf(kStem);
  const Project project = projectOf(kStem + "add_node 3 front 0 20 ; append_node 1 3\n"
                                            "start_branch 2 3 ; add_node 4 front 5 30 ; add_click 4 right 5 30 ; append_node 2 4\nadd_leaves 2 nodes=2\n");
  ASSERT_TRUE(measurablePart(project));
  EXPECT_EQ(*measurablePart(project), part);
}

TEST(MeasurablePart, LeavesOutWhatNothingConnects) {
  const Project project = projectOf(kStem + "add_node 8 front 50 0 ; add_click 8 right 50 0 ; add_node 9 front 50 9 ; add_click 9 right 50 9 ; add_stem 5 8 9\n");
  EXPECT_EQ(*measurablePart(project), projectOf(kStem));
}

TEST(MeasurablePart, IsNothingBeforeAnythingCanBeMeasured) {
  EXPECT_EQ(measurablePart(Project{}), std::nullopt);
  EXPECT_EQ(measurablePart(projectOf("add_view front \"\"\nadd_node 1 front 0 0 ; add_stem 1 1\n")), std::nullopt);
}

}  // namespace
}  // namespace axil::document
