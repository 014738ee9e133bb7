#include "base/files.hpp"
#include "document/command_text.hpp"
#include "document/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::document {
namespace {

std::string page() {
  const auto text = readFile(std::string(AXIL_TEST_DIR) + "/../../docs/commands.md");
  EXPECT_TRUE(text) << text.error().message;
  return text ? *text : "";
}

TEST(CommandsPage, HasTheRowOfEveryCommandAndNoOther) {
  const std::string text = page();
  std::string rows;
  for (const CommandInfo& info : commandTable()) rows += "| `" + usageOf(info) + "` | " + info.help + " |\n";
  EXPECT_NE(text.find("|---|---|\n" + rows + "\n"), std::string::npos) << "the table in docs/commands.md must be:\n" << rows;
}

TEST(CommandsPage, TheExampleRuns) {
  const std::string text = page();
  const std::size_t begin = text.find("```\n") + 4;
  const std::string lines = text.substr(begin, text.find("```", begin) - begin);
  const auto history = replay(Project(), lines);
  ASSERT_TRUE(history) << history.error().message;
  EXPECT_EQ(history->project().leaves.size(), 1u);
}

}  // namespace
}  // namespace axil::document
