#include "ui/actions.hpp"

#include "base/text.hpp"
#include "document/lookup.hpp"
#include "ui/stem_steps.hpp"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

namespace axil::ui {
namespace {

using document::Step;
using enum Chord::Held;

bool always(const Panel&) { return true; }
bool hasSelection(const Panel& panel) { return panel.state.selection.node.has_value(); }
bool hasNodes(const Panel& panel) { return !panel.project.nodes.empty(); }
bool hasPlant(const Panel& panel) { return panel.following.grammar(panel.state.kind) != nullptr; }

Taken openDialog(const Panel& panel) {
  panel.state.dialog = {DialogKind::Open, panel.session.openProject().folder, "", ""};
  return {};
}
Taken saveAs(const Panel& panel) {
  panel.state.dialog = {DialogKind::SaveAs, panel.session.openProject().folder, panel.project.name + ".axil", ""};
  return {};
}
template <class W>
Taken wish(const Panel& panel) {
  panel.state.wishes.push_back(W{});
  return {};
}
Taken exportAll(const Panel& panel) {
  panel.state.way = Way::Grow;
  panel.state.wishes.push_back(WishExport{panel.state.exportFolder});
  return {};
}
template <bool UiState::*Shown>
Taken toggle(const Panel& panel) {
  panel.state.*Shown = !(panel.state.*Shown);
  return {};
}
template <Way Where>
Taken goTo(const Panel& panel) {
  panel.state.way = Where;
  panel.state.maximised.reset();
  return {};
}
template <int Pane>
Taken maximise(const Panel& panel) {
  panel.state.maximised = panel.state.maximised == Pane ? std::nullopt : std::optional(Pane);
  return {};
}
template <Language Which>
Taken speak(const Panel& panel) {
  panel.state.language = Which;
  return {};
}
Taken otherTheme(const Panel& panel) {
  panel.state.theme = panel.state.theme == Theme::Dark ? Theme::Light : Theme::Dark;
  return {};
}
template <int Percent>
Taken resize(const Panel& panel) {
  panel.state.scale = std::clamp(panel.state.scale * static_cast<float>(Percent) / 100, 0.75f, 3.0f);
  return {};
}
Taken fit(const Panel& panel) {
  panel.state.frames.clear();
  panel.state.orbit = Orbit{};
  return {};
}
Taken play(const Panel& panel) {
  panel.state.playing = !panel.state.playing;
  if (panel.state.playing && panel.state.time < 0) panel.state.time = 0;
  return {};
}
template <int Whole>
Taken growTo(const Panel& panel) {
  panel.state.time = Whole;
  panel.state.playing = false;
  return {};
}
Taken palette(const Panel& panel) {
  panel.state.palette = PaletteState{};
  return {};
}
Taken tour(const Panel& panel) {
  panel.state.wishes.push_back(WishTour{});
  return {};
}
Taken selectAll(const Panel& panel) {
  panel.state.selection = {};
  for (const auto& entry : panel.project.nodes) panel.state.selection.add(entry.node.id);
  return {};
}
Taken selectStem(const Panel& panel) {
  const auto stem = stemOf(panel.project, *panel.state.selection.node);
  const auto place = stem ? document::stemWithId(panel.project, *stem) : std::nullopt;
  if (!place) return {};
  for (const auto node : panel.project.stems[*place].stem.nodes) panel.state.selection.add(node);
  return {};
}
Taken removeSelected(const Panel& panel) { return Step{document::RemoveNodes{panel.state.selection.all()}}; }

template <std::optional<Step> (*StepOf)(const document::Project&, document::NodeId)>
bool stepExists(const Panel& panel) {
  return hasSelection(panel) && StepOf(panel.project, *panel.state.selection.node).has_value();
}
template <std::optional<Step> (*StepOf)(const document::Project&, document::NodeId)>
Taken takeStep(const Panel& panel) {
  return StepOf(panel.project, *panel.state.selection.node);
}
template <Pick::Kind Kind>
Taken pick(const Panel& panel) {
  if (const auto stem = stemOf(panel.project, *panel.state.selection.node)) panel.state.pick = Pick{Kind, *stem};
  return {};
}

/// The clicks that the photos propose for the selected stem, in every photo that shows it.
Taken takeProposals(const Panel& panel) {
  return stepOf(panel.project, panel.proposals.all());
}

/// One step back from whatever a person is in the middle of.
Taken escape(const Panel& panel) {
  UiState& state = panel.state;
  if (state.palette) state.palette.reset();
  else if (state.shortcuts || state.history || state.dialog.kind != DialogKind::None) {
    state.shortcuts = state.history = false;
    state.dialog.kind = DialogKind::None;
  } else if (state.tour) state.tour.reset();
  else if (state.pick) state.pick.reset();
  else if (state.tool != PhotoTool::None) {
    state.tool = PhotoTool::None;
    state.lengthFrom.reset();
  } else if (state.selection.node) state.selection = {};
  else state.maximised.reset();
  return {};
}

constexpr Action kActions[] = {
    {"key_palette", "Ctrl+K", {GLFW_KEY_K, Control}, always, palette},
    {"key_new", "Ctrl+N", {GLFW_KEY_N, Control}, always, wish<WishNew>},
    {"key_open", "Ctrl+O", {GLFW_KEY_O, Control}, always, openDialog},
    {"key_save", "Ctrl+S", {GLFW_KEY_S, Control}, always, wish<WishSave>},
    {"key_save_as", "Ctrl+Shift+S", {GLFW_KEY_S, ControlShift}, always, saveAs},
    {"key_export", "Ctrl+E", {GLFW_KEY_E, Control}, hasPlant, exportAll},
    {"key_undo", "Ctrl+Z", {GLFW_KEY_Z, Control}, [](const Panel& p) { return p.session.history().canUndo(); }, wish<WishUndo>},
    {"key_redo", "Ctrl+Shift+Z", {GLFW_KEY_Z, ControlShift}, [](const Panel& p) { return p.session.history().canRedo(); }, wish<WishRedo>},
    {"key_redo_y", "Ctrl+Y", {GLFW_KEY_Y, Control}, [](const Panel& p) { return p.session.history().canRedo(); }, wish<WishRedo>},
    {"key_history", "Ctrl+H", {GLFW_KEY_H, Control}, always, toggle<&UiState::history>},
    {"way_describe", "Alt+1", {}, always, goTo<Way::Describe>},
    {"way_photos", "Alt+2", {}, always, goTo<Way::Photos>},
    {"way_stems", "Alt+3", {}, always, goTo<Way::Stems>},
    {"way_leaves", "Alt+4", {}, always, goTo<Way::Leaves>},
    {"way_grammar", "Alt+5", {}, always, goTo<Way::Grammar>},
    {"way_grow", "Alt+6", {}, always, goTo<Way::Grow>},
    {"key_pane_front", "1", {GLFW_KEY_1}, always, maximise<0>},
    {"key_pane_right", "2", {GLFW_KEY_2}, always, maximise<1>},
    {"key_pane_top", "3", {GLFW_KEY_3}, always, maximise<2>},
    {"key_pane_plant", "4", {GLFW_KEY_4}, always, maximise<3>},
    {"key_fit", "F", {GLFW_KEY_F}, always, fit},
    {"key_loupe", "L", {GLFW_KEY_L}, always, toggle<&UiState::loupe>},
    {"key_snap", "S", {GLFW_KEY_S}, always, toggle<&UiState::snap>},
    {"key_trace", "W", {GLFW_KEY_W}, always, toggle<&UiState::trace>},
    {"key_skeleton", "K", {GLFW_KEY_K}, always, toggle<&UiState::showSkeleton>},
    {"key_plant", "G", {GLFW_KEY_G}, always, toggle<&UiState::showPlant>},
    {"key_play", "P", {GLFW_KEY_P}, hasPlant, play},
    {"to_start", "Home", {GLFW_KEY_HOME}, hasPlant, growTo<0>},
    {"to_end", "End", {GLFW_KEY_END}, hasPlant, growTo<-1>},
    {"key_select_all", "Ctrl+A", {GLFW_KEY_A, Control}, hasNodes, selectAll},
    {"key_select_stem", "A", {GLFW_KEY_A}, hasSelection, selectStem},
    {"key_delete", "Delete", {GLFW_KEY_DELETE}, hasSelection, removeSelected},
    {"key_take", "Enter", {GLFW_KEY_ENTER}, [](const Panel& p) { return !p.proposals.all().empty(); }, takeProposals},
    {"key_split", "X", {GLFW_KEY_X}, stepExists<splitAt>, takeStep<splitAt>},
    {"key_join", "J", {GLFW_KEY_J}, hasSelection, pick<Pick::Kind::Join>},
    {"key_attach", "B", {GLFW_KEY_B}, hasSelection, pick<Pick::Kind::Attach>},
    {"key_reverse", "R", {GLFW_KEY_R}, stepExists<reverseAt>, takeStep<reverseAt>},
    {"key_escape", "Esc", {GLFW_KEY_ESCAPE}, always, escape},
    {"theme_light", "", {}, [](const Panel& p) { return p.state.theme == Theme::Dark; }, otherTheme},
    {"theme_dark", "", {}, [](const Panel& p) { return p.state.theme == Theme::Light; }, otherTheme},
    {"language_en", "", {}, always, speak<Language::English>},
    {"language_zh_hant", "", {}, always, speak<Language::TraditionalChinese>},
    {"language_zh_hans", "", {}, always, speak<Language::SimplifiedChinese>},
    {"key_larger", "Ctrl+=", {GLFW_KEY_EQUAL, Control}, always, resize<110>},
    {"key_smaller", "Ctrl+-", {GLFW_KEY_MINUS, Control}, always, resize<91>},
    {"key_tour", "", {}, always, tour},
    {"key_help", "?  F1", {GLFW_KEY_F1}, always, toggle<&UiState::shortcuts>},
    {"key_quit", "Ctrl+Q", {GLFW_KEY_Q, Control}, always, wish<WishQuit>},
};

Chord::Held heldNow() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) return io.KeyShift ? ControlShift : Control;
  return io.KeyShift ? Shift : Nothing;
}

bool isPressed(const Action& action, Chord::Held held) {
  const bool repeats = action.chord.key == GLFW_KEY_Z || action.chord.key == GLFW_KEY_Y;
  return action.chord.key != 0 && action.chord.held == held && ImGui::IsKeyPressed(action.chord.key, repeats);
}

/// Keys that mean the same while a field is written in.
bool alwaysMeant(const Action& action) { return action.chord.key == GLFW_KEY_ESCAPE || action.chord.key == GLFW_KEY_F1; }

}  // namespace

std::span<const Action> actions() { return kActions; }

Taken actOnKeys(const Panel& panel) {
  const ImGuiIO& io = ImGui::GetIO();
  const Chord::Held held = heldNow();
  if (io.KeyAlt && !io.WantTextInput)
    for (int i = 0; i < 6; ++i)
      if (ImGui::IsKeyPressed(GLFW_KEY_1 + i, false)) panel.state.way = kWays[static_cast<std::size_t>(i)];
  if (io.KeyAlt) return {};
  if (!io.WantTextInput && held == Shift && ImGui::IsKeyPressed(GLFW_KEY_SLASH, false)) return toggle<&UiState::shortcuts>(panel);
  for (const Action& action : kActions)
    if (isPressed(action, held) && (!io.WantTextInput || alwaysMeant(action)) && action.possible(panel)) return action.act(panel);
  return {};
}

std::optional<int> likeness(std::string_view words, std::string_view typed) {
  const auto low = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  int gaps = 0;
  std::size_t at = 0;
  bool first = true;
  for (const char wanted : typed) {
    if (wanted == ' ') continue;
    std::size_t found = at;
    while (found < words.size() && low(words[found]) != low(wanted)) ++found;
    if (found == words.size()) return std::nullopt;
    // Beginning in the middle of a word is worse than at a word's beginning.
    const bool begins = found == 0 || words[found - 1] == ' ';
    gaps += first ? static_cast<int>(std::min<std::size_t>(found, 20)) : static_cast<int>(found - at) * (begins ? 1 : 3);
    at = found + 1;
    first = false;
  }
  return gaps;
}

std::vector<const Action*> actionsFor(const Panel& panel, const std::string& typed) {
  std::vector<std::pair<int, const Action*>> fitting;
  for (const Action& action : kActions) {
    if (!action.possible(panel) || std::string_view(action.name) == "key_palette" || std::string_view(action.name) == "key_redo_y") continue;
    const auto shown = likeness(panel.t(action.name), typed), english = likeness(panel.texts(action.name, Language::English), typed);
    if (!shown && !english) continue;
    fitting.emplace_back(std::min(shown.value_or(1'000'000), english.value_or(1'000'000)), &action);
  }
  std::stable_sort(fitting.begin(), fitting.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Action*> found;
  for (const auto& [score, action] : fitting) found.push_back(action);
  return found;
}

}  // namespace axil::ui
