/// \file
/// `axil`: the command line. This file has the table of the commands; each command is a file of its own.
///
/// The same main() makes three programs. `axil` has the light commands alone, so that it starts at once; a command that needs
/// OpenCV or VTK is handed over to `axil-measure` or `axil-draw`, which have the light commands and their own. See
/// docs/decisions/start.md.

#include "app/commands.hpp"
#include "app/hand_over.hpp"
#include "simeco/report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace axil::app;

constexpr int kBadUsage = 2;

// Where a command is linked: everywhere, or only into the program with the libraries that it needs.
constexpr const char* kLight = "axil";
constexpr const char* kMeasuring = "axil-measure";  // OpenCV, Ceres
constexpr const char* kDrawing = "axil-draw";       // and VTK

struct Command {
  const char* name;
  const char* what;
  AddCommand* add;  ///< null where this program does not have it
  const char* program;
};

const Command kCommands[] = {
    {"keywords", "Read the traits of a botanical description", addKeywords, kLight},
    {"describe", "Write the grammar of a typical plant from its description alone", addDescribe, kMeasuring},
    {"skeleton", "Solve the 3D skeleton from the clicks of a project (prints skeleton.json)", addSkeleton, kMeasuring},
    {"trace", "Draft the stems from masks of the plant, without a click (writes a project to correct)", addTrace, kMeasuring},
    {"calibrate", "Find a lens from photos of a chessboard (prints the camera of a project's views)", addCalibrate, kMeasuring},
    {"quantify", "Measure every segment: length, level, kind, turning angles (prints stems.csv)", addQuantify, kMeasuring},
    {"emit", "Write the grammar of a measured plant", addEmit, kMeasuring},
    {"check", "Say what is wrong with a grammar, all of it at once", addCheck, kLight},
    {"fmt", "Lay a grammar out: one layout, comments kept", addFmt, kLight},
    {"derive", "Derive a grammar's string", addDerive, kLight},
    {"fit-statistics", "Structure and statistics of one plant or many, by branching order and rank", addFitStatistics, kDrawing},
    {"compare", "Say how near two plants are, or how alike two sets of plants", addCompare, kDrawing},
    {"backtest", "Cut the youngest stage off, foretell it, compare", addBacktest, kDrawing},
    {"grow", "Grow a grammar into a picture, an animation, a mesh or a skeleton file", addGrow, kDrawing},
    {"build", "Do it all: skeleton, measurements, grammars, pictures, mesh and a report", addBuild, kDrawing},
    {"completion", "Print the completion script of a shell", addCompletion, kDrawing},  // it names the options of all
};

void add(CLI::App& app, const Command& command, char** argv, int& status) {
  CLI::App* sub = app.add_subcommand(command.name, command.what);
  if (command.add != nullptr) return command.add(*sub, status);
  // The other program reads the options, --help among them.
  sub->set_help_flag();
  sub->prefix_command();
  sub->callback([&command, argv, &status] { status = handOver(command.program, argv); });
}

bool isCommand(const std::string& word) {
  return std::any_of(std::begin(kCommands), std::end(kCommands), [&](const Command& command) { return word == command.name; });
}

int refuseUnknown(const std::string& word) {
  std::vector<std::string_view> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  const std::string hint = axil::simeco::didYouMean(word, names);
  std::fprintf(stderr, "axil: error: there is no command '%s'; %s\n", word.c_str(), hint.empty() ? "`axil --help` lists them" : hint.c_str());
  return kBadUsage;
}

int runAxil(int argc, char** argv) {
  CLI::App app{"From a botanical description and photographs of a plant to the L-system grammar that grows it."};
  app.name("axil");
  app.footer("Start with: axil build PROJECT -o DIR. `axil COMMAND --help` explains each command.\n"
             "Exit status: 0 success, 1 the input is wrong or gives no answer, 2 bad usage.");
  app.set_version_flag("--version", "axil " AXIL_VERSION);
  app.require_subcommand(1);
  int status = 0;
  for (const Command& command : kCommands) add(app, command, argv, status);
  char help[] = "--help";
  if (argc > 1 && std::string_view(argv[1]) == "help") {  // `axil help grow` is `axil grow --help`
    argv[1] = argc > 2 ? argv[2] : help;
    if (argc > 2) argv[2] = help;
    argc = std::min(argc, 3);
    argv[argc] = nullptr;
  }
  if (argc > 1 && argv[1][0] != '-' && !isCommand(argv[1])) return refuseUnknown(argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "axil: error: %s; `axil%s --help` says how it is called\n", error.what(), argc > 1 && argv[1][0] != '-' ? (std::string(" ") + argv[1]).c_str() : "");
    return kBadUsage;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // The last catch: what reaches it is out of memory or a bug. AXIL_NO_CATCH lets a debugger or a test see it.
  if (std::getenv("AXIL_NO_CATCH") != nullptr) return runAxil(argc, argv);
  try {
    return runAxil(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("axil: error: not enough memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "axil: a bug in the program: %s. Please report it with the input.\n", error.what());
  }
  return 1;
}
