#include "base/text.hpp"
#include "document/command_text.hpp"
#include "ui/actions.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <imgui_stdlib.h>

namespace axil::ui {
namespace {

bool beginSheet(const Panel& panel, const char* key, ImVec2 size) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({(screen.x - size.x) / 2, (screen.y - size.y) / 2});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(22), panel.px(18)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, panel.px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, panel.px(1));
  const bool open = ImGui::Begin(key, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(3);
  return open;
}

}  // namespace

void shortcutsSheet(const Panel& panel) {
  static constexpr std::array<std::pair<const char*, const char*>, 8> kGestures = {{{"Shift + click", "key_shift"}, {"Ctrl + click", "key_also"}, {"drag", "key_drag"}, {"drag beside nodes", "key_box"},
      {"Alt + drag", "key_lasso"}, {"right click", "key_menu"}, {"wheel", "key_wheel"}, {"right or middle drag", "key_pan"}}};
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (beginSheet(panel, "##shortcuts", {std::min(panel.px(940), 0.94f * screen.x), std::min(panel.px(640), 0.9f * screen.y)})) {
    heading(panel, "shortcuts");
    ImGui::BeginChild("##rows", {0, -panel.px(46)});
    std::vector<std::pair<const char*, const char*>> rows(kGestures.begin(), kGestures.end());
    for (const Action& action : actions())
      if (action.keys[0] != '\0') rows.emplace_back(action.keys, action.name);
    const std::size_t half = (rows.size() + 1) / 2;
    if (ImGui::BeginTable("##keys", 4)) {
      for (const float width : {150.0f, 290.0f, 120.0f, 290.0f}) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, panel.px(width));
      for (std::size_t i = 0; i < half; ++i)
        for (const std::size_t which : {i, i + half}) {
          if (which >= rows.size()) continue;
          ImGui::TableNextColumn();
          words(panel, rows[which].first, panel.palette.accent);
          ImGui::TableNextColumn();
          ImGui::TextUnformatted(panel.t(rows[which].second));
        }
      ImGui::EndTable();
    }
    ImGui::EndChild();
    if (button(panel, "close", Emphasis::Primary)) panel.state.shortcuts = false;
  }
  ImGui::End();
}

void historySheet(const Panel& panel) {
  const auto& entries = panel.session.history().entries();
  if (beginSheet(panel, "##history", {panel.px(620), panel.px(520)})) {
    heading(panel, "history");
    quiet(panel, panel.t("history_help"));
    gap(panel, 4);
    ImGui::BeginChild("##steps", {0, -panel.px(46)});
    ImGui::PushFont(font(Face::Mono));
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::string line = i == 0 ? panel.t("history_start") : document::print(entries[i].step);
      const std::string label = line.substr(0, 160) + "##" + std::to_string(i);
      if (i > panel.session.history().position()) ImGui::PushStyleColor(ImGuiCol_Text, panel.palette.quiet);
      if (ImGui::Selectable(label.c_str(), i == panel.session.history().position())) panel.state.wishes.push_back(WishGoTo{i});
      if (i > panel.session.history().position()) ImGui::PopStyleColor();
    }
    ImGui::PopFont();
    ImGui::EndChild();
    if (button(panel, "close", Emphasis::Primary)) panel.state.history = false;
  }
  ImGui::End();
}

void questionSheet(const Panel& panel) {
  UiState& state = panel.state;
  const Question question = *state.question;
  if (beginSheet(panel, "##question", {panel.px(470), panel.px(170)})) {
    if (const auto* unsaved = std::get_if<Unsaved>(&question)) {
      heading(panel, "unsaved");
      words(panel, filled(panel.t("unsaved_text"), {{"name", panel.project.name}}), panel.palette.quiet);
      gap(panel, 10);
      if (button(panel, "save", Emphasis::Primary)) {
        state.question.reset();
        state.wishes.push_back(WishSave{});
        if (!panel.session.path().empty()) state.wishes.push_back(unsaved->then);
      }
      ImGui::SameLine(0, panel.px(8));
      if (button(panel, "discard")) {
        state.question.reset();
        state.leaveUnsaved = true;
        state.wishes.push_back(unsaved->then);
      }
      ImGui::SameLine(0, panel.px(8));
      if (button(panel, "cancel")) state.question.reset();
    } else if (const auto* left = std::get_if<LeftWork>(&question)) {
      heading(panel, "left_work");
      words(panel, filled(panel.t("left_work_text"), {{"n", std::to_string(left->actions)}}), panel.palette.quiet);
      gap(panel, 10);
      if (button(panel, "recover", Emphasis::Primary)) state.wishes.push_back(WishRecover{left->journal}), state.question.reset();
      ImGui::SameLine(0, panel.px(8));
      if (button(panel, "discard")) state.wishes.push_back(WishForget{left->journal}), state.question.reset();
    }
  }
  ImGui::End();
}

// ---- the palette -------------------------------------------------------------------------------------------------------------

namespace {

constexpr int kPaletteRows = 11;

Taken paletteRow(const Panel& panel, const Action& action, bool chosen) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = panel.px(32);
  const bool pressed = ImGui::InvisibleButton(action.name, {width, height});
  landmark(panel, std::string("do_") + action.name);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (chosen || ImGui::IsItemHovered()) list.AddRectFilled(at, {at.x + width, at.y + height}, chosen ? panel.palette.accentSoft : panel.palette.hovered, panel.px(6));
  const float y = at.y + (height - ImGui::GetFontSize()) / 2;
  list.AddText({at.x + panel.px(12), y}, panel.palette.text, panel.t(action.name));
  list.AddText({at.x + width - panel.px(12) - ImGui::CalcTextSize(action.keys).x, y}, panel.palette.quiet, action.keys);
  if (!pressed) return std::nullopt;
  panel.state.palette.reset();
  return action.act(panel);
}

}  // namespace

Taken paletteSheet(const Panel& panel) {
  Taken taken;
  ImGui::SetNextWindowFocus();
  if (beginSheet(panel, "##palette", {panel.px(560), panel.px(470)})) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##typed", panel.t("palette_hint"), &panel.state.palette->typed)) panel.state.palette->chosen = 0;
    gap(panel, 4);
    const auto found = actionsFor(panel, panel.state.palette->typed);
    int& chosen = panel.state.palette->chosen;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) ++chosen;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) --chosen;
    chosen = std::clamp(chosen, 0, std::max(0, static_cast<int>(found.size()) - 1));
    if (found.empty()) quiet(panel, panel.t("palette_none"));
    const int first = std::max(0, chosen - kPaletteRows + 1);
    const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && !found.empty();
    const int picked = chosen;  // an action that is taken closes the palette
    for (int i = first; i < std::min(first + kPaletteRows, static_cast<int>(found.size())) && panel.state.palette; ++i)
      if (Taken one = paletteRow(panel, *found[static_cast<std::size_t>(i)], i == picked)) taken = std::move(one);
    if (entered && panel.state.palette) {
      panel.state.palette.reset();
      taken = found[static_cast<std::size_t>(picked)]->act(panel);
    }
  }
  ImGui::End();
  return taken;
}

// ---- the guided tour ---------------------------------------------------------------------------------------------------------

namespace {

/// One card: where it leads, what it says and what it points at.
struct TourCard {
  Way way;
  const char* words;
  const char* landmark;
};
constexpr std::array<TourCard, 5> kTour = {{{Way::Photos, "tour_photos", "pane_front"}, {Way::Stems, "tour_stems", "pane_right"}, {Way::Leaves, "tour_leaves", "way_leaves"},
                                           {Way::Grammar, "tour_grammar", "way_grammar"}, {Way::Grow, "tour_grow", "play"}}};

}  // namespace

void tourCard(const Panel& panel) {
  UiState& state = panel.state;
  const TourCard& card = kTour[static_cast<std::size_t>(*state.tour)];
  const auto point = state.landmarks.find(card.landmark);
  if (point != state.landmarks.end()) {
    const auto [x, y, width, height] = point->second;
    ImGui::GetForegroundDrawList()->AddRect({x - panel.px(2), y - panel.px(2)}, {x + width + panel.px(2), y + height + panel.px(2)}, panel.palette.accent, panel.px(6), 0, panel.px(3));
  }
  const ImVec2 screen = ImGui::GetIO().DisplaySize, size{panel.px(400), panel.px(196)};
  ImGui::SetNextWindowPos({screen.x - size.x - panel.px(300), screen.y - size.y - panel.px(122)});
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleColor(ImGuiCol_WindowBg, panel.palette.raised);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(18), panel.px(14)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, panel.px(10));
  ImGui::Begin("##tour", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
  const int last = static_cast<int>(kTour.size()) - 1;
  quiet(panel, filled(panel.t("tour_step"), {{"n", std::to_string(*state.tour + 1)}, {"of", std::to_string(last + 1)}}));
  gap(panel, 2);
  words(panel, panel.t(card.words), panel.palette.text);
  ImGui::SetCursorPosY(size.y - panel.px(46));
  const int at = *state.tour;
  if (at > 0 && button(panel, "tour_back")) state.tour = at - 1, state.way = kTour[static_cast<std::size_t>(at - 1)].way;
  if (at > 0) ImGui::SameLine(0, panel.px(8));
  if (at < last && button(panel, "tour_next", Emphasis::Primary)) state.tour = at + 1, state.way = kTour[static_cast<std::size_t>(at + 1)].way;
  if (at == last && button(panel, "tour_done", Emphasis::Primary)) state.tour.reset();
  if (at < last) {
    ImGui::SameLine(0, panel.px(8));
    if (button(panel, "tour_end", Emphasis::Quiet)) state.tour.reset();
  }
  ImGui::End();
}

}  // namespace axil::ui
