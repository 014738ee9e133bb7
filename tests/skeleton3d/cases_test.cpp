#include "skeleton3d/tree.hpp"

#include "skeleton3d/camera.hpp"
#include "skeleton3d/linear_least_squares.hpp"
#include "support/cases.hpp"
#include "support/shared_data.hpp"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr const char* kCameras[] = {"ortho", "persp", "handheld"};

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Textbook triangulation: x cross P X = 0, two rows a view, inhomogeneous. No weights, no refinement.
PlantPoint plainTriangulation(const std::vector<View>& views, const ClickedNode& node) {
  std::vector<detail::LinearRow> rows;
  for (const View& view : views) {
    if (!node.clicks.contains(view.name)) continue;
    const glm::dvec2 x = undistorted(view.camera, node.clicks.at(view.name));
    const glm::dmat3 r = glm::transpose(view.camera.rotation);
    const bool flat = view.camera.model == CameraModel::Orthographic;
    for (int i = 0; i < 2; ++i)
      rows.push_back({flat ? r[i] : r[i] - x[i] * r[2], (flat ? x[i] : x[i] * view.camera.translation.z) - view.camera.translation[i]});
  }
  return {detail::solveThree(rows)};
}

std::vector<double> errorsOf(const test::PlantCase& plant, const std::vector<Node>& nodes) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < nodes.size(); ++i) errors.push_back(glm::length(nodes[i].position.at - plant.truth[i].at) / plant.height_m);
  return errors;
}

TEST(Cases, ExactClicksPutEveryNodeWithinATenThousandthOfTheHeight) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  double worst = 0;
  for (const auto& folder : test::plantCaseFolders())
    for (const char* cameras : kCameras) {
      const test::PlantCase plant = test::readPlantCase(folder, {.cameras = cameras});
      const auto tree = buildSkeleton(plant.views, plant.nodes, plant.stems);
      ASSERT_TRUE(tree) << plant.name << " " << cameras << ": " << tree.error().message;
      EXPECT_EQ(tree->stems.size(), plant.stems.size());
      const auto errors = errorsOf(plant, tree->nodes);
      worst = std::max(worst, *std::max_element(errors.begin(), errors.end()));
    }
  EXPECT_LT(worst, 1e-4);
  std::printf("exact clicks: worst node %.5f %% of the height\n", 100 * worst);
}

double rootMeanSquare(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Independent clicks of 3 px cannot place every node of every plant within 0.6 %: seen small in its photo (maple, maize) one
/// pixel is more of the height, and for orthographic views plain triangulation is already the best there is. So each plant is
/// held against plain triangulation, and all plants and cameras together against the figure.
TEST(Cases, NoisyClicksAreSolvedNoWorseThanByPlainTriangulation) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases");
  std::vector<double> pooled;
  for (const char* cameras : kCameras) {
    for (const auto& folder : test::plantCaseFolders()) {
      std::vector<double> ours, plain;
      for (const std::uint64_t seed : {1, 2, 3}) {
        const test::PlantCase plant = test::readPlantCase(folder, {.cameras = cameras, .noise_px = 3, .seed = seed});
        const auto nodes = solveNodes(plant.views, plant.nodes, {.click_px = 3});
        ASSERT_TRUE(nodes) << plant.name << " " << cameras << ": " << nodes.error().message;
        const auto errors = errorsOf(plant, *nodes);
        ours.insert(ours.end(), errors.begin(), errors.end());
        for (std::size_t i = 0; i < plant.nodes.size(); ++i)
          plain.push_back(glm::length(plainTriangulation(plant.views, plant.nodes[i]).at - plant.truth[i].at) / plant.height_m);
      }
      std::printf("%-20s %-8s p95 %.3f %% (plain %.3f), rms %.3f %% (plain %.3f)\n", folder.filename().c_str(), cameras, 100 * percentile(ours, 0.95),
                  100 * percentile(plain, 0.95), 100 * rootMeanSquare(ours), 100 * rootMeanSquare(plain));
      EXPECT_LE(rootMeanSquare(ours), rootMeanSquare(plain) * (1 + 1e-9)) << folder << " " << cameras;
      EXPECT_LE(percentile(ours, 0.95), percentile(plain, 0.95) * 1.02) << folder << " " << cameras;
      pooled.insert(pooled.end(), ours.begin(), ours.end());
    }
  }
  std::printf("all plants and cameras: median %.3f %%, p95 %.3f %%\n", 100 * percentile(pooled, 0.5), 100 * percentile(pooled, 0.95));
  EXPECT_LE(percentile(pooled, 0.95), 0.006);
}

}  // namespace
}  // namespace axil::skeleton3d
