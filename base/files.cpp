#include "base/files.hpp"

#include "base/file_writer.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace axil {

namespace fs = std::filesystem;

namespace {

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

fs::path asideOf(const fs::path& path) { return path.string() + ".part" + std::to_string(::getpid()); }

Failure unwritable(const fs::path& path, const std::string& why) {
  return fail(ErrorCode::Unwritable, "cannot write " + quoted(path) + ": " + why + "; make room there or choose a folder you may write to");
}

Result<void> makeFolder(const fs::path& folder) {
  if (folder.empty()) return {};
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return unwritable(folder, code.message());
  return {};
}

}  // namespace

Result<std::string> readFile(const fs::path& path, std::uintmax_t limitBytes) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) return fail(ErrorCode::NotFound, "there is no file " + quoted(path));
  if (fs::is_directory(status)) return fail(ErrorCode::Unreadable, quoted(path) + " is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::Unreadable, "cannot read " + quoted(path) + ": " + std::strerror(errno));
  std::string content;
  char buffer[1 << 16];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0) {
    content.append(buffer, static_cast<std::size_t>(file.gcount()));
    if (content.size() > limitBytes)
      return fail(ErrorCode::LimitReached, quoted(path) + " is larger than the limit of " + std::to_string(limitBytes) + " bytes");
  }
  return content;
}

FileWriter::FileWriter(fs::path path) : path_(std::move(path)), aside_(asideOf(path_)), state_(makeFolder(path_.parent_path())) {
  if (!state_) return;
  file_.open(aside_, std::ios::binary | std::ios::trunc);
  if (!file_) state_ = unwritable(path_, std::strerror(errno));
}

FileWriter::~FileWriter() {
  if (!file_.is_open()) return;
  file_.close();
  std::error_code ignored;
  fs::remove(aside_, ignored);
}

void FileWriter::write(std::string_view piece) {
  if (!state_) return;
  file_.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  if (!file_) state_ = unwritable(path_, std::strerror(errno));
}

Result<void> FileWriter::finish() {
  if (!state_) return state_;
  file_.close();
  std::error_code code;
  if (!file_) state_ = unwritable(path_, std::strerror(errno));
  else if (fs::rename(aside_, path_, code); code) state_ = unwritable(path_, code.message());
  std::error_code ignored;
  if (!state_) fs::remove(aside_, ignored);
  return state_;
}

Result<void> writeFile(const fs::path& path, std::string_view content) {
  FileWriter file(path);
  file.write(content);
  return file.finish();
}

StagingFolder::StagingFolder(fs::path target, fs::path staging) : target_(std::move(target)), staging_(std::move(staging)) {}

StagingFolder::StagingFolder(StagingFolder&& other) noexcept
    : target_(std::move(other.target_)), staging_(std::exchange(other.staging_, {})) {}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

Result<StagingFolder> StagingFolder::beside(const fs::path& target) {
  std::error_code code;
  const fs::path whole = fs::absolute(target, code).lexically_normal();
  const fs::path plain = whole.has_filename() ? whole : whole.parent_path();
  if (fs::exists(plain, code) && !fs::is_directory(plain, code)) return unwritable(target, "it is a file, not a folder");
  // A target that exists must itself be writable, though the staging folder stands beside it.
  if (fs::exists(plain, code) && ::access(plain.c_str(), W_OK) != 0) return unwritable(target, std::strerror(errno));
  const fs::path staging = asideOf(plain);
  fs::create_directories(staging, code);
  if (code) return unwritable(target, code.message());  // who asked knows nothing of the folder beside it
  return StagingFolder(plain, staging);
}

Result<void> StagingFolder::publish() {
  std::error_code code;
  if (!fs::exists(target_, code)) {
    fs::rename(staging_, target_, code);
    if (code) return unwritable(target_, code.message());
    staging_.clear();
    return {};
  }
  for (const auto& entry : fs::recursive_directory_iterator(staging_, code)) {
    const fs::path place = target_ / entry.path().lexically_relative(staging_);
    if (entry.is_directory()) fs::create_directories(place, code);
    else fs::rename(entry.path(), place, code);
    if (code) return unwritable(place, code.message());
  }
  return {};
}

}  // namespace axil
