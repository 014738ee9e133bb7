#pragma once
/// \file
/// A file written piece by piece, for one that is too large to be held: aside, and renamed into its place by `finish`. After a failure
/// further pieces are dropped, and `finish` says what failed. Without `finish` nothing is left behind.

#include "base/result.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>

namespace axil {

class FileWriter {
 public:
  explicit FileWriter(std::filesystem::path path);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter();

  void write(std::string_view piece);
  [[nodiscard]] Result<void> finish();

 private:
  std::filesystem::path path_;
  std::filesystem::path aside_;
  std::ofstream file_;
  Result<void> state_;
};

}  // namespace axil
