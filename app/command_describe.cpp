#include "app/commands.hpp"
#include "app/described_grammar.hpp"
#include "app/terminal.hpp"
#include "simeco/language.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace axil::app {

namespace {

struct DescribeCommand {
  std::string file;  ///< "-": stdin
};

int run(const DescribeCommand& command) {
  const auto plant = describedPlantIn(command.file);
  if (!plant) return report(plant.error());
  return print(simeco::print(plant->grammar));
}

}  // namespace

void addDescribe(CLI::App& sub, int& status) {
  auto& command = onCall<DescribeCommand>(sub, status, run);
  addExamples(sub, "  axil describe samples/species/rosa/en.txt > rose.simeco\n  axil grow samples/species/rosa/en.txt -o rose.png");
  sub.add_option("FILE", command.file, "A description in English or Chinese; - reads standard input")->required();
}

}  // namespace axil::app
