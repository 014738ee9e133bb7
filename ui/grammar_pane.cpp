#include "simeco/language_service.hpp"
#include "ui/grammar_links.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <imgui_stdlib.h>
#include <set>

namespace axil::ui {
namespace {

using simeco::TokenRole;

Colour inkOf(const Palette& palette, TokenRole role) {
  switch (role) {
    case TokenRole::Comment: return palette.quiet;
    case TokenRole::Keyword:
    case TokenRole::Attribute:
    case TokenRole::Directive: return palette.accent;
    case TokenRole::Number: return palette.warning;
    case TokenRole::Text: return palette.warning;
    case TokenRole::Unknown: return palette.error;
    case TokenRole::Function:
    case TokenRole::Macro:
    case TokenRole::Module:
    case TokenRole::Branch:
    case TokenRole::Name:
    case TokenRole::Operator:
    case TokenRole::Sign:
    case TokenRole::Separator: return palette.text;
  }
  return palette.text;
}

/// A grammar's text as it is shown: its lines, and what is marked in them.
struct Sheet {
  std::string_view text;
  std::vector<std::string_view> lines;
  std::vector<SourceSpan> spans;                ///< of the lines
  std::vector<simeco::ServiceToken> tokens;
  std::set<std::size_t> wrong;                  ///< lines with an error
};

Sheet sheetOf(std::string_view text, const std::vector<Diagnostic>& diagnostics) {
  Sheet sheet{.text = text, .lines = {}, .spans = {}, .tokens = simeco::tokensOf(text, simeco::Language::SimEco), .wrong = {}};
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    sheet.lines.push_back(text.substr(at, end - at));
    sheet.spans.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)});
    at = end + 1;
  }
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::Error) sheet.wrong.insert(static_cast<std::size_t>(placeOf(text, d.span.begin).line) - 1);
  return sheet;
}

/// The segment that ends at the selected node.
std::optional<int> chosenSegment(const Panel& panel) {
  if (!panel.state.selection.node || !panel.following.measurements.good) return std::nullopt;
  const auto& segments = panel.following.measurements.good->segments;
  for (std::size_t i = 0; i < segments.size(); ++i)
    if (segments[i].to == *panel.state.selection.node) return static_cast<int>(i);
  return std::nullopt;
}

void selectSegment(const Panel& panel, int segment) {
  const auto& measurements = panel.following.measurements.good;
  if (segment < 0 || !measurements || segment >= static_cast<int>(measurements->segments.size())) return;
  panel.state.selection = {.node = measurements->segments[static_cast<std::size_t>(segment)].to, .others = {}};
}

struct Marks {
  const std::vector<int>* segments = nullptr;  ///< of the lines, where they are known
  std::optional<int> chosen;
  std::optional<std::size_t> organ;            ///< the line of the rule that made the chosen organ
  std::string find;
};

void drawLine(const Panel& panel, const Sheet& sheet, std::size_t line, ImVec2 at, float gutter, float width, const Marks& marks) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float height = ImGui::GetTextLineHeight();
  const bool isChosen = marks.chosen && marks.segments != nullptr && line < marks.segments->size() && (*marks.segments)[line] == *marks.chosen;
  const bool isFound = !marks.find.empty() && sheet.lines[line].find(marks.find) != std::string_view::npos;
  const bool isOrgan = marks.organ == line;
  if (isChosen || isFound || isOrgan) list.AddRectFilled({at.x, at.y}, {at.x + width, at.y + height}, panel.palette.accentSoft);
  if (isOrgan) list.AddRectFilled({at.x, at.y}, {at.x + panel.px(4), at.y + height}, panel.palette.accent);
  const std::string number = std::to_string(line + 1);
  const bool isWrong = sheet.wrong.contains(line);
  list.AddText({at.x + gutter - panel.px(14) - ImGui::CalcTextSize(number.c_str()).x, at.y}, isWrong ? panel.palette.error : withAlpha(panel.palette.quiet, 140), number.c_str());
  float x = at.x + gutter;
  const SourceSpan span = sheet.spans[line];
  auto token = std::lower_bound(sheet.tokens.begin(), sheet.tokens.end(), span.begin, [](const simeco::ServiceToken& t, std::uint32_t byte) { return t.span.end <= byte; });
  for (std::uint32_t byte = span.begin; byte < span.end;) {
    const bool inside = token != sheet.tokens.end() && token->span.begin <= byte;
    const std::uint32_t end = std::min(span.end, inside ? token->span.end : token == sheet.tokens.end() ? span.end : token->span.begin);
    const char* from = sheet.text.data() + byte;
    const char* to = sheet.text.data() + end;
    list.AddText({x, at.y}, inside ? inkOf(panel.palette, token->role) : panel.palette.text, from, to);
    x += ImGui::CalcTextSize(from, to).x;
    if (inside) ++token;
    byte = std::max(end, byte + 1);
  }
}

/// Scrolls a line into the middle.
void showLine(int line) {
  const float at = static_cast<float>(line) * ImGui::GetTextLineHeight();
  if (at < ImGui::GetScrollY() || at > ImGui::GetScrollY() + ImGui::GetWindowHeight() - 3 * ImGui::GetTextLineHeight()) ImGui::SetScrollY(std::max(0.0f, at - ImGui::GetWindowHeight() / 2));
}

// ---- to be read ------------------------------------------------------------------------------------------------------------

/// In the grammar that is grown.
std::optional<std::size_t> organLine(const Panel& panel, const GrownGrammar& grown, document::GrammarKind kind) {
  const ChosenOrgan* organ = panel.organ();
  if (kind != panel.state.kind || organ == nullptr || !organ->where || organ->where->begin >= grown.text.size()) return std::nullopt;
  return static_cast<std::size_t>(placeOf(grown.text, organ->where->begin).line - 1);
}

void readOnly(const Panel& panel, const GrownGrammar& grown, document::GrammarKind kind, float gutter) {
  const Sheet sheet = sheetOf(grown.text, grown.diagnostics);
  const Marks marks{kind == document::GrammarKind::Structured ? nullptr : &grown.segments, chosenSegment(panel), organLine(panel, grown, kind), panel.state.find};
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  if (panel.state.wantedLine) showLine(*panel.state.wantedLine);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(sheet.lines.size()), height);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const auto line = static_cast<std::size_t>(i);
      drawLine(panel, sheet, line, at, gutter, width, marks);
      ImGui::PushID(i);
      if (ImGui::InvisibleButton("line", {std::max(width, gutter + ImGui::CalcTextSize(sheet.lines[line].data(), sheet.lines[line].data() + sheet.lines[line].size()).x), height}) &&
          marks.segments != nullptr && line < marks.segments->size())
        selectSegment(panel, (*marks.segments)[line]);
      if (marks.segments != nullptr && line < marks.segments->size() && (*marks.segments)[line] >= 0 && ImGui::IsItemHovered()) panel.state.status = panel.t("click_line");
      ImGui::PopID();
    }
  ImGui::PopStyleVar();
}

// ---- to be written ---------------------------------------------------------------------------------------------------------

int noteCursor(ImGuiInputTextCallbackData* data) {
  static_cast<GrammarDraft*>(data->UserData)->cursor = static_cast<std::size_t>(std::max(0, data->CursorPos));
  return 0;
}

/// The field itself has no ink: the coloured lines are drawn over it.
void writable(const Panel& panel, float gutter) {
  GrammarDraft& draft = *panel.state.grammarDraft;
  const Sheet sheet = sheetOf(draft.text, panel.draft ? panel.draft->diagnostics : std::vector<Diagnostic>{});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  std::size_t longest = 0;
  for (const std::string_view line : sheet.lines) longest = std::max(longest, line.size());
  const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x - gutter, static_cast<float>(longest + 4) * ImGui::CalcTextSize("0").x), (static_cast<float>(sheet.lines.size()) + 2) * height};
  const std::size_t cursor = draft.cursor;
  ImGui::SetCursorScreenPos({at.x + gutter, at.y});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_FrameBg, 0);
  ImGui::PushStyleColor(ImGuiCol_Text, withAlpha(panel.palette.text, 1));
  if (ImGui::InputTextMultiline("##draft", &draft.text, size, ImGuiInputTextFlags_AllowTabInput | ImGuiInputTextFlags_CallbackAlways, noteCursor, &draft)) ++draft.version;
  landmark(panel, "grammar_field");
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
  const Marks marks{nullptr, std::nullopt, std::nullopt, panel.state.find};
  const int first = std::max(0, static_cast<int>(ImGui::GetScrollY() / height) - 1), shown = static_cast<int>(ImGui::GetWindowHeight() / height) + 3;
  for (int i = first; i < std::min(first + shown, static_cast<int>(sheet.lines.size())); ++i)
    drawLine(panel, sheet, static_cast<std::size_t>(i), {at.x, at.y + static_cast<float>(i) * height}, gutter, size.x + gutter, marks);
  if (ImGui::IsItemActive()) {
    const auto line = placeOf(draft.text, static_cast<std::uint32_t>(std::min<std::size_t>(draft.cursor, draft.text.size()))).line - 1;
    const float y = at.y + static_cast<float>(line) * height;
    const auto column = draft.cursor - sheet.spans[static_cast<std::size_t>(std::clamp(line, 0, static_cast<int>(sheet.spans.size()) - 1))].begin;
    const float x = at.x + gutter + static_cast<float>(column) * ImGui::CalcTextSize("0").x;
    ImGui::GetWindowDrawList()->AddLine({x, y}, {x, y + height}, panel.palette.accent, panel.px(1.5f));
    if (cursor != draft.cursor) showLine(line);
  }
}

// ---- what stands above and below -------------------------------------------------------------------------------------------

/// Moved clicks of an edited initial grammar; empty where nothing moved or it does not grow.
document::Step movedClicks(const Panel& panel) {
  const auto& f = panel.following;
  if (!panel.draft || !panel.draft->growth || !f.measured.isCurrent() || !f.skeleton.isCurrent() || !f.measurements.isCurrent()) return {};
  const auto plant = simeco::plantAt(*panel.draft->growth, panel.draft->end);
  return plant ? clicksFollowing(panel.project, *f.measured.good, *f.skeleton.good, *f.measurements.good, *plant) : document::Step{};
}

Taken editingButtons(const Panel& panel) {
  Taken taken;
  UiState& state = panel.state;
  if (!state.grammarDraft) {
    const auto* grown = panel.following.grammar(state.kind);
    if (grown != nullptr && button(panel, "grammar_edit")) state.grammarDraft = GrammarDraft{.text = grown->text, .kind = state.kind};
    ImGui::SameLine(0, panel.px(8));
    if (choice(panel, "side_by_side", state.sideBySide, 0)) state.sideBySide = !state.sideBySide;
    return taken;
  }
  if (state.grammarDraft->kind == document::GrammarKind::Initial && button(panel, "grammar_apply", Emphasis::Primary)) {
    document::Step moved = movedClicks(panel);
    if (moved.empty()) state.notice = Notice{NoticeKind::Warned, panel.t("grammar_moves_nothing")};
    else taken = std::move(moved);
    state.grammarDraft.reset();
    return taken;
  }
  if (state.grammarDraft->kind == document::GrammarKind::Initial) ImGui::SameLine(0, panel.px(8));
  if (button(panel, "export_as")) state.dialog = {DialogKind::ExportFile, panel.session.openProject().folder, panel.project.name + ".simeco", ""};
  ImGui::SameLine(0, panel.px(8));
  if (button(panel, "discard")) state.grammarDraft.reset();
  return taken;
}

std::string said(const Panel& panel, const std::string& message) { return panel.texts.translated(message, panel.state.language); }

void diagnosticsBelow(const Panel& panel, const GrownGrammar* grown) {
  if (grown == nullptr) return;
  ImGui::PushFont(font(Face::Small));
  for (std::size_t i = 0; i < std::min<std::size_t>(grown->diagnostics.size(), 50); ++i) {
    const Diagnostic& d = grown->diagnostics[i];
    const SourcePlace place = placeOf(grown->text, d.span.begin);
    const std::string line = std::to_string(place.line) + ":" + std::to_string(place.column) + "  " + said(panel, d.message) + (d.hint.empty() ? "" : "  (" + said(panel, d.hint) + ")") + "##d" + std::to_string(i);
    ImGui::PushStyleColor(ImGuiCol_Text, d.severity == Severity::Error ? panel.palette.error : panel.palette.warning);
    if (ImGui::Selectable(line.c_str())) panel.state.wantedLine = place.line - 1;
    ImGui::PopStyleColor();
  }
  if (grown->diagnostics.empty() && grown->trouble) words(panel, said(panel, grown->trouble->message), panel.palette.error);
  if (grown->diagnostics.empty() && !grown->trouble) words(panel, panel.t("diagnostics_none"), panel.palette.quiet);
  ImGui::PopFont();
}

void textColumn(const Panel& panel, const char* id, document::GrammarKind kind, ImVec2 size) {
  ImGui::BeginChild(id, size, false, ImGuiWindowFlags_HorizontalScrollbar);
  ImGui::PushFont(font(Face::Mono));
  const float gutter = ImGui::CalcTextSize("00000").x + panel.px(14);
  const auto* grown = panel.following.grammar(kind);
  if (panel.state.grammarDraft && panel.state.grammarDraft->kind == kind) writable(panel, gutter);
  else if (grown != nullptr) readOnly(panel, *grown, kind, gutter);
  ImGui::PopFont();
  if (grown == nullptr) quiet(panel, panel.t("grammar_none"));
  ImGui::EndChild();
}

/// A stem chosen elsewhere is shown here.
void followSelection(const Panel& panel) {
  const auto chosen = chosenSegment(panel);
  const auto* grown = panel.following.grammar(panel.state.kind);
  if (chosen == panel.state.shownSegment || grown == nullptr) return;
  panel.state.shownSegment = chosen;
  const auto line = chosen ? std::find(grown->segments.rbegin(), grown->segments.rend(), *chosen) : grown->segments.rend();
  if (line != grown->segments.rend()) panel.state.wantedLine = static_cast<int>(grown->segments.rend() - line) - 1;
}

}  // namespace

Taken grammarText(const Panel& panel, Area area) {
  UiState& state = panel.state;
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, panel.palette.panel);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(8), panel.px(10)});
  ImGui::BeginChild("##grammar", {area.width, area.height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
  if (state.grammarDraft && state.grammarDraft->kind != state.kind) state.kind = state.grammarDraft->kind;
  followSelection(panel);
  Taken taken = editingButtons(panel);
  gap(panel, 2);
  const auto* shown = state.grammarDraft ? panel.draft.get() : panel.following.grammar(state.kind);
  const float below = std::min(panel.px(132), area.height * 0.25f);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (state.sideBySide && !state.grammarDraft) {
    const float width = (room.x - 2 * panel.px(8)) / 3;
    static constexpr std::array<const char*, 3> kIds = {"##initial", "##predictive", "##structured"};
    for (std::size_t i = 0; i < kIds.size(); ++i) {
      if (i > 0) ImGui::SameLine(0, panel.px(8));
      textColumn(panel, kIds[i], static_cast<document::GrammarKind>(i), {width, room.y - below});
    }
  } else {
    textColumn(panel, "##text", state.kind, {0, room.y - below});
  }
  state.wantedLine.reset();
  ImGui::Separator();
  ImGui::BeginChild("##diagnostics", {0, 0});
  diagnosticsBelow(panel, shown);
  ImGui::EndChild();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return taken;
}

Taken grammarPanel(const Panel& panel) {
  heading(panel, "way_grammar");
  static constexpr std::array<const char*, 3> kKinds = {"kind_initial", "kind_predictive", "kind_structured"};
  static constexpr std::array<const char*, 3> kHelp = {"kind_initial_help", "kind_predictive_help", "kind_structured_help"};
  for (std::size_t i = 0; i < 3; ++i)
    if (choice(panel, kKinds[i], panel.state.kind == static_cast<document::GrammarKind>(i), -1)) panel.state.kind = static_cast<document::GrammarKind>(i);
  const std::size_t kind = static_cast<std::size_t>(panel.state.kind);
  gap(panel, 4);
  quiet(panel, panel.t(kHelp[kind]));
  gap(panel, 4);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##find", panel.t("find"), &panel.state.find);
  if (panel.following.grammarTroubles[kind]) say(panel, NoticeKind::Warned, panel.following.grammarTroubles[kind]->message);
  return std::nullopt;
}

}  // namespace axil::ui
