#pragma once
/// \file
/// FileLock: one process at a time holds a file. The system lets go of it when the process ends, however it ends, so no lock
/// outlives its holder; what the holder wrote into the file stays, and tells the next one that it did not end in order.

#include "base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace axil::document {

class FileLock {
 public:
  /// Takes the lock on `path`, making the file and its folder where they are missing. Nothing: somebody holds it, in this process or
  /// another. Fails with Unwritable where the file cannot be made.
  [[nodiscard]] static Result<std::optional<FileLock>> take(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// What is in the file.
  [[nodiscard]] Result<std::string> content() const;
  /// Adds to its end, whole or not at all; it is with the system when this returns.
  [[nodiscard]] Result<void> append(std::string_view bytes) const;
  [[nodiscard]] Result<void> replaceContent(std::string_view bytes) const;
  /// Moves the held file to another name in the same folder.
  [[nodiscard]] Result<void> rename(const std::filesystem::path& to);
  /// Deletes the file and lets go.
  void remove();

 private:
  FileLock(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  void close();

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace axil::document
