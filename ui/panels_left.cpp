#include "ui/widgets_interop.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

constexpr std::array<const char*, 6> kWayKeys = {"way_describe", "way_photos", "way_stems", "way_leaves", "way_grammar", "way_grow"};

/// What has been reached, in a few words.
std::string reached(const Panel& panel, Way way) {
  const document::Project& project = panel.project;
  const auto* grown = panel.following.grammar(document::GrammarKind::Initial);
  switch (way) {
    case Way::Describe: return project.description.empty() ? "" : countOf(panel, panel.following.said ? panel.following.said->size() : 0, "n_facts");
    case Way::Photos: return project.views.empty() ? "" : countOf(panel, project.views.size(), "n_photos");
    case Way::Stems: return project.stems.empty() ? "" : countOf(panel, project.stems.size(), "n_stems");
    case Way::Leaves: return project.leaves.empty() ? "" : countOf(panel, project.leaves.size(), "n_leaves");
    case Way::Grammar: return grown == nullptr ? "" : countOf(panel, static_cast<std::size_t>(std::count(grown->text.begin(), grown->text.end(), '\n')), "n_lines");
    case Way::Grow: return grown != nullptr && grown->growth ? panel.t("ready") : "";
  }
  return "";
}

void wayRow(const Panel& panel, Way way) {
  const std::size_t i = static_cast<std::size_t>(way);
  const bool chosen = panel.state.way == way;
  const float height = panel.px(38), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton(kWayKeys[i], {width, height})) {
    panel.state.way = way;
    panel.state.maximised.reset();
    panel.state.tool = PhotoTool::None;
  }
  landmark(panel, kWayKeys[i]);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Palette& p = panel.palette;
  if (chosen || ImGui::IsItemHovered()) list.AddRectFilled(at, {at.x + width, at.y + height}, chosen ? p.accentSoft : p.hovered, panel.px(7));
  const Colour ink = chosen ? p.accent : p.text;
  drawIcon(list, static_cast<Icon>(i), {at.x + panel.px(22), at.y + height / 2}, panel.px(18), ink);
  const float line = ImGui::GetFontSize();
  list.AddText({at.x + panel.px(44), at.y + (height - line) / 2}, ink, panel.t(kWayKeys[i]));
  const std::string done = reached(panel, way);
  ImGui::PushFont(font(Face::Small));
  const float w = ImGui::CalcTextSize(done.c_str()).x;
  list.AddText({at.x + width - w - panel.px(12), at.y + (height - ImGui::GetFontSize()) / 2}, p.quiet, done.c_str());
  ImGui::PopFont();
}

}  // namespace

void wayPanel(const Panel& panel) {
  for (const Way way : kWays) {
    wayRow(panel, way);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - panel.px(4));
  }
}

}  // namespace axil::ui
