#pragma once
/// \file
/// Private to ui: one photo pane while it is drawn, shared by what draws it and what the hand does in it.

#include "document/lookup.hpp"
#include "ui/widgets_interop.hpp"

namespace axil::ui {

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
  [[nodiscard]] PhotoLook look() const;
};

/// Null while the view's camera is not known.
[[nodiscard]] const skeleton3d::Camera* cameraOf(const Panel& panel, const std::string& view);

/// Where a node is in this photo: as it is being dragged, as it was clicked, or as the skeleton says.
enum class SeenBy { Click, Program, Skeleton };  ///< a person's click, one that the program placed, where the skeleton has the node
struct Seen {
  PhotoPoint at;
  SeenBy by = SeenBy::Click;
};
[[nodiscard]] std::optional<Seen> seen(const Pane& pane, document::NodeId id);

// ---- the hand ----------------------------------------------------------------------------------------------------------
/// The mouse in this pane: zooms, pans, says what a click would do, and gives the step that was taken.
[[nodiscard]] Taken photoHand(Pane& pane);

}  // namespace axil::ui
