#include "ui/studio.hpp"

#include "base/overloaded.hpp"
#include "document/journal.hpp"
#include "document/lookup.hpp"
#include "document/replay.hpp"
#include "ui/actions.hpp"
#include "ui/export_file.hpp"
#include "ui/export_work.hpp"
#include "ui/ghosts.hpp"
#include "ui/fonts_interop.hpp"
#include "ui/plant_picture.hpp"
#include "ui/shell.hpp"
#include "ui/trait_words.hpp"

#include <imgui.h>

#include <algorithm>
#include <chrono>

namespace axil::ui {

namespace fs = std::filesystem;
using document::Session;
using document::Step;

namespace {

std::string textOf(const Error& error, const Texts& texts, Language language) {
  std::string text = texts.translated(error.message, language);
  for (std::size_t i = 0; i < std::min<std::size_t>(error.details.size(), 3); ++i) text += "\n" + texts.translated(error.details[i], language);
  return text;
}

/// Which view a photo without one gets: the one its name says, else the first that has none.
std::string viewFor(const document::Project& project, const fs::path& photo) {
  static constexpr std::array<const char*, 3> kViews = {"front", "right", "top"};
  const auto isFree = [&](const char* view) {
    const auto place = document::viewNamed(project, view);
    return !place || project.views[*place].photo.empty();
  };
  for (const char* view : kViews)
    if (isFree(view) && photo.stem().string().find(view) != std::string::npos) return view;
  for (const char* view : kViews)
    if (isFree(view)) return view;
  return {};
}

}  // namespace

struct Studio::Inside {
  StudioOptions options;
  Texts texts;
  UiState state = {};
  Session session;
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

  Inside(StudioOptions given, Texts words)
      : options(std::move(given)), texts(std::move(words)), session(Session::untitled({.stateFolder = options.stateFolder, .chain = {}})), photos(options.wake), wires(options.wake), proposals(options.wake), follower(followingWork, options.wake),
        draftGrower([] { return [](const DraftQuestion& q) { return grownFrom(q.text, q.seed, q.environment); }; }, options.wake), ghostGrower(ghostWork, options.wake),
        drawer(drawingWork, options.wake), exporter(options.wake), fileWriter(fileWork, options.wake) {
    state.preferences = readPreferences(options.stateFolder);
    state.theme = options.theme.value_or(state.preferences.theme.value_or(Theme::Dark));
    state.language = options.language.value_or(state.preferences.language.value_or(Language::English));
    state.scale = options.scale.value_or(state.preferences.scale.value_or(options.screenScale));
    kept = preferencesNow();
    for (const fs::path& project : state.preferences.recent) fonts.want(project.string());
    state.exportFolder = (fs::current_path() / "plant-out").string();
    fonts.want(texts.allCharacters());
    fonts.want("°±•·–…→English繁體中文简体中文");
  }

  [[nodiscard]] const char* t(const char* key) const { return texts(key, state.language); }
  void tell(NoticeKind kind, std::string text) {
    fonts.want(text);
    state.notice = Notice{kind, std::move(text)};
  }
  void fail(const Error& error) { tell(NoticeKind::Failed, textOf(error, texts, state.language)); }

  // ---- the project -----------------------------------------------------------------------------------------------------------

  /// What the window should remember if it ended now.
  [[nodiscard]] Preferences preferencesNow() const {
    Preferences now = state.preferences;
    now.theme = state.theme;
    now.language = state.language;
    now.scale = state.scale;
    return now;
  }

  /// Written as soon as something changed and no hand is moving it.
  void keepPreferences() {
    if (options.stateFolder.empty() || ImGui::IsAnyMouseDown()) return;
    if (Preferences now = preferencesNow(); now != kept) {
      kept = std::move(now);
      if (const auto written = writePreferences(options.stateFolder, kept); !written) fail(written.error());
    }
  }

  void changed() {
    ++revision;
    state.candidates.reset();
    const document::Project& project = session.project();
    fonts.want(project.name);
    fonts.want(project.description);
    for (const auto& view : project.views) fonts.want(view.photo + view.view.name);
    for (const document::NodeId node : state.selection.all())
      if (!document::nodeWithId(project, node)) state.selection.remove(node);
    if (session.journalTrouble()) tell(NoticeKind::Warned, session.journalTrouble()->message);
  }

  void run(Step step) {
    const auto ran = session.run(std::move(step));
    if (!ran) return fail(ran.error());
    state.notice.reset();
    changed();
  }

  void replaceSession(Session with) {
    if (!session.isDirty() || state.leaveUnsaved) session.close();
    session = std::move(with);
    const Way way = state.way;
    UiState fresh;
    fresh.theme = state.theme;
    fresh.language = state.language;
    fresh.scale = state.scale;
    fresh.way = way;
    fresh.loupe = state.loupe;
    fresh.tour = state.tour;
    fresh.preferences = std::move(state.preferences);
    state = std::move(fresh);
    following = std::make_shared<Following>();
    drawn.reset();
    state.exportFolder = ((isSample() || session.path().empty() ? fs::current_path() : session.path().parent_path()) / (session.project().name + "-out")).string();
    plantTexture = Texture{};
    exporting = {};
    changed();
  }

  Result<void> open(const fs::path& path) {
    auto opened = Session::open(path, {.stateFolder = options.stateFolder, .chain = {}});
    if (!opened) return opened.failure();
    replaceSession(std::move(*opened));
    if (!isSample()) rememberProject(state.preferences, session.path());
    if (options.stateFolder.empty()) return {};
    if (const auto left = document::leftJournals(options.stateFolder, session.path()); !left.empty()) state.question = LeftWork{left.front().file, left.front().actions};
    return {};
  }

  void recover(const fs::path& journal) {
    auto recovered = document::recover(journal);
    if (!recovered) return fail(recovered.error());
    const std::size_t faults = recovered->faults.size();
    session.close();  // gives the lock back to whoever goes on
    auto resumed = Session::resume(std::move(*recovered), {.stateFolder = options.stateFolder, .chain = {}});
    if (!resumed) return fail(resumed.error());
    replaceSession(std::move(*resumed));
    tell(faults == 0 ? NoticeKind::Said : NoticeKind::Warned, t(faults == 0 ? "recovered" : "recovered_partly"));
  }

  void forget(const fs::path& journal) {
    if (auto recovered = document::recover(journal)) recovered->journal.remove();
  }

  /// Samples are everybody's: what is made of them is kept elsewhere.
  [[nodiscard]] bool isSample() const {
    const fs::path samples = samplesFolder();
    return !samples.empty() && session.path().string().starts_with(samples.string());
  }

  void save() {
    if (session.path().empty() || isSample()) {
      state.dialog = {DialogKind::SaveAs, isSample() ? fs::current_path() : session.openProject().folder, session.project().name + ".axil", ""};
      return;
    }
    if (const auto saved = session.save(); !saved) return fail(saved.error());
    tell(NoticeKind::Said, filled(t("saved"), {{"file", session.path().string()}}));
  }

  void saveAs(const fs::path& path) {
    if (const auto saved = session.saveAs(path); !saved) return fail(saved.error());
    rememberProject(state.preferences, session.path());
    tell(NoticeKind::Said, filled(t("saved"), {{"file", session.path().string()}}));
  }

  /// Whether the wish may go on: unsaved work is asked about first.
  bool mayLeave(const Wish& wish) {
    if (!session.isDirty() || state.leaveUnsaved) return true;
    state.question = Unsaved{wish};
    return false;
  }

  void beginTour(const Wish& wish) {
    const fs::path sample = samplesFolder() / "lantana" / "lantana.axil";
    if (session.path() != sample) {
      if (!mayLeave(wish)) return;
      if (const auto opened = open(sample); !opened) return fail(opened.error());
    }
    state.tour = 0;
  }

  void step(const Result<void>& moved) {
    if (!moved) return;
    state.notice.reset();
    changed();
  }

  void carryOut(const Wish& wish) {
    std::visit(overloaded{[&](const WishSave&) { save(); }, [&](const WishSaveAs& w) { saveAs(w.path); },
                          [&](const WishOpen& w) {
                            if (!mayLeave(wish)) return;
                            if (const auto opened = open(w.path); !opened) fail(opened.error());
                          },
                          [&](const WishNew&) {
                            if (mayLeave(wish)) replaceSession(Session::untitled({.stateFolder = options.stateFolder, .chain = {}}));
                          },
                          [&](const WishUndo&) {
                            if (session.history().canUndo()) step(session.undo());
                          },
                          [&](const WishRedo&) {
                            if (session.history().canRedo()) step(session.redo());
                          },
                          [&](const WishGoTo& w) { step(session.goTo(w.position)); },
                          [&](const WishExport& w) {
                            exporting = {.running = true, .what = "", .share = 0, .done = {}};
                            exporter.begin({session.openProject(), w.folder});
                          },
                          [&](const WishExportFile& w) { exportFile(w.file); },
                          [&](const WishCancelExport&) { exporter.cancel(); },
                          [&](const WishQuit&) {
                            if (!mayLeave(wish)) return;
                            session.close();
                            ended = true;
                          },
                          [&](const WishTour&) { beginTour(wish); },
                          [&](const WishRecover& w) { recover(w.journal); }, [&](const WishForget& w) { forget(w.journal); }},
               wish);
  }

  // ---- the background --------------------------------------------------------------------------------------------------------

  void takeAnswers() {
    if (auto answer = follower.take()) {
      following = std::move(*answer);
      wantFacts();
    }
    if (asked != revision || askedEnvironment != state.environment) {
      asked = revision;
      askedEnvironment = state.environment;
      askedDraft = 0;
      follower.ask({session.openProject(), revision, state.environment});
    }
    followDraft();
    followGhosts();
    if (auto answer = fileWriter.take()) {
      if (answer->written) tell(NoticeKind::Said, filled(t("saved"), {{"file", answer->file.string()}}));
      else fail(answer->written.error());
    }
    photos.update(session.openProject());
    wires.update(session.openProject(), state, photos);
    const bool isCurrent = following->revision == revision && following->measured.good;
    proposals.update(session.openProject(), revision, state, isCurrent ? std::optional(Placed{*following->measured.good, following->skeleton.good.get()}) : std::nullopt, photos, wires);
    if (auto picture = drawer.take()) {
      drawingTrouble = picture->trouble;
      if (picture->trouble) fail(*picture->trouble);
      else plantTexture.set(picture->image.width_px, picture->image.height_px, picture->image.rgb);
    }
    if (auto answer = exporter.take()) finishExport(*answer);
    if (exporting.running) std::tie(exporting.what, exporting.share) = exporter.progress();
  }

  /// The words of all facts in the window's language.
  void wantFacts() {
    if (!following->said) return;
    for (const keywords::Trait& trait : *following->said) fonts.want(valueWord(trait, state.language) + organWord(trait.organ, state.language) + trait.qualifier + trait.unit);
  }

  void followDraft() {
    if (auto answer = draftGrower.take()) draft = std::move(*answer);
    if (!state.grammarDraft) {
      draft.reset();
      askedDraft = 0;
    } else if (askedDraft != state.grammarDraft->version) {
      askedDraft = state.grammarDraft->version;
      draftGrower.ask({state.grammarDraft->text, session.project().seed, state.environment});
    }
  }

  /// Ghosts follow the time as fast as they can.
  void followGhosts() {
    if (auto answer = ghostGrower.take()) ghosts = std::move(*answer);
    const auto& grammar = following->grammars[static_cast<std::size_t>(state.kind)];
    if (state.ghosts == 0 || !grammar || state.grammarDraft) {
      ghosts.clear();
      askedGhosts.reset();
      return;
    }
    GhostQuestion question{grammar, session.project().seed, state.ghosts, state.time < 0 ? grammar->end : std::min(state.time, grammar->end), state.environment};
    const bool same = askedGhosts && askedGhosts->grammar == question.grammar && askedGhosts->seed == question.seed && askedGhosts->ghosts == question.ghosts &&
                      askedGhosts->time == question.time && askedGhosts->environment == question.environment;
    if (same || ghostGrower.working()) return;
    askedGhosts = question;
    ghostGrower.ask(std::move(question));
  }

  /// The grammar that is shown: the draft where it grows.
  [[nodiscard]] const GrownGrammar* shown() const {
    return state.grammarDraft && draft && draft->growth ? draft.get() : following->grammar(state.kind);
  }

  void exportFile(const fs::path& file) {
    const GrownGrammar* grown = shown();
    FileQuestion question{.file = file, .text = state.grammarDraft ? state.grammarDraft->text : grown != nullptr ? grown->text : std::string(), .growth = {}, .camera = {}};
    if (grown != nullptr) {
      question.growth = grown->growth;
      question.end = grown->end;
      question.time = state.time < 0 ? grown->end : std::min(state.time, grown->end);
      question.size_px = {1440, 1440};
      question.camera = orbitCamera(state.orbit, grown->middle, grown->reach, question.size_px);
    }
    question.unit = session.project().unit;
    tell(NoticeKind::Said, filled(t("writing"), {{"file", file.filename().string()}}));
    fileWriter.ask(std::move(question));
  }

  void finishExport(const ExportAnswer& answer) {
    exporting.running = false;
    if (!answer.report && answer.report.error().code == ErrorCode::Cancelled) return tell(NoticeKind::Said, t("export_cancelled"));
    if (!answer.report) return fail(answer.report.error());
    exporting.done = answer.folder.string();
    tell(NoticeKind::Said, filled(t("exported"), {{"folder", answer.folder.string()}}));
  }

  /// When what is shown goes beyond the measured plant, if that is to be seen.
  [[nodiscard]] std::optional<double> measuredUntil() const {
    const auto* measured = following->grammar(document::GrammarKind::Initial);
    if (!state.tintPredicted || state.kind != document::GrammarKind::Predictive || state.grammarDraft || measured == nullptr) return std::nullopt;
    return measured->end;
  }

  /// Asks for the plant as it should look now, unless it looks so already. A turning plant is drawn small, to keep up.
  void askForPlant() {
    const auto* grown = shown();
    if (grown == nullptr || !grown->growth || state.plantPaneSize.x < 16 || state.plantPaneSize.y < 16 || !state.showPlant || drawingTrouble) return;
    const double factor = state.turningPlant || state.playing ? 0.5 : 1;
    PlantQuestion question{*grown->growth, timeShown(state.time, *grown), {}, {}};
    question.size_px = glm::max(glm::ivec2(glm::dvec2(state.plantPaneSize) * factor), glm::ivec2(16));
    question.camera = resized(orbitCamera(state.orbit, grown->middle, grown->reach, state.plantPaneSize), factor);
    question.measuredUntil = measuredUntil();
    const bool same = drawn && &drawn->growth.data() == &question.growth.data() && drawn->time == question.time && drawn->measuredUntil == question.measuredUntil && drawn->camera == question.camera && drawn->size_px == question.size_px;
    if (same || drawer.working()) return;
    drawn = question;
    drawer.ask(std::move(question));
  }

  [[nodiscard]] bool plantIsBehind() const {
    const auto* grown = shown();
    if (grown == nullptr || !grown->growth || state.plantPaneSize.x < 16 || !state.showPlant || drawingTrouble) return false;
    return drawer.busy() || !drawn || drawn->size_px != state.plantPaneSize;
  }

  void play() {
    const auto* grown = shown();
    if (!state.playing || grown == nullptr || grown->end <= 0) return;
    constexpr double kSeconds = 8;  // from nothing to the end
    state.time = std::max(0.0, state.time) + static_cast<double>(ImGui::GetIO().DeltaTime) * grown->end / kSeconds * state.speed;
    if (state.time < grown->end) return;
    state.time = -1;
    state.playing = false;
  }

  void draw() {
    const Palette& palette = paletteOf(state.theme);
    if (look != std::pair(state.theme, state.scale)) {
      look = {state.theme, state.scale};
      applyLook(palette, state.scale);
    }
    play();
    const Panel panel{session, session.project(), *following, photos, wires, proposals, texts, palette, plantTexture, ghosts, draft, exporting, state};
    std::vector<Step> steps;
    if (Taken taken = actOnKeys(panel)) steps.push_back(std::move(*taken));
    for (Step& taken : shell(panel)) steps.push_back(std::move(taken));
    for (Step& taken : steps) run(std::move(taken));
    askForPlant();
    for (const Wish& wish : std::exchange(state.wishes, {})) carryOut(wish);
    keepPreferences();
  }

  void wantFactValues(const FactDraft& fact) {
    for (const FactKind& kind : factKinds()) fonts.want(organWord(kind.organ, state.language));
    for (const std::string& value : valuesOf(fact.organ, fact.property)) fonts.want(valueWord(fact.organ, fact.property, value, state.language));
  }

  /// What is typed and listed may have characters that no font has yet.
  void wantTyped() {
    if (state.factDraft) wantFactValues(*state.factDraft);
    if (state.describing) fonts.want(state.descriptionDraft);
    if (state.dialog.kind == DialogKind::None) return;
    std::error_code none;
    fonts.want(state.dialog.folder.string());
    for (fs::directory_iterator it(state.dialog.folder, fs::directory_options::skip_permission_denied, none), end; !none && it != end; it.increment(none))
      fonts.want(it->path().filename().string());
  }
};

Studio::Studio(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Studio::Studio(Studio&&) noexcept = default;
Studio& Studio::operator=(Studio&&) noexcept = default;
Studio::~Studio() = default;

Result<Studio> Studio::create(StudioOptions options) {
  auto texts = Texts::load();
  if (!texts) return texts.failure();
  Studio studio(std::make_unique<Inside>(std::move(options), std::move(*texts)));
  if (!FontBook::isInstalled())
    studio.inside_->tell(NoticeKind::Warned, "Chinese cannot be shown: the font is missing (on Debian: apt-get install fonts-wqy-microhei)");
  return studio;
}

Result<void> Studio::open(const fs::path& project) { return inside_->open(project); }

Result<void> Studio::runLine(std::string_view line) {
  const auto ran = inside_->session.runLine(line);
  if (!ran) return ran.failure();
  inside_->changed();
  return {};
}

void Studio::drop(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    if (file.extension() == ".axil") {
      inside_->carryOut(WishOpen{file});
      continue;
    }
    const document::Project& project = inside_->session.project();
    const std::string view = viewFor(project, file);
    if (view.empty()) {
      inside_->tell(NoticeKind::Warned, inside_->t("all_views_taken"));
      return;
    }
    const bool exists = document::viewNamed(project, view).has_value();
    inside_->run(exists ? Step{document::RelinkPhoto{view, file.string()}} : Step{document::AddView{view, file.string()}});
    inside_->state.way = Way::Photos;
  }
}

bool Studio::prepareFonts() {
  inside_->wantTyped();
  return inside_->fonts.prepare(inside_->state.scale);
}

void Studio::tell(const Error& error) { inside_->fail(error); }

Colour Studio::ground() const { return paletteOf(inside_->state.theme).ground; }

void Studio::frame() {
  inside_->takeAnswers();
  inside_->draw();
}

bool Studio::isBusy() const {
  const Inside& in = *inside_;
  return in.state.playing || in.follower.busy() || in.asked != in.revision || in.draftGrower.busy() || in.ghostGrower.busy() || in.fileWriter.busy() || in.photos.busy() || in.wires.busy() || in.proposals.busy() || in.plantIsBehind() || in.exporting.running;
}

bool Studio::hasEnded() const { return inside_->ended; }
void Studio::askToEnd() { inside_->carryOut(WishQuit{}); }
const Session& Studio::session() const { return inside_->session; }
UiState& Studio::state() { return inside_->state; }

fs::path samplesFolder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  for (const fs::path& folder : {program.parent_path().parent_path() / "share" / "axil" / "samples", fs::path(AXIL_SAMPLES_FOLDER)})
    if (fs::exists(folder / "lantana" / "lantana.axil", none)) return folder;
  return {};
}

}  // namespace axil::ui
