#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "skeleton3d/calibrate.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdio>
#include <filesystem>

namespace axil::app {

namespace {

struct CalibrateCommand {
  std::vector<std::string> photos;
  std::string corners;  ///< "9x6"; empty: found out
};

std::optional<glm::ivec2> cornersFrom(const std::string& text) {
  glm::ivec2 corners{0, 0};
  const char* end = text.data() + text.size();
  const auto across = std::from_chars(text.data(), end, corners.x);
  if (across.ec != std::errc{} || across.ptr == end || *across.ptr != 'x') return std::nullopt;
  const auto down = std::from_chars(across.ptr + 1, end, corners.y);
  return down.ec == std::errc{} && down.ptr == end ? std::optional(corners) : std::nullopt;
}

/// What a view of a project takes over as it stands: size_px and camera; the rest says how good it is.
std::string lensText(const skeleton3d::CalibratedLens& lens) {
  using Json = nlohmann::ordered_json;
  Json json = {{"size_px", {lens.size_px.x, lens.size_px.y}},
               {"camera", {{"model", "unknown"}, {"focal_px", {lens.focal_px.x, lens.focal_px.y}}, {"centre_px", {lens.centre_px.x, lens.centre_px.y}}, {"distortion", lens.distortion}}},
               {"sigma", {{"focal_px", {lens.focalSigma_px.x, lens.focalSigma_px.y}}, {"centre_px", {lens.centreSigma_px.x, lens.centreSigma_px.y}}}},
               {"rms_px", lens.rms_px},
               {"corners", {lens.corners.x, lens.corners.y}}};
  json["photos"] = Json::array();
  for (const auto& photo : lens.photos)
    json["photos"].push_back(photo.fault.empty() ? Json{{"photo", photo.name}, {"rms_px", photo.rms_px}} : Json{{"photo", photo.name}, {"left_out", photo.fault}});
  return json.dump(1) + "\n";
}

int run(const CalibrateCommand& command) {
  skeleton3d::CalibrateOptions options;
  if (!command.corners.empty()) {
    options.corners = cornersFrom(command.corners);
    if (!options.corners) return report({ErrorCode::BadInput, "--corners takes inner corners across and down, such as 9x6, not '" + command.corners + "'", {}});
  }
  const std::vector<std::filesystem::path> photos(command.photos.begin(), command.photos.end());
  const auto lens = skeleton3d::calibrateLens(photos, options, terminalWatch());
  if (!lens) return report(lens.error());
  for (const auto& photo : lens->photos)
    if (!photo.fault.empty()) std::fprintf(stderr, "axil: note: %s is left out: %s\n", photo.name.c_str(), photo.fault.c_str());
  return print(lensText(*lens));
}

}  // namespace

void addCalibrate(CLI::App& sub, int& status) {
  auto& command = onCall<CalibrateCommand>(sub, status, run);
  addExamples(sub, "  axil calibrate board1.jpg board2.jpg board3.jpg > lens.json   # its \"camera\" goes into every view of the project");
  sub.add_option("PHOTO", command.photos, "Photos of one chessboard, held in different ways, by the camera and zoom of the plant's photos")->required();
  sub.add_option("--corners", command.corners, "Inner corners across and down, such as 9x6; by default the usual boards are tried")->option_text("NxM");
}

}  // namespace axil::app
