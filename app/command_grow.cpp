#include "app/cli_interop.hpp"
#include "app/commands.hpp"
#include "app/described_grammar.hpp"
#include "app/environment_options.hpp"
#include "app/grammar_options.hpp"
#include "app/project_options.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "base/units.hpp"
#include "document/skeleton_file.hpp"
#include "render/render.hpp"
#include "simeco/growth_attributes.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
#include <map>
#include <memory>

namespace axil::app {

namespace {

namespace fs = std::filesystem;
using simeco::Plant;

struct GrowCommand {
  std::string grammar;
  std::string plant;  ///< its name; empty: all of them
  std::optional<double> time;
  std::optional<std::int64_t> steps;
  std::uint64_t seed = 1;
  std::optional<int> frames;
  std::string out;
  std::string view = "quarter";
  std::string unit = "m";  ///< of the grammar's lengths
  int width = 1200;
  int height = 1600;
  simeco::Environment environment;
  TurningRule turning = TurningRule::Exact;
  simeco::Limits limits;
};

const std::map<std::string, render::ViewPreset> kViews = {{"front", render::ViewPreset::Front},
                                                          {"right", render::ViewPreset::Right},
                                                          {"top", render::ViewPreset::Top},
                                                          {"quarter", render::ViewPreset::ThreeQuarter}};

/// The plant of a grammar at any moment, whichever language it is written in.
struct Growing {
  std::function<Result<Plant>(double time)> at;
  double endTime = 0;
  std::shared_ptr<const Plant> last = {};  ///< the plant at `endTime`, where it is known already; it may be large
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
  auto grown = simeco::plantOfLSystem(grammar, options);
  if (!grown) return grown.failure();
  const auto last = std::make_shared<const Plant>(*std::move(grown));
  return Growing{[grammar, options, last](double time) -> Result<Plant> {
                   if (time >= last->time) return *last;
                   simeco::LSystemPlantOptions earlier = options;
                   earlier.derive.derive.steps = static_cast<std::int64_t>(time);
                   return simeco::plantOfLSystem(grammar, earlier);
                 },
                 last->time, last};
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

/// What stands in the picture beside the plant: what the grammar names, and what the options do.
Result<std::vector<simeco::Obstacle>> obstaclesAround(const simeco::Grammar& grammar, const GrowCommand& command) {
  auto obstacles = simeco::obstaclesIn(grammar);
  if (obstacles) obstacles->insert(obstacles->end(), command.environment.obstacles.begin(), command.environment.obstacles.end());
  return obstacles;
}

Result<std::shared_ptr<const Plant>> plantAtEnd(const Growing& growing) {
  if (growing.last != nullptr) return growing.last;
  auto plant = growing.at(growing.endTime);
  if (!plant) return plant.failure();
  return std::make_shared<const Plant>(*std::move(plant));
}

/// A picture, a mesh or a skeleton, by the file's ending.
Result<void> writePlant(const Plant& plant, const GrowCommand& command, const render::PictureOptions& picture) {
  const std::string ending = fs::path(command.out).extension().string();
  if (ending == ".json") return written(skeletonBytes(plant), command.out);
  const auto mesh = render::meshOf(plant);
  if (!mesh) return mesh.failure();
  for (const std::string& note : mesh->notes) std::fprintf(stderr, "axil: note: %s\n", note.c_str());
  if (ending == ".png") return written(pictureBytes(*mesh, picture), command.out);
  if (ending == ".glb") return render::writeGlb(*mesh, command.out, {.metresPerUnit = metresPer(command.unit).value_or(1)});
  if (ending == ".ply") return written(render::plyBytes(*mesh), command.out);
  return render::writeObj(*mesh, command.out);
}

Result<void> grow(const simeco::Grammar& grammar, std::uint64_t seed, const GrowCommand& command) {
  const std::string ending = fs::path(command.out).extension().string();
  const auto growing = growingOf(grammar, seed, command);
  if (!growing) return growing.failure();
  const auto obstacles = obstaclesAround(grammar, command);
  if (!obstacles) return obstacles.failure();
  const render::PictureOptions picture{.width_px = command.width, .height_px = command.height, .view = kViews.at(command.view), .obstacles = *obstacles};
  if (isAnimation(command, ending)) return writeAnimation(*growing, command, picture);
  const auto plant = plantAtEnd(*growing);
  if (!plant) return plant.failure();
  return writePlant(**plant, command, picture);
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

/// A description's plant is shown in flower where nothing else is asked for.
Result<simeco::Grammar> grammarOf(GrowCommand& command) {
  if (!isDescription(command.grammar)) return grammarIn(command.grammar);
  auto plant = describedPlantIn(command.grammar);
  if (!plant) return plant.failure();
  if (!command.time && !command.steps) command.time = plant->inFlower;
  return std::move(plant->grammar);
}

int run(const GrowCommand& asked) {
  GrowCommand command = asked;
  if (const auto out = checkOut(command); !out) return report(out.error());
  auto grammar = grammarOf(command);
  if (!grammar) return report(grammar.error());
  const auto plant = plantNamed(*grammar, command.plant);
  if (!plant) return report(plant.error());
  if (!command.plant.empty()) grammar->plants = {std::move(grammar->plants[*plant])};
  const auto grown = grow(*grammar, seedOf(command.seed, *plant), command);
  if (!grown) return report(grown.error());
  endProgress();
  return 0;
}

}  // namespace

void addGrow(CLI::App& sub, int& status) {
  auto& command = onCall<GrowCommand>(sub, status, run);
  addExamples(sub, "  axil grow plant.simeco -o plant.png\n  axil grow plant.simeco --time 12.5 -o young.png --view front\n"
                   "  axil grow rose.txt -o rose.png                         # a plant from words alone, in flower\n"
                   "  axil grow plant.simeco --frames 120 -o growth.mp4      # or .webm, or a folder of PNGs\n"
                   "  axil grow plant.simeco -o plant.glb                    # or .obj, .ply, .json\n"
                   "  axil grow plant.simeco -o windy.png --wind 0.5,0,0 --temperature 15 --obstacle sphere:0.2,0.6,0,0.15");
  sub.add_option("GRAMMAR", command.grammar, "A .simeco or .l file, or a description, .txt, of which a typical plant is grown")->required();
  sub.add_option("-o,--out", command.out, "Where to: its ending chooses .json .glb .obj .ply .png .mp4 .webm; with --frames also a folder")->required();
  auto* time = sub.add_option("--time", command.time, "Moment of growth in the grammar's time; by default when all is grown, for a description when it flowers")->check(notNegative());
  sub.add_option("--steps", command.steps, "Stop after this many derivation steps, then let what is there grow out")->check(notNegative())->excludes(time);
  addPlant(sub, command.plant, "all of them");
  addSeed(sub, command.seed);
  addLimits(sub, command.limits);
  sub.add_option("--frames", command.frames, "How many pictures of the growth from nothing to the chosen moment")->check(CLI::Range(2, 100000));
  sub.add_option("--unit", command.unit, "Unit of the grammar's lengths, for .glb, which is in metres")->check(CLI::IsMember({"m", "dm", "cm", "mm"}))->capture_default_str();
  sub.add_option("--view", command.view, "front, right, top or quarter")->check(CLI::IsMember({"front", "right", "top", "quarter"}))->capture_default_str();
  sub.add_option("--width", command.width, "Pixels")->check(CLI::Range(16, 8192))->capture_default_str();
  sub.add_option("--height", command.height, "Pixels")->check(CLI::Range(16, 8192))->capture_default_str();
  addEnvironment(sub, command.environment);
  addLiteral(sub, command.turning);
}

}  // namespace axil::app
