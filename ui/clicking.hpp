#pragma once
/// \file
/// What a click in a photo would do, before it is done: the status line says it, the click does it. There are no modes to enter; the
/// selected node decides.
///
/// - On a node: it is selected.
/// - With a selected node that has no click in this photo yet: it gets one, and the next node of its stem that lacks one here is selected.
/// - On a stem's line between two of its nodes: the stem gets a node there, which is selected, so that a branch can begin at it. Not
///   where the selected node waits for a branch, or is a tip that is clicked in one photo alone: what goes on there may stand before any stem.
/// - With a selected node whose next one up the stem has no click in this photo: that one gets it.
/// - With a selected tip: its stem goes on with a new node. With a selected node in the middle: a branch begins at it.
/// - With nothing selected: the first stem of the plant begins; where there is one already, nothing happens.
///
/// What comes first here wins.

#include "document/command.hpp"
#include "skeleton3d/live_wire.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::ui {

/// The selected node, which says what a click does, and others that are deleted and moved with it.
struct Selection {
  std::optional<document::NodeId> node = {};
  std::vector<document::NodeId> others = {};

  [[nodiscard]] bool has(document::NodeId id) const;
  [[nodiscard]] std::vector<document::NodeId> all() const;  ///< the selected node first
  void add(document::NodeId id);
  void remove(document::NodeId id);
  friend bool operator==(const Selection&, const Selection&) = default;
};

enum class ClickKind { Nothing, Select, Place, Insert, Extend, Branch, Begin };

struct ClickMeaning {
  ClickKind kind = ClickKind::Nothing;
  document::Step step = {};              ///< empty for Nothing and Select
  Selection after = {};
  std::optional<document::NodeId> node = {};  ///< the node it is about
  std::optional<document::StemId> stem = {};  ///< the stem that grows
};

/// PickNodes: a node within `reach_px` is selected, a stem within half of that or of its width gets a node. OnlyPlace: nodes and stems nearby are passed over, to
/// place a click close to one, but not on the selected one.
enum class Picking { PickNodes, OnlyPlace };

struct PhotoClick {
  std::string view;
  PhotoPoint at;
  double reach_px = 8;  ///< px of the photo
  double stem_px = 0;   ///< width of the stem that is seen there; 0: none is
  double photo_px = 0;  ///< the photo's longer side
  Picking picking = Picking::PickNodes;
};

/// A place on a stem between two of its nodes, as clicked in a view.
struct PlaceOnStem {
  document::StemId stem;
  document::NodeId below, above;  ///< the nodes that it is between
  double distance_px = 0;
};
/// The stem segment nearest to a click, within its reach; both ends must be clicked in the view.
[[nodiscard]] std::optional<PlaceOnStem> placeOnStem(const document::Project& project, const PhotoClick& click);
/// A new node there, clicked in this view.
[[nodiscard]] document::Step insertAt(const document::Project& project, const PlaceOnStem& place, const PhotoClick& click);

/// `way`: the places along the stem from the selected node to the click, where they were traced; the click is the last of them. A stem
/// that goes on, or a branch that begins, gets a node at each. Any other click is as without a way.
[[nodiscard]] ClickMeaning meaningAlong(const document::Project& project, const Selection& selection, const PhotoClick& click, std::span<const PhotoPoint> way);
[[nodiscard]] ClickMeaning meaningOf(const document::Project& project, const Selection& selection, const PhotoClick& click);

[[nodiscard]] double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b);

/// The node with the nearest click in the view, within reach.
[[nodiscard]] std::optional<document::NodeId> nodeAt(const document::Project& project, const PhotoClick& click);

/// How far a followed stem may bow away from the straight line between two of its nodes: few nodes count more than the last pixel, but a
/// long stem is no straight one.
[[nodiscard]] double bowOf(double length_px, double photo_px);

/// The stem whose line a click is on: nearer than half the reach of a node, or, where a stem is seen, than half its width and the bow that
/// it may have there.
[[nodiscard]] std::optional<PlaceOnStem> lineAt(const document::Project& project, PhotoClick click);

/// The stem to which a node's colour and its neighbours belong: the one it is on beyond its beginning, else the first that begins with it.
/// The segments of all stems whose ends are clicked in the view.
[[nodiscard]] std::vector<skeleton3d::TakenSegment> segmentsIn(const document::Project& project, const std::string& view);
[[nodiscard]] std::optional<document::StemId> stemOf(const document::Project& project, document::NodeId node);

}  // namespace axil::ui
