// What a click in the window sets off, all but the drawing: the command, then skeleton, measurements, three grammars and their growth.
#include "document/session.hpp"
#include "skeleton3d/camera.hpp"
#include "ui/following.hpp"
#include "ui/headless.hpp"
#include "ui/photo_tiles.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace axil::ui {
namespace {

/// A trunk with winding branches of 20 segments each, clicked in three views whose cameras are known.
document::Project plantOf(int segments) {
  document::Project project;
  for (const char* name : {"front", "right", "top"}) {
    document::ProjectView view;
    view.view = {name, *skeleton3d::nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 2200}), {1200, 1600}};
    project.views.push_back(view);
  }
  std::vector<document::ProjectStem> stems;
  for (int i = 0; i <= segments; ++i) {
    const int branch = i / 20, along = i % 20;
    const double turn = 2.4 * branch + 0.05 * along;
    const double up = branch == 0 ? 0.045 * along : 0.045 * (1 + branch % 19) + 0.004 * along, out = branch == 0 ? 0.001 * along : 0.02 * along + 0.01;
    document::ProjectNode node;
    node.node.id = document::NodeId(i + 1);
    for (const auto& view : project.views) node.node.clicks[view.view.name] = skeleton3d::project(view.view.camera, {{out * std::cos(turn), up, out * std::sin(turn)}});
    project.nodes.push_back(node);
    if (along == 0) {
      stems.emplace_back();
      stems.back().stem.id = document::StemId(branch + 1);
      if (branch > 0) stems.back().stem.nodes.emplace_back(2 + branch % 19);
    }
    stems.back().stem.nodes.emplace_back(i + 1);
  }
  for (const auto& stem : stems) project.stems.push_back(stem);
  return project;
}

void clickToGrammar(benchmark::State& state) {
  auto session = document::Session::untitled({.stateFolder = {}, .chain = {}}, plantOf(static_cast<int>(state.range(0))));
  const auto& node = session.project().nodes[session.project().nodes.size() / 2].node;
  const auto id = node.id;
  const PhotoPoint at = node.clicks.begin()->second;
  const std::string view = node.clicks.begin()->first;
  const auto follow = followingWork();
  std::uint64_t revision = 1;
  bool there = false;
  std::size_t lines = 0;
  for (auto _ : state) {
    there = !there;
    if (!session.run(document::MoveClick{id, view, {at.px + glm::dvec2(there ? 1 : 0, 0)}})) state.SkipWithError("the click was refused");
    const auto following = follow({session.openProject(), ++revision});
    const auto* grown = following->grammar(document::GrammarKind::Initial);
    if (grown == nullptr || following->skeleton.trouble) state.SkipWithError(following->skeleton.trouble ? following->skeleton.trouble->message.c_str() : "there is no grammar");
    else lines = grown->segments.size();
  }
  state.counters["lines"] = static_cast<double>(lines);
}
BENCHMARK(clickToGrammar)->Arg(500)->Unit(benchmark::kMillisecond);

/// A 24-megapixel photo with something to see, as the plainest of files.
void writePhoto(const std::filesystem::path& file) {
  constexpr std::uint32_t kWidth = 4000, kHeight = 6000, kHeader = 54;
  std::string bytes(kHeader + std::size_t{kWidth} * kHeight * 3, '\0');
  const auto put = [&](std::size_t at, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i) & 255);
  };
  bytes[0] = 'B', bytes[1] = 'M';
  put(2, static_cast<std::uint32_t>(bytes.size()), 4), put(10, kHeader, 4), put(14, 40, 4), put(18, kWidth, 4), put(22, kHeight, 4), put(26, 1, 2), put(28, 24, 2);
  for (std::size_t i = kHeader; i < bytes.size(); ++i) bytes[i] = static_cast<char>((i / 3 % kWidth / 7 * 31 + i / 3 / kWidth / 5 * 17) & 255);
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A frame of the whole window while a 24-megapixel photo is moved under three panes of such photos; argument: percent of zoom, 0 for the whole photo.
void frameWhilePanning(benchmark::State& state) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "axil_bench_photos";
  std::filesystem::create_directories(folder);
  for (const char* view : {"front", "right", "top"})
    if (!std::filesystem::exists(folder / (std::string(view) + ".bmp"))) writePhoto(folder / (std::string(view) + ".bmp"));
  auto headless = HeadlessStudio::open({}, 1440, 900);
  if (!headless) return state.SkipWithError(headless.error().message.c_str());
  for (const char* view : {"front", "right", "top"}) (void)headless->studio().runLine("add_view " + std::string(view) + " \"" + (folder / (std::string(view) + ".bmp")).string() + "\"");
  headless->studio().state().trace = false;
  if (auto shown = headless->run("ui way stems\nui wait\n"); !shown) return state.SkipWithError(shown.error().message.c_str());
  const double zoom = static_cast<double>(state.range(0)) / 100;
  double at = 0;
  for (auto _ : state) {
    at += 6;
    if (zoom > 0)
      for (const char* view : {"front", "right", "top"}) headless->studio().state().frames[view] = {.zoom = zoom, .centre = {1500 + std::fmod(at, 1200.0), 3000}};
    headless->drawFrame();
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(frameWhilePanning)->Arg(0)->Arg(30)->Arg(100)->Arg(300)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

/// What a 24-megapixel photo costs before it can be shown; in the background.
void levelsOfAPhoto(benchmark::State& state) {
  const skeleton3d::Photo photo{6000, 4000, std::vector<std::uint8_t>(std::size_t{6000} * 4000 * 3, 90)};
  for (auto _ : state) benchmark::DoNotOptimize(photoLevels(photo));
}
BENCHMARK(levelsOfAPhoto)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace axil::ui
