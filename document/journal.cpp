#include "document/journal.hpp"

#include "base/files.hpp"
#include "document/command_words.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <unistd.h>

namespace axil::document {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTitle = "axil-journal 1";
constexpr std::string_view kSaving = "# saving ";
constexpr const char* kEnding = ".journal";
constexpr const char* kUnfinished = ".unfinished";  // while its beginning is written; such a file never holds an action

fs::path absolutely(const fs::path& path) {
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(path, code);
  return code ? fs::absolute(path).lexically_normal() : whole;
}

fs::path journalsOf(const fs::path& stateFolder) { return stateFolder / "journals"; }

std::string plainName(const fs::path& project) { return project.empty() ? "untitled" : contentHash(absolutely(project).string()); }

// ---- writing ---------------------------------------------------------------------------------------------------------

void removeIfLeft(const fs::path& file) {
  if (auto lock = FileLock::take(file); lock && *lock) (*lock)->remove();
}

std::string headerText(const JournalSubject& subject, const std::string& base) {
  std::string text(kTitle);
  text += "\npid " + std::to_string(::getpid());
  text += "\nproject " + asWord(subject.project.string());
  text += "\nfolder " + asWord(subject.folder.string());
  text += "\nsaved " + asWord(subject.savedHash);
  text += "\nbase " + std::to_string(base.size()) + "\n" + base + "\n";
  return text;
}

std::string historyLines(const History& history) {
  std::string lines;
  for (std::size_t i = 1; i < history.entries().size(); ++i) lines += printAction(history.entries()[i].step) + "\n";
  const std::size_t undone = history.entries().size() - 1 - history.position();
  if (undone > 0) lines += printAction(Undo{undone}) + "\n";
  return lines;
}

/// A name in `folder` that no file has yet.
Result<FileLock> freshFile(const fs::path& folder, const std::string& stem) {
  for (int n = 0; n < 10'000; ++n) {
    const fs::path path = folder / (stem + "-" + std::to_string(::getpid()) + "-" + std::to_string(n) + kEnding);
    std::error_code ignored;
    if (fs::exists(path, ignored)) continue;
    auto lock = FileLock::take(path.string() + kUnfinished);
    if (!lock) return lock.failure();
    if (*lock) return std::move(**lock);
  }
  return fail(ErrorCode::Unwritable, "there are too many journals in '" + folder.string() + "'; recover or delete them");
}

// ---- reading ---------------------------------------------------------------------------------------------------------

/// A journal's text taken apart. `lines` are those that were written whole.
struct Parts {
  JournalSubject subject;
  long pid = 0;
  std::string_view base;
  std::string_view lines;
};

/// The rest of the first line when it begins with `key`, and the text without it.
std::optional<std::string> takeLine(std::string_view& text, std::string_view key) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const auto words = cutLine(text.substr(0, end));
  text.remove_prefix(end + 1);
  if (!words || words->size() != 1 || words->front().size() != 2 || words->front()[0].whole() != key) return std::nullopt;
  return words->front()[1].whole();
}

template <class Number>
std::optional<Number> numberIn(const std::optional<std::string>& text) {
  Number value = 0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ptr != text->data() + text->size()) return std::nullopt;
  return value;
}

std::optional<Parts> partsOf(std::string_view text) {
  if (!text.starts_with(kTitle) || text.size() <= kTitle.size()) return std::nullopt;
  text.remove_prefix(kTitle.size() + 1);
  Parts parts;
  const auto pid = numberIn<long>(takeLine(text, "pid"));
  const auto project = takeLine(text, "project");
  const auto folder = takeLine(text, "folder");
  const auto saved = takeLine(text, "saved");
  const auto size = numberIn<std::size_t>(takeLine(text, "base"));
  if (!pid || !project || !folder || !saved || !size || text.size() <= *size) return std::nullopt;
  parts.pid = *pid;
  parts.subject = {*project, *folder, *saved};
  parts.base = text.substr(0, *size);
  const std::string_view rest = text.substr(*size + 1);
  const std::size_t last = rest.rfind('\n');
  parts.lines = last == std::string_view::npos ? std::string_view() : rest.substr(0, last + 1);
  return parts;
}

Failure noJournal(const fs::path& file) {
  return fail(ErrorCode::Unreadable, "'" + file.string() + "' is no journal that can be recovered; its beginning is missing or damaged");
}

bool isMark(std::string_view line) { return line.starts_with('#'); }

std::vector<std::string_view> linesIn(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

/// The hashes that the file has had while the journal was written.
std::vector<std::string_view> knownHashes(const Parts& parts) {
  std::vector<std::string_view> hashes{parts.subject.savedHash};
  for (const std::string_view line : linesIn(parts.lines))
    if (line.starts_with(kSaving)) hashes.push_back(line.substr(kSaving.size()));
  return hashes;
}

std::string_view sinceLastSave(std::string_view lines) {
  std::string_view since = lines;
  for (std::size_t begin = 0; begin < lines.size(); begin = lines.find('\n', begin) + 1)
    if (lines.substr(begin).starts_with(kSaving)) since = lines.substr(lines.find('\n', begin) + 1);
  return since;
}

// ---- recovering ------------------------------------------------------------------------------------------------------

/// The project's file as it is now.
struct Disk {
  std::optional<Project> project;
  std::string hash;
};

Disk diskOf(const fs::path& path) {
  if (path.empty()) return {};
  const auto bytes = readFile(path);
  if (!bytes) return {};
  auto project = parseProject(*bytes);
  return {project ? std::optional(std::move(*project)) : std::nullopt, contentHash(*bytes)};
}

bool knows(const Parts& parts, const Disk& disk) {
  const auto hashes = knownHashes(parts);
  return disk.hash.empty() || std::find(hashes.begin(), hashes.end(), disk.hash) != hashes.end();
}

Result<Replayed> replayed(const Parts& parts, const Disk& disk, const fs::path& file) {
  if (disk.project && !knows(parts, disk)) {
    Replayed onto = replayWhatApplies(*disk.project, sinceLastSave(parts.lines));
    onto.faults.insert(onto.faults.begin(), "'" + parts.subject.project.string() + "' was changed by another program meanwhile; what was not saved is replayed onto it");
    return onto;
  }
  const auto base = parseProject(parts.base);
  if (!base) return noJournal(file);
  Replayed all = replayWhatApplies(*base, parts.lines);
  if (!knows(parts, disk)) all.faults.insert(all.faults.begin(), "'" + parts.subject.project.string() + "' can no longer be read as a project; the journal's own copy is used");
  return all;
}

Failure openElsewhere(const fs::path& project, const fs::path& lock) {
  const auto holder = readFile(lock);
  const std::string pid = holder ? holder->substr(0, holder->find(' ')) : "";
  return fail(ErrorCode::BadInput, "'" + project.string() + "' is open in another window" + (pid.empty() ? "" : " (process " + pid + ")") +
                                       "; close it there, or open a copy");
}

}  // namespace

Result<fs::path> stateFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) return fs::path(state) / "axil";  // a relative one does not count, says the XDG specification
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return fs::path(home) / ".local" / "state" / "axil";
  return fail(ErrorCode::NotFound, "neither XDG_STATE_HOME nor HOME says where the program may keep its journal; set one of them");
}

// FNV-1a, 64 bits: tells versions of one file apart; nobody is to be kept from forging it.
std::string contentHash(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += digits[(hash >> shift) & 15];
  return text;
}

Result<Journal> Journal::begin(const fs::path& stateFolder, const JournalSubject& subject, const History& history) {
  auto file = freshFile(journalsOf(stateFolder), plainName(subject.project));
  if (!file) return file.failure();
  JournalSubject whole = subject;
  if (!whole.project.empty()) whole.project = absolutely(whole.project);
  const std::string text = headerText(whole, projectText(*history.entries().front().after)) + historyLines(history);
  if (auto written = file->append(text); !written) {
    file->remove();
    return written.failure();
  }
  const std::string finished = file->path().string();
  if (auto renamed = file->rename(finished.substr(0, finished.size() - std::string_view(kUnfinished).size())); !renamed) return renamed.failure();
  return Journal(std::move(*file));
}

Result<void> Journal::append(const Action& action) { return file_.append(printAction(action) + "\n"); }

Result<void> Journal::noteSaving(std::string_view bytes) { return file_.append(std::string(kSaving) + contentHash(bytes) + "\n"); }

std::vector<LeftJournal> leftJournals(const fs::path& stateFolder, const fs::path& project) {
  std::vector<LeftJournal> left;
  std::error_code code;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(journalsOf(stateFolder), code))
    if (entry.path().extension() == kEnding) files.push_back(entry.path());
    else if (entry.path().extension() == kUnfinished) removeIfLeft(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    auto lock = FileLock::take(file);
    if (!lock || !*lock) continue;  // its process is alive
    const auto text = (*lock)->content();
    const auto parts = text ? partsOf(*text) : std::nullopt;
    if (!parts) continue;
    if (!project.empty() && parts->subject.project != absolutely(project)) continue;
    const auto lines = linesIn(parts->lines);
    const auto actions = static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [](std::string_view line) { return !isMark(line); }));
    if (actions == 0) (*lock)->remove();
    else left.push_back({file, parts->subject, parts->pid, fs::last_write_time(file, code), actions});
  }
  std::stable_sort(left.begin(), left.end(), [](const LeftJournal& a, const LeftJournal& b) { return a.lastWritten > b.lastWritten; });
  return left;
}

Result<Recovered> recover(const fs::path& journal) {
  std::error_code code;
  if (!fs::exists(journal, code)) return fail(ErrorCode::NotFound, "there is no journal '" + journal.string() + "'");
  auto lock = FileLock::take(journal);
  if (!lock) return lock.failure();
  if (!*lock) return fail(ErrorCode::BadInput, "the work in '" + journal.string() + "' is open in another window; go on there");
  const auto text = (*lock)->content();
  if (!text) return text.failure();
  const auto parts = partsOf(*text);
  if (!parts) return noJournal(journal);
  Disk disk = diskOf(parts->subject.project);
  auto work = replayed(*parts, disk, journal);
  if (!work) return work.failure();
  return Recovered{parts->subject, std::move(work->history), std::move(work->faults), std::move(disk.project), std::move(disk.hash), std::move(**lock)};
}

Result<ProjectLock> ProjectLock::take(const fs::path& stateFolder, const fs::path& project) {
  const fs::path path = stateFolder / "locks" / (plainName(project) + ".lock");
  auto lock = FileLock::take(path);
  if (!lock) return lock.failure();
  if (!*lock) return openElsewhere(project, path);
  const auto before = (*lock)->content();
  const std::string holder = std::to_string(::getpid()) + " " + asWord(absolutely(project).string()) + "\n";
  if (auto written = (*lock)->replaceContent(holder); !written) return written.failure();
  return ProjectLock(std::move(**lock), before && !before->empty());
}

ProjectLock& ProjectLock::operator=(ProjectLock&& other) noexcept {
  if (this == &other) return *this;
  file_.remove();
  file_ = std::move(other.file_);
  wasStale_ = other.wasStale_;
  return *this;
}

}  // namespace axil::document
