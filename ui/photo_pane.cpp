#include "document/lookup.hpp"
#include "ui/epipolar.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::NodeId;
using document::StemId;

/// A photo in its pane: photo px to screen px and back.
struct Lens {
  ImVec2 middle;
  PhotoFrame frame;

  [[nodiscard]] ImVec2 onScreen(PhotoPoint p) const {
    return {middle.x + static_cast<float>((p.px.x - frame.centre.x) * frame.zoom), middle.y + static_cast<float>((p.px.y - frame.centre.y) * frame.zoom)};
  }
  [[nodiscard]] PhotoPoint onPhoto(ImVec2 s) const {
    return {{frame.centre.x + (s.x - middle.x) / frame.zoom, frame.centre.y + (s.y - middle.y) / frame.zoom}};
  }
};

/// One photo pane while it is drawn.
struct Pane {
  const Panel& panel;
  const document::ProjectView& view;
  const ShownPhoto* photo;
  Area area;
  Lens lens;
  ImDrawList& list;

  [[nodiscard]] const std::string& name() const { return view.view.name; }
  [[nodiscard]] UiState& state() const { return panel.state; }
  [[nodiscard]] double reach() const { return panel.px(9) / lens.frame.zoom; }
};

const skeleton3d::Camera* cameraOf(const Panel& panel, const std::string& view) {
  if (!panel.following.measured.good) return nullptr;
  for (const skeleton3d::View& known : panel.following.measured.good->views)
    if (known.name == view && known.camera.model != skeleton3d::CameraModel::Unknown) return &known.camera;
  return nullptr;
}

const skeleton3d::Node* solvedNode(const Panel& panel, NodeId id) {
  if (!panel.following.skeleton.good) return nullptr;
  for (const skeleton3d::Node& node : panel.following.skeleton.good->nodes)
    if (node.id == id) return &node;
  return nullptr;
}

/// Where a node is in this photo: as it is being dragged, as it was clicked, or as the skeleton says.
struct Seen {
  PhotoPoint at;
  bool clicked = true;
};
std::optional<Seen> seen(const Pane& pane, NodeId id) {
  if (const auto& drag = pane.state().drag; drag && drag->moved && drag->node == id && drag->view == pane.name()) return Seen{drag->at};
  const auto place = document::nodeWithId(pane.panel.project, id);
  if (!place) return std::nullopt;
  const auto& clicks = pane.panel.project.nodes[*place].node.clicks;
  if (const auto click = clicks.find(pane.name()); click != clicks.end()) return Seen{click->second};
  const skeleton3d::Camera* camera = cameraOf(pane.panel, pane.name());
  const skeleton3d::Node* solved = solvedNode(pane.panel, id);
  if (camera == nullptr || solved == nullptr || !skeleton3d::isInFront(*camera, solved->position)) return std::nullopt;
  return Seen{skeleton3d::project(*camera, solved->position), false};
}

// ---- drawing ---------------------------------------------------------------------------------------------------------------

void drawPhoto(const Pane& pane) {
  if (pane.photo == nullptr || pane.photo->texture.id() == 0) return;
  pane.photo->texture.magnify(pane.lens.frame.zoom > 3 ? Texture::Magnified::Pixels : Texture::Magnified::Smooth);
  const glm::dvec2 size(pane.photo->size_px);
  pane.list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(pane.photo->texture.id())), pane.lens.onScreen({{0, 0}}), pane.lens.onScreen({size}));
}

void drawSegment(const Pane& pane, const Seen& a, const Seen& b, Colour colour, float width) {
  const ImVec2 from = pane.lens.onScreen(a.at), to = pane.lens.onScreen(b.at);
  if (!a.clicked || !b.clicked) return dashed(pane.list, from, to, withAlpha(colour, 190), width, pane.panel.px(5));
  pane.list.AddLine(from, to, rgb(0x101010, 130), width + pane.panel.px(1.6f));
  pane.list.AddLine(from, to, colour, width);
}

void drawStem(const Pane& pane, const skeleton3d::ClickedStem& stem, bool chosen) {
  const Colour colour = colourOf(stem.id);
  const float width = pane.panel.px(chosen ? 3.2f : 2.0f);
  for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
    const auto a = seen(pane, stem.nodes[i - 1]), b = seen(pane, stem.nodes[i]);
    if (a && b) drawSegment(pane, *a, *b, colour, width);
  }
  // A node is drawn by the stem that it is a part of; a stem's first node belongs to its parent.
  for (std::size_t i = 0; i < stem.nodes.size(); ++i) {
    if (i == 0 && stemOf(pane.panel.project, stem.nodes[0]) != stem.id) continue;
    const auto at = seen(pane, stem.nodes[i]);
    if (!at) continue;
    const ImVec2 s = pane.lens.onScreen(at->at);
    const float r = pane.panel.px(4.2f);
    if (at->clicked) drawMark(pane.list, markOf(stem.id), s, r, colour);
    else pane.list.AddCircle(s, r, withAlpha(colour, 200), 16, pane.panel.px(1.3f));
  }
}

void drawSelected(const Pane& pane, NodeId id) {
  const auto at = seen(pane, id);
  if (!at) return;
  const ImVec2 s = pane.lens.onScreen(at->at);
  pane.list.AddCircle(s, pane.panel.px(9), rgb(0x000000, 150), 28, pane.panel.px(4));
  pane.list.AddCircle(s, pane.panel.px(9), rgb(0xFFFFFF), 28, pane.panel.px(2));
}

void drawLine(const Pane& pane, const std::vector<PhotoPoint>& line, Colour colour, float width) {
  for (const PhotoPoint& p : line) pane.list.PathLineTo(pane.lens.onScreen(p));
  pane.list.PathStroke(colour, 0, width);
}

/// Lines of the selected node's clicks in the other photos, and of the mouse in another photo.
void drawEpipolar(const Pane& pane) {
  const skeleton3d::Camera* here = cameraOf(pane.panel, pane.name());
  if (here == nullptr) return;
  const auto* grown = pane.panel.following.grammar(document::GrammarKind::Initial);
  const PlantPoint middle = grown != nullptr ? grown->middle : PlantPoint{};
  const double reach = grown != nullptr ? 1.6 * grown->reach : 1;
  const auto lineFrom = [&](const std::string& view, PhotoPoint at) {
    const skeleton3d::Camera* there = cameraOf(pane.panel, view);
    return there == nullptr ? std::vector<PhotoPoint>{} : epipolarLine(*there, at, *here, middle, reach);
  };
  const auto selected = pane.state().selection.node ? document::nodeWithId(pane.panel.project, *pane.state().selection.node) : std::nullopt;
  if (selected) {
    const auto& node = pane.panel.project.nodes[*selected].node;
    const auto stem = stemOf(pane.panel.project, node.id);
    const bool missing = !node.clicks.contains(pane.name());
    for (const auto& [view, at] : node.clicks)
      if (view != pane.name()) drawLine(pane, lineFrom(view, at), withAlpha(stem ? colourOf(*stem) : rgb(0xFFFFFF), missing ? 230 : 70), pane.panel.px(missing ? 1.8f : 1));
  }
  const auto& hover = pane.state().hover;
  if (pane.state().way == Way::Stems && hover && hover->first != pane.name()) drawLine(pane, lineFrom(hover->first, hover->second), rgb(0xFFFFFF, 150), pane.panel.px(1));
}

void drawOrigin(const Pane& pane) {
  const float r = pane.panel.px(8);
  if (pane.view.origin_px && pane.state().way == Way::Photos) {
    const ImVec2 s = pane.lens.onScreen(*pane.view.origin_px);
    for (const auto& [colour, width] : {std::pair{rgb(0x000000, 160), 3.6f}, {rgb(0xFFFFFF), 1.6f}}) {
      pane.list.AddCircle(s, r, colour, 24, pane.panel.px(width));
      pane.list.AddLine({s.x - 1.7f * r, s.y}, {s.x + 1.7f * r, s.y}, colour, pane.panel.px(width));
      pane.list.AddLine({s.x, s.y - 1.7f * r}, {s.x, s.y + 1.7f * r}, colour, pane.panel.px(width));
    }
  }
  if (pane.view.scale && pane.state().way == Way::Photos) {
    const ImVec2 a = pane.lens.onScreen(pane.view.scale->from), b = pane.lens.onScreen(pane.view.scale->to);
    pane.list.AddLine(a, b, rgb(0x000000, 160), pane.panel.px(4));
    pane.list.AddLine(a, b, rgb(0xFFD54A), pane.panel.px(2));
  }
  const auto& from = pane.state().lengthFrom;
  if (from && from->first == pane.name() && pane.state().hover && pane.state().hover->first == pane.name())
    dashed(pane.list, pane.lens.onScreen(from->second), ImGui::GetIO().MousePos, rgb(0xFFD54A), pane.panel.px(2), pane.panel.px(6));
}

void drawLoupe(const Pane& pane, PhotoPoint at) {
  if (pane.photo == nullptr || pane.photo->texture.id() == 0) return;
  const float half = pane.panel.px(66), margin = pane.panel.px(10);
  const double magnified = std::max(6.0 * pane.panel.state.scale, 2 * pane.lens.frame.zoom);
  const bool left = ImGui::GetIO().MousePos.x > pane.area.x + pane.area.width / 2;
  const ImVec2 c{left ? pane.area.x + margin + half : pane.area.x + pane.area.width - margin - half, pane.area.y + pane.area.height - margin - half};
  const glm::dvec2 size(pane.photo->size_px);
  const auto uv = [&](double sx, double sy) {
    return ImVec2(static_cast<float>((at.px.x + sx * half / magnified) / size.x), static_cast<float>((at.px.y + sy * half / magnified) / size.y));
  };
  pane.list.AddRectFilled({c.x - half, c.y - half}, {c.x + half, c.y + half}, pane.panel.palette.photo, pane.panel.px(8));
  pane.list.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(pane.photo->texture.id())), {c.x - half, c.y - half}, {c.x + half, c.y + half},
                            uv(-1, -1), uv(1, 1), rgb(0xFFFFFF), pane.panel.px(8));
  pane.list.AddRect({c.x - half, c.y - half}, {c.x + half, c.y + half}, pane.panel.palette.accent, pane.panel.px(8), 0, pane.panel.px(2));
  for (const auto& [colour, width] : {std::pair{rgb(0x000000, 140), 3.0f}, {rgb(0xFFFFFF), 1.2f}}) {
    pane.list.AddLine({c.x - pane.panel.px(14), c.y}, {c.x + pane.panel.px(14), c.y}, colour, width);
    pane.list.AddLine({c.x, c.y - pane.panel.px(14)}, {c.x, c.y + pane.panel.px(14)}, colour, width);
  }
}

void drawLabel(const Pane& pane, int number) {
  ImGui::PushFont(font(Face::Small));
  const float pad = pane.panel.px(7);
  const std::string key = "view_" + pane.name();
  const std::string name = pane.panel.texts.has(key) ? pane.panel.t(key) : pane.name();
  const float width = chip(pane.list, {pane.area.x + pad, pane.area.y + pad}, std::to_string(number) + "  " + name, withAlpha(pane.panel.palette.panel, 225), pane.panel.palette.text, pad);
  const bool known = cameraOf(pane.panel, pane.name()) != nullptr;
  if (!known)
    chip(pane.list, {pane.area.x + 1.6f * pad + width, pane.area.y + pad}, pane.panel.t("camera_unknown"), withAlpha(pane.panel.palette.panel, 225), pane.panel.palette.warning, pad);
  ImGui::PopFont();
}

void drawTrouble(const Pane& pane) {
  std::string text = pane.panel.t("photo_reading");
  if (pane.view.photo.empty()) text = pane.panel.t("photo_none");
  else if (pane.photo != nullptr && pane.photo->trouble) text = pane.photo->trouble->message;
  else if (pane.photo != nullptr) return;
  const float width = pane.area.width * 0.8f;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  pane.list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {pane.area.x + (pane.area.width - size.x) / 2, pane.area.y + (pane.area.height - size.y) / 2}, pane.panel.palette.quiet, text.c_str(),
                    nullptr, width);
}

// ---- the mouse -------------------------------------------------------------------------------------------------------------

/// A photo that has not been moved fills its pane.
PhotoFrame frameOf(const Panel& panel, const std::string& view, glm::dvec2 photo, Area area) {
  PhotoFrame frame = panel.state.frames[view];
  if (frame.zoom > 0) return frame;
  return {.zoom = 0.96 * std::min(area.width / photo.x, area.height / photo.y), .centre = photo / 2.0};
}

void zoomAndPan(Pane& pane, bool hovered, bool panning) {
  ImGuiIO& io = ImGui::GetIO();
  PhotoFrame& frame = pane.lens.frame;
  if (hovered && io.MouseWheel != 0) {
    const PhotoPoint under = pane.lens.onPhoto(io.MousePos);
    frame.zoom = std::clamp(frame.zoom * std::pow(1.2, io.MouseWheel), 0.02, 64.0);
    frame.centre += under.px - pane.lens.onPhoto(io.MousePos).px;  // what is under the mouse stays there
    pane.state().frames[pane.name()] = frame;
  }
  if (panning && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    frame.centre -= glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / frame.zoom;
    pane.state().frames[pane.name()] = frame;
  }
}

PhotoClick clickAt(const Pane& pane, PhotoPoint at) {
  return {.view = pane.name(), .at = at, .reach_px = pane.reach(), .picking = ImGui::GetIO().KeyShift ? Picking::OnlyPlace : Picking::PickNodes};
}

std::string numberOf(std::optional<NodeId> id) { return id ? std::to_string(id->value) : ""; }
std::string numberOf(std::optional<StemId> id) { return id ? std::to_string(id->value) : ""; }

void sayWhat(const Pane& pane, const ClickMeaning& meaning) {
  static constexpr std::array<const char*, 6> kKeys = {"click_nothing", "click_select", "click_place", "click_extend", "click_branch", "click_begin"};
  const char* key = kKeys[static_cast<std::size_t>(meaning.kind)];
  if (meaning.kind == ClickKind::Nothing && pane.state().way == Way::Stems && !pane.panel.project.stems.empty()) key = "click_nothing_stems";
  pane.state().status = filled(pane.panel.t(key), {{"node", numberOf(meaning.node)}, {"stem", numberOf(meaning.stem)}, {"view", pane.name()}});
}

/// Outside the Stems part of the way a click only selects.
ClickMeaning meaningHere(const Pane& pane, PhotoPoint at) {
  const ClickMeaning meaning = meaningOf(pane.panel.project, pane.state().selection, clickAt(pane, at));
  return meaning.kind == ClickKind::Select || pane.state().way == Way::Stems ? meaning : ClickMeaning{};
}

Taken useTool(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  if (state.tool == PhotoTool::Origin) return document::Step{document::SetOrigin{pane.name(), at}};
  if (!state.lengthFrom || state.lengthFrom->first != pane.name()) {
    state.lengthFrom = {pane.name(), at};
    return std::nullopt;
  }
  const PhotoPoint from = state.lengthFrom->second;
  state.lengthFrom.reset();
  return document::Step{document::SetScale{pane.name(), from, at, state.knownLength}};
}

void sayTool(const Pane& pane) {
  const bool second = pane.state().lengthFrom && pane.state().lengthFrom->first == pane.name();
  pane.state().status = pane.panel.t(pane.state().tool == PhotoTool::Origin ? "click_origin" : second ? "click_length_to" : "click_length_from");
}

/// A press on a node may become a drag; only in Stems.
void maybeDrag(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  if (ImGui::IsItemActivated() && ImGui::IsMouseDown(0) && state.way == Way::Stems && !ImGui::GetIO().KeyShift)
    if (const auto node = nodeAt(pane.panel.project, clickAt(pane, at))) state.drag = NodeDrag{*node, pane.name(), at};
  if (!state.drag || state.drag->view != pane.name() || !ImGui::IsMouseDragging(0, pane.panel.px(3))) return;
  state.drag->moved = true;
  state.drag->at = at;
  state.selection.node = state.drag->node;
  state.status = filled(pane.panel.t("drag_node"), {{"node", std::to_string(state.drag->node.value)}});
}

Taken released(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  const auto drag = std::exchange(state.drag, std::nullopt);
  if (drag && drag->moved) return document::Step{document::MoveClick{drag->node, drag->view, drag->at}};
  const ImVec2 moved = ImGui::GetMouseDragDelta(0, 0);
  if (std::hypot(moved.x, moved.y) > pane.panel.px(4)) return std::nullopt;
  if (state.way == Way::Photos && state.tool != PhotoTool::None) return useTool(pane, at);
  const ClickMeaning meaning = meaningHere(pane, at);
  if (meaning.kind == ClickKind::Nothing) return std::nullopt;
  state.selection = meaning.after;
  return meaning.step.empty() ? Taken{} : Taken{meaning.step};
}

bool insidePhoto(const Pane& pane, PhotoPoint p) {
  return pane.photo != nullptr && p.px.x >= 0 && p.px.y >= 0 && p.px.x <= pane.photo->size_px.x && p.px.y <= pane.photo->size_px.y;
}

Taken mouse(Pane& pane) {
  ImGui::SetCursorScreenPos({pane.area.x, pane.area.y});
  ImGui::InvisibleButton("photo", {pane.area.width, pane.area.height}, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const bool spaceHeld = ImGui::IsKeyDown(32);
  const bool panning = active && (ImGui::IsMouseDown(2) || ImGui::IsMouseDown(1) || (spaceHeld && ImGui::IsMouseDown(0)));
  zoomAndPan(pane, hovered, panning);
  const PhotoPoint at = pane.lens.onPhoto(ImGui::GetIO().MousePos);
  if (spaceHeld) return std::nullopt;
  if (active) maybeDrag(pane, at);
  const bool isReleased = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(0);
  if (isReleased && hovered && (insidePhoto(pane, at) || pane.state().drag)) return released(pane, at);
  if (isReleased) pane.state().drag.reset();
  if (!hovered || !insidePhoto(pane, at)) return std::nullopt;
  pane.state().hover = {pane.name(), at};
  if (pane.state().drag && pane.state().drag->moved) return std::nullopt;
  if (pane.state().way == Way::Photos && pane.state().tool != PhotoTool::None) sayTool(pane);
  else sayWhat(pane, meaningHere(pane, at));
  return std::nullopt;
}

/// What a click would add, before it is clicked.
void drawGhost(const Pane& pane) {
  const auto& hover = pane.state().hover;
  if (!hover || hover->first != pane.name() || pane.state().way != Way::Stems || pane.state().drag) return;
  const ClickMeaning meaning = meaningHere(pane, hover->second);
  const Colour colour = meaning.stem ? colourOf(*meaning.stem) : meaning.kind == ClickKind::Branch ? colourOf(document::nextStemId(pane.panel.project)) : rgb(0xFFFFFF);
  const ImVec2 mouse = pane.lens.onScreen(hover->second);
  if (meaning.kind == ClickKind::Extend || meaning.kind == ClickKind::Branch)
    if (const auto from = seen(pane, *meaning.node)) dashed(pane.list, pane.lens.onScreen(from->at), mouse, colour, pane.panel.px(2), pane.panel.px(6));
  if (meaning.kind != ClickKind::Nothing && meaning.kind != ClickKind::Select) pane.list.AddCircle(mouse, pane.panel.px(4), colour, 16, pane.panel.px(1.6f));
}

}  // namespace

std::array<int, 3> viewsOfPanes(const document::Project& project) {
  static constexpr std::array<std::string_view, 3> kNames = {"front", "right", "top"};
  std::array<int, 3> panes = {-1, -1, -1};
  for (std::size_t i = 0; i < 3; ++i)
    if (const auto view = document::viewNamed(project, kNames[i])) panes[i] = static_cast<int>(*view);
  for (int v = 0; v < static_cast<int>(project.views.size()); ++v) {
    const auto free = std::find(panes.begin(), panes.end(), -1);
    if (free != panes.end() && std::find(panes.begin(), panes.end(), v) == panes.end()) *free = v;
  }
  return panes;
}

Taken photoPane(const Panel& panel, int number, Area area) {
  const int place = viewsOfPanes(panel.project)[static_cast<std::size_t>(number)];
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low{area.x, area.y}, high{area.x + area.width, area.y + area.height};
  list.AddRectFilled(low, high, panel.palette.photo, panel.px(4));
  if (place < 0) {
    static constexpr std::array<const char*, 3> kKeys = {"pane_front", "pane_right", "pane_top"};
    const char* text = panel.t(kKeys[static_cast<std::size_t>(number)]);
    const ImVec2 size = ImGui::CalcTextSize(text);
    list.AddText({area.x + (area.width - size.x) / 2, area.y + (area.height - size.y) / 2}, panel.palette.quiet, text);
    return std::nullopt;
  }
  const document::ProjectView& view = panel.project.views[static_cast<std::size_t>(place)];
  const ShownPhoto* photo = view.photo.empty() ? nullptr : panel.photos.find(document::photoPath(panel.session.openProject(), view));
  glm::dvec2 size = photo != nullptr && photo->size_px.x > 0 ? glm::dvec2(photo->size_px) : glm::dvec2(view.view.size_px);
  if (size.x <= 0) size = {900, 1200};
  Pane pane{panel, view, photo, area, {{area.x + area.width / 2, area.y + area.height / 2}, frameOf(panel, view.view.name, size, area)}, list};
  ImGui::PushID(number);
  Taken taken = mouse(pane);
  panel.state.landmarks["pane_" + view.view.name] = {area.x, area.y, area.width, area.height};
  panel.state.shownFrames[view.view.name] = {pane.lens.frame, {pane.lens.middle.x, pane.lens.middle.y}};
  list.PushClipRect(low, high, true);
  drawPhoto(pane);
  list.PushClipRect(pane.lens.onScreen({{0, 0}}), pane.lens.onScreen({size}), true);
  drawEpipolar(pane);
  list.PopClipRect();
  const auto chosen = panel.state.selection.node ? stemOf(panel.project, *panel.state.selection.node) : std::nullopt;
  for (const auto& stem : panel.project.stems) drawStem(pane, stem.stem, stem.stem.id == chosen);
  if (panel.state.selection.node) drawSelected(pane, *panel.state.selection.node);
  drawGhost(pane);
  drawOrigin(pane);
  drawTrouble(pane);
  const bool here = panel.state.hover && panel.state.hover->first == view.view.name;
  if (here && panel.state.loupe) drawLoupe(pane, panel.state.hover->second);
  drawLabel(pane, number + 1);
  list.PopClipRect();
  ImGui::PopID();
  return taken;
}

}  // namespace axil::ui
