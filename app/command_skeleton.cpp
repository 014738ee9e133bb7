#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "document/skeleton_file.hpp"

#include <CLI/CLI.hpp>

namespace axil::app {

namespace {

struct SkeletonCommand {
  std::string project;
};

int run(const SkeletonCommand& command) {
  return printed(command.project, {.watch = terminalWatch()},
                 [](const auto& open, const auto& options) { return document::skeletonOf(open, options); }, document::skeletonText);
}

}  // namespace

void addSkeleton(CLI::App& sub, int& status) {
  auto& command = onCall<SkeletonCommand>(sub, status, run);
  addExamples(sub, "  axil skeleton plant.axil > skeleton.json");
  addProject(sub, command.project);
}

}  // namespace axil::app
