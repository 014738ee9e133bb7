#include "app/cli_interop.hpp"
#include "app/commands.hpp"
#include "app/grammar_options.hpp"
#include "app/terminal.hpp"
#include "document/plant_file.hpp"
#include "quantify/compare.hpp"
#include "quantify/layers.hpp"
#include "quantify/stalks.hpp"
#include "render/render.hpp"
#include "simeco/simeco.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numbers>

namespace axil::app {

namespace {

namespace fs = std::filesystem;
using quantify::Measurements;

struct CompareCommand {
  std::string a, b;
  std::vector<std::string> views;
  quantify::CompareOptions options;
  std::uint64_t seed = 1;
  int seeds = 1;
  bool json = false;
};

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr const char* kNoUnit = "";  // of plants that grammars grow: numbers alone
const std::map<std::string, quantify::SilhouetteView> kViews = {
    {"front", quantify::SilhouetteView::Front}, {"right", quantify::SilhouetteView::Right}, {"top", quantify::SilhouetteView::Top}};

/// The plant that a grammar grows, measured as a skeleton.
Result<Measurements> grownPlant(const std::string& path, std::uint64_t seed) {
  const auto grammar = grammarIn(path);
  if (!grammar) return grammar.failure();
  Result<simeco::Plant> plant = fail(ErrorCode::BadGrammar, "the grammar has no plant");
  if (grammar->language == simeco::Language::LSystem) {
    const auto view = simeco::viewBeside(path);
    if (!view) return view.failure();
    simeco::LSystemPlantOptions options;
    options.derive.view = *view;
    options.derive.derive.seed = seed;
    plant = simeco::plantOfLSystem(*grammar, options);
  } else {
    simeco::GrowOptions options;
    options.seed = seed;
    const auto growth = simeco::prepareGrowth(*grammar, options);
    if (!growth) return growth.failure();
    plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  }
  if (!plant) return plant.failure();
  const auto skeleton = render::skeletonOf(*plant);
  if (!skeleton) return skeleton.failure();
  auto measured = quantify::measure(quantify::withoutStalks(*skeleton));
  if (measured) measured->unit = kNoUnit;
  return measured;
}

bool isGrammar(const fs::path& path) { return path.extension() == ".simeco" || path.extension() == ".l"; }
bool isPlant(const fs::path& path) { return isGrammar(path) || path.extension() == ".axil" || path.extension() == ".json"; }

/// The plants of one side: of a file one, of a grammar as many as there are seeds, of a folder those of all its files.
Result<std::vector<Measurements>> plantsOf(const fs::path& path, const CompareCommand& command) {
  std::vector<fs::path> files{path};
  std::error_code none;
  if (fs::is_directory(path, none)) {
    files.clear();
    for (const auto& entry : fs::directory_iterator(path, none))
      if (isPlant(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty()) return fail(ErrorCode::BadInput, path.string() + " has no plant; it needs .axil, .json, .simeco or .l files");
  }
  std::vector<Measurements> plants;
  for (const fs::path& file : files) {
    for (int seed = 0; seed < (isGrammar(file) ? command.seeds : 1); ++seed) {
      auto plant = isGrammar(file) ? grownPlant(file.string(), command.seed + static_cast<std::uint64_t>(seed)) : [&]() -> Result<Measurements> {
        auto read = document::readPlant(file);
        if (!read) return read.failure();
        return std::move(read->measurements);
      }();
      if (!plant) return fail(Error{plant.error().code, file.string() + ": " + plant.error().message, plant.error().details});
      plants.push_back(*std::move(plant));
    }
  }
  return plants;
}

using Json = nlohmann::ordered_json;

Json deviationJson(const quantify::Deviation& d, double factor) {
  return Json{{"mean", d.mean * factor}, {"worst", d.worst * factor}, {"samples", d.samples}};
}
Json comparisonJson(const quantify::PlantComparison& c, const CompareCommand& command) {
  Json json{{"height", c.height},
            {"tolerance", command.options.tolerance},
            {"nodes", {{"a", c.nodesA}, {"b", c.nodesB}, {"matched", c.matched}, {"precision", c.precision}, {"recall", c.recall}}},
            {"place", deviationJson(c.place, 1)},
            {"length", deviationJson(c.length, 1)},
            {"angle_deg", deviationJson(c.angle, kDegrees)},
            {"branch_divergence_deg", c.branchDivergence ? Json(*c.branchDivergence * kDegrees) : Json()},
            {"leaf_divergence_deg", c.leafDivergence ? Json(*c.leafDivergence * kDegrees) : Json()},
            {"tree_edit_distance", c.treeEdit ? Json(*c.treeEdit) : Json()}};
  for (std::size_t v = 0; v < c.silhouettes.size(); ++v) json["silhouette_iou"][command.views[v]] = c.silhouettes[v];
  return json;
}

std::string line(const char* format, auto... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return std::string(text) + "\n";
}

std::string comparisonText(const quantify::PlantComparison& c, const CompareCommand& command) {
  std::string text = line("nodes       %zu and %zu; %zu the same within %.3g %% of the height: precision %.3f, recall %.3f", c.nodesA, c.nodesB, c.matched,
                          100 * command.options.tolerance, c.precision, c.recall);
  text += line("place       off by %.3g on average, %.3g at worst (height %.3g)", c.place.mean, c.place.worst, c.height);
  text += line("length      off by %.3g on average, %.3g at worst, on %zu segments", c.length.mean, c.length.worst, c.length.samples);
  text += line("direction   off by %.3g degrees on average, %.3g at worst", c.angle.mean * kDegrees, c.angle.worst * kDegrees);
  if (c.branchDivergence) text += line("divergence  of branches off by %.3g degrees", *c.branchDivergence * kDegrees);
  if (c.leafDivergence) text += line("divergence  of leaves off by %.3g degrees", *c.leafDivergence * kDegrees);
  text += c.treeEdit ? line("tree edit   %zu segments to insert, delete or change", *c.treeEdit)
                     : line("tree edit   left out: more than %zu pairs of segments", command.options.mostPairs);
  for (std::size_t v = 0; v < c.silhouettes.size(); ++v) text += line("silhouette  %s: IoU %.3f", command.views[v].c_str(), c.silhouettes[v]);
  return text;
}

Json setsJson(const quantify::SetComparison& all, std::size_t a, std::size_t b) {
  Json json{{"plants", {{"a", a}, {"b", b}}}, {"p", all.p}, {"exchanges", all.exchanges}, {"distributions", Json::array()}};
  for (const auto& d : all.distances)
    json["distributions"].push_back({{"quantity", d.quantity}, {"samples_a", d.samplesA}, {"samples_b", d.samplesB}, {"mean_a", d.meanA}, {"mean_b", d.meanB}, {"ks", d.ks}, {"p", d.p},
                                     {"p_independent", d.pIndependent}, {"wasserstein", d.wasserstein}});
  return json;
}
std::string setsText(const quantify::SetComparison& all, std::size_t a, std::size_t b) {
  std::string text = line("%zu and %zu plants                     mean A      mean B   samples A   samples B          KS           p  Wasserstein", a, b);
  for (const auto& d : all.distances)
    if (d.samplesA + d.samplesB > 0)
      text += line("%-30s %11.4g %11.4g %11zu %11zu %11.3f %11.3g %12.3g", d.quantity.c_str(), d.meanA, d.meanB, d.samplesA, d.samplesB, d.ks, d.p, d.wasserstein);
  text += all.exchanges > 0 ? line("p = %.3g that all are alike (%zu exchanges of plants between the sets)", all.p, all.exchanges)
                            : line("p = %.3g that all are alike (too few plants to exchange: as if samples were independent)", all.p);
  return text + "lengths are shares of the mean height of A; angles are radians\n";
}

/// All plants of both sides in one unit. A grammar's numbers are in the unit that a measured plant has.
Result<std::vector<Measurements>> inOneUnit(std::vector<Measurements> plants) {
  const auto measured = std::find_if(plants.begin(), plants.end(), [](const Measurements& m) { return m.unit != kNoUnit; });
  const std::string unit = measured == plants.end() ? "m" : measured->unit;
  for (Measurements& m : plants)
    if (m.unit == kNoUnit) m.unit = unit;
  std::vector<std::string> warnings;
  auto same = quantify::inOneUnit(plants, warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "axil: warning: %s\n", warning.c_str());
  return same;
}

int run(const CompareCommand& given) {
  CompareCommand command = given;
  if (command.views.empty()) command.views = {"front", "right", "top"};
  command.options.views.clear();
  for (const std::string& view : command.views) command.options.views.push_back(kViews.at(view));
  auto a = plantsOf(command.a, command);
  if (!a) return report(a.error());
  auto b = plantsOf(command.b, command);
  if (!b) return report(b.error());
  std::vector<Measurements> both = *a;
  both.insert(both.end(), b->begin(), b->end());
  const auto same = inOneUnit(std::move(both));
  if (!same) return report(same.error());
  const auto middle = same->begin() + static_cast<std::ptrdiff_t>(a->size());
  a->assign(same->begin(), middle);
  b->assign(middle, same->end());
  if (a->size() > 1 || b->size() > 1) {
    const auto distances = quantify::compareSets(*a, *b);
    if (!distances) return report(distances.error());
    return print(command.json ? setsJson(*distances, a->size(), b->size()).dump(2) + "\n" : setsText(*distances, a->size(), b->size()));
  }
  const auto comparison = quantify::comparePlants(a->front(), b->front(), command.options);
  if (!comparison) return report(comparison.error());
  return print(command.json ? comparisonJson(*comparison, command).dump(2) + "\n" : comparisonText(*comparison, command));
}

}  // namespace

void addCompare(CLI::App& sub, int& status) {
  auto& command = onCall<CompareCommand>(sub, status, run);
  addExamples(sub, "  axil compare plant.axil initial.simeco            # is the measured plant regrown?\n"
                   "  axil compare measured/ structured.simeco --seeds 20 --json   # two sets of plants: their distributions");
  sub.add_option("A", command.a, "A project, skeleton.json or grammar (.simeco, .l), or a folder of them")->required();
  sub.add_option("B", command.b, "What it is compared with")->required();
  sub.add_option("--tolerance", command.options.tolerance, "Within which nodes are the same, as a share of A's height")->check(CLI::Range(1e-9, 1.0))->capture_default_str();
  sub.add_option("--views", command.views, "Of the silhouettes: front, right, top")->delimiter(',')->check(CLI::IsMember({"front", "right", "top"}));
  sub.add_option("--seed", command.seed, "Of what grammars draw by chance")->capture_default_str();
  sub.add_option("--seeds", command.seeds, "Grow so many plants of each grammar, from the seed on")->check(CLI::Range(1, 10000))->capture_default_str();
  sub.add_flag("--json", command.json, "Print JSON");
}

}  // namespace axil::app
