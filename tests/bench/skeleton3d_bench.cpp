#include "base/rng.hpp"
#include "skeleton3d/bundle.hpp"
#include "skeleton3d/skeleton3d.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace axil::skeleton3d {
namespace {

struct Clicks {
  std::vector<View> views;
  std::map<std::string, UnknownCameraHints> hints;
  std::vector<ClickedNode> nodes;
  std::vector<ClickedStem> stems;
};

/// A stem with branches of 20 segments each, seen by three perspective cameras with a little distortion; clicks of 1 px noise.
Clicks clicksOf(int segments) {
  Clicks made;
  Rng rng(1);
  for (const char* name : {"front", "right", "top"}) {
    View view{name, *nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 2200}), {1200, 1600}};
    view.camera.distortion = {-0.05, 0.01, 0.001, 0.001, 0};
    made.hints[name] = {project(view.camera, {{0, 0, 0}}), KnownLength{project(view.camera, {{0.1, 0, 0.1}}), project(view.camera, {{0.1, 0.3, 0.13}}), 0.3015}, std::nullopt};
    made.views.push_back(view);
  }
  for (int i = 0; i <= segments; ++i) {
    const int branch = i / 20, along = i % 20;
    const double up = branch == 0 ? 0.05 * along : 0.9 * branch / (segments / 20.0) + 0.005 * along, out = branch == 0 ? 0 : 0.02 * along + 0.01;
    ClickedNode node{NodeId(i), {}, std::nullopt};
    for (const View& view : made.views) {
      node.clicks[view.name] = project(view.camera, {{out * std::cos(2.4 * branch), up, out * std::sin(2.4 * branch)}});
      node.clicks[view.name].px += glm::dvec2{rng.normal(), rng.normal()};
    }
    made.nodes.push_back(node);
    if (along == 0) made.stems.push_back({StemId(branch), branch == 0 ? std::vector<NodeId>{} : std::vector{NodeId(1 + branch % 19)}});
    made.stems.back().nodes.push_back(NodeId(i));
  }
  return made;
}

void solveNodesBenchmark(benchmark::State& state) {
  const Clicks clicks = clicksOf(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(solveNodes(clicks.views, clicks.nodes).has_value());
}
BENCHMARK(solveNodesBenchmark)->Name("skeleton3d/solve_nodes")->Arg(300)->Arg(2000)->Unit(benchmark::kMillisecond);

void buildSkeletonBenchmark(benchmark::State& state) {
  const Clicks clicks = clicksOf(static_cast<int>(state.range(0)));
  if (const auto tree = buildSkeleton(clicks.views, clicks.nodes, clicks.stems); !tree) state.SkipWithError(tree.error().message.c_str());
  for (auto _ : state) benchmark::DoNotOptimize(buildSkeleton(clicks.views, clicks.nodes, clicks.stems).has_value());
}
BENCHMARK(buildSkeletonBenchmark)->Name("skeleton3d/build_skeleton")->Arg(2000)->Unit(benchmark::kMillisecond);

Clicks unknownOf(Clicks clicks) {
  for (View& view : clicks.views) {
    view.camera.model = CameraModel::Unknown;
    view.camera.focal_px = glm::dvec2{2190, 2190};
  }
  return clicks;
}

/// One bundle adjustment, from the linear guess to where it stands still.
void adjustBundleBenchmark(benchmark::State& state) {
  const Clicks clicks = unknownOf(clicksOf(static_cast<int>(state.range(0))));
  const auto gathered = detail::gatherBundle(clicks.views, clicks.hints, clicks.nodes, {});
  const auto guess = gathered ? detail::guessBundle(*gathered) : gathered;
  if (!guess) {
    state.SkipWithError(guess.error().message.c_str());
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(detail::adjustBundle(*guess, {.click_px = 1, .loss = 4}).has_value());
}
BENCHMARK(adjustBundleBenchmark)->Name("skeleton3d/adjust_bundle")->Arg(500)->Unit(benchmark::kMillisecond);

/// The whole: guess, scatter of the clicks, wrong clicks, known lengths, covariance.
void estimateCamerasBenchmark(benchmark::State& state) {
  const Clicks clicks = unknownOf(clicksOf(static_cast<int>(state.range(0))));
  if (const auto cameras = estimateCameras(clicks.views, clicks.hints, clicks.nodes); !cameras) state.SkipWithError(cameras.error().message.c_str());
  for (auto _ : state) benchmark::DoNotOptimize(estimateCameras(clicks.views, clicks.hints, clicks.nodes).has_value());
}
BENCHMARK(estimateCamerasBenchmark)->Name("skeleton3d/estimate_cameras")->Arg(500)->Unit(benchmark::kMillisecond);

/// A photo of 12 megapixels: bent stems of 6 to 60 px before a grainy wall.
std::shared_ptr<const Photo> largePhoto() {
  auto photo = std::make_shared<Photo>(Photo{4000, 3000, {}});
  photo->rgb.resize(std::size_t{3} * 4000 * 3000);
  Rng rng(7);
  for (std::uint8_t& byte : photo->rgb) byte = static_cast<std::uint8_t>(196 + 6 * rng.uniform());
  for (int stem = 0; stem < 12; ++stem)
    for (int y = 200; y < 2800; ++y) {
      const double middle = 300 + 290 * stem + 120 * std::sin(0.003 * y + stem), half = 3 + 2.2 * stem;
      for (int x = static_cast<int>(middle - half); x < static_cast<int>(middle + half); ++x) {
        std::uint8_t* rgb = photo->rgb.data() + 3 * (static_cast<std::size_t>(y) * 4000 + static_cast<std::size_t>(x));
        rgb[0] = 70, rgb[1] = 120, rgb[2] = 50;
      }
    }
  return photo;
}

PhotoPoint onStem(int stem, double y) { return {{300 + 290 * stem + 120 * std::sin(0.003 * y + stem), y}}; }

void prepareWireBenchmark(benchmark::State& state) {
  const auto photo = largePhoto();
  for (auto _ : state) benchmark::DoNotOptimize(prepareLiveWire(photo).has_value());
}
BENCHMARK(prepareWireBenchmark)->Name("skeleton3d/prepare_live_wire_12_megapixels")->Unit(benchmark::kMillisecond)->Iterations(2);

void startWireBenchmark(benchmark::State& state) {
  const auto wire = prepareLiveWire(largePhoto());
  for (auto _ : state) benchmark::DoNotOptimize(startWire(*wire, onStem(4, 300)).has_value());
}
BENCHMARK(startWireBenchmark)->Name("skeleton3d/start_live_wire_12_megapixels")->Unit(benchmark::kMillisecond);

/// One move of the mouse, 2400 px away along the stem.
void wireToBenchmark(benchmark::State& state) {
  const auto wire = prepareLiveWire(largePhoto());
  const int stem = static_cast<int>(state.range(0));
  const auto start = startWire(*wire, onStem(stem, 300));
  for (auto _ : state) benchmark::DoNotOptimize(wireTo(*start, onStem(stem, 2700)).nodes.size());
}
BENCHMARK(wireToBenchmark)->Name("skeleton3d/live_wire_step_12_megapixels")->Arg(0)->Arg(4)->Arg(11)->Unit(benchmark::kMillisecond);

void snapClickBenchmark(benchmark::State& state) {
  const auto photo = largePhoto();
  const int stem = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(snapClick(*photo, {onStem(stem, 900).px + glm::dvec2{4, 1}}).has_value());
}
BENCHMARK(snapClickBenchmark)->Name("skeleton3d/snap_click_12_megapixels")->Arg(0)->Arg(4)->Arg(11)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace axil::skeleton3d
