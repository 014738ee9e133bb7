#include "document/journal.hpp"

#include "base/files.hpp"
#include "base/rng.hpp"
#include "document/command_text.hpp"
#include "random_commands.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axil::document {
namespace {

namespace fs = std::filesystem;
using test::plantOf;

class JournalTest : public ::testing::Test {
 protected:
  JournalTest()
      : folder_(fs::canonical(fs::temp_directory_path()) / ("axil_journal_" + std::to_string(::getpid()) + "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name())),
        state_(folder_ / "state"), project_(folder_ / "plant.axil") {
    fs::remove_all(folder_);
    EXPECT_TRUE(saveProject(plantOf(20), project_));
  }
  ~JournalTest() override { fs::remove_all(folder_); }

  JournalSubject subject() const { return {project_, folder_, contentHash(*readFile(project_))}; }
  /// What a session does: a history and its journal, action by action.
  void act(History& history, Journal& journal, const std::string& line) {
    const auto action = parseAction(line);
    ASSERT_TRUE(action) << action.error().message;
    ASSERT_TRUE(perform(history, *action)) << line;
    ASSERT_TRUE(journal.append(*action));
  }
  fs::path onlyJournal() const {
    const auto left = leftJournals(state_);
    EXPECT_EQ(left.size(), 1u);
    return left.empty() ? fs::path() : left.front().file;
  }

  fs::path folder_, state_, project_;
};

void expectSame(const History& a, const History& b) {
  ASSERT_EQ(a.entries().size(), b.entries().size());
  EXPECT_EQ(a.position(), b.position());
  for (std::size_t i = 0; i < a.entries().size(); ++i) ASSERT_EQ(*a.entries()[i].after, *b.entries()[i].after) << i;
}

TEST_F(JournalTest, BringsBackTheWholeHistory) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal) << journal.error().message;
    act(history, *journal, "set_name \"my plant\"");
    act(history, *journal, "set_description \"two\\nlines\\n# saving 0123\"");
    act(history, *journal, "add_node 99 front 5 5 ; append_node 1 99");
    act(history, *journal, "undo");
  }
  const auto left = leftJournals(state_);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].actions, 4u);
  EXPECT_EQ(left[0].pid, ::getpid());
  EXPECT_EQ(left[0].subject, subject());
  const auto recovered = recover(left[0].file);
  ASSERT_TRUE(recovered) << recovered.error().message;
  EXPECT_TRUE(recovered->faults.empty());
  expectSame(recovered->history, history);
}

TEST_F(JournalTest, BeginsWithAHistoryThatIsUnderWay) {
  History history(plantOf(20));
  ASSERT_TRUE(history.run(SetName{"one"}));
  ASSERT_TRUE(history.run(SetName{"two"}));
  ASSERT_TRUE(history.undo());
  { ASSERT_TRUE(Journal::begin(state_, subject(), history)); }
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  expectSame(recovered->history, history);
}

TEST_F(JournalTest, ALineThatWasCutOffIsTheOnlyOneLost) {
  History history(plantOf(20));
  std::string whole;
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    for (int i = 0; i < 5; ++i) act(history, *journal, "move_click 1 front " + std::to_string(100 + i) + " 200");
    whole = *readFile(journal->path());
  }
  const fs::path file = onlyJournal();
  const std::size_t lastLine = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = lastLine; size < whole.size(); ++size) {
    fs::resize_file(file, size);
    const auto recovered = recover(file);
    ASSERT_TRUE(recovered) << size;
    EXPECT_EQ(recovered->history.position(), 4u) << size;
    EXPECT_EQ(recovered->history.project().nodes[0].node.clicks.at("front").px.x, 103) << size;
    EXPECT_TRUE(recovered->faults.empty());
  }
}

TEST_F(JournalTest, EveryTruncationIsRecoveredOrOneClearError) {
  History history(plantOf(20));
  std::string whole;
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name one");
    act(history, *journal, "set_name two");
    whole = *readFile(journal->path());
  }
  const fs::path file = onlyJournal();
  const std::size_t actionsBegin = whole.find("\nset_name one") + 1;
  for (std::size_t size = 0; size < whole.size(); size += size + 40 < actionsBegin ? 13 : 1) {
    std::ofstream(file, std::ios::trunc) << whole.substr(0, size);
    const auto recovered = recover(file);
    EXPECT_EQ(recovered.has_value(), size >= actionsBegin) << size;
    if (!recovered) {
      EXPECT_NE(recovered.error().message.find("no journal that can be recovered"), std::string::npos);
    }
  }
}

TEST_F(JournalTest, SurvivesKillMinusNine) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    History history(plantOf(20));
    auto lock = ProjectLock::take(state_, project_);
    auto journal = Journal::begin(state_, {project_, folder_, contentHash(*readFile(project_))}, history);
    if (!lock || !journal) ::_exit(3);
    for (int i = 0; i < 100; ++i)
      if (!journal->append(Step{MoveClick{NodeId(1), "front", {{i * 1.0, 7}}}})) ::_exit(4);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
  const auto left = leftJournals(state_, project_);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].pid, child);
  const auto recovered = recover(left[0].file);
  ASSERT_TRUE(recovered);
  EXPECT_EQ(recovered->history.position(), 100u);
  EXPECT_EQ(recovered->history.project().nodes[0].node.clicks.at("front").px.x, 99);
  const auto lock = ProjectLock::take(state_, project_);
  ASSERT_TRUE(lock) << lock.error().message;
  EXPECT_TRUE(lock->wasStale());
}

TEST_F(JournalTest, AJournalOfALivingProcessIsNotLeft) {
  const History history(plantOf(20));
  History acted = history;
  auto journal = Journal::begin(state_, subject(), history);
  ASSERT_TRUE(journal);
  act(acted, *journal, "set_name one");
  EXPECT_TRUE(leftJournals(state_).empty());
  const auto recovered = recover(journal->path());
  ASSERT_FALSE(recovered);
  EXPECT_NE(recovered.error().message.find("open in another window"), std::string::npos);
}

TEST_F(JournalTest, DiscardedAndEmptyJournalsLeaveNothing) {
  History history(plantOf(20));
  { ASSERT_TRUE(Journal::begin(state_, subject(), history)); }
  EXPECT_TRUE(leftJournals(state_).empty());
  auto journal = Journal::begin(state_, subject(), history);
  ASSERT_TRUE(journal);
  act(history, *journal, "set_name one");
  journal->discard();
  EXPECT_TRUE(leftJournals(state_).empty());
  EXPECT_TRUE(fs::is_empty(state_ / "journals"));
}

TEST_F(JournalTest, UndoBehindASaveComesBackToo) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name one");
    act(history, *journal, "set_name two");
    ASSERT_TRUE(journal->noteSaving(projectText(history.project())));
    ASSERT_TRUE(saveProject(history.project(), project_));
    act(history, *journal, "undo");
  }
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  EXPECT_TRUE(recovered->faults.empty());
  EXPECT_EQ(recovered->history.project().name, "one");
  EXPECT_EQ(recovered->onDisk->name, "two");
  expectSame(recovered->history, history);
}

TEST_F(JournalTest, ACrashBetweenTheNoteAndTheSaveIsRecoveredAsWell) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name one");
    ASSERT_TRUE(journal->noteSaving(projectText(history.project())));
  }
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  EXPECT_TRUE(recovered->faults.empty());
  EXPECT_EQ(recovered->history.project().name, "one");
}

TEST_F(JournalTest, LinesThatNoLongerApplyToAChangedFileAreNamed) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name one");
    act(history, *journal, "move_click 5 front 1 2");
  }
  const auto changed = document::apply(plantOf(20), Step{RemoveStem{StemId(1)}, SetUnit{"cm"}});
  ASSERT_TRUE(changed);
  ASSERT_TRUE(saveProject(*changed, project_));
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  ASSERT_EQ(recovered->faults.size(), 2u);
  EXPECT_NE(recovered->faults[0].find("was changed by another program"), std::string::npos);
  EXPECT_NE(recovered->faults[1].find("there is no node 5"), std::string::npos) << recovered->faults[1];
  EXPECT_EQ(recovered->history.project().unit, "cm");
  EXPECT_EQ(recovered->history.project().name, "one");
}

TEST_F(JournalTest, AProjectWithoutAFileComesBackFromTheJournalsOwnCopy) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, {"", folder_, ""}, history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name \"not saved yet\"");
  }
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  expectSame(recovered->history, history);
  EXPECT_FALSE(recovered->onDisk);
}

TEST_F(JournalTest, ADamagedProjectFileDoesNotStandInTheWay) {
  History history(plantOf(20));
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    act(history, *journal, "set_name one");
  }
  std::ofstream(project_, std::ios::trunc) << "{ broken";
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  EXPECT_EQ(recovered->history.project().name, "one");
  ASSERT_EQ(recovered->faults.size(), 1u);
}

TEST_F(JournalTest, FilesThatAreNoJournalsAreLeftAlone) {
  fs::create_directories(state_ / "journals");
  std::ofstream(state_ / "journals" / "notes.journal") << "buy milk\n";
  std::ofstream(state_ / "journals" / "letter.txt") << "dear journal\n";
  EXPECT_TRUE(leftJournals(state_).empty());
  EXPECT_EQ(*readFile(state_ / "journals" / "notes.journal"), "buy milk\n");
  EXPECT_FALSE(recover(state_ / "journals" / "notes.journal"));
  EXPECT_FALSE(recover(state_ / "journals" / "nothing.journal"));
  EXPECT_FALSE(fs::exists(state_ / "journals" / "nothing.journal"));
}

TEST_F(JournalTest, TheSecondToOpenAProjectIsToldByWhomItIsOpen) {
  auto first = ProjectLock::take(state_, project_);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_FALSE(first->wasStale());
  const auto second = ProjectLock::take(state_, folder_ / "." / "plant.axil");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::BadInput);
  EXPECT_NE(second.error().message.find("(process " + std::to_string(::getpid()) + ")"), std::string::npos) << second.error().message;
  EXPECT_TRUE(ProjectLock::take(state_, folder_ / "other.axil"));
}

TEST_F(JournalTest, ALockGivenBackIsFreeAndNotStale) {
  { ASSERT_TRUE(ProjectLock::take(state_, project_)); }
  EXPECT_TRUE(fs::is_empty(state_ / "locks"));
  const auto again = ProjectLock::take(state_, project_);
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->wasStale());
}

TEST_F(JournalTest, AnotherProcessIsToldToo) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto lock = ProjectLock::take(state_, project_);
    const char answer = lock ? 'y' : 'n';
    if (::write(ready[1], &answer, 1) != 1) ::_exit(1);
    ::pause();
    ::_exit(0);
  }
  char answer = 0;
  ASSERT_EQ(::read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  const auto second = ProjectLock::take(state_, project_);
  EXPECT_FALSE(second);
  if (!second) {
    EXPECT_NE(second.error().message.find(std::to_string(child)), std::string::npos) << second.error().message;
  }
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  const auto third = ProjectLock::take(state_, project_);
  ASSERT_TRUE(third) << third.error().message;
  EXPECT_TRUE(third->wasStale());
}

TEST_F(JournalTest, AFolderThatCannotBeMadeIsOneClearError) {
  std::ofstream(folder_ / "file") << "x";
  const auto journal = Journal::begin(folder_ / "file", subject(), History(plantOf(20)));
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().code, ErrorCode::Unwritable);
  const auto lock = ProjectLock::take(folder_ / "file", project_);
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().code, ErrorCode::Unwritable);
}

// The limit on file sizes makes the system refuse to write on, as a full disk does.
TEST_F(JournalTest, ALineThatDidNotFitLeavesNoHalfBehind) {
  ::signal(SIGXFSZ, SIG_IGN);
  History history(plantOf(20));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  {
    auto journal = Journal::begin(state_, subject(), history);
    ASSERT_TRUE(journal);
    const rlimit full{fs::file_size(journal->path()) + 20, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
    const auto failed = journal->append(Step{SetName{std::string(100, 'x')}});
    ::setrlimit(RLIMIT_FSIZE, &before);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::Unwritable);
    act(history, *journal, "set_name one");
  }
  const auto recovered = recover(onlyJournal());
  ASSERT_TRUE(recovered);
  EXPECT_TRUE(recovered->faults.empty()) << recovered->faults.front();
  expectSame(recovered->history, history);
}

TEST(StateFolder, FollowsTheXdgVariableElseTheHomeFolder) {
  const char* before = std::getenv("XDG_STATE_HOME");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("XDG_STATE_HOME", "/somewhere", 1);
  EXPECT_EQ(*stateFolder(), "/somewhere/axil");
  ::setenv("XDG_STATE_HOME", "relative", 1);
  EXPECT_EQ(*stateFolder(), fs::path(std::getenv("HOME")) / ".local/state/axil");
  if (before != nullptr) ::setenv("XDG_STATE_HOME", kept.c_str(), 1);
  else ::unsetenv("XDG_STATE_HOME");
}

}  // namespace
}  // namespace axil::document
