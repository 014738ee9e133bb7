#pragma once
/// \file
/// What a click in a photo would do, before it is done: the status line says it, the click does it. There are no modes to enter; the
/// selected node decides.
///
/// - On a node: it is selected.
/// - With a selected node that has no click in this photo yet: it gets one, and the next node of its stem that lacks one here is selected.
/// - With a selected tip: its stem goes on with a new node. With a selected node in the middle: a branch begins at it.
/// - With nothing selected: the first stem of the plant begins; where there is one already, nothing happens.

#include "document/command.hpp"

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

enum class ClickKind { Nothing, Select, Place, Extend, Branch, Begin };

struct ClickMeaning {
  ClickKind kind = ClickKind::Nothing;
  document::Step step = {};              ///< empty for Nothing and Select
  Selection after = {};
  std::optional<document::NodeId> node = {};  ///< the node it is about
  std::optional<document::StemId> stem = {};  ///< the stem that grows
};

/// PickNodes: a node within `reach_px` is selected. OnlyPlace: nodes nearby are passed over, to place a click close to one.
enum class Picking { PickNodes, OnlyPlace };

struct PhotoClick {
  std::string view;
  PhotoPoint at;
  double reach_px = 8;  ///< px of the photo
  Picking picking = Picking::PickNodes;
};

/// `way`: the places along the stem from the selected node to the click, where they were traced; the click is the last of them. A stem
/// that goes on, or a branch that begins, gets a node at each. Any other click is as without a way.
[[nodiscard]] ClickMeaning meaningAlong(const document::Project& project, const Selection& selection, const PhotoClick& click, std::span<const PhotoPoint> way);
[[nodiscard]] ClickMeaning meaningOf(const document::Project& project, const Selection& selection, const PhotoClick& click);

/// The node with the nearest click in the view, within reach.
[[nodiscard]] std::optional<document::NodeId> nodeAt(const document::Project& project, const PhotoClick& click);

/// The stem to which a node's colour and its neighbours belong: the one it is on beyond its beginning, else the first that begins with it.
[[nodiscard]] std::optional<document::StemId> stemOf(const document::Project& project, document::NodeId node);

}  // namespace axil::ui
