#include "base/text.hpp"
#include "ui/epipolar.hpp"
#include "ui/photo_pane_interop.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::NodeId;
using document::StemId;

const skeleton3d::Node* solvedNode(const Panel& panel, NodeId id) {
  if (!panel.following.skeleton.good) return nullptr;
  for (const skeleton3d::Node& node : panel.following.skeleton.good->nodes)
    if (node.id == id) return &node;
  return nullptr;
}

// ---- drawing ---------------------------------------------------------------------------------------------------------------

/// The photo from `low` to `high`, as a lens shows it.
void drawPart(const Pane& pane, const Lens& lens, glm::dvec2 low, glm::dvec2 high) {
  if (pane.photo == nullptr || !pane.photo->tiles) return;
  for (const PhotoTiles::Piece& piece : pane.photo->tiles->pieces(low, high, lens.frame.zoom, pane.look()))
    pane.list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(piece.texture)), lens.onScreen({piece.low}), lens.onScreen({piece.high}),
                       {piece.from.x, piece.from.y}, {piece.to.x, piece.to.y});
}

/// The pane's own ground where its photo does not cover it: in software every pixel drawn twice costs twice.
void drawGround(const Pane& pane) {
  const bool isShown = pane.photo != nullptr && pane.photo->tiles;
  const ImVec2 low = pane.lens.onScreen({{0, 0}}), high = isShown ? pane.lens.onScreen({pane.photo->size_px}) : low;
  const float left = pane.area.x, top = pane.area.y, right = left + pane.area.width, bottom = top + pane.area.height;
  const Colour colour = pane.panel.palette.photo;
  const float upper = std::clamp(low.y, top, bottom), lower = std::clamp(high.y, upper, bottom);
  pane.list.AddRectFilled({left, top}, {right, upper}, colour);
  pane.list.AddRectFilled({left, lower}, {right, bottom}, colour);
  pane.list.AddRectFilled({left, upper}, {std::clamp(low.x, left, right), lower}, colour);
  pane.list.AddRectFilled({std::clamp(high.x, left, right), upper}, {right, lower}, colour);
}

void drawPhoto(const Pane& pane) {
  const glm::dvec2 low = pane.lens.onPhoto({pane.area.x, pane.area.y}).px, high = pane.lens.onPhoto({pane.area.x + pane.area.width, pane.area.y + pane.area.height}).px;
  drawPart(pane, pane.lens, low, high);
}

void drawSegment(const Pane& pane, const Seen& a, const Seen& b, Colour colour, float width) {
  const ImVec2 from = pane.lens.onScreen(a.at), to = pane.lens.onScreen(b.at);
  if (a.by == SeenBy::Skeleton || b.by == SeenBy::Skeleton) return dashed(pane.list, from, to, withAlpha(colour, 190), width, pane.panel.px(5));
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
    if (at->by == SeenBy::Skeleton) pane.list.AddCircle(s, r, withAlpha(colour, 200), 16, pane.panel.px(1.3f));
    else drawMark(pane.list, markOf(stem.id), s, r, colour);
    if (at->by == SeenBy::Program) pane.list.AddCircleFilled(s, r * 0.45f, rgb(0x101010, 220), 12);
  }
}

void drawSelected(const Pane& pane, NodeId id) {
  const auto at = seen(pane, id);
  if (!at) return;
  const ImVec2 s = pane.lens.onScreen(at->at);
  pane.list.AddCircle(s, pane.panel.px(9), rgb(0x000000, 150), 28, pane.panel.px(4));
  pane.list.AddCircle(s, pane.panel.px(9), rgb(0xFFFFFF), 28, pane.panel.px(2));
}

/// The others of the selection, and what is being gathered into it.
void drawGathered(const Pane& pane) {
  for (const NodeId id : pane.state().selection.others)
    if (const auto at = seen(pane, id)) {
      const ImVec2 s = pane.lens.onScreen(at->at);
      pane.list.AddCircle(s, pane.panel.px(7.5f), rgb(0x000000, 150), 24, pane.panel.px(3.2f));
      pane.list.AddCircle(s, pane.panel.px(7.5f), rgb(0xFFFFFF), 24, pane.panel.px(1.3f));
    }
  const auto& band = pane.state().band;
  if (!band || band->view != pane.name()) return;
  if (band->kind == Band::Kind::Box) {
    const ImVec2 a = pane.lens.onScreen(band->points.front()), b = pane.lens.onScreen(band->points.back());
    const ImVec2 low{std::min(a.x, b.x), std::min(a.y, b.y)}, high{std::max(a.x, b.x), std::max(a.y, b.y)};
    pane.list.AddRectFilled(low, high, withAlpha(pane.panel.palette.accent, 40));
    pane.list.AddRect(low, high, pane.panel.palette.accent, 0, 0, pane.panel.px(1.5f));
    return;
  }
  for (const PhotoPoint& p : band->points) pane.list.PathLineTo(pane.lens.onScreen(p));
  pane.list.PathStroke(pane.panel.palette.accent, ImDrawFlags_Closed, pane.panel.px(1.5f));
}

void drawLine(const Pane& pane, const std::vector<PhotoPoint>& line, Colour colour, float width) {
  for (const PhotoPoint& p : line) pane.list.PathLineTo(pane.lens.onScreen(p));
  pane.list.PathStroke(colour, 0, width);
}

/// Lines of the selected node's clicks in the other photos, and of the mouse in another photo.
void drawEpipolar(const Pane& pane) {
  const skeleton3d::Camera* here = cameraOf(pane.panel, pane.name());
  if (here == nullptr) return;
  const skeleton3d::Reach scene = pane.panel.placed()->scene();
  const auto lineFrom = [&](const std::string& view, PhotoPoint at) {
    const skeleton3d::Camera* there = cameraOf(pane.panel, view);
    return there == nullptr ? std::vector<PhotoPoint>{} : epipolarLine(*there, at, *here, scene.centre, scene.radius);
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
  const float half = pane.panel.px(66), margin = pane.panel.px(10);
  const double magnified = std::max(6.0 * pane.panel.state.scale, 2 * pane.lens.frame.zoom);
  const bool left = ImGui::GetIO().MousePos.x > pane.area.x + pane.area.width / 2;
  const ImVec2 c{left ? pane.area.x + margin + half : pane.area.x + pane.area.width - margin - half, pane.area.y + pane.area.height - margin - half};
  const ImVec2 low{c.x - half, c.y - half}, high{c.x + half, c.y + half};
  const Lens loupe{c, {.zoom = magnified, .centre = at.px}};
  pane.list.AddRectFilled(low, high, pane.panel.palette.photo);
  pane.list.PushClipRect(low, high, true);
  drawPart(pane, loupe, loupe.onPhoto(low).px, loupe.onPhoto(high).px);
  pane.list.PopClipRect();
  pane.list.AddRect(low, high, pane.panel.palette.accent, 0, 0, pane.panel.px(2));
  for (const auto& [colour, width] : {std::pair{rgb(0x000000, 140), 3.0f}, {rgb(0xFFFFFF), 1.2f}}) {
    pane.list.AddLine({c.x - pane.panel.px(14), c.y}, {c.x + pane.panel.px(14), c.y}, colour, width);
    pane.list.AddLine({c.x, c.y - pane.panel.px(14)}, {c.x, c.y + pane.panel.px(14)}, colour, width);
  }
}

void drawLabel(const Pane& pane, int number) {
  ImGui::PushFont(font(Face::Small));
  const float pad = pane.panel.px(7);
  const float width = chip(pane.list, {pane.area.x + pad, pane.area.y + pad}, std::to_string(number) + "  " + nameOfView(pane.panel, pane.name()), withAlpha(pane.panel.palette.panel, 225), pane.panel.palette.text, pad);
  const bool known = cameraOf(pane.panel, pane.name()) != nullptr;
  if (!known)
    chip(pane.list, {pane.area.x + 1.6f * pad + width, pane.area.y + pad}, pane.panel.t("camera_unknown"), withAlpha(pane.panel.palette.panel, 225), pane.panel.palette.warning, pad);
  ImGui::PopFont();
}

void drawTrouble(const Pane& pane) {
  std::string text = pane.panel.t("photo_reading");
  if (pane.view.photo.empty()) text = pane.panel.t("photo_none");
  else if (pane.photo != nullptr && pane.photo->trouble) text = pane.panel.texts.translated(pane.photo->trouble->message, pane.state().language);
  else if (pane.photo != nullptr) return;
  const float width = pane.area.width * 0.8f;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  pane.list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {pane.area.x + (pane.area.width - size.x) / 2, pane.area.y + (pane.area.height - size.y) / 2}, pane.panel.palette.quiet, text.c_str(),
                    nullptr, width);
}

/// The way that a click would take, and its nodes.
void drawWire(const Pane& pane, const skeleton3d::WirePath& wire, Colour colour) {
  for (const auto& [ink, width] : {std::pair{rgb(0x101010, 150), 4.2f}, {colour, 2.2f}}) {
    for (const skeleton3d::WireNode& place : wire.line) pane.list.PathLineTo(pane.lens.onScreen(place.at));
    pane.list.PathStroke(ink, 0, pane.panel.px(width));
  }
  for (std::size_t i = 1; i < wire.nodes.size(); ++i) {
    pane.list.AddCircleFilled(pane.lens.onScreen(wire.nodes[i].at), pane.panel.px(3.4f), rgb(0xFFFFFF), 16);
    pane.list.AddCircle(pane.lens.onScreen(wire.nodes[i].at), pane.panel.px(4.2f), colour, 16, pane.panel.px(1.8f));
  }
}

/// The stem of the selected node as this photo seems to show it.
void drawProposal(const Pane& pane, const ProposedStem& proposed) {
  const auto stem = stemOf(pane.panel.project, proposed.clicks.back().first);
  const Colour colour = stem ? colourOf(*stem) : rgb(0xFFFFFF);
  for (std::size_t i = 1; i < proposed.line.size(); i += 2)
    pane.list.AddLine(pane.lens.onScreen(proposed.line[i - 1]), pane.lens.onScreen(proposed.line[i]), colour, pane.panel.px(2.4f));
  for (const auto& [node, at] : proposed.clicks) {
    pane.list.AddCircleFilled(pane.lens.onScreen(at), pane.panel.px(3.2f), rgb(0xFFFFFF, 200), 16);
    pane.list.AddCircle(pane.lens.onScreen(at), pane.panel.px(4.4f), colour, 16, pane.panel.px(1.6f));
  }
}

/// Which point of another photo is looked for in this one: of the selected node, or under the mouse.
struct Sought {
  std::string first;
  PhotoPoint at;
  std::optional<NodeId> before;
};
std::optional<Sought> soughtHere(const Pane& pane) {
  const UiState& state = pane.state();
  const auto selected = state.selection.node ? document::nodeWithId(pane.panel.project, *state.selection.node) : std::nullopt;
  if (selected) {
    const auto& node = pane.panel.project.nodes[*selected].node;
    if (!node.clicks.contains(pane.name()) && !node.clicks.empty()) return Sought{node.clicks.begin()->first, node.clicks.begin()->second, {}};
  }
  if (!state.hover || state.hover->first == pane.name() || !state.selection.node) return std::nullopt;
  return Sought{state.hover->first, state.ridge ? state.ridge->at : state.hover->second, state.selection.node};
}

/// The likeliest places, the best with a number; worked out anew when the point has moved.
void drawCandidates(const Pane& pane) {
  constexpr std::size_t kShown = 3;
  UiState& state = pane.state();
  if (!state.trace || state.way != Way::Stems || pane.photo == nullptr || !pane.photo->tiles) return;
  const auto sought = soughtHere(pane);
  const auto placed = pane.panel.placed();
  const skeleton3d::LiveWire* photo = pane.panel.wires.ready(pane.photo->tiles->sharedPhoto());
  if (!sought || !placed || photo == nullptr) return;
  const bool isKnown = state.candidates && state.candidates->first == sought->first && state.candidates->at == sought->at && state.candidates->before == sought->before;
  if (!isKnown) state.candidates = Candidates{sought->first, sought->at, sought->before, {}};
  const auto [places, isNew] = state.candidates->places.try_emplace(pane.name());
  if (isNew) places->second = placesFor(*placed, sought->first, sought->at, pane.name(), *photo, sought->before);
  ImGui::PushFont(font(Face::Small));
  for (std::size_t i = 0; i < std::min(kShown, places->second.size()); ++i) {
    const auto& [candidate, rank] = places->second[i];
    const ImVec2 at = pane.lens.onScreen(candidate.at);
    const std::uint32_t alpha = static_cast<std::uint32_t>(std::clamp(90 + 165 * rank.probability, 90.0, 255.0));
    pane.list.AddCircle(at, pane.panel.px(6.5f), rgb(0x000000, alpha / 2), 20, pane.panel.px(3.4f));
    pane.list.AddCircle(at, pane.panel.px(6.5f), rgb(0xFFFFFF, alpha), 20, pane.panel.px(1.6f));
    const std::string number = std::to_string(i + 1);
    pane.list.AddText({at.x + pane.panel.px(9), at.y - pane.panel.px(15)}, rgb(0x000000, alpha), number.c_str());
    pane.list.AddText({at.x + pane.panel.px(8), at.y - pane.panel.px(16)}, rgb(0xFFFFFF, alpha), number.c_str());
  }
  ImGui::PopFont();
}

/// What a click would add, before it is clicked.
void drawGhost(const Pane& pane) {
  const auto& hover = pane.state().hover;
  if (!hover || hover->first != pane.name() || pane.state().way != Way::Stems || pane.state().drag || !pane.state().meaning) return;
  const ClickMeaning& meaning = *pane.state().meaning;
  const Colour colour = meaning.stem ? colourOf(*meaning.stem) : meaning.kind == ClickKind::Branch ? colourOf(document::nextStemId(pane.panel.project)) : rgb(0xFFFFFF);
  const auto& ridge = pane.state().ridge;
  const ImVec2 mouse = pane.lens.onScreen(ridge ? ridge->at : hover->second);
  if (ridge) {
    const glm::dvec2 across = glm::dvec2(-std::sin(ridge->along.radians()), std::cos(ridge->along.radians())) * (ridge->width_px / 2);
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec2 edge = ridge->at.px + side * across, half = glm::dvec2(across.y, -across.x) * 0.8;
      pane.list.AddLine(pane.lens.onScreen({edge - half}), pane.lens.onScreen({edge + half}), rgb(0xFFFFFF, 200), pane.panel.px(1.2f));
    }
  }
  if (pane.state().wire) return drawWire(pane, *pane.state().wire, colour);
  if (meaning.kind == ClickKind::Extend || meaning.kind == ClickKind::Branch)
    if (const auto from = seen(pane, *meaning.node)) dashed(pane.list, pane.lens.onScreen(from->at), mouse, colour, pane.panel.px(2), pane.panel.px(6));
  if (meaning.kind != ClickKind::Nothing && meaning.kind != ClickKind::Select) pane.list.AddCircle(mouse, pane.panel.px(4), colour, 16, pane.panel.px(1.6f));
}

void doubtLabel(const Pane& pane, ImVec2 at, const std::string& text) {
  ImGui::PushFont(font(Face::Small));
  chip(pane.list, {at.x + pane.panel.px(9), at.y + pane.panel.px(5)}, text, withAlpha(pane.panel.palette.panel, 215), pane.panel.palette.warning, pane.panel.px(4));
  ImGui::PopFont();
}

/// What does not fit together, where it is: how far a click is from where the others put its node, and leaps along a stem.
void drawDoubts(const Pane& pane) {
  const Following& following = pane.panel.following;
  const Colour ink = pane.panel.palette.warning;
  const auto mark = [&](NodeId node, double off_px) {
    const PhotoPoint* clicked = document::clickOf(pane.panel.project, node, pane.name());
    if (clicked == nullptr) return;
    const ImVec2 click = pane.lens.onScreen(*clicked);
    const skeleton3d::Node* solved = solvedNode(pane.panel, node);
    const skeleton3d::Camera* camera = cameraOf(pane.panel, pane.name());
    if (solved != nullptr && camera != nullptr && skeleton3d::isInFront(*camera, solved->position))
      pane.list.AddLine(click, pane.lens.onScreen(skeleton3d::project(*camera, solved->position)), ink, pane.panel.px(2));
    pane.list.AddCircle(click, pane.panel.px(11), ink, 24, pane.panel.px(2));
    doubtLabel(pane, click, fixed(off_px, 0) + " px");
  };
  for (const skeleton3d::DoubtfulClick& click : following.doubts.clicks)
    if (click.view == pane.name()) mark(click.node, click.off_px);
  if (following.measured.good)
    for (const skeleton3d::SuspectClick& suspect : following.measured.good->suspects)
      if (suspect.view == pane.name()) mark(suspect.node, suspect.off_px);
  for (const skeleton3d::DoubtfulSegment& segment : following.doubts.segments) {
    const auto from = seen(pane, segment.from), to = seen(pane, segment.to);
    if (!from || !to) continue;
    const ImVec2 a = pane.lens.onScreen(from->at), b = pane.lens.onScreen(to->at);
    dashed(pane.list, a, b, ink, pane.panel.px(3), pane.panel.px(9));
    doubtLabel(pane, {(a.x + b.x) / 2, (a.y + b.y) / 2}, filled(pane.panel.t("leap"), {{"times", fixed(segment.times, 0)}}));
  }
}

/// A photo that has not been moved fills its pane.
PhotoFrame frameOf(const Panel& panel, const std::string& view, glm::dvec2 photo, Area area) {
  PhotoFrame frame = panel.state.frames[view];
  if (frame.zoom > 0) return frame;
  return {.zoom = 0.96 * std::min(area.width / photo.x, area.height / photo.y), .centre = photo / 2.0};
}

}  // namespace

const skeleton3d::Camera* cameraOf(const Panel& panel, const std::string& view) {
  if (!panel.following.measured.good) return nullptr;
  for (const skeleton3d::View& known : panel.following.measured.good->views)
    if (known.name == view && known.camera.model != skeleton3d::CameraModel::Unknown) return &known.camera;
  return nullptr;
}

PhotoLook Pane::look() const {
  const auto known = panel.state.looks.find(name());
  return known == panel.state.looks.end() ? PhotoLook{} : known->second;
}

std::optional<Seen> seen(const Pane& pane, NodeId id) {
  const auto place = document::nodeWithId(pane.panel.project, id);
  if (!place) return std::nullopt;
  const skeleton3d::ClickedNode& node = pane.panel.project.nodes[*place].node;
  const SeenBy by = node.placed.contains(pane.name()) ? SeenBy::Program : SeenBy::Click;
  if (const auto click = node.clicks.find(pane.name()); click != node.clicks.end()) {
    const auto& drag = pane.state().drag;
    const bool moves = drag && drag->moved && drag->view == pane.name() && (drag->node == id || pane.state().selection.has(id));
    if (moves) return Seen{{click->second.px + drag->moved_px()}, by};
    const auto& inSpace = pane.state().plantDrag;
    const skeleton3d::Camera* camera = inSpace && inSpace->moved && inSpace->node == id ? cameraOf(pane.panel, pane.name()) : nullptr;
    return Seen{{click->second.px + (camera != nullptr ? inSpace->moved_px(*camera) : glm::dvec2(0, 0))}, by};
  }
  const skeleton3d::Camera* camera = cameraOf(pane.panel, pane.name());
  const skeleton3d::Node* solved = solvedNode(pane.panel, id);
  if (camera == nullptr || solved == nullptr || !skeleton3d::isInFront(*camera, solved->position)) return std::nullopt;
  return Seen{skeleton3d::project(*camera, solved->position), SeenBy::Skeleton};
}

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
  if (place < 0) {
    list.AddRectFilled(low, high, panel.palette.photo);
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
  Taken taken = photoHand(pane);
  panel.state.landmarks["pane_" + view.view.name] = {area.x, area.y, area.width, area.height};
  panel.state.shownFrames[view.view.name] = {pane.lens.frame, {pane.lens.middle.x, pane.lens.middle.y}};
  list.PushClipRect(low, high, true);
  drawGround(pane);
  drawPhoto(pane);
  list.PushClipRect(pane.lens.onScreen({{0, 0}}), pane.lens.onScreen({size}), true);
  drawEpipolar(pane);
  list.PopClipRect();
  const auto chosen = panel.state.selection.node ? stemOf(panel.project, *panel.state.selection.node) : std::nullopt;
  for (const auto& stem : panel.project.stems) drawStem(pane, stem.stem, stem.stem.id == chosen);
  drawGathered(pane);
  if (panel.state.way == Way::Stems) drawDoubts(pane);
  if (panel.state.selection.node) drawSelected(pane, *panel.state.selection.node);
  if (const ProposedStem* proposed = panel.proposals.in(view.view.name)) drawProposal(pane, *proposed);
  else drawCandidates(pane);
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
