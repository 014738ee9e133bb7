#include "base/text.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>
#include <imgui_stdlib.h>

namespace axil::ui {

namespace {

using document::Step;

/// One thing of the environment: as the grammar has it, or as the slider says.
void environmentRow(const Panel& panel, const char* key, std::optional<double>& value, double first, float low, float high, const char* format) {
  ImGui::PushID(key);
  bool given = value.has_value();
  if (ImGui::Checkbox(panel.t(key), &given)) value = given ? std::optional(first) : std::nullopt;
  landmark(panel, key);
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
  ImGui::SetNextItemWidth(-1);
  if (value) {
    float shown = static_cast<float>(*value);
    if (ImGui::SliderFloat("##v", &shown, low, high, format)) value = std::round(static_cast<double>(shown) * 100) / 100;
  } else {
    ImGui::TextDisabled("%s", panel.t("as_in_grammar"));
  }
  ImGui::PopID();
}

/// Where the light comes from, as two angles.
void lightRows(const Panel& panel, std::optional<glm::dvec3>& light) {
  bool given = light.has_value();
  if (ImGui::Checkbox(panel.t("env_light"), &given)) light = given ? std::optional(glm::dvec3(0.5, 0.8, 0)) : std::nullopt;
  landmark(panel, "env_light");
  if (!light) return;
  const glm::dvec3 unit = glm::normalize(*light);
  float height = static_cast<float>(Angle::fromRadians(std::asin(std::clamp(unit.y, -1.0, 1.0))).degrees());
  float around = static_cast<float>(Angle::fromRadians(std::atan2(unit.x, unit.z)).degrees());
  ImGui::SetNextItemWidth(-1);
  bool changed = ImGui::SliderFloat("##height", &height, 5, 89.9f, panel.t("env_light_height"));
  ImGui::SetNextItemWidth(-1);
  changed = ImGui::SliderFloat("##around", &around, -180, 180, panel.t("env_light_around")) || changed;
  if (!changed) return;
  const double up = Angle::fromDegrees(static_cast<double>(height)).radians(), turn = Angle::fromDegrees(static_cast<double>(around)).radians();
  light = glm::dvec3(std::cos(up) * std::sin(turn), std::sin(up), std::cos(up) * std::cos(turn));
}

void environmentRows(const Panel& panel) {
  heading(panel, "environment");
  simeco::Environment& e = panel.state.environment;
  environmentRow(panel, "env_soil", e.soilPH, 7, 3, 10, "pH %.1f");
  environmentRow(panel, "env_rain", e.rainRate, 0.9, 0, 2, "%.2f");
  environmentRow(panel, "env_day", e.dayLight, 12, 0, 24, "%.1f h");
  environmentRow(panel, "env_temperature", e.temperature, 20, -5, 45, "%.0f °C");
  lightRows(panel, e.light);
}

/// One file of what is shown.
void exportOne(const Panel& panel, const char* key, const char* ending, float width) {
  if (!button(panel, key, Emphasis::Plain, width)) return;
  panel.state.dialog = {DialogKind::ExportFile, panel.session.openProject().folder, panel.project.name + ending, ""};
}

}  // namespace

Taken growPanel(const Panel& panel) {
  Taken taken;
  heading(panel, "way_grow");
  static constexpr std::array<const char*, 3> kKinds = {"grow_measured", "grow_predicted", "grow_structured"};
  for (std::size_t i = 0; i < 3; ++i)
    if (choice(panel, kKinds[i], panel.state.kind == static_cast<document::GrammarKind>(i), -1)) panel.state.kind = static_cast<document::GrammarKind>(i);
  const auto* grown = panel.following.grammar(panel.state.kind);
  if (grown != nullptr && grown->trouble) say(panel, NoticeKind::Failed, grown->trouble->message);
  if (panel.state.kind == document::GrammarKind::Predictive) {
    ImGui::Checkbox(panel.t("tint_predicted"), &panel.state.tintPredicted);
    landmark(panel, "tint_predicted");
  }
  gap(panel, 8);
  heading(panel, "seed");
  ImGui::SetNextItemWidth(-1);
  std::string seed = std::to_string(panel.project.seed);
  if (ImGui::InputText("##seed", &seed, ImGuiInputTextFlags_CharsDecimal | ImGuiInputTextFlags_EnterReturnsTrue))
    if (const auto number = parseNumber(seed); number && *number >= 0 && *number <= 9007199254740992.0) taken = Step{document::SetSeed{static_cast<std::uint64_t>(*number)}};
  ImGui::TextUnformatted(panel.t("speed"));
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.4f);
  ImGui::SetNextItemWidth(-1);
  float speed = static_cast<float>(panel.state.speed);
  if (ImGui::SliderFloat("##speed", &speed, 0.1f, 5, "%.1f x", ImGuiSliderFlags_Logarithmic)) panel.state.speed = static_cast<double>(speed);
  ImGui::TextUnformatted(panel.t("ghosts"));
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.4f);
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderInt("##ghosts", &panel.state.ghosts, 0, 12);
  landmark(panel, "ghosts");
  gap(panel, 8);
  environmentRows(panel);
  gap(panel, 8);
  heading(panel, "export");
  const float half = (ImGui::GetContentRegionAvail().x - panel.px(6)) / 2;
  exportOne(panel, "export_picture", ".png", half);
  ImGui::SameLine(0, panel.px(6));
  exportOne(panel, "export_video", ".mp4", half);
  exportOne(panel, "export_mesh", ".glb", half);
  ImGui::SameLine(0, panel.px(6));
  exportOne(panel, "export_grammar", ".simeco", half);
  gap(panel, 4);
  quiet(panel, panel.t("export_help"));
  const ExportState& exporting = panel.exporting;
  if (exporting.running) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, panel.palette.accent);
    ImGui::ProgressBar(static_cast<float>(exporting.share), {-1, panel.px(22)}, exporting.what.c_str());
    ImGui::PopStyleColor();
    if (button(panel, "cancel", Emphasis::Plain, -1)) panel.state.wishes.push_back(WishCancelExport{});
  } else {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##folder", &panel.state.exportFolder);
    if (button(panel, "export_now", Emphasis::Primary, -1)) panel.state.wishes.push_back(WishExport{panel.state.exportFolder});
  }
  if (exporting.done && !exporting.running) say(panel, NoticeKind::Said, filled(panel.t("exported"), {{"folder", *exporting.done}}));
  return taken;
}

}  // namespace axil::ui
