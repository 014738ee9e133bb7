#include "app/terminal.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <unistd.h>

namespace axil::app {

namespace {

using Clock = std::chrono::steady_clock;

// A signal handler can reach nothing else; the token lives as long as the program.
CancelToken interrupted;

// The second signal ends the program as it would without us: nobody waits for a stuck one.
extern "C" void onInterrupt(int signal) {
  std::signal(signal, SIG_DFL);
  interrupted.cancel();
}

/// Also a terminal that is closed and a machine that shuts down: what is half done is cleaned up. What the caller chose to
/// ignore (nohup) stays ignored.
void watchSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, onInterrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
}

struct ProgressLine {
  Clock::time_point started = Clock::now();
  Clock::time_point last = started;
  bool onTerminal = ::isatty(STDERR_FILENO) != 0;

  void show(std::string_view what, double share) {
    const Clock::time_point now = Clock::now();
    const auto pause = onTerminal ? std::chrono::milliseconds(100) : std::chrono::milliseconds(2000);
    if (now - started < std::chrono::seconds(1) || now - last < pause) return;
    last = now;
    const int percent = static_cast<int>(share * 100);
    std::fprintf(stderr, onTerminal ? "\r\033[K%.*s %d %%" : "%.*s %d %%\n", static_cast<int>(what.size()), what.data(), percent);
    std::fflush(stderr);
  }
};

}  // namespace

int report(const Error& error) {
  endProgress();
  std::fprintf(stderr, "axil: error: %s\n", error.message.c_str());
  for (const std::string& detail : error.details) std::fprintf(stderr, "  %s\n", detail.c_str());
  return 1;
}

int print(const std::string& data) {
  endProgress();
  const bool written = std::fwrite(data.data(), 1, data.size(), stdout) == data.size() && std::fflush(stdout) == 0;
  return written ? 0 : report({ErrorCode::Unwritable, "cannot write to the standard output", {}});
}

Watch terminalWatch() {
  watchSignals();
  const auto line = std::make_shared<ProgressLine>();
  return {[line](std::string_view what, double share) { line->show(what, share); }, &interrupted};
}

void endProgress() {
  if (::isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

}  // namespace axil::app
