#include "document/lookup.hpp"
#include "skeleton3d/camera.hpp"
#include "ui/organ_pick.hpp"
#include "ui/plant_picture.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

struct View3d {
  const Panel& panel;
  Area area;
  skeleton3d::Camera camera;
  ImDrawList& list;

  [[nodiscard]] ImVec2 onScreen(PlantPoint p) const {
    const glm::dvec2 px = skeleton3d::project(camera, p).px;
    return {area.x + static_cast<float>(px.x), area.y + static_cast<float>(px.y)};
  }
  [[nodiscard]] PhotoPoint mouse() const {
    const ImVec2 at = ImGui::GetIO().MousePos;
    return {{at.x - area.x, at.y - area.y}};
  }
};

const skeleton3d::Node* nodeWith(const skeleton3d::Skeleton& skeleton, skeleton3d::NodeId id) {
  for (const skeleton3d::Node& node : skeleton.nodes)
    if (node.id == id) return &node;
  return nullptr;
}

/// What is shown is not of the present project: it could not be measured.
bool isPast(const Panel& panel) { return panel.following.skeleton.trouble && !panel.following.partly; }

/// A draft with errors: the last that grew stays.
bool isStale(const Panel& panel) { return panel.state.grammarDraft && panel.draft && !panel.draft->growth; }

void drawSkeleton(const View3d& view) {
  const auto& shown = view.panel.following.skeleton;
  if (!shown.good) return;
  const bool young = view.panel.state.time >= 0 && view.panel.following.grammar(document::GrammarKind::Initial) != nullptr &&
                     view.panel.state.time < view.panel.following.grammar(document::GrammarKind::Initial)->end;
  // The last good one stands back, and so does what has not grown yet.
  const std::uint32_t alpha = young ? 45 : isPast(view.panel) ? 110 : 235;
  const auto chosen = view.panel.state.selection.node ? stemOf(view.panel.project, *view.panel.state.selection.node) : std::nullopt;
  for (const skeleton3d::Stem& stem : shown.good->stems) {
    const Colour colour = withAlpha(colourOf(stem.id), alpha);
    const float width = view.panel.px(stem.id == chosen ? 3.0f : 1.8f);
    for (std::size_t i = 0; i < stem.nodes.size(); ++i) {
      const skeleton3d::Node* node = nodeWith(*shown.good, stem.nodes[i]);
      const skeleton3d::Node* before = i == 0 ? nullptr : nodeWith(*shown.good, stem.nodes[i - 1]);
      if (node != nullptr && before != nullptr) view.list.AddLine(view.onScreen(before->position), view.onScreen(node->position), colour, width);
      if (node != nullptr && i > 0) drawMark(view.list, markOf(stem.id), view.onScreen(node->position), view.panel.px(2.6f), colour);
    }
  }
  if (!view.panel.state.selection.node) return;
  if (const skeleton3d::Node* node = nodeWith(*shown.good, *view.panel.state.selection.node)) {
    view.list.AddCircle(view.onScreen(node->position), view.panel.px(8), rgb(0x000000, 170), 24, view.panel.px(4));
    view.list.AddCircle(view.onScreen(node->position), view.panel.px(8), rgb(0xFFFFFF), 24, view.panel.px(2));
    view.panel.state.landmarks["selected_in_space"] = {view.onScreen(node->position).x, view.onScreen(node->position).y, 0, 0};
  }
}

/// Other seeds of the same grammar, behind what is shown.
void drawGhosts(const View3d& view) {
  for (std::size_t i = 0; i < view.panel.ghosts.size(); ++i) {
    const Colour colour = withAlpha(colourOf(document::StemId(static_cast<int>(i) + 2)), 120);
    for (const auto& [from, to] : view.panel.ghosts[i]) view.list.AddLine(view.onScreen(from), view.onScreen(to), colour, view.panel.px(1.3f));
  }
}

/// Beside every node: the stem segment under the mouse, which is known by the node that it ends at.
void pickSegment(const View3d& view, const skeleton3d::Skeleton& skeleton) {
  double best = static_cast<double>(view.panel.px(8));
  for (const skeleton3d::Stem& stem : skeleton.stems)
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const auto* from = nodeWith(skeleton, stem.nodes[i - 1]);
      const auto* to = nodeWith(skeleton, stem.nodes[i]);
      if (from == nullptr || to == nullptr || !document::nodeWithId(view.panel.project, to->id)) continue;
      const double distance = distanceToSegment(view.mouse().px, skeleton3d::project(view.camera, from->position).px, skeleton3d::project(view.camera, to->position).px);
      if (distance > best) continue;
      best = distance;
      view.panel.state.selection = {.node = to->id, .others = {}};
    }
}

/// The clicked node under the mouse.
const skeleton3d::Node* nodeUnderMouse(const View3d& view) {
  const auto& skeleton = view.panel.following.skeleton.good;
  if (!skeleton) return nullptr;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const skeleton3d::Node* found = nullptr;
  float best = view.panel.px(10);
  for (const skeleton3d::Node& node : skeleton->nodes) {
    const ImVec2 at = view.onScreen(node.position);
    const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
    if (distance > best || !document::nodeWithId(view.panel.project, node.id)) continue;
    best = distance;
    found = &node;
  }
  return found;
}

/// An organ of the plant as it stands there: it says which rule made it, and its measured segment is selected.
void pickOrgan(const View3d& view, const GrownGrammar& grown) {
  UiState& state = view.panel.state;
  if (state.grammarDraft) return;
  const auto plant = grown.growth ? simeco::plantAt(*grown.growth, timeShown(state.time, grown)) : Result<simeco::Plant>(simeco::Plant{});
  const auto organ = plant ? organUnder(*plant, view.camera, view.mouse(), static_cast<double>(view.panel.px(5))) : std::nullopt;
  if (!organ) return;
  state.organ = describedOrgan(*plant, *organ);
  state.organOf = {view.panel.following.revision, state.kind};
  if (state.organ->where) state.wantedLine = placeOf(grown.text, state.organ->where->begin).line - 1;
  const auto& measured = view.panel.following.measurements.good;
  const int segment = state.kind == document::GrammarKind::Structured ? -1 : segmentOfOrgan(*plant, *organ);
  if (measured && segment >= 0 && segment < static_cast<int>(measured->segments.size())) state.selection = {.node = measured->segments[static_cast<std::size_t>(segment)].to, .others = {}};
}

void pick(const View3d& view) {
  UiState& state = view.panel.state;
  state.organ.reset();
  const auto& skeleton = view.panel.following.skeleton.good;
  const GrownGrammar* grown = view.panel.shown();
  if (const skeleton3d::Node* node = skeleton ? nodeUnderMouse(view) : nullptr) state.selection = {.node = node->id, .others = {}};
  else if (grown != nullptr && state.showPlant) pickOrgan(view, *grown);
  else if (skeleton) pickSegment(view, *skeleton);
}

/// The chosen organ's middle line.
void drawOrgan(const View3d& view, const GrownGrammar& grown) {
  const ChosenOrgan* organ = view.panel.organ();
  if (organ == nullptr || organ->time != timeShown(view.panel.state.time, grown)) return;
  const std::vector<PlantPoint>& middle = organ->middle;
  for (const auto& [colour, width] : {std::pair{rgb(0x000000, 170), 5.5f}, {rgb(0xFFFFFF), 2.6f}})
    for (std::size_t i = 1; i < middle.size(); ++i) view.list.AddLine(view.onScreen(middle[i - 1]), view.onScreen(middle[i]), colour, view.panel.px(width));
}

// ---- dragging a node in space ----------------------------------------------------------------------------------------------

/// A press on a node may become a drag: not while an older plant is shown, whose nodes stand elsewhere.
void pressed(const View3d& view) {
  UiState& state = view.panel.state;
  if (state.way != Way::Stems || !state.showSkeleton || state.grammarDraft || isPast(view.panel)) return;
  if (const skeleton3d::Node* node = nodeUnderMouse(view)) state.plantDrag = PlantDrag{.node = node->id, .from = node->position, .at = node->position};
}

/// The node follows the mouse in the plane through where it was that faces the eye.
void moved(const View3d& view) {
  UiState& state = view.panel.state;
  if (!state.plantDrag || !ImGui::IsMouseDragging(0, view.panel.px(3))) return;
  PlantDrag& drag = *state.plantDrag;
  const ImVec2 by = ImGui::GetMouseDragDelta(0, 0);
  const PhotoPoint target{skeleton3d::project(view.camera, drag.from).px + glm::dvec2(by.x, by.y)};
  const skeleton3d::Ray ray = skeleton3d::rayThrough(view.camera, target);
  const glm::dvec3 towards = glm::transpose(view.camera.rotation)[2];
  const double ahead = glm::dot(ray.direction.unit(), towards);
  if (std::abs(ahead) < 1e-9) return;
  drag.at = {ray.origin.at + ray.direction.unit() * (glm::dot(drag.from.at - ray.origin.at, towards) / ahead)};
  drag.moved = true;
  state.selection = {.node = drag.node, .others = {}};
}

/// The clicks of the node go where its new place is seen, in every photo whose camera is known.
Taken dropped(const Panel& panel, const PlantDrag& drag) {
  const auto place = document::nodeWithId(panel.project, drag.node);
  if (!place || !drag.moved || !panel.following.measured.good) return std::nullopt;
  const auto& clicks = panel.project.nodes[*place].node.clicks;
  document::Step step;
  for (const skeleton3d::View& view : panel.following.measured.good->views)
    if (const auto click = clicks.find(view.name); click != clicks.end() && view.camera.model != skeleton3d::CameraModel::Unknown)
      step.emplace_back(document::MoveClick{drag.node, view.name, {click->second.px + drag.moved_px(view.camera)}});
  return step.empty() ? Taken{} : Taken{std::move(step)};
}

void drawDrag(const View3d& view) {
  const auto& drag = view.panel.state.plantDrag;
  if (!drag || !drag->moved) return;
  const auto stem = stemOf(view.panel.project, drag->node);
  const Colour colour = stem ? colourOf(*stem) : rgb(0xFFFFFF);
  dashed(view.list, view.onScreen(drag->from), view.onScreen(drag->at), colour, view.panel.px(2), view.panel.px(6));
  view.list.AddCircleFilled(view.onScreen(drag->at), view.panel.px(5), colour, 20);
  view.list.AddCircle(view.onScreen(drag->at), view.panel.px(8), rgb(0xFFFFFF), 24, view.panel.px(2));
}

void turn(const View3d& view, bool hovered, bool active) {
  ImGuiIO& io = ImGui::GetIO();
  Orbit& orbit = view.panel.state.orbit;
  view.panel.state.turningPlant = active && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || view.panel.state.turningPlant);
  if (hovered && io.MouseWheel != 0) orbit.zoom = std::clamp(orbit.zoom * std::pow(1.15, io.MouseWheel), 0.1, 40.0);
  if (!active || view.panel.state.plantDrag) return;
  if (ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2)) {
    orbit.shift += glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / static_cast<double>(view.area.height);
    return;
  }
  orbit.azimuth += Angle::fromDegrees(-0.5 * static_cast<double>(io.MouseDelta.x / view.panel.state.scale));
  const double up = orbit.elevation.degrees() + 0.4 * static_cast<double>(io.MouseDelta.y / view.panel.state.scale);
  orbit.elevation = Angle::fromDegrees(std::clamp(up, -4.0, 88.0));
}

void overlayButtons(const Panel& panel, Area area) {
  const float size = panel.px(26), pad = panel.px(7);
  ImGui::SetCursorScreenPos({area.x + area.width - 2 * size - 1.5f * pad, area.y + pad});
  if (iconButton(panel, "toggle_skeleton", Icon::Stems, panel.t("show_skeleton"), size)) panel.state.showSkeleton = !panel.state.showSkeleton;
  ImGui::SetCursorScreenPos({area.x + area.width - size - pad, area.y + pad});
  if (iconButton(panel, "toggle_plant", Icon::Leaves, panel.t("show_plant"), size)) panel.state.showPlant = !panel.state.showPlant;
}

}  // namespace

Taken plantPane(const Panel& panel, Area area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low{area.x, area.y}, high{area.x + area.width, area.y + area.height};
  const bool isPictured = panel.shown() != nullptr && panel.state.showPlant && panel.plantPicture.id() != 0, isDimmed = isPast(panel) || isStale(panel);
  if (!isPictured || isDimmed) list.AddRectFilled(low, high, panel.palette.photo);
  panel.state.landmarks["pane_plant"] = {area.x, area.y, area.width, area.height};
  panel.state.plantPaneSize = {static_cast<int>(area.width), static_cast<int>(area.height)};
  ImGui::PushID("plant");
  overlayButtons(panel, area);
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("turn", {area.width, area.height}, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const auto* grown = panel.shown();
  View3d view{panel, area, {}, list};
  turn(view, hovered, active);
  if (grown == nullptr) {
    const char* text = panel.t("plant_none");
    const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, area.width * 0.8f);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {area.x + (area.width - size.x) / 2, area.y + (area.height - size.y) / 2}, panel.palette.quiet, text, nullptr, area.width * 0.8f);
    ImGui::PopID();
    return std::nullopt;
  }
  view.camera = orbitCamera(panel.state.orbit, grown->middle, grown->reach, panel.state.plantPaneSize);
  if (ImGui::IsItemActivated() && ImGui::IsMouseDown(0)) pressed(view);
  if (active) moved(view);
  Taken taken;
  if (ImGui::IsItemDeactivated()) {
    const ImVec2 by = ImGui::GetMouseDragDelta(0, 0);
    const auto drag = std::exchange(panel.state.plantDrag, std::nullopt);
    if (drag && drag->moved) taken = dropped(panel, *drag);
    else if (ImGui::IsMouseReleased(0) && std::hypot(by.x, by.y) < panel.px(4)) pick(view);
  }
  if (hovered) panel.state.status = panel.t(panel.state.way == Way::Stems ? "click_plant_stems" : "click_plant");
  list.PushClipRect(low, high, true);
  if (isPictured)
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(panel.plantPicture.id())), low, high, {0, 0}, {1, 1}, rgb(0xFFFFFF, isDimmed ? 120 : 255));
  drawGhosts(view);
  if (panel.state.showSkeleton && !panel.state.grammarDraft) drawSkeleton(view);
  drawOrgan(view, *grown);
  drawDrag(view);
  ImGui::PushFont(font(Face::Small));
  const float pad = panel.px(7);
  const float width = chip(list, {area.x + pad, area.y + pad}, std::string("4  ") + panel.t("view_plant"), withAlpha(panel.palette.panel, 225), panel.palette.text, pad);
  if (isStale(panel)) chip(list, {area.x + 1.6f * pad + width, area.y + pad}, panel.t("last_good"), withAlpha(panel.palette.panel, 225), panel.palette.warning, pad);
  else if (panel.following.skeleton.trouble)
    chip(list, {area.x + 1.6f * pad + width, area.y + pad}, panel.t(panel.following.partly ? "so_far" : "last_good"), withAlpha(panel.palette.panel, 225), panel.palette.warning, pad);
  ImGui::PopFont();
  const float size = panel.px(26);
  for (int i = 0; i < 2; ++i) {
    const ImVec2 at{area.x + area.width - static_cast<float>(2 - i) * size - (i == 0 ? 1.5f : 1.0f) * pad, area.y + pad};
    const bool on = i == 0 ? panel.state.showSkeleton : panel.state.showPlant;
    list.AddRectFilled(at, {at.x + size, at.y + size}, withAlpha(panel.palette.panel, 225), panel.px(5));
    drawIcon(list, i == 0 ? Icon::Stems : Icon::Leaves, {at.x + size / 2, at.y + size / 2}, size * 0.5f, on ? panel.palette.accent : panel.palette.quiet);
  }
  list.PopClipRect();
  ImGui::PopID();
  return taken;
}

}  // namespace axil::ui
