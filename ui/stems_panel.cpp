#include "document/lookup.hpp"
#include "ui/elsewhere.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::Step;

/// What keeps the plant from being measured, and the nodes that wait for a second photo.
std::vector<std::string> missing(const Panel& panel) {
  std::vector<std::string> lines;
  const auto& skeleton = panel.following.skeleton;
  if (skeleton.trouble && skeleton.trouble->details.empty()) lines.push_back(skeleton.trouble->message);
  if (skeleton.trouble) lines.insert(lines.end(), skeleton.trouble->details.begin(), skeleton.trouble->details.end());
  if (skeleton.good && !skeleton.trouble)
    for (const auto& node : skeleton.good->incomplete) lines.push_back(filled(panel.t("node_waits"), {{"node", std::to_string(node.id.value)}}));
  for (const auto& click : panel.following.doubts.clicks)
    lines.push_back(filled(panel.t("doubt_click"), {{"node", std::to_string(click.node.value)}, {"view", click.view}, {"px", std::to_string(std::lround(click.off_px))}}));
  if (panel.following.measured.good)
    for (const auto& click : panel.following.measured.good->suspects)
      lines.push_back(filled(panel.t("doubt_left_out"), {{"node", std::to_string(click.node.value)}, {"view", click.view}, {"px", std::to_string(std::lround(click.off_px))}}));
  for (const auto& leap : panel.following.doubts.segments)
    lines.push_back(filled(panel.t("doubt_leap"), {{"stem", std::to_string(leap.stem.value)}, {"to", std::to_string(leap.to.value)}, {"times", std::to_string(std::lround(leap.times))}}));
  return lines;
}

/// Where the waiting nodes' lines cross their stems in another photo: one click in place of many.
Taken placeWaiting(const Panel& panel) {
  const auto placed = panel.placed();
  auto& [followed, places] = panel.state.placeable;
  if (!placed) return std::nullopt;
  if (followed != panel.following.revision) followed = panel.following.revision, places = placesOfWaiting(panel.project, *placed).size();
  if (places == 0) return std::nullopt;
  gap(panel, 4);
  const bool pressed = button(panel, "place_waiting", Emphasis::Plain, -1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", countOf(panel, places, "place_waiting_n").c_str());
  if (!pressed) return std::nullopt;
  Step step;
  for (const FoundPlace& place : placesOfWaiting(panel.project, *placed)) {
    const document::ProjectView& view = panel.project.views[*document::viewNamed(panel.project, place.view)];
    step.emplace_back(document::PlaceClick{place.node, place.view, centred(panel.photos.photoOf(panel.session.openProject(), view).get(), place.at), place.within_px});
  }
  return step.empty() ? std::nullopt : std::optional(std::move(step));
}

Taken stillMissing(const Panel& panel) {
  constexpr std::size_t kMost = 6;
  if (panel.project.nodes.empty()) return std::nullopt;
  const std::vector<std::string> lines = missing(panel);
  panel.state.shownTroubles = lines.size();
  if (lines.empty()) return std::nullopt;
  gap(panel, 6);
  heading(panel, "to_do");
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i) say(panel, NoticeKind::Warned, lines[i]);
  if (lines.size() > kMost) quiet(panel, filled(panel.t("and_more"), {{"n", std::to_string(lines.size() - kMost)}}));
  return placeWaiting(panel);
}

}  // namespace

Taken stemsPanel(const Panel& panel) {
  heading(panel, "way_stems");
  quiet(panel, panel.t(panel.project.stems.empty() ? "stems_first" : "stems_help"));
  Taken taken = stillMissing(panel);
  gap(panel, 4);
  const auto chosen = panel.state.selection.node ? stemOf(panel.project, *panel.state.selection.node) : std::nullopt;
  for (const auto& entry : panel.project.stems) {
    const skeleton3d::ClickedStem& stem = entry.stem;
    ImGui::PushID(stem.id.value);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = panel.px(30);
    if (ImGui::InvisibleButton("stem", {width, height}) && !stem.nodes.empty()) panel.state.selection.node = stem.nodes.back();
    landmark(panel, "stem_" + std::to_string(stem.id.value));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool isChosen = chosen && *chosen == stem.id;
    if (isChosen || ImGui::IsItemHovered())
      list.AddRectFilled(at, {at.x + width, at.y + height}, isChosen ? panel.palette.accentSoft : panel.palette.hovered, panel.px(6));
    list.AddLine({at.x + panel.px(8), at.y + height / 2}, {at.x + panel.px(34), at.y + height / 2}, colourOf(stem.id), panel.px(3));
    drawMark(list, markOf(stem.id), {at.x + panel.px(21), at.y + height / 2}, panel.px(4.5f), colourOf(stem.id));
    const std::string label = filled(panel.t("stem_n"), {{"stem", std::to_string(stem.id.value)}});
    list.AddText({at.x + panel.px(44), at.y + (height - ImGui::GetFontSize()) / 2}, panel.palette.text, label.c_str());
    ImGui::PushFont(font(Face::Small));
    const std::string nodes = countOf(panel, stem.nodes.size(), "n_nodes");
    list.AddText({at.x + width - ImGui::CalcTextSize(nodes.c_str()).x - panel.px(10), at.y + (height - ImGui::GetFontSize()) / 2}, panel.palette.quiet, nodes.c_str());
    ImGui::PopFont();
    ImGui::PopID();
  }
  return taken;
}

}  // namespace axil::ui
