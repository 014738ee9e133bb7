#include "keywords/presets.hpp"
#include "ui/leaf_steps.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Step;

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

constexpr int kMostLeafNodes = 10'000;

/// How long the stem is, as measured; nothing before it is.
std::optional<double> lengthOf(const Panel& panel, document::StemId stem) {
  double length = 0;
  if (panel.following.measurements.good)
    for (const quantify::Segment& segment : panel.following.measurements.good->segments)
      if (segment.stem == stem) length += segment.length;
  return length > 0 ? std::optional(length) : std::nullopt;
}

/// Leaf nodes for each unit of the stem's length; gives their number where another density is wanted.
std::optional<int> densityRow(const Panel& panel, document::StemId stem, int nodes) {
  const auto length = lengthOf(panel, stem);
  if (!length) return std::nullopt;
  double density = nodes / *length;
  ImGui::TextUnformatted(panel.t("leaf_density"));
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputDouble("##density", &density, 0, 0, ("%.3g / " + panel.project.unit).c_str());
  if (!ImGui::IsItemDeactivatedAfterEdit() || !(density > 0)) return std::nullopt;
  return std::clamp(static_cast<int>(std::lround(std::min(density * *length, 1.0 * kMostLeafNodes))), 1, kMostLeafNodes);
}

bool editLeaves(const Panel& panel, quantify::LeafArrangement& draft) {
  bool changed = combo("##arrangement", keywords::arrangementNames(), draft.arrangement, "–");
  std::string shape = draft.shape;
  if (combo("##shape", leafShapeNames(), shape, panel.t("from_description"))) draft.shape = shape, changed = true;
  leafPreview(panel, draft.shape.empty() ? "ovate" : draft.shape);
  if (draft.at.empty()) {
    int nodes = draft.nodes.value_or(3);
    ImGui::TextUnformatted(panel.t("leaf_nodes"));
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##nodes", &nodes, 1, 40)) draft.nodes = std::clamp(nodes, 1, kMostLeafNodes), changed = true;
    if (const auto wanted = densityRow(panel, draft.stem, nodes)) draft.nodes = *wanted, changed = true;
  }
  changed = angleRow(panel, "leaf_angle", draft.angle, 55, 0, 180) || changed;
  changed = angleRow(panel, "leaf_roll", draft.roll, 0, -180, 180) || changed;
  changed = angleRow(panel, "leaf_azimuth", draft.azimuth, 0, -180, 180) || changed;
  changed = lengthRow(panel, "leaf_length", draft.length, 0.05) || changed;
  changed = lengthRow(panel, "leaf_petiole", draft.petiole, 0.01) || changed;
  return changed;
}

}  // namespace

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

}  // namespace axil::ui
