#include "document/chain.hpp"

#include "skeleton3d/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::document {
namespace {

/// A stem clicked in the photos of `seenIn`; no camera is known, the base and a length of 0.5 are.
OpenProject photographed(const std::vector<std::string>& seenIn) {
  Project project;
  const auto place = [](int i) { return PlantPoint{{0.06 * i * std::cos(i), 0.15 * i, 0.05 * i * std::sin(2.0 * i)}}; };
  std::vector<skeleton3d::Camera> cameras;
  for (const char* name : {"front", "right", "top"}) {
    cameras.push_back(*skeleton3d::nominalCamera(name, {.target = {{0, 0.5, 0}}, .distance = 3, .focal_px = 2000}));
    ProjectView view;
    view.view = {name, {}, {1200, 1600}};
    view.view.camera.model = skeleton3d::CameraModel::Unknown;
    view.view.camera.focal_px = glm::dvec2(2000, 2000);
    view.origin_px = skeleton3d::project(cameras.back(), {{0, 0, 0}});
    view.scale = skeleton3d::KnownLength{skeleton3d::project(cameras.back(), {{0, 0, 0}}), skeleton3d::project(cameras.back(), {{0, 0.5, 0}}), 0.5};
    if (view.view.name == "top") view.scale.reset();
    project.views.push_back(view);
  }
  ProjectStem stem;
  stem.stem.id = skeleton3d::StemId(1);
  for (int i = 0; i < 6; ++i) {
    ProjectNode node;
    node.node.id = skeleton3d::NodeId(i + 1);
    for (std::size_t v = 0; v < cameras.size(); ++v)
      if (std::find(seenIn.begin(), seenIn.end(), project.views[v].view.name) != seenIn.end())
        node.node.clicks[project.views[v].view.name] = skeleton3d::project(cameras[v], place(i));
    project.nodes.push_back(node);
    stem.stem.nodes.push_back(node.node.id);
  }
  project.stems.push_back(stem);
  return {std::move(project), {}};
}

TEST(Chain, APhotoWithoutEnoughClicksIsLeftOutAndNamed) {
  const auto measured = document::measured(photographed({"front", "right"}), {});
  ASSERT_TRUE(measured) << measured.error().message;
  ASSERT_EQ(measured->views.size(), 2u);
  ASSERT_FALSE(measured->notes.empty());
  EXPECT_EQ(measured->notes.front(), "view 'top' is left out: of the nodes clicked there 0 are clicked in other views too; click at least 4");
  EXPECT_TRUE(skeletonOf(photographed({"front", "right"}), {}));
}

TEST(Chain, APhotoWithTheOnlyKnownLengthIsAskedForClicks) {
  OpenProject open = photographed({"front", "right"});
  for (std::size_t i = 0; i < 3; ++i) {
    ProjectView view = open.project.views[i];
    view.scale = view.view.name == "top" ? std::optional(skeleton3d::KnownLength{{{500, 500}}, {{700, 500}}, 0.5}) : std::nullopt;
    open.project.views.set(i, view);
  }
  const auto measured = document::measured(open, {});
  ASSERT_FALSE(measured);
  EXPECT_NE(measured.error().message.find("'top'"), std::string::npos) << measured.error().message;
}

TEST(Chain, AllPhotosCountOnceTheyHaveEnoughClicks) {
  const auto measured = document::measured(photographed({"front", "right", "top"}), {});
  ASSERT_TRUE(measured) << measured.error().message;
  EXPECT_EQ(measured->views.size(), 3u);
  for (const std::string& note : measured->notes) EXPECT_EQ(note.find("left out"), std::string::npos) << note;
}

TEST(Chain, CamerasAreNotEstimatedFromPlacedClicks) {
  OpenProject off = photographed({"front", "right", "top"});
  OpenProject without = off;
  ProjectNode node = off.project.nodes[3];
  without.project.nodes.set(3, [&] {
    ProjectNode less = node;
    less.node.clicks.erase("top");
    return less;
  }());
  node.node.clicks.at("top").px += glm::dvec2(12, -9);
  node.node.placed["top"] = 0;
  off.project.nodes.set(3, node);
  const auto placed = document::measured(off, {}), left = document::measured(without, {});
  ASSERT_TRUE(placed && left);
  EXPECT_TRUE(placed->suspects.empty());
  EXPECT_EQ(placed->views[2].camera, left->views[2].camera);
}

TEST(Chain, ANodeThatOnlyALeftOutPhotoShowsIsStillAskedFor) {
  OpenProject open = photographed({"front", "right"});
  ProjectNode lone;
  lone.node.id = skeleton3d::NodeId(9);
  lone.node.clicks["top"] = {{600, 700}};
  open.project.nodes.push_back(lone);
  const auto measured = document::measured(open, {});
  ASSERT_FALSE(measured);
  EXPECT_NE(measured.error().message.find("top"), std::string::npos) << measured.error().message;
}

}  // namespace
}  // namespace axil::document
