#include "app/commands.hpp"
#include "app/project_options.hpp"
#include "base/text.hpp"
#include "document/chain.hpp"
#include "document/session.hpp"
#include "skeleton3d/draft.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>

namespace axil::app {

namespace {

struct TraceCommand {
  std::string project;
  std::vector<std::string> masks;  ///< VIEW=FILE
  std::vector<std::string> boxes;  ///< VIEW=X0,Y0,X1,Y1
  std::string output;
};

/// `given`, each VIEW=something, by view; `option` and `example` are for the words where one is wrong.
Result<std::map<std::string, std::string>> byView(const std::vector<std::string>& given, const document::Project& project, const std::string& option, const std::string& example) {
  std::map<std::string, std::string> values;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals + 1 == one.size()) return fail(ErrorCode::BadInput, option + " '" + one + "' is not " + example);
    const std::string view = one.substr(0, equals);
    const bool known = std::any_of(project.views.begin(), project.views.end(), [&](const document::ProjectView& v) { return v.view.name == view; });
    if (!known) return fail(ErrorCode::NotFound, option + " " + one + ": the project has no view '" + view + "'");
    if (!values.emplace(view, one.substr(equals + 1)).second) return fail(ErrorCode::BadInput, option + " is given twice for view '" + view + "'");
  }
  return values;
}

Result<skeleton3d::PlantBox> boxFrom(const std::string& text, const skeleton3d::Photo& photo) {
  std::vector<double> numbers;
  for (const char *at = text.data(), *end = text.data() + text.size(); at <= end;) {
    double number = 0;
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc() || (read.ptr != end && *read.ptr != ',')) break;
    numbers.push_back(number);
    at = read.ptr + 1;
    if (read.ptr == end) break;
  }
  const bool four = numbers.size() == 4 && static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) == 3;
  if (!four || !(numbers[0] < numbers[2] && numbers[1] < numbers[3]) || numbers[0] < 0 || numbers[1] < 0 || numbers[2] > photo.width || numbers[3] > photo.height)
    return fail(ErrorCode::BadInput, "the box '" + text + "' is not X0,Y0,X1,Y1 in pixels of its photo (" + std::to_string(photo.width) + " x " + std::to_string(photo.height) +
                                         "), left above right below");
  return skeleton3d::PlantBox{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
}

/// The plant is somewhere inside the photo's border unless a box says where.
Result<skeleton3d::Mask> maskInPhoto(const document::OpenProject& open, const document::ProjectView& view, const std::map<std::string, std::string>& boxes, const Watch& watch) {
  const auto photo = skeleton3d::readPhoto(document::photoPath(open, view));
  if (!photo) return photo.failure();
  skeleton3d::PlantBox box{{0.03 * photo->width, 0.03 * photo->height}, {0.97 * photo->width, 0.97 * photo->height}};
  if (const auto given = boxes.find(view.view.name); given != boxes.end()) {
    const auto read = boxFrom(given->second, *photo);
    if (!read) return fail(read.error().code, "--box " + view.view.name + ": " + read.error().message);
    box = *read;
  }
  auto mask = skeleton3d::maskByColour(*photo, box, watch);
  if (!mask) return fail(mask.error().code, "view '" + view.view.name + "': " + mask.error().message);
  return mask;
}

/// The mask of each view: the file given, else found by colour. Where only some views have a file, and no box, the others are left out.
Result<std::map<std::string, skeleton3d::Mask>> masksOf(const TraceCommand& command, const document::OpenProject& open, const Watch& watch) {
  const auto files = byView(command.masks, open.project, "--mask", "VIEW=FILE, for example front=front.mask.png");
  if (!files) return files.failure();
  const auto boxes = byView(command.boxes, open.project, "--box", "VIEW=X0,Y0,X1,Y1, for example front=120,80,900,1500");
  if (!boxes) return boxes.failure();
  std::map<std::string, skeleton3d::Mask> masks;
  for (const document::ProjectView& view : open.project.views) {
    const std::string& name = view.view.name;
    const bool byColour = !view.photo.empty() && (files->empty() || boxes->contains(name));
    if (!files->contains(name) && !byColour) continue;
    auto mask = files->contains(name) ? skeleton3d::readMask(files->at(name)) : maskInPhoto(open, view, *boxes, watch);
    if (!mask) return mask.failure();
    masks[name] = *std::move(mask);
  }
  return masks;
}

template <class Things, class IdOf>
std::int32_t firstFree(const Things& things, IdOf idOf) {
  std::int32_t next = 1;
  for (const auto& thing : things) next = std::max(next, static_cast<std::int32_t>(idOf(thing)) + 1);
  return next;
}

/// The project with the draft's nodes and stems after what was clicked already, each stem with how sure it is.
document::Project withDraft(document::Project project, std::span<const skeleton3d::View> views, std::span<const skeleton3d::DraftStem> stems) {
  const std::int32_t firstNode = firstFree(project.nodes, [](const auto& n) { return n.node.id.value; });
  const skeleton3d::DraftClicks clicks = skeleton3d::clicksOf(views, stems, skeleton3d::NodeId(firstNode), skeleton3d::StemId(1));
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
  const auto masks = masksOf(command, *open, options.watch);
  if (!masks) return report(masks.error());
  const auto stems = skeleton3d::draftStems(measured->views, *masks, {.watch = options.watch});
  endProgress();
  if (!stems) return report(stems.error());
  for (std::size_t i = 0; i < stems->size(); ++i)
    std::fprintf(stderr, "stem %zu: %zu nodes, %s, %.0f %% sure\n", i + 1, (*stems)[i].points.size(),
                 (*stems)[i].parent ? ("on stem " + std::to_string(*(*stems)[i].parent + 1)).c_str() : "from the collar", 100 * (*stems)[i].sureness);
  const document::Project traced = withDraft(open->project, measured->views, *stems);
  if (command.output.empty()) return print(document::projectText(traced));
  const std::filesystem::path beside = std::filesystem::absolute(command.output).parent_path();
  const auto saved = document::saveProject(document::withPhotosFrom(traced, open->folder, beside), command.output);
  return saved ? 0 : report(saved.error());
}

}  // namespace

void addTrace(CLI::App& sub, int& status) {
  auto& command = onCall<TraceCommand>(sub, status, run);
  addExamples(sub,
              "  axil trace plant.axil --mask front=front.png --mask right=right.png --mask top=top.png -o traced.axil\n"
              "  axil trace plant.axil -o traced.axil     # masks by colour, for a plant before a plain background\n"
              "  axil trace plant.axil --box front=200,90,800,1420 -o traced.axil\n"
              "Loose nodes are kept. At most 400 stems; space about the plant in at most 500,000 cubes, coarser if need be; Ctrl+C stops.");
  addProject(sub, command.project);
  sub.add_option("--mask", command.masks, "The plant's mask in a view: pixels of 128 and more are the plant's (without any: found by colour)")->option_text("VIEW=FILE");
  sub.add_option("--box", command.boxes, "Where in a view's photo the whole plant is, in pixels, to find it by its colours")->option_text("VIEW=X0,Y0,X1,Y1");
  sub.add_option("-o,--output", command.output, "Write the project with the draft here instead of printing it; paths of photos are kept right")->option_text("FILE");
}

}  // namespace axil::app
