#include "base/table.hpp"

#include <gtest/gtest.h>

namespace axil {
namespace {

TEST(ReadTable, SkipsCommentsAndEmptyLinesAndTrimsCells) {
  const auto table = readTable("# what it is\n\nname\tsize\n a \t1\r\nb\t 2", "t.tsv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->columns, (std::vector<std::string>{"name", "size"}));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->cell(table->rows[0], "name"), "a");
  EXPECT_EQ(table->cell(table->rows[1], "size"), "2");
  EXPECT_EQ(table->rows[1].line, 5);
}

TEST(ReadTable, NamesTheLineOfARowThatDoesNotFit) {
  const auto table = readTable("name\tsize\na\n", "t.tsv");
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::BadInput);
  EXPECT_NE(table.error().message.find("t.tsv:2"), std::string::npos) << table.error().message;
}

TEST(SplitList, LeavesOutEmptyPieces) { EXPECT_EQ(splitList(" a, b,, c ", ','), (std::vector<std::string>{"a", "b", "c"})); }

}  // namespace
}  // namespace axil
