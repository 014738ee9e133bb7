#include "document/session.hpp"

#include "base/files.hpp"

namespace axil::document {

namespace fs = std::filesystem;

namespace {

fs::path absolutely(const fs::path& path) {
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, code), code);
  return code ? fs::absolute(path).lexically_normal() : whole;
}

bool isInside(const fs::path& relative) { return !relative.empty() && *relative.begin() != ".."; }

/// The file's bytes; nothing where there is no file.
Result<std::optional<std::string>> bytesOf(const fs::path& path) {
  const auto bytes = readFile(path);
  if (bytes) return std::optional(*bytes);
  if (bytes.error().code == ErrorCode::NotFound) return std::optional<std::string>();
  return bytes.failure();
}

}  // namespace

Project withPhotosFrom(const Project& project, const fs::path& from, const fs::path& to) {
  const fs::path here = absolutely(from), there = absolutely(to);
  Project moved = project;
  if (here == there) return moved;
  for (std::size_t i = 0; i < project.views.size(); ++i) {
    ProjectView view = project.views[i];
    if (view.photo.empty()) continue;
    const fs::path photo(view.photo);
    const fs::path whole = photo.is_absolute() ? photo : absolutely(here / photo);
    const fs::path near = whole.lexically_relative(there);
    view.photo = isInside(near) ? near.generic_string() : whole.string();
    if (view.photo != project.views[i].photo) moved.views.set(i, std::move(view));
  }
  return moved;
}

Session::Session(History history, fs::path folder, const SessionOptions& options)
    : history_(std::move(history)), folder_(std::move(folder)), options_(options), derived_(std::make_unique<Derived>(options.chain)) {}

Result<Session> Session::open(const fs::path& path, const SessionOptions& options) {
  const fs::path whole = absolutely(path);
  auto loaded = loadProject(whole);
  if (!loaded) return loaded.failure();
  const auto bytes = readFile(whole);
  if (!bytes) return bytes.failure();
  Session session(History(std::move(loaded->project)), loaded->folder, options);
  session.path_ = whole;
  session.saved_ = session.history_.snapshot();
  session.savedHash_ = contentHash(*bytes);
  if (auto locked = session.lockFile(); !locked) return locked.failure();
  return session;
}

Session Session::untitled(const SessionOptions& options, Project initial, fs::path folder) {
  return Session(History(std::move(initial)), absolutely(folder.empty() ? fs::path(".") : folder), options);
}

Result<Session> Session::resume(Recovered recovered, const SessionOptions& options) {
  Session session(std::move(recovered.history), recovered.subject.folder, options);
  session.path_ = recovered.subject.project;
  if (recovered.onDisk) session.saved_ = std::make_shared<const Project>(std::move(*recovered.onDisk));
  session.savedHash_ = recovered.diskHash;
  if (auto locked = session.lockFile(); !locked) return locked.failure();
  session.beginJournal();
  if (session.journal_) recovered.journal.remove();
  return session;
}

// ---- journal and lock ------------------------------------------------------------------------------------------------

Result<void> Session::lockFile() {
  if (options_.stateFolder.empty() || path_.empty()) return {};
  auto lock = ProjectLock::take(options_.stateFolder, path_);
  if (lock) {
    lock_.emplace(std::move(*lock));
    return {};
  }
  if (lock.error().code == ErrorCode::Unwritable) {
    journalTrouble_ = lock.error();
    return {};
  }
  if (options_.ifOpenElsewhere == IfOpenElsewhere::Refuse) return lock.failure();
  openElsewhere_ = lock.error();
  return {};
}

void Session::beginJournal() {
  if (options_.stateFolder.empty()) return;
  auto journal = Journal::begin(options_.stateFolder, {path_, folder_, savedHash_}, history_);
  journalTrouble_ = journal ? std::nullopt : std::optional(journal.error());
  if (journal) journal_.emplace(std::move(*journal));
}

// A project that is only looked at leaves no journal; the first action begins one. After a failure the journal that was kept so far
// stays as it is, and each further action tries to begin one that has everything.
void Session::note(const Action& action) {
  if (journal_ && !journalTrouble_) {
    if (const auto written = journal_->append(action); !written) journalTrouble_ = written.error();
    return;
  }
  std::optional<Journal> behind = std::exchange(journal_, std::nullopt);
  beginJournal();
  if (behind && journal_) behind->discard();
  if (behind && !journal_) journal_ = std::move(behind);
}

// ---- actions ---------------------------------------------------------------------------------------------------------

Result<History::Ran> Session::run(Step step) {
  const auto ran = history_.run(step);
  if (ran && *ran == History::Ran::Changed) note(std::move(step));
  return ran;
}

Result<History::Ran> Session::runLine(std::string_view line) {
  const auto action = parseAction(line);
  if (!action) return action.failure();
  if (const Step* step = std::get_if<Step>(&*action)) return run(*step);
  const auto moved = perform(history_, *action);
  if (moved) note(*action);
  return moved;
}

Result<void> Session::undo(std::size_t steps) {
  const auto moved = history_.undo(steps);
  if (moved && steps > 0) note(Undo{steps});
  return moved;
}

Result<void> Session::redo(std::size_t steps) {
  const auto moved = history_.redo(steps);
  if (moved && steps > 0) note(Redo{steps});
  return moved;
}

Result<void> Session::goTo(std::size_t position) {
  const std::size_t now = history_.position();
  if (position < now) return undo(now - position);
  if (position > now && position < history_.entries().size()) return redo(position - now);
  return history_.goTo(position);
}

Result<void> Session::replayLines(std::string_view lines) {
  for (const NumberedLine& line : linesThatCount(lines))
    if (const auto done = runLine(line.text); !done) return fail(done.error().code, inLine(line, done.error()));
  return {};
}

// ---- the file --------------------------------------------------------------------------------------------------------

bool Session::isDirty() const { return saved_ ? !(*saved_ == project()) : !(project() == *history_.entries().front().after); }

Result<void> Session::checkUnchanged() const {
  const auto bytes = bytesOf(path_);
  if (!bytes) return bytes.failure();
  if (!*bytes || contentHash(**bytes) == savedHash_) return {};
  return fail(ErrorCode::BadInput, "'" + path_.string() + "' was changed by another program since it was opened; save under another name, or overwrite it");
}

Result<void> Session::write(const fs::path& path, const Project& project) {
  const std::string text = projectText(project);
  if (journal_)
    if (auto noted = journal_->noteSaving(text); !noted) journalTrouble_ = noted.error();
  if (auto written = writeFile(path, text); !written) return written;
  savedHash_ = contentHash(text);
  saved_ = history_.snapshot();
  return {};
}

Result<void> Session::save(IfChangedOnDisk ifChanged) {
  if (path_.empty()) return fail(ErrorCode::BadInput, "the project has no file yet; save it under a name");
  if (ifChanged == IfChangedOnDisk::Refuse)
    if (auto unchanged = checkUnchanged(); !unchanged) return unchanged;
  return write(path_, withPhotosFrom(project(), folder_, path_.parent_path()));
}

Result<void> Session::saveAs(const fs::path& path) {
  const fs::path whole = absolutely(path);
  if (whole == path_) return save(IfChangedOnDisk::Overwrite);
  std::optional<ProjectLock> lock;
  if (!options_.stateFolder.empty()) {
    auto taken = ProjectLock::take(options_.stateFolder, whole);
    if (!taken && taken.error().code != ErrorCode::Unwritable) return taken.failure();
    if (taken) lock.emplace(std::move(*taken));
  }
  if (auto written = write(whole, withPhotosFrom(project(), folder_, whole.parent_path())); !written) return written;
  path_ = whole;
  openElsewhere_.reset();
  lock_ = std::move(lock);
  std::optional<Journal> before = std::exchange(journal_, std::nullopt);
  if (before) beginJournal();
  if (before && journal_) before->discard();
  if (before && !journal_) journal_ = std::move(before);
  return {};
}

void Session::close() {
  if (journal_) journal_->discard();
  journal_.reset();
  lock_.reset();
}

}  // namespace axil::document
