#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "document/plant_file.hpp"
#include "document/plots.hpp"
#include "document/statistics_file.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>
#include <vector>

namespace axil::app {

namespace {

struct FitStatisticsCommand {
  std::vector<std::string> plants;
  bool json = false;
  std::string plot;
};

int run(const FitStatisticsCommand& command) {
  std::vector<quantify::Measurements> plants;
  for (const std::string& file : command.plants) {
    auto plant = document::readPlant(file, {.watch = terminalWatch()});
    if (!plant) return report(plant.error());
    plants.push_back(std::move(plant->measurements));
  }
  const auto statistics = quantify::layeredStatistics(plants);
  if (!statistics) return report(statistics.error());
  endProgress();
  for (const std::string& warning : statistics->warnings) std::fprintf(stderr, "axil: warning: %s\n", warning.c_str());
  if (!command.plot.empty()) {
    const auto png = document::statisticsPlot(*statistics);
    if (!png) return report(png.error());
    if (const auto written = writeFile(command.plot, *png); !written) return report(written.error());
  }
  return print(command.json ? document::statisticsJson(*statistics) : document::statisticsText(*statistics));
}

}  // namespace

void addFitStatistics(CLI::App& sub, int& status) {
  auto& command = onCall<FitStatisticsCommand>(sub, status, run);
  addExamples(sub, "  axil fit-statistics plant.axil                     # structure and statistics by branching order\n"
                   "  axil fit-statistics a.axil b.axil grown.json --json   # of several plants of a kind, with every rank");
  sub.add_option("PLANT", command.plants, "Projects (.axil) or skeleton files (.json), all of one kind")->required()->option_text("...");
  sub.add_option("--plot", command.plot, "Write charts along the rank, PNG")->option_text("FILE.png");
  sub.add_flag("--json", command.json, "As JSON, with the layers of every rank");
}

}  // namespace axil::app
