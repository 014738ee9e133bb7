#include "ui/studio_inside.hpp"

#include "base/overloaded.hpp"
#include "document/journal.hpp"
#include "document/lookup.hpp"
#include "document/replay.hpp"

#include <imgui.h>

namespace axil::ui {

namespace fs = std::filesystem;
using document::Session;
using document::Step;

Preferences Studio::Inside::preferencesNow() const {
  Preferences now = state.preferences;
  now.theme = state.theme;
  now.language = state.language;
  now.scale = state.scale;
  return now;
}

void Studio::Inside::keepPreferences() {
  if (options.stateFolder.empty() || ImGui::IsAnyMouseDown()) return;
  if (Preferences now = preferencesNow(); now != kept) {
    kept = std::move(now);
    if (const auto written = writePreferences(options.stateFolder, kept); !written) fail(written.error());
  }
}

void Studio::Inside::changed() {
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

void Studio::Inside::run(Step step) {
  const auto ran = session.run(std::move(step));
  if (!ran) return fail(ran.error());
  state.notice.reset();
  changed();
}

void Studio::Inside::replaceSession(Session with) {
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

Result<void> Studio::Inside::open(const fs::path& path) {
  auto opened = Session::open(path, {.stateFolder = options.stateFolder, .chain = {}});
  if (!opened) return opened.failure();
  replaceSession(std::move(*opened));
  if (!isSample()) rememberProject(state.preferences, session.path());
  if (options.stateFolder.empty()) return {};
  if (const auto left = document::leftJournals(options.stateFolder, session.path()); !left.empty()) state.question = LeftWork{left.front().file, left.front().actions};
  return {};
}

void Studio::Inside::recover(const fs::path& journal) {
  auto recovered = document::recover(journal);
  if (!recovered) return fail(recovered.error());
  const std::size_t faults = recovered->faults.size();
  session.close();  // gives the lock back to whoever goes on
  auto resumed = Session::resume(std::move(*recovered), {.stateFolder = options.stateFolder, .chain = {}});
  if (!resumed) return fail(resumed.error());
  replaceSession(std::move(*resumed));
  tell(faults == 0 ? NoticeKind::Said : NoticeKind::Warned, t(faults == 0 ? "recovered" : "recovered_partly"));
}

void Studio::Inside::forget(const fs::path& journal) {
  if (auto recovered = document::recover(journal)) recovered->journal.remove();
}

bool Studio::Inside::isSample() const {
  const fs::path samples = samplesFolder();
  return !samples.empty() && session.path().string().starts_with(samples.string());
}

void Studio::Inside::save() {
  if (session.path().empty() || isSample()) {
    state.dialog = {DialogKind::SaveAs, isSample() ? fs::current_path() : session.openProject().folder, session.project().name + ".axil", ""};
    return;
  }
  if (const auto saved = session.save(); !saved) return fail(saved.error());
  tell(NoticeKind::Said, filled(t("saved"), {{"file", session.path().string()}}));
}

void Studio::Inside::saveAs(const fs::path& path) {
  if (const auto saved = session.saveAs(path); !saved) return fail(saved.error());
  rememberProject(state.preferences, session.path());
  tell(NoticeKind::Said, filled(t("saved"), {{"file", session.path().string()}}));
}

bool Studio::Inside::mayLeave(const Wish& wish) {
  if (!session.isDirty() || state.leaveUnsaved) return true;
  state.question = Unsaved{wish};
  return false;
}

void Studio::Inside::beginTour(const Wish& wish) {
  const fs::path sample = samplesFolder() / "lantana" / "lantana.axil";
  if (session.path() != sample) {
    if (!mayLeave(wish)) return;
    if (const auto opened = open(sample); !opened) return fail(opened.error());
  }
  state.tour = 0;
}

void Studio::Inside::step(const Result<void>& moved) {
  if (!moved) return;
  state.notice.reset();
  changed();
}

void Studio::Inside::carryOut(const Wish& wish) {
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

}  // namespace axil::ui
