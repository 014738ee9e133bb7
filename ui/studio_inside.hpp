#pragma once
/// \file
/// What one Studio keeps from frame to frame, and what it does with it. Defined by topic: studio_project.cpp (opening, saving, undoing,
/// what a person wished), studio_background.cpp (questions to the workers and their answers), studio.cpp (one frame).

#include "document/session.hpp"
#include "ui/export_file.hpp"
#include "ui/export_work.hpp"
#include "ui/fonts_interop.hpp"
#include "ui/ghosts.hpp"
#include "ui/plant_picture.hpp"
#include "ui/shell.hpp"
#include "ui/studio.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace axil::ui {

struct Studio::Inside {
  StudioOptions options;
  Texts texts;
  UiState state = {};
  document::Session session;
  FontBook fonts = {};
  std::uint64_t revision = 1;         // of the project; counts changes
  std::uint64_t asked = 0;
  simeco::Environment askedEnvironment = {};
  std::shared_ptr<const GrownGrammar> draft = {};
  std::uint64_t askedDraft = 0;             // version of the draft
  std::vector<Ghost> ghosts = {};
  std::optional<GhostQuestion> askedGhosts = {};
  std::shared_ptr<const Following> following = std::make_shared<Following>();
  Texture plantTexture = {};
  std::optional<PlantQuestion> drawn = {};  // what was asked for last
  std::optional<Error> drawingTrouble = {};
  ExportState exporting = {};
  bool ended = false;
  std::optional<std::pair<Theme, float>> look = {};
  Preferences kept = {};  // as they were written last
  // Workers last: their threads end first.
  Photos photos;
  Wires wires;
  Proposals proposals;
  Follower follower;
  DraftGrower draftGrower;
  GhostGrower ghostGrower;
  PlantDrawer drawer;
  Exporter exporter;
  FileWriter fileWriter;

  Inside(StudioOptions given, Texts words);
  [[nodiscard]] const char* t(const char* key) const { return texts(key, state.language); }
  void tell(NoticeKind kind, std::string text);
  void fail(const Error& error);

  /// What the window should remember if it ended now.
  [[nodiscard]] Preferences preferencesNow() const;
  /// Written as soon as something changed and no hand is moving it.
  void keepPreferences();
  void changed();
  void run(document::Step step);
  void replaceSession(document::Session with);
  Result<void> open(const std::filesystem::path& path);
  void recover(const std::filesystem::path& journal);
  void forget(const std::filesystem::path& journal);
  /// Samples are everybody's: what is made of them is kept elsewhere.
  [[nodiscard]] bool isSample() const;
  void save();
  void saveAs(const std::filesystem::path& path);
  /// Whether the wish may go on: unsaved work is asked about first.
  bool mayLeave(const Wish& wish);
  void beginTour(const Wish& wish);
  void step(const Result<void>& moved);
  void carryOut(const Wish& wish);

  void takeAnswers();
  /// The words of all facts in the window's language.
  void wantFacts();
  void followDraft();
  /// Ghosts follow the time as fast as they can.
  void followGhosts();
  /// The grammar that is shown: the draft where it grows.
  [[nodiscard]] const GrownGrammar* shown() const;
  void exportFile(const std::filesystem::path& file);
  void finishExport(const ExportAnswer& answer);
  /// When what is shown goes beyond the measured plant, if that is to be seen.
  [[nodiscard]] std::optional<double> measuredUntil() const;
  /// Asks for the plant as it should look now, unless it looks so already. A turning plant is drawn small, to keep up.
  void askForPlant();
  [[nodiscard]] bool plantIsBehind() const;

  void play();
  void draw();
  void wantFactValues(const FactDraft& fact);
  /// What is typed and listed may have characters that no font has yet.
  void wantTyped();
};

}  // namespace axil::ui
