#pragma once
/// \file
/// Reading whole files, and writing so that nothing is ever half written: a new file is written beside its place and
/// renamed into it.

#include "base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace axil {

/// Bytes of a file. Fails with NotFound, Unreadable (a folder, no permission) or LimitReached (larger than `limitBytes`).
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path, std::uintmax_t limitBytes = std::uintmax_t{1} << 30);

/// Writes `content` to `path`: aside, then renamed. Missing folders are made. On failure `path` is as it was.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view content);

/// A folder beside `target` to fill; `publish` moves what is in it into `target`, file by file, and the destructor removes
/// what was not published. So a command that fails leaves its output folder as it found it.
class StagingFolder {
 public:
  [[nodiscard]] static Result<StagingFolder> beside(const std::filesystem::path& target);
  StagingFolder(StagingFolder&& other) noexcept;
  StagingFolder& operator=(StagingFolder&&) = delete;
  ~StagingFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return staging_; }
  [[nodiscard]] Result<void> publish();

 private:
  StagingFolder(std::filesystem::path target, std::filesystem::path staging);
  std::filesystem::path target_;
  std::filesystem::path staging_;
};

}  // namespace axil
