#include "document/file_lock.hpp"

#include "base/files.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axil::document {

namespace fs = std::filesystem;

namespace {

Failure unwritable(const fs::path& path, const std::string& why) { return fail(ErrorCode::Unwritable, "cannot write '" + path.string() + "': " + why); }

/// Whether the open file is still the one that stands under `path`: its last holder may have deleted it meanwhile.
bool standsAt(int file, const fs::path& path) {
  struct stat open {}, there {};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino && open.st_dev == there.st_dev;
}

}  // namespace

Result<std::optional<FileLock>> FileLock::take(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path.parent_path(), code);
  if (code) return unwritable(path, code.message());
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0) return unwritable(path, std::strerror(errno));
    FileLock lock(path, file);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return std::optional<FileLock>();
      return unwritable(path, std::strerror(errno));
    }
    if (standsAt(file, path)) return std::optional<FileLock>(std::move(lock));
  }
  return unwritable(path, "it is deleted again and again");
}

FileLock::FileLock(FileLock&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  if (this == &other) return *this;
  close();
  path_ = std::move(other.path_);
  file_ = std::exchange(other.file_, -1);
  return *this;
}

FileLock::~FileLock() { close(); }

void FileLock::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

Result<std::string> FileLock::content() const { return readFile(path_); }

Result<void> FileLock::append(std::string_view bytes) const {
  const off_t before = ::lseek(file_, 0, SEEK_END);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const std::string why = written < 0 ? std::strerror(errno) : "nothing could be written";
      if (before < 0 || ::ftruncate(file_, before) != 0) return unwritable(path_, why + ", and its end is damaged");
      return unwritable(path_, why);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> FileLock::replaceContent(std::string_view bytes) const {
  if (::ftruncate(file_, 0) != 0) return unwritable(path_, std::strerror(errno));
  return append(bytes);
}

Result<void> FileLock::rename(const fs::path& to) {
  std::error_code code;
  fs::rename(path_, to, code);
  if (code) return unwritable(to, code.message());
  path_ = to;
  return {};
}

void FileLock::remove() {
  std::error_code ignored;
  if (file_ >= 0) fs::remove(path_, ignored);
  close();
}

}  // namespace axil::document
