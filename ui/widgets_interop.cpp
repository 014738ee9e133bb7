#include "ui/widgets_interop.hpp"

#include "keywords/presets.hpp"
#include "organs/leaf.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {

ImFont* font(Face face) { return ImGui::GetIO().Fonts->Fonts[static_cast<int>(face)]; }

namespace {

using Points = std::vector<ImVec2>;

/// A line drawing in a square from -1 to 1.
void strokes(ImDrawList& list, std::initializer_list<Points> lines, ImVec2 centre, float half, Colour colour, float width) {
  for (const Points& line : lines) {
    for (const ImVec2& p : line) list.PathLineTo(ImVec2(centre.x + p.x * half, centre.y + p.y * half));
    list.PathStroke(colour, 0, width);
  }
}

void leafIcon(ImDrawList& list, ImVec2 c, float h, Colour colour, float width) {
  list.PathLineTo({c.x - 0.75f * h, c.y + 0.75f * h});
  list.PathBezierCubicCurveTo({c.x - 1.1f * h, c.y - 0.3f * h}, {c.x - 0.2f * h, c.y - 1.0f * h}, {c.x + 0.9f * h, c.y - 0.9f * h});
  list.PathBezierCubicCurveTo({c.x + 1.0f * h, c.y + 0.2f * h}, {c.x + 0.3f * h, c.y + 1.1f * h}, {c.x - 0.75f * h, c.y + 0.75f * h});
  list.PathStroke(colour, 0, width);
  strokes(list, {{{-0.75f, 0.75f}, {0.35f, -0.35f}}}, c, h, colour, width);
}

}  // namespace

void drawIcon(ImDrawList& list, Icon icon, ImVec2 c, float size, Colour colour) {
  const float h = size / 2, w = std::max(1.4f, size / 12);
  switch (icon) {
    case Icon::Describe: strokes(list, {{{-0.9f, -0.7f}, {0.9f, -0.7f}}, {{-0.9f, -0.1f}, {0.9f, -0.1f}}, {{-0.9f, 0.5f}, {0.2f, 0.5f}}}, c, h, colour, w); break;
    case Icon::Photos:
      list.AddRect({c.x - h, c.y - 0.65f * h}, {c.x + h, c.y + 0.8f * h}, colour, 0.25f * h, 0, w);
      list.AddCircle({c.x, c.y + 0.1f * h}, 0.42f * h, colour, 16, w);
      strokes(list, {{{-0.4f, -0.65f}, {-0.25f, -0.95f}, {0.25f, -0.95f}, {0.4f, -0.65f}}}, c, h, colour, w);
      break;
    case Icon::Stems:
      strokes(list, {{{0, 1}, {0, -0.5f}}, {{0, 0.5f}, {0.65f, -0.25f}}, {{0, 0.1f}, {-0.6f, -0.5f}}}, c, h, colour, w);
      for (const ImVec2 p : {ImVec2{0, -0.7f}, {0.75f, -0.4f}, {-0.7f, -0.65f}}) list.AddCircleFilled({c.x + p.x * h, c.y + p.y * h}, 0.2f * h, colour);
      break;
    case Icon::Leaves: leafIcon(list, c, h, colour, w); break;
    case Icon::Grammar:
      strokes(list, {{{-0.45f, -0.9f}, {-0.75f, -0.7f}, {-0.75f, -0.2f}, {-1, 0}, {-0.75f, 0.2f}, {-0.75f, 0.7f}, {-0.45f, 0.9f}},
                     {{0.45f, -0.9f}, {0.75f, -0.7f}, {0.75f, -0.2f}, {1, 0}, {0.75f, 0.2f}, {0.75f, 0.7f}, {0.45f, 0.9f}}}, c, h, colour, w);
      for (const float x : {-0.3f, 0.0f, 0.3f}) list.AddCircleFilled({c.x + x * h, c.y}, 0.11f * h, colour);
      break;
    case Icon::Grow:
      strokes(list, {{{0, 1}, {0, -0.2f}}, {{-0.8f, 1}, {0.8f, 1}}}, c, h, colour, w);
      list.PathLineTo({c.x, c.y + 0.1f * h});
      list.PathBezierCubicCurveTo({c.x - 0.9f * h, c.y + 0.1f * h}, {c.x - 0.95f * h, c.y - 0.6f * h}, {c.x - 0.9f * h, c.y - 0.8f * h});
      list.PathBezierCubicCurveTo({c.x - 0.3f * h, c.y - 0.8f * h}, {c.x, c.y - 0.5f * h}, {c.x, c.y + 0.1f * h});
      list.PathBezierCubicCurveTo({c.x, c.y - 0.6f * h}, {c.x + 0.4f * h, c.y - 1.0f * h}, {c.x + 0.9f * h, c.y - 1.0f * h});
      list.PathBezierCubicCurveTo({c.x + 0.9f * h, c.y - 0.3f * h}, {c.x + 0.5f * h, c.y - 0.1f * h}, {c.x, c.y + 0.1f * h});
      list.PathStroke(colour, 0, w);
      break;
    case Icon::Play: list.AddTriangleFilled({c.x - 0.6f * h, c.y - 0.8f * h}, {c.x + 0.85f * h, c.y}, {c.x - 0.6f * h, c.y + 0.8f * h}, colour); break;
    case Icon::Pause:
      list.AddRectFilled({c.x - 0.65f * h, c.y - 0.75f * h}, {c.x - 0.2f * h, c.y + 0.75f * h}, colour, 1);
      list.AddRectFilled({c.x + 0.2f * h, c.y - 0.75f * h}, {c.x + 0.65f * h, c.y + 0.75f * h}, colour, 1);
      break;
    case Icon::Start:
      list.AddRectFilled({c.x - 0.75f * h, c.y - 0.7f * h}, {c.x - 0.5f * h, c.y + 0.7f * h}, colour);
      list.AddTriangleFilled({c.x + 0.7f * h, c.y - 0.7f * h}, {c.x + 0.7f * h, c.y + 0.7f * h}, {c.x - 0.45f * h, c.y}, colour);
      break;
    case Icon::End:
      list.AddRectFilled({c.x + 0.5f * h, c.y - 0.7f * h}, {c.x + 0.75f * h, c.y + 0.7f * h}, colour);
      list.AddTriangleFilled({c.x - 0.7f * h, c.y - 0.7f * h}, {c.x + 0.45f * h, c.y}, {c.x - 0.7f * h, c.y + 0.7f * h}, colour);
      break;
    case Icon::Check: strokes(list, {{{-0.7f, 0.05f}, {-0.2f, 0.6f}, {0.75f, -0.55f}}}, c, h, colour, w); break;
    case Icon::Cross: strokes(list, {{{-0.6f, -0.6f}, {0.6f, 0.6f}}, {{-0.6f, 0.6f}, {0.6f, -0.6f}}}, c, h, colour, w); break;
    case Icon::Folder: strokes(list, {{{-0.9f, -0.6f}, {-0.3f, -0.6f}, {-0.1f, -0.35f}, {0.9f, -0.35f}, {0.9f, 0.7f}, {-0.9f, 0.7f}, {-0.9f, -0.6f}}}, c, h, colour, w); break;
    case Icon::File: strokes(list, {{{-0.6f, -0.85f}, {0.2f, -0.85f}, {0.6f, -0.45f}, {0.6f, 0.85f}, {-0.6f, 0.85f}, {-0.6f, -0.85f}}}, c, h, colour, w); break;
    case Icon::Eye:
      list.PathLineTo({c.x - h, c.y});
      list.PathBezierQuadraticCurveTo({c.x, c.y - 1.2f * h}, {c.x + h, c.y});
      list.PathBezierQuadraticCurveTo({c.x, c.y + 1.2f * h}, {c.x - h, c.y});
      list.PathStroke(colour, 0, w);
      list.AddCircleFilled(c, 0.28f * h, colour);
      break;
    case Icon::Pencil: strokes(list, {{{-0.8f, 0.8f}, {-0.7f, 0.35f}, {0.45f, -0.8f}, {0.8f, -0.45f}, {-0.35f, 0.7f}, {-0.8f, 0.8f}}, {{0.2f, -0.55f}, {0.55f, -0.2f}}}, c, h, colour, w); break;
    case Icon::Expand: strokes(list, {{{-0.2f, -0.8f}, {-0.8f, -0.8f}, {-0.8f, -0.2f}}, {{0.2f, 0.8f}, {0.8f, 0.8f}, {0.8f, 0.2f}}}, c, h, colour, w); break;
  }
}

void landmark(const Panel& panel, std::string_view key) {
  const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  panel.state.landmarks.insert_or_assign(std::string(key), std::array<float, 4>{low.x, low.y, size.x, size.y});
}

bool button(const Panel& panel, std::string_view key, Emphasis emphasis, float width) {
  const Palette& p = panel.palette;
  if (emphasis == Emphasis::Primary) {
    ImGui::PushStyleColor(ImGuiCol_Button, p.accent);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, withAlpha(p.accent, 225));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, withAlpha(p.accent, 190));
    ImGui::PushStyleColor(ImGuiCol_Text, p.onAccent);
  } else {
    ImGui::PushStyleColor(ImGuiCol_Button, emphasis == Emphasis::Quiet ? 0 : p.raised);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, p.hovered);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, p.accentSoft);
    ImGui::PushStyleColor(ImGuiCol_Text, p.text);
  }
  const std::string label = std::string(panel.t(key)) + "##" + std::string(key);
  const bool pressed = ImGui::Button(label.c_str(), {width, 0});
  ImGui::PopStyleColor(4);
  landmark(panel, key);
  return pressed;
}

bool iconButton(const Panel& panel, const char* id, Icon icon, const char* tip, float size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(id, {size, size});
  landmark(panel, id);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) {
    list.AddRectFilled(at, {at.x + size, at.y + size}, panel.palette.hovered, panel.px(5));
    if (tip != nullptr) ImGui::SetTooltip("%s", tip);
  }
  drawIcon(list, icon, {at.x + size / 2, at.y + size / 2}, size * 0.5f, panel.palette.text);
  return pressed;
}

bool choice(const Panel& panel, std::string_view key, bool chosen, float width) {
  const Palette& p = panel.palette;
  ImGui::PushStyleColor(ImGuiCol_Button, chosen ? p.accentSoft : p.raised);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, chosen ? p.accentSoft : p.hovered);
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, p.accentSoft);
  ImGui::PushStyleColor(ImGuiCol_Text, chosen ? p.accent : p.text);
  const std::string label = std::string(panel.t(key)) + "##" + std::string(key);
  const bool pressed = ImGui::Button(label.c_str(), {width, 0});
  ImGui::PopStyleColor(4);
  landmark(panel, key);
  return pressed;
}

void heading(const Panel& panel, std::string_view key) {
  ImGui::PushFont(font(Face::Heading));
  ImGui::TextUnformatted(panel.t(key));
  ImGui::PopFont();
  gap(panel, 2);
}

void words(const Panel&, std::string_view text, Colour colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void quiet(const Panel& panel, std::string_view text) {
  ImGui::PushFont(font(Face::Small));
  words(panel, text, panel.palette.quiet);
  ImGui::PopFont();
}

void say(const Panel& panel, NoticeKind kind, std::string_view text) {
  const Colour colour = kind == NoticeKind::Failed ? panel.palette.error : kind == NoticeKind::Warned ? panel.palette.warning : panel.palette.quiet;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Indent(panel.px(10));
  ImGui::PushFont(font(Face::Small));
  words(panel, panel.texts.translated(text, panel.state.language), colour);
  ImGui::PopFont();
  ImGui::Unindent(panel.px(10));
  list.AddRectFilled({at.x, at.y + 2}, {at.x + panel.px(3), ImGui::GetItemRectMax().y}, colour, 1);
}

void fact(const Panel& panel, const char* name, const std::string& value) {
  ImGui::PushFont(font(Face::Small));
  const float right = ImGui::GetContentRegionAvail().x;
  const float start = ImGui::GetCursorPosX();
  ImGui::PushStyleColor(ImGuiCol_Text, panel.palette.quiet);
  ImGui::TextUnformatted(name);
  ImGui::PopStyleColor();
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(start + std::max(right - width, ImGui::GetItemRectSize().x + panel.px(8)));
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
}

void gap(const Panel& panel, float height) { ImGui::Dummy({1, panel.px(height)}); }

float chip(ImDrawList& list, ImVec2 at, std::string_view text, Colour ground, Colour ink, float pad) {
  const ImVec2 size = ImGui::CalcTextSize(text.data(), text.data() + text.size());
  list.AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y + pad}, ground, pad * 0.9f);
  list.AddText({at.x + pad, at.y + pad / 2}, ink, text.data(), text.data() + text.size());
  return size.x + 2 * pad;
}

void drawMark(ImDrawList& list, Mark mark, ImVec2 at, float r, Colour colour) {
  const Colour rim = rgb(0x101010, 200 * (colour >> IM_COL32_A_SHIFT) / 255);  // a mark that stands back has no black edge
  switch (mark) {
    case Mark::Disc:
      list.AddCircleFilled(at, r + 1.2f, rim, 20);
      list.AddCircleFilled(at, r, colour, 20);
      break;
    case Mark::Square:
      list.AddRectFilled({at.x - r - 1, at.y - r - 1}, {at.x + r + 1, at.y + r + 1}, rim);
      list.AddRectFilled({at.x - r + 0.3f, at.y - r + 0.3f}, {at.x + r - 0.3f, at.y + r - 0.3f}, colour);
      break;
    case Mark::Diamond:
      list.AddQuadFilled({at.x, at.y - 1.4f * r - 1}, {at.x + 1.4f * r + 1, at.y}, {at.x, at.y + 1.4f * r + 1}, {at.x - 1.4f * r - 1, at.y}, rim);
      list.AddQuadFilled({at.x, at.y - 1.25f * r}, {at.x + 1.25f * r, at.y}, {at.x, at.y + 1.25f * r}, {at.x - 1.25f * r, at.y}, colour);
      break;
    case Mark::Triangle:
      list.AddTriangleFilled({at.x, at.y - 1.5f * r - 1}, {at.x + 1.35f * r + 1, at.y + r + 1}, {at.x - 1.35f * r - 1, at.y + r + 1}, rim);
      list.AddTriangleFilled({at.x, at.y - 1.3f * r}, {at.x + 1.15f * r, at.y + 0.85f * r}, {at.x - 1.15f * r, at.y + 0.85f * r}, colour);
      break;
  }
}

void dashed(ImDrawList& list, ImVec2 from, ImVec2 to, Colour colour, float width, float dash) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::sqrt(dx * dx + dy * dy);
  if (length < 1 || length > 20000) return;
  for (float s = 0; s < length; s += 2 * dash) {
    const float e = std::min(s + dash, length);
    list.AddLine({from.x + dx * s / length, from.y + dy * s / length}, {from.x + dx * e / length, from.y + dy * e / length}, colour, width);
  }
}

std::string nameOfView(const Panel& panel, const std::string& view) {
  const std::string key = "view_" + view;
  return panel.texts.has(key) ? panel.t(key) : view;
}

std::string countOf(const Panel& panel, std::size_t n, const char* key) { return filled(panel.t(key), {{"n", std::to_string(n)}}); }

void leafPreview(const Panel& panel, const std::string& shape) {
  const auto known = organs::leafShapeNamed(keywords::drawnShapeOf(shape));
  if (!known) return;
  const auto outline = organs::leafOutline(*known);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = panel.px(104), width = ImGui::GetContentRegionAvail().x;
  list.AddRectFilled(at, {at.x + width, at.y + height}, panel.palette.raised, panel.px(6));
  float low = 0, high = 1, wide = 0.2f;
  for (const glm::vec2& p : outline) low = std::min(low, p.y), high = std::max(high, p.y), wide = std::max(wide, std::abs(p.x));
  const float scale = std::min((width - panel.px(20)) / (high - low + 0.12f), (height - panel.px(16)) / (2 * wide));
  const ImVec2 base{at.x + (width - (high + low) * scale) / 2 , at.y + height / 2};
  const auto place = [&](glm::vec2 p) { return ImVec2(base.x + p.y * scale, base.y + p.x * scale); };
  // A fan from the middle of the midrib fills every blade that is not cut deep; cut ones are outlined only.
  if (known->lobes == organs::LeafLobes::None)
    for (std::size_t i = 0; i < outline.size(); ++i) list.AddTriangleFilled(place({0, 0.5f}), place(outline[i]), place(outline[(i + 1) % outline.size()]), withAlpha(panel.palette.accent, 90));
  for (const glm::vec2& p : outline) list.PathLineTo(place(p));
  list.PathStroke(panel.palette.accent, ImDrawFlags_Closed, panel.px(1.6f));
  list.AddLine(place({0, -0.1f}), place({0, 1}), panel.palette.accent, panel.px(1.2f));
  ImGui::Dummy({width, height});
}

bool combo(const char* id, const std::vector<std::string>& names, std::string& chosen, const char* none) {
  bool changed = false;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo(id, chosen.empty() ? none : chosen.c_str())) return false;
  if (ImGui::Selectable(none, chosen.empty())) chosen.clear(), changed = true;
  for (const std::string& name : names)
    if (ImGui::Selectable(name.c_str(), name == chosen)) chosen = name, changed = true;
  ImGui::EndCombo();
  return changed;
}

std::vector<std::string> leafShapeNames() {
  std::vector<std::string> names;
  for (const organs::LeafShape& shape : organs::leafShapes()) names.push_back(shape.name);
  return names;
}

}  // namespace axil::ui
