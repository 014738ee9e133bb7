#include "app/commands.hpp"
#include "app/grammar_options.hpp"
#include "app/terminal.hpp"

#include <CLI/CLI.hpp>

namespace axil::app {

namespace {

struct CheckCommand {
  std::string grammar;
};

int run(const CheckCommand& command) {
  const auto file = simeco::readGrammarFile(command.grammar);
  if (!file) return report(file.error());
  std::string lines;
  for (const Diagnostic& d : file->parsed.diagnostics) lines += formatDiagnostic(d, file->text, command.grammar) + "\n";
  const int status = print(lines);
  return status != 0 ? status : (file->parsed.ok() ? 0 : 1);
}

}  // namespace

void addCheck(CLI::App& sub, int& status) {
  auto& command = onCall<CheckCommand>(sub, status, run);
  addExamples(sub, "  axil check plant.simeco      # prints nothing when all is well, else FILE:LINE:COL: error: ...");
  addGrammar(sub, command.grammar);
}

}  // namespace axil::app
