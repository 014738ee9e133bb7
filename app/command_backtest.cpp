#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "document/plant_file.hpp"
#include "document/plots.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>
#include <vector>

namespace axil::app {

namespace {

struct BacktestCommand {
  std::vector<std::string> plants;
  std::vector<std::string> later;
  int stages = 1;
  bool json = false;
  std::string plot;
};

Result<std::vector<quantify::Measurements>> measured(const std::vector<std::string>& files) {
  std::vector<quantify::Measurements> plants;
  for (const std::string& file : files) {
    auto plant = document::readPlant(file, {.watch = terminalWatch()});
    if (!plant) return plant.failure();
    plants.push_back(std::move(plant->measurements));
  }
  return plants;
}

Result<quantify::Backtest> tested(const BacktestCommand& command, std::string& unit) {
  const auto plants = measured(command.plants);
  if (!plants) return plants.failure();
  unit = plants->front().unit;
  if (command.later.empty()) return quantify::backtest(*plants, command.stages);
  const auto later = measured(command.later);
  if (!later) return later.failure();
  return quantify::backtest(*plants, *later, command.stages);
}

int run(const BacktestCommand& command) {
  std::string unit;
  const auto test = tested(command, unit);
  if (!test) return report(test.error());
  endProgress();
  for (const std::string& note : test->notes) std::fprintf(stderr, "axil: note: %s\n", note.c_str());
  if (!command.plot.empty()) {
    const auto png = document::backtestPlot(*test, unit);
    if (!png) return report(png.error());
    if (const auto written = writeFile(command.plot, *png); !written) return report(written.error());
  }
  return print(command.json ? document::backtestJson(*test) : document::backtestText(*test));
}

}  // namespace

void addBacktest(CLI::App& sub, int& status) {
  auto& command = onCall<BacktestCommand>(sub, status, run);
  addExamples(sub, "  axil backtest a.axil b.axil c.axil --plot skill.png         # cut the youngest stage off each, foretell it\n"
                   "  axil backtest may.json --later june.json --stages 3         # one plant, measured twice, three stages apart");
  sub.add_option("PLANT", command.plants, "Projects (.axil) or skeleton files (.json), all of one kind")->required()->option_text("...");
  sub.add_option("--later", command.later, "The same plants, measured later, in the same order; nothing is cut off then")->option_text("...");
  sub.add_option("--stages", command.stages, "How many stages to cut off, or to foretell")->check(CLI::Range(1, 1000))->capture_default_str();
  sub.add_flag("--json", command.json, "As JSON, with every length and count");
  sub.add_option("--plot", command.plot, "Write a chart of it, PNG")->option_text("FILE.png");
}

}  // namespace axil::app
