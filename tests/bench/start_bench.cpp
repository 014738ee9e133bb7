// From the start of the program to the first derived string on its output: what an editor or a script waits for at each call.
#include "base/files.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace {

/// A grammar in a file for as long as this lives.
struct GrammarFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("axil_start_" + std::to_string(::getpid()) + ".l");
  GrammarFile() { (void)axil::writeFile(path, "Lsystem: start\nderivation length: 4\nAxiom: A\nA --> F[+A]FA\nendlsystem\n"); }
  ~GrammarFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// Runs the program with its output thrown away; whether it ended well.
bool ran(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
  pid_t child = 0;
  int status = 1;
  const bool started = ::posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  return started && ::waitpid(child, &status, 0) == child && status == 0;
}

void startToFirstString(benchmark::State& state) {
  const GrammarFile grammar;
  for (auto _ : state)
    if (!ran({AXIL_PROGRAM, "derive", grammar.path.string()})) return state.SkipWithError("axil could not be run");
}
BENCHMARK(startToFirstString)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same by way of the program with VTK and OpenCV, as every start was before.
void startOfTheDrawingProgram(benchmark::State& state) {
  const GrammarFile grammar;
  for (auto _ : state)
    if (!ran({AXIL_DRAWING_PROGRAM, "derive", grammar.path.string()})) return state.SkipWithError("axil-draw could not be run");
}
BENCHMARK(startOfTheDrawingProgram)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
