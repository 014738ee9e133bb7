#include "base/files.hpp"

#include "base/file_writer.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace axil {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  Files() : folder(fs::path(::testing::TempDir()) / ("axil_files_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Files() override { fs::remove_all(folder); }
  std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator())); }
  fs::path folder;
};

TEST_F(Files, WhatIsWrittenReadsBackAndLeavesNothingBeside) {
  ASSERT_TRUE(writeFile(folder / "a.txt", "x"));
  ASSERT_TRUE(writeFile(folder / "a.txt", "yz"));
  EXPECT_EQ(*readFile(folder / "a.txt"), "yz");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, MissingFoldersAndLargeFilesAreRefusedByName) {
  EXPECT_EQ(readFile(folder / "none").error().code, ErrorCode::NotFound);
  EXPECT_EQ(readFile(folder).error().code, ErrorCode::Unreadable);
  ASSERT_TRUE(writeFile(folder / "big", std::string(100, 'x')));
  EXPECT_EQ(readFile(folder / "big", 99).error().code, ErrorCode::LimitReached);
}

TEST_F(Files, AFileInPiecesIsThereWhenItIsFinishedAndNotBefore) {
  {
    FileWriter file(folder / "sub" / "pieces");
    file.write("one ");
    file.write("two");
    EXPECT_FALSE(fs::exists(folder / "sub" / "pieces"));
    ASSERT_TRUE(file.finish());
  }
  EXPECT_EQ(*readFile(folder / "sub" / "pieces"), "one two");
  {
    FileWriter leftAlone(folder / "other");
    leftAlone.write("x");
  }
  FileWriter inAFile(folder / "sub" / "pieces" / "a");
  inAFile.write("x");
  EXPECT_EQ(inAFile.finish().error().code, ErrorCode::Unwritable);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, AStagingFolderThatIsNotPublishedLeavesNoTrace) {
  {
    auto staging = StagingFolder::beside(folder / "out");
    ASSERT_TRUE(staging) << staging.error().message;
    ASSERT_TRUE(writeFile(staging->path() / "a", "1"));
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, PublishingKeepsWhatElseIsInTheFolder) {
  ASSERT_TRUE(writeFile(folder / "out" / "mine", "keep"));
  auto staging = StagingFolder::beside(folder / "out");
  ASSERT_TRUE(staging);
  ASSERT_TRUE(writeFile(staging->path() / "sub" / "a", "1"));
  ASSERT_TRUE(staging->publish());
  EXPECT_EQ(*readFile(folder / "out" / "mine"), "keep");
  EXPECT_EQ(*readFile(folder / "out" / "sub" / "a"), "1");
}

TEST_F(Files, AFileInThePlaceOfAnOutputFolderIsRefused) {
  ASSERT_TRUE(writeFile(folder / "out", "a file"));
  const auto staging = StagingFolder::beside(folder / "out");
  ASSERT_FALSE(staging);
  EXPECT_EQ(staging.error().code, ErrorCode::Unwritable);
}

}  // namespace
}  // namespace axil
