#include "ui/shell.hpp"

#include "ui/widgets_interop.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using document::Step;

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// What a part stands on: its own ground, or the window's, which is there before anything is drawn.
enum class Ground { Panel, Window };

/// Draws one part of the window and keeps the step it gave.
template <class Content>
void part(const Panel& panel, const char* name, Area area, Ground ground, float pad, std::vector<Step>& steps, Content content) {
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(pad), panel.px(pad)});
  const ImGuiWindowFlags scrolling = pad > 0 ? kFixed & ~ImGuiWindowFlags_NoScrollbar : kFixed | ImGuiWindowFlags_NoScrollWithMouse;
  ImGui::Begin(name, nullptr, ground == Ground::Window ? scrolling | ImGuiWindowFlags_NoBackground : scrolling);
  ImGui::PopStyleVar();
  if (Taken taken = content()) steps.push_back(std::move(*taken));
  ImGui::End();
}

/// The program's and the project's name as far as there is room.
void names(const Panel& panel, Area area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = area.y + area.height / 2, right = area.x + area.width;
  drawIcon(list, Icon::Grow, {area.x + panel.px(24), middle}, panel.px(22), panel.palette.accent);
  float x = area.x + panel.px(46);
  list.PushClipRect({area.x, area.y}, {right, area.y + area.height}, true);
  ImGui::PushFont(font(Face::Heading));
  const float title = ImGui::CalcTextSize("Axil Studio").x;
  if (x + title < right) {
    list.AddText({x, middle - ImGui::GetFontSize() / 2}, panel.palette.text, "Axil Studio");
    x += title + panel.px(18);
  }
  ImGui::PopFont();
  const std::string name = panel.project.name + (panel.session.isDirty() ? "  •" : "");
  list.AddText({x, middle - ImGui::GetFontSize() / 2}, panel.palette.quiet, name.c_str());
  list.PopClipRect();
}

void topBar(const Panel& panel, Area area) {
  UiState& state = panel.state;
  static constexpr std::array<const char*, 5> kSteps = {"menu_open", "save", "undo", "redo", "history"};
  float steps = panel.px(30);
  for (const char* key : kSteps) steps += ImGui::CalcTextSize(panel.t(key)).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float middle = area.y + area.height / 2, right = area.x + area.width;
  const float begin = std::clamp(right - panel.px(296) - steps, panel.px(40), panel.px(330));
  names(panel, {area.x, area.y, begin - panel.px(10), area.height});

  const float height = ImGui::GetFrameHeight();
  ImGui::SetCursorScreenPos({area.x + begin, middle - height / 2});
  if (button(panel, "menu_open", Emphasis::Quiet)) state.dialog = {DialogKind::Open, panel.session.openProject().folder, "", ""};
  ImGui::SameLine(0, panel.px(2));
  if (button(panel, "save", Emphasis::Quiet)) state.wishes.push_back(WishSave{});
  ImGui::SameLine(0, panel.px(14));
  ImGui::BeginDisabled(!panel.session.history().canUndo());
  if (button(panel, "undo", Emphasis::Quiet)) state.wishes.push_back(WishUndo{});
  ImGui::EndDisabled();
  ImGui::SameLine(0, panel.px(2));
  ImGui::BeginDisabled(!panel.session.history().canRedo());
  if (button(panel, "redo", Emphasis::Quiet)) state.wishes.push_back(WishRedo{});
  ImGui::EndDisabled();
  ImGui::SameLine(0, panel.px(2));
  if (button(panel, "history", Emphasis::Quiet)) state.history = !state.history;

  static constexpr std::array<const char*, 3> kLanguages = {"English", "繁體中文", "简体中文"};
  ImGui::SetCursorScreenPos({right - panel.px(296), middle - height / 2});
  ImGui::SetNextItemWidth(panel.px(116));
  if (ImGui::BeginCombo("##language", kLanguages[static_cast<std::size_t>(state.language)])) {
    for (std::size_t i = 0; i < kLanguages.size(); ++i)
      if (ImGui::Selectable(kLanguages[i], static_cast<std::size_t>(state.language) == i)) state.language = static_cast<Language>(i);
    ImGui::EndCombo();
  }
  landmark(panel, "language");
  ImGui::SameLine(0, panel.px(6));
  if (button(panel, state.theme == Theme::Dark ? "theme_light" : "theme_dark", Emphasis::Quiet)) state.theme = state.theme == Theme::Dark ? Theme::Light : Theme::Dark;
  ImGui::SameLine(0, panel.px(2));
  if (button(panel, "shortcuts", Emphasis::Quiet)) state.shortcuts = !state.shortcuts;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("F1 · Ctrl+K");
}

Taken leftColumn(const Panel& panel) {
  wayPanel(panel);
  gap(panel, 4);
  ImGui::Separator();
  gap(panel, 6);
  switch (panel.state.way) {
    case Way::Describe: return describePanel(panel);
    case Way::Photos: return photosPanel(panel);
    case Way::Stems: return stemsPanel(panel);
    case Way::Leaves: return leavesPanel(panel);
    case Way::Grammar: return grammarPanel(panel);
    case Way::Grow: return growPanel(panel);
  }
  return std::nullopt;
}

Taken pane(const Panel& panel, int number, Area area) {
  if (number < 3) return photoPane(panel, number, area);
  return plantPane(panel, area);
}

/// A border between two parts that can be dragged; gives how far, in px at scale 1.
enum class Border { Upright, Level };
float draggedBorder(const Panel& panel, const char* name, Area area, Border border) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::InvisibleButton(name, {area.width, area.height});
  landmark(panel, name);
  const bool held = ImGui::IsItemActive();
  if (held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(border == Border::Upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, panel.palette.accentSoft);
    panel.state.status = panel.t("drag_border");
  }
  if (!held) return 0;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  return (border == Border::Upright ? moved.x : moved.y) / panel.state.scale;
}

Taken quadrants(const Panel& panel, Area area) {
  if (panel.state.maximised) return pane(panel, *panel.state.maximised, area);
  Layout& layout = panel.state.preferences.layout;
  const float gapWidth = panel.px(5), roomX = area.width - gapWidth, roomY = area.height - gapWidth;
  const float width = roomX * layout.across, height = roomY * layout.down;
  layout.across += draggedBorder(panel, "border_across", {area.x + width, area.y, gapWidth, area.height}, Border::Upright) * panel.state.scale / roomX;
  layout.down += draggedBorder(panel, "border_down", {area.x, area.y + height, area.width, gapWidth}, Border::Level) * panel.state.scale / roomY;
  layout = withinReason(layout);
  Taken taken;
  for (int i = 0; i < 4; ++i) {
    const bool isRight = i % 2 == 1, isBelow = i / 2 == 1;
    const Area quarter{area.x + (isRight ? width + gapWidth : 0), area.y + (isBelow ? height + gapWidth : 0), isRight ? roomX - width : width, isBelow ? roomY - height : height};
    if (Taken one = pane(panel, i, quarter)) taken = std::move(one);
  }
  return taken;
}

Taken centre(const Panel& panel, Area area) {
  const bool empty = panel.project == document::Project{} && !panel.state.begun && panel.session.path().empty() && !panel.session.history().canUndo();
  if (empty) {
    welcome(panel, area);
    return std::nullopt;
  }
  const float gapWidth = panel.px(4);
  const Area left{area.x, area.y, (area.width - gapWidth) * 0.56f, area.height};
  const Area right{area.x + left.width + gapWidth, area.y, area.width - left.width - gapWidth, area.height};
  switch (panel.state.way) {
    case Way::Describe: {
      Taken taken = descriptionText(panel, left);
      if (Taken moved = plantPane(panel, right)) taken = std::move(moved);
      return taken;
    }
    case Way::Grammar: {
      const bool wide = panel.state.sideBySide && !panel.state.grammarDraft;
      Taken taken = grammarText(panel, wide ? area : left);
      if (wide) return taken;
      if (Taken moved = plantPane(panel, right)) taken = std::move(moved);
      return taken;
    }
    case Way::Grow: return plantPane(panel, area);
    case Way::Photos:
    case Way::Stems:
    case Way::Leaves: return quadrants(panel, area);
  }
  return std::nullopt;
}

void statusLine(const Panel& panel, Area area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(font(Face::Small));
  const float y = area.y + (area.height - ImGui::GetFontSize()) / 2;
  const char* idle = panel.project.views.empty() ? "status_idle_empty" : "status_idle";
  const std::string text = panel.state.status.empty() ? panel.t(idle) : panel.state.status;
  list.AddCircleFilled({area.x + panel.px(16), area.y + area.height / 2}, panel.px(4), panel.palette.accent);
  list.AddText({area.x + panel.px(28), y}, panel.palette.text, text.c_str());
  if (const auto& notice = panel.state.notice) {
    const Colour colour = notice->kind == NoticeKind::Failed ? panel.palette.error : notice->kind == NoticeKind::Warned ? panel.palette.warning : panel.palette.quiet;
    const float room = area.width * 0.52f, width = std::min(ImGui::CalcTextSize(notice->text.c_str()).x, room);
    const float x = area.x + area.width - width - panel.px(14);
    list.PushClipRect({x, area.y}, {area.x + area.width, area.y + area.height}, true);
    list.AddText({x, y}, colour, notice->text.c_str());
    list.PopClipRect();
    ImGui::SetCursorScreenPos({x, area.y});
    ImGui::InvisibleButton("notice", {width, area.height});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", notice->text.c_str());
  }
  ImGui::PopFont();
}

}  // namespace

std::vector<Step> shell(const Panel& panel) {
  std::vector<Step> steps;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  Layout& layout = panel.state.preferences.layout;
  const float top = panel.px(46), status = panel.px(30), below = panel.px(72), between = panel.px(5);
  // Where everything is large and the window small, photos keep their room.
  const float left = std::min(panel.px(layout.left), 0.3f * screen.x), right = std::min(panel.px(layout.right), 0.24f * screen.x);
  const Area barArea{0, 0, screen.x, top};
  const Area statusArea{0, screen.y - status, screen.x, status};
  const Area timeArea{left + between, screen.y - status - below, screen.x - left - between, below};
  const Area leftArea{0, top, left, screen.y - top - status};
  const Area rightArea{screen.x - right, top, right, screen.y - top - status - below - between};
  const Area middle{left + between, top, std::max(64.0f, screen.x - left - right - 2 * between), std::max(64.0f, screen.y - top - status - below - between)};
  panel.state.hover.reset();
  panel.state.meaning.reset();
  panel.state.ridge.reset();
  panel.state.wire.reset();
  panel.state.status.clear();
  panel.state.landmarks.clear();
  panel.state.shownTroubles = 0;
  panel.state.plantPaneSize = {0, 0};
  part(panel, "##bar", barArea, Ground::Panel, 0, steps, [&] { return topBar(panel, barArea), Taken{}; });
  part(panel, "##left", leftArea, Ground::Panel, 12, steps, [&] { return leftColumn(panel); });
  part(panel, "##centre", middle, Ground::Window, 0, steps, [&] { return centre(panel, middle); });
  part(panel, "##right", rightArea, Ground::Panel, 14, steps, [&] { return inspector(panel); });
  part(panel, "##left_border", {left, top, between, leftArea.height}, Ground::Window, 0, steps,
       [&] { return layout.left += draggedBorder(panel, "border_left", {left, top, between, leftArea.height}, Border::Upright), Taken{}; });
  part(panel, "##right_border", {rightArea.x - between, top, between, rightArea.height}, Ground::Window, 0, steps,
       [&] { return layout.right -= draggedBorder(panel, "border_right", {rightArea.x - between, top, between, rightArea.height}, Border::Upright), Taken{}; });
  layout = withinReason(layout);
  part(panel, "##time", timeArea, Ground::Panel, 0, steps, [&] { return timeline(panel, timeArea), Taken{}; });
  part(panel, "##status", statusArea, Ground::Window, 0, steps, [&] { return statusLine(panel, statusArea), Taken{}; });
  if (panel.state.shortcuts) shortcutsSheet(panel);
  if (panel.state.history) historySheet(panel);
  if (panel.state.tour) tourCard(panel);
  if (panel.state.palette)
    if (Taken taken = paletteSheet(panel)) steps.push_back(std::move(*taken));
  if (panel.state.question) questionSheet(panel);
  if (Taken taken = fileDialog(panel)) steps.push_back(std::move(*taken));
  return steps;
}

void applyLook(const Palette& p, float scale) {
  ImGuiStyle style;
  style.WindowRounding = 0;
  style.ChildRounding = 4;
  style.FrameRounding = 6;
  style.PopupRounding = 6;
  style.GrabRounding = 6;
  style.ScrollbarRounding = 6;
  style.ScrollbarSize = 10;
  style.WindowBorderSize = 0;
  style.WindowMinSize = {1, 1};
  style.ChildBorderSize = 0;
  style.FramePadding = {11, 6};
  style.ItemSpacing = {8, 6};
  style.GrabMinSize = 12;
  style.ScaleAllSizes(scale);
  const auto set = [&](ImGuiCol which, Colour colour) { style.Colors[which] = ImGui::ColorConvertU32ToFloat4(colour); };
  set(ImGuiCol_Text, p.text);
  set(ImGuiCol_TextDisabled, p.quiet);
  set(ImGuiCol_WindowBg, p.panel);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, p.raised);
  set(ImGuiCol_Border, p.line);
  set(ImGuiCol_Separator, p.line);
  for (const ImGuiCol which : {ImGuiCol_FrameBg, ImGuiCol_Button}) set(which, p.raised);
  for (const ImGuiCol which : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive}) set(which, p.hovered);
  for (const ImGuiCol which : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive, ImGuiCol_TextSelectedBg}) set(which, p.accentSoft);
  set(ImGuiCol_Header, p.raised);
  set(ImGuiCol_ScrollbarBg, 0);
  set(ImGuiCol_ScrollbarGrab, p.line);
  for (const ImGuiCol which : {ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogram}) set(which, p.accent);
  ImGui::GetStyle() = style;
}

}  // namespace axil::ui
