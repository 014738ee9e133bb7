#include "base/text.hpp"
#include "document/lookup.hpp"
#include "quantify/estimate.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using document::Step;

/// Brightness and contrast of all photos together: what is hard to see in one is so in the others.
void lookSliders(const Panel& panel) {
  gap(panel, 6);
  PhotoLook look;
  for (const auto& [view, shown] : panel.state.looks) look = shown;
  const PhotoLook before = look;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  ImGui::SliderFloat(panel.t("brightness"), &look.brightness, -0.5f, 0.5f, "%.2f");
  landmark(panel, "brightness");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  ImGui::SliderFloat(panel.t("contrast"), &look.contrast, 0.4f, 3.0f, "%.2f");
  landmark(panel, "contrast");
  if (look != PhotoLook{} && button(panel, "as_taken", Emphasis::Plain, -1)) look = {};
  if (look == before) return;
  for (const document::ProjectView& view : panel.project.views) panel.state.looks[view.view.name] = look;
}

/// How far clicks in the view typically are from where their nodes project to, px; nothing before there is a skeleton.
std::optional<double> typicalMiss(const Panel& panel, const std::string& view) {
  std::vector<double> misses;
  if (panel.following.skeleton.good)
    for (const skeleton3d::Node& node : panel.following.skeleton.good->nodes)
      if (const auto miss = node.reprojection_px.find(view); miss != node.reprojection_px.end()) misses.push_back(miss->second);
  return misses.empty() ? std::nullopt : std::optional(quantify::medianOf(std::move(misses)));
}

/// Where a given camera stands, and how well clicks fit it.
void givenCamera(const Panel& panel, const skeleton3d::View& view) {
  const auto miss = typicalMiss(panel, view.name);
  if (!miss || view.camera.model == skeleton3d::CameraModel::Unknown) return;
  const bool isNear = view.camera.model == skeleton3d::CameraModel::Perspective;
  fact(panel, nameOfView(panel, view.name).c_str(), filled(panel.t(isNear ? "camera_given" : "camera_given_far"), {{"far", shortest(roundedTo(glm::length(view.camera.translation), 3))}, {"unit", panel.project.unit}, {"px", fixed(*miss, 2)}}));
}

/// Poses and residuals of the cameras, and what a person should look at.
void camerasFound(const Panel& panel, const document::Measured& measured) {
  constexpr std::size_t kMostNotes = 4;
  for (const skeleton3d::View& view : measured.views) {
    const bool estimated = std::any_of(measured.cameras.begin(), measured.cameras.end(), [&](const auto& report) { return report.view == view.name; });
    if (!estimated) givenCamera(panel, view);
  }
  for (const auto& report : measured.cameras) {
    fact(panel, nameOfView(panel, report.view).c_str(), filled(panel.t("camera_estimated"), {{"px", fixed(report.typical_px, 2)}, {"deg", fixed(report.turned.degrees(), 1)}}));
    for (const std::string& weak : report.weak) say(panel, NoticeKind::Warned, weak);
  }
  gap(panel, 4);
  for (std::size_t i = 0; i < std::min(measured.notes.size(), kMostNotes); ++i) say(panel, NoticeKind::Warned, measured.notes[i]);
}

}  // namespace

Taken photosPanel(const Panel& panel) {
  Taken taken;
  heading(panel, "way_photos");
  static constexpr std::array<const char*, 3> kNames = {"front", "right", "top"};
  const auto panes = viewsOfPanes(panel.project);
  for (std::size_t i = 0; i < 3; ++i) {
    ImGui::PushID(static_cast<int>(i));
    const document::ProjectView* view = panes[i] < 0 ? nullptr : &panel.project.views[static_cast<std::size_t>(panes[i])];
    const std::string name = view != nullptr ? view->view.name : kNames[i];
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(nameOfView(panel, name).c_str());
    ImGui::SameLine(panel.px(80));
    const std::string file = view == nullptr || view->photo.empty() ? panel.t("choose_photo") : std::filesystem::path(view->photo).filename().string();
    if (ImGui::Button((file + "##file").c_str(), {-1, 0})) {
      panel.state.dialog = {DialogKind::Photo, panel.session.openProject().folder, "", name};
    }
    landmark(panel, "photo_" + name);
    ImGui::PopID();
  }
  gap(panel, 4);
  if (panes[0] >= 0 && panes[1] >= 0 && button(panel, "swap_front_right", Emphasis::Plain, -1)) taken = Step{document::SwapViews{"front", "right"}};
  if (panel.project.views.empty()) {
    quiet(panel, panel.t("photos_help"));
    return taken;
  }
  gap(panel, 6);
  heading(panel, "calibrate");
  quiet(panel, panel.t("calibrate_help"));
  const float half = (ImGui::GetContentRegionAvail().x - panel.px(8)) / 2;
  if (choice(panel, "tool_origin", panel.state.tool == PhotoTool::Origin, half))
    panel.state.tool = panel.state.tool == PhotoTool::Origin ? PhotoTool::None : PhotoTool::Origin;
  ImGui::SameLine(0, panel.px(8));
  if (choice(panel, "tool_length", panel.state.tool == PhotoTool::Length, half)) {
    panel.state.tool = panel.state.tool == PhotoTool::Length ? PhotoTool::None : PhotoTool::Length;
    panel.state.lengthFrom.reset();
  }
  if (panel.state.tool == PhotoTool::Length) {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputDouble("##length", &panel.state.knownLength, 0, 0, ("%.4g " + panel.project.unit).c_str());
    panel.state.knownLength = std::clamp(panel.state.knownLength, 1e-6, 1e6);
  }
  gap(panel, 4);
  for (const int place : panes) {
    if (place < 0) continue;
    const document::ProjectView& view = panel.project.views[static_cast<std::size_t>(place)];
    const std::string marks = std::string(view.origin_px ? panel.t("origin_set") : panel.t("origin_missing")) + (view.scale ? std::string(" · ") + panel.t("length_set") : "");
    fact(panel, nameOfView(panel, view.view.name).c_str(), view.view.camera.model == skeleton3d::CameraModel::Unknown ? marks : panel.t("camera_known"));
  }
  if (panel.following.measured.trouble) {
    gap(panel, 4);
    say(panel, NoticeKind::Warned, panel.following.measured.trouble->message);
  }
  lookSliders(panel);
  if (panel.following.measured.isCurrent()) camerasFound(panel, *panel.following.measured.good);
  for (const auto& trouble : panel.following.photos) say(panel, NoticeKind::Failed, trouble.error.message);
  return taken;
}

}  // namespace axil::ui
