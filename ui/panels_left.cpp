#include "base/text.hpp"
#include "document/lookup.hpp"
#include "keywords/presets.hpp"
#include "organs/leaf.hpp"
#include "ui/leaf_steps.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>
#include <imgui_stdlib.h>

namespace axil::ui {
namespace {

using document::NodeId;
using document::StemId;
using document::Step;

constexpr std::array<const char*, 6> kWayKeys = {"way_describe", "way_photos", "way_stems", "way_leaves", "way_grammar", "way_grow"};

std::string count(const Panel& panel, std::size_t n, const char* key) { return filled(panel.t(key), {{"n", std::to_string(n)}}); }

/// What has been reached, in a few words.
std::string reached(const Panel& panel, Way way) {
  const document::Project& project = panel.project;
  const auto* grown = panel.following.grammar(document::GrammarKind::Initial);
  switch (way) {
    case Way::Describe: return project.description.empty() ? "" : count(panel, panel.following.said ? panel.following.said->size() : 0, "n_facts");
    case Way::Photos: return project.views.empty() ? "" : count(panel, project.views.size(), "n_photos");
    case Way::Stems: return project.stems.empty() ? "" : count(panel, project.stems.size(), "n_stems");
    case Way::Leaves: return project.leaves.empty() ? "" : count(panel, project.leaves.size(), "n_leaves");
    case Way::Grammar: return grown == nullptr ? "" : count(panel, static_cast<std::size_t>(std::count(grown->text.begin(), grown->text.end(), '\n')), "n_lines");
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

// ---- describe --------------------------------------------------------------------------------------------------------------

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

std::vector<std::string> shapeNames() {
  std::vector<std::string> names;
  for (const organs::LeafShape& shape : organs::leafShapes()) names.push_back(shape.name);
  return names;
}

std::string valueText(const keywords::Trait& trait) {
  if (!trait.low) return trait.value;
  const auto number = [](double v) { return shortest(roundedTo(v, 4)); };
  return number(*trait.low) + (trait.high && trait.high != trait.low ? " – " + number(*trait.high) : "") + (trait.unit.empty() ? "" : " " + trait.unit);
}

const document::ProjectTrait* decisionOn(const document::Project& project, const keywords::Trait& trait) {
  for (const document::ProjectTrait& decision : project.traits)
    if (decision.organ == trait.organ && decision.property == trait.property && decision.words == trait.text) return &decision;
  return nullptr;
}

/// The value the project goes by: as read, or as the user changed it.
keywords::Trait decided(keywords::Trait trait, const document::ProjectTrait* decision) {
  if (decision == nullptr || decision->verdict != document::Verdict::Changed) return trait;
  if (!decision->value.empty()) trait.value = decision->value;
  if (decision->low) trait.low = decision->low, trait.high = decision->high, trait.unit = decision->unit;
  return trait;
}

FactDraft draftOf(const keywords::Trait& trait, std::size_t index) {
  const double low = trait.low.value_or(0);
  return {.index = index, .value = trait.value, .low = low, .high = trait.high.value_or(low), .unit = trait.unit};
}

/// The words that a property can have, where they are few.
std::vector<std::string> valuesOf(const keywords::Trait& trait) {
  if (trait.property == "arrangement") return keywords::arrangementNames();
  if (trait.property == "shape" && (trait.organ == "leaf" || trait.organ == "leaflet" || trait.organ == "blade")) return shapeNames();
  return {};
}

/// The fields of a fact that is being changed; gives the step when they are applied.
Taken factFields(const Panel& panel, const keywords::Trait& trait) {
  FactDraft& draft = *panel.state.factDraft;
  const float third = (ImGui::GetContentRegionAvail().x - panel.px(16)) / 3;
  if (trait.low) {
    ImGui::SetNextItemWidth(third);
    ImGui::InputDouble("##low", &draft.low, 0, 0, "%.4g");
    ImGui::SameLine(0, panel.px(8));
    ImGui::SetNextItemWidth(third);
    ImGui::InputDouble("##high", &draft.high, 0, 0, "%.4g");
    ImGui::SameLine(0, panel.px(8));
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##unit", &draft.unit);
  } else if (const auto values = valuesOf(trait); !values.empty()) {
    combo("##value", values, draft.value, "–");
  } else {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##value", &draft.value);
  }
  if (trait.property == "shape") leafPreview(panel, draft.value);
  Taken taken;
  if (button(panel, "apply", Emphasis::Primary)) {
    if (trait.low) taken = Step{document::ChangeTraitRange{trait.organ, trait.property, trait.text, std::min(draft.low, draft.high), std::max(draft.low, draft.high), draft.unit}};
    else taken = Step{document::ChangeTrait{trait.organ, trait.property, trait.text, draft.value}};
  }
  ImGui::SameLine(0, panel.px(8));
  if (button(panel, "cancel") || taken) panel.state.factDraft.reset();
  gap(panel, 4);
  return taken;
}

Taken traitRow(const Panel& panel, const keywords::Trait& read, std::size_t index) {
  Taken taken;
  const keywords::Trait trait = decided(read, decisionOn(panel.project, read));
  const document::ProjectTrait* decision = decisionOn(panel.project, trait);
  const bool rejected = decision != nullptr && decision->verdict == document::Verdict::Rejected;
  const bool accepted = decision != nullptr && !rejected;
  ImGui::PushID(static_cast<int>(index));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = panel.px(42);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool hovered = ImGui::IsMouseHoveringRect(at, {at.x + width, at.y + height}) && ImGui::IsWindowHovered();
  if (hovered) panel.state.hotTrait = index;
  list.AddRectFilled(at, {at.x + width, at.y + height}, hovered ? panel.palette.hovered : panel.palette.raised, panel.px(6));
  const Colour ink = rejected ? panel.palette.quiet : panel.palette.text;
  const std::string value = valueText(trait);
  list.PushClipRect(at, {at.x + width - panel.px(88), at.y + height}, true);
  list.AddText({at.x + panel.px(10), at.y + panel.px(4)}, ink, value.c_str());
  if (rejected) {
    const float w = ImGui::CalcTextSize(value.c_str()).x, y = at.y + panel.px(4) + ImGui::GetFontSize() / 2;
    list.AddLine({at.x + panel.px(10), y}, {at.x + panel.px(10) + w, y}, ink, 1);
  }
  ImGui::PushFont(font(Face::Small));
  const std::string from = trait.organ + " · " + trait.property + (trait.qualifier.empty() ? "" : " · " + trait.qualifier);
  list.AddText({at.x + panel.px(10), at.y + panel.px(23)}, panel.palette.quiet, from.c_str());
  ImGui::PopFont();
  list.PopClipRect();
  const float size = panel.px(24);
  ImGui::SetCursorScreenPos({at.x + width - 3 * size - panel.px(14), at.y + (height - size) / 2});
  if (iconButton(panel, "change", Icon::Pencil, panel.t("trait_change"), size)) panel.state.factDraft = draftOf(trait, index);
  ImGui::SetCursorScreenPos({at.x + width - 2 * size - panel.px(10), at.y + (height - size) / 2});
  if (iconButton(panel, "accept", Icon::Check, panel.t("trait_accept"), size))
    taken = accepted ? Step{document::ForgetTrait{trait.organ, trait.property, trait.text}} : Step{document::AcceptTrait{trait.organ, trait.property, trait.text}};
  if (accepted) drawIcon(list, Icon::Check, {at.x + width - 1.5f * size - panel.px(10), at.y + height / 2}, size * 0.5f, panel.palette.accent);
  ImGui::SetCursorScreenPos({at.x + width - size - panel.px(6), at.y + (height - size) / 2});
  if (iconButton(panel, "reject", Icon::Cross, panel.t("trait_reject"), size))
    taken = rejected ? Step{document::ForgetTrait{trait.organ, trait.property, trait.text}} : Step{document::RejectTrait{trait.organ, trait.property, trait.text}};
  if (rejected) drawIcon(list, Icon::Cross, {at.x + width - 0.5f * size - panel.px(6), at.y + height / 2}, size * 0.5f, panel.palette.error);
  ImGui::SetCursorScreenPos({at.x, at.y + height + panel.px(4)});
  ImGui::Dummy({1, 0});
  if (panel.state.factDraft && panel.state.factDraft->index == index)
    if (Taken changed = factFields(panel, trait)) taken = std::move(changed);
  ImGui::PopID();
  return taken;
}

// ---- leaves ----------------------------------------------------------------------------------------------------------------

template <class Value, class Draw>
bool optionalRow(const Panel& panel, const char* key, std::optional<Value>& value, Value first, Draw draw) {
  ImGui::PushID(key);
  bool given = value.has_value(), changed = false;
  if (ImGui::Checkbox(panel.t(key), &given)) {
    value = given ? std::optional<Value>(first) : std::nullopt;
    changed = true;
  }
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
  ImGui::SetNextItemWidth(-1);
  if (value) changed = draw(*value) || changed;
  else ImGui::TextDisabled("%s", panel.t("from_description"));
  ImGui::PopID();
  return changed;
}

bool angleRow(const Panel& panel, const char* key, std::optional<Angle>& angle, double first, float low, float high) {
  return optionalRow(panel, key, angle, Angle::fromDegrees(first), [&](Angle& a) {
    float degrees = static_cast<float>(a.degrees());
    if (!ImGui::SliderFloat("##a", &degrees, low, high, "%.0f°")) return false;
    a = Angle::fromDegrees(std::round(static_cast<double>(degrees)));
    return true;
  });
}

bool lengthRow(const Panel& panel, const char* key, std::optional<double>& length, double first) {
  return optionalRow(panel, key, length, first, [&](double& l) {
    double shown = l;
    if (!ImGui::InputDouble("##l", &shown, 0, 0, ("%.4g " + panel.project.unit).c_str()) || shown < 0) return false;
    l = shown;
    return true;
  });
}

bool editLeaves(const Panel& panel, quantify::LeafArrangement& draft) {
  bool changed = combo("##arrangement", keywords::arrangementNames(), draft.arrangement, "–");
  std::string shape = draft.shape;
  if (combo("##shape", shapeNames(), shape, panel.t("from_description"))) draft.shape = shape, changed = true;
  leafPreview(panel, draft.shape.empty() ? "ovate" : draft.shape);
  if (draft.at.empty()) {
    int nodes = draft.nodes.value_or(3);
    ImGui::TextUnformatted(panel.t("leaf_nodes"));
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##nodes", &nodes, 1, 40)) draft.nodes = std::clamp(nodes, 1, 10'000), changed = true;
  }
  changed = angleRow(panel, "leaf_angle", draft.angle, 55, 0, 180) || changed;
  changed = angleRow(panel, "leaf_roll", draft.roll, 0, -180, 180) || changed;
  changed = angleRow(panel, "leaf_azimuth", draft.azimuth, 0, -180, 180) || changed;
  changed = lengthRow(panel, "leaf_length", draft.length, 0.05) || changed;
  changed = lengthRow(panel, "leaf_petiole", draft.petiole, 0.01) || changed;
  return changed;
}

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

/// What keeps the plant from being measured, and the nodes that wait for a second photo.
std::vector<std::string> missing(const Panel& panel) {
  std::vector<std::string> lines;
  const auto& skeleton = panel.following.skeleton;
  if (skeleton.trouble && skeleton.trouble->details.empty()) lines.push_back(skeleton.trouble->message);
  if (skeleton.trouble) lines.insert(lines.end(), skeleton.trouble->details.begin(), skeleton.trouble->details.end());
  if (skeleton.good && !skeleton.trouble)
    for (const auto& node : skeleton.good->incomplete) lines.push_back(filled(panel.t("node_waits"), {{"node", std::to_string(node.id.value)}}));
  return lines;
}

void stillMissing(const Panel& panel) {
  constexpr std::size_t kMost = 6;
  if (panel.project.nodes.empty()) return;
  const std::vector<std::string> lines = missing(panel);
  panel.state.shownTroubles = lines.size();
  if (lines.empty()) return;
  gap(panel, 6);
  heading(panel, "to_do");
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i) say(panel, NoticeKind::Warned, lines[i]);
  if (lines.size() > kMost) quiet(panel, filled(panel.t("and_more"), {{"n", std::to_string(lines.size() - kMost)}}));
}

}  // namespace

void wayPanel(const Panel& panel) {
  for (const Way way : kWays) {
    wayRow(panel, way);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - panel.px(4));
  }
}

Taken describePanel(const Panel& panel) {
  heading(panel, "facts");
  quiet(panel, panel.t("facts_help"));
  gap(panel, 4);
  Taken taken;
  panel.state.hotTrait.reset();
  if (!panel.following.said || panel.following.said->empty()) return taken;
  for (std::size_t i = 0; i < panel.following.said->size(); ++i)
    if (auto step = traitRow(panel, (*panel.following.said)[i], i)) taken = std::move(step);
  if (panel.state.hotTrait && !panel.state.factDraft)
    if (const auto& hot = (*panel.following.said)[*panel.state.hotTrait]; hot.property == "shape" && !hot.value.empty()) leafPreview(panel, hot.value);
  return taken;
}

Taken photosPanel(const Panel& panel) {
  Taken taken;
  heading(panel, "way_photos");
  static constexpr std::array<const char*, 3> kNames = {"front", "right", "top"};
  const auto panes = viewsOfPanes(panel.project);
  for (std::size_t i = 0; i < 3; ++i) {
    ImGui::PushID(static_cast<int>(i));
    const document::ProjectView* view = panes[i] < 0 ? nullptr : &panel.project.views[static_cast<std::size_t>(panes[i])];
    const std::string name = view != nullptr ? view->view.name : kNames[i];
    const std::string key = "view_" + name;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(panel.texts.has(key) ? panel.t(key) : name.c_str());
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
    const std::string key = "view_" + view.view.name;
    const std::string marks = std::string(view.origin_px ? panel.t("origin_set") : panel.t("origin_missing")) + (view.scale ? std::string(" · ") + panel.t("length_set") : "");
    fact(panel, panel.texts.has(key) ? panel.t(key) : view.view.name.c_str(), view.view.camera.model == skeleton3d::CameraModel::Unknown ? marks : panel.t("camera_known"));
  }
  if (panel.following.measured.trouble) {
    gap(panel, 4);
    say(panel, NoticeKind::Warned, panel.following.measured.trouble->message);
  }
  lookSliders(panel);
  if (panel.following.measured.isCurrent())
    for (const auto& report : panel.following.measured.good->cameras)
      fact(panel, report.view.c_str(), filled(panel.t("camera_estimated"), {{"px", fixed(report.typical_px, 2)}, {"deg", fixed(report.turned.degrees(), 1)}}));
  for (const auto& trouble : panel.following.photos) say(panel, NoticeKind::Failed, trouble.error.message);
  return taken;
}

Taken stemsPanel(const Panel& panel) {
  Taken taken;
  heading(panel, "way_stems");
  quiet(panel, panel.t(panel.project.stems.empty() ? "stems_first" : "stems_help"));
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
    const std::string nodes = count(panel, stem.nodes.size(), "n_nodes");
    list.AddText({at.x + width - ImGui::CalcTextSize(nodes.c_str()).x - panel.px(10), at.y + (height - ImGui::GetFontSize()) / 2}, panel.palette.quiet, nodes.c_str());
    ImGui::PopFont();
    ImGui::PopID();
  }
  stillMissing(panel);
  return taken;
}

Taken leavesPanel(const Panel& panel) {
  Taken taken;
  heading(panel, "way_leaves");
  const auto stem = panel.state.selection.node ? stemOf(panel.project, *panel.state.selection.node) : std::nullopt;
  if (!stem) {
    quiet(panel, panel.t("leaves_select"));
    return taken;
  }
  quiet(panel, filled(panel.t("leaves_of"), {{"stem", std::to_string(stem->value)}}));
  if (button(panel, "leaves_add", Emphasis::Primary, -1)) taken = Step{document::AddLeaves{newLeaves(panel.following.said, *stem)}};
  gap(panel, 4);
  for (std::size_t i = 0; i < panel.project.leaves.size(); ++i) {
    quantify::LeafArrangement draft = panel.project.leaves[i].arrangement;
    if (draft.stem != *stem) continue;
    ImGui::PushID(static_cast<int>(i));
    std::string title = draft.arrangement;
    for (const NodeId node : draft.at) title += " · " + filled(panel.t("node_n"), {{"node", std::to_string(node.value)}});
    if (ImGui::CollapsingHeader((title + "##leaves").c_str())) {
      const auto& pending = panel.state.leavesDraft;
      const bool mine = pending && panel.state.leavesNumber == static_cast<int>(i) + 1;
      if (mine) draft = *pending;
      if (editLeaves(panel, draft)) {
        panel.state.leavesDraft = draft;
        panel.state.leavesNumber = static_cast<int>(i) + 1;
      }
      // A slider that is being pulled previews; one command when it is let go.
      if (panel.state.leavesDraft && panel.state.leavesNumber == static_cast<int>(i) + 1 && !ImGui::IsAnyItemActive()) {
        taken = Step{document::ChangeLeaves{static_cast<int>(i) + 1, *panel.state.leavesDraft}};
        panel.state.leavesDraft.reset();
      }
      if (const auto bare = bareStems(panel.project); !bare.empty()) {
        const std::string label = filled(panel.t("leaves_copy"), {{"n", std::to_string(bare.size())}}) + "##copy";
        if (ImGui::Button(label.c_str(), {-1, 0})) taken = Step{document::CopyLeaves{static_cast<int>(i) + 1, bare}};
        landmark(panel, "leaves_copy");
      }
      if (button(panel, "leaves_remove", Emphasis::Plain, -1)) taken = Step{document::RemoveLeaves{static_cast<int>(i) + 1}};
    }
    ImGui::PopID();
  }
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

namespace {

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
