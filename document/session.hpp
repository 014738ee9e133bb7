#pragma once
/// \file
/// Session: one project open in one window, or in a headless replay: its history, its file, its journal, and what follows from it.
///
/// The user's file changes when `save` is called and never otherwise. Every action is in the journal before its call returns. Where no
/// journal can be kept (a full disk, a folder nobody may write to) work goes on and `journalTrouble` says so. A session that is only
/// destroyed leaves its journal behind, as a crash does; `close` ends it in order.

#include "document/derived.hpp"
#include "document/journal.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace axil::document {

enum class IfOpenElsewhere {
  Refuse,
  OpenAnyway,  ///< `openElsewhere` says where; saving still notices a file that changed
};
enum class IfChangedOnDisk { Refuse, Overwrite };

struct SessionOptions {
  std::filesystem::path stateFolder;  ///< for journal and lock; empty: neither is kept (headless replays)
  IfOpenElsewhere ifOpenElsewhere = IfOpenElsewhere::Refuse;
  ChainOptions chain = {};
};

class Session {
 public:
  /// Opens a project's file. Fails as loadProject does, and with BadInput where it is open elsewhere.
  [[nodiscard]] static Result<Session> open(const std::filesystem::path& path, const SessionOptions& options);
  /// A project without a file. Relative photo paths, if it has any, start at `folder`.
  [[nodiscard]] static Session untitled(const SessionOptions& options, Project initial = {}, std::filesystem::path folder = {});
  /// Goes on with recovered work; its journal is replaced by this session's own. Fails with BadInput where the project is open elsewhere.
  [[nodiscard]] static Result<Session> resume(Recovered recovered, const SessionOptions& options);

  Session(Session&&) noexcept = default;
  Session& operator=(Session&&) noexcept = default;

  // ---- what the user said --------------------------------------------------------------------------------------------

  [[nodiscard]] const Project& project() const { return history_.project(); }
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] OpenProject openProject() const { return {history_.project(), folder_}; }

  /// The one door; fails as History::run does.
  [[nodiscard]] Result<History::Ran> run(Step step);
  [[nodiscard]] Result<History::Ran> run(const Command& command) { return run(Step{command}); }
  [[nodiscard]] Result<History::Ran> runLine(std::string_view line);
  [[nodiscard]] Result<void> undo(std::size_t steps = 1);
  [[nodiscard]] Result<void> redo(std::size_t steps = 1);
  [[nodiscard]] Result<void> goTo(std::size_t position);
  /// Every line of a saved session (document/replay.hpp). Fails at the first that cannot be done; those before it stay done.
  [[nodiscard]] Result<void> replayLines(std::string_view lines);

  // ---- its file ------------------------------------------------------------------------------------------------------

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  ///< empty: no file yet
  [[nodiscard]] bool isDirty() const;
  /// Fails with Unwritable, or with BadInput where the project has no file yet or the file is not as this session last saw it.
  [[nodiscard]] Result<void> save(IfChangedOnDisk ifChanged = IfChangedOnDisk::Refuse);
  /// Saves under another name and goes on there. Photos are found from the new place: inside its folder by relative paths, else absolutely.
  [[nodiscard]] Result<void> saveAs(const std::filesystem::path& path);
  /// Nothing is left to recover: everything is saved, or the user gave it up.
  void close();

  [[nodiscard]] const std::optional<Error>& journalTrouble() const { return journalTrouble_; }
  [[nodiscard]] const std::optional<Error>& openElsewhere() const { return openElsewhere_; }
  /// Whether whoever had the project open last is gone without closing it.
  [[nodiscard]] bool foundStaleLock() const { return lock_ && lock_->wasStale(); }

  // ---- what follows --------------------------------------------------------------------------------------------------

  [[nodiscard]] const Shown<keywords::Traits>& traits() { return derived_->traits(project()); }
  [[nodiscard]] const Shown<Measured>& measured() { return derived_->measured(openProject()); }
  [[nodiscard]] const Shown<skeleton3d::Skeleton>& skeleton() { return derived_->skeleton(openProject()); }
  [[nodiscard]] const Shown<quantify::Measurements>& measurements() { return derived_->measurements(openProject()); }
  [[nodiscard]] const Shown<simeco::Grammar>& grammar(GrammarKind kind) { return derived_->grammar(openProject(), kind); }
  [[nodiscard]] const Shown<std::string>& grammarText(GrammarKind kind) { return derived_->grammarText(openProject(), kind); }
  [[nodiscard]] std::vector<PhotoTrouble> photoTroubles() { return derived_->photoTroubles(openProject()); }
  [[nodiscard]] const Derived& derived() const { return *derived_; }

 private:
  Session(History history, std::filesystem::path folder, const SessionOptions& options);
  Result<void> lockFile();
  void beginJournal();
  void note(const Action& action);
  Result<void> checkUnchanged() const;
  Result<void> write(const std::filesystem::path& path, const Project& project);

  History history_;
  std::filesystem::path path_;
  std::filesystem::path folder_;              // what photo paths in memory are relative to; stays when the project is saved elsewhere
  std::shared_ptr<const Project> saved_;      // as the file has it; null: there is no file
  std::string savedHash_;
  SessionOptions options_;
  std::optional<ProjectLock> lock_;
  std::optional<Journal> journal_;
  std::optional<Error> journalTrouble_;
  std::optional<Error> openElsewhere_;
  std::unique_ptr<Derived> derived_;
};

/// `project` with photo paths that were relative to `from` as they must be in a file in the folder `to`.
[[nodiscard]] Project withPhotosFrom(const Project& project, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace axil::document
