#pragma once
/// \file
/// UiState: what a person is looking at and in the middle of. It is no part of the project: it is not saved with it and undo leaves it
/// alone. Plain values; panels read and write them, and one frame's wishes are carried out after the panels are drawn.

#include "base/angle.hpp"
#include "document/chain.hpp"
#include "document/command.hpp"
#include "simeco/environment.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/guide_candidates.hpp"
#include "skeleton3d/live_wire.hpp"
#include "skeleton3d/snap.hpp"
#include "ui/clicking.hpp"
#include "ui/preferences.hpp"
#include "ui/texts.hpp"
#include "ui/organ_pick.hpp"
#include "ui/theme.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace axil::ui {

/// The way of work, from the words to the growing plant.
enum class Way { Describe, Photos, Stems, Leaves, Grammar, Grow };
inline constexpr std::array<Way, 6> kWays = {Way::Describe, Way::Photos, Way::Stems, Way::Leaves, Way::Grammar, Way::Grow};

/// How a photo lies in its pane. `zoom`: screen px a photo px; 0: as large as the pane allows. `centre`: the photo px in the middle.
struct PhotoFrame {
  double zoom = 0;
  glm::dvec2 centre{0, 0};
};

/// Where the plant is looked at from. Azimuth 0 is the front, growing to the right; `zoom` 1 shows all of it.
struct Orbit {
  Angle azimuth = Angle::fromDegrees(32);
  Angle elevation = Angle::fromDegrees(10);
  double zoom = 1;
  glm::dvec2 shift{0, 0};  ///< of the plant in its pane, in shares of the pane's height
};

/// A node on its way to another place while the button is down; selected nodes go with it.
struct NodeDrag {
  document::NodeId node;
  std::string view;
  PhotoPoint from;     ///< its click
  PhotoPoint grabbed;  ///< where the button was pressed, beside it
  PhotoPoint at;       ///< where the mouse is
  bool moved = false;

  [[nodiscard]] glm::dvec2 moved_px() const { return at.px - grabbed.px; }
};

/// A node on its way to another place in space, in the plane through it that faces the eye.
struct PlantDrag {
  document::NodeId node;
  PlantPoint from;
  PlantPoint at;
  bool moved = false;

  /// How far its click moves in a photo of this camera.
  [[nodiscard]] glm::dvec2 moved_px(const skeleton3d::Camera& camera) const {
    return skeleton3d::project(camera, at).px - skeleton3d::project(camera, from).px;
  }
};

/// Ranked places in the other photos for a point of one photo, as they were worked out last.
struct Candidates {
  std::string first;
  PhotoPoint at;
  std::optional<document::NodeId> before;
  std::map<std::string, std::vector<skeleton3d::ProposedPlace>> places;  ///< by view, best first
};

/// Nodes on their way into the selection: a box from corner to corner, or all that a line drawn by hand goes round. In px of the photo.
struct Band {
  enum class Kind { Box, Lasso };
  std::string view;
  Kind kind = Kind::Box;
  std::vector<PhotoPoint> points;  ///< a box: where it began and where the mouse is
};

/// The next node clicked is what a stem is joined or attached to.
struct Pick {
  enum class Kind { Join, Attach };
  Kind kind = Kind::Join;
  document::StemId stem;
};

/// What the right button was pressed on.
struct PlaceMenu {
  std::string view;
  PhotoPoint at;
  double reach_px = 8;
  std::optional<document::NodeId> node;
  std::optional<document::StemId> stem;
};

/// The palette while it is open.
struct PaletteState {
  std::string typed;
  int chosen = 0;
};

/// How a photo is shown; its pixels stay as they are. 0 and 1: as it was taken.
struct PhotoLook {
  float brightness = 0;  ///< -1 to 1, of the whole range
  float contrast = 1;    ///< 0.2 to 4, about the middle grey
  friend bool operator==(const PhotoLook&, const PhotoLook&) = default;
};

/// A fact while it is written: one of the description, or one of the user's own.
struct FactDraft {
  std::optional<std::size_t> index;  ///< among the facts of the text; nothing: the user's own
  std::string organ;                 ///< empty: not chosen yet
  std::string property;
  std::string words;                 ///< of the description; empty for the user's own
  bool isMeasured = false;           ///< a size, not a word
  std::string value;
  double low = 0, high = 0;
  std::string unit;
};

/// The grammar while it is written: nothing of the project changes until it is applied.
struct GrammarDraft {
  std::string text;
  document::GrammarKind kind = document::GrammarKind::Initial;
  std::uint64_t version = 1;   ///< counts changes of the text
  std::size_t cursor = 0;      ///< byte of the text
};

/// What a click in a photo does while photos are set up.
enum class PhotoTool { None, Origin, Length };

/// What is done after the panels are drawn, since it is no command on the project.
struct WishSave {};
struct WishSaveAs {
  std::filesystem::path path;
};
struct WishOpen {
  std::filesystem::path path;
};
struct WishNew {};
struct WishUndo {};
struct WishRedo {};
struct WishGoTo {
  std::size_t position = 0;
};
struct WishExport {
  std::filesystem::path folder;
};
struct WishExportFile {
  std::filesystem::path file;  ///< its ending says what is written
};
struct WishCancelExport {};
struct WishQuit {};
/// The sample, and a card that leads through it.
struct WishTour {};
/// The answers to a question.
struct WishRecover {
  std::filesystem::path journal;
};
struct WishForget {
  std::filesystem::path journal;
};
using Wish = std::variant<WishSave, WishSaveAs, WishOpen, WishNew, WishUndo, WishRedo, WishGoTo, WishExport,  //
                          WishExportFile, WishCancelExport, WishQuit, WishTour, WishRecover, WishForget>;

/// Something the user must decide before it goes on.
struct Unsaved {
  Wish then;  ///< what was asked for
};
struct LeftWork {
  std::filesystem::path journal;
  std::size_t actions = 0;
};
using Question = std::variant<Unsaved, LeftWork>;

enum class NoticeKind { Said, Warned, Failed };
struct Notice {
  NoticeKind kind = NoticeKind::Said;
  std::string text;
};

enum class DialogKind { None, Open, SaveAs, Photo, ExportFile };
struct FileDialogState {
  DialogKind kind = DialogKind::None;
  std::filesystem::path folder;
  std::string name;
  std::string view;  ///< Photo: which view gets it
};

struct UiState {
  Way way = Way::Stems;
  Theme theme = Theme::Dark;
  Language language = Language::English;
  float scale = 1;

  Selection selection;
  std::optional<NodeDrag> drag;
  std::optional<PlantDrag> plantDrag;
  std::optional<Band> band;
  std::optional<Pick> pick;
  std::optional<PlaceMenu> menu;
  std::map<std::string, PhotoFrame> frames;                                     ///< of photos that were moved
  std::map<std::string, std::pair<PhotoFrame, glm::dvec2>> shownFrames;         ///< as drawn, with the middle of the pane on the screen
  std::map<std::string, PhotoLook> looks;                                       ///< of photos that are shown otherwise than they are
  std::optional<int> maximised;  ///< pane 0 to 3
  std::optional<std::pair<std::string, PhotoPoint>> hover;  ///< which photo the mouse is over, and where
  bool snap = true;                                      ///< clicks go to the centre line of the stem they are near
  std::optional<ClickMeaning> meaning;                   ///< of a click where the mouse is, this frame
  std::optional<skeleton3d::RidgeReading> ridge;         ///< under the mouse, this frame
  bool trace = true;                                     ///< a stem is followed from the selected node to the mouse
  std::optional<Candidates> candidates;                  ///< while the photos are as they were
  std::optional<skeleton3d::WirePath> wire;              ///< the way to the mouse, this frame
  bool loupe = false;
  bool shortcuts = false;
  bool history = false;
  bool begun = false;  ///< an empty project is being filled: no welcome
  std::optional<PaletteState> palette;
  std::optional<int> tour;  ///< which card of the guided tour, from 0
  Preferences preferences;

  PhotoTool tool = PhotoTool::None;
  std::optional<std::pair<std::string, PhotoPoint>> lengthFrom;  ///< first end of a known length
  double knownLength = 0.1;

  Orbit orbit;
  bool turningPlant = false;
  glm::ivec2 plantPaneSize{0, 0};  ///< as drawn; 0, 0 where it is not shown
  bool showSkeleton = true;
  bool showPlant = true;
  bool tintPredicted = true;       ///< what is not measured stands out

  document::GrammarKind kind = document::GrammarKind::Predictive;  ///< which grammar is shown and grown
  double time = -1;                                                ///< below 0: when all is grown
  bool playing = false;
  double speed = 1;  ///< derivation steps a second
  std::string find;
  bool sideBySide = false;                                         ///< all three grammars at once
  std::optional<GrammarDraft> grammarDraft;
  std::optional<ChosenOrgan> organ;                                ///< Panel::organ says whether it is still of what is shown
  std::pair<std::uint64_t, document::GrammarKind> organOf;         ///< the project's revision and the grammar when it was chosen
  std::optional<int> shownSegment;                                 ///< whose lines were scrolled to last
  std::optional<int> wantedLine;                                   ///< of the grammar, from 0: to be scrolled to
  simeco::Environment environment;                                 ///< that the plant is grown in
  int ghosts = 0;                                                  ///< how many other seeds are shown

  std::string descriptionDraft;
  bool describing = false;         ///< the draft is being written
  std::optional<std::size_t> hotTrait;
  std::optional<FactDraft> factDraft;
  std::optional<quantify::LeafArrangement> leavesDraft;  ///< while a slider is pulled
  int leavesNumber = 0;                                  ///< which arrangement it is, from 1
  std::string exportFolder;

  FileDialogState dialog;
  std::optional<Question> question;
  bool leaveUnsaved = false;       ///< the user gave the unsaved work up
  std::optional<Notice> notice;    ///< of the last thing done; until the next
  std::pair<std::uint64_t, std::size_t> placeable;  ///< the plant that was followed last, and how many of its waiting nodes have a place
  std::size_t shownTroubles = 0;   ///< lines of what is still missing, this frame
  std::string status;              ///< what a click would do now
  std::map<std::string, std::array<float, 4>, std::less<>> landmarks;  ///< x, y, width, height of what can be pressed, this frame
  std::vector<Wish> wishes;
};

}  // namespace axil::ui
