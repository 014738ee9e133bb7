#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "document/traits.hpp"
#include "quantify/contradictions.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace axil::app {

namespace {

struct QuantifyCommand {
  std::string project;
  TurningRule turning = TurningRule::Exact;
};

/// What the measured plant says against the description goes to stderr: it is no part of the table.
Result<quantify::Measurements> measuredAgainstText(const document::OpenProject& open, const document::ChainOptions& options) {
  auto measurements = document::measurementsOf(open, options);
  if (!measurements) return measurements;
  const auto said = document::traitsOf(open.project);
  if (!said) return said.failure();
  for (const auto& contradiction : quantify::contradictionsWith(*said, *measurements)) std::cerr << "warning: " << contradiction.line() << "\n";
  return measurements;
}

int run(const QuantifyCommand& command) {
  return printed(command.project, {.turning = command.turning, .watch = terminalWatch()}, measuredAgainstText, quantify::segmentsCsv);
}

}  // namespace

void addQuantify(CLI::App& sub, int& status) {
  auto& command = onCall<QuantifyCommand>(sub, status, run);
  addExamples(sub, "  axil quantify plant.axil > stems.csv");
  addProject(sub, command.project);
  addLiteral(sub, command.turning);
}

}  // namespace axil::app
