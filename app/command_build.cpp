#include "app/commands.hpp"
#include "app/grammar_options.hpp"
#include "app/project_options.hpp"
#include "document/build.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace axil::app {

namespace {

struct BuildCommand {
  std::string project;
  std::string out;
  int frames = 6;
  bool video = false;
  simeco::Limits limits;
};

std::string summary(const document::BuildReport& r, const std::string& folder) {
  char numbers[400];
  std::snprintf(numbers, sizeof numbers,
                "%s: %zu nodes, %zu stems, %zu segments, %zu leaves; %.3g high. Clicks within %.2f px of their nodes; regrown within %.1e of the height.\n",
                r.name.c_str(), r.nodes, r.stems, r.segments, r.leaves, r.height, r.worstReprojection_px, r.height > 0 ? r.worstRegrown / r.height : 0.0);
  std::string text = numbers;
  for (const std::string& note : r.notes) text += "Note: " + note + "\n";
  text += "Written to " + folder + ":\n";
  for (const std::string& file : r.files) text += "  " + file + "\n";
  return text;
}

int run(const BuildCommand& command) {
  const auto open = document::loadProject(command.project);
  if (!open) return report(open.error());
  document::BuildOptions options;
  options.chain.watch = terminalWatch();
  options.chain.limits = command.limits;
  options.frames = command.frames;
  options.video = command.video ? document::Video::Mp4 : document::Video::None;
  const auto built = document::build(*open, command.out, options);
  if (!built) return report(built.error());
  endProgress();
  std::fputs(summary(*built, command.out).c_str(), stderr);
  return 0;
}

}  // namespace

void addBuild(CLI::App& sub, int& status) {
  auto& command = onCall<BuildCommand>(sub, status, run);
  addExamples(sub, "  axil build plant.axil -o out\n  axil build plant.axil -o out --frames 12 --video");
  addProject(sub, command.project);
  sub.add_option("-o,--out", command.out, "The folder to write into; made if missing")->required();
  sub.add_option("--frames", command.frames, "Growth pictures")->check(CLI::Range(2, 1000))->capture_default_str();
  sub.add_flag("--video", command.video, "Also write growth.mp4");
  addLimits(sub, command.limits);
}

}  // namespace axil::app
