#include "base/text.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <imgui_stdlib.h>

namespace axil::ui {
namespace {

// ---- the description with what was found in it --------------------------------------------------------------------------------

/// Pieces that may stand at a line's end: a Latin word with the blanks after it, or one Chinese character.
std::vector<SourceSpan> piecesOf(std::string_view text) {
  std::vector<SourceSpan> pieces;
  for (std::uint32_t at = 0; at < text.size();) {
    std::uint32_t end = at + static_cast<std::uint32_t>(utf8Length(text[at]));
    if (static_cast<unsigned char>(text[at]) < 0x80 && text[at] != '\n')
      while (end < text.size() && static_cast<unsigned char>(text[end]) < 0x80 && text[end - 1] != ' ' && text[end] != '\n') ++end;
    end = std::min(end, static_cast<std::uint32_t>(text.size()));
    pieces.push_back({at, end});
    at = end;
  }
  return pieces;
}

const keywords::Trait* traitAt(const Panel& panel, std::uint32_t byte, std::size_t& index) {
  if (!panel.following.said) return nullptr;
  for (index = 0; index < panel.following.said->size(); ++index)
    if (const auto& trait = (*panel.following.said)[index]; trait.span.begin <= byte && byte < trait.span.end) return &trait;
  return nullptr;
}

/// A piece may be partly found: it is drawn character by character where it is.
void drawPiece(const Panel& panel, ImDrawList& list, std::string_view text, SourceSpan piece, ImVec2 at) {
  for (std::uint32_t byte = piece.begin; byte < piece.end;) {
    std::size_t index = 0;
    const keywords::Trait* trait = traitAt(panel, byte, index);
    std::uint32_t end = byte;
    for (std::size_t other = 0; end < piece.end && (traitAt(panel, end, other) == nullptr ? nullptr : &(*panel.following.said)[other]) == trait;)
      end += static_cast<std::uint32_t>(utf8Length(text[end]));
    end = std::min(end, piece.end);
    const ImVec2 size = ImGui::CalcTextSize(text.data() + byte, text.data() + end);
    if (trait != nullptr) {
      const bool hot = panel.state.hotTrait == index;
      list.AddRectFilled({at.x, at.y - 1}, {at.x + size.x, at.y + size.y + 1}, hot ? panel.palette.accent : panel.palette.accentSoft, 2);
      list.AddText(at, hot ? panel.palette.onAccent : panel.palette.accent, text.data() + byte, text.data() + end);
    } else {
      list.AddText(at, panel.palette.text, text.data() + byte, text.data() + end);
    }
    at.x += size.x;
    byte = std::max(end, byte + 1);
  }
}

void highlighted(const Panel& panel, std::string_view text, float width) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetFontSize() * 1.65f;
  ImVec2 at = start;
  for (const SourceSpan piece : piecesOf(text)) {
    if (text[piece.begin] == '\n') {
      at = {start.x, at.y + line};
      continue;
    }
    const float w = ImGui::CalcTextSize(text.data() + piece.begin, text.data() + piece.end).x;
    if (at.x > start.x && at.x + w > start.x + width) at = {start.x, at.y + line};
    drawPiece(panel, list, text, piece, at);
    at.x += w;
  }
  ImGui::Dummy({width, at.y + line - start.y});
}

}  // namespace

Taken descriptionText(const Panel& panel, Area area) {
  Taken taken;
  UiState& state = panel.state;
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, panel.palette.panel);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(26), panel.px(22)});
  ImGui::BeginChild("##description", {area.width, area.height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  heading(panel, "description");
  quiet(panel, panel.t("description_help"));
  gap(panel, 8);
  const std::string& text = panel.project.description.text();
  if (!state.describing) {
    if (text.empty()) quiet(panel, panel.t("description_none"));
    else highlighted(panel, text, std::min(ImGui::GetContentRegionAvail().x, panel.px(760)));
    gap(panel, 12);
    if (button(panel, "description_edit", Emphasis::Primary)) {
      state.describing = true;
      state.descriptionDraft = text;
    }
  } else {
    ImGui::InputTextMultiline("##text", &state.descriptionDraft, {-1, ImGui::GetContentRegionAvail().y - panel.px(54)});
    landmark(panel, "description_field");
    gap(panel, 4);
    if (button(panel, "description_done", Emphasis::Primary)) {
      state.describing = false;
      if (state.descriptionDraft != text) taken = document::Step{document::SetDescription{state.descriptionDraft}};
    }
    ImGui::SameLine(0, panel.px(8));
    if (button(panel, "cancel")) state.describing = false;
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return taken;
}

// ---- nothing is open ----------------------------------------------------------------------------------------------------------

namespace {

void recentProjects(const Panel& panel) {
  const auto& recent = panel.state.preferences.recent;
  if (recent.empty()) return;
  gap(panel, 10);
  heading(panel, "recent_projects");
  for (std::size_t i = 0; i < recent.size(); ++i) {
    const std::string label = recent[i].filename().string() + "##recent" + std::to_string(i);
    if (ImGui::Selectable(label.c_str())) panel.state.wishes.push_back(WishOpen{recent[i]});
    landmark(panel, "recent_" + std::to_string(i));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", recent[i].string().c_str());
    ImGui::SameLine(panel.px(180));
    ImGui::TextDisabled("%s", recent[i].parent_path().string().c_str());
  }
}

}  // namespace

void welcome(const Panel& panel, Area area) {
  const float width = panel.px(440);
  ImGui::SetCursorScreenPos({area.x + (area.width - width) / 2, area.y + area.height * 0.14f});
  ImGui::BeginChild("##welcome", {width, area.height * 0.84f});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  drawIcon(list, Icon::Grow, {at.x + panel.px(30), at.y + panel.px(30)}, panel.px(56), panel.palette.accent);
  ImGui::Dummy({1, panel.px(68)});
  heading(panel, "welcome");
  words(panel, panel.t("welcome_text"), panel.palette.quiet);
  gap(panel, 12);
  const std::filesystem::path samples = samplesFolder();
  if (!samples.empty() && button(panel, "open_sample", Emphasis::Primary, width)) panel.state.wishes.push_back(WishOpen{samples / "lantana" / "lantana.axil"});
  gap(panel, 2);
  if (!samples.empty() && button(panel, "tour_offer", Emphasis::Plain, width)) panel.state.wishes.push_back(WishTour{});
  gap(panel, 2);
  if (button(panel, "new_from_photos", Emphasis::Plain, width)) {
    panel.state.way = Way::Photos;
    panel.state.begun = true;
    panel.state.dialog = {DialogKind::Photo, std::filesystem::current_path(), "", "front"};
  }
  gap(panel, 2);
  if (button(panel, "open_project", Emphasis::Plain, width)) panel.state.dialog = {DialogKind::Open, std::filesystem::current_path(), "", ""};
  gap(panel, 8);
  quiet(panel, panel.t("welcome_drop"));
  recentProjects(panel);
  ImGui::EndChild();
}

}  // namespace axil::ui
