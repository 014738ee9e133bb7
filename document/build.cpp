#include "document/build.hpp"

#include "base/files.hpp"
#include "base/units.hpp"
#include "document/json_lines.hpp"
#include "document/plots.hpp"
#include "document/skeleton_file.hpp"
#include "document/statistics_file.hpp"
#include "document/traits.hpp"
#include "quantify/contradictions.hpp"
#include "render/render.hpp"
#include "simeco/simeco.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace axil::document {

namespace {

namespace fs = std::filesystem;
using simeco::Grammar;
using simeco::Growth;
using skeleton3d::Skeleton;

constexpr GrammarKind kKinds[] = {GrammarKind::Initial, GrammarKind::Predictive, GrammarKind::Structured};

/// Collects what is made, in a folder that appears only when all is well.
struct Output {
  StagingFolder staging;
  std::vector<std::string> files = {};
  std::vector<std::string> notes = {};

  bool has(const std::string& name) const { return std::find(files.begin(), files.end(), name) != files.end(); }
  Result<void> write(const std::string& name, const std::string& content) {
    files.push_back(name);
    return writeFile(staging.path() / name, content);
  }
};

double heightOf(const Skeleton& skeleton) {
  double low = 0, high = 0;
  for (const auto& node : skeleton.nodes) {
    low = std::min(low, node.position.at.y);
    high = std::max(high, node.position.at.y);
  }
  return high - low;
}

double worstReprojection(const Skeleton& skeleton) {
  double worst = 0;
  for (const auto& node : skeleton.nodes)
    for (const auto& [view, px] : node.reprojection_px) worst = std::max(worst, px);
  return worst;
}

/// Largest distance of a segment's upper node from the nearest tip that the grammar grew.
double worstDistance(const Skeleton& skeleton, const simeco::Plant& plant) {
  double worst = 0;
  for (const auto& node : skeleton.nodes) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const simeco::Organ& organ : plant.organs) {
      if (organ.kind != simeco::OrganKind::Stem) continue;
      nearest = std::min({nearest, glm::distance(organ.tip().at, node.position.at), glm::distance(organ.base.at, node.position.at)});
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// The grammars of a plant. A plant that shows no way on (a single segment) has no predictive one: that is noted, and no failure.
Result<std::map<GrammarKind, Grammar>> writeGrammars(Output& output, const Project& project, const quantify::Measurements& measurements,
                                                     const ChainOptions& options) {
  std::map<GrammarKind, Grammar> grammars;
  for (const GrammarKind kind : kKinds) {
    auto grammar = grammarOf(project, measurements, kind, options);
    if (!grammar && kind != GrammarKind::Initial && grammar.error().code == ErrorCode::NoAnswer) {
      output.notes.push_back(std::string("there is no ") + nameOf(kind) + " grammar: " + grammar.error().message);
      continue;
    }
    if (!grammar) return grammar.failure();
    if (auto written = output.write(std::string(nameOf(kind)) + ".simeco", simeco::print(*grammar)); !written) return written.failure();
    grammars.emplace(kind, std::move(*grammar));
  }
  return grammars;
}

Result<Growth> growthOf(const Grammar& grammar, const Project& project, const ChainOptions& options) {
  return simeco::prepareGrowth(grammar, {.seed = project.seed, .limits = options.limits, .watch = options.watch, .turning = options.turning});
}

/// What the furthest-reaching grammar grows: the predictive one, where there is one.
Result<simeco::Plant> nextOf(const std::map<GrammarKind, Grammar>& grammars, const Project& project, const ChainOptions& options) {
  const GrammarKind kind = grammars.contains(GrammarKind::Predictive) ? GrammarKind::Predictive : GrammarKind::Initial;
  const auto growth = growthOf(grammars.at(kind), project, options);
  if (!growth) return growth.failure();
  return simeco::plantAt(*growth, simeco::completeTime(*growth));
}

Result<void> writePicture(Output& output, const char* name, const render::PlantMesh& mesh, const render::PictureOptions& look) {
  const auto image = render::drawPlant(mesh, look);
  if (!image) return image.failure();
  const auto bytes = render::pngBytes(*image);
  if (!bytes) return bytes.failure();
  return output.write(name, *bytes);
}

/// The growth as pictures, and as a video where one is wanted.
Result<void> writeGrowth(Output& output, const Growth& growth, const render::PictureOptions& look, const BuildOptions& options) {
  constexpr int kVideoFrames = 96;
  const auto at = [&growth](double time) { return simeco::plantAt(growth, time); };
  // The first picture shows something already: nothing has grown at time 0.
  const double end = simeco::completeTime(growth);
  render::AnimationOptions animation{.from = end / options.frames, .to = end, .frames = options.frames};
  animation.picture = look;
  const fs::path folder = output.staging.path();
  if (auto written = render::writeAnimation(folder / "growth", at, animation, options.chain.watch); !written) return written;
  for (const auto& entry : fs::directory_iterator(folder / "growth")) output.files.push_back("growth/" + entry.path().filename().string());
  std::sort(output.files.end() - options.frames, output.files.end());
  if (options.video == Video::None) return {};
  animation.from = 0;
  animation.frames = kVideoFrames;
  output.files.emplace_back("growth.mp4");
  return render::writeAnimation(folder / "growth.mp4", at, animation, options.chain.watch);
}

std::string reportText(const BuildReport& report) {
  nlohmann::ordered_json json = {{"axil_report", 1}, {"name", report.name}, {"unit", report.unit}, {"nodes", report.nodes}, {"stems", report.stems},
                                 {"segments", report.segments}, {"leaves", report.leaves}, {"height", report.height},
                                 {"worst_reprojection_px", report.worstReprojection_px}, {"worst_regrown", report.worstRegrown},
                                 {"suspect_clicks", nlohmann::ordered_json::array()}, {"notes", report.notes}, {"files", report.files}};
  for (const auto& click : report.suspects) json["suspect_clicks"].push_back({{"node", click.node.value}, {"view", click.view}, {"off_px", click.off_px}});
  return jsonLines(json);
}

/// The measured plant and what it grows into, seen by one camera over one floor, so that all pictures can be laid over each other.
struct Grown {
  Growth growth;
  simeco::Plant plant;
  render::PlantMesh mesh;
  render::PlantMesh next;
  render::PictureOptions look;
};

Result<Grown> grow(const std::map<GrammarKind, Grammar>& grammars, const Project& project, const BuildOptions& options) {
  const auto growth = growthOf(grammars.at(GrammarKind::Initial), project, options.chain);
  if (!growth) return growth.failure();
  auto plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  if (!plant) return plant.failure();
  const auto next = nextOf(grammars, project, options.chain);
  if (!next) return next.failure();
  auto mesh = render::meshOf(*plant);
  if (!mesh) return mesh.failure();
  auto nextMesh = render::meshOf(*next);
  if (!nextMesh) return nextMesh.failure();
  const render::PictureOptions look{.width_px = options.width, .height_px = options.height,
                                    .view = render::cameraFitting(*nextMesh, render::ViewPreset::ThreeQuarter, options.width, options.height),
                                    .floorHeight = render::floorUnder(*nextMesh)};
  return Grown{*growth, std::move(*plant), std::move(*mesh), std::move(*nextMesh), look};
}

Result<void> draw(Output& output, const Grown& grown, const BuildOptions& options) {
  if (auto written = writePicture(output, "plant.png", grown.mesh, grown.look); !written) return written;
  if (output.has("predictive.simeco"))
    if (auto written = writePicture(output, "predicted.png", grown.next, grown.look); !written) return written;
  return writeGrowth(output, grown.growth, grown.look, options);
}

Result<void> writeMesh(Output& output, const render::PlantMesh& mesh, const std::string& unit) {
  const auto metres = metresPer(unit);
  if (!metres) output.notes.push_back("the unit '" + unit + "' is none of m, dm, cm, mm, in and ft; plant.glb takes it for a metre");
  const auto glb = render::glbBytes(mesh, {.metresPerUnit = metres.value_or(1)});
  if (!glb) return glb.failure();
  return output.write("plant.glb", *glb);
}

Result<BuildReport> finish(Output& output, BuildReport report) {
  output.files.emplace_back("report.json");
  report.files = output.files;
  report.notes = output.notes;
  if (auto written = writeFile(output.staging.path() / "report.json", reportText(report)); !written) return written.failure();
  if (auto published = output.staging.publish(); !published) return published.failure();
  return report;
}

/// The plant's statistics by order and rank, as numbers and as charts.
Result<void> writeLayers(Output& output, const quantify::Measurements& measurements) {
  const auto statistics = quantify::layeredStatistics(std::span(&measurements, 1));
  if (!statistics) return statistics.failure();
  if (auto written = output.write("statistics.json", statisticsJson(*statistics)); !written) return written;
  const auto charts = statisticsPlot(*statistics);
  if (!charts) return charts.failure();
  return output.write("layers.png", *charts);
}

BuildReport reportOn(const Project& project, const Skeleton& skeleton, const quantify::Measurements& measurements, const simeco::Plant& plant) {
  BuildReport report;
  report.name = project.name;
  report.unit = project.unit;
  report.nodes = skeleton.nodes.size();
  report.stems = skeleton.stems.size();
  report.segments = measurements.segments.size();
  report.leaves = skeleton.leaves.size();
  report.height = heightOf(skeleton);
  report.worstReprojection_px = worstReprojection(skeleton);
  report.worstRegrown = worstDistance(skeleton, plant);
  return report;
}

}  // namespace

Result<BuildReport> build(const OpenProject& open, const fs::path& folder, const BuildOptions& options) {
  const auto clicks = measured(open, options.chain);
  if (!clicks) return clicks.failure();
  const auto skeleton = skeletonOf(open.project, *clicks, options.chain);
  if (!skeleton) return skeleton.failure();
  const auto measurements = measurementsOf(*skeleton, options.chain);
  if (!measurements) return measurements.failure();
  auto staging = StagingFolder::beside(folder);
  if (!staging) return staging.failure();
  Output output{std::move(*staging)};
  if (auto w = output.write("skeleton.json", skeletonText(*skeleton)); !w) return w.failure();
  if (auto w = output.write("stems.csv", quantify::segmentsCsv(*measurements)); !w) return w.failure();
  if (auto w = writeLayers(output, *measurements); !w) return w.failure();
  const auto said = traitsOf(open.project);
  if (!said) return said.failure();
  for (std::string& line : waitingLines(*skeleton, clicks->suspects)) output.notes.push_back(std::move(line));
  for (const auto& contradiction : quantify::contradictionsWith(*said, *measurements)) output.notes.push_back(contradiction.line());
  options.chain.watch.report("writing the grammars", 0.1);
  const auto grammars = writeGrammars(output, open.project, *measurements, options.chain);
  if (!grammars) return grammars.failure();
  options.chain.watch.report("growing", 0.2);
  const auto grown = grow(*grammars, open.project, options);
  if (!grown) return grown.failure();
  options.chain.watch.report("drawing", 0.3);
  if (auto w = draw(output, *grown, options); !w) return w.failure();
  if (auto w = writeMesh(output, grown->mesh, open.project.unit); !w) return w.failure();
  output.notes.insert(output.notes.end(), grown->mesh.notes.begin(), grown->mesh.notes.end());
  BuildReport report = reportOn(open.project, *skeleton, *measurements, grown->plant);
  report.suspects = clicks->suspects;
  return finish(output, std::move(report));
}

}  // namespace axil::document
