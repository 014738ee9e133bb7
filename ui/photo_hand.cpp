#include "ui/elsewhere.hpp"
#include "ui/leaf_steps.hpp"
#include "ui/photo_pane_interop.hpp"
#include "ui/stem_steps.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using document::NodeId;
using document::StemId;
using document::Step;

// ---- zoom, and what a click would do ---------------------------------------------------------------------------------------

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

/// With the stem that is seen there.
PhotoClick clickOn(const Pane& pane, PhotoPoint at, const std::optional<skeleton3d::RidgeReading>& stem) {
  PhotoClick click = clickAt(pane, at);
  if (stem) click.stem_px = stem->width_px;
  if (pane.photo != nullptr) click.photo_px = std::max(pane.photo->size_px.x, pane.photo->size_px.y);
  return click;
}

PhotoClick onlyPlaced(const Pane& pane, PhotoPoint at) {
  PhotoClick click = clickAt(pane, at);
  click.picking = Picking::OnlyPlace;
  return click;
}

std::string numberOf(std::optional<NodeId> id) { return id ? std::to_string(id->value) : ""; }
std::string numberOf(std::optional<StemId> id) { return id ? std::to_string(id->value) : ""; }

void sayWhat(const Pane& pane, const ClickMeaning& meaning) {
  static constexpr std::array<const char*, 7> kKeys = {"click_nothing", "click_select", "click_place", "click_insert", "click_extend", "click_branch", "click_begin"};
  const char* key = kKeys[static_cast<std::size_t>(meaning.kind)];
  if (meaning.kind == ClickKind::Nothing && pane.state().way == Way::Stems && !pane.panel.project.stems.empty()) key = "click_nothing_stems";
  pane.state().status = filled(pane.panel.t(key), {{"node", numberOf(meaning.node)}, {"stem", numberOf(meaning.stem)}, {"view", pane.name()}});
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

/// The centre line of the stem near `at`. Nothing where snapping is off or no stem is there.
std::optional<skeleton3d::RidgeReading> ridgeNear(const Pane& pane, PhotoPoint at) {
  constexpr double kReach_px = 10, kMost_px = 40;  // of the screen; of the photo, so that a snap keeps up with the mouse
  if (!pane.state().snap || pane.photo == nullptr || !pane.photo->tiles) return std::nullopt;
  return skeleton3d::snapClick(pane.photo->tiles->photo(), at, {.reach_px = std::clamp(kReach_px / pane.lens.frame.zoom, 2.0, kMost_px)});
}

/// The same, where a click may have to do with a stem.
std::optional<skeleton3d::RidgeReading> stemUnder(const Pane& pane, PhotoPoint at) {
  return pane.state().way == Way::Stems ? ridgeNear(pane, at) : std::nullopt;
}

/// Whether the camera of another photo is known, so that a traced stem can be found there too.
bool seesFromElsewhere(const Pane& pane) {
  const auto& views = pane.panel.project.views;
  return std::any_of(views.begin(), views.end(), [&](const document::ProjectView& view) { return view.view.name != pane.name() && cameraOf(pane.panel, view.view.name) != nullptr; });
}

/// The way along the stem from the node that would go on to `at`; nothing where tracing is off, no stem leads there, or its nodes would
/// have to be clicked one by one in the other photos.
std::optional<skeleton3d::WirePath> wireTo(const Pane& pane, const ClickMeaning& meaning, PhotoPoint at) {
  const bool grows = meaning.kind == ClickKind::Extend || meaning.kind == ClickKind::Branch;
  if (!grows || !pane.state().trace || !seesFromElsewhere(pane) || !meaning.node || pane.photo == nullptr || !pane.photo->tiles) return std::nullopt;
  const PhotoPoint* from = document::clickOf(pane.panel.project, *meaning.node, pane.name());
  return from == nullptr ? std::nullopt : pane.panel.wires.way(pane.photo->tiles->sharedPhoto(), *from, at);
}

/// The places of the new nodes: the way begins at one that is there.
std::vector<PhotoPoint> placesOf(const skeleton3d::WirePath& wire) {
  std::vector<PhotoPoint> places;
  for (std::size_t i = 1; i < wire.nodes.size(); ++i) places.push_back(wire.nodes[i].at);
  return places;
}

/// With a tip that is clicked here, the nodes before it that are not get their places on the way to it: as proposed, or with its end here.
std::optional<ProposedStem> wholeStem(const Pane& pane, const ClickMeaning& meaning, PhotoPoint at) {
  const auto placed = pane.panel.placed();
  if (meaning.kind != ClickKind::Place || !pane.state().trace || !placed || !meaning.node || pane.photo == nullptr || !pane.photo->tiles) return std::nullopt;
  const ProposedStem* known = pane.panel.proposals.in(pane.name());
  if (known != nullptr && glm::distance(known->clicks.back().second.px, at.px) < pane.reach()) return *known;
  const skeleton3d::LiveWire* photo = pane.panel.wires.ready(pane.photo->tiles->sharedPhoto());
  auto question = photo == nullptr ? std::nullopt : stemQuestion(pane.panel.project, *placed, *meaning.node, pane.name(), *photo);
  if (!question) return std::nullopt;
  question->options.endInOther = at;
  const auto stem = proposedStem(*question);
  return stem && (stem->clicks.size() > 1 || !stem->bends.empty()) ? stem : std::nullopt;
}

/// A node put into a stem has its place in the other photos too, on the centre line where there is one.
void addElsewhere(const Pane& pane, const PlaceOnStem& place, NodeId node, PhotoPoint at, Step& step) {
  const auto placed = pane.panel.placed();
  if (!placed) return;
  for (const document::ProjectView& view : pane.panel.project.views)
    if (const auto there = placeElsewhere(pane.panel.project, *placed, place, pane.name(), at, view.view.name))
      step.emplace_back(document::PlaceClick{node, view.view.name, centred(pane.panel.photos.photoOf(pane.panel.session.openProject(), view).get(), *there),
                                             placed->within_px(pane.name(), view.view.name)});
}

/// A node on a stem's line, on its centre line where there is one.
Step insertHere(const Pane& pane, const PlaceOnStem& place, PhotoClick click, const std::optional<skeleton3d::RidgeReading>& ridge) {
  if (ridge) click.at = ridge->at;
  Step step = insertAt(pane.panel.project, place, click);
  addElsewhere(pane, place, document::nextNodeId(pane.panel.project), click.at, step);
  return step;
}

/// Outside the Stems part of the way a click only selects.
ClickMeaning meaningHere(const Pane& pane, PhotoPoint at, const std::optional<skeleton3d::RidgeReading>& stem) {
  const ClickMeaning meaning = meaningOf(pane.panel.project, pane.state().selection, clickOn(pane, at, stem));
  return meaning.kind == ClickKind::Select || pane.state().way == Way::Stems ? meaning : ClickMeaning{};
}

/// Whether a click of this meaning puts a node somewhere.
bool places(const ClickMeaning& meaning) { return meaning.kind != ClickKind::Nothing && meaning.kind != ClickKind::Select; }

bool insidePhoto(const Pane& pane, PhotoPoint p) {
  return pane.photo != nullptr && p.px.x >= 0 && p.px.y >= 0 && p.px.x <= pane.photo->size_px.x && p.px.y <= pane.photo->size_px.y;
}

void sayPick(const Pane& pane) {
  const Pick& pick = *pane.state().pick;
  pane.state().status = filled(pane.panel.t(pick.kind == Pick::Kind::Join ? "click_join" : "click_attach"), {{"stem", numberOf(pick.stem)}});
}

// ---- dragging nodes, gathering nodes ---------------------------------------------------------------------------------------

bool editsStems(const UiState& state) { return state.way == Way::Stems; }
bool gathersNodes(const UiState& state) { return state.way == Way::Stems || state.way == Way::Leaves; }

/// A press on a node may become a drag, a press beside nodes a box or a lasso.
void pressed(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  if (state.pick || state.tool != PhotoTool::None || ImGui::GetIO().KeyShift || !insidePhoto(pane, at)) return;
  const auto node = nodeAt(pane.panel.project, clickAt(pane, at));
  if (node && editsStems(state) && !ImGui::GetIO().KeyCtrl) {
    const auto place = document::nodeWithId(pane.panel.project, *node);
    state.drag = NodeDrag{.node = *node, .view = pane.name(), .from = pane.panel.project.nodes[*place].node.clicks.at(pane.name()), .grabbed = at, .at = at};
  } else if (!node && gathersNodes(state)) {
    state.band = Band{pane.name(), ImGui::GetIO().KeyAlt ? Band::Kind::Lasso : Band::Kind::Box, {at}};
  }
}

void moved(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  if (!ImGui::IsMouseDragging(0, pane.panel.px(3))) return;
  if (state.drag && state.drag->view == pane.name()) {
    state.drag->moved = true;
    state.drag->at = at;
    if (!state.selection.has(state.drag->node)) state.selection = {.node = state.drag->node, .others = {}};
    state.status = filled(pane.panel.t("drag_node"), {{"node", numberOf(std::optional(state.drag->node))}});
  }
  if (state.band && state.band->view == pane.name()) {
    auto& points = state.band->points;
    if (state.band->kind == Band::Kind::Box) points = {points.front(), at};
    else if (glm::distance(points.back().px, at.px) * pane.lens.frame.zoom > 4) points.push_back(at);
    state.status = pane.panel.t("drag_band");
  }
}

bool isInside(const Band& band, PhotoPoint p) {
  if (band.kind == Band::Kind::Box) {
    const glm::dvec2 low = glm::min(band.points.front().px, band.points.back().px), high = glm::max(band.points.front().px, band.points.back().px);
    return p.px.x >= low.x && p.px.x <= high.x && p.px.y >= low.y && p.px.y <= high.y;
  }
  bool inside = false;
  for (std::size_t i = 0, j = band.points.size() - 1; i < band.points.size(); j = i++) {
    const glm::dvec2 a = band.points[i].px, b = band.points[j].px;
    if ((a.y > p.px.y) != (b.y > p.px.y) && p.px.x < (b.x - a.x) * (p.px.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

Selection gathered(const Pane& pane, const Band& band) {
  Selection selection = ImGui::GetIO().KeyCtrl ? pane.state().selection : Selection{};
  for (const auto& entry : pane.panel.project.nodes)
    if (const auto at = seen(pane, entry.node.id); at && isInside(band, at->at)) selection.add(entry.node.id);
  return selection;
}

/// All selected nodes go along.
Step dropped(const Pane& pane, const NodeDrag& drag) {
  Step step;
  for (const NodeId id : pane.state().selection.all()) {
    const auto place = document::nodeWithId(pane.panel.project, id);
    const auto& clicks = pane.panel.project.nodes[*place].node.clicks;
    if (const auto click = clicks.find(drag.view); click != clicks.end()) step.emplace_back(document::MoveClick{id, drag.view, {click->second.px + drag.moved_px()}});
  }
  return step;
}

// ---- clicks ----------------------------------------------------------------------------------------------------------------

Taken usePick(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  const auto node = nodeAt(pane.panel.project, clickAt(pane, at));
  if (!node) return std::nullopt;
  const Pick pick = *std::exchange(state.pick, std::nullopt);
  const auto step = pick.kind == Pick::Kind::Join ? joinOnto(pane.panel.project, pick.stem, *node) : attachTo(pane.panel.project, pick.stem, *node);
  if (!step) state.notice = Notice{NoticeKind::Warned, pane.panel.t(pick.kind == Pick::Kind::Join ? "cannot_join" : "cannot_attach")};
  return step;
}

Taken clicked(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  if (state.pick) return usePick(pane, at);
  if (state.way == Way::Photos && state.tool != PhotoTool::None) return useTool(pane, at);
  if (ImGui::GetIO().KeyCtrl) {
    if (const auto node = nodeAt(pane.panel.project, clickAt(pane, at))) state.selection.has(*node) ? state.selection.remove(*node) : state.selection.add(*node);
    return std::nullopt;
  }
  const auto ridge = stemUnder(pane, at);
  ClickMeaning meaning = meaningHere(pane, at, ridge);
  if (meaning.kind == ClickKind::Nothing) return std::nullopt;
  const PhotoPoint centre = ridge ? ridge->at : at;
  if (meaning.kind == ClickKind::Insert) {
    const PhotoClick click = clickOn(pane, at, ridge);
    state.selection = meaning.after;
    return insertHere(pane, *lineAt(pane.panel.project, click), click, ridge);
  }
  if (const auto wire = wireTo(pane, meaning, at)) {
    meaning = meaningAlong(pane.panel.project, state.selection, onlyPlaced(pane, wire->nodes.back().at), placesOf(*wire));
  } else if (places(meaning)) {
    if (const auto whole = wholeStem(pane, meaning, centre)) return Taken{stepOf(pane.panel.project, {&*whole, 1})};
    if (ridge) {
      ClickMeaning snapped = meaningOf(pane.panel.project, state.selection, onlyPlaced(pane, centre));
      if (places(snapped)) meaning = std::move(snapped);  // not onto the node that it goes on from
    }
  }
  state.selection = meaning.after;
  return meaning.step.empty() ? Taken{} : Taken{meaning.step};
}

Taken released(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  const auto drag = std::exchange(state.drag, std::nullopt);
  const auto band = std::exchange(state.band, std::nullopt);
  if (drag && drag->moved) return dropped(pane, *drag);
  if (band && band->points.size() > 1) {
    state.selection = gathered(pane, *band);
    return std::nullopt;
  }
  const ImVec2 moved = ImGui::GetMouseDragDelta(0, 0);
  if (std::hypot(moved.x, moved.y) > pane.panel.px(4) || !insidePhoto(pane, at)) return std::nullopt;
  return clicked(pane, at);
}

// ---- the menu of a place ---------------------------------------------------------------------------------------------------

Taken openMenu(const Pane& pane, PhotoPoint at) {
  UiState& state = pane.state();
  const PhotoClick click = clickAt(pane, at);
  const auto node = nodeAt(pane.panel.project, click);
  const auto place = placeOnStem(pane.panel.project, click);
  const auto stem = node ? stemOf(pane.panel.project, *node) : place ? std::optional(place->stem) : std::nullopt;
  if (!stem) return std::nullopt;
  const auto found = document::stemWithId(pane.panel.project, *stem);
  if (node) state.selection = {.node = node, .others = {}};
  else if (found) state.selection = {.node = pane.panel.project.stems[*found].stem.nodes.back(), .others = {}};
  if (state.way == Way::Leaves) return firstLeaves(pane.panel.project, pane.panel.following.said, *stem);
  if (!editsStems(state)) return std::nullopt;
  state.menu = PlaceMenu{pane.name(), at, click.reach_px, node, stem};
  ImGui::OpenPopup("##place");
  return std::nullopt;
}

bool menuRow(const Pane& pane, const char* key, bool possible = true) {
  const bool chosen = ImGui::MenuItem(pane.panel.t(key), nullptr, false, possible);
  landmark(pane.panel, std::string("menu_") + key);
  return chosen && possible;
}

Taken menuOfNode(const Pane& pane, NodeId node, StemId stem) {
  const auto& project = pane.panel.project;
  Taken taken;
  const auto split = splitAt(project, node), reversed = reverseAt(project, node);
  if (menuRow(pane, "key_split", split.has_value())) taken = split;
  if (menuRow(pane, "key_join")) pane.state().pick = Pick{Pick::Kind::Join, stem};
  if (menuRow(pane, "key_attach")) pane.state().pick = Pick{Pick::Kind::Attach, stem};
  if (menuRow(pane, "key_reverse", reversed.has_value())) taken = reversed;
  ImGui::Separator();
  if (menuRow(pane, "not_seen_here")) taken = Step{document::RemoveClick{node, pane.name()}};
  if (menuRow(pane, "delete_node")) taken = Step{document::RemoveNodes{{node}}};
  return taken;
}

Taken placeMenu(const Pane& pane) {
  UiState& state = pane.state();
  if (!state.menu || state.menu->view != pane.name()) return std::nullopt;
  if (!ImGui::BeginPopup("##place")) {
    state.menu.reset();
    return std::nullopt;
  }
  Taken taken;
  const PlaceMenu menu = *state.menu;
  ImGui::TextDisabled("%s", filled(pane.panel.t("stem_n"), {{"stem", numberOf(menu.stem)}}).c_str());
  if (menuRow(pane, "menu_leaves")) {
    state.way = Way::Leaves;
    taken = firstLeaves(pane.panel.project, pane.panel.following.said, *menu.stem);
  }
  ImGui::Separator();
  if (menu.node) {
    if (Taken one = menuOfNode(pane, *menu.node, *menu.stem)) taken = std::move(one);
  } else {
    const PhotoClick click{.view = menu.view, .at = menu.at, .reach_px = menu.reach_px};
    const auto place = placeOnStem(pane.panel.project, click);
    if (menuRow(pane, "insert_node", place.has_value())) taken = insertHere(pane, *place, click, stemUnder(pane, menu.at));
  }
  if (menuRow(pane, "delete_stem_whole")) taken = Step{document::RemoveStem{*menu.stem}};
  ImGui::EndPopup();
  return taken;
}

}  // namespace

Taken photoHand(Pane& pane) {
  UiState& state = pane.state();
  if (Taken taken = placeMenu(pane)) return taken;
  ImGui::SetCursorScreenPos({pane.area.x, pane.area.y});
  ImGui::InvisibleButton("photo", {pane.area.width, pane.area.height}, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const bool spaceHeld = ImGui::IsKeyDown(32);
  zoomAndPan(pane, hovered, active && (ImGui::IsMouseDown(2) || ImGui::IsMouseDown(1) || (spaceHeld && ImGui::IsMouseDown(0))));
  const PhotoPoint at = pane.lens.onPhoto(ImGui::GetIO().MousePos);
  if (spaceHeld) return std::nullopt;
  if (ImGui::IsItemActivated() && ImGui::IsMouseDown(0)) pressed(pane, at);
  if (active) moved(pane, at);
  const bool isReleased = ImGui::IsItemDeactivated();
  if (isReleased && ImGui::IsMouseReleased(0) && (hovered || state.drag || state.band)) return released(pane, at);
  if (isReleased) state.drag.reset(), state.band.reset();
  const ImVec2 rightMoved = ImGui::GetMouseDragDelta(1, 0);
  if (isReleased && ImGui::IsMouseReleased(1) && hovered && std::hypot(rightMoved.x, rightMoved.y) < pane.panel.px(4)) return openMenu(pane, at);
  if (!hovered || !insidePhoto(pane, at)) return std::nullopt;
  state.hover = {pane.name(), at};
  if ((state.drag && state.drag->moved) || (state.band && state.band->points.size() > 1)) return std::nullopt;
  if (state.pick) sayPick(pane);
  else if (state.way == Way::Photos && state.tool != PhotoTool::None) sayTool(pane);
  else {
    const auto ridge = stemUnder(pane, at);
    const ClickMeaning meaning = meaningHere(pane, at, ridge);
    sayWhat(pane, meaning);
    state.wire = wireTo(pane, meaning, at);
    if (places(meaning) && !state.wire) state.ridge = ridge;
    state.meaning = meaning;
    if (state.wire) state.status += "  " + filled(pane.panel.t("follows"), {{"n", std::to_string(state.wire->nodes.size() - 1)}});
    if (meaning.kind == ClickKind::Place && pane.panel.proposals.in(pane.name()) != nullptr) state.status += "  " + std::string(pane.panel.t("proposal_take"));
    if (state.ridge) state.status += "  " + filled(pane.panel.t("snaps"), {{"percent", std::to_string(std::lround(100 * state.ridge->confidence))}});
  }
  return std::nullopt;
}

}  // namespace axil::ui
