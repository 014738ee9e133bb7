#include "app/hand_over.hpp"

#include "app/terminal.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace axil::app {

namespace fs = std::filesystem;

int handOver(const char* program, char** argv) {
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown), folder = self.parent_path();
  if (unknown) return report({ErrorCode::Unreadable, "cannot tell where this program is, so " + std::string(program) + " cannot be found: " + unknown.message(), {}});
  const fs::path installed = folder.parent_path() / "libexec/axil" / program;
  for (const fs::path& path : {folder / program, installed}) {
    if (path == self) continue;  // a program that lacks a command of its own would start itself for ever
    ::execv(path.c_str(), argv);
    if (errno != ENOENT && errno != ENOTDIR) return report({ErrorCode::Unreadable, "cannot start " + path.string() + ": " + std::strerror(errno), {}});
  }
  return report({ErrorCode::Unreadable,
                 "this command is part of " + std::string(program) + ", which is neither in " + folder.string() + " nor in " + installed.parent_path().string() +
                     "; build the target axil_cli or install all of Axil",
                 {}});
}

}  // namespace axil::app
