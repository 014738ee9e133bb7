#pragma once
/// \file
/// Live-wire in the window: the way along a stem from the selected node to the mouse. Photos are made ready and ways are begun in the
/// background; the way to the mouse itself takes a few milliseconds and is asked for in each frame.

#include "document/project.hpp"
#include "skeleton3d/live_wire.hpp"
#include "ui/photos.hpp"
#include "ui/state.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axil::ui {

struct WireQuestion {
  std::shared_ptr<const skeleton3d::Photo> photo;
  std::optional<PhotoPoint> from;  ///< nothing: the photo is only made ready
  std::vector<skeleton3d::TakenSegment> taken;  ///< of the stems that are clicked there
};

struct WireAnswer {
  WireQuestion question;
  std::optional<skeleton3d::LiveWire> ready;  ///< nothing where the photo is too small to hold a stem
  std::optional<skeleton3d::WireStart> start;
};

/// The node whose click a way to `view` begins at: the selected one, or the last before it on its stem that is clicked there.
[[nodiscard]] std::optional<document::NodeId> wireNode(const document::Project& project, const Selection& selection, const std::string& view);

class Wires {
 public:
  explicit Wires(std::function<void()> answered);

  /// Asks for the way's beginning where the mouse is; once a frame. Photos that are shown are made ready one after the other.
  void update(const document::OpenProject& open, const UiState& state, const Photos& photos);
  /// The way from `from` to `to` along a stem of `photo`; nothing while it is being made ready, or where there is no stem.
  [[nodiscard]] std::optional<skeleton3d::WirePath> way(const std::shared_ptr<const skeleton3d::Photo>& photo, PhotoPoint from, PhotoPoint to) const;
  /// Null while the photo is being made ready.
  [[nodiscard]] const skeleton3d::LiveWire* ready(const std::shared_ptr<const skeleton3d::Photo>& photo) const;
  [[nodiscard]] bool busy() const { return worker_.busy(); }

 private:
  void ask(WireQuestion question);

  struct Ready {
    std::shared_ptr<const skeleton3d::Photo> photo;
    std::optional<skeleton3d::LiveWire> wire;
  };
  [[nodiscard]] std::vector<Ready>::const_iterator place(const std::shared_ptr<const skeleton3d::Photo>& photo) const;

  std::vector<Ready> ready_;
  std::optional<WireAnswer> answer_;
  Worker<WireQuestion, WireAnswer> worker_;
};

}  // namespace axil::ui
