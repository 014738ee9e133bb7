/// \file
/// `axil`: the command line. Options in, commands out; what a command does stands in commands.cpp.

#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/environment_options.hpp"
#include "app/terminal.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <map>

namespace {

using namespace axil;
using namespace axil::app;

constexpr int kBadUsage = 2;

/// Adds a subcommand whose options fill `command` and whose run leaves its exit status in `status`.
template <class Command>
CLI::App* add(CLI::App& app, int& status, Command& command, const char* name, const char* what, const char* example) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->footer(std::string("Examples:\n") + example);
  sub->callback([&] { status = run(command); });
  return sub;
}

void addLiteral(CLI::App* sub, TurningRule& turning) {
  sub->add_flag_callback("--literal", [&turning] { turning = TurningRule::Literal; },
                         "Turn branches by the thesis' literal rule (for old files; rotr is then not the angle at the fork)");
}

void addSeed(CLI::App* sub, std::uint64_t& seed) {
  sub->add_option("--seed", seed, "Seed of every random choice; the same seed grows the same plant")->capture_default_str();
}

void addPlant(CLI::App* sub, std::string& plant, const char* otherwise) {
  sub->add_option("--plant", plant, std::string("Name of one plant of the ecosystem; by default ") + otherwise)->option_text("NAME");
}

void addLimits(CLI::App* sub, simeco::Limits& limits) {
  sub->add_option("--max-modules", limits.modules, "Stop with a message at this many modules")->check(CLI::PositiveNumber)->capture_default_str();
  sub->add_option("--max-seconds", limits.seconds, "Stop with a message after this much time")->check(CLI::PositiveNumber)->capture_default_str();
}

void addKeywords(CLI::App& app, int& status, KeywordsCommand& command) {
  auto* sub = add(app, status, command, "keywords", "Read the traits of a botanical description",
                  "  axil keywords description.txt\n  echo 'Shrub; leaves opposite, ovate, 3-8 cm long' | axil keywords - --json");
  sub->add_option("FILE", command.file, "A description in English or Chinese, UTF-8; - reads standard input")->required();
  sub->add_flag("--json", command.json, "Print JSON: every trait with its words and their place, and the presets they set");
}

void addSkeleton(CLI::App& app, int& status, SkeletonCommand& command) {
  auto* sub = add(app, status, command, "skeleton", "Solve the 3D skeleton from the clicks of a project (prints skeleton.json)",
                  "  axil skeleton plant.axil > skeleton.json");
  sub->add_option("PROJECT", command.project, "A project file, NAME.axil")->required();
}

void addQuantify(CLI::App& app, int& status, QuantifyCommand& command) {
  auto* sub = add(app, status, command, "quantify", "Measure every segment: length, level, kind, turning angles (prints stems.csv)",
                  "  axil quantify plant.axil > stems.csv");
  sub->add_option("PROJECT", command.project, "A project file, NAME.axil")->required();
  addLiteral(sub, command.turning);
}

void addEmit(CLI::App& app, int& status, EmitCommand& command) {
  static const std::map<std::string, document::GrammarKind> kinds = {{"initial", document::GrammarKind::Initial},
                                                                     {"predictive", document::GrammarKind::Predictive},
                                                                     {"structured", document::GrammarKind::Structured}};
  static const std::map<std::string, emit::Dialect> dialects = {
      {"simeco", emit::Dialect::SimEco}, {"cpfg", emit::Dialect::Cpfg}, {"lpy", emit::Dialect::LPy}, {"mtg", emit::Dialect::Mtg}};
  auto* sub = add(app, status, command, "emit", "Write the grammar of a measured plant",
                  "  axil emit plant.axil --kind initial > plant.simeco      # regrows exactly what was measured\n"
                  "  axil emit plant.axil --kind predictive > next.simeco    # goes on growing from there\n"
                  "  axil emit plant.axil --kind structured > rules.simeco   # the same habit in few rules\n"
                  "  axil emit plant.axil --kind initial --dialect cpfg > plant.l");
  sub->add_option("PROJECT", command.project, "A project file, NAME.axil")->required();
  sub->add_option("--kind", command.kind, "initial, predictive or structured")->transform(CLI::CheckedTransformer(kinds))->option_text("KIND [initial]");
  sub->add_option("--dialect", command.dialect, "simeco, cpfg, lpy or mtg")->transform(CLI::CheckedTransformer(dialects))->option_text("DIALECT [simeco]");
  sub->add_option("--decimals", command.decimals, "Digits after the point; -1 prints full precision")->check(CLI::Range(-1, 15))->capture_default_str();
  addLiteral(sub, command.turning);
}

void addCheck(CLI::App& app, int& status, CheckCommand& command) {
  auto* sub = add(app, status, command, "check", "Say what is wrong with a grammar, all of it at once",
                  "  axil check plant.simeco      # prints nothing when all is well, else FILE:LINE:COL: error: ...");
  sub->add_option("GRAMMAR", command.grammar, "A .simeco or .l file")->required();
}

void addDerive(CLI::App& app, int& status, DeriveCommand& command) {
  auto* sub = add(app, status, command, "derive", "Derive a grammar's string",
                  "  axil derive plant.simeco --steps 3\n  axil derive plant.simeco --counts    # modules after every step, letters of the last string");
  sub->add_option("GRAMMAR", command.grammar, "A .simeco or .l file")->required();
  sub->add_option("--steps", command.steps, "Derivation steps; by default the file's own length, else until nothing changes")->check(CLI::NonNegativeNumber);
  addPlant(sub, command.plant, "the first");
  addSeed(sub, command.seed);
  addLimits(sub, command.limits);
  auto* counts = sub->add_flag_callback("--counts", [&] { command.print = DeriveCommand::Print::Counts; }, "Print JSON: modules a step, letters of the string");
  sub->add_flag_callback("--stats", [&] { command.print = DeriveCommand::Print::Stats; }, "Print JSON: modules, seconds, bytes, threads; no string")->excludes(counts);
  sub->add_flag("--single", command.singlePrecision, "Keep parameters in single precision, as classic programs do");
  sub->add_option("--threads", command.threads, "Threads; 0 takes what the machine has. The string does not depend on it")->check(CLI::Range(0, 1024))->capture_default_str();
}

void addGrow(CLI::App& app, int& status, GrowCommand& command) {
  auto* sub = add(app, status, command, "grow", "Grow a grammar into a picture, an animation, a mesh or a skeleton file",
                  "  axil grow plant.simeco -o plant.png\n  axil grow plant.simeco --time 12.5 -o young.png --view front\n"
                  "  axil grow plant.simeco --frames 120 -o growth.mp4      # or .webm, or a folder of PNGs\n"
                  "  axil grow plant.simeco -o plant.glb                    # or .obj, .ply, .json\n"
                  "  axil grow plant.simeco -o windy.png --wind 0.5,0,0 --temperature 15 --obstacle sphere:0.2,0.6,0,0.15");
  sub->add_option("GRAMMAR", command.grammar, "A .simeco or .l file")->required();
  sub->add_option("-o,--out", command.out, "Where to: its ending chooses .json .glb .obj .ply .png .mp4 .webm; with --frames also a folder")->required();
  auto* time = sub->add_option("--time", command.time, "Moment of growth in the grammar's time; by default when all is grown")->check(CLI::NonNegativeNumber);
  sub->add_option("--steps", command.steps, "Stop after this many derivation steps, then let what is there grow out")->check(CLI::NonNegativeNumber)->excludes(time);
  addPlant(sub, command.plant, "all of them");
  addSeed(sub, command.seed);
  addLimits(sub, command.limits);
  sub->add_option("--frames", command.frames, "How many pictures of the growth from nothing to the chosen moment")->check(CLI::Range(2, 100000));
  sub->add_option("--unit", command.unit, "Unit of the grammar's lengths, for .glb, which is in metres")->check(CLI::IsMember({"m", "dm", "cm", "mm"}))->capture_default_str();
  sub->add_option("--view", command.view, "front, right, top or quarter")->check(CLI::IsMember({"front", "right", "top", "quarter"}))->capture_default_str();
  sub->add_option("--width", command.width, "Pixels")->check(CLI::Range(16, 8192))->capture_default_str();
  sub->add_option("--height", command.height, "Pixels")->check(CLI::Range(16, 8192))->capture_default_str();
  addEnvironment(sub, command.environment);
  addLiteral(sub, command.turning);
}

void addBuild(CLI::App& app, int& status, BuildCommand& command) {
  auto* sub = add(app, status, command, "build", "Do it all: skeleton, measurements, grammars, pictures, mesh and a report",
                  "  axil build plant.axil -o out\n  axil build plant.axil -o out --frames 12 --video");
  sub->add_option("PROJECT", command.project, "A project file, NAME.axil")->required();
  sub->add_option("-o,--out", command.out, "The folder to write into; made if missing")->required();
  sub->add_option("--frames", command.frames, "Growth pictures")->check(CLI::Range(2, 1000))->capture_default_str();
  sub->add_flag("--video", command.video, "Also write growth.mp4");
}

struct Commands {
  KeywordsCommand keywords;
  SkeletonCommand skeleton;
  QuantifyCommand quantify;
  EmitCommand emit;
  CheckCommand check;
  DeriveCommand derive;
  GrowCommand grow;
  BuildCommand build;
};

void addCompletion(CLI::App& app, int& status) {
  static std::string shell;
  CLI::App* sub = app.add_subcommand("completion", "Print the completion script of a shell");
  sub->footer("Examples:\n  axil completion bash > ~/.local/share/bash-completion/completions/axil\n"
              "  axil completion zsh > ~/.zfunc/_axil\n  axil completion fish > ~/.config/fish/completions/axil.fish");
  sub->add_option("SHELL", shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  sub->callback([&app, &status] {
    status = print(completionScript(app, shell));
  });
}

int runAxil(int argc, char** argv) {
  CLI::App app{"From a botanical description and photographs of a plant to the L-system grammar that grows it."};
  app.name("axil");
  app.footer("Start with: axil build PROJECT -o DIR. `axil COMMAND --help` explains each command.\n"
             "Exit status: 0 success, 1 the input is wrong or gives no answer, 2 bad usage.");
  app.set_version_flag("--version", "axil " AXIL_VERSION);
  app.require_subcommand(1);
  int status = 0;
  Commands commands;
  addKeywords(app, status, commands.keywords);
  addSkeleton(app, status, commands.skeleton);
  addQuantify(app, status, commands.quantify);
  addEmit(app, status, commands.emit);
  addCheck(app, status, commands.check);
  addDerive(app, status, commands.derive);
  addGrow(app, status, commands.grow);
  addBuild(app, status, commands.build);
  addCompletion(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUsage;
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
