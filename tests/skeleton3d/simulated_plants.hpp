#pragma once
/// \file
/// Random trees, photographed by somebody who holds a camera by hand, with truth: tilt, roll, off-centre framing, unequal
/// distances, a measured rod beside the plant.

#include "base/rng.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace axil::test {

struct HandheldOptions {
  double noise_px = 1;
  double turned_deg = 2;       ///< standard deviation of a camera's turn about each axis
  double focalError = 0;       ///< of the EXIF focal length, as a share; 0: the focal length is given
  double wrongShare = 0;       ///< of the clicks, off by 20 to 80 px
  double bend = 0;             ///< true radial distortion k1, of which nobody tells
  int nodes = 60;
  std::vector<std::string> names = {"front", "right", "top"};
};

struct HandheldPlant {
  double height = 0;
  std::vector<skeleton3d::View> truth;  ///< true cameras
  std::vector<skeleton3d::View> views;  ///< unknown ones
  std::map<std::string, skeleton3d::UnknownCameraHints> hints;
  std::vector<skeleton3d::ClickedNode> nodes;
  std::vector<PlantPoint> places;       ///< of nodes[i]
  std::vector<std::vector<int>> stems;  ///< chains of node numbers
  std::vector<std::pair<int, std::string>> wrong;

  [[nodiscard]] std::vector<skeleton3d::ClickedStem> clickedStems() const {
    std::vector<skeleton3d::ClickedStem> clicked;
    for (const auto& stem : stems) {
      clicked.push_back({skeleton3d::StemId(static_cast<int>(clicked.size())), {}});
      for (const int node : stem) clicked.back().nodes.push_back(skeleton3d::NodeId(node));
    }
    return clicked;
  }
};

/// A stem that leans and bends, and branches off it at random heights.
inline void growRandomTree(Rng& rng, int nodes, HandheldPlant& plant) {
  plant.height = rng.uniform(0.2, 1.2);
  const int along = std::max(4, nodes / 4);
  const glm::dvec3 lean{rng.uniform(-0.15, 0.15), 0, rng.uniform(-0.15, 0.15)};
  std::vector<int> main;
  for (int i = 0; i <= along; ++i) {
    const double s = static_cast<double>(i) / along;
    main.push_back(static_cast<int>(plant.places.size()));
    plant.places.push_back({plant.height * (glm::dvec3{0, s, 0} + s * s * lean + (i > 0 ? 0.01 : 0.0) * glm::dvec3{rng.normal(), rng.normal(), rng.normal()})});
  }
  plant.stems.push_back(main);
  while (static_cast<int>(plant.places.size()) < nodes) {
    const int base = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(along - 1)));
    const double turn = rng.uniform(0, 2 * std::numbers::pi), rise = rng.uniform(0.2, 1.2), length = plant.height * rng.uniform(0.1, 0.4);
    std::vector<int> branch{base};
    for (int k = 1; k <= 4; ++k) {
      const double out = length * k / 4;
      branch.push_back(static_cast<int>(plant.places.size()));
      plant.places.push_back({plant.places[static_cast<std::size_t>(base)].at + out * glm::dvec3{std::cos(turn), rise * (1 - 0.1 * k), std::sin(turn)} / std::hypot(1.0, rise) +
                              0.004 * plant.height * glm::dvec3{rng.normal(), rng.normal(), rng.normal()}});
    }
    plant.stems.push_back(branch);
  }
}

inline skeleton3d::Camera handheldCamera(Rng& rng, const std::string& name, double height, const HandheldOptions& options) {
  const double distance = height * rng.uniform(2.0, 4.0), focal_px = 1600.0 * rng.uniform(1.0, 1.4) * distance / (1.6 * height) / 1.6;
  const glm::dvec3 target{rng.uniform(-0.05, 0.05) * height, (name == "top" ? 0.3 : 0.5) * height, rng.uniform(-0.05, 0.05) * height};
  glm::dmat3 rotation = *skeleton3d::nominalRotation(name);
  for (const PlantDirection axis : {PlantDirection::along({1, 0, 0}), PlantDirection::along({0, 1, 0}), PlantDirection::along({0, 0, 1})}) {
    const Angle by = Angle::fromDegrees(rng.normal(0, options.turned_deg));
    for (int c = 0; c < 3; ++c) rotation[c] = turned(PlantDirection::along(rotation[c]), axis, by).unit();
  }
  skeleton3d::Camera camera = skeleton3d::cameraAt(rotation, {.target = {target}, .distance = distance, .focal_px = focal_px, .size_px = {1500, 2000}});
  camera.distortion[0] = options.bend;
  return camera;
}

inline HandheldPlant handheldPlant(std::uint64_t seed, const HandheldOptions& options = {}) {
  Rng rng(seed);
  HandheldPlant plant;
  growRandomTree(rng, options.nodes, plant);
  for (std::size_t i = 0; i < plant.places.size(); ++i) plant.nodes.push_back({skeleton3d::NodeId(static_cast<int>(i)), {}, std::nullopt});
  const double rod = 0.4 * plant.height, focalError = rng.normal(0, 1) * options.focalError;
  const PlantPoint low{glm::dvec3{-0.2, 0.02, 0.15} * plant.height}, high{low.at + rod * glm::dvec3{0.1, 0.98, std::sqrt(1 - 0.01 - 0.98 * 0.98)}};
  for (const std::string& name : options.names) {
    const skeleton3d::View truth{name, handheldCamera(rng, name, plant.height, options), {1500, 2000}};
    const auto seen = [&](PlantPoint at) { return PhotoPoint{skeleton3d::project(truth.camera, at).px + options.noise_px * glm::dvec2{rng.normal(), rng.normal()}}; };
    for (std::size_t i = 0; i < plant.places.size(); ++i) {
      PhotoPoint click = seen(plant.places[i]);
      if (rng.uniform() < options.wrongShare) {
        const double turn = rng.uniform(0, 2 * std::numbers::pi), by = rng.uniform(20, 80);
        click.px += by * glm::dvec2{std::cos(turn), std::sin(turn)};
        plant.wrong.emplace_back(static_cast<int>(i), name);
      }
      if (click.px.x >= 0 && click.px.y >= 0 && click.px.x < 1500 && click.px.y < 2000) plant.nodes[i].clicks[name] = click;
    }
    skeleton3d::View asked = truth;
    asked.camera = {};
    skeleton3d::UnknownCameraHints hint;
    hint.origin_px = seen({});
    hint.scale = skeleton3d::KnownLength{seen(low), seen(high), glm::length(high.at - low.at)};
    if (options.focalError > 0)
      hint.exif_focal_px = truth.camera.focal_px->x * (1 + focalError);
    else
      asked.camera.focal_px = truth.camera.focal_px;
    plant.hints[name] = hint;
    plant.truth.push_back(truth);
    plant.views.push_back(asked);
  }
  return plant;
}

}  // namespace axil::test
