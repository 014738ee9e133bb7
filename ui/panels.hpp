#pragma once
/// \file
/// Panels: each is a function of the project, of what follows from it and of UiState. It draws itself and gives the step that the user
/// took, if any; it changes nothing but UiState. Panels are drawn inside a frame of the window library and nowhere else.

#include "document/session.hpp"
#include "ui/following.hpp"
#include "ui/ghosts.hpp"
#include "ui/photos.hpp"
#include "ui/proposals.hpp"
#include "ui/state.hpp"
#include "ui/wires.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axil::ui {

/// What runs outside the project.
struct ExportState {
  bool running = false;
  std::string what;
  double share = 0;
  std::optional<std::string> done;  ///< folder of the last one that went well
};

/// All that a panel may look at.
struct Panel {
  const document::Session& session;
  const document::Project& project;
  const Following& following;
  const Photos& photos;
  const Wires& wires;
  const Proposals& proposals;
  const Texts& texts;
  const Palette& palette;
  const Texture& plantPicture;
  const std::vector<Ghost>& ghosts;
  const std::shared_ptr<const GrownGrammar>& draft;  ///< what follows from the grammar that is being written; null: nothing yet
  const ExportState& exporting;
  UiState& state;

  /// What has been measured so far; nothing before any camera is known.
  [[nodiscard]] std::optional<Placed> placed() const {
    if (!following.measured.good) return std::nullopt;
    return Placed{*following.measured.good, following.skeleton.good.get()};
  }
  /// What is shown and grown: the draft where it grows, else the last that did.
  [[nodiscard]] const GrownGrammar* shown() const {
    return state.grammarDraft && draft && draft->growth ? draft.get() : following.grammar(state.kind);
  }
  /// The chosen organ; null: none is, or the plant has changed since.
  [[nodiscard]] const ChosenOrgan* organ() const {
    return state.organ && !state.grammarDraft && state.organOf == std::pair(following.revision, state.kind) ? &*state.organ : nullptr;
  }
  [[nodiscard]] const char* t(std::string_view key) const { return texts(key, state.language); }
  [[nodiscard]] float px(float designed) const { return designed * state.scale; }
};

struct Area {
  float x = 0, y = 0, width = 0, height = 0;
};

using Taken = std::optional<document::Step>;

// ---- left: what belongs to each part of the way ------------------------------------------------------------------------
void wayPanel(const Panel& panel);
[[nodiscard]] Taken describePanel(const Panel& panel);
[[nodiscard]] Taken photosPanel(const Panel& panel);
[[nodiscard]] Taken stemsPanel(const Panel& panel);
[[nodiscard]] Taken leavesPanel(const Panel& panel);
[[nodiscard]] Taken grammarPanel(const Panel& panel);
[[nodiscard]] Taken growPanel(const Panel& panel);

// ---- centre --------------------------------------------------------------------------------------------------------------
/// The views' places in the panes: front, right and top first, others where a place is free; -1: none.
[[nodiscard]] std::array<int, 3> viewsOfPanes(const document::Project& project);
[[nodiscard]] Taken photoPane(const Panel& panel, int pane, Area area);
[[nodiscard]] Taken plantPane(const Panel& panel, Area area);
[[nodiscard]] Taken descriptionText(const Panel& panel, Area area);
[[nodiscard]] Taken grammarText(const Panel& panel, Area area);
void welcome(const Panel& panel, Area area);

// ---- right, bottom, on top -----------------------------------------------------------------------------------------------
[[nodiscard]] Taken inspector(const Panel& panel);
void timeline(const Panel& panel, Area area);
void shortcutsSheet(const Panel& panel);
void historySheet(const Panel& panel);
[[nodiscard]] Taken paletteSheet(const Panel& panel);
/// The card of the guided tour, and a frame around what it speaks of.
void tourCard(const Panel& panel);
/// Unsaved work, or work left by a crash: one question, its answers are wishes.
void questionSheet(const Panel& panel);
[[nodiscard]] Taken fileDialog(const Panel& panel);

/// Where samples are: beside the program when it is installed, else in the source tree. Empty where there are none.
[[nodiscard]] std::filesystem::path samplesFolder();

}  // namespace axil::ui
