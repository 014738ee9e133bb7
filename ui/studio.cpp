#include "ui/studio_inside.hpp"

#include "document/lookup.hpp"
#include "ui/actions.hpp"
#include "ui/trait_words.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>

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

Studio::Inside::Inside(StudioOptions given, Texts words)
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

void Studio::Inside::tell(NoticeKind kind, std::string text) {
  fonts.want(text);
  state.notice = Notice{kind, std::move(text)};
}

void Studio::Inside::fail(const Error& error) { tell(NoticeKind::Failed, textOf(error, texts, state.language)); }

void Studio::Inside::play() {
  const auto* grown = shown();
  if (!state.playing || grown == nullptr || grown->end <= 0) return;
  constexpr double kSeconds = 8;  // from nothing to the end
  state.time = std::max(0.0, state.time) + static_cast<double>(ImGui::GetIO().DeltaTime) * grown->end / kSeconds * state.speed;
  if (state.time < grown->end) return;
  state.time = -1;
  state.playing = false;
}

void Studio::Inside::draw() {
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

void Studio::Inside::wantFactValues(const FactDraft& fact) {
  for (const FactKind& kind : factKinds()) fonts.want(organWord(kind.organ, state.language));
  for (const std::string& value : valuesOf(fact.organ, fact.property)) fonts.want(valueWord(fact.organ, fact.property, value, state.language));
}

void Studio::Inside::wantTyped() {
  if (state.factDraft) wantFactValues(*state.factDraft);
  if (state.describing) fonts.want(state.descriptionDraft);
  if (state.dialog.kind == DialogKind::None) return;
  std::error_code none;
  fonts.want(state.dialog.folder.string());
  for (fs::directory_iterator it(state.dialog.folder, fs::directory_options::skip_permission_denied, none), end; !none && it != end; it.increment(none))
    fonts.want(it->path().filename().string());
}

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
