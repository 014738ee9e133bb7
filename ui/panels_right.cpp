#include "base/text.hpp"
#include "document/lookup.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::NodeId;
using document::StemId;
using document::Step;

std::string length(const Panel& panel, double value) { return shortest(roundedTo(value, 4)) + " " + panel.project.unit; }

Taken nodeFacts(const Panel& panel, const skeleton3d::ClickedNode& node) {
  Taken taken;
  ImGui::PushFont(font(Face::Heading));
  ImGui::TextUnformatted(filled(panel.t("node_n"), {{"node", std::to_string(node.id.value)}}).c_str());
  ImGui::PopFont();
  const skeleton3d::Node* solved = nullptr;
  if (panel.following.skeleton.good)
    for (const skeleton3d::Node& known : panel.following.skeleton.good->nodes)
      if (known.id == node.id) solved = &known;
  for (const document::ProjectView& view : panel.project.views) {
    const auto click = node.clicks.find(view.view.name);
    const std::string name = nameOfView(panel, view.view.name);
    if (click == node.clicks.end()) {
      fact(panel, name.c_str(), panel.t("not_clicked"));
      continue;
    }
    std::string value = fixed(click->second.px.x, 1) + ", " + fixed(click->second.px.y, 1);
    if (solved != nullptr && solved->reprojection_px.contains(view.view.name)) value += "  (" + fixed(solved->reprojection_px.at(view.view.name), 2) + " px)";
    fact(panel, name.c_str(), value);
    if (node.placed.contains(view.view.name)) quiet(panel, panel.t("click_placed"));
  }
  if (node.clicks.size() < 2) say(panel, NoticeKind::Warned, panel.t("needs_two"));
  if (solved != nullptr) {
    gap(panel, 4);
    fact(panel, "x, y, z", fixed(solved->position.at.x, 3) + ", " + fixed(solved->position.at.y, 3) + ", " + fixed(solved->position.at.z, 3));
    fact(panel, panel.t("sure"), "± " + fixed(std::max({solved->sigma.x, solved->sigma.y, solved->sigma.z}), 4) + " " + panel.project.unit);
  }
  gap(panel, 4);
  double width = 2 * node.radius.value_or(0);
  ImGui::PushFont(font(Face::Small));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(panel.t("width"));
  ImGui::SameLine(panel.px(90));
  ImGui::SetNextItemWidth(-1);
  ImGui::InputDouble("##width", &width, 0, 0, node.radius ? ("%.4g " + panel.project.unit).c_str() : panel.t("not_measured"));
  if (ImGui::IsItemDeactivatedAfterEdit() && width >= 0) taken = Step{document::SetRadius{node.id, width / 2}};
  ImGui::PopFont();
  gap(panel, 4);
  if (button(panel, "delete_node", Emphasis::Plain, -1)) taken = Step{document::RemoveNodes{{node.id}}};
  return taken;
}

const quantify::Segment* segmentTo(const Panel& panel, NodeId node) {
  if (!panel.following.measurements.good) return nullptr;
  for (const quantify::Segment& segment : panel.following.measurements.good->segments)
    if (segment.to == node) return &segment;
  return nullptr;
}

void segmentFacts(const Panel& panel, NodeId node) {
  const quantify::Segment* segment = segmentTo(panel, node);
  if (segment == nullptr) return;
  gap(panel, 8);
  heading(panel, "segment");
  static constexpr std::array<const char*, 3> kKinds = {"segment_root", "segment_main", "segment_branch"};
  fact(panel, panel.t("segment_kind"), panel.t(kKinds[static_cast<std::size_t>(segment->kind)]));
  fact(panel, panel.t("segment_length"), length(panel, segment->length));
  fact(panel, panel.t("segment_level"), std::to_string(segment->level));
  fact(panel, "rotr", fixed(segment->rotr.degrees(), 1) + "°");
  fact(panel, "rotu", fixed(segment->rotu.degrees(), 1) + "°");
  fact(panel, panel.t("segment_leaves"), std::to_string(segment->leaves.size()));
}

Taken stemFacts(const Panel& panel, StemId id) {
  Taken taken;
  const auto place = document::stemWithId(panel.project, id);
  if (!place) return taken;
  const skeleton3d::ClickedStem& stem = panel.project.stems[*place].stem;
  gap(panel, 8);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(font(Face::Heading));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  drawMark(list, markOf(id), {at.x + panel.px(7), at.y + ImGui::GetFontSize() / 2}, panel.px(5.5f), colourOf(id));
  ImGui::Indent(panel.px(22));
  ImGui::TextUnformatted(filled(panel.t("stem_n"), {{"stem", std::to_string(id.value)}}).c_str());
  ImGui::Unindent(panel.px(22));
  ImGui::PopFont();
  double total = 0;
  for (const NodeId node : stem.nodes)
    if (const auto* segment = segmentTo(panel, node); segment != nullptr && segment->stem == id) total += segment->length;
  fact(panel, panel.t("nodes"), std::to_string(stem.nodes.size()));
  if (total > 0) fact(panel, panel.t("segment_length"), length(panel, total));
  gap(panel, 4);
  const float half = (ImGui::GetContentRegionAvail().x - panel.px(6)) / 2;
  if (button(panel, "reverse_stem", Emphasis::Plain, half)) taken = Step{document::ReverseStem{id}};
  ImGui::SameLine(0, panel.px(6));
  if (button(panel, "delete_stem", Emphasis::Plain, half)) taken = Step{document::RemoveStem{id}};
  return taken;
}

/// Several nodes: what can be done to them together.
Taken selectionFacts(const Panel& panel) {
  Taken taken;
  const auto nodes = panel.state.selection.all();
  ImGui::PushFont(font(Face::Heading));
  ImGui::TextUnformatted(filled(panel.t("nodes_selected"), {{"n", std::to_string(nodes.size())}}).c_str());
  ImGui::PopFont();
  gap(panel, 4);
  double width = 0;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(panel.t("width"));
  ImGui::SameLine(panel.px(90));
  ImGui::SetNextItemWidth(-1);
  ImGui::InputDouble("##width", &width, 0, 0, ("%.4g " + panel.project.unit).c_str());
  if (ImGui::IsItemDeactivatedAfterEdit() && width >= 0) {
    Step step;
    for (const NodeId node : nodes) step.emplace_back(document::SetRadius{node, width / 2});
    taken = std::move(step);
  }
  gap(panel, 4);
  if (button(panel, "key_delete", Emphasis::Plain, -1)) taken = Step{document::RemoveNodes{nodes}};
  return taken;
}

void plantFacts(const Panel& panel) {
  if (panel.project.views.empty() && panel.project.nodes.empty()) return;  // nothing to count yet: the middle says how to begin
  heading(panel, "plant");
  fact(panel, panel.t("nodes"), std::to_string(panel.project.nodes.size()));
  fact(panel, panel.t("way_stems"), std::to_string(panel.project.stems.size()));
  if (const auto& measurements = panel.following.measurements.good) {
    fact(panel, panel.t("segments"), std::to_string(measurements->segments.size()));
    std::size_t leaves = 0;
    for (const auto& segment : measurements->segments) leaves += segment.leaves.size();
    fact(panel, panel.t("segment_leaves"), std::to_string(leaves));
  }
  if (const auto& skeleton = panel.following.skeleton.good; skeleton && !skeleton->nodes.empty()) {
    double low = 0, high = 0, worst = 0;
    for (const auto& node : skeleton->nodes) {
      low = std::min(low, node.position.at.y);
      high = std::max(high, node.position.at.y);
      for (const auto& [view, px] : node.reprojection_px) worst = std::max(worst, px);
    }
    fact(panel, panel.t("height"), length(panel, high - low));
    fact(panel, panel.t("worst_click"), fixed(worst, 2) + " px");
  }
  gap(panel, 6);
  quiet(panel, panel.t("inspector_help"));
}

void organFacts(const Panel& panel) {
  if (panel.organ() == nullptr) return;
  const ChosenOrgan& organ = *panel.organ();
  static constexpr std::array<const char*, 6> kNames = {"organ_apex", "organ_stem", "organ_leaf", "organ_root", "organ_fruit", "organ_flower"};
  heading(panel, kNames[static_cast<std::size_t>(organ.kind)]);
  fact(panel, panel.t("segment_length"), length(panel, organ.length));
  fact(panel, panel.t("organ_age"), shortest(roundedTo(organ.age, 2)));
  quiet(panel, organ.rule.empty() ? panel.t("organ_axiom") : organ.rule);
  gap(panel, 8);
}

}  // namespace

Taken inspector(const Panel& panel) {
  organFacts(panel);
  const auto place = panel.state.selection.node ? document::nodeWithId(panel.project, *panel.state.selection.node) : std::nullopt;
  if (!place) {
    plantFacts(panel);
    return std::nullopt;
  }
  if (!panel.state.selection.others.empty()) return selectionFacts(panel);
  const skeleton3d::ClickedNode& node = panel.project.nodes[*place].node;
  Taken taken = nodeFacts(panel, node);
  segmentFacts(panel, node.id);
  if (const auto stem = stemOf(panel.project, node.id))
    if (auto step = stemFacts(panel, *stem)) taken = std::move(step);
  return taken;
}

// ---- the timeline ------------------------------------------------------------------------------------------------------------

void timeline(const Panel& panel, Area area) {
  UiState& state = panel.state;
  const auto* grown = panel.shown();
  const double end = grown != nullptr ? grown->end : 0;
  const auto* measured = panel.following.grammar(document::GrammarKind::Initial);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Palette& p = panel.palette;
  const float size = panel.px(34), middle = area.y + area.height / 2;
  float x = area.x + panel.px(14);
  ImGui::SetCursorScreenPos({x, middle - size / 2});
  if (iconButton(panel, "to_start", Icon::Start, panel.t("to_start"), size)) state.time = 0, state.playing = false;
  x += size;
  ImGui::SetCursorScreenPos({x, middle - size / 2});
  if (iconButton(panel, "play", state.playing ? Icon::Pause : Icon::Play, panel.t("play"), size) && end > 0) {
    state.playing = !state.playing;
    if (state.playing && (state.time < 0 || state.time >= end)) state.time = 0;
  }
  x += size;
  ImGui::SetCursorScreenPos({x, middle - size / 2});
  if (iconButton(panel, "to_end", Icon::End, panel.t("to_end"), size)) state.time = -1, state.playing = false;
  x += size + panel.px(14);
  const float right = area.x + area.width - panel.px(130);
  const float track = panel.px(8);
  const double shown = state.time < 0 ? end : state.time;
  const auto at = [&](double time) { return end <= 0 ? x : x + static_cast<float>(time / end) * (right - x); };
  ImGui::SetCursorScreenPos({x, middle - size / 2});
  ImGui::InvisibleButton("track", {right - x, size});
  landmark(panel, "track");
  if (ImGui::IsItemActive() && end > 0) {
    state.time = std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - x) / (right - x)), 0.0, 1.0) * end;
    state.playing = false;
  }
  if (ImGui::IsItemHovered()) state.status = panel.t("click_timeline");
  list.AddRectFilled({x, middle - track / 2}, {right, middle + track / 2}, p.raised, track / 2);
  const bool predicts = state.kind == document::GrammarKind::Predictive && measured != nullptr && measured->end < end;
  const double measuredEnd = predicts ? measured->end : end;
  list.AddRectFilled({x, middle - track / 2}, {at(std::min(shown, measuredEnd)), middle + track / 2}, p.accent, track / 2);
  if (predicts && shown > measuredEnd) list.AddRectFilled({at(measuredEnd), middle - track / 2}, {at(shown), middle + track / 2}, p.predicted, track / 2);
  if (predicts) {
    list.AddLine({at(measuredEnd), middle - panel.px(12)}, {at(measuredEnd), middle + panel.px(12)}, p.quiet, 1);
    ImGui::PushFont(font(Face::Small));
    const char* words[2] = {panel.t("measured"), panel.t("predicted")};
    const float y = middle + panel.px(12);
    const float w = ImGui::CalcTextSize(words[0]).x;
    if (at(measuredEnd) - w - panel.px(8) > x) list.AddText({at(measuredEnd) - w - panel.px(6), y}, p.quiet, words[0]);
    list.AddText({std::min(at(measuredEnd) + panel.px(6), right - ImGui::CalcTextSize(words[1]).x), y}, p.quiet, words[1]);
    ImGui::PopFont();
  }
  list.AddCircleFilled({at(shown), middle}, panel.px(8), p.text, 24);
  ImGui::PushFont(font(Face::Small));
  const std::string label = end > 0 ? filled(panel.t("time_of"), {{"t", fixed(shown, 1)}, {"end", fixed(end, 1)}}) : panel.t("nothing_grows");
  list.AddText({right + panel.px(20), middle - ImGui::GetFontSize() / 2}, p.quiet, label.c_str());
  ImGui::PopFont();
}

}  // namespace axil::ui
