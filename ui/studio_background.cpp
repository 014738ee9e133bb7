#include "ui/studio_inside.hpp"

#include "ui/trait_words.hpp"

#include <algorithm>
#include <tuple>

namespace axil::ui {

namespace fs = std::filesystem;

void Studio::Inside::takeAnswers() {
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

void Studio::Inside::wantFacts() {
  if (!following->said) return;
  for (const keywords::Trait& trait : *following->said) fonts.want(valueWord(trait, state.language) + organWord(trait.organ, state.language) + trait.qualifier + trait.unit);
}

void Studio::Inside::followDraft() {
  if (auto answer = draftGrower.take()) draft = std::move(*answer);
  if (!state.grammarDraft) {
    draft.reset();
    askedDraft = 0;
  } else if (askedDraft != state.grammarDraft->version) {
    askedDraft = state.grammarDraft->version;
    draftGrower.ask({state.grammarDraft->text, session.project().seed, state.environment});
  }
}

void Studio::Inside::followGhosts() {
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

const GrownGrammar* Studio::Inside::shown() const {
  return state.grammarDraft && draft && draft->growth ? draft.get() : following->grammar(state.kind);
}

void Studio::Inside::exportFile(const fs::path& file) {
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

void Studio::Inside::finishExport(const ExportAnswer& answer) {
  exporting.running = false;
  if (!answer.report && answer.report.error().code == ErrorCode::Cancelled) return tell(NoticeKind::Said, t("export_cancelled"));
  if (!answer.report) return fail(answer.report.error());
  exporting.done = answer.folder.string();
  tell(NoticeKind::Said, filled(t("exported"), {{"folder", answer.folder.string()}}));
}

std::optional<double> Studio::Inside::measuredUntil() const {
  const auto* measured = following->grammar(document::GrammarKind::Initial);
  if (!state.tintPredicted || state.kind != document::GrammarKind::Predictive || state.grammarDraft || measured == nullptr) return std::nullopt;
  return measured->end;
}

void Studio::Inside::askForPlant() {
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

bool Studio::Inside::plantIsBehind() const {
  const auto* grown = shown();
  if (grown == nullptr || !grown->growth || state.plantPaneSize.x < 16 || !state.showPlant || drawingTrouble) return false;
  return drawer.busy() || !drawn || drawn->size_px != state.plantPaneSize;
}

}  // namespace axil::ui
