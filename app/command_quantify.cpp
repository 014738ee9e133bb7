#include "app/commands.hpp"
#include "app/project_options.hpp"

#include <CLI/CLI.hpp>

namespace axil::app {

namespace {

struct QuantifyCommand {
  std::string project;
  TurningRule turning = TurningRule::Exact;
};

int run(const QuantifyCommand& command) {
  return printed(command.project, {.turning = command.turning, .watch = terminalWatch()},
                 [](const auto& open, const auto& options) { return document::measurementsOf(open, options); }, quantify::segmentsCsv);
}

}  // namespace

void addQuantify(CLI::App& sub, int& status) {
  auto& command = onCall<QuantifyCommand>(sub, status, run);
  addExamples(sub, "  axil quantify plant.axil > stems.csv");
  addProject(sub, command.project);
  addLiteral(sub, command.turning);
}

}  // namespace axil::app
