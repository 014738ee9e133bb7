#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "base/text.hpp"
#include "document/chain.hpp"
#include "skeleton3d/draft.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

namespace axil::app {

namespace {

struct TraceCommand {
  std::string project;
  std::vector<std::string> masks;  ///< VIEW=FILE
  std::string output;
};

Result<std::map<std::string, std::string>> maskFiles(const TraceCommand& command, const document::Project& project) {
  std::map<std::string, std::string> files;
  for (const std::string& given : command.masks) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos || equals + 1 == given.size()) return fail(ErrorCode::BadInput, "--mask '" + given + "' is not VIEW=FILE, for example front=front.mask.png");
    const std::string view = given.substr(0, equals);
    const bool known = std::any_of(project.views.begin(), project.views.end(), [&](const document::ProjectView& v) { return v.view.name == view; });
    if (!known) return fail(ErrorCode::NotFound, "--mask " + given + ": the project has no view '" + view + "'");
    files[view] = given.substr(equals + 1);
  }
  return files;
}

/// The mask of each view: the file given, else found by colour, the plant being somewhere inside the photo's border.
Result<std::map<std::string, skeleton3d::Mask>> masksOf(const TraceCommand& command, const document::OpenProject& open) {
  const auto files = maskFiles(command, open.project);
  if (!files) return files.failure();
  std::map<std::string, skeleton3d::Mask> masks;
  for (const document::ProjectView& view : open.project.views) {
    const std::string& name = view.view.name;
    if (!files->empty() && !files->contains(name)) continue;
    if (files->empty() && view.photo.empty()) continue;
    if (files->contains(name)) {
      auto mask = skeleton3d::readMask(files->at(name));
      if (!mask) return mask.failure();
      masks[name] = *std::move(mask);
      continue;
    }
    const auto photo = skeleton3d::readPhoto(document::photoPath(open, view));
    if (!photo) return photo.failure();
    auto mask = skeleton3d::maskByColour(*photo, {{0.03 * photo->width, 0.03 * photo->height}, {0.97 * photo->width, 0.97 * photo->height}});
    if (!mask) return fail(mask.error().code, "view '" + name + "': " + mask.error().message);
    masks[name] = *std::move(mask);
  }
  return masks;
}

/// The project with the draft's nodes and stems, each with how sure it is.
document::Project withDraft(document::Project project, std::span<const skeleton3d::View> views, std::span<const skeleton3d::DraftStem> stems) {
  const skeleton3d::DraftClicks clicks = skeleton3d::clicksOf(views, stems, skeleton3d::NodeId(1), skeleton3d::StemId(1));
  project.nodes = {};
  for (const auto& node : clicks.nodes) project.nodes.push_back({node, {}});
  for (std::size_t i = 0; i < clicks.stems.size(); ++i) project.stems.push_back({clicks.stems[i], {{"draft_sureness", fixed(stems[i].sureness, 2)}}});
  return project;
}

int run(const TraceCommand& command) {
  const auto open = document::loadProject(command.project);
  if (!open) return report(open.error());
  if (!open->project.stems.empty())
    return report({ErrorCode::BadInput, "'" + command.project + "' has stems already; a draft starts from a project without any, so take them out or trace a copy"});
  const document::ChainOptions options{.watch = terminalWatch()};
  const auto measured = document::measured(*open, options);
  if (!measured) return report(measured.error());
  const auto masks = masksOf(command, *open);
  if (!masks) return report(masks.error());
  const auto stems = skeleton3d::draftStems(measured->views, *masks, {.watch = terminalWatch()});
  if (!stems) return report(stems.error());
  for (std::size_t i = 0; i < stems->size(); ++i)
    std::fprintf(stderr, "stem %zu: %zu nodes, %s, %.0f %% sure\n", i + 1, (*stems)[i].points.size(),
                 (*stems)[i].parent ? ("on stem " + std::to_string(*(*stems)[i].parent + 1)).c_str() : "from the collar", 100 * (*stems)[i].sureness);
  const document::Project traced = withDraft(open->project, measured->views, *stems);
  if (command.output.empty()) return print(document::projectText(traced));
  const auto saved = document::saveProject(traced, command.output);
  return saved ? 0 : report(saved.error());
}

}  // namespace

void addTrace(CLI::App& sub, int& status) {
  auto& command = onCall<TraceCommand>(sub, status, run);
  addExamples(sub,
              "  axil trace plant.axil --mask front=front.png --mask right=right.png --mask top=top.png -o traced.axil\n"
              "  axil trace plant.axil -o traced.axil     # masks by colour, for a plant before a plain background");
  addProject(sub, command.project);
  sub.add_option("--mask", command.masks, "The plant's mask in a view: pixels of 128 and more are the plant's (without any: found by colour)")->option_text("VIEW=FILE");
  sub.add_option("-o,--output", command.output, "Write the project with the draft here instead of printing it; keep it beside the photos' folder")->option_text("FILE");
}

}  // namespace axil::app
