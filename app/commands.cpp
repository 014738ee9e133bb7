#include "app/commands.hpp"

#include "app/terminal.hpp"
#include "base/files.hpp"
#include "base/rng.hpp"
#include "document/build.hpp"
#include "document/skeleton_file.hpp"
#include "render/render.hpp"
#include "simeco/simeco.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>

namespace axil::app {

namespace fs = std::filesystem;
using document::ChainOptions;
using simeco::Plant;

namespace {

constexpr std::uintmax_t kMaximumTextBytes = 100'000'000;

/// Warnings do not stop anything; they go to stderr, with the place they are about.
void warn(const simeco::GrammarFile& file) {
  for (const Diagnostic& d : file.parsed.diagnostics)
    if (d.severity == Severity::Warning) std::fprintf(stderr, "%s\n", formatWithCaret(d, file.text, file.path.string()).c_str());
}

Result<simeco::Grammar> grammarIn(const std::string& path) {
  auto file = simeco::readGrammarFile(path);
  if (!file) return file.failure();
  if (file->parsed.ok()) {
    warn(*file);
    return std::move(file->parsed.grammar);
  }
  Error error{ErrorCode::BadGrammar, path + " has errors", {}};
  for (const Diagnostic& d : file->parsed.diagnostics) error.details.push_back(formatWithCaret(d, file->text, path));
  return fail(std::move(error));
}

/// The plant of an ecosystem that is called `name`; without a name the first.
Result<std::size_t> plantNamed(const simeco::Grammar& grammar, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < grammar.plants.size(); ++i) {
    if (name.empty() || grammar.plants[i].name == name) return i;
    names += (names.empty() ? "\"" : ", \"") + grammar.plants[i].name + "\"";
  }
  if (names.empty()) return fail(ErrorCode::BadGrammar, "the grammar has no plant");
  return fail(ErrorCode::BadInput, "the grammar has no plant \"" + name + "\"; it has " + names);
}

/// Of the random numbers of an ecosystem those of one plant, so that it is the same alone and among the others.
std::uint64_t seedOf(std::uint64_t seed, std::size_t plant) { return plant == 0 ? seed : Rng(seed).split(plant).bits(); }

/// Runs `chain` on an open project and prints what it gives as `text` says.
template <class Chain, class Print>
int printed(const std::string& project, const ChainOptions& options, Chain chain, Print text) {
  const auto open = document::loadProject(project);
  if (!open) return report(open.error());
  const auto value = chain(*open, options);
  return value ? print(text(*value)) : report(value.error());
}

}  // namespace

// ---- keywords --------------------------------------------------------------------------------------------------------

namespace {

Result<std::string> textOf(const std::string& file) {
  if (file != "-") return readFile(file, kMaximumTextBytes);
  std::string text;
  for (char c; text.size() <= kMaximumTextBytes && std::cin.get(c);) text.push_back(c);
  if (text.size() > kMaximumTextBytes) return fail(ErrorCode::LimitReached, "the description is longer than the limit of 100,000,000 bytes");
  return text;
}

}  // namespace

int run(const KeywordsCommand& command) {
  const auto bytes = textOf(command.file);
  if (!bytes) return report(bytes.error());
  const auto traits = keywords::readTraits(*bytes);
  if (!traits) return report({traits.error().code, (command.file == "-" ? "standard input" : command.file) + ": " + traits.error().message, traits.error().details});
  return print(command.json ? keywords::traitsJson(*traits, keywords::presetsOf(*traits)) : keywords::traitsText(*traits, keywords::presetsOf(*traits)));
}

// ---- skeleton, quantify, emit ----------------------------------------------------------------------------------------

int run(const SkeletonCommand& command) {
  return printed(command.project, {.watch = terminalWatch()},
                 [](const auto& open, const auto& options) { return document::skeletonOf(open, options); }, document::skeletonText);
}

int run(const QuantifyCommand& command) {
  return printed(command.project, {.turning = command.turning, .watch = terminalWatch()},
                 [](const auto& open, const auto& options) { return document::measurementsOf(open, options); }, quantify::segmentsCsv);
}

int run(const EmitCommand& command) {
  const ChainOptions options{.turning = command.turning, .decimals = command.decimals, .watch = terminalWatch()};
  if (command.dialect == emit::Dialect::SimEco)
    return printed(command.project, options, [&](const auto& open, const auto& o) { return document::grammarOf(open, command.kind, o); }, simeco::print);
  if (command.kind != document::GrammarKind::Initial)
    return report({ErrorCode::BadInput, std::string("the ") + document::nameOf(command.kind) + " grammar can only be written as simeco; use --kind initial for other dialects", {}});
  return printed(command.project, options, [&](const auto& open, const auto& o) { return document::dialectOf(open, command.dialect, o); },
                 [](const std::string& text) { return text; });
}

// ---- check, derive ---------------------------------------------------------------------------------------------------

int run(const CheckCommand& command) {
  const auto file = simeco::readGrammarFile(command.grammar);
  if (!file) return report(file.error());
  std::string lines;
  for (const Diagnostic& d : file->parsed.diagnostics) lines += formatDiagnostic(d, file->text, command.grammar) + "\n";
  const int status = print(lines);
  return status != 0 ? status : (file->parsed.ok() ? 0 : 1);
}

namespace {

using Json = nlohmann::ordered_json;

std::string countsText(const simeco::Derivation& derivation) {
  return Json{{"steps", derivation.modulesPerStep}, {"letters", simeco::letterCounts(derivation.string)}}.dump() + "\n";
}

std::string statsText(const simeco::Derivation& derivation) {
  return Json{{"modules", derivation.string.size()},
              {"steps", derivation.modulesPerStep.size()},
              {"derive_seconds", derivation.seconds},
              {"peak_bytes", derivation.peakBytes},
              {"threads", derivation.threads}}
             .dump() + "\n";
}

/// An L-system may ask where its turtle is, and its view file says where that starts.
Result<simeco::Derivation> derived(const simeco::Grammar& grammar, const std::string& path, const simeco::DeriveOptions& options) {
  if (grammar.language != simeco::Language::LSystem) return simeco::derive(grammar, options);
  const auto view = simeco::viewBeside(path);
  if (!view) return view.failure();
  return simeco::deriveLSystem(grammar, {.derive = options, .view = *view});
}

std::string stringText(const simeco::Grammar& grammar, const simeco::Derivation& derivation) {
  return (grammar.language == simeco::Language::LSystem ? simeco::toLSystemText(derivation.string) : simeco::toText(derivation.string)) + "\n";
}

}  // namespace

int run(const DeriveCommand& command) {
  const auto grammar = grammarIn(command.grammar);
  if (!grammar) return report(grammar.error());
  const auto plant = plantNamed(*grammar, command.plant);
  if (!plant) return report(plant.error());
  if (command.plant.empty() && grammar->plants.size() > 1)
    std::fprintf(stderr, "axil: note: the ecosystem has %zu plants; this is \"%s\", --plant NAME derives another\n", grammar->plants.size(), grammar->plants.front().name.c_str());
  simeco::DeriveOptions options;
  options.plant = *plant;
  options.steps = command.steps;
  options.seed = seedOf(command.seed, *plant);
  options.limits = command.limits;
  options.threads = command.threads;
  options.singlePrecision = command.singlePrecision;
  options.watch = terminalWatch();
  options.host.print = [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); };
  const auto derivation = derived(*grammar, command.grammar, options);
  if (!derivation) return report(derivation.error());
  for (const std::string& warning : derivation->warnings) std::fprintf(stderr, "%s: warning: %s\n", command.grammar.c_str(), warning.c_str());
  switch (command.print) {
    case DeriveCommand::Print::Counts: return print(countsText(*derivation));
    case DeriveCommand::Print::Stats: return print(statsText(*derivation));
    case DeriveCommand::Print::Text: break;
  }
  return print(stringText(*grammar, *derivation));
}

// ---- grow ------------------------------------------------------------------------------------------------------------

namespace {

const std::map<std::string, render::ViewPreset> kViews = {{"front", render::ViewPreset::Front},
                                                          {"right", render::ViewPreset::Right},
                                                          {"top", render::ViewPreset::Top},
                                                          {"quarter", render::ViewPreset::ThreeQuarter}};

/// The plant of a grammar at any moment, whichever language it is written in.
struct Growing {
  std::function<Result<Plant>(double time)> at;
  double endTime = 0;
};

/// An L-system has no time of its own: its moments are its steps.
Result<Growing> growingOfLSystem(const simeco::Grammar& grammar, const GrowCommand& command) {
  if (command.environment != simeco::Environment{})
    return fail(ErrorCode::BadInput, "a classic L-system has no environment; its view file bends it (tropism:), so leave options such as --wind out");
  const auto view = simeco::viewBeside(command.grammar);
  if (!view) return view.failure();
  simeco::LSystemPlantOptions options;
  options.derive.view = *view;
  options.derive.derive.seed = command.seed;
  options.derive.derive.limits = command.limits;
  options.derive.derive.watch = terminalWatch();
  options.derive.derive.steps = command.steps;
  constexpr double kMostSteps = 1e9;  // the engine's own limit is lower
  if (command.time) options.derive.derive.steps = static_cast<std::int64_t>(std::min(*command.time, kMostSteps));
  const auto last = simeco::plantOfLSystem(grammar, options);
  if (!last) return last.failure();
  return Growing{[grammar, options, last = *last](double time) -> Result<Plant> {
                   if (time >= last.time) return last;
                   simeco::LSystemPlantOptions earlier = options;
                   earlier.derive.derive.steps = static_cast<std::int64_t>(time);
                   return simeco::plantOfLSystem(grammar, earlier);
                 },
                 last->time};
}

Result<Growing> growingOf(const simeco::Grammar& grammar, std::uint64_t seed, const GrowCommand& command) {
  if (grammar.language == simeco::Language::LSystem) return growingOfLSystem(grammar, command);
  simeco::GrowOptions options;
  options.seed = seed;
  options.limits = command.limits;
  options.watch = terminalWatch();
  options.environment = command.environment;
  options.turning = command.turning;
  options.upToTime = command.time;
  options.steps = command.steps;
  const auto growth = simeco::prepareGrowth(grammar, options);
  if (!growth) return growth.failure();
  return Growing{[growth = *growth](double time) { return simeco::plantAt(growth, time); }, command.time.value_or(simeco::completeTime(*growth))};
}

Result<std::string> skeletonBytes(const Plant& plant) {
  const auto skeleton = render::skeletonOf(plant);
  if (!skeleton) return skeleton.failure();
  return document::skeletonText(*skeleton);
}

Result<std::string> pictureBytes(const render::PlantMesh& mesh, const render::PictureOptions& picture) {
  const auto image = render::drawPlant(mesh, picture);
  if (!image) return image.failure();
  return render::pngBytes(*image);
}

Result<void> writeObj(const render::PlantMesh& mesh, const fs::path& out) {
  // The OBJ names its library, and a name there must not have blanks.
  std::string name = out.stem().string();
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
  const fs::path library = out.parent_path() / (name + ".mtl");
  const auto files = render::objAndMtl(mesh, library.filename().string());
  if (!files) return files.failure();
  if (auto written = writeFile(library, files->mtl); !written) return written;
  return writeFile(out, files->obj);
}

Result<void> written(const Result<std::string>& bytes, const fs::path& out) {
  if (!bytes) return bytes.failure();
  return writeFile(out, *bytes);
}

bool isAnimation(const GrowCommand& command, const std::string& ending) { return ending == ".mp4" || ending == ".webm" || command.frames.has_value(); }

Result<void> writeAnimation(const Growing& growing, const GrowCommand& command, const render::PictureOptions& picture) {
  constexpr int kDefaultFrames = 96;
  const render::AnimationOptions animation{.to = growing.endTime, .frames = command.frames.value_or(kDefaultFrames), .picture = picture};
  return render::writeAnimation(command.out, growing.at, animation, terminalWatch());
}

Result<void> grow(const simeco::Grammar& grammar, std::uint64_t seed, const GrowCommand& command) {
  const std::string ending = fs::path(command.out).extension().string();
  const auto growing = growingOf(grammar, seed, command);
  if (!growing) return growing.failure();
  const render::PictureOptions picture{.width_px = command.width, .height_px = command.height, .view = kViews.at(command.view)};
  if (isAnimation(command, ending)) return writeAnimation(*growing, command, picture);
  const auto plant = growing->at(growing->endTime);
  if (!plant) return plant.failure();
  if (ending == ".json") return written(skeletonBytes(*plant), command.out);
  const auto mesh = render::meshOf(*plant);
  if (!mesh) return mesh.failure();
  for (const std::string& note : mesh->notes) std::fprintf(stderr, "axil: note: %s\n", note.c_str());
  if (ending == ".png") return written(pictureBytes(*mesh, picture), command.out);
  if (ending == ".glb") return written(render::glbBytes(*mesh, {.metresPerUnit = document::metresPer(command.unit).value_or(1)}), command.out);
  if (ending == ".ply") return written(render::plyBytes(*mesh), command.out);
  return writeObj(*mesh, command.out);
}

/// Whether OUT names something this command can write; asked before any work.
Result<void> checkOut(const GrowCommand& command) {
  static const char* const endings[] = {".json", ".glb", ".obj", ".ply", ".png", ".mp4", ".webm"};
  const std::string ending = fs::path(command.out).extension().string();
  const bool known = std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
  const bool folder = command.frames && !known;
  if (folder || (known && !(command.frames && ending != ".mp4" && ending != ".webm"))) return {};
  if (known) return fail(ErrorCode::BadInput, "--frames makes a folder of pictures, an .mp4 or a .webm, not " + ending + "; leave --frames out for one " + ending);
  return fail(ErrorCode::BadInput, "cannot tell what to write from '" + command.out + "'; end it in .json, .glb, .obj, .ply, .png, .mp4 or .webm, or give --frames for a folder of pictures");
}

}  // namespace

int run(const GrowCommand& command) {
  if (const auto out = checkOut(command); !out) return report(out.error());
  auto grammar = grammarIn(command.grammar);
  if (!grammar) return report(grammar.error());
  const auto plant = plantNamed(*grammar, command.plant);
  if (!plant) return report(plant.error());
  if (!command.plant.empty()) grammar->plants = {std::move(grammar->plants[*plant])};
  const auto grown = grow(*grammar, seedOf(command.seed, *plant), command);
  if (!grown) return report(grown.error());
  endProgress();
  return 0;
}

// ---- build -----------------------------------------------------------------------------------------------------------

namespace {

std::string summary(const document::BuildReport& r, const std::string& folder) {
  char numbers[400];
  std::snprintf(numbers, sizeof numbers,
                "%s: %zu nodes, %zu stems, %zu segments, %zu leaves; %.3g high. Clicks within %.2f px of their nodes; regrown within %.1e of the height.\n",
                r.name.c_str(), r.nodes, r.stems, r.segments, r.leaves, r.height, r.worstReprojection_px, r.height > 0 ? r.worstRegrown / r.height : 0.0);
  std::string text = numbers;
  for (const std::string& note : r.notes) text += "Note: " + note + "\n";
  text += "Written to " + folder + ":\n";
  for (const std::string& file : r.files) text += "  " + file + "\n";
  return text;
}

}  // namespace

int run(const BuildCommand& command) {
  const auto open = document::loadProject(command.project);
  if (!open) return report(open.error());
  document::BuildOptions options;
  options.chain.watch = terminalWatch();
  options.frames = command.frames;
  options.video = command.video ? document::Video::Mp4 : document::Video::None;
  const auto built = document::build(*open, command.out, options);
  if (!built) return report(built.error());
  endProgress();
  std::fputs(summary(*built, command.out).c_str(), stderr);
  return 0;
}

}  // namespace axil::app
