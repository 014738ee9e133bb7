#pragma once
/// \file
/// Journal: every action on a project, written down at once in a file of the program's own, so that a crash or `kill -9` loses at
/// most the action in flight. The user's file is never touched. A journal holds the project as the history began with it and one
/// line an action (document/replay.hpp), so it brings back the whole history; a line that was cut off in the middle does not count.
///
/// A journal that is left behind by a process that is gone can be recovered. Where the project's file is as that process knew it (as
/// it was opened, or saved since), or is gone, all comes back exactly. Where somebody else has changed the file, the lines since the
/// last save are replayed onto what it says now, and those that no longer apply are named.
///
/// Journals and locks live in the state folder: `$XDG_STATE_HOME/axil`, else `~/.local/state/axil`. What is written is with the
/// operating system when a call returns; it survives the program, not a loss of power.

#include "base/result.hpp"
#include "document/file_lock.hpp"
#include "document/replay.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::document {

/// Fails with NotFound where neither XDG_STATE_HOME nor HOME names a folder.
[[nodiscard]] Result<std::filesystem::path> stateFolder();

/// 16 hex digits that say whether two files are the same.
[[nodiscard]] std::string contentHash(std::string_view bytes);

/// Which project a journal belongs to.
struct JournalSubject {
  std::filesystem::path project;  ///< absolute; empty: it has no file yet
  std::filesystem::path folder;   ///< what its photo paths are relative to
  std::string savedHash;          ///< of the file's bytes when it was opened or saved; empty: it has no file yet
  friend bool operator==(const JournalSubject&, const JournalSubject&) = default;
};

class Journal {
 public:
  /// A new journal that holds all of `history`. Fails with Unwritable.
  [[nodiscard]] static Result<Journal> begin(const std::filesystem::path& stateFolder, const JournalSubject& subject, const History& history);

  /// Fails with Unwritable (a full disk); the journal then ends with the last action that was written whole.
  [[nodiscard]] Result<void> append(const Action& action);
  /// Before a save: the file will have these bytes from now on.
  [[nodiscard]] Result<void> noteSaving(std::string_view bytes);
  /// The work is saved or given up: nothing is left to recover. A journal that is only destroyed stays, as after a crash.
  void discard() { file_.remove(); }

  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

 private:
  explicit Journal(FileLock file) : file_(std::move(file)) {}
  FileLock file_;
};

/// A journal whose process is gone.
struct LeftJournal {
  std::filesystem::path file;
  JournalSubject subject;
  long pid = 0;                                  ///< of the process that wrote it
  std::filesystem::file_time_type lastWritten;
  std::size_t actions = 0;
};

/// The journals that nobody writes any more, the latest first; for one project or, with an empty path, all. Journals that hold no
/// action are deleted on the way; files that are no journals are left alone.
[[nodiscard]] std::vector<LeftJournal> leftJournals(const std::filesystem::path& stateFolder, const std::filesystem::path& project = {});

struct Recovered {
  JournalSubject subject;
  History history;
  std::vector<std::string> faults;     ///< lines that no longer apply, and what else was noticed; empty: all came back
  std::optional<Project> onDisk;       ///< what the file says now
  std::string diskHash;                ///< of its bytes; empty: there is no file
  FileLock journal;                    ///< held: nobody else recovers it meanwhile; remove() it when the work is safe
};

/// Fails with NotFound, Unreadable (not a journal, or damaged before its first action) or BadInput (its process is alive).
[[nodiscard]] Result<Recovered> recover(const std::filesystem::path& journal);

/// The right to edit a project's file, held by one process.
class ProjectLock {
 public:
  /// Fails with BadInput where the project is open elsewhere, naming the process; with Unwritable where no lock can be made.
  [[nodiscard]] static Result<ProjectLock> take(const std::filesystem::path& stateFolder, const std::filesystem::path& project);
  /// Whether the last holder was gone without giving the lock back: there may be a journal to recover.
  [[nodiscard]] bool wasStale() const { return wasStale_; }

  ProjectLock(ProjectLock&&) noexcept = default;
  ProjectLock& operator=(ProjectLock&& other) noexcept;
  ~ProjectLock() { file_.remove(); }

 private:
  ProjectLock(FileLock file, bool wasStale) : file_(std::move(file)), wasStale_(wasStale) {}
  FileLock file_;
  bool wasStale_ = false;
};

}  // namespace axil::document
