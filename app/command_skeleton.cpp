#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "base/files.hpp"
#include "document/skeleton_file.hpp"
#include "skeleton3d/report.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>

namespace axil::app {

namespace {

namespace fs = std::filesystem;

struct SkeletonCommand {
  std::string project;
  std::string report;  ///< a folder; empty: none
  bool snap = false;
};

/// One picture a view, residuals_NAME.png, and report.txt.
Result<void> writeReport(const document::OpenProject& open, const document::Measured& clicks, const skeleton3d::Skeleton& skeleton, const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) return fail(ErrorCode::Unwritable, "the folder '" + folder.string() + "' cannot be made: " + fault.message());
  std::vector<skeleton3d::ClickedNode> nodes;
  for (const auto& node : open.project.nodes) nodes.push_back(node.node);
  for (std::size_t v = 0; v < clicks.views.size(); ++v) {
    const document::ProjectView& view = open.project.views[v];
    const auto photo = view.photo.empty() ? std::nullopt : std::optional(document::photoPath(open, view));
    const auto plot = skeleton3d::residualPlot(photo, clicks.views[v], nodes, skeleton, clicks.suspects, clicks.uncertainty.click_px);
    if (!plot) return plot.failure();
    std::string name = clicks.views[v].name;
    for (char& c : name)
      if (c == '/' || c == '\\') c = '_';
    if (auto written = writeFile(folder / ("residuals_" + name + ".png"), *plot); !written) return written;
  }
  return writeFile(folder / "report.txt", skeleton3d::reportText(clicks.views, clicks.cameras, clicks.suspects, clicks.uncertainty, clicks.notes, skeleton));
}

/// What a person should look at, on stderr: clicks that are left out first.
void say(const document::Measured& clicks, const skeleton3d::Skeleton& skeleton) {
  for (const auto& suspect : clicks.suspects)
    std::fprintf(stderr, "axil: suspect click: node %d in view %s, %.1f px off, wrong with a chance of %.0f %%\n", suspect.node.value, suspect.view.c_str(), suspect.off_px,
                 100 * suspect.chance);
  for (const std::string& note : clicks.notes) std::fprintf(stderr, "axil: note: %s\n", note.c_str());
  for (const std::string& line : document::waitingLines(skeleton, clicks.suspects)) std::fprintf(stderr, "axil: note: %s\n", line.c_str());
}

int run(const SkeletonCommand& command) {
  const auto open = document::loadProject(command.project);
  if (!open) return report(open.error());
  const document::ChainOptions options{.watch = terminalWatch(), .snap = command.snap ? document::Snap::On : document::Snap::Off};
  const auto clicks = document::measured(*open, options);
  if (!clicks) return report(clicks.error());
  const auto skeleton = document::skeletonOf(open->project, *clicks, options);
  if (!skeleton) return report(skeleton.error());
  say(*clicks, *skeleton);
  if (!command.report.empty())
    if (const auto written = writeReport(*open, *clicks, *skeleton, command.report); !written) return report(written.error());
  return print(document::skeletonText(*skeleton, clicks->suspects));
}

}  // namespace

void addSkeleton(CLI::App& sub, int& status) {
  auto& command = onCall<SkeletonCommand>(sub, status, run);
  addExamples(sub, "  axil skeleton plant.axil > skeleton.json\n  axil skeleton plant.axil --snap > skeleton.json             # clicks go to the stems' centre lines, widths are measured\n  axil skeleton plant.axil --report report > skeleton.json   # and how well every click fits");
  addProject(sub, command.project);
  sub.add_flag("--snap", command.snap, "Move each click across its stem to the centre line seen in the photo, and measure the stems' widths");
  sub.add_option("--report", command.report, "Also write into this folder: report.txt, and per view the misses of all clicks drawn over the photo")->option_text("FOLDER");
}

}  // namespace axil::app
