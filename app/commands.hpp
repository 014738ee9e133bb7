#pragma once
/// \file
/// The commands of `axil`: one file each, `command_NAME.cpp`, with its options and what it does, and one row of the table in
/// axil.cpp. Data goes to stdout, words to stderr (terminal.hpp); docs/files.md says what each prints.

#include <functional>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace axil::app {

/// Fills in a command: its options, and what runs when it is called and leaves its exit status in `status` (0 success, 1 the
/// input is wrong or gives no answer).
using AddCommand = void(CLI::App& sub, int& status);

// Weak: a command that needs heavy libraries is linked only into the program that has them (docs/decisions/start.md).
[[gnu::weak]] AddCommand addKeywords, addSkeleton, addTrace, addCalibrate, addQuantify, addEmit, addCheck, addFmt, addDerive, addFitStatistics, addCompare, addBacktest, addGrow, addBuild, addCompletion, addDescribe;
/// Draws the contact sheet of `axil keywords --gallery`.
[[gnu::weak]] int drawShapeGallery(const std::string& out);

/// Does `call` when `sub` is called, after its options are read.
void setCallback(CLI::App& sub, std::function<void()> call);

/// The values that the options of `sub` fill, kept as long as `sub`; `run` gets them when the command is called.
template <class Options>
Options& onCall(CLI::App& sub, int& status, int (*run)(const Options&)) {
  auto options = std::make_shared<Options>();
  setCallback(sub, [options, run, &status] { status = run(*options); });
  return *options;
}

/// How a command is called, shown below its help; whole lines, indented by two blanks.
void addExamples(CLI::App& sub, const char* examples);

}  // namespace axil::app
